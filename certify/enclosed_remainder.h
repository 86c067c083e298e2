// SPDX-License-Identifier: Apache-2.0
// Runs over enclosures on what bilateral and sliding contacts leave of a problem, told in its terms: they leave
// over rationals, before numbers are enclosed.

#ifndef STICTION_CERTIFY_ENCLOSED_REMAINDER_H_
#define STICTION_CERTIFY_ENCLOSED_REMAINDER_H_

#include "corpus/rounded.h"
#include "solver/problem/reduction.h"
#include "solver/problem/remainder.h"
#include "solver/problem/solution.h"

namespace stiction {

// What bilateral and sliding contacts leave of a problem, and the whole from it, over Scalar.
template <class Scalar>
class EnclosedRemainder {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  // Keeps a reference: `problem` must outlive it.
  template <class Convert>
  EnclosedRemainder(const ExactProblem& problem, Convert convert)
      : whole_(problem),
        reduction_(problem),
        reduced_(Converted<Scalar>(reduction_.problem(), convert)),
        E_(reduction_.E().unaryExpr(convert)),
        AE_(ExactProblem::Matrix(problem.A * reduction_.E()).unaryExpr(convert)),
        e_(reduction_.e().unaryExpr(convert)),
        a_(ExactProblem::Vector(problem.A * reduction_.e() + problem.b).unaryExpr(convert)) {}

  ReductionEnd end() const { return reduction_.end(); }
  const Problem& problem() const { return reduced_; }
  const ExactProblem& exact() const { return reduction_.problem(); }
  Vector Forces(const Vector& x) const { return Direction(x) + e_; }
  Vector Direction(const Vector& dx) const { return Product(E_, dx); }
  // Accelerations, their change with a direction of df, in the rows that remain as given.
  Vector Accelerations(const Vector& x, const Vector& given) const {
    return WithGiven(Product(AE_, x) + a_, given);
  }
  Vector AccelerationRates(const Vector& dx, const Vector& given) const {
    return WithGiven(Product(AE_, dx), given);
  }

  std::string Word(const std::string& word) const {
    return Reduction<Rational>::Concerns(whole_) ? WholeWord(whole_.contacts, word) : word;
  }

  // A pivot in the plane, in the rows of the whole problem.
  Pivot<Scalar> Restored(Pivot<Scalar> pivot) const {
    pivot.driven = RowOf(pivot.driven);
    pivot.limiting = RowOf(pivot.limiting);
    pivot.da = AccelerationRates(pivot.df, pivot.da);
    pivot.df = Direction(pivot.df);
    pivot.a = Accelerations(pivot.f, pivot.a);
    pivot.f = Forces(pivot.f);
    pivot.word = Word(pivot.word);
    if (!pivot.sets.empty()) pivot.sets = reduction_.Spread(pivot.sets, IndexSet::kClamped, IndexSet::kNone);
    return pivot;
  }

 private:
  int RowOf(int row) const { return row < 0 ? row : reduction_.row_of()[row]; }

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

  const ExactProblem& whole_;
  Reduction<Rational> reduction_;
  Problem reduced_;
  typename Problem::Matrix E_, AE_;
  Vector e_, a_;
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_ENCLOSED_REMAINDER_H_
