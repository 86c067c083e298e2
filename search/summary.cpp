// SPDX-License-Identifier: Apache-2.0
#include "search/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "corpus/json_text.h"
#include "corpus/kinds.h"
#include "search/adversary/optimized_unit.h"

namespace stiction {
namespace {

constexpr int kShown = 10;

// A line of the summary: a signature up to the first "-<number>c". That is a kind, sometimes with its outcomes:
// "disagreement-ray-solved".
std::string LabelOf(const std::string& signature) {
  for (std::size_t dash = signature.find('-'); dash != signature.npos; dash = signature.find('-', dash + 1)) {
    if (dash + 1 < signature.size() && std::isdigit(static_cast<unsigned char>(signature[dash + 1])) != 0) {
      return signature.substr(0, dash);
    }
  }
  return signature;
}

// The gravest kinds first.
struct ByGravity {
  bool operator()(const std::string& left, const std::string& right) const {
    return std::tuple(Gravity(KindOf(left + "-")), left) < std::tuple(Gravity(KindOf(right + "-")), right);
  }
};

// What the facts of a finding say of its minimized problem: with a grid, contacts, start and period.
Json MinimizedFacts(const Finding& finding) {
  const std::string source = "facts of " + finding.signature;
  const Json facts = ParseJson(finding.facts, source);
  const JsonPlace minimized =
      JsonPlace(facts, source, "").Required("minimized", "those of the minimized problem");
  minimized.Required("grid", "outcomes over the policy grid").RequireObject();
  for (const char* key : {"contacts", "start", "period"}) minimized.Required(key, "a number");
  return minimized.json();
}

struct Digest {
  std::int64_t units = 0, problems = 0, runs = 0, suspicions = 0, confirmed = 0, audited = 0, misjudged = 0,
               wrong = 0;
  std::map<std::string, std::int64_t, ByGravity> findings;  // by label, all counted
  std::map<std::string, std::int64_t, ByGravity> groups;    // by label
  ExistenceTally existence;
  AgreementTally agreement;
  LoopTally loops;
  std::vector<Finding> grave;
  std::int64_t finished = 0, pending = 0, whole_grid = 0;
  std::vector<Finding> simplest;
  Work work;
};

Digest DigestOf(const Store& store) {
  Digest digest;
  const Record total = store.Total();
  digest.units = store.Units().Count();
  digest.work = store.TotalWork();
  std::map<std::pair<std::string, int>, std::int64_t> problems;  // the same problems run under each policy
  for (const auto& [key, tally] : total.tallies) {
    digest.runs += tally.problems;
    problems[{key.generator, key.contacts}] = tally.problems;
    for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
      for (int exact = 0; exact < kOutcomeCount; ++exact) {
        digest.suspicions += tally.verdicts[inexact][exact];
        const bool undecided = exact == static_cast<int>(Outcome::kUndecided);
        if (exact == inexact && !undecided) digest.confirmed += tally.verdicts[inexact][exact];
      }
    }
    digest.audited += tally.audited;
    digest.misjudged += tally.misjudged;
    digest.wrong += tally.wrong;
  }
  for (const auto& [key, count] : problems) digest.problems += count;
  for (const auto& [contacts, tally] : total.existence) {
    digest.existence.problems += tally.problems;
    digest.existence.solved += tally.solved;
    digest.existence.with_folds += tally.with_folds;
    digest.existence.with_descents += tally.with_descents;
  }
  for (const auto& [contacts, tally] : total.agreement) {
    digest.agreement.compared += tally.compared;
    digest.agreement.enumerated += tally.enumerated;
    digest.agreement.disagreements += tally.disagreements;
    digest.agreement.safety_decided += tally.safety_decided;
    digest.agreement.safe += tally.safe;
    digest.agreement.safe_gave_up += tally.safe_gave_up;
  }
  for (const auto& [contacts, tally] : total.loops) {
    digest.loops.loops += tally.loops;
    digest.loops.without_zero_steps += tally.without_zero_steps;
    digest.loops.of_zero_steps_alone += tally.of_zero_steps_alone;
  }
  for (const auto& [signature, count] : total.signatures) {
    digest.findings[LabelOf(signature)] += count;
    ++digest.groups[LabelOf(signature)];
  }
  for (Finding& finding : store.Findings()) {
    ++(finding.done ? digest.finished : digest.pending);
    if (IsGrave(finding.kind)) digest.grave.push_back(finding);
    if (!finding.done || finding.minimized.empty()) continue;
    digest.whole_grid += MinimizedFacts(finding).at("grid").size() == 1 && IsLoopKind(finding.kind);
    digest.simplest.push_back(std::move(finding));
  }
  const auto rank = [](const Finding& f) { return std::tuple(Gravity(f.kind), f.minimized.size()); };
  std::stable_sort(digest.simplest.begin(), digest.simplest.end(),
                   [&rank](const Finding& left, const Finding& right) { return rank(left) < rank(right); });
  return digest;
}

std::string FindingLine(const Finding& finding) {
  const Json facts = MinimizedFacts(finding);
  std::string grid;
  for (const auto& [outcome, count] : facts.at("grid").items()) {
    grid += fmt::format("{}{} {}", grid.empty() ? "" : ", ", outcome, count.dump());
  }
  return fmt::format("  {:40} {} contacts, start {}, period {}; {}\n", finding.signature,
                     facts.at("contacts").dump(), facts.at("start").dump(), facts.at("period").dump(),
                     grid.empty() ? "in space, over intervals" : "policies: " + grid);
}

// What the frequencies are worth: how much was audited, and what came of it.
std::string AuditText(const Digest& d) {
  if (d.runs == 0) return "";
  const std::string misjudged =
      d.audited == 0 ? "" : fmt::format(", of these {} misjudged", ShareText(d.misjudged, d.audited));
  if (d.audited + d.suspicions == d.runs)
    return fmt::format("  in brackets: exact intervals at 95 %. Every run was repeated exactly{}\n", misjudged);
  return fmt::format(
      "  in brackets: exact intervals at 95 %. Rates are lower bounds: loops that doubles take for solutions "
      "are\n"
      "  not counted. Of {} runs without a suspicion {} were audited{}\n",
      Grouped(d.runs - d.suspicions), Grouped(d.audited), misjudged);
}

// What other exact methods made of the problems; of those of space existence alone is counted.
std::string ExistenceText(const Digest& digest) {
  std::string text = fmt::format(
      "  existence: {} of {} problems given to complete driving were solved, verified exactly ({} with "
      "folds)\n",
      Grouped(digest.existence.solved), Grouped(digest.existence.problems),
      Grouped(digest.existence.with_folds));
  text += fmt::format(
      "  agreement: {} disagreements of complete driving, Lemke's method and the published algorithm on {} "
      "problems, "
      "all modes tried of {}\n",
      Grouped(digest.agreement.disagreements), Grouped(digest.agreement.compared),
      Grouped(digest.agreement.enumerated));
  text += fmt::format("  safe: {} of {} audited problems; {} gave up something under apex=suspended\n",
                      Grouped(digest.agreement.safe), Grouped(digest.agreement.safety_decided),
                      Grouped(digest.agreement.safe_gave_up));
  return text;
}

Json TimeToJson(const ProcessorTime& time) {
  Json json = Json::object();
  ForEachPart(time, [&json](const char* name, const char*, std::int64_t value) {
    json[name] = static_cast<double>(value) * 1e-6;
  });
  return json;
}

// "processor time: 41.2 s: generation 10 %, ..."; what took nothing is left out.
std::string TimeText(const ProcessorTime& time) {
  const auto total = static_cast<double>(time.Total());
  if (total == 0) return "";
  std::string parts;
  ForEachPart(time, [&](const char* name, const char*, std::int64_t value) {
    const double share = 100 * static_cast<double>(value) / total;
    if (value > 0)
      parts += fmt::format("{}{} {:.{}f} %", parts.empty() ? "" : ", ", name, share, share < 1 ? 1 : 0);
  });
  return fmt::format("  processor time: {:.4g} s: {}\n", total * 1e-6, parts);
}

Json IntervalToJson(const Interval& interval) { return {{"low", interval.low}, {"high", interval.high}}; }

// Per label: findings in a million runs.
Json RatesToJson(const Digest& d) {
  Json rates = Json::object();
  if (d.runs == 0) return rates;
  for (const auto& [label, count] : d.findings) {
    const double scale = 1e6 / static_cast<double>(d.runs);
    const Interval expected = CountInterval(count);
    rates[label] = {{"per_million", scale * static_cast<double>(count)},
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

std::string HowToFinish(const std::string& file) {
  return fmt::format("  what is to go is finished by: ./run search --store {} --finish\n", file);
}

std::string ValueText(const Objective& objective, const Worth& worth) {
  if (!worth.value && !objective.of_loops) return "no value";
  if (!worth.value) return fmt::format("no loop, the nearest at distance {:.3g}", -worth.nearness);
  return fmt::format("{:.6g}{}{}", objective.sign * *worth.value, objective.unit.empty() ? "" : " ",
                     objective.unit);
}

std::string OptimizedText(const Store& store, const Campaign& campaign, const std::string& file) {
  const Objective& objective = *FindObjective(campaign.objective);
  const Yield yield = YieldOf(store);
  std::string text = fmt::format(
      "{}: {} candidates in {} units, seed {}\n  objective {}, {}: {}\n  optimizer {}: {} exact runs, which "
      "denied "
      "{} values of doubles\n",
      file, Grouped(yield.evaluations), Grouped(yield.units), campaign.seed, objective.name,
      objective.sign > 0 ? "to be high" : "to be low", objective.help, campaign.optimizer,
      Grouped(yield.confirmations), Grouped(yield.denied));
  for (const Elite& elite : BestOf(store, 1)) {
    text += fmt::format(
        "  {:18} {} contacts, mu = {}: {}\n", Row(elite.candidate.generator).name, elite.candidate.contacts,
        ToString(Rational(elite.candidate.mu.numerator) / Rational(elite.candidate.mu.denominator)),
        ValueText(objective, elite.worth));
  }
  const Kept kept = KeptOf(store);
  text += fmt::format("  loops of {} kinds kept, {} of them certified and minimized\n",
                      kept.finished + kept.pending, kept.finished);
  if (kept.pending > 0) text += HowToFinish(file);
  text += TimeText(store.TotalWork().time);
  text += fmt::format(
      "The best as a problem file: ./run problem {0} --best -o best.json; all: ./run report {0} -o report; the "
      "same "
      "search again goes on.\n",
      file);
  return text;
}

Json OptimizedToJson(const Store& store, const Campaign& campaign) {
  const Objective& objective = *FindObjective(campaign.objective);
  const Yield yield = YieldOf(store);
  const Kept kept = KeptOf(store);
  const Work work = store.TotalWork();
  Json best = Json::array();
  for (const Elite& elite : BestOf(store, 1)) {
    Json row = {{"candidate", ToJson(elite.candidate)}};
    row["value"] = elite.worth.value ? Json(objective.sign * *elite.worth.value) : Json();
    if (!elite.worth.value && objective.of_loops) row["distance"] = -elite.worth.nearness;
    best.push_back(std::move(row));
  }
  return {{"seed", campaign.seed},           {"objective", objective.name},
          {"optimizer", campaign.optimizer}, {"units", yield.units},
          {"candidates", yield.evaluations}, {"confirmations", yield.confirmations},
          {"denied", yield.denied},          {"best", best},
          {"finished", kept.finished},       {"pending", kept.pending},
          {"builds", work.builds},           {"processor_seconds", TimeToJson(work.time)}};
}

}  // namespace

Json SummaryToJson(const Store& store) {
  const Campaign campaign = CampaignOf(store.identity(), "summary");
  if (!campaign.objective.empty()) return OptimizedToJson(store, campaign);
  const Digest digest = DigestOf(store);
  Json simplest = Json::array();
  for (const Finding& finding : digest.simplest) {
    simplest.push_back(
        {{"signature", finding.signature}, {"facts", ParseJson(finding.facts, finding.signature)}});
  }
  Json grave = Json::array();
  for (const Finding& finding : digest.grave)
    grave.push_back({{"signature", finding.signature}, {"kind", finding.kind}});
  Json summary = {{"seed", store.identity().seed},
                  {"algorithm", store.identity().algorithm},
                  {"builds", digest.work.builds},
                  {"processor_seconds", TimeToJson(digest.work.time)},
                  {"units", digest.units},
                  {"problems", digest.problems},
                  {"runs", digest.runs},
                  {"findings", digest.findings},
                  {"groups", digest.groups},
                  {"rates", RatesToJson(digest)},
                  {"rates_are_lower_bounds", digest.audited + digest.suspicions < digest.runs},
                  {"finished", digest.finished},
                  {"pending", digest.pending},
                  {"whole_grid", digest.whole_grid},
                  {"suspicions", digest.suspicions},
                  {"confirmed", digest.confirmed},
                  {"audited", digest.audited},
                  {"misjudged", digest.misjudged},
                  {"misjudged_share", IntervalToJson(ShareInterval(digest.misjudged, digest.audited))},
                  {"wrong", digest.wrong},
                  {"existence_checked", digest.existence.problems},
                  {"existence_solved", digest.existence.solved},
                  {"compared", digest.agreement.compared},
                  {"enumerated", digest.agreement.enumerated},
                  {"disagreements_of_methods", digest.agreement.disagreements},
                  {"safety_decided", digest.agreement.safety_decided},
                  {"safe", digest.agreement.safe},
                  {"safe_gave_up", digest.agreement.safe_gave_up},
                  {"loops", digest.loops.loops},
                  {"loops_without_zero_steps", digest.loops.without_zero_steps},
                  {"loops_of_zero_steps_alone", digest.loops.of_zero_steps_alone},
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

std::string SummaryText(const Store& store, const std::string& file) {
  const Campaign campaign = CampaignOf(store.identity(), file);
  if (!campaign.objective.empty()) return OptimizedText(store, campaign, file);
  const Digest digest = DigestOf(store);
  std::string text = fmt::format("{}: {} problems in {} units, seed {}\n", file, Grouped(digest.problems),
                                 Grouped(digest.units), store.identity().seed);
  for (const Finding& finding : digest.grave)
    text += fmt::format("  GRAVE: {}: {}\n", finding.kind, finding.signature);
  for (const auto& [kind, count] : digest.findings) {
    text += fmt::format("  {:28} {:>12} in {} groups, {} in a million runs\n", kind, Grouped(count),
                        Grouped(digest.groups.at(kind)), RateText(count, digest.runs));
  }
  if (digest.findings.empty()) text += "  no findings\n";
  if (digest.loops.loops > 0)
    text += fmt::format("  of {} loops {} have no step of length zero in their period, {} nothing else\n",
                        Grouped(digest.loops.loops), Grouped(digest.loops.without_zero_steps),
                        Grouped(digest.loops.of_zero_steps_alone));
  text += fmt::format(
      "  doubles: {} of {} suspicions confirmed exactly; {} of {} audited runs misjudged; {} wrong answers\n",
      Grouped(digest.confirmed), Grouped(digest.suspicions), Grouped(digest.misjudged), Grouped(digest.audited),
      Grouped(digest.wrong));
  text += AuditText(digest);
  text += ExistenceText(digest);
  text += fmt::format("  representatives: {} finished, {} to go; {} loop under the whole grid of policies\n",
                      Grouped(digest.finished), Grouped(digest.pending), Grouped(digest.whole_grid));
  if (digest.pending > 0) text += HowToFinish(file);
  text += TimeText(digest.work.time);
  if (!digest.simplest.empty()) text += "Simplest, proved and minimized:\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(kShown, digest.simplest.size()); ++i) {
    text += FindingLine(digest.simplest[i]);
  }
  text += fmt::format("See them: ./run report {} -o report; the same search again goes on.\n", file);
  return text;
}

}  // namespace stiction
