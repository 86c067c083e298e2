// SPDX-License-Identifier: Apache-2.0
// Runs over enclosures on what bilateral and sliding contacts leave of a problem, told in its terms: they leave
// over rationals, before numbers are enclosed.

#pragma once

#include <optional>

#include "corpus/rounded.h"
#include "solver/problem/reduction.h"
#include "solver/problem/remainder.h"
#include "solver/problem/solution.h"

namespace stiction {

// What bilateral and sliding contacts leave of a problem, and the whole from it, over Scalar. A problem without
// them remains as it is.
template <class Scalar>
class EnclosedRemainder {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  // Keeps a reference: `problem` must outlive it.
  template <class Convert>
  EnclosedRemainder(const ExactProblem& problem, Convert convert) : whole_(problem) {
    if (Reduction<Rational>::Concerns(problem)) part_.emplace(problem, convert);
    reduced_ = Converted<Scalar>(exact(), convert);
  }

  ReductionEnd end() const { return part_ ? part_->reduction.end() : ReductionEnd::kReduced; }
  const Problem& problem() const { return reduced_; }
  const ExactProblem& exact() const { return part_ ? part_->reduction.problem() : whole_; }
  Vector Forces(const Vector& x) const { return part_ ? Vector(Direction(x) + part_->e) : x; }
  Vector Direction(const Vector& dx) const { return part_ ? Product(part_->E, dx) : dx; }
  // Accelerations, their change with a direction of df, in the rows that remain as given.
  Vector Accelerations(const Vector& x, const Vector& given) const {
    return part_ ? WithGiven(Product(part_->AE, x) + part_->a, given) : given;
  }
  Vector AccelerationRates(const Vector& dx, const Vector& given) const {
    return part_ ? WithGiven(Product(part_->AE, dx), given) : given;
  }

  std::string Word(const std::string& word) const { return part_ ? WholeWord(whole_.contacts, word) : word; }

  // A pivot in the plane, in the rows of the whole problem.
  Pivot<Scalar> Restored(Pivot<Scalar> pivot) const {
    if (!part_) return pivot;
    pivot.driven = RowOf(pivot.driven);
    pivot.limiting = RowOf(pivot.limiting);
    pivot.da = AccelerationRates(pivot.df, pivot.da);
    pivot.df = Direction(pivot.df);
    pivot.a = Accelerations(pivot.f, pivot.a);
    pivot.f = Forces(pivot.f);
    pivot.word = Word(pivot.word);
    if (!pivot.sets.empty())
      pivot.sets = part_->reduction.Spread(pivot.sets, IndexSet::kClamped, IndexSet::kNone);
    return pivot;
  }

 private:
  // f = E x + e, A f + b = AE x + a.
  struct Part {
    template <class Convert>
    Part(const ExactProblem& problem, Convert convert)
        : reduction(problem),
          E(reduction.E().unaryExpr(convert)),
          AE(ExactProblem::Matrix(problem.A * reduction.E()).unaryExpr(convert)),
          e(reduction.e().unaryExpr(convert)),
          a(ExactProblem::Vector(problem.A * reduction.e() + problem.b).unaryExpr(convert)) {}
    Reduction<Rational> reduction;
    typename Problem::Matrix E, AE;
    Vector e, a;
  };

  int RowOf(int row) const { return row < 0 ? row : part_->reduction.row_of()[row]; }

  // No entry that is zero is multiplied: it would widen what is known.
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
    for (int i = 0; i < given.size(); ++i) values[part_->reduction.row_of()[i]] = given[i];
    return values;
  }

  const ExactProblem& whole_;
  std::optional<Part> part_;
  Problem reduced_;
};

}  // namespace stiction
