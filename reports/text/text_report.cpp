// SPDX-License-Identifier: Apache-2.0
#include "reports/text/text_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/program_name.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/finding_words.h"
#include "corpus/store/store_totals.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

constexpr std::size_t kShown = 10;       // loops of a list
constexpr std::size_t kShownOfTwo = 5;   // likewise on two screens
constexpr int kMostRowsInNumbers = 12;   // of a matrix on the page
constexpr std::size_t kLongestWord = 9;  // of its numbers

// What a label means, for someone who has not read the paper.
std::string InWords(const std::string& label) {
  static const std::map<std::string, std::string> words = {
      {"safe-cycle", "loop for ever though safe, which ties alone can make"},
      {"disagreement-of-methods", "methods that prove contradict each other"},
      {"cycle", "loop for ever"},
      {"stall", "loop inside one drive"},
      {"singular", "no direction of the forces exists"},
      {"ray", "a step without limit"},
      {"limit", "budget spent before an end"},
      {"undecided", "intervals cannot tell"},
      {"wrong-answer", "doubles: solved, and it is not"}};
  const auto found = words.find(label);
  if (found != words.end()) return found->second;
  constexpr std::string_view kDisagreement = "disagreement-";
  if (!label.starts_with(kDisagreement)) return label;
  const std::string ends = label.substr(kDisagreement.size());
  const std::size_t dash = ends.find('-');
  return dash == ends.npos ? label
                           : fmt::format("doubles: {}, exact: {}", ends.substr(0, dash), ends.substr(dash + 1));
}

std::string RateSentence(std::int64_t count, std::int64_t runs) {
  return fmt::format("{} in a million runs", RateText(count, runs));
}

// "1 is", "2 are".
std::string Verb(std::int64_t count, const char* one, const char* more) {
  return fmt::format("{} {}", Grouped(count), count == 1 ? one : more);
}

std::string Command(const std::string& text) { return "    " + text + "\n"; }

// ---- Sentences, each of one subject ----

std::string HeadLine(const StoreTotals& t, const Store& store, const std::string& file) {
  std::string text = fmt::format("{}: {} in {}, seed {}", file, Counted(t.problems, "problem"),
                                 Counted(t.units, "unit"), store.identity().seed);
  if (t.counts.runs != t.problems)
    text += fmt::format("; {}, each problem under every policy asked for", Counted(t.counts.runs, "run"));
  return Paragraph(text, 0);
}

std::string RemarkLines(const CampaignIdentity& identity) {
  std::string text;
  const Json remarks = RemarksOf(identity);
  for (const auto& [name, value] : remarks.items())
    text += Paragraph(fmt::format("{}: {}", name, PlainValue(value)));
  return text;
}

std::string GraveLines(const StoreTotals& t) {
  std::string text;
  for (const Finding& finding : t.grave)
    text += Paragraph(fmt::format("GRAVE: {}: {}", finding.kind, finding.signature));
  return text;
}

std::string LoopsText(const StoreTotals& t) {
  const std::int64_t loops = t.counts.Loops(), runs = t.counts.runs;
  if (runs == 0) return "";
  if (loops == 0) {
    return Paragraph(fmt::format("No run of the published algorithm, under {}, was found to loop: {}.",
                                 PoliciesText(t.record), RateSentence(0, runs)));
  }
  std::string text =
      Paragraph(fmt::format("The published algorithm, under {}, loops for ever in {}: {}. In the plane a state "
                            "of such a run recurs, exactly; in space, as intervals prove, one does or the run "
                            "never leaves a box: so it never ends.",
                            PoliciesText(t.record), Counted(loops, "run"), RateSentence(loops, runs)));
  const bool is_minimized =
      std::any_of(t.simplest.begin(), t.simplest.end(), [](const Finding& f) { return IsLoopKind(f.kind); });
  const std::string grid =
      t.finished_loops == 0
          ? is_minimized ? "other policies were not looked at, which is done of minimized loops in the plane"
                         : "none is minimized yet, which tells how many loop under every policy"
          : fmt::format("of {} finished, {} under every policy that stiction distinguishes, as minimized",
                        Grouped(t.finished_loops), Verb(t.whole_grid, "loops", "loop"));
  text += Paragraph(fmt::format("Found in {}; {}.", Counted(t.LoopGroups(), "group"), grid));
  if (t.loops.loops > 0) {
    text += Paragraph(fmt::format(
        "Steps of length zero in the periods of {}: {} none, {} no others.", Counted(t.loops.loops, "loop"),
        Verb(t.loops.without_zero_steps, "has", "have"), Verb(t.loops.of_zero_steps_alone, "has", "have")));
  }
  return text;
}

