// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/published_space.h"

#include <algorithm>
#include <utility>

#include "certify/exact/enclosed_remainder.h"
#include "certify/exact/interval.h"
#include "solver/published/published_space.ipp"

namespace stiction {
namespace {

Eigen::VectorXd MiddleOf(const std::vector<Enclosure>& values) {
  Eigen::VectorXd middles(values.size());
  std::transform(values.begin(), values.end(), middles.begin(),
                 [](const Enclosure& x) { return x.low + (x.high - x.low) / 2; });
  return middles;
}

void SetEnd(std::vector<Enclosure> f, std::vector<Enclosure> a, InexactAnswer& answer) {
  answer.f = MiddleOf(f);
  answer.a = MiddleOf(a);
  answer.f_enclosed = std::move(f);
  answer.a_enclosed = std::move(a);
}

}  // namespace

InexactAnswer RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  const EnclosedRemainder<Interval> remainder(problem, Around);
  PublishedInSpace<Interval> algorithm(options);
  PublishedSpaceVerdict verdict = {Outcome::kSingular, Reason(remainder.end())};
  const bool runs = remainder.end() == ReductionEnd::kReduced;
  try {
    if (runs) verdict = algorithm.Run(remainder.problem());
  } catch (const UnsureComparison&) {
    verdict = algorithm.verdict();
    verdict.outcome = Outcome::kUndecided;
    verdict.reason = kUnsureSign;
  }
  auto answer = AnswerOf<double>(verdict);
  answer.method = "baraff";
  answer.arithmetic = Arithmetic::kInterval;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  if (!runs) {
    SetEnd(std::vector<Enclosure>(problem.rows()), Enclosures(problem.b.unaryExpr(&Around)), answer);
    return answer;
  }
  SetEnd(Enclosures(remainder.Forces(algorithm.f())),
         Enclosures(remainder.Accelerations(algorithm.f(), algorithm.a())), answer);
  if (answer.outcome == Outcome::kRay) answer.ray = MiddleOf(Enclosures(remainder.Direction(algorithm.ray())));
  return answer;
}

}  // namespace stiction
