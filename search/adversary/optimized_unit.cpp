// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/optimized_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "certify/exact/exact.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "search/adversary/parents.h"
#include "search/units/regenerate.h"
#include "search/units/signature.h"

namespace stiction {
namespace {

constexpr std::size_t kElitesOfUnit = 8;
constexpr std::size_t kParents = 16;
constexpr std::size_t kSmallerParents = 2;  // of each size

// The best first, each problem once, at most so many.
void KeepBest(std::vector<Elite>& elites, std::size_t most) {
  std::ranges::stable_sort(elites, IsBetter);
  std::vector<Elite> kept;
  for (Elite& elite : elites) {
    const auto same = [&elite](const Elite& other) { return other.candidate == elite.candidate; };
    if (kept.size() < most && std::none_of(kept.begin(), kept.end(), same)) kept.push_back(std::move(elite));
  }
  elites = std::move(kept);
}

// What an optimizer is given: what was found and what was asked for, of its size, then what is smaller, made as
// large.
std::vector<Candidate> StartOf(const Optimization& o, const std::vector<Candidate>& found,
                               const std::vector<Candidate>& asked) {
  std::vector<Candidate> start, smaller;
  for (const auto* candidates : {&found, &asked}) {
    for (const Candidate& candidate : *candidates) {
      auto& list = candidate.contacts == o.like.contacts ? start : smaller;
      const bool known = std::find(list.begin(), list.end(), candidate) != list.end();
      if (!known && candidate.generator == o.like.generator) list.push_back(candidate);
    }
  }
  for (Candidate& sum : Enlarged(smaller, o.like, o.seed)) start.push_back(std::move(sum));
  return start;
}

}  // namespace

std::string ToText(const UnitElites& unit) {
  std::vector<SharedJson> elites;
  for (const Elite& elite : unit.elites) {
    SharedJson json = {{"candidate", ToJson(elite.candidate)}, {"nearness", elite.worth.nearness}};
    if (elite.worth.value) json.Add({{"value", *elite.worth.value}});
    elites.push_back(std::move(json));
  }
  return JsonText(SharedJson{{"elites", std::move(elites)},
                             {"evaluations", unit.evaluations},
                             {"confirmations", unit.confirmations},
                             {"denied", unit.denied}});
}

UnitElites ElitesFromText(const std::string& text, const std::string& source) {
  const JsonPlace root(text, source);
  root.RequireObject();
  root.AllowKeys({"elites", "evaluations", "confirmations", "denied"});
  const auto count = [&root](const char* key) {
    return root.Required(key, "a count").Integer(0, std::int64_t{1} << 53, "a count");
  };
  UnitElites unit{{}, count("evaluations"), count("confirmations"), count("denied")};
  const JsonPlace list = root.Required("elites", "a list");
  for (std::size_t i = 0; i < list.Size("a list"); ++i) {
    const JsonPlace place = list[i];
    place.RequireObject();
    place.AllowKeys({"candidate", "nearness", "value"});
    Elite elite;
    elite.candidate = CandidateFromJson(place.Required("candidate", "a candidate"));
    elite.worth.nearness = place.Required("nearness", "a number").Number("a number");
    if (const auto value = place.Optional("value")) elite.worth.value = value->Number("a number");
    unit.elites.push_back(std::move(elite));
  }
  return unit;
}

void Heritage::Add(std::int64_t unit, const UnitElites& elites) {
  if (shard_.Owns(unit)) units_[unit] = elites.elites;
}

std::vector<Candidate> Heritage::ParentsOf(std::int64_t unit) const {
  const Task task = TaskOf(schedule_, unit);
  std::map<int, std::vector<Elite>, std::greater<>> best;  // by contacts
  for (const auto& [earlier, elites] : units_) {
    if (EpochOf(earlier, shard_) >= EpochOf(unit, shard_)) break;
    const Task other = TaskOf(schedule_, earlier);
    const bool grows = other.contacts < task.contacts && HasDirectSums(task.generator);
    if (other.generator != task.generator || !(grows || other.contacts == task.contacts)) continue;
    best[other.contacts].insert(best[other.contacts].end(), elites.begin(), elites.end());
  }
  std::vector<Candidate> parents;
  for (auto& [contacts, elites] : best) {
    KeepBest(elites, contacts == task.contacts ? kParents : kSmallerParents);
    for (Elite& elite : elites) parents.push_back(std::move(elite.candidate));
  }
  return parents;
}

UnitResult RunOptimizedUnit(const Campaign& campaign, std::int64_t unit, const std::vector<Candidate>& parents,
                            const std::function<bool()>& cancelled, const TrySolver& tries) {
  const Task task = TaskOf(Schedule(campaign), unit);
  Optimization optimization;
  optimization.objective = FindObjective(campaign.objective);
  optimization.like = {task.generator, task.contacts, campaign.palette.front(), campaign.gravity_only, {}};
  optimization.palette = campaign.palette;
  optimization.seed = ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), 0);
  optimization.parents = StartOf(optimization, parents, campaign.parents);
  optimization.evaluations = UnitProblems(campaign, task, unit);
  optimization.policy = campaign.policies.front();
  optimization.limits = campaign.limits;
  optimization.cancelled = cancelled;
  optimization.tries = tries;
  Optimized optimized = FindOptimizer(campaign.optimizer)->run(optimization);
  if (cancelled()) return {};

  UnitResult result;
  result.problems = optimized.evaluations;
  UnitElites elites{{optimized.elites.begin(), optimized.elites.end()},
                    optimized.evaluations,
                    optimized.confirmations,
                    optimized.denied};
  KeepBest(elites.elites, kElitesOfUnit);
  result.elites = ToText(elites);
  if (tries) return result;  // of a solver under test, which may be in space, no run of the published algorithm
  // The best loops stand for their signatures.
  std::ranges::stable_sort(optimized.loops, IsBetter);
  std::int64_t index = 0;
  for (const Assessed& assessed : optimized.loops) {
    const ExactProblem problem = ExactOf(assessed.candidate);
    const ExactRun run = RunExact(problem, {.policy = campaign.policies.front(), .limits = campaign.limits});
    std::string signature = Signature(problem, run);
    if (!(run.policy == Policy{})) signature += "@" + PolicyName(run.policy);
    const bool first = ++result.record.signatures[signature] == 1;
    const bool room = static_cast<std::int64_t>(result.candidates.size()) < campaign.representatives_per_unit;
    if (first && room) {
      Finding& finding = result.candidates.emplace_back(FindingAt(campaign, task, unit, index));
      finding.signature = std::move(signature);
      finding.kind = finding.inexact_outcome = finding.exact_outcome = Name(run.verdict.outcome);
      const std::string name = fmt::format("{}-{}-{}", finding.generator, unit, index);
      finding.problem = JsonText(ToJson(FileOf(assessed.candidate, name)));
    }
    ++index;  // its place among the loops of its unit
  }
  return result;
}

std::vector<Elite> BestOf(const Store& store, std::size_t most) {
  std::map<std::pair<GeneratorId, int>, std::vector<Elite>> by_task;
  for (const auto& [unit, text] : store.Elites()) {
    for (Elite& elite : ElitesFromText(text, fmt::format("elites of unit {}", unit)).elites)
      by_task[{elite.candidate.generator, elite.candidate.contacts}].push_back(std::move(elite));
  }
  std::vector<Elite> best;
  for (auto& [task, elites] : by_task) {
    KeepBest(elites, most);
    best.insert(best.end(), elites.begin(), elites.end());
  }
  std::ranges::stable_sort(best, IsBetter);
  return best;
}

}  // namespace stiction
