// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/published_space.h"

#include "certify/exact/enclosed_remainder.h"
#include "certify/exact/interval.h"
#include "solver/published/published_space.ipp"

namespace stiction {
namespace {

PublishedSpaceVerdict Unstarted(ReductionEnd end) {
  PublishedSpaceVerdict verdict;
  verdict.outcome = Outcome::kSingular;
  verdict.reason = Reason(end);
  return verdict;
}

}  // namespace

IntervalSpaceRun RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  IntervalSpaceRun run;
  const EnclosedRemainder<Interval> remainder(problem, Around);
  if (remainder.end() != ReductionEnd::kReduced) {
    run.verdict = Unstarted(remainder.end());
    run.f.assign(problem.rows(), {});
    run.a = Enclosures(problem.b.unaryExpr(&Around));
    return run;
  }
  PublishedInSpace<Interval> algorithm(options);
  try {
    run.verdict = algorithm.Run(remainder.problem());
  } catch (const UnsureComparison&) {
    run.verdict = algorithm.verdict();
    run.verdict.outcome = Outcome::kUndecided;
    run.verdict.reason = kUnsureSign;
  }
  run.f = Enclosures(remainder.Forces(algorithm.f()));
  run.a = Enclosures(remainder.Accelerations(algorithm.f(), algorithm.a()));
  if (run.verdict.outcome == Outcome::kRay) run.ray = Enclosures(remainder.Direction(algorithm.ray()));
  return run;
}

}  // namespace stiction
