// SPDX-License-Identifier: Apache-2.0
// Findings one by one: the section of the page, and its data.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "corpus/intervals.h"
#include "corpus/plain_text.h"
#include "corpus/rational.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/finding_words.h"
#include "reports/page/page.h"
#include "reports/pictures/finding_picture.h"
#include "reports/tables/discovery.h"

namespace stiction {
namespace {

// Letters of the JSON text of a problem: longer ones nobody reads off a page.
constexpr std::size_t kLongestProblem = 6000;

// ---- The problem in numbers ----

// "N1", "F1", "N2", ...; in space a contact has two friction rows, "F1x" and "F1y".
std::vector<std::string> RowNames(const ExactProblem& problem) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    names.push_back(fmt::format("N{}", i + 1));
    if (!problem.contacts[i].HasFrictionRows()) continue;
    if (problem.dimension == 2) {
      names.push_back(fmt::format("F{}", i + 1));
    } else {
      names.insert(names.end(), {fmt::format("F{}x", i + 1), fmt::format("F{}y", i + 1)});
    }
  }
  return names;
}

std::string MuText(const Contact<Rational>& contact) {
  return contact.HasFrictionRows() ? ToString(contact.mu) : "–";
}

// The column of mu: the coefficient beside the normal of its contact.
std::vector<std::string> MuColumn(const ExactProblem& problem) {
  std::vector<std::string> column;
  for (const Contact<Rational>& contact : problem.contacts) {
    column.push_back(MuText(contact));
    if (contact.HasFrictionRows())
      column.resize(column.size() + static_cast<std::size_t>(problem.dimension) - 1);
  }
  return column;
}

TableCell Number(const Rational& x, const std::string& style = "") {
  return {ToString(x), "", x == 0 && style.empty() ? "zero" : style};
}

Html ProblemTable(const ExactProblem& problem, const std::string& caption) {
  const std::vector<std::string> names = RowNames(problem);
  const std::vector<std::string> mu = MuColumn(problem);
  Table table{"problem", caption, {{"A", "", kText}}};
  for (const std::string& name : names) table.columns.push_back({name});
  table.columns.insert(table.columns.end(), {{"b"}, {"mu"}});
  for (int row = 0; row < problem.rows(); ++row) {
    std::vector<TableCell> cells = {names[row]};
    for (int column = 0; column < problem.rows(); ++column) cells.push_back(Number(problem.A(row, column)));
    cells.push_back(Number(problem.b[row], "edge"));
    cells.emplace_back(mu[row], "", "edge");
    table.Add(std::move(cells));
  }
  return ToHtml(table);
}

// Numbers of A and b that are not zero; bits of the longest numerator or denominator.
std::pair<int, std::int64_t> SizeOf(const ExactProblem& problem) {
  int nonzeros = 0;
  std::int64_t bits = 0;
  const auto count = [&](const Rational& x) {
    nonzeros += x != 0;
    bits = std::max<std::int64_t>(bits, Bits(x));
  };
  for (const Rational& x : problem.A.reshaped()) count(x);
  for (const Rational& x : problem.b) count(x);
  for (const auto& contact : problem.contacts) count(contact.mu);
  return {nonzeros, bits};
}

// The minimized problem; as found while there is none.
const std::string& SimplestText(const Finding& finding) {
  return finding.minimized.empty() ? finding.problem : finding.minimized;
}

Html ProblemOf(const Finding& finding) {
  const std::string& text = SimplestText(finding);
  if (text.size() > kLongestProblem)
    return Html("<p class=\"note\">Its numbers are too long for a page.</p>\n");
  return ProblemTable(ParseProblem(text, finding.signature).problem, "Problem of " + finding.signature);
}

// ---- Words ----

