// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/exact.h"

#include <utility>

#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/problem/remainder.h"
#include "solver/published/published.ipp"

namespace stiction {

template class Reduction<Rational>;
template class PublishedAlgorithm<Rational>;
template class CompleteDriving<Rational>;
template class LemkeAlgorithm<Rational>;

namespace {

Verdict VerdictOn(const Remainder<Rational>& remainder) { return {Outcome::kSingular, remainder.Obstacle()}; }

// A run on the remainder in the terms of the whole problem.
ExactRun Restored(const Remainder<Rational>& remainder, ExactRun run) {
  for (Pivot<Rational>& pivot : run.trace.pivots) pivot = remainder.Restored(std::move(pivot));
  run.sets = remainder.Sets(std::move(run.sets), IndexSet::kClamped);
  run.last_left = remainder.Sets(std::move(run.last_left), IndexSet::kNone);
  run.f = remainder.Forces(run.f);
  run.last_driven_contact = remainder.ContactOf(run.last_driven_contact);
  run.initial_f = remainder.Forces(run.initial_f);
  if (&remainder.problem() != &remainder.whole()) run.a = remainder.Accelerations(run.f);
  if (run.verdict.outcome == Outcome::kRay) run.ray = remainder.Direction(run.ray);
  return run;
}

// A run of no steps.
ExactRun Unstarted(const ExactProblem& problem, const Verdict& verdict) {
  ExactRun run;
  run.verdict = verdict;
  run.initial_f = run.f = ExactProblem::Vector::Zero(problem.rows());
  run.sets.assign(problem.rows(), IndexSet::kNone);
  run.last_left = run.sets;
  run.a = problem.b;
  return run;
}

ExactRun RunRemaining(const ExactProblem& problem, const Request& request) {
  constexpr std::size_t kPivotsExpected = 128;  // each that has to move is copied
  PublishedAlgorithm<Rational> algorithm(request);
  ExactRun run;
  run.trace.pivots.reserve(kPivotsExpected);
  run.verdict = algorithm.Run(problem, &run.trace);
  run.initial_f = ExactProblem::Vector::Zero(problem.rows());
  run.sets = algorithm.state().sets;
  run.f = algorithm.state().f;
  run.a = algorithm.state().a;
  run.last_driven_contact = algorithm.last_driven_contact();
  run.last_left = algorithm.last_left();
  run.last_step_zero = algorithm.last_step_zero();
  if (run.verdict.outcome == Outcome::kRay) run.ray = algorithm.direction().df();
  return run;
}

// Runs policies one by one and remembers which others each run speaks for.
class GridRunner {
 public:
  GridRunner(const ExactProblem& problem, const Limits& limits) : remainder_(problem) {
    algorithm_.request().limits = limits;
    trace_.keep_pivots = false;
  }

  const PolicyClass& Run(const Policy& policy) {
    for (PolicyClass& known : classes_) {
      if (!AgreeOn(known.consulted, known.policies.front(), policy)) continue;
      known.policies.push_back(policy);
      return known;
    }
    algorithm_.request().policy = policy;
    const Verdict verdict =
        remainder_.Obstacle().empty() ? algorithm_.Run(remainder_.problem(), &trace_) : VerdictOn(remainder_);
    return classes_.emplace_back(PolicyClass{{policy}, trace_.consulted, verdict});
  }

  std::vector<PolicyClass> Take() { return std::move(classes_); }

 private:
  const Remainder<Rational> remainder_;
  PublishedAlgorithm<Rational> algorithm_;
  Trace<Rational> trace_;
  std::vector<PolicyClass> classes_;
};

}  // namespace

ExactRun RunExact(const ExactProblem& problem, const Request& request) {
  const Remainder<Rational> remainder(problem);
  ExactRun run = remainder.Obstacle().empty() ? Restored(remainder, RunRemaining(remainder.problem(), request))
                                              : Unstarted(problem, VerdictOn(remainder));
  run.policy = request.policy;
  return run;
}

std::vector<PolicyClass> RunPolicies(const ExactProblem& problem, const std::vector<Policy>& policies,
                                     const Limits& limits, const std::function<bool()>& cancelled) {
  GridRunner runner(problem, limits);
  for (const Policy& policy : policies) {
    if (cancelled()) break;
    runner.Run(policy);
  }
  return runner.Take();
}

bool AllEndIn(Outcome outcome, const ExactProblem& problem, const std::vector<Policy>& policies,
              const Limits& limits) {
  GridRunner runner(problem, limits);
  for (const Policy& policy : policies) {
    if (runner.Run(policy).verdict.outcome != outcome) return false;
  }
  return true;
}

std::string VariableName(const RowLayout<Eigen::Dynamic>& layout, int row) {
  return (layout.IsNormal(row) ? "N" : "F") + std::to_string(layout.ContactOf(row) + 1);
}

std::vector<std::string> VariableNames(const ExactProblem& problem) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  std::vector<std::string> names;
  for (int row = 0; row < problem.rows(); ++row) names.push_back(VariableName(layout, row));
  return names;
}

}  // namespace stiction
