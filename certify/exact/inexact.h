// SPDX-License-Identifier: Apache-2.0
// Answers over floating-point numbers, told in doubles; and the published algorithm in space, run again where
// it does not end solved. For units that define a table of methods, or choose from it.

#pragma once

#include <fmt/format.h>

#include "certify/exact/solve.h"
#include "corpus/rounded.h"
#include "solver/published/published_space.h"

namespace stiction {

template <class Vector>
Eigen::VectorXd InDoubles(const Vector& values) {
  return values.template cast<double>();
}

template <class Scalar>
Pivot<double> InDoubles(const Pivot<Scalar>& pivot) {
  return Converted<double>(pivot, [](const Scalar& x) { return static_cast<double>(x); });
}

// Forces of wide numbers are rounded to what is told of them before they are judged.
template <class Scalar>
InexactAnswer InDoubles(const Answer<Scalar>& answer, const ContactProblem<Scalar>& problem, double bound) {
  InexactAnswer result;
  result.outcome = answer.outcome;
  result.reason = answer.reason;
  result.start = answer.start;
  result.period = answer.period;
  result.method = answer.method;
  result.arithmetic = answer.arithmetic;
  result.law = answer.law;
  result.f = InDoubles(answer.f);
  result.a = InDoubles(answer.a);
  result.ray = InDoubles(answer.ray);
  result.first_f = InDoubles(answer.first_f);
  result.errors = answer.errors;
  result.word = answer.word;
  result.counters = answer.counters;
  for (const Pivot<Scalar>& pivot : answer.pivots) result.pivots.push_back(InDoubles(pivot));
  if (sizeof(Scalar) > sizeof(double)) {
    const auto doubles = Converted<double>(problem, [](const Scalar& x) { return static_cast<double>(x); });
    JudgeAnswer(doubles, bound, result);
  }
  return result;
}

// InputError where the published algorithm in space has no such reading.
inline void RequireReading(int dimension, const Request& request) {
  const bool concerned = dimension == 3 && request.method == "baraff";
  if (!concerned || PublishedReadsInSpace(request.policy)) return;
  throw InputError(
      fmt::format("--policy {}: in space expected file=no, apex=kept and slip=literal or slip=redirect, or "
                  "slip=polygon alone; no other reading of these is built",
                  PolicyName(request.policy)));
}

}  // namespace stiction
