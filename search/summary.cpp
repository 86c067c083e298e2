// SPDX-License-Identifier: Apache-2.0
#include "search/summary.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/program_name.h"
#include "corpus/record/counts.h"
#include "corpus/record/fields.ipp"
#include "corpus/record/problem_file.h"
#include "corpus/store/store_totals.h"
#include "search/adversary/optimized_unit.h"
#include "search/families.h"
#include "search/under_test/solver_report.h"

namespace stiction {
namespace {

Json TimeToJson(const ProcessorTime& time) {
  Json json = Json::object();
  ForEachPart(time, [&json](const char* name, const char*, std::int64_t value) {
    json[name] = static_cast<double>(value) * 1e-6;
  });
  return json;
}

Json IntervalToJson(const Interval& interval) { return {{"low", interval.low}, {"high", interval.high}}; }

// Runs that fail in exact arithmetic, by outcome, and where doubles fail. Both counts of a rate are of
// `counts`.
std::map<std::string, std::int64_t> FailuresOf(const Counts& counts) {
  std::map<std::string, std::int64_t> failures;
  for (int i = 0; i < kOutcomeCount; ++i) {
    const auto outcome = static_cast<Outcome>(i);
    if (outcome != Outcome::kSolved && counts.exact[i] > 0)
      failures[std::string(Name(outcome))] = counts.exact[i];
  }
  if (counts.doubles_differ > 0) failures["doubles-differ"] = counts.doubles_differ;
  if (counts.wrong > 0) failures["wrong-answer"] = counts.wrong;
  return failures;
}

// In a million runs.
Json RatesToJson(const Counts& counts) {
  Json rates = Json::object();
  for (const auto& [name, count] : FailuresOf(counts)) {
    const double scale = 1e6 / static_cast<double>(counts.runs);
    const Interval rate = RateInterval(count, counts.runs);
    rates[name] = {{"per_million", scale * static_cast<double>(count)},
                   {"interval", IntervalToJson(Interval{1e6 * rate.low, 1e6 * rate.high})}};
  }
  return rates;
}

// What is told of a store.
struct Summed {
  const Store& store;
  Campaign campaign;
  StoreTotals totals;
  UnitElites yield;  // of a search with an objective, what its units cost; no elites
  const Counts& counts() const { return totals.counts; }
};
using S = Summed;

Summed SummedOf(const Store& store, const std::string& file) {
  Summed summed = {store, CampaignOf(store.identity(), file), TotalsOf(store), {}};
  for (const auto& [unit, text] : store.Elites()) {
    const UnitElites elites = ElitesFromText(text, fmt::format("elites of unit {}", unit));
    summed.yield.evaluations += elites.evaluations;
    summed.yield.confirmations += elites.confirmations;
    summed.yield.denied += elites.denied;
  }
  return summed;
}

Json RemarksToJson(const S& s) {
  Json remarks = RemarksOf(s.store.identity());
  return remarks.empty() ? Json() : remarks;
}

// Members of both searches.
constexpr ToldOf<S> kSeed = {"seed", "integer", "", [](const S& s) -> Json { return s.campaign.seed; }};
constexpr ToldOf<S> kUnits = {"units", "integer", "", [](const S& s) -> Json { return s.totals.units; }};
constexpr ToldOf<S> kFamilies = {"families", "{tried: integer, of: integer, not_reached: [text]}",
                                 "generators at numbers of contacts",
                                 [](const S& s) -> Json { return FamiliesToJson(s.store); }};
constexpr ToldOf<S> kFinished = {"finished", "integer", "",
                                 [](const S& s) -> Json { return s.totals.finished; }};
constexpr ToldOf<S> kPending = {"pending", "integer", "", [](const S& s) -> Json { return s.totals.pending; }};
constexpr ToldOf<S> kBuilds = {"builds", "[text]", "that worked on it",
                               [](const S& s) -> Json { return s.totals.work.builds; }};
constexpr ToldOf<S> kMachines = {
    "machines", "[text]", "that worked on it: processor, cores, memory, system; empty if none was recorded",
    [](const S& s) -> Json { return s.totals.work.machines; }};
constexpr ToldOf<S> kTimes = {"processor_seconds", "times", "",
                              [](const S& s) { return TimeToJson(s.totals.work.time); }};
constexpr ToldOf<S> kRemarks = {"remarks?", "{*: any}",
                                "fields of the campaign that say nothing of what is done", RemarksToJson};

// ---- Of a search with an objective: its best, and no rates, since nothing was drawn at random ------

std::string ValueText(const Objective& objective, const Worth& worth) {
  if (!worth.value && !objective.of_loops) return "no value";
  if (!worth.value) return fmt::format("no loop, the nearest at distance {:.3g}", -worth.nearness);
  return fmt::format("{:.6g}{}{}", objective.sign * *worth.value, objective.unit.empty() ? "" : " ",
                     objective.unit);
}

Json BestToJson(const S& s) {
  const Objective& objective = *FindObjective(s.campaign.objective);
  Json best = Json::array();
  for (const Elite& elite : BestOf(s.store, 1)) {
    Json row = {{"candidate", ToJson(elite.candidate)}};
    const auto value = ValueOf(elite, s.campaign);
    row["value"] = value ? Json(*value) : Json();
    if (!elite.worth.value && objective.of_loops) row["distance"] = -elite.worth.nearness;
    best.push_back(std::move(row));
  }
  return best;
}

constexpr auto kOptimizedMembers = std::to_array<ToldOf<S>>({
    kSeed,
    {"objective", "text", "", [](const S& s) -> Json { return s.campaign.objective; }},
    {"optimizer", "text", "", [](const S& s) -> Json { return s.campaign.optimizer; }},
    kUnits,
    kFamilies,
    {"candidates", "integer", "", [](const S& s) -> Json { return s.yield.evaluations; }},
    {"confirmations", "integer", "candidates whose value was confirmed exactly",
     [](const S& s) -> Json { return s.yield.confirmations; }},
    {"denied", "integer", "candidates whose value was not", [](const S& s) -> Json { return s.yield.denied; }},
    {"best", "[{candidate: object, value: rounded | null, distance?: rounded}]", "", BestToJson},
    kFinished,
    kPending,
    kBuilds,
    kMachines,
    kTimes,
    {"groups?", "[{signature: text, kind: text, count: integer, facts: object}]",
     "findings of a solver under test, the smallest first",
     [](const S& s) { return s.campaign.solver.name.empty() ? Json() : GroupsToJson(s.store); }},
    kRemarks,
});

// ---- Of a search at random -------------------------------------------------------------------------

Json GraveToJson(const S& s) {
  Json grave = Json::array();
  for (const Finding& finding : s.totals.grave)
    grave.push_back({{"signature", finding.signature}, {"kind", finding.kind}});
  return grave;
}

Json SimplestToJson(const S& s) {
  Json simplest = Json::array();
  for (const Finding& finding : s.totals.simplest)
    simplest.push_back(
        {{"signature", finding.signature}, {"facts", ParseJson(finding.facts, finding.signature)}});
  return simplest;
}

constexpr auto kSummaryMembers = std::to_array<ToldOf<S>>({
    kSeed,
    {"algorithm", "integer", "the version of what searches compute",
     [](const S& s) -> Json { return s.store.identity().algorithm; }},
    kBuilds,
    kMachines,
    kTimes,
    kUnits,
    {"problems", "integer", "", [](const S& s) -> Json { return s.totals.problems; }},
    kFamilies,
    {"runs", "integer", "problems, each under every policy",
     [](const S& s) -> Json { return s.counts().runs; }},
    {"failures", "counters",
     "runs that fail in exact arithmetic, by outcome; doubles-differ: doubles end otherwise than exact "
     "arithmetic; wrong-answer: doubles call solved what is not",
     [](const S& s) -> Json { return FailuresOf(s.counts()); }},
    {"groups", "counters", "how many different findings of each kind",
     [](const S& s) -> Json { return s.totals.groups; }},
    {"rates", "{*: {per_million: number, interval: interval}}", "",
     [](const S& s) { return RatesToJson(s.counts()); }},
    {"rates_are_lower_bounds", "truth",
     "whether not every run was exact, so that some loops may have been taken for solutions",
     [](const S& s) -> Json { return s.counts().audited + s.counts().suspicious < s.counts().runs; }},
    kFinished,
    kPending,
    {"finished_loops", "integer", "loops that are minimized, with their outcomes over the policy grid",
     [](const S& s) -> Json { return s.totals.finished_loops; }},
    {"whole_grid", "integer", "findings that loop under every policy of the planar grid",
     [](const S& s) -> Json { return s.totals.whole_grid; }},
    {"suspicions", "integer", "", [](const S& s) -> Json { return s.counts().suspicious; }},
    {"confirmed", "integer", "", [](const S& s) -> Json { return s.counts().confirmed; }},
    {"audited", "integer", "", [](const S& s) -> Json { return s.counts().audited; }},
    {"misjudged", "integer", "", [](const S& s) -> Json { return s.counts().misjudged; }},
    {"misjudged_share", "interval", "",
     [](const S& s) { return IntervalToJson(ShareInterval(s.counts().misjudged, s.counts().audited)); }},
    {"wrong", "integer", "wrong answers of doubles", [](const S& s) -> Json { return s.counts().wrong; }},
    {"existence_checked", "integer", "", [](const S& s) -> Json { return s.totals.existence.problems; }},
    {"existence_solved", "integer", "", [](const S& s) -> Json { return s.totals.existence.solved; }},
    {"compared", "integer", "", [](const S& s) -> Json { return s.totals.agreement.compared; }},
    {"enumerated", "integer", "", [](const S& s) -> Json { return s.totals.agreement.enumerated; }},
    {"disagreements_of_methods", "integer", "", [](const S& s) -> Json { return s.totals.disagreements; }},
    {"safety_decided", "integer", "", [](const S& s) -> Json { return s.totals.agreement.safety_decided; }},
    {"safe", "integer", "", [](const S& s) -> Json { return s.totals.agreement.safe; }},
    {"safe_gave_up", "integer", "", [](const S& s) -> Json { return s.totals.agreement.safe_gave_up; }},
    {"loops", "integer", "", [](const S& s) -> Json { return s.totals.loops.loops; }},
    {"loops_without_zero_steps", "integer", "",
     [](const S& s) -> Json { return s.totals.loops.without_zero_steps; }},
    {"loops_of_zero_steps_alone", "integer", "",
     [](const S& s) -> Json { return s.totals.loops.of_zero_steps_alone; }},
    {"grave", "[{signature: text, kind: text}]", "findings that cannot be, if what is proved is right",
     GraveToJson},
    {"minimized", "[{signature: text, facts: facts}]", "", SimplestToJson},
    kRemarks,
});

}  // namespace

std::vector<BestLine> BestLines(const Store& store) {
  const Campaign campaign = CampaignOf(store.identity(), "summary");
  if (campaign.objective.empty()) return {};
  std::vector<BestLine> lines;
  for (const Elite& elite : BestOf(store, 1)) {
    const Candidate& best = elite.candidate;
    lines.push_back({.generator = std::string(Row(best.generator).name),
                     .mu = ToString(Rational(best.mu.numerator) / Rational(best.mu.denominator)),
                     .value = ValueText(*FindObjective(campaign.objective), elite.worth),
                     .contacts = best.contacts});
  }
  return lines;
}

std::optional<double> ValueOf(const Elite& elite, const Campaign& campaign) {
  if (!elite.worth.value) return std::nullopt;
  return FindObjective(campaign.objective)->sign * *elite.worth.value;
}

ProblemFile BestFile(const Elite& elite, const Campaign& campaign) {
  ProblemFile file = FileOf(elite.candidate, "best-" + campaign.objective);
  file.origin.Add({{"objective", campaign.objective}});
  return file;
}

SharedJson SummaryToJson(const Store& store) {
  const Campaign campaign = CampaignOf(store.identity(), "summary");
  Json summary;
  if (!campaign.objective.empty()) {
    WriteTold<S>(kOptimizedMembers, SummedOf(store, "summary"), summary);
  } else if (!campaign.solver.name.empty()) {
    summary = SolverToJson(store);
  } else {
    WriteTold<S>(kSummaryMembers, SummedOf(store, "summary"), summary);
  }
  if (!IsUtf8(summary)) {
    throw InputError(
        "summary: found a signature or another text of the store that is no UTF-8, which JSON asks for");
  }
  return summary;
}

std::string ShapeOfSummary() { return ShapeOf<S>(kSummaryMembers); }
std::string ShapeOfOptimized() { return ShapeOf<S>(kOptimizedMembers); }
std::string ShapeOfTimes() {
  std::string members;
  ForEachPart(ProcessorTime{}, [&members](const char* name, const char* meaning, std::int64_t) {
    members += fmt::format("{}: number,  // {}\n", name, meaning);
  });
  return "{" + members + "}";
}

std::string OptimizedText(const Store& store, const std::string& file) {
  const Summed summed = SummedOf(store, file);
  const Campaign& campaign = summed.campaign;
  const Objective& objective = *FindObjective(campaign.objective);
  const UnitElites& yield = summed.yield;
  std::string text = fmt::format(
      "{}: {} in {}, seed {}\n  objective {}, {}: {}\n"
      "  optimizer {}: {}, which denied {} of doubles\n",
      file, Counted(yield.evaluations, "candidate"), Counted(summed.totals.units, "unit"), campaign.seed,
      objective.name, objective.sign > 0 ? "to be high" : "to be low", objective.help, campaign.optimizer,
      Counted(yield.confirmations, "exact run"), Counted(yield.denied, "value"));
  for (const auto& [name, value] : PlainValues(RemarksOf(store.identity())))
    text += fmt::format("  {}: {}\n", name, value);
  for (const BestLine& best : BestLines(store))
    text += fmt::format("  {:18} {}, mu = {}: {}\n", best.generator, Counted(best.contacts, "contact"), best.mu,
                        best.value);
  const StoreTotals& kept = summed.totals;
  const bool tests = !campaign.solver.name.empty();
  text += fmt::format("  {} of {} kept, {} of them {} and minimized\n", tests ? "failures" : "loops",
                      Counted(kept.finished + kept.pending, "group"), kept.finished,
                      tests ? "seen again" : "certified");
  if (tests) text += GroupsText(store);
  if (kept.pending > 0)
    text += fmt::format("  what is to go is finished by: {}\n",
                        tests ? FinishTestedCommand(file) : FinishCommand(file));
  if (const std::string time = TimeText(kept.work.time); !time.empty()) text += fmt::format("  {}\n", time);
  text += fmt::format(
      "The best as a problem file: {1} problem {0} --best -o best.json; all: {1} report {0} -o report. More "
      "--minutes or --problems go on from here.\n",
      file, ProgramName());
  return text;
}

}  // namespace stiction