// How the algorithm fails, in exact arithmetic or, in space, over intervals.
std::string FailuresTable(const StoreTotals& t) {
  Table table{"failures", "", Columns("repeated_exactly* outcome* runs in_a_million_[95_%]")};
  table.keys = 2;
  for (int i = 0; i < kOutcomeCount; ++i) {
    const std::string name(kOutcomeNames[i]);
    const std::int64_t count = t.counts.exact[i];
    if (i != static_cast<int>(Outcome::kSolved) && count > 0)
      table.Add({InWords(name), name, count, RateOf(count, t.counts.runs)});
  }
  return table.rows.empty() ? Paragraph("No run that was repeated exactly fails.") : ToText(table);
}

// What a label of doubles says, which is no disagreement of the exact methods.
std::string OfDoublesText(const std::string& label) {
  const std::string words = InWords(label);
  return IsOfDoubles(KindOf(label + "-")) && words != label ? fmt::format(" ({})", words) : "";
}

// Groups of findings, by kind.
std::string GroupsText(const StoreTotals& t) {
  std::vector<std::string> parts;
  for (const auto& [label, count] : t.groups)
    parts.push_back(fmt::format("{} of {}{}", Grouped(count), label, OfDoublesText(label)));
  return parts.empty() ? Paragraph("No findings.")
                       : Paragraph(fmt::format("Groups of findings: {}.", fmt::join(parts, ", ")));
}

std::string ExistenceText(const StoreTotals& t) {
  const ExistenceTally& e = t.existence;
  const AgreementTally& a = t.agreement;
  std::string text;
  if (e.problems == 0) {
    text += Paragraph("Whether solutions exist was not asked: no problem was given to complete driving.");
  } else {
    const std::int64_t missed = e.problems - e.solved;
    text +=
        Paragraph(fmt::format("{}: of {} given to complete driving {} solved, each solution verified exactly "
                              "({} with folds, where the published algorithm gives up).",
                              missed == 0 ? "Complete driving never failed"
                                          : fmt::format("Complete driving FAILED on {}", Grouped(missed)),
                              Counted(e.problems, "problem"), Grouped(e.solved), Grouped(e.with_folds)));
  }
  const std::string disagree =
      t.disagreements == 0 ? "they never disagree with each other" : Counted(t.disagreements, "disagreement");
  if (a.compared > 0 || t.disagreements > 0)
    text += Paragraph(fmt::format("Exact methods compared on {}, on {} of them all contact modes, too: {}.",
                                  Counted(a.compared, "problem"), Grouped(a.enumerated), disagree));
  if (a.safety_decided > 0)
    text += Paragraph(
        fmt::format("{} of {} {} safe (all reduced determinants are positive); under apex=suspended the "
                    "published algorithm gave something up in {} of them.",
                    Grouped(a.safe), Counted(a.safety_decided, "audited problem"), a.safe == 1 ? "is" : "are",
                    Grouped(a.safe_gave_up)));
  return text;
}

