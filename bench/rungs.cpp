// SPDX-License-Identifier: Apache-2.0
#include "bench/rungs.h"

#include "certify/exact/exact.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/problem/errors.h"
#include "solver/published/published.h"

namespace stiction {
namespace {

template <class Scalar>
std::optional<ContactProblem<Scalar>> TryRounded(const ExactProblem& problem) {
  try {
    return Rounded<Scalar>(problem);
  } catch (const RangeError&) {
    return std::nullopt;
  }
}

}  // namespace

RungProblem::RungProblem(ExactProblem problem)
    : exact_(std::move(problem)), float_(TryRounded<float>(exact_)), double_(TryRounded<double>(exact_)) {
  if (float_) given_[kFloat] = Unrounded(*float_);
  if (double_) given_[kDouble] = Unrounded(*double_);
}

RungProblem::Data RungProblem::DataOf(Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::kFloat) return kFloat;
  return arithmetic == Arithmetic::kFiltered || arithmetic == Arithmetic::kExact ? kAsItIs : kDouble;
}

const ExactProblem& RungProblem::Given(Arithmetic arithmetic) const {
  const Data data = DataOf(arithmetic);
  return data == kAsItIs ? exact_ : given_[data];
}

Outcome RungProblem::PublishedEnd(Arithmetic arithmetic) const {
  auto& end = ends_[DataOf(arithmetic)];
  if (!end) end = PublishedAlgorithm<Rational>().Run(Given(arithmetic)).outcome;
  return *end;
}

double ExactResidual(const ExactProblem& problem, const ExactProblem::Vector& f, const Gate& gate) {
  ErrorMeter<Rational> meter;
  const auto a = Accelerations(problem, f);
  return ToDouble(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a, meter, Rational(gate.theta())).Largest());
}

}  // namespace stiction
