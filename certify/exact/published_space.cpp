// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/published_space.h"

#include <algorithm>
#include <array>
#include <utility>

#include "certify/exact/enclosed_remainder.h"
#include "certify/exact/interval.h"
#include "certify/exact/loops_in_space.h"
#include "solver/published/published_space.ipp"
#include "solver/solve.ipp"

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

Answer<Interval> RunOverIntervals(const ContactProblem<Interval>& problem, const Request& request) {
  PublishedInSpace<Interval> algorithm(request);
  Verdict verdict;
  try {
    verdict = algorithm.Run(problem);
  } catch (const UnsureComparison&) {
    verdict = algorithm.verdict();
    verdict.outcome = Outcome::kUndecided;
    verdict.reason = kUnsureSign;
  }
  auto answer = AnswerOf<Interval>(verdict);
  answer.counters = algorithm.counters();
  answer.f = algorithm.f();
  answer.a = algorithm.a();
  if (answer.outcome == Outcome::kRay) answer.ray = algorithm.ray();
  return answer;
}

}  // namespace

template <>
std::span<const Method<Interval>> Methods<Interval>() {
  static const std::array rows = {BaraffRow<Interval>({&RunOverIntervals}, {})};
  return rows;
}

InexactAnswer RunIntervalsInSpace(const ExactProblem& problem, const Request& request) {
  const EnclosedRemainder<Interval> remainder(problem, Around);
  const Method<Interval>& method = Methods<Interval>().front();
  InexactAnswer answer;
  answer.method = method.name;
  answer.arithmetic = Arithmetic::kInterval;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  if (remainder.end() != ReductionEnd::kReduced) {
    answer.outcome = Outcome::kSingular;
    answer.reason = Reason(remainder.end());
    answer.counters = PublishedInSpace<Interval>().counters();
    SetEnd(std::vector<Enclosure>(problem.rows()), Enclosures(problem.b.unaryExpr(&Around)), answer);
    return answer;
  }
  const Answer<Interval> end = method.space.run(remainder.problem(), request);
  answer.outcome = end.outcome;
  answer.reason = end.reason;
  answer.start = end.start;
  answer.period = end.period;
  answer.counters = end.counters;
  SetEnd(Enclosures(remainder.Forces(end.f)), Enclosures(remainder.Accelerations(end.f, end.a)), answer);
  if (end.outcome == Outcome::kUndecided && !request.limits.Stopped()) {
    if (const auto loop = ProveLoopInSpace(remainder.exact(), request.policy, request.limits)) {
      answer.outcome = Outcome::kCycle;
      answer.reason = loop->IsBox() ? kStaysInBox : "";
      answer.start = loop->start;
      answer.period = loop->period;
    }
  }
  if (end.outcome == Outcome::kRay) answer.ray = MiddleOf(Enclosures(remainder.Direction(end.ray)));
  return answer;
}

}  // namespace stiction
