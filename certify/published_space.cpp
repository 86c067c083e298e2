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

#include "certify/exact.h"
#include "corpus/rounded.h"
#include "solver/problem/reduction.h"
#include "solver/published/published_space.ipp"

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

// What bilateral and sliding contacts leave of a problem, and the whole from it, over Scalar.
template <class Scalar>
class EnclosedRemainder {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  template <class Convert>
  EnclosedRemainder(const ExactProblem& problem, Convert convert)
      : reduction_(problem),
        reduced_(Converted<Scalar>(reduction_.problem(), convert)),
        E_(reduction_.E().unaryExpr(convert)),
        AE_(ExactProblem::Matrix(problem.A * reduction_.E()).unaryExpr(convert)),
        e_(reduction_.e().unaryExpr(convert)),
        a_(ExactProblem::Vector(problem.A * reduction_.e() + problem.b).unaryExpr(convert)) {}

  ReductionEnd end() const { return reduction_.end(); }
  const Problem& problem() const { return reduced_; }
  Vector Forces(const Vector& x) const { return Direction(x) + e_; }
  Vector Direction(const Vector& dx) const { return Product(E_, dx); }
  // Accelerations, their change with a direction of df, in the rows that remain as given.
  Vector Accelerations(const Vector& x, const Vector& given) const {
    return WithGiven(Product(AE_, x) + a_, given);
  }
  Vector AccelerationRates(const Vector& dx, const Vector& given) const {
    return WithGiven(Product(AE_, dx), given);
  }

 private:
  // No entry that is zero is multiplied: nothing is lost where there is nothing to reduce.
  static Vector Product(const typename Problem::Matrix& M, const Vector& x) {
    Vector result = Vector::Constant(M.rows(), Scalar(0));
    for (int i = 0; i < M.rows(); ++i) {
      for (int j = 0; j < M.cols(); ++j) {
        if (!IsSurelyZero(M(i, j))) result[i] += M(i, j) * x[j];
      }
    }
    return result;
  }

  Vector WithGiven(Vector values, const Vector& given) const {
    for (int i = 0; i < given.size(); ++i) values[reduction_.row_of()[i]] = given[i];
    return values;
  }

  Reduction<Rational> reduction_;
  Problem reduced_;
  typename Problem::Matrix E_, AE_;
  Vector e_, a_;
};

PublishedSpaceVerdict Unstarted(ReductionEnd end) {
  PublishedSpaceVerdict verdict;
  verdict.outcome = Outcome::kSingular;
  verdict.reason = Reason(end);
  return verdict;
}

std::vector<Enclosure> Enclosures(const ContactProblem<Interval>::Vector& values) {
  std::vector<Enclosure> result;
  for (const Interval& x : values) result.push_back({x.inf(), x.sup()});
  return result;
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
  } catch (const CGAL::Uncertain_conversion_exception&) {
    run.verdict = algorithm.verdict();
    run.verdict.outcome = Outcome::kUndecided;
    run.verdict.reason = "a sign is unsure";
  }
  run.f = Enclosures(remainder.Forces(algorithm.f()));
  run.a = Enclosures(remainder.Accelerations(algorithm.f(), algorithm.a()));
  if (run.verdict.outcome == Outcome::kRay) run.ray = Enclosures(remainder.Direction(algorithm.ray()));
  return run;
}

}  // namespace stiction
