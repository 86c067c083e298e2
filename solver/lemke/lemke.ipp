// SPDX-License-Identifier: Apache-2.0
// Definitions for lemke.h.

#ifndef STICTION_SOLVER_LEMKE_LEMKE_IPP_
#define STICTION_SOLVER_LEMKE_LEMKE_IPP_

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/lemke/lemke.h"
#include "solver/problem/residual.h"

namespace stiction {

template <class Scalar, int Rows>
Verdict LemkeAlgorithm<Scalar, Rows>::Run(const Problem& problem) {
  Start(problem);
  verdict_.outcome = IsNonnegative() ? Outcome::kSolved : Follow(problem);
  if (verdict_.outcome == Outcome::kSolved) {
    Extract(problem);
    verdict_.outcome = JudgeSolution(problem);
  }
  return verdict_;
}

// T = (q, I), w basic. Inexact runs divide accelerations by max abs(b) and A by max A_ii, which leaves the
// path as it is: the covering vector is scaled along.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Start(const Problem& problem) {
  verdict_ = Verdict();
  SetUnits(problem);
  ListComponents(problem);
  if constexpr (Rows == Eigen::Dynamic) {
    f_.resize(problem.rows());
    ray_.resize(problem.rows());
    T_.resize(size_, size_ + 1);
    M_.resize(size_, size_);
    column_.resize(size_);
    cover_.resize(size_);
  }
  const Scalar limit_cover = LimitCover(problem);
  basis_.resize(size_);
  for (int i = 0; i < problem.rows(); ++i) f_[i] = ray_[i] = Scalar(0);
  for (int i = 0; i < size_; ++i) {
    basis_[i] = i;
    cover_[i] = components_[i].block == Block::kMultiplier ? limit_cover : Scalar(1);
    T_(i, 0) = RightSide(problem, components_[i]);
    for (int j = 0; j < size_; ++j) {
      T_(i, j + 1) = Scalar(i == j ? 1 : 0);
      M_(i, j) = MatrixEntry(problem, components_[i], components_[j]);
    }
  }
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::SetUnits(const Problem& problem) {
  unit_A_ = unit_b_ = Scalar(1);
  if constexpr (!kIsExact<Scalar>) {
    Scalar A = 0, b = 0;
    for (int i = 0; i < problem.rows(); ++i) {
      A = std::max(A, Abs(problem.A(i, i)));
      b = std::max(b, Abs(problem.b[i]));
    }
    if (A > 0) unit_A_ = A;
    if (b > 0) unit_b_ = b;
    const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
    pivot_tolerance_ = std::max(Scalar(options_.tolerances.pivot), least);
    tie_tolerance_ = std::max(Scalar(options_.tolerances.force), least);
    residual_tolerance_ = std::max(Scalar(options_.tolerances.loop_grain), least);
  }
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ListComponents(const Problem& problem) {
  components_.clear();
  for (const Block block : {Block::kNormal, Block::kPlus, Block::kMinus, Block::kMultiplier}) {
    int row = 0;
    for (int contact = 0; contact < static_cast<int>(problem.contacts.size()); ++contact) {
      const bool rough = problem.contacts[contact].HasFrictionRows();
      if (block == Block::kNormal) {
        components_.push_back({block, row, contact});
      } else if (rough) {
        components_.push_back({block, row + 1, contact});
      }
      row += rough ? 2 : 1;
    }
  }
  size_ = static_cast<int>(components_.size());
}

template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::RightSide(const Problem& problem, const Component& w) const {
  if (w.block == Block::kMultiplier) return Scalar(0);
  const Scalar value = problem.b[w.row] / unit_b_;
  return w.block == Block::kMinus ? Scalar(-value) : value;
}

template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::MatrixEntry(const Problem& problem, const Component& w,
                                                 const Component& z) const {
  if (w.block != Block::kMultiplier && z.block != Block::kMultiplier) {
    const Scalar entry = problem.A(w.row, z.row) / unit_A_;
    return (w.block == Block::kMinus) != (z.block == Block::kMinus) ? Scalar(-entry) : entry;
  }
  const bool both = w.block == z.block;
  if (w.contact != z.contact || both || w.block == Block::kNormal) return Scalar(0);
  if (z.block == Block::kMultiplier) return Scalar(1);
  return z.block == Block::kNormal ? problem.contacts[w.contact].mu : Scalar(-1);
}

// The covering vector in the rows of force limits.
template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::LimitCover(const Problem& problem) const {
  if (options_.cover == Cover::kOnes) return unit_A_;
  Scalar A = Scalar(0);
  for (int i = 0; i < problem.rows(); ++i) A = std::max<Scalar>(A, problem.A(i, i));
  return Sign(A) > 0 ? Scalar(unit_A_ / A) : Scalar(1);
}

template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::IsNonnegative() const {
  for (int i = 0; i < size_; ++i) {
    if (Sign(T_(i, 0)) < 0) return false;
  }
  return true;
}

// ---- The path ----------------------------------------------------------------------------------

template <class Scalar, int Rows>
Outcome LemkeAlgorithm<Scalar, Rows>::Follow(const Problem& problem) {
  int entering = Artificial();
  ComputeColumn(entering);
  int row = FirstLeaving();
  while (true) {
    const int leaving = basis_[row];
    Pivot(row, entering);
    if (leaving == Artificial()) return Outcome::kSolved;
    if (BudgetSpent()) return Outcome::kLimit;
    entering = leaving < size_ ? leaving + size_ : leaving - size_;  // the complement of what has left
    ComputeColumn(entering);
    row = Leaving();
    if (row < 0) return JudgeRay(problem, entering);
  }
}

// The lexicographically smallest row of (q, I) divided by the covering vector: z0 becomes so large that all
// rows are positive. All unit vectors with the same quotient: the last is the smallest.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::FirstLeaving() const {
  int best = 0;
  for (int i = 1; i < size_; ++i) {
    if (Sign(Scalar(T_(i, 0) * cover_[best] - T_(best, 0) * cover_[i])) <= 0) best = i;
  }
  return best;
}

// inv(B) times the column of a variable in w - M z - e z0 = q.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ComputeColumn(int entering) {
  const auto coefficient = [&](int k) -> const Scalar& {
    return entering == Artificial() ? cover_[k] : M_(k, entering - size_);
  };
  for (int i = 0; i < size_; ++i) {
    if (entering < size_) {
      column_[i] = T_(i, entering + 1);
      continue;
    }
    column_[i] = Scalar(0);
    for (int k = 0; k < size_; ++k) {
      if (Sign(T_(i, k + 1)) != 0) column_[i] -= T_(i, k + 1) * coefficient(k);
    }
  }
}

