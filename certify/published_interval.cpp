// SPDX-License-Identifier: Apache-2.0
#include "certify/published_interval.h"

#include <CGAL/Interval_nt.h>

#include <cmath>
#include <limits>

namespace stiction {

using Interval = CGAL::Interval_nt<>;

template <>
struct Approximation<Interval> {
  static double Of(const Interval& x) { return (x.inf() + x.sup()) / 2; }
};

template <>
bool IsSurelyZero(const Interval& x) {
  return x.inf() == 0 && x.sup() == 0;
}

}  // namespace stiction

#include "solver/published_space.ipp"

namespace stiction {
namespace {

// The double nearest to x, or the two on either side of it.
Interval Around(const Rational& x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nearest = ToDouble(x);
  if (std::isinf(nearest)) return {-kInfinity, kInfinity};
  const int side = cmp(Rational(nearest), x);
  return {side > 0 ? std::nextafter(nearest, -kInfinity) : nearest,
          side < 0 ? std::nextafter(nearest, kInfinity) : nearest};
}

ContactProblem<Interval> Around(const ExactProblem& problem) {
  ContactProblem<Interval> result;
  result.dimension = problem.dimension;
  for (const auto& contact : problem.contacts)
    result.contacts.push_back({contact.kind, Around(contact.mu), {Interval(0), Interval(0)}});
  result.A.resize(problem.rows(), problem.rows());
  result.b.resize(problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    result.b[i] = Around(problem.b[i]);
    for (int j = 0; j < problem.rows(); ++j) result.A(i, j) = Around(problem.A(i, j));
  }
  return result;
}

std::vector<Enclosure> Enclosures(const ContactProblem<Interval>::Vector& values) {
  std::vector<Enclosure> result;
  for (const Interval& x : values) result.push_back({x.inf(), x.sup()});
  return result;
}

}  // namespace

IntervalRun RunOverIntervals(const ExactProblem& problem, const PublishedOptions& options) {
  PublishedInSpace<Interval> algorithm(options);
  IntervalRun run;
  const ContactProblem<Interval> data = Around(problem);
  try {
    run.verdict = algorithm.Run(data);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    run.verdict = algorithm.verdict();
    run.verdict.outcome = Outcome::kUndecided;
    run.verdict.reason = "a sign is unsure";
  }
  run.f = Enclosures(algorithm.f());
  run.a = Enclosures(algorithm.a());
  return run;
}

}  // namespace stiction
