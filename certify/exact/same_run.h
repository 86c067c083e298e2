// SPDX-License-Identifier: Apache-2.0
// SameRun: whether a run over enclosures comes to the loop of a run over rationals by the same steps.
//
// Included by units that run the published algorithm over an enclosure, after its scalar.

#pragma once

#include <algorithm>

#include "certify/exact/exact.h"
#include "certify/exact/interval.h"
#include "solver/published/published.ipp"

namespace stiction {

template <class Scalar>
bool SameDecision(const Pivot<Scalar>& one, const Pivot<Rational>& other) {
  return one.drive == other.drive && one.driven == other.driven && one.goal == other.goal &&
         one.limiting == other.limiting && one.from == other.from && one.to == other.to &&
         one.sets == other.sets;
}

// False as well where a comparison cannot be decided. `rows`: of every problem of the box; or null.
template <class Scalar>
bool SameRun(const ContactProblem<Scalar>& box, const ExactRun& run, Request request,
             DependentRows* rows = nullptr) {
  request.limits.drives = run.verdict.start + run.verdict.period;
  PublishedAlgorithm<Scalar> algorithm(request);
  algorithm.KnowDependentRows(rows);
  Trace<Scalar> trace;
  try {
    const Verdict verdict = algorithm.Run(box, &trace);
    const auto& steps = run.trace.pivots;
    return verdict.outcome == Outcome::kCycle && verdict.start == run.verdict.start &&
           verdict.period == run.verdict.period &&
           std::equal(steps.begin(), steps.end(), trace.pivots.begin(), trace.pivots.end(),
                      [](const auto& exact, const auto& wide) { return SameDecision(wide, exact); });
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return false;
  }
}

}  // namespace stiction
