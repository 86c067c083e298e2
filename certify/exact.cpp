// SPDX-License-Identifier: Apache-2.0
#include "certify/exact.h"

#include <CGAL/Exact_rational.h>

#include <optional>
#include <type_traits>

#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published.ipp"

namespace stiction {

static_assert(std::is_same_v<CGAL::Exact_rational, Rational>, "CGAL computes with the same exact rational");

template class Reduction<Rational>;
template class PublishedAlgorithm<Rational>;
template class CompleteDriving<Rational>;
template class LemkeAlgorithm<Rational>;

namespace {

// What a run takes place on: the problem, or what bilateral and sliding contacts leave of it.
class Remainder {
 public:
  explicit Remainder(const ExactProblem& whole) : whole_(whole) {
    if (Reduction<Rational>::Concerns(whole)) reduction_.emplace(whole);
  }

  const ExactProblem& problem() const { return reduction_ ? reduction_->problem() : whole_; }

  // A verdict without a run, if there is nothing to run on.
  std::optional<Verdict> Obstacle() const {
    if (!reduction_ || reduction_->end() == ReductionEnd::kReduced) return std::nullopt;
    Verdict verdict;
    verdict.outcome = Outcome::kSingular;
    verdict.reason = Reason(reduction_->end());
    return verdict;
  }

  // A run on problem() in the terms of the whole problem.
  ExactRun Restored(ExactRun run) const {
    if (!reduction_) return run;
    for (Pivot<Rational>& pivot : run.trace.pivots) {
      pivot.driven = reduction_->row_of()[pivot.driven];
      pivot.limiting = reduction_->row_of()[pivot.limiting];
      pivot.df = reduction_->Direction(pivot.df);
      pivot.da = whole_.A * pivot.df;
      pivot.f = reduction_->Forces(pivot.f);
      pivot.a = whole_.A * pivot.f + whole_.b;
      pivot.sets = reduction_->Spread(pivot.sets, IndexSet::kClamped, IndexSet::kNone);
    }
    ExactState& state = run.state;
    state.sets = reduction_->Spread(state.sets, IndexSet::kClamped, IndexSet::kNone);
    state.last_left = reduction_->Spread(state.last_left, IndexSet::kNone, IndexSet::kNone);
    state.f = reduction_->Forces(state.f);
    if (state.last_driven_contact >= 0)
      state.last_driven_contact = reduction_->contact_of()[state.last_driven_contact];
    run.initial_f = reduction_->Forces(run.initial_f);
    run.a = whole_.A * state.f + whole_.b;
    if (run.verdict.outcome == Outcome::kRay) run.ray = reduction_->Direction(run.ray);
    return run;
  }

 private:
  const ExactProblem& whole_;
  std::optional<Reduction<Rational>> reduction_;
};

// A run of no steps.
ExactRun Unstarted(const ExactProblem& problem, const Verdict& verdict) {
  ExactRun run;
  run.verdict = verdict;
  run.initial_f = run.state.f = ExactProblem::Vector::Zero(problem.rows());
  run.state.sets.assign(problem.rows(), IndexSet::kNone);
  run.state.last_left = run.state.sets;
  run.a = problem.b;
  return run;
}

ExactRun RunRemaining(const ExactProblem& problem, const PublishedOptions& options) {
  PublishedAlgorithm<Rational> algorithm(options);
  ExactRun run;
  run.verdict = algorithm.Run(problem, &run.trace);
  run.initial_f = ExactProblem::Vector::Zero(problem.rows());
  run.state = {algorithm.state().sets, algorithm.state().f, algorithm.last_driven_contact(),
               algorithm.last_left(), algorithm.last_step_zero()};
  run.a = algorithm.state().a;
  if (run.verdict.outcome == Outcome::kRay) run.ray = algorithm.direction().df();
  return run;
}

}  // namespace

ExactRun RunExact(const ExactProblem& problem, const PublishedOptions& options) {
  const Remainder remainder(problem);
  const auto obstacle = remainder.Obstacle();
  ExactRun run =
      obstacle ? Unstarted(problem, *obstacle) : remainder.Restored(RunRemaining(remainder.problem(), options));
  run.policy = options.policy;
  return run;
}

namespace {

// Runs policies one by one and remembers which others each run speaks for.
class GridRunner {
 public:
  GridRunner(const ExactProblem& problem, const Limits& limits)
      : remainder_(problem), obstacle_(remainder_.Obstacle()) {
    algorithm_.options().limits = limits;
    trace_.keep_pivots = false;
  }

  const PolicyClass& Run(const Policy& policy) {
    for (PolicyClass& known : classes_) {
      if (!AgreeOn(known.consulted, known.policies.front(), policy)) continue;
      known.policies.push_back(policy);
      return known;
    }
    algorithm_.options().policy = policy;
    const Verdict verdict = obstacle_ ? *obstacle_ : algorithm_.Run(remainder_.problem(), &trace_);
    return classes_.emplace_back(PolicyClass{{policy}, trace_.consulted, verdict});
  }

  std::vector<PolicyClass> Take() { return std::move(classes_); }

 private:
  const Remainder remainder_;
  const std::optional<Verdict> obstacle_;
  PublishedAlgorithm<Rational> algorithm_;
  Trace<Rational> trace_;
  std::vector<PolicyClass> classes_;
};

}  // namespace

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
