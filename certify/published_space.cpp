// SPDX-License-Identifier: Apache-2.0
#include "certify/published_space.h"

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

template <class Scalar, class Convert>
ContactProblem<Scalar> Converted(const ExactProblem& problem, Convert convert) {
  ContactProblem<Scalar> result;
  result.dimension = problem.dimension;
  for (const auto& contact : problem.contacts)
    result.contacts.push_back({contact.kind, convert(contact.mu), {Scalar(0), Scalar(0)}});
  result.A = problem.A.unaryExpr(convert);
  result.b = problem.b.unaryExpr(convert);
  return result;
}

template <class Scalar>
RoundedSpaceRun Run(const ContactProblem<Scalar>& problem, const PublishedOptions& options) {
  PublishedInSpace<Scalar> algorithm(options);
  RoundedSpaceRun run;
  run.verdict = algorithm.Run(problem);
  const auto f = algorithm.f();
  const typename ContactProblem<Scalar>::Vector a = problem.A * f + problem.b;
  run.f.assign(f.begin(), f.end());
  run.a.assign(a.begin(), a.end());
  run.residual = static_cast<double>(WeakResidual(problem, f, a));
  return run;
}

std::vector<Enclosure> Enclosures(const ContactProblem<Interval>::Vector& values) {
  std::vector<Enclosure> result;
  for (const Interval& x : values) result.push_back({x.inf(), x.sup()});
  return result;
}

}  // namespace

template <class Scalar>
RoundedSpaceRun RunRoundedInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  const auto round = [](const Rational& x) { return static_cast<Scalar>(ToDouble(x)); };
  return Run(Converted<Scalar>(problem, round), options);
}

template <class Scalar>
RoundedSpaceRun RunSuspicionInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  const auto round = [](const Rational& x) {
    return static_cast<long double>(static_cast<Scalar>(ToDouble(x)));
  };
  PublishedOptions fine = options;
  Tolerances& t = fine.tolerances;
  for (double* tolerance : {&t.acceleration, &t.force, &t.pivot}) *tolerance = std::min(*tolerance, 1e-14);
  t.loop_grain = std::min(t.loop_grain, 1e-12);
  return Run(Converted<long double>(problem, round), fine);
}

IntervalSpaceRun RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  PublishedInSpace<Interval> algorithm(options);
  IntervalSpaceRun run;
  const ContactProblem<Interval> data = Converted<Interval>(problem, Around);
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

template RoundedSpaceRun RunRoundedInSpace<float>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunRoundedInSpace<double>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunRoundedInSpace<long double>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunSuspicionInSpace<float>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunSuspicionInSpace<double>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunSuspicionInSpace<long double>(const ExactProblem&, const PublishedOptions&);

}  // namespace stiction
