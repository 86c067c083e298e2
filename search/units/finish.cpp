// SPDX-License-Identifier: Apache-2.0
#include "search/units/finish.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/agreement.h"
#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/published_space.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "search/campaign.h"
#include "search/units/minimize.h"
#include "search/units/signature.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// Empty where no checker would do the work that it asks for.
std::string Checked(const Json& certificate, const std::string& source) {
  const CheckReport report = CheckCertificate(certificate, source);
  if (report.is_too_dear) return "";
  STICTION_CHECK(report.accepted,
                 fmt::format("{}: our own certificate is rejected: {}", source, report.reason));
  return JsonText(certificate);
}

// The grid of a larger problem as it was found takes seconds; that of its minimized form is run all the same.
constexpr int kMostContactsOfGrid = 4;

// `safe` is null where it is not decided.
Json FactsOf(const ExactProblem& problem, const ExactRun& run, const Json& grid, const ExactMethods& methods) {
  const auto safe = methods.is_safe(problem);
  return {{"contacts", problem.contacts.size()}, {"outcome", Name(run.verdict.outcome)},
          {"start", run.verdict.start},          {"period", run.verdict.period},
          {"steps", run.trace.pivots.size()},    {"grid", grid},
          {"safe", safe ? Json(*safe) : Json()}};
}

// In space: of a run over intervals; no grid.
Json FactsInSpace(const ExactProblem& problem, const InexactAnswer& answer, const std::string& existence) {
  return {{"contacts", problem.contacts.size()},
          {"outcome", Name(answer.outcome)},
          {"start", answer.start},
          {"period", answer.period},
          {"steps", answer.counters[Counter::kSteps]},
          {"grid", Json::object()},
          {"existence", {{"claim", existence.empty() ? Json() : Json("solution-exists")}}}};
}

// A minimized problem as a file: what it shows, where it comes from, what every policy makes of it.
ProblemFile Describe(const ExactProblem& problem, const Finding& finding, const Policy& policy, bool whole_grid,
                     bool has_scene) {
  ProblemFile file;
  file.name = finding.signature;
  file.problem = problem;
  file.origin = {{"parent", fmt::format("{}-{}-{}", finding.generator, finding.unit, finding.index)},
                 {"minimized", true}};
  if (has_scene) file.origin.Add({{"scene", kSceneOfParent}});
  file.expect[whole_grid ? "*" : PolicyName(policy)] = finding.exact_outcome;
  return file;
}

// The solution that the published algorithm misses, or a proof that there is none.
struct Decided {
  std::string certificate;  // JSON text; empty if undecided
  Json facts;
};

