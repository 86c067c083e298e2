// SPDX-License-Identifier: Apache-2.0
#include "certify/robust.h"

#include <algorithm>

#include "certify/interval.h"
#include "solver/problem/check.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

using IntervalProblem = ContactProblem<Interval>;
using Steps = std::vector<Pivot<Rational>>;

constexpr int kLargestExponent = 40;

template <class Entries>
Rational LargestOf(const Entries& entries) {
  Rational largest = 0;
  for (const Rational& x : entries.reshaped()) largest = std::max<Rational>(largest, abs(x));
  return largest;
}

// Everything within `by` of x.
Interval Within(const Rational& x, const Rational& by) {
  return {Around(x - by).inf(), Around(x + by).sup()};
}

IntervalProblem BoxAbout(const ExactProblem& problem, const Rational& radius) {
  IntervalProblem box;
  box.dimension = problem.dimension;
  for (const auto& contact : problem.contacts) {
    Contact<Interval> wide;
    wide.kind = contact.kind;
    wide.mu = Within(contact.mu, radius * contact.mu);
    wide.slip = {Interval(0), Interval(0)};
    box.contacts.push_back(wide);
  }
  const Rational of_A = radius * LargestOf(problem.A), of_b = radius * LargestOf(problem.b);
  box.A = problem.A.unaryExpr([&](const Rational& x) { return Within(x, of_A); });
  box.b = problem.b.unaryExpr([&](const Rational& x) { return Within(x, of_b); });
  return box;
}

bool SameDecision(const Pivot<Interval>& one, const Pivot<Rational>& other) {
  return one.drive == other.drive && one.driven == other.driven && one.goal == other.goal &&
         one.limiting == other.limiting && one.from == other.from && one.to == other.to &&
         one.sets == other.sets;
}

bool ProvedOver(const IntervalProblem& box, const ExactRun& run, PublishedOptions options) {
  options.limits.drives = run.verdict.start + run.verdict.period;
  PublishedAlgorithm<Interval> algorithm(options);
  Trace<Interval> trace;
  const Verdict verdict = algorithm.Run(box, &trace);
  const Steps& steps = run.trace.pivots;
  return verdict.outcome == Outcome::kCycle && verdict.start == run.verdict.start &&
         verdict.period == run.verdict.period &&
         std::equal(steps.begin(), steps.end(), trace.pivots.begin(), trace.pivots.end(),
                    [](const auto& exact, const auto& wide) { return SameDecision(wide, exact); });
}

}  // namespace

bool LoopsWithin(const ExactProblem& problem, const ExactRun& run, const PublishedOptions& options,
                 const Rational& radius) {
  STICTION_CHECK(PublishedHandles(problem), "static and frictionless contacts of the plane");
  if (run.verdict.outcome != Outcome::kCycle) return false;
  try {
    return ProvedOver(BoxAbout(problem, radius), run, options);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return false;
  }
}

std::optional<Rational> RadiusOfLoop(const ExactProblem& problem, const PublishedOptions& options) {
  const ExactRun run = RunExact(problem, options);
  const auto loops = [&](const Rational& radius) { return LoopsWithin(problem, run, options, radius); };
  if (!loops(0)) return std::nullopt;
  // Boxes grow with the radius, and with them all that is uncertain.
  Rational unit(1, 2);
  for (int k = 1; k <= kLargestExponent; ++k, unit /= 2) {
    if (!loops(unit)) continue;
    int parts = 8;  // eighths of `unit`
    while (parts < 15 && loops(unit * (parts + 1) / 8)) ++parts;
    return Rational(unit * parts / 8);
  }
  return Rational(0);
}

}  // namespace stiction