std::string DoublesText(const StoreTotals& t) {
  const Counts& c = t.counts;
  if (c.runs == 0) return "";
  return Paragraph(fmt::format(
      "Faults of doubles, not of the algorithm: in {} they differ from exact arithmetic ({} in a million), in "
      "{} they call solved what is not ({} in a million). They were suspected in {}, and right in {} of them; "
      "of "
      "{}, {} misjudged.",
      Counted(c.doubles_differ, "run"), RateText(c.doubles_differ, c.runs), Counted(c.wrong, "run"),
      RateText(c.wrong, c.runs), Counted(c.suspicious, "run"), Grouped(c.confirmed),
      Counted(c.audited, "audited run"), Verb(c.misjudged, "was", "were")));
}

// What the rates are worth: how much was audited, and what came of it.
std::string WorthText(const StoreTotals& t) {
  const Counts& c = t.counts;
  if (c.runs == 0) return "";
  const std::string misjudged =
      c.audited == 0 ? "" : fmt::format("; {} of them were misjudged", ShareText(c.misjudged, c.audited));
  std::string text = "In brackets: exact intervals at 95 %. ";
  if (c.audited + c.suspicious == c.runs) {
    text += fmt::format("Every run was repeated exactly{}.", misjudged);
  } else {
    text += fmt::format(
        "Rates are lower bounds: loops that doubles take for solutions are not counted. {} of {} without a "
        "suspicion were audited{}.",
        Grouped(c.audited), Counted(c.runs - c.suspicious, "run"), misjudged);
  }
  return Paragraph(text);
}

std::string FinishText(const StoreTotals& t, const std::string& file) {
  // What exact runs do not decide, or do not show again, has neither.
  const auto minimized = std::ssize(t.simplest);
  const std::string without =
      minimized == t.finished ? "" : fmt::format(", {} finished without that", Grouped(t.finished - minimized));
  std::string text = Paragraph(
      fmt::format("Representatives, one of each group as far as kept: {} certified and minimized{}, {} to go.",
                  Grouped(minimized), without, Grouped(t.pending)));
  if (t.pending > 0) text += Paragraph("What is to go is finished by:") + Command(FinishCommand(file));
  return text;
}

// What happens to a finished finding, minimized.
std::string FindingText(const Finding& finding) {
  const Json facts = MinimizedFacts(finding);
  const auto number = [&facts](const char* key) { return facts.at(key).get<std::int64_t>(); };
  std::string text = Counted(number("contacts"), "contact");
  if (IsLoopKind(finding.kind)) {
    text += ", " + LoopClause(ProvedRunOf(finding, FindingForm::kMinimized), UnitOfLoop(finding));
  } else {
    text += ", " + InWords(finding.kind);
  }
  std::string grid;
  for (const auto& [outcome, count] : facts.at("grid").items())
    grid += fmt::format("{}{} {}", grid.empty() ? "" : ", ", JsonText(count), outcome);
  return text + (grid.empty() ? "; in space, over intervals" : "; policies: " + grid);
}

std::string SimplestText(const StoreTotals& t) {
  if (t.simplest.empty()) return "";
  std::string text = "Simplest, proved and minimized:\n";
  for (std::size_t i = 0; i < std::min(kShown, t.simplest.size()); ++i) {
    text += Paragraph(t.simplest[i].signature);
    text += Paragraph(FindingText(t.simplest[i]), 6);
  }
  return text;
}

// ---- The page's own sections ----

// A table of failures for each policy, on two screens for one; `names` stand before the runs.
std::string FailuresByPolicy(const Record& record, const By& names, const char* title, Extent extent) {
  By by = names;
  by.insert(by.begin(), "policy");
  std::string columns;
  for (const std::string& name : by) columns += name == "friction" ? "friction=mu " : name + " ";
  columns += "runs #loops loops=in_a_million_[95_%] #singular #ray=rays";
  const Table table = Select(FailuresTable(record, by), columns, "");
  if (extent == Extent::kAll) return TextByPolicy(table, title);
  const std::map<std::string, Table> parts = SplitBy(table, "policy");
  if (parts.empty()) return "";
  const auto paper = parts.find("paper");
  const auto& [policy, part] = paper == parts.end() ? *parts.begin() : *paper;
  return Paragraph(fmt::format(fmt::runtime(title), policy)) + ToText(part);
}

