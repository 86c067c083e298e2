// SPDX-License-Identifier: Apache-2.0
#include "search/summary.h"

#include <fmt/format.h>

#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/program_name.h"
#include "corpus/record/counts.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/store_totals.h"
#include "search/adversary/optimized_unit.h"

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
    const Interval expected = CountInterval(count);
    rates[name] = {{"per_million", scale * static_cast<double>(count)},
                   {"interval", IntervalToJson(Interval{scale * expected.low, scale * expected.high})}};
  }
  return rates;
}

// ---- Of a search with an objective: its best, and no rates, since nothing was drawn at random ------

struct Yield {
  std::int64_t units = 0, evaluations = 0, confirmations = 0, denied = 0;
};

Yield YieldOf(const Store& store) {
  Yield yield;
  for (const auto& [unit, text] : store.Elites()) {
    const UnitElites elites = ElitesFromText(text, fmt::format("elites of unit {}", unit));
    ++yield.units;
    yield.evaluations += elites.evaluations;
    yield.confirmations += elites.confirmations;
    yield.denied += elites.denied;
  }
  return yield;
}

// Representatives of loops.
struct Kept {
  std::int64_t finished = 0, pending = 0;
};

Kept KeptOf(const Store& store) {
  Kept kept;
  for (const Finding& finding : store.Findings()) ++(finding.done ? kept.finished : kept.pending);
  return kept;
}

std::string ValueText(const Objective& objective, const Worth& worth) {
  if (!worth.value && !objective.of_loops) return "no value";
  if (!worth.value) return fmt::format("no loop, the nearest at distance {:.3g}", -worth.nearness);
  return fmt::format("{:.6g}{}{}", objective.sign * *worth.value, objective.unit.empty() ? "" : " ",
                     objective.unit);
}

Json OptimizedToJson(const Store& store, const Campaign& campaign) {
  const Objective& objective = *FindObjective(campaign.objective);
  const Yield yield = YieldOf(store);
  const Kept kept = KeptOf(store);
  const Work work = store.TotalWork();
  Json best = Json::array();
  for (const Elite& elite : BestOf(store, 1)) {
    Json row = {{"candidate", ToJson(elite.candidate)}};
    const auto value = ValueOf(elite, campaign);
    row["value"] = value ? Json(*value) : Json();
    if (!elite.worth.value && objective.of_loops) row["distance"] = -elite.worth.nearness;
    best.push_back(std::move(row));
  }
  return {{"seed", campaign.seed},
          {"objective", objective.name},
          {"optimizer", campaign.optimizer},
          {"units", yield.units},
          {"candidates", yield.evaluations},
          {"confirmations", yield.confirmations},
          {"denied", yield.denied},
          {"best", best},
          {"finished", kept.finished},
          {"pending", kept.pending},
          {"builds", work.builds},
          {"machines", work.machines},
          {"processor_seconds", TimeToJson(work.time)}};
}

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
  (*file.origin)["objective"] = campaign.objective;
  return file;
}

Json SummaryToJson(const Store& store) {
  const Campaign campaign = CampaignOf(store.identity(), "summary");
  if (!campaign.objective.empty()) return OptimizedToJson(store, campaign);
  const StoreTotals totals = TotalsOf(store);
  const Counts& counts = totals.counts;
  Json simplest = Json::array();
  for (const Finding& finding : totals.simplest) {
    simplest.push_back(
        {{"signature", finding.signature}, {"facts", ParseJson(finding.facts, finding.signature)}});
  }
  Json grave = Json::array();
  for (const Finding& finding : totals.grave)
    grave.push_back({{"signature", finding.signature}, {"kind", finding.kind}});
  Json summary = {{"seed", store.identity().seed},
                  {"algorithm", store.identity().algorithm},
                  {"builds", totals.work.builds},
                  {"machines", totals.work.machines},
                  {"processor_seconds", TimeToJson(totals.work.time)},
                  {"units", totals.units},
                  {"problems", totals.problems},
                  {"runs", counts.runs},
                  {"failures", FailuresOf(counts)},
                  {"groups", totals.groups},
                  {"rates", RatesToJson(counts)},
                  {"rates_are_lower_bounds", counts.audited + counts.suspicious < counts.runs},
                  {"finished", totals.finished},
                  {"pending", totals.pending},
                  {"finished_loops", totals.finished_loops},
                  {"whole_grid", totals.whole_grid},
                  {"suspicions", counts.suspicious},
                  {"confirmed", counts.confirmed},
                  {"audited", counts.audited},
                  {"misjudged", counts.misjudged},
                  {"misjudged_share", IntervalToJson(ShareInterval(counts.misjudged, counts.audited))},
                  {"wrong", counts.wrong},
                  {"existence_checked", totals.existence.problems},
                  {"existence_solved", totals.existence.solved},
                  {"compared", totals.agreement.compared},
                  {"enumerated", totals.agreement.enumerated},
                  {"disagreements_of_methods", totals.agreement.disagreements},
                  {"safety_decided", totals.agreement.safety_decided},
                  {"safe", totals.agreement.safe},
                  {"safe_gave_up", totals.agreement.safe_gave_up},
                  {"loops", totals.loops.loops},
                  {"loops_without_zero_steps", totals.loops.without_zero_steps},
                  {"loops_of_zero_steps_alone", totals.loops.of_zero_steps_alone},
                  {"grave", grave},
                  {"minimized", simplest}};
  try {
    summary.dump();
  } catch (const Json::exception&) {
    throw InputError(
        "summary: found a signature or another text of the store that is no UTF-8, which JSON asks for");
  }
  return summary;
}

std::string OptimizedText(const Store& store, const std::string& file) {
  const Campaign campaign = CampaignOf(store.identity(), file);
  const Objective& objective = *FindObjective(campaign.objective);
  const Yield yield = YieldOf(store);
  std::string text = fmt::format(
      "{}: {} candidates in {} units, seed {}\n  objective {}, {}: {}\n  optimizer {}: {} exact runs, which "
      "denied "
      "{} values of doubles\n",
      file, Grouped(yield.evaluations), Grouped(yield.units), campaign.seed, objective.name,
      objective.sign > 0 ? "to be high" : "to be low", objective.help, campaign.optimizer,
      Grouped(yield.confirmations), Grouped(yield.denied));
  for (const BestLine& best : BestLines(store))
    text +=
        fmt::format("  {:18} {} contacts, mu = {}: {}\n", best.generator, best.contacts, best.mu, best.value);
  const Kept kept = KeptOf(store);
  text += fmt::format("  loops of {} groups kept, {} of them certified and minimized\n",
                      kept.finished + kept.pending, kept.finished);
  if (kept.pending > 0) text += fmt::format("  what is to go is finished by: {}\n", FinishCommand(file));
  if (const std::string time = TimeText(store.TotalWork().time); !time.empty())
    text += fmt::format("  {}\n", time);
  text += fmt::format(
      "The best as a problem file: {1} problem {0} --best -o best.json; all: {1} report {0} -o report; the "
      "same "
      "search again goes on.\n",
      file, ProgramName());
  return text;
}

}  // namespace stiction
