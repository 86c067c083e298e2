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

#include "corpus/rounded.h"
#include "solver/problem/reduction.ipp"
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
class Remainder {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  template <class Convert>
  Remainder(const ExactProblem& problem, Convert convert)
      : reduction_(problem),
        contacts_(problem.contacts.size()),
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

  // A pivot in the rows and contacts of the whole problem.
  Pivot<Scalar> Restored(Pivot<Scalar> pivot) const {
    pivot.driven = reduction_.row_of()[pivot.driven];
    pivot.limiting = reduction_.row_of()[pivot.limiting];
    pivot.da = AccelerationRates(pivot.df, pivot.da);
    pivot.df = Direction(pivot.df);
    pivot.a = Accelerations(pivot.f, pivot.a);
    pivot.f = Forces(pivot.f);
    pivot.sets = reduction_.Spread(pivot.sets, IndexSet::kClamped, IndexSet::kNone);
    std::vector<std::array<Scalar, 2>> recorded(contacts_, {Scalar(0), Scalar(0)});
    for (std::size_t i = 0; i < pivot.recorded.size(); ++i)
      recorded[reduction_.contact_of()[i]] = pivot.recorded[i];
    pivot.recorded = std::move(recorded);
    return pivot;
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
  std::size_t contacts_;
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

template <class Vector>
std::vector<double> Doubles(const Vector& values) {
  return {values.begin(), values.end()};
}

template <class Scalar>
Pivot<double> InDoubles(const Pivot<Scalar>& pivot) {
  const auto vector = [](const auto& values) { return Eigen::VectorXd(values.template cast<double>()); };
  Pivot<double> result;
  result.drive = pivot.drive;
  result.driven = pivot.driven;
  result.goal = pivot.goal;
  result.df = vector(pivot.df);
  result.da = vector(pivot.da);
  result.s = static_cast<double>(pivot.s);
  result.limiting = pivot.limiting;
  result.from = pivot.from;
  result.to = pivot.to;
  result.wanted = pivot.wanted;
  result.gave_up = pivot.gave_up;
  result.f = vector(pivot.f);
  result.a = vector(pivot.a);
  result.sets = pivot.sets;
  result.turned_away = pivot.turned_away;
  for (const auto& d : pivot.recorded)
    result.recorded.push_back({static_cast<double>(d[0]), static_cast<double>(d[1])});
  return result;
}

template <class Scalar, class Convert>
RoundedSpaceRun Run(const ExactProblem& problem, Convert convert, const PublishedOptions& options,
                    KeepTrace keep) {
  using Vector = typename ContactProblem<Scalar>::Vector;
  const ContactProblem<Scalar> whole = Converted<Scalar>(problem, convert);
  const Remainder<Scalar> remainder(problem, convert);
  PublishedInSpace<Scalar> algorithm(options);
  RoundedSpaceRun run;
  Vector f = Vector::Constant(problem.rows(), Scalar(0));
  if (remainder.end() != ReductionEnd::kReduced) {
    run.verdict = Unstarted(remainder.end());
  } else {
    SpaceTrace<Scalar> trace;
    run.verdict = algorithm.Run(remainder.problem(), keep == KeepTrace::kYes ? &trace : nullptr);
    f = remainder.Forces(algorithm.f());
    if (run.verdict.outcome == Outcome::kRay) run.ray = Doubles(remainder.Direction(algorithm.ray()));
    for (const Pivot<Scalar>& pivot : trace) run.trace.push_back(InDoubles(remainder.Restored(pivot)));
    const Vector rest = Vector::Constant(remainder.problem().rows(), Scalar(0));
    run.initial_f = Doubles(remainder.Forces(rest));
    run.initial_a = Doubles(remainder.Accelerations(rest, remainder.problem().b));
  }
  const Vector a = whole.A * f + whole.b;
  run.f = Doubles(f);
  run.a = Doubles(a);
  run.residual = static_cast<double>(WeakResidual(whole, f, a));
  return run;
}

std::vector<Enclosure> Enclosures(const ContactProblem<Interval>::Vector& values) {
  std::vector<Enclosure> result;
  for (const Interval& x : values) result.push_back({x.inf(), x.sup()});
  return result;
}

}  // namespace

template <class Scalar>
RoundedSpaceRun RunRoundedInSpace(const ExactProblem& problem, const PublishedOptions& options,
                                  KeepTrace keep) {
  const auto round = [](const Rational& x) { return static_cast<Scalar>(ToDouble(x)); };
  return Run<Scalar>(problem, round, options, keep);
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
  return Run<long double>(problem, round, fine, KeepTrace::kNo);
}

IntervalSpaceRun RunIntervalsInSpace(const ExactProblem& problem, const PublishedOptions& options) {
  IntervalSpaceRun run;
  const Remainder<Interval> remainder(problem, Around);
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

template RoundedSpaceRun RunRoundedInSpace<float>(const ExactProblem&, const PublishedOptions&, KeepTrace);
template RoundedSpaceRun RunRoundedInSpace<double>(const ExactProblem&, const PublishedOptions&, KeepTrace);
template RoundedSpaceRun RunRoundedInSpace<long double>(const ExactProblem&, const PublishedOptions&,
                                                        KeepTrace);
template RoundedSpaceRun RunSuspicionInSpace<float>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunSuspicionInSpace<double>(const ExactProblem&, const PublishedOptions&);
template RoundedSpaceRun RunSuspicionInSpace<long double>(const ExactProblem&, const PublishedOptions&);

}  // namespace stiction