// A, b and mu, if they fit.
std::string ProblemText(const ExactProblem& problem) {
  if (problem.rows() > kMostRowsInNumbers) return Paragraph("Its numbers are too many for a page of text.");
  Table table{"problem", "", std::vector<Column>(static_cast<std::size_t>(problem.rows()) + 2)};
  table.columns.front().name = "A";
  table.columns.back().name = "b";
  for (int row = 0; row < problem.rows(); ++row) {
    std::vector<TableCell> cells = {""};
    for (int column = 0; column < problem.rows(); ++column)
      cells.emplace_back(ToString(problem.A(row, column)));
    cells.emplace_back(ToString(problem.b[row]));
    for (const TableCell& cell : cells) {
      if (Shown(cell).size() > kLongestWord) return Paragraph("Its numbers are too long for a page of text.");
    }
    table.Add(std::move(cells));
  }
  std::vector<std::string> mu;
  for (const auto& contact : problem.contacts)
    mu.push_back(contact.HasFrictionRows() ? ToString(contact.mu) : std::string(Name(contact.kind)));
  return ToText(table) + Paragraph(fmt::format("mu = {}", fmt::join(mu, ", ")));
}

std::string SimplestInFull(const StoreTotals& t, const std::string& file) {
  const auto first =
      std::find_if(t.simplest.begin(), t.simplest.end(), [](const Finding& f) { return IsLoopKind(f.kind); });
  if (first == t.simplest.end()) return "";
  const std::string problem = "report/findings/" + FileName(first->signature) + ".json";
  const std::string options = ReplayOptionsOf(*first);
  std::string text = "\n" + Heading("The simplest loop: " + first->signature);
  text += Paragraph(FindingText(*first) + ".") +
          ProblemText(ParseProblem(first->minimized, first->signature).problem);
  text += Paragraph("Step by step, with every force, and as a page in which to step:");
  text += Command(fmt::format("{} report {} -o report", ProgramName(), ShellWord(file)));
  text += Command(fmt::format("{} replay {} --step{}", ProgramName(), problem, options));
  text += Command(fmt::format("{} replay {} --html loop.html{}", ProgramName(), problem, options));
  text += Paragraph("The problem as the search drew it:");
  text +=
      Command(fmt::format("{} problem {} {} {}", ProgramName(), ShellWord(file), first->unit, first->index));
  return text;
}

std::string NewLoops(const StoreTotals& t, const KnownCase& known_as, std::size_t shown) {
  std::vector<std::pair<std::string, std::int64_t>> unknown;
  std::int64_t loops = 0;
  for (const auto& [signature, count] : t.record.signatures) {
    if (!IsLoopKind(KindOf(signature))) continue;
    ++loops;
    if (known_as(signature).empty()) unknown.emplace_back(signature, count);
  }
  if (loops == 0) return "";
  const auto all = static_cast<std::int64_t>(unknown.size());
  std::string text = "\n" + Heading("New groups of loops");
  text += Paragraph(
      fmt::format("Of {} {} shown by no case of the corpus.", Counted(loops, "group"), Verb(all, "is", "are")));
  std::stable_sort(unknown.begin(), unknown.end(),
                   [](const auto& left, const auto& right) { return left.second > right.second; });
  Table table{"new", "", Columns("signature* runs")};
  for (std::size_t i = 0; i < std::min(shown, unknown.size()); ++i)
    table.Add({unknown[i].first, unknown[i].second});
  if (unknown.size() > shown) text += Paragraph(fmt::format("The {} that were met most often:", shown));
  return text + ToText(table);
}

// "0.1.0 2060e9f249a5, GNU 12.2.0 Release" of a build, whose flags follow.
std::string WithoutFlags(const std::string& build) {
  const std::size_t first = build.find(',');
  return first == build.npos ? build : build.substr(0, build.find(',', first + 1));
}

