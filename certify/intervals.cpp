// SPDX-License-Identifier: Apache-2.0
#include "certify/intervals.h"

#include <optional>

#include "certify/enclosed_remainder.h"
#include "certify/interval.h"
#include "solver/lemke/lemke.ipp"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

using IntervalVector = ContactProblem<Interval>::Vector;

// Where a method over intervals stands at its end.
struct End {
  Verdict verdict;
  std::optional<IntervalVector> f, a;
  IntervalVector ray;
};

// run(problem, trace) returns an End.
template <class Run>
IntervalRun RunOn(const ExactProblem& problem, KeepTrace keep, Run run) {
  const EnclosedRemainder<Interval> remainder(problem, Around);
  IntervalRun result;
  if (remainder.end() != ReductionEnd::kReduced) {
    result.verdict.outcome = Outcome::kSingular;
    result.verdict.reason = Reason(remainder.end());
    return result;
  }
  Trace<Interval> trace;
  const End end = run(remainder.problem(), keep == KeepTrace::kYes ? &trace : nullptr);
  result.verdict = end.verdict;
  if (end.f) {
    result.f = Enclosures(remainder.Forces(*end.f));
    result.a = Enclosures(remainder.Accelerations(*end.f, *end.a));
  }
  if (end.verdict.outcome == Outcome::kRay) result.ray = Enclosures(remainder.Direction(end.ray));
  for (const Pivot<Interval>& pivot : trace.pivots)
    result.pivots.push_back(Converted<double>(remainder.Restored(pivot), &Approximation<Interval>::Of));
  return result;
}

// The verdict of a run; undecided where a sign was unsure.
template <class Run>
Verdict Decided(Run run) {
  try {
    return run();
  } catch (const CGAL::Uncertain_conversion_exception&) {
    Verdict verdict;
    verdict.reason = kUnsureSign;
    return verdict;
  }
}

}  // namespace

IntervalRun RunPublishedOverIntervals(const ExactProblem& problem, const PublishedOptions& options,
                                      KeepTrace keep) {
  return RunOn(problem, keep, [&](const ContactProblem<Interval>& enclosed, Trace<Interval>* trace) {
    PublishedAlgorithm<Interval> algorithm(options);
    const Verdict verdict = Decided([&] { return algorithm.Run(enclosed, trace); });
    return End{verdict, algorithm.state().f, algorithm.state().a, algorithm.direction().df()};
  });
}

IntervalRun RunLemkeOverIntervals(const ExactProblem& problem, const Limits& limits, KeepTrace keep) {
  return RunOn(problem, keep, [&](const ContactProblem<Interval>& enclosed, Trace<Interval>* trace) {
    LemkeOptions options;
    options.limits = limits;
    LemkeAlgorithm<Interval> lemke(options);
    const Verdict verdict = Decided([&] { return lemke.Run(enclosed, trace); });
    if (verdict.outcome != Outcome::kSolved) return End{verdict, {}, {}, lemke.ray()};
    return End{verdict, lemke.f(), lemke.a(), {}};
  });
}

}  // namespace stiction