Decided DecideExistenceOf(const ExactProblem& problem, const std::string& source, const Limits& limits,
                          const std::function<bool()>& cancelled) {
  const ClaimAnswer existence = DecideExistence(problem, {.law = FrictionLaw::kBaraff, .limits = limits},
                                                [&cancelled](const Enumeration&) { return !cancelled(); });
  const bool decided = bool(existence.certificate);
  Decided result;
  if (decided) result.certificate = Checked(existence.certificate, source);
  const ExactAnswer complete = Solve(problem, {.method = "complete", .limits = limits});
  result.facts = {{"claim", decided ? existence.certificate->at("claim") : Json()},
                  {"method", existence.method},
                  {"pieces", complete.counters[Counter::kPieces]},
                  {"folds", complete.counters[Counter::kFolds]},
                  {"descents", complete.counters[Counter::kDescents]}};
  return result;
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

namespace {

// What a finding is finished from, and by.
struct Unfinished {
  ExactProblem problem;
  ExactRun run;
  Json grid;
  bool has_scene = false;
  const ExactMethods& methods;
};

// All methods on the problem as found. A disagreement that only shows here makes the finding one, under its
// signature.
void CompareMethods(Finding& finding, Json& facts, const Unfinished& found, const Limits& limits) {
  Answers answers{
      {found.methods.complete(found.problem, limits),
       AnswerBy("baraff", found.run.verdict.outcome, found.run.f), found.methods.lemke(found.problem, limits)},
      {}};
  if (finding.contacts <= kMostContactsEnumerated) answers.modes = found.methods.modes(found.problem);
  const auto disagreement = FindDisagreement(found.problem, answers);
  if (!disagreement || finding.kind == kDisagreementOfMethods) return;
  finding.kind = kDisagreementOfMethods;
  facts["disagreement"] = disagreement->reason;
  facts["answers"] = AnswersToJson(answers);
}

// Fills in what concerns the problem as found.
void CertifyFound(Finding& finding, Json& facts, const Unfinished& found, const Limits& limits,
                  const std::function<bool()>& cancelled) {
  const Outcome outcome = found.run.verdict.outcome;
  if (outcome == Outcome::kCycle) {
    finding.certificate =
        Checked(CycleCertificate(found.problem, {found.run.policy}, limits), finding.signature);
  } else if (outcome == Outcome::kSolved && !FindViolation(found.problem, found.run.f)) {
    finding.certificate = Checked(SolutionCertificate(found.problem, found.run.f), finding.signature);
  }
  Decided existence = DecideExistenceOf(found.problem, finding.signature, limits, cancelled);
  finding.existence = std::move(existence.certificate);
  facts["found"] = FactsOf(found.problem, found.run, found.grid, found.methods);
  facts["found"]["existence"] = std::move(existence.facts);
}

// Fills in the minimized form, unless cancelled.
void MinimizeFound(Finding& finding, Json& facts, const Unfinished& found, const Limits& limits,
                   const std::function<bool()>& cancelled) {
  const Outcome outcome = found.run.verdict.outcome;
  const Policy& policy = found.run.policy;
  const Minimized minimized = Minimize(
      found.problem, WhatToKeep(found.problem, found.run, IsWhole(found.grid, outcome), limits, cancelled));
  if (minimized.cancelled || cancelled()) return;
  const ExactProblem& small = minimized.problem;
  const Json grid = GridCounts(small, limits, cancelled);
  if (cancelled()) return;
  const bool whole = IsWhole(grid, outcome);
  finding.minimized = JsonText(ToJson(Describe(small, finding, policy, whole, found.has_scene)));
  if (outcome == Outcome::kCycle) {
    const std::vector<Policy> certified = whole ? PlanarGrid() : std::vector<Policy>{policy};
    finding.minimized_certificate = Checked(CycleCertificate(small, certified, limits), finding.signature);
  }
  Decided existence = DecideExistenceOf(small, finding.signature, limits, cancelled);
  finding.minimized_existence = std::move(existence.certificate);
  facts["minimized"] =
      FactsOf(small, RunExact(small, {.policy = policy, .limits = limits}), grid, found.methods);
  facts["minimized"]["existence"] = std::move(existence.facts);
  if (outcome == Outcome::kCycle && facts["minimized"]["safe"] == true) finding.kind = kSafeCycle;
}

std::string ExistenceInSpace(const ExactProblem& problem, const std::string& source, const Limits& limits) {
  const ClaimAnswer existence = DecideExistence(problem, {.law = FrictionLaw::kBaraff, .limits = limits});
  return existence.certificate ? Checked(existence.certificate, source) : std::string();
}

// Empty where it has none.
std::string LoopInSpaceOf(const ExactProblem& problem, const Request& request, const std::string& source) {
  if (!PublishedHandlesInSpace(problem)) return {};
  const Json certificate = CycleCertificate(problem, {request.policy}, request.limits);
  return certificate.is_null() ? std::string() : Checked(certificate, source);
}

// A finding of space: what intervals prove, minimized as far as they prove it still; the solution that is
// missed.
std::optional<Finding> FinishInSpace(const Finding& finding, const ExactProblem& problem, const Limits& limits,
                                     const std::function<bool()>& cancelled, const ExactMethods& methods) {
  Finding finished = finding;
  finished.done = true;
  const Request request{.policy = ParsePolicy(finding.policy), .limits = limits};
  const InexactAnswer answer = methods.published_in_space(problem, request);
  Json facts = finding.facts.empty() ? Json::object() : ParseJson(finding.facts, finding.signature);
  finished.existence = ExistenceInSpace(problem, finding.signature, limits);
  const bool loops = answer.outcome == Outcome::kCycle;
  if (loops) finished.certificate = LoopInSpaceOf(problem, request, finding.signature);
  facts["found"] = FactsInSpace(problem, answer, finished.existence);
  const bool minimize =
      !answer.Solved() && answer.outcome != Outcome::kUndecided && finding.kind != kDisagreementOfMethods;
  if (minimize) {
    MinimizeOptions what;
    what.keep = answer.outcome;
    what.policies = {request.policy};
    what.period = answer.period;
    what.limits = limits;
    what.cancelled = cancelled;
    const ExactProblem small = Minimize(problem, what).problem;
    finished.minimized = JsonText(ToJson(Describe(small, finding, request.policy, false, false)));
    if (loops) finished.minimized_certificate = LoopInSpaceOf(small, request, finding.signature);
    if (finished.minimized_certificate.empty())
      finished.certificate.clear();  // it would speak of another problem
    finished.minimized_existence = ExistenceInSpace(small, finding.signature, limits);
    facts["minimized"] =
        FactsInSpace(small, methods.published_in_space(small, request), finished.minimized_existence);
  }
  finished.facts = JsonText(facts);
  return cancelled() ? std::nullopt : std::optional(finished);
}

}  // namespace

std::optional<Finding> FinishFinding(const Finding& finding, const Limits& limits,
                                     const std::function<bool()>& cancelled, const ExactMethods& methods) {
  const ProblemFile file = ParseProblem(finding.problem, finding.signature);
  if (file.problem.dimension() == 3) return FinishInSpace(finding, file.problem, limits, cancelled, methods);
  Unfinished found{file.problem,
                   methods.published(file.problem, {.policy = ParsePolicy(finding.policy), .limits = limits}),
                   Json::object(), bool(file.scene), methods};
  Finding finished = finding;
  finished.done = true;
  if (finding.contacts <= kMostContactsOfGrid) found.grid = GridCounts(file.problem, limits, cancelled);
  Json facts = finding.facts.empty() ? Json::object() : ParseJson(finding.facts, finding.signature);
  CertifyFound(finished, facts, found, limits, cancelled);
  if (!cancelled()) CompareMethods(finished, facts, found, limits);
  if (!cancelled()) {
    const Feasibility answer = methods.ipopt(found.problem);
    facts["ipopt"] = {{"outcome", answer.outcome}, {"starts", answer.starts}};
  }
  // What methods disagree about is kept as it is.
  const bool minimize =
      found.run.verdict.outcome != Outcome::kSolved && finished.kind != kDisagreementOfMethods;
  if (minimize && !cancelled()) MinimizeFound(finished, facts, found, limits, cancelled);
  if (cancelled()) return std::nullopt;
  finished.facts = JsonText(facts);
  return finished;
}

}  // namespace stiction