// "solved 36, cycle 1,500"
std::string GridText(const GridOutcomes& grid) {
  std::string text;
  for (int i = 0; i < kOutcomeCount; ++i) {
    if (grid.counts[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kOutcomeNames[i], Grouped(grid.counts[i]));
  }
  return text;
}

// "Under paper: the state after 3 drives recurs 4 drives later, for ever (17 steps in all)."
std::string RunText(const RunFacts& run, const ProvedRun& proved, const Finding& finding) {
  if (!IsLoopKind(finding.kind) && finding.exact_outcome != Name(Outcome::kCycle))
    return fmt::format("Exactly: {} after {}.", finding.exact_outcome, Counted(run.steps, "step"));
  const std::string steps = proved.steps > 0 ? fmt::format(" ({} in all)", Counted(proved.steps, "step")) : "";
  return fmt::format("Under {}: {}{}.", finding.policy, LoopSentence(proved, UnitOfLoop(finding)), steps);
}

// Commands for a shell in the folder of the report.
std::string CommandsOf(const Discovery& discovery) {
  const Finding& finding = *discovery.representative;
  const std::string problem = discovery.HasFiles() ? ShellWord(discovery.files.problem) : "problem.json";
  std::string text = "stiction replay " + problem + ReplayOptionsOf(finding);
  text = fmt::format("{0} --step\n{0} --html replay.html", text);
  if (!discovery.HasFiles())
    return fmt::format("stiction problem STORE {} {} -o problem.json\n{}", finding.unit, finding.index, text);
  if (!discovery.files.certificate.empty())
    text += fmt::format("\nstiction check {}", ShellWord(discovery.files.certificate));
  return text;
}

Html FileLinks(const FindingFiles& files) {
  const auto link = [](const std::string& file, std::string_view title) {
    return Tag("a", {{"href", file}})(title);
  };
  if (files.problem.empty()) return Tag("p", {{"class", "note"}})("Files: left out of this report.");
  Html links = link(files.problem, "problem") + Html(" · ") + link(files.original, "as found");
  if (!files.certificate.empty()) links += Html(" · ") + link(files.certificate, "certificate");
  if (!files.existence.empty()) links += Html(" · ") + link(files.existence, "a solution exists");
  if (!files.original_existence.empty())
    links += Html(" · ") + link(files.original_existence, "likewise, as found");
  if (!files.picture.empty()) links += Html(" · ") + link(files.picture, "picture");
  return Tag("p", {{"class", "note"}})(Html("Files: ") + links);
}

std::string SafeText(const RunFacts& run) {
  return run.safe == true ? " All reduced determinants are positive." : "";
}

// What happens, and to which problem.
std::string StoryOf(const Discovery& discovery) {
  const Finding& finding = *discovery.representative;
  if (!discovery.Finished()) return "Neither certified nor minimized yet; the problem as found:";
  if (discovery.minimized)
    return RunText(*discovery.minimized, ProvedRunOf(finding, FindingForm::kMinimized), finding) +
           SafeText(*discovery.minimized);
  std::string text = fmt::format("In doubles: {}.", finding.inexact_outcome);
  if (discovery.found)
    text += " " + RunText(*discovery.found, ProvedRunOf(finding, FindingForm::kFound), finding);
  return text + " Not minimized; the problem as found:";
}

// ---- The table ----

Html KindBadge(const Discovery& discovery, const std::optional<Since>& since) {
  const bool stands_out = discovery.IsLoop() || IsGrave(discovery.kind);
  const Tag badge("span", {{"class", stands_out ? "badge loop" : "badge"}});
  Html html = badge(discovery.kind);
  if (discovery.WholeGrid()) html += Html(" <span class=\"badge whole\">whole grid</span>");
  const std::string_view change = since ? since->ChangeOf(discovery) : "";
  if (!change.empty()) html += Html(" ") + Tag("span", {{"class", "badge change"}})(change);
  return html;
}

Html ContactsText(const Discovery& discovery) {
  const int found = discovery.representative->contacts, smallest = discovery.SmallestContacts();
  return found == smallest ? Text(std::to_string(found)) : Text(fmt::format("{} → {}", found, smallest));
}

// "about" beyond what is counted exactly.
Html MetText(const Discovery& discovery) {
  Html met = Text(Grouped(discovery.met));
  if (!discovery.words) return met;
  const std::int64_t words = discovery.Words();
  return met + Tag("small")((discovery.words->IsExact() ? "" : "about ") + Counted(words, "word"));
}

Html RepresentativeText(const Finding& finding) {
  Html html = Text(fmt::format("{} {}/{}", finding.generator, finding.unit, finding.index));
  if (finding.policy != "paper") html += Tag("small")(finding.policy);
  return html;
}

Html SizeText(const Discovery& discovery) {
  if (!discovery.minimized) return Tag("span", {{"class", "soft"}})(discovery.Finished() ? "–" : "pending");
  const Finding& finding = *discovery.representative;
  const auto [nonzeros, bits] = SizeOf(ParseProblem(finding.minimized, finding.signature).problem);
  return Text(fmt::format("{}, {}", Counted(nonzeros, "nonzero"), Counted(bits, "bit")));
}

Html FindingsRows(const std::vector<const Discovery*>& shown, const std::optional<Since>& since) {
  Table table{
      "gallery",
      "Findings, the simplest first",
      {{"signature", "the same for problems that differ by permuted contacts, reversed tangents or units",
        kText},
       {"kind", "", kText},
       {"contacts", "of the problem as found → of the minimized problem", kText},
       {"drives", "of one period of the loop"},
       {"steps", "of one period of the loop"},
       {"met",
        "runs of the campaign with this signature; below: different words of their loops, where the signature "
        "is counts alone"},
       {"representative", "generator, unit and index of the first problem that shows it; its policy", kText},
       {"policies, as found", "outcomes over the planar grid of policies", kText},
       {"policies, minimized", "likewise, of the minimized problem", kText},
       {"minimized size", "entries of A and b that are not zero; bits of the longest number", kText}}};
  table.stays_open = true;
  for (const Discovery* d : shown) {
    table.Add(
        {TableCell(Tag("code")(d->signature), "", "signature"), KindBadge(*d, since), ContactsText(*d),
         d->loop ? TableCell(d->loop->drives) : TableCell(), d->loop ? TableCell(d->loop->steps) : TableCell(),
         MetText(*d), RepresentativeText(*d->representative), d->found ? GridText(d->found->grid) : "",
         d->minimized ? GridText(d->minimized->grid) : "", SizeText(*d)},
        Tag("details")(Html("<summary>A, b, mu and commands</summary>\n") + FindingDetails(*d)));
    table.rows.back().style = "finding";
  }
  return ToHtml(table);
}

Html HowMany(std::size_t represented, const std::vector<Discovery>& discoveries) {
  const auto all = static_cast<std::int64_t>(discoveries.size());
  const auto here = static_cast<std::int64_t>(represented);
  std::string text =
      "One row per signature: cycles of safe problems and disagreements of methods first, then loops, finished "
      "ones before others, then fewest contacts, then those that every policy of the grid shows, then the most "
      "frequent. ";
  text += here == all
              ? "All " + Counted(all, "signature") + (all == 1 ? " is" : " are")
              : fmt::format("{} of {} have a representative and are", Grouped(here), Counted(all, "signature"));
  text += represented > kFindingsShown
              ? fmt::format(" here, without a script the first {}; all are in ", kFindingsShown)
              : " here; all are in ";
  return Tag("p", {{"class", "how-many"}})(Text(text) +
                                           Html("<a href=\"findings.csv\"><code>findings.csv</code></a>."));
}

Html IpoptText(const std::vector<Discovery>& discoveries) {
  std::int64_t asked = 0, solved = 0, starts = 0, unavailable = 0;
  for (const Discovery& discovery : discoveries) {
    if (!discovery.ipopt) continue;
    const FeasibilityFacts& facts = *discovery.ipopt;
    if (facts.outcome == "unavailable") {
      ++unavailable;
      continue;
    }
    ++asked;
    solved += facts.outcome == "solved";
    starts += facts.outcome == "solved" ? facts.starts : 0;
  }
  if (asked + unavailable == 0) return Html();
  std::string text = fmt::format("Ipopt could not be asked about {}.", Counted(unavailable, "finding"));
  if (asked > 0) {
    text = fmt::format(
        "Ipopt’s feasibility solve led to a solution, verified over rationals, of {} of {} "
        "finished findings, {}, after {} starts in the mean; ",
        Grouped(solved), Grouped(asked), ShareText(solved, asked), Mean(starts, solved));
    text += unavailable > 0 ? fmt::format("it could not be asked about {}; each is in ", unavailable)
                            : "each is in ";
  }
  Html html = Text(text);
  if (asked > 0) html += Html("<a href=\"ipopt.csv\"><code>ipopt.csv</code></a>.");
  return Tag("p")(html) + Html("\n");
}

// ---- Data ----

Json NumbersToJson(const ExactProblem& problem) {
  Json A = Json::array(), b = Json::array();
  for (int row = 0; row < problem.rows(); ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < problem.rows(); ++column) numbers.push_back(ToString(problem.A(row, column)));
    A.push_back(std::move(numbers));
    b.push_back(ToString(problem.b[row]));
  }
  return {{"names", RowNames(problem)},
          {"A", std::move(A)},
          {"b", std::move(b)},
          {"mu", MuColumn(problem)},
          {"dimension", problem.dimension},
          {"contacts", ProblemToJson(problem)["contacts"]}};
}

