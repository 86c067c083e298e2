// SPDX-License-Identifier: Apache-2.0
#include "cli/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <vector>

#include "cli/command_line.h"
#include "cli/help.h"
#include "corpus/exit_code.h"
#include "corpus/json.h"

namespace stiction {
namespace {

constexpr std::array kWords = {
    Word{"N1", "the normal variable of contact 1: its force fN and the acceleration aN along its normal",
         "4.1"},
    Word{"F1", "the friction variable of contact 1: its force fF and the acceleration aF along its tangent",
         "5.1"},
    Word{"F1x, F1y", "in space: the two tangents of contact 1", "5.6"},
    Word{"f, a", "forces and accelerations, a = A f + b", "4.1"},
    Word{"drive",
         "one variable's force grows, or its friction goes to zero, until its own condition holds; the others "
         "follow",
         "4.1"},
    Word{"step", "a stretch of a drive until some variable reaches a limit; of length s, which can be zero",
         "4.2"},
    Word{"df, da", "how all forces and accelerations change for a unit of the driven force", "4.2"},
    Word{"C", "normals that are clamped: aN = 0 is kept, fN is free to be positive", "4.1"},
    Word{"NC", "normals that are not clamped: fN = 0 is kept, aN is free to be positive", "4.1"},
    Word{"CF", "friction that holds: aF = 0 is kept, |fF| is less than its limit or at it", "5.2"},
    Word{"NC+", "friction at its upper limit: fF = mu fN is kept, aF <= 0", "5.2"},
    Word{"NC-", "friction at its lower limit: fF = -mu fN is kept, aF >= 0", "5.2"},
    Word{"NCF", "in space: friction at its limit, along the direction that it had when it got there", "5.6"},
    Word{"suspended", "under the policy apex=suspended: friction that rests while its normal force is zero",
         "solver/published/readings.md"},
    Word{"half", "in space: friction of which one tangent is at rest and the other not yet", "5.6"},
    Word{"turns away",
         "in space, under slip=redirect: friction leaves NCF for no set, aF being across its direction; it is "
         "driven anew, against aF",
         "solver/published/readings.md"},
    Word{"bounce", "a variable wants back into the set that it has just left, at a step of length zero", "5.5"},
    Word{"give up, given up",
         "what the paper does at a bounce: the variable leaves all sets, and is driven again later",
         "5.4, 5.5"},
    Word{"loop",
         "a run that never ends, since its state recurs, or in space stays in a box; a cycle or a stall", ""},
    Word{"cycle", "a loop over drives: a state between two drives recurs exactly, or in space stays in a box",
         ""},
    Word{"kind states, kind box, kind punctured",
         "of a loop in space: sets recur of a state that remembers nothing else; what it remembers stays in a "
         "box; in a box without the point that it comes near to",
         "certify/certificates.md"},
    Word{"endless", "a run that never ends, and on which no state recurs", "search/adversary/frontiers.md"},
    Word{"stall", "a loop inside one drive", ""},
    Word{"start, period",
         "how many drives (of a stall: steps) before the state that recurs, and until it recurs", ""},
    Word{"singular", "no direction keeps the conditions of the sets: the algorithm cannot go on", "5.5"},
    Word{"ray", "a step without limit: the forces could grow for ever", "6"},
    Word{"fold",
         "in complete driving: the determinant changes its sign, and the driven force turns back; there the "
         "published algorithm gives up",
         "solver/complete/complete_driving.md"},
    Word{"descent",
         "in complete driving: the driven force has come back to zero, and the variable before it is driven "
         "again",
         "solver/complete/complete_driving.md"},
    Word{"stage",
         "in complete driving: the pieces on which one variable is driven, until its own condition holds",
         "solver/complete/complete_driving.md"},
    Word{"piece", "in complete driving: a stretch of the path along which no contact changes its cell",
         "solver/complete/complete_driving.md"},
    Word{"cell, cells",
         "what a contact does: B breaks, S sticks, + and - slip or are about to (friction at its upper, at its "
         "lower limit), ? not driven yet, 0 without friction, H held; in space I sticks, V and E are at "
         "corners and on edges of a polygon",
         "solver/complete/complete_driving.md"},
    Word{"word",
         "the cells of all contacts, one letter each; in the certificate of a run in space, all its steps",
         "solver/complete/complete_driving.md"},
    Word{
        "enters, leaves",
        "in Lemke's method: the variable that grows from zero, and the one that comes down to zero. Of contact "
        "1, fN1 is the normal force, f+1 and f-1 are friction of either sign, l1 is the size of the slip; "
        "aN1, a+1, a-1 and m1 are what stands in the condition of each. In space corner k of the polygon has "
        "fk.1 and ak.1",
        "solver/lemke/lemke.h"},
    Word{"z0",
         "in Lemke's method: added to every condition at first, so that all hold; the method ends when it is "
         "zero",
         "solver/lemke/lemke.h"},
    Word{"policy",
         "one reading of the published text: a value for each of its open choices; `paper` is the reference",
         "solver/published/readings.md"},
    Word{"finding", "a run that is no solution, or a disagreement between methods, arithmetics or checks", ""},
    Word{"grave",
         "of a finding: methods that are proved disagree, or a problem loops that is safe, which ties alone "
         "can make",
         ""},
    Word{"certificate", "a claim with an exact witness, which a short independent program accepts",
         "certify/README.md"},
    Word{"existence",
         "that there is a solution: a theorem for every mu, where A is symmetric positive semidefinite, b in "
         "its range "
         "and no contact slides",
         "certify/existence.md"},
};

std::string TextOf(const Word& word) {
  const std::string source = word.source.empty() ? "" : fmt::format(" ({})", word.source);
  return HelpEntry(std::string(word.name), std::string(word.meaning) + source);
}

// "start, period" -> both.
std::vector<std::string_view> NamesOf(const Word& word) {
  std::vector<std::string_view> names;
  for (std::string_view rest = word.name; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(", "), rest.size());
    names.push_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 2, rest.size()));
  }
  return names;
}

// Whether a word stands in a text by itself: NC does not in "NC+" nor in "_NC".
bool StandsIn(std::string_view text, std::string_view word) {
  const auto belongs = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-';
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !belongs(text[at - 1])) && (end == text.size() || !belongs(text[end]))) return true;
  }
  return false;
}

int List(const bool& in_json) {
  Json json = Json::array();
  std::string text;
  for (const Word& word : kWords) {
    json.push_back({{"word", word.name}, {"meaning", word.meaning}, {"source", word.source}});
    text += TextOf(word);
  }
  std::cout << (in_json ? JsonText(json) + "\n" : text + "\nNumbers in brackets are sections of the paper.\n");
  return kExitDone;
}

}  // namespace

std::span<const Word> AllWords() { return kWords; }

std::string GlossaryOf(std::string_view text) {
  const auto stands = [text](std::string_view name) { return StandsIn(text, name); };
  std::string glossary;
  for (const Word& word : kWords) {
    const auto names = NamesOf(word);
    if (std::any_of(names.begin(), names.end(), stands)) glossary += TextOf(word);
  }
  return glossary;
}

const ListedVerb kWordsVerb("Show", 30, [](CommandLine& program) {
  auto [verb, in_json] = program.Add("words", "What the words of answers and replays mean", List);
  verb.Prints(in_json, "what words mean", R"([{
      word: text, meaning: text,
      source: text  // a section of the paper, or a page here
    }])");
});

}  // namespace stiction
