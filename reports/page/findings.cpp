// SPDX-License-Identifier: Apache-2.0
// Findings one by one: their data, and what the page shows of the first without a script.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "corpus/json.h"
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
          {"contacts", ProblemToJson(problem)->at("contacts")}};
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

// ---- As a page shows them ----

Html ProblemTable(const Json& numbers, const std::string& caption) {
  Table table{"problem", caption, {{"A", "", kText}}};
  for (const Json& name : numbers["names"]) table.columns.push_back({name.get<std::string>()});
  table.columns.insert(table.columns.end(), {{"b"}, {"mu"}});
  for (std::size_t row = 0; row < numbers["names"].size(); ++row) {
    std::vector<TableCell> cells = {numbers["names"][row].get<std::string>()};
    for (const Json& number : numbers["A"][row])
      cells.emplace_back(number.get<std::string>(), "", number == "0" ? "zero" : "");
    for (const char* column : {"b", "mu"})
      cells.emplace_back(row < numbers[column].size() ? numbers[column][row].get<std::string>() : "", "",
                         "edge");
    table.Add(std::move(cells));
  }
  return ToHtml(table);
}

Html FileLinks(const Json& files) {
  static constexpr const char* kTitles[] = {"problem",           "as found",           "certificate",
                                            "a solution exists", "likewise, as found", "picture"};
  Html links;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto file = files[i].get<std::string>();
    if (!file.empty()) links += (i > 0 ? Html(" · ") : Html()) + Tag("a", {{"href", file}})(kTitles[i]);
  }
  return Tag("p",
             {{"class", "note"}})(Html("Files: ") + (links.empty() ? Html("left out of this report.") : links));
}

// "2 → 1", where they differ.
std::string ContactsText(const Json& f) {
  return f["contacts"] == f["smallest"]
             ? JsonText(f["contacts"])
             : fmt::format("{} → {}", JsonText(f["contacts"]), JsonText(f["smallest"]));
}

// "about" beyond what is counted exactly.
std::string WordsText(const Json& f) {
  if (!f.contains("words")) return "";
  return (f["words_exact"] == true ? "" : "about ") + Counted(f["words"].get<std::int64_t>(), "word");
}

std::string SizeText(const Json& f) {
  if (!f.contains("nonzeros")) return f["state"] == "finished" ? "–" : "pending";
  return fmt::format("{}, {}", Counted(f["nonzeros"].get<std::int64_t>(), "nonzero"),
                     Counted(f["bits"].get<std::int64_t>(), "bit"));
}

TableCell NumberOf(const Json& f, const char* key) {
  return f.contains(key) ? TableCell(f[key].get<std::int64_t>()) : TableCell();
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
  const Json f = FindingToJson(discovery, {});
  const auto text = [&f](const char* key) { return f[key].get<std::string>(); };
  const Html numbers = f["numbers"].is_null()
                           ? Html("<p class=\"note\">Its numbers are too long for a page.</p>\n")
                           : ProblemTable(f["numbers"], "Problem of " + discovery.signature);
  return Tag("div", {{"class", "details"}})(Html("\n") + Tag("p")(text("story")) + Html("\n") + numbers +
                                            PictureOfFinding(*discovery.representative) +
                                            Tag("pre")(Tag("code")(text("commands"))) + FileLinks(f["files"])) +
         Html("\n");
}

Html FindingsRows(const std::vector<Discovery>& discoveries, const std::optional<Since>& since) {
  Table table = Described("gallery");
  table.stays_open = true;
  for (const Discovery* discovery : ByInterest(discoveries)) {
    if (table.rows.size() == kFindingsShown) break;
    const Json f = FindingToJson(*discovery, since);
    const auto text = [&f](const char* key) { return f.value(key, std::string()); };
    const std::string policy = text("policy"), whole = f["whole"] == true ? "whole grid " : "";
    table.Add({{text("signature"), "", "signature code"},
               {text("kind"), whole + text("change")},
               ContactsText(f),
               NumberOf(f, "drives"),
               NumberOf(f, "steps"),
               {Grouped(discovery->met), WordsText(f)},
               {fmt::format("{} {}/{}", text("generator"), JsonText(f["unit"]), JsonText(f["index"])),
                policy == "paper" ? "" : policy},
               text("grid"),
               text("minimized_grid"),
               SizeText(f)},
              Tag("details")(Html("<summary>A, b, mu and commands</summary>\n") + FindingDetails(*discovery)));
    table.rows.back().style = "finding";
  }
  return ToHtml(table);
}

}  // namespace stiction