Json FilesToJson(const FindingFiles& files) {
  return {files.problem,   files.original,           files.certificate,
          files.existence, files.original_existence, files.picture};
}

Json FindingToJson(const Discovery& discovery, const std::optional<Since>& since) {
  const Finding& finding = *discovery.representative;
  Json json = {{"signature", discovery.signature},
               {"kind", discovery.kind},
               {"loop", discovery.IsLoop()},
               {"stands_out", discovery.IsLoop() || IsGrave(discovery.kind)},
               {"whole", discovery.WholeGrid()},
               {"state", StateOf(discovery)},
               {"contacts", finding.contacts},
               {"smallest", discovery.SmallestContacts()},
               {"met", discovery.met},
               {"generator", finding.generator},
               {"unit", finding.unit},
               {"index", finding.index},
               {"policy", finding.policy}};
  if (discovery.loop) {
    json["drives"] = discovery.loop->drives;
    json["steps"] = discovery.loop->steps;
  }
  if (discovery.words) {
    json["words"] = discovery.Words();
    json["words_exact"] = discovery.words->IsExact();
  }
  if (since) json["change"] = since->ChangeOf(discovery);
  if (discovery.found) json["grid"] = GridText(discovery.found->grid);
  if (discovery.minimized) json["minimized_grid"] = GridText(discovery.minimized->grid);
  const std::string& text = SimplestText(finding);
  const ExactProblem problem = ParseProblem(text, finding.signature).problem;
  if (discovery.minimized) {
    const auto [nonzeros, bits] = SizeOf(problem);
    json["nonzeros"] = nonzeros;
    json["bits"] = bits;
  }
  json["story"] = StoryOf(discovery);
  json["commands"] = CommandsOf(discovery);
  json["files"] = FilesToJson(discovery.files);
  json["numbers"] = text.size() > kLongestProblem ? Json() : NumbersToJson(problem);
  if (const auto& run = discovery.minimized ? discovery.minimized : discovery.found; run) {
    json["looping"] = run->grid.Loops();
    json["policies"] = run->grid.Total();
    // Whose drives are said to recur.
    const bool recurs = !discovery.IsLoop() || ProvedRunOf(finding, SimplestForm(finding)).Recurs();
    json["start"] = recurs ? run->start : 0;
    json["period"] = recurs ? run->period : 0;
  }
  return json;
}

}  // namespace