// Rates under every policy, by contacts and friction, too; or by generator, under the first one.
std::string RatesText(const StoreTotals& t, Extent extent) {
  if (t.counts.runs == 0) return "";
  std::string text = "\n" + Heading("How often it fails, in exact arithmetic or, in space, over intervals");
  if (extent == Extent::kTwoScreens)
    return text + FailuresByPolicy(t.record, {"generator"}, "Policy {}:", extent);
  return text + FailuresByPolicy(t.record, {"generator", "contacts"}, "Policy {}:", extent) + "\n" +
         Heading("The same by friction coefficient") +
         Paragraph(
             "Of bodies mu is friction; of matrices alone it speaks of how they were drawn, since other "
             "units of the tangents make another mu of it.") +
         FailuresByPolicy(t.record, {"friction"}, "Policy {}, all generators together:", extent);
}

// But for machines and processor times, which `status` tells: equal searches give equal reports. On two screens
// what makes its problems.
std::string SearchedText(const Store& store, const StoreTotals& t, const std::string& file, Extent extent) {
  const CampaignIdentity& identity = store.identity();
  std::string text = "\n" + Heading("What was searched");
  const Json definition = ToldDefinition(identity);
  if (definition.is_object()) {
    for (const auto& [key, value] : definition.items()) {
      const bool makes_problems = key == "generators" || key == "contacts" || key == "mu" || key == "note";
      if (key != "format" && key != "version" && (makes_problems || extent == Extent::kAll))
        text += Paragraph(fmt::format("{}: {}", key, PlainValue(value)));
    }
  } else {
    text += Paragraph(identity.definition);
  }
  const Json policies = Json::parse(identity.policies, nullptr, false);
  if (extent == Extent::kAll)
    text += Paragraph("policies: " + (policies.is_array() ? PlainValue(policies) : identity.policies));
  text += Paragraph(fmt::format("seed {}, version {} of the algorithm", identity.seed, identity.algorithm));
  for (const std::string& build : t.work.builds) {
    if (extent == Extent::kAll || &build == &*t.work.builds.begin())
      text += Paragraph("build: " + WithoutFlags(build));
  }
  if (extent == Extent::kAll) return text;
  return text + Paragraph("By contacts, friction and every policy, with the campaign in full:", 0) +
         Command(fmt::format("{} report {} --text --all", ProgramName(), ShellWord(file)));
}

std::string Findings(const StoreTotals& t) {
  return LoopsText(t) + FailuresTable(t) + GroupsText(t) + ExistenceText(t) + DoublesText(t) + WorthText(t);
}

}  // namespace

std::string SummaryText(const Store& store, const std::string& file) {
  const StoreTotals t = TotalsOf(store);
  return HeadLine(t, store, file) + GraveLines(t) + RemarkLines(store.identity()) + Findings(t) +
         FinishText(t, file) + Paragraph(TimeText(t.work.time)) + SimplestText(t) +
         Paragraph("More as text; all as a page, with files to replay and to check:", 0) +
         Command(fmt::format("{} report {} --text", ProgramName(), ShellWord(file))) +
         Command(fmt::format("{} report {} -o report", ProgramName(), ShellWord(file))) +
         Paragraph("More --minutes or --problems go on from here.", 0);
}

std::string TextReport(const Store& store, const std::string& file, const KnownCase& known_as, Extent extent) {
  const StoreTotals t = TotalsOf(store);
  const std::size_t shown = extent == Extent::kAll ? kShown : kShownOfTwo;
  return HeadLine(t, store, file) + GraveLines(t) + "\n" + Heading("What was found") + Findings(t) +
         FinishText(t, file) + SimplestInFull(t, file) + NewLoops(t, known_as, shown) + RatesText(t, extent) +
         SearchedText(store, t, file, extent);
}

}  // namespace stiction