// The row that limits the entering variable first, -1 if none does. z0 leaves whenever it can.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::Leaving() const {
  Scalar largest = Scalar(0);
  if constexpr (!kIsExact<Scalar>) {
    for (int i = 0; i < size_; ++i) largest = std::max(largest, Abs(column_[i]));
  }
  const Scalar tolerance = pivot_tolerance_ * largest;
  int best = -1, artificial = -1;
  for (int i = 0; i < size_; ++i) {
    if (Sign(column_[i], tolerance) <= 0) continue;
    if (basis_[i] == Artificial()) artificial = i;
    if (best < 0 || IsBefore(i, best)) best = i;
  }
  return artificial >= 0 && CompareQuotients(artificial, best, 0) <= 0 ? artificial : best;
}

// The sign of T_ic / column_i - T_kc / column_k.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::CompareQuotients(int i, int k, int c) const {
  if constexpr (kIsExact<Scalar>) {
    const int left = Sign(T_(i, c)), right = Sign(T_(k, c));
    if (left != right || left == 0) return Sign(Scalar(left - right));
    return Sign(Scalar(T_(i, c) * column_[k] - T_(k, c) * column_[i]));
  } else {
    const Scalar x = T_(i, c) / column_[i], y = T_(k, c) / column_[k];
    const Scalar scale = std::max({Abs(x), Abs(y), 1 / column_[i], 1 / column_[k]});
    return Sign(x - y, tie_tolerance_ * scale);
  }
}