Json FindingsToJson(const std::vector<Discovery>& discoveries, const std::optional<Since>& since,
                    std::size_t most) {
  Json json = Json::array();
  for (const Discovery* discovery : ByInterest(discoveries)) {
    if (json.size() < most) json.push_back(FindingToJson(*discovery, since));
  }
  return json;
}

Html FindingDetails(const Discovery& discovery) {
  const Finding& finding = *discovery.representative;
  return Tag("div", {{"class", "details"}})(Html("\n") + Tag("p")(StoryOf(discovery)) + Html("\n") +
                                            ProblemOf(finding) + PictureOfFinding(finding) +
                                            Tag("pre")(Tag("code")(CommandsOf(discovery))) +
                                            FileLinks(discovery.files)) +
         Html("\n");
}

Html FindingsSection(const std::vector<Discovery>& discoveries, const std::optional<Since>& since) {
  if (discoveries.empty()) return Section("findings", "Findings", Html("<p>None.</p>\n"));
  std::vector<const Discovery*> shown = ByInterest(discoveries);
  const std::size_t represented = shown.size();
  if (represented > kFindingsShown) shown.resize(kFindingsShown);
  return Section(
      "findings", "Findings",
      HowMany(represented, discoveries) + IpoptText(discoveries) +
          Html("<p>Commands stand in the folder of this page, where <code>stiction</code> is the program, or "
               "<code>run</code> of its sources:</p>\n<pre class=\"setup\"><code>stiction() { "
               "/path/to/stiction/run \"$@\"; }</code></pre>\n<p class=\"note\"><code>replay</code> shows "
               "every pivot in exact numbers, as text or as a page to step through; <code>check</code> "
               "verifies a certificate, and so does <code>certify/check_certificate.py</code> of the sources, "
               "which shares nothing with it.</p>\n<div id=\"gallery\"></div>\n") +
          FindingsRows(shown, since));
}

}  // namespace stiction
