// SPDX-License-Identifier: Apache-2.0
// Trial: one problem and what the methods make of it, each run once, when it is first asked for.

#pragma once

#include <optional>

#include "corpus/exact_problem.h"
#include "solver/complete/complete.h"
#include "solver/published/published.h"

namespace stiction {

inline double AsDouble(double x) { return x; }
inline double AsDouble(const Rational& x) { return ToDouble(x); }

template <class Scalar>
class Trial {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  Trial(Problem problem, const Policy& policy, const Limits& limits)
      : problem_(std::move(problem)), policy_(policy), limits_(limits) {}

  const Problem& problem() const { return problem_; }
  const Policy& policy() const { return policy_; }
  const Limits& limits() const { return limits_; }
  int contacts() const { return static_cast<int>(problem_.contacts.size()); }

  // Of the published algorithm under the policy: how it ended, and where.
  const Verdict& Published() {
    if (!published_) Run(nullptr);
    return *published_;
  }
  const Vector& PublishedForces() {
    Published();
    return f_;
  }
  // All steps of that run. Most objectives ask for none of them.
  const std::vector<Pivot<Scalar>>& Steps() {
    if (!trace_) Run(&trace_.emplace());
    return trace_->pivots;
  }
  bool Loops() { return IsLoop(Published().outcome); }
  bool Solves() { return Published().outcome == Outcome::kSolved; }

  const RunEnd<>& Complete() {
    if (!complete_) complete_ = CompleteDriving<Scalar>({.limits = limits_}).Run(problem_);
    return *complete_;
  }

 private:
  void Run(Trace<Scalar>* trace) {
    PublishedAlgorithm<Scalar> algorithm({.policy = policy_, .limits = limits_});
    published_ = algorithm.Run(problem_, trace);
    f_ = algorithm.state().f;
  }

  Problem problem_;
  Policy policy_;
  Limits limits_;
  std::optional<Verdict> published_;
  Vector f_;
  std::optional<Trace<Scalar>> trace_;
  std::optional<RunEnd<>> complete_;
};

using InexactTrial = Trial<double>;
using ExactTrial = Trial<Rational>;

// How far a run is from a loop: the least distance of two of its states between drives. States with equal sets
// are as far apart as their forces, relative to the largest, at most 1; others 1 and one more for each set
// that differs. 0 at a loop; empty for a run of fewer than two drives.
std::optional<double> DistanceToLoop(InexactTrial& trial);
std::optional<double> DistanceToLoop(ExactTrial& trial);

// The smallest pivot: of all steps the least acceleration of the driven variable per unit of its force,
// relative to its diagonal entry. Empty for a run without a step.
std::optional<double> SmallestPivot(InexactTrial& trial);
std::optional<double> SmallestPivot(ExactTrial& trial);

// How robust a loop is: the least relative gap of any decision of its first period. A step ends where the first
// of the quantities fN, aN, aF, mu fN - fF, mu fN + fF of all contacts reaches zero; its gap is how much later
// the next would, relative to the later. A scan between drives decides by the signs of the same quantities; the
// gap is their size, relative to the largest force or acceleration. A step of length zero at which a variable
// wants back at once is no decision; any other, and two contacts at once, are ties: a margin of zero. A lower
// bound: quantities that no condition reads are among them. Empty unless the run loops.
std::optional<double> Margin(ExactTrial& trial);

// The longest chain of friction forces that a run gave up, each while the one before it rested, given up, and
// was not driven. What a force that rests is depends on those that rested when it was given up and on nothing
// else of the past: where the matrices are regular, the sets alone
// decide all other forces. So there a run that never ends and whose chains have a bound comes to finitely many
// states, and loops.
std::int64_t LongestMemory(InexactTrial& trial);
std::int64_t LongestMemory(ExactTrial& trial);

// Bits of the longest number in the forces and accelerations of a run.
std::int64_t LongestNumber(ExactTrial& trial);

// lambda_max / lambda_min of A, over doubles; empty unless A is definite by a clear margin.
std::optional<double> Condition(const ContactProblem<double>& problem);

}  // namespace stiction
