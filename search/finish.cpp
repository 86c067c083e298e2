// SPDX-License-Identifier: Apache-2.0
#include "search/finish.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/certificate.h"
#include "certify/existence.h"
#include "corpus/json_text.h"
#include "search/minimize.h"
#include "search/signature.h"
#include "solver/check.h"

namespace stiction {
namespace {

std::string Checked(const Json& certificate, const std::string& source) {
  const CheckReport report = CheckCertificate(certificate, source);
  STICTION_CHECK(report.accepted,
                 fmt::format("{}: our own certificate is rejected: {}", source, report.reason));
  return JsonText(certificate);
}

// The grid of a larger problem as it was found takes seconds; that of its minimized form is run all the same.
constexpr int kMostContactsOfGrid = 4;

bool IsLoop(Outcome outcome) { return outcome == Outcome::kCycle || outcome == Outcome::kStall; }

Json FactsOf(const ExactProblem& problem, const ExactRun& run, const Json& grid) {
  return {{"contacts", problem.contacts.size()}, {"outcome", Name(run.verdict.outcome)},
          {"start", run.verdict.start},          {"period", run.verdict.period},
          {"steps", run.trace.pivots.size()},    {"grid", grid}};
}

// A minimized problem as a file: what it shows, where it comes from, what every policy makes of it.
ProblemFile Describe(const ExactProblem& problem, const Finding& finding, const Policy& policy,
                     bool whole_grid) {
  ProblemFile file;
  file.name = finding.signature;
  file.problem = problem;
  file.origin = Json{{"parent", fmt::format("{}-{}-{}", finding.generator, finding.unit, finding.index)},
                     {"minimized", true}};
  file.expect[whole_grid ? "*" : PolicyName(policy)] = finding.exact_outcome;
  return file;
}

// The solution that the published algorithm misses.
Json ExistenceOf(const ExactProblem& problem, const Limits& limits) {
  const CompleteRun complete = RunComplete(problem, limits);
  Json json = {{"outcome", Name(complete.verdict.outcome)},
               {"pieces", complete.verdict.statistics.pieces},
               {"folds", complete.verdict.statistics.folds},
               {"descents", complete.verdict.statistics.descents}};
  if (complete.verdict.outcome == Outcome::kSolved) json["f"] = VectorToJson(complete.f);
  return json;
}

// Whether the whole grid ends in this outcome.
bool IsWhole(const Json& grid, Outcome outcome) {
  return grid.size() == 1 && grid.contains(std::string(Name(outcome)));
}

MinimizeOptions WhatToKeep(const ExactProblem& problem, const ExactRun& run, bool whole_grid,
                           const Limits& limits, const std::function<bool()>& cancelled) {
  MinimizeOptions options;
  options.keep = run.verdict.outcome;
  options.policies = {run.policy};
  if (whole_grid) {
    options.policies = PlanarGrid();
    std::iter_swap(options.policies.begin(),
                   std::find(options.policies.begin(), options.policies.end(), run.policy));
  }
  if (IsLoop(run.verdict.outcome)) options.signature = Signature(problem, run);
  options.limits = limits;
  options.cancelled = cancelled;
  return options;
}

}  // namespace

Json GridCounts(const ExactProblem& problem, const Limits& limits, const std::function<bool()>& cancelled) {
  std::array<std::int64_t, kOutcomeCount> counts = {};
  for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), limits, cancelled)) {
    counts[static_cast<int>(equal.verdict.outcome)] += static_cast<std::int64_t>(equal.policies.size());
  }
  Json json = Json::object();
  for (int i = 0; i < kOutcomeCount; ++i) {
    if (counts[i] > 0) json[std::string(kOutcomeNames[i])] = counts[i];
  }
  return json;
}

std::optional<Finding> FinishFinding(const Finding& finding, const Limits& limits,
                                     const std::function<bool()>& cancelled) {
  const ProblemFile file = ParseProblem(finding.problem, finding.signature);
  const Policy policy = ParsePolicy(finding.policy);
  const ExactRun run = RunExact(file.problem, {policy, {}, limits});
  const Outcome outcome = run.verdict.outcome;
  Finding finished = finding;
  finished.done = true;
  Json grid = Json::object();
  if (finding.contacts <= kMostContactsOfGrid) grid = GridCounts(file.problem, limits, cancelled);
  Json facts = {{"found", FactsOf(file.problem, run, grid)}, {"existence", ExistenceOf(file.problem, limits)}};
  if (outcome == Outcome::kSolved) {
    finished.certificate = Checked(SolutionCertificate(file.problem, run.state.f), finding.signature);
  } else {
    if (IsLoop(outcome)) {
      finished.certificate =
          Checked(LoopCertificate(file.problem, outcome, {policy}, limits), finding.signature);
    }
    const Minimized minimized =
        Minimize(file.problem, WhatToKeep(file.problem, run, IsWhole(grid, outcome), limits, cancelled));
    if (minimized.cancelled || cancelled()) return std::nullopt;
    const ExactProblem& small = minimized.problem;
    const Json small_grid = GridCounts(small, limits, cancelled);
    if (cancelled()) return std::nullopt;
    const bool whole = IsWhole(small_grid, outcome);
    finished.minimized = ToJson(Describe(small, finding, policy, whole)).dump();
    facts["minimized"] = FactsOf(small, RunExact(small, {policy, {}, limits}), small_grid);
    if (IsLoop(outcome)) {
      const std::vector<Policy> certified = whole ? PlanarGrid() : std::vector<Policy>{policy};
      finished.minimized_certificate =
          Checked(LoopCertificate(small, outcome, certified, limits), finding.signature);
    }
  }
  if (cancelled()) return std::nullopt;
  finished.facts = facts.dump();
  return finished;
}

}  // namespace stiction
