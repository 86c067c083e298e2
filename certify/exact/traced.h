// SPDX-License-Identifier: Apache-2.0
// A run of a method of the table, with its trace where that is asked for.

#ifndef STICTION_CERTIFY_EXACT_TRACED_H_
#define STICTION_CERTIFY_EXACT_TRACED_H_

#include <utility>

#include "certify/exact/solve.h"

namespace stiction {

template <class Scalar>
TracedAnswer<Scalar> Traced(Answer<Scalar> answer, Trace<Scalar> trace) {
  TracedAnswer<Scalar> traced;
  static_cast<Answer<Scalar>&>(traced) = std::move(answer);
  traced.pivots = std::move(trace.pivots);
  return traced;
}

template <class Scalar>
TracedAnswer<Scalar> SolveTraced(const ContactProblem<Scalar>& problem, const SolveRequest& request) {
  Trace<Scalar> trace;
  const bool keep = request.trace == KeepTrace::kYes;
  Answer<Scalar> answer = Solve(problem, request.method, request.options, keep ? &trace : nullptr);
  return Traced(std::move(answer), std::move(trace));
}

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_TRACED_H_
