// SPDX-License-Identifier: Apache-2.0
// One problem as every arithmetic gets it, and what an answer is worth over rationals.

#ifndef STICTION_BENCH_RUNGS_H_
#define STICTION_BENCH_RUNGS_H_

#include <array>
#include <optional>

#include "corpus/exact_problem.h"
#include "solver/problem/answer.h"
#include "solver/problem/errors.h"

namespace stiction {

// Rounded to float, rounded to double for wider numbers, as it is for filtered and exact.
class RungProblem {
 public:
  explicit RungProblem(ExactProblem problem);

  const ExactProblem& exact() const { return exact_; }
  // Empty where a number is not one of the scalar's.
  const std::optional<ContactProblem<float>>& in_float() const { return float_; }
  const std::optional<ContactProblem<double>>& in_double() const { return double_; }
  // What an arithmetic was given, over rationals.
  const ExactProblem& Given(Arithmetic arithmetic) const;
  // How the published algorithm ends on it over rationals; found once, when it is asked for.
  Outcome PublishedEnd(Arithmetic arithmetic) const;

 private:
  enum Data { kFloat, kDouble, kAsItIs };
  static Data DataOf(Arithmetic arithmetic);

  ExactProblem exact_;
  std::optional<ContactProblem<float>> float_;
  std::optional<ContactProblem<double>> double_;
  std::array<ExactProblem, 2> given_;
  mutable std::array<std::optional<Outcome>, 3> ends_;
};

// The largest error (solver/problem/errors.h) by a gate's theta, over rationals, rounded.
double ExactResidual(const ExactProblem& problem, const ExactProblem::Vector& f,
                     const Gate& gate = GateOf<double>());

}  // namespace stiction

#endif  // STICTION_BENCH_RUNGS_H_
