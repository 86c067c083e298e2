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

// Whether all forces are zero that the sets do not determine.
bool RestsOutside(const std::vector<IndexSet>& sets, const IntervalProblem::Vector& f) {
  for (std::size_t row = 0; row < sets.size(); ++row) {
    const bool determined = IsUnknown(sets[row]) || LimitSign(sets[row]) != 0;
    if (!determined && !IsSurelyZero(f[static_cast<Eigen::Index>(row)])) return false;
  }
  return true;
}

bool AreRegular(const IntervalProblem& box, const std::vector<IndexSet>& sets) {
  using System = DirectionSystem<Interval, Eigen::Dynamic>;
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(box.contacts);
  System system;
  system.Start(box);
  const IndexSets<Eigen::Dynamic> given(sets.begin(), sets.end());
  return system.SolveForces(box, SetUnknowns<Interval, Eigen::Dynamic>{box, layout, given},
                            MakeScale(box, Tolerances{})) == System::Status::kRegular;
}

// The forces after so many drives; zero before the first.
IntervalProblem::Vector ForcesAfter(std::int64_t drives, const std::vector<Pivot<Interval>>& steps, int rows) {
  IntervalProblem::Vector f = IntervalProblem::Vector::Constant(rows, Interval(0));
  for (const Pivot<Interval>& step : steps) {
    if (step.drive <= drives) f = step.f;
  }
  return f;
}

bool ProvedOver(const IntervalProblem& box, const ExactRun& run, PublishedOptions options) {
  const std::int64_t start = run.verdict.start, end = start + run.verdict.period;
  options.limits.drives = end;
  PublishedAlgorithm<Interval> algorithm(options);
  Trace<Interval> trace;
  try {
    algorithm.Run(box, &trace);
  } catch (const CGAL::Uncertain_conversion_exception&) {  // here, or where the state stands again
  }
  const Steps& steps = run.trace.pivots;
  if (trace.pivots.size() < steps.size()) return false;
  if (!std::equal(steps.begin(), steps.end(), trace.pivots.begin(),
                  [](const auto& exact, const auto& wide) { return SameDecision(wide, exact); }))
    return false;
  return RestsOutside(run.state.sets, ForcesAfter(start, trace.pivots, box.rows())) &&
         RestsOutside(run.state.sets, ForcesAfter(end, trace.pivots, box.rows())) &&
         AreRegular(box, run.state.sets);
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