template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::IsBefore(int i, int k) const {
  for (int c = 0; c <= size_; ++c) {
    if (const int order = CompareQuotients(i, k, c); order != 0) return order < 0;
  }
  return false;  // over exact scalars two rows are never proportional
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Pivot(int row, int entering) {
  const Scalar pivot = column_[row];
  for (int c = 0; c <= size_; ++c) {
    if (Sign(T_(row, c)) != 0) T_(row, c) /= pivot;
  }
  for (int i = 0; i < size_; ++i) {
    if (i == row || Sign(column_[i]) == 0) continue;
    for (int c = 0; c <= size_; ++c) {
      if (Sign(T_(row, c)) != 0) T_(i, c) -= column_[i] * T_(row, c);
    }
  }
  basis_[row] = entering;
  ++verdict_.statistics.pivots;
}

template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::BudgetSpent() {
  if (verdict_.statistics.pivots >= options_.limits.pivots) {
    verdict_.reason = "pivots";
  } else {
    for (int i = 0; i < size_; ++i) {
      if (BitLength<Scalar>::Of(T_(i, 0)) > options_.limits.bits) verdict_.reason = "bits";
    }
  }
  return !verdict_.reason.empty();
}

// ---- Answers -----------------------------------------------------------------------------------

// Adds the force that a variable of the path stands for, if any.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::AddForce(int variable, const Scalar& value, Vector& f) const {
  if (variable < size_ || variable == Artificial()) return;
  const Component& z = components_[variable - size_];
  if (z.block == Block::kMultiplier) return;
  if (z.block == Block::kMinus) {
    f[z.row] -= value;
  } else {
    f[z.row] += value;
  }
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Extract(const Problem& problem) {
  const Scalar unit = unit_b_ / unit_A_;
  for (int i = 0; i < size_; ++i) AddForce(basis_[i], T_(i, 0) * unit, f_);
  a_ = problem.b;
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) {
      if (Sign(f_[j]) != 0) a_[i] += problem.A(i, j) * f_[j];
    }
  }
}

template <class Scalar, int Rows>
Outcome LemkeAlgorithm<Scalar, Rows>::JudgeSolution(const Problem& problem) {
  if constexpr (!kIsExact<Scalar>) {
    // Written so that a residual that is no number is refused.
    if (!(NaturalResidual(problem, f_, a_) <= residual_tolerance_)) {
      verdict_.reason = "residual of the answer";
      return Outcome::kUndecided;
    }
  }
  return Outcome::kSolved;
}

// Over inexact scalars a ray counts if its forces show it: A ray = 0 to the tolerance of pivots and b'ray < 0
// far beyond it. Otherwise what limits the step may have been lost in rounding.
template <class Scalar, int Rows>
Outcome LemkeAlgorithm<Scalar, Rows>::JudgeRay(const Problem& problem, int entering) {
  AddForce(entering, Scalar(1), ray_);
  for (int i = 0; i < size_; ++i) AddForce(basis_[i], Scalar(-column_[i]), ray_);
  if constexpr (!kIsExact<Scalar>) {
    Scalar largest = 0, product = 0, image = 0;
    for (int i = 0; i < problem.rows(); ++i) {
      Scalar change = 0;
      for (int j = 0; j < problem.rows(); ++j) change += problem.A(i, j) * ray_[j];
      largest = std::max(largest, Abs(ray_[i]));
      image = std::max(image, Abs(change));
      product += problem.b[i] * ray_[i];
    }
    const bool shown =
        image <= pivot_tolerance_ * unit_A_ * largest && product < -residual_tolerance_ * unit_b_ * largest;
    if (!shown) {
      verdict_.reason = "no pivot above the tolerance";
      return Outcome::kUndecided;
    }
  }
  return Outcome::kRay;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_LEMKE_LEMKE_IPP_
