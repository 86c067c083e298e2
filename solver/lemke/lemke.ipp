// SPDX-License-Identifier: Apache-2.0
// Definitions for lemke.h.

#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <utility>

#include "solver/lemke/lemke.h"
#include "solver/problem/check.h"
#include "solver/problem/lenient.h"

namespace stiction {

template <class Scalar, int Rows>
RunEnd<> LemkeAlgorithm<Scalar, Rows>::Run(const Problem& problem, Trace<Scalar>* trace) {
  problem_ = &problem;
  polygons_ = nullptr;
  trace_ = trace;
  return Run();
}

template <class Scalar, int Rows>
RunEnd<> LemkeAlgorithm<Scalar, Rows>::Run(const Problem& problem, const Polygons& polygons,
                                           Trace<Scalar>* trace) {
  STICTION_CHECK(polygons.size() == problem.contacts.size(), "a polygon per contact");
  problem_ = &problem;
  polygons_ = &polygons;
  trace_ = trace;
  return Run();
}

template <class Scalar, int Rows>
RunEnd<> LemkeAlgorithm<Scalar, Rows>::Run() {
  Start();
  verdict_.outcome = IsNonnegative() ? Outcome::kSolved : Follow();
  if (verdict_.outcome == Outcome::kSolved) {
    Extract();
    verdict_.outcome = JudgeSolution();
  }
  return verdict_;
}

// T = (q, I), w basic. Inexact runs divide accelerations by max abs(b) and A by max A_ii, which leaves the
// path as it is: the covering vector is scaled along.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Start() {
  const Problem& problem = *problem_;
  verdict_ = {.statistics = {Counter::kPivots}};
  if (trace_ != nullptr) {
    trace_->pivots.clear();
    trace_->consulted = 0;
    if (!trace_->keep_pivots) trace_ = nullptr;
  }
  SetUnits();
  ListComponents();
  if constexpr (Rows == Eigen::Dynamic) {
    f_.resize(problem.rows());
    ray_.resize(problem.rows());
    T_.resize(size_, size_ + 1);
    M_.resize(size_, size_);
    column_.resize(size_);
    cover_.resize(size_);
  }
  denominator_ = Entry(1);
  row_units_.assign(size_, Entry(1));
  basis_.resize(size_);
  for (int i = 0; i < problem.rows(); ++i) f_[i] = ray_[i] = Scalar(0);
  const Scalar limit = LimitCover();
  for (int i = 0; i < size_; ++i) {
    basis_[i] = i;
    for (int j = 0; j < size_; ++j) T_(i, j + 1) = Entry(i == j ? 1 : 0);
    SetRow(i, limit);
  }
}

// q, M and d; where integers are beneath the scalar, times their common denominator.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::SetRow(int i, const Scalar& limit_cover) {
  using F = Fractions<Scalar>;
  const Component& w = components_[i];
  const Scalar q = RightSide(w), cover = CoverOf(w, limit_cover);
  Entry& unit = row_units_[i];
  if constexpr (kFractionFree<Scalar>) {
    F::Include(unit, q);
    F::Include(unit, cover);
    for (const Component& z : components_) F::Include(unit, MatrixEntry(w, z));
  }
  T_(i, 0) = F::Numerator(q, unit);
  cover_[i] = F::Numerator(cover, unit);
  for (int j = 0; j < size_; ++j) M_(i, j) = F::Numerator(MatrixEntry(w, components_[j]), unit);
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::SetUnits() {
  const Problem& problem = *problem_;
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
    pivot_tolerance_ = std::max(Scalar(request_.tolerances.pivot), least);
    tie_tolerance_ = std::max(Scalar(request_.tolerances.force), least);
    residual_tolerance_ = std::max(Scalar(request_.tolerances.loop_grain), least);
  }
}

// Normals, the first corners, the second ones, ..., multipliers; each by contact.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ListComponents() {
  components_.clear();
  int row = 0;
  for (int contact = 0; contact < static_cast<int>(problem_->contacts.size()); ++contact) {
    components_.push_back({Block::kNormal, row, contact});
    row += problem_->contacts[contact].HasFrictionRows() ? problem_->dimension : 1;
  }
  ListCorners();
  const int normals = static_cast<int>(problem_->contacts.size());
  for (int i = 0; i < normals; ++i) {
    const Component normal = components_[i];
    if (Corners(normal.contact) > 0)
      components_.push_back({Block::kMultiplier, normal.row + 1, normal.contact});
  }
  size_ = static_cast<int>(components_.size());
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ListCorners() {
  const int contacts = static_cast<int>(problem_->contacts.size());
  int most = 0;
  for (int contact = 0; contact < contacts; ++contact) most = std::max(most, Corners(contact));
  for (int corner = 0; corner < most; ++corner) {
    for (int contact = 0; contact < contacts; ++contact) {
      if (corner < Corners(contact))
        components_.push_back({Block::kCorner, components_[contact].row + 1, contact, corner});
    }
  }
}

template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::Corners(int contact) const {
  if (!problem_->contacts[contact].HasFrictionRows()) return 0;
  return polygons_ == nullptr ? 2 : (*polygons_)[contact].sides();
}

// The normal value values(0), or d.values(0), values(1) for the corner d; in the plane d = +1, -1.
template <class Scalar, int Rows>
template <class Values>
Scalar LemkeAlgorithm<Scalar, Rows>::Along(const Component& component, const Values& values) const {
  if (component.block == Block::kNormal) return values(0);
  if (polygons_ == nullptr) return component.corner == 0 ? Scalar(values(0)) : Scalar(-values(0));
  const Planar<Scalar>& d = (*polygons_)[component.contact].corner(component.corner);
  return d[0] * values(0) + d[1] * values(1);
}

template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::RightSide(const Component& w) const {
  if (w.block == Block::kMultiplier) return Scalar(0);
  return Along(w, [&](int k) { return Scalar(problem_->b[w.row + k] / unit_b_); });
}

template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::MatrixEntry(const Component& w, const Component& z) const {
  if (w.block != Block::kMultiplier && z.block != Block::kMultiplier) {
    return Along(w, [&](int k) {
      return Along(z, [&](int l) { return Scalar(problem_->A(w.row + k, z.row + l) / unit_A_); });
    });
  }
  const bool both = w.block == z.block;
  if (w.contact != z.contact || both || w.block == Block::kNormal) return Scalar(0);
  if (z.block == Block::kMultiplier) return Scalar(1);
  return z.block == Block::kNormal ? problem_->contacts[w.contact].mu : Scalar(-1);
}

// The covering vector in the rows of force limits.
template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::LimitCover() const {
  const Problem& problem = *problem_;
  if (kind_of_cover_ == Cover::kOnes) return unit_A_;
  if (kind_of_cover_ == Cover::kGraded) return Scalar(1 / Grade<Scalar>());
  Scalar A = Scalar(0);
  for (int i = 0; i < problem.rows(); ++i) A = std::max<Scalar>(A, problem.A(i, i));
  return Sign(A) > 0 ? Scalar(unit_A_ / A) : Scalar(1);
}

template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::CoverOf(const Component& w, const Scalar& limit_cover) const {
  if (w.block == Block::kMultiplier) return limit_cover;
  Scalar cover(1);
  for (int r = 0; kind_of_cover_ == Cover::kGraded && r < w.row; ++r) cover *= Grade<Scalar>();
  return cover;
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
Outcome LemkeAlgorithm<Scalar, Rows>::Follow() {
  int entering = Artificial();
  ComputeColumn(entering);
  int row = FirstLeaving();
  while (true) {
    if (trace_ != nullptr) RecordStep(row, entering);
    if (row < 0) return JudgeRay();
    const int leaving = basis_[row];
    Pivot(row, entering);
    if constexpr (kEncloses<Scalar>) {
      Renew();
      if (leaving == Artificial()) MeetEnd(entering);
    }
    if (trace_ != nullptr) RecordPoint(row);
    if (leaving == Artificial()) return Outcome::kSolved;
    if (BudgetSpent()) return verdict_.reason == kStopped ? Outcome::kUndecided : Outcome::kLimit;
    entering = leaving < size_ ? leaving + size_ : leaving - size_;  // the complement of what has left
    ComputeColumn(entering);
    row = Leaving(entering);
    if (row < 0) ComputeRay(entering);
  }
}

// The lexicographically smallest row of (q, I) divided by the covering vector: z0 becomes so large that all
// rows are positive. All unit vectors with the same quotient: the last is the smallest.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::FirstLeaving() const {
  int best = 0;
  for (int i = 1; i < size_; ++i) {
    if (Sign(Entry(T_(i, 0) * cover_[best] - T_(best, 0) * cover_[i])) <= 0) best = i;
  }
  return best;
}

// inv(B) times the column of a variable in w - M z - e z0 = q.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ComputeColumn(int entering) {
  const auto coefficient = [&](int k) -> const Entry& {
    return entering == Artificial() ? cover_[k] : M_(k, entering - size_);
  };
  for (int i = 0; i < size_; ++i) {
    if (entering < size_) {
      column_[i] = T_(i, entering + 1);
      continue;
    }
    column_[i] = Entry(0);
    for (int k = 0; k < size_; ++k) {
      if (!IsSurelyZero(T_(i, k + 1))) column_[i] -= T_(i, k + 1) * coefficient(k);
    }
  }
}

// The row that limits the entering variable first, -1 if none does. z0 leaves whenever it can.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::Leaving(int entering) const {
  Scalar tolerance(0);
  if constexpr (!kIsExact<Scalar>) {
    for (int i = 0; i < size_; ++i) tolerance = std::max(tolerance, Abs(column_[i]));
    tolerance *= pivot_tolerance_;
  }
  const auto falls = [&](int i) {
    if constexpr (kIsExact<Scalar>) {
      return Sign(column_[i]) > 0;
    } else {
      return Sign(column_[i], tolerance) > 0;
    }
  };
  int best = -1, artificial = -1;
  for (int i = 0; i < size_; ++i) {
    if (kEncloses<Scalar> && FollowsCover(i, entering)) continue;  // z0 leaves in its place
    if (!falls(i)) continue;
    if (basis_[i] == Artificial()) artificial = i;
    if (best < 0 || IsBefore(i, best)) best = i;
  }
  if (artificial < 0 || artificial == best) return best;
  return CompareQuotients(artificial, best, 0) <= 0 ? artificial : best;
}

// The sign of T_ic / column_i - T_kc / column_k.
template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::CompareQuotients(int i, int k, int c) const {
  if constexpr (kIsExact<Scalar>) {
    const int left = Sign(T_(i, c)), right = Sign(T_(k, c));
    if (left != right || left == 0) return left - right;
    return Sign(Entry(T_(i, c) * column_[k] - T_(k, c) * column_[i]));
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
bool LemkeAlgorithm<Scalar, Rows>::IsBasic(int variable) const {
  return std::find(basis_.begin(), basis_.end(), variable) != basis_.end();
}

// Whether the basic variable of row i is a multiple of z0, whatever the numbers: alone among the basic and the
// entering ones in   m = mu fN - sum of beta_k + e z0,   or in the plane in   w_+ + w_- = 2 l + 2 z0.
template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::FollowsCover(int i, int entering) const {
  const int variable = basis_[i];
  if (variable == Artificial()) return false;
  const Component& own = ComponentOf(variable);
  const bool is_z = variable >= size_;
  if (own.block == Block::kNormal || (own.block == Block::kMultiplier && is_z)) return false;
  const bool of_forces = is_z || own.block == Block::kMultiplier;  // the first relation
  if (!of_forces && polygons_ != nullptr) return false;
  for (int k = 0; k < size_; ++k) {
    const Component& other = components_[k];
    if (other.contact != own.contact) continue;
    const bool normal = other.block == Block::kNormal;
    if (normal && (!of_forces || IsSurelyZero(problem_->contacts[own.contact].mu))) continue;
    const bool member_is_z = of_forces != (other.block == Block::kMultiplier);
    const int member = member_is_z ? k + size_ : k;
    if (member != variable && (member == entering || IsBasic(member))) return false;
  }
  return true;
}

// Of the columns of w - M z - e z0 = q.
template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::BasisEntry(int row, int variable) const {
  if (variable == Artificial()) return -cover_[row];
  return variable < size_ ? Scalar(row == variable ? 1 : 0) : Scalar(-M_(row, variable - size_));
}

// T = inv(B) (q, I) over enclosures, from the basis: with R near inv(B) in doubles, R B is near I, and to
// eliminate it keeps the ends close. Any R will do.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Renew() {
  if constexpr (kEncloses<Scalar>) {  // over other scalars nothing calls it
    using Dense = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Dense B(size_, size_), q(size_, 1);
    Eigen::MatrixXd middle(size_, size_);
    for (int i = 0; i < size_; ++i) {
      q(i, 0) = RightSide(components_[i]);
      for (int j = 0; j < size_; ++j) B(i, j) = BasisEntry(i, basis_[j]);
      for (int j = 0; j < size_; ++j) middle(i, j) = Approximation<Scalar>::Of(B(i, j));
    }
    const Eigen::MatrixXd inverse = middle.inverse();
    const Dense R = inverse.unaryExpr([](double x) { return Scalar(x); });
    Dense C = R * B;
    T_ << R * q, R;
    for (int c = 0; c < size_; ++c) {
      const Scalar pivot = C(c, c);
      C.row(c) /= pivot;
      T_.row(c) /= pivot;
      for (int i = 0; i < size_; ++i) {
        if (i == c) continue;
        const Scalar factor = C(i, c);
        C.row(i) -= factor * C.row(c);
        T_.row(i) -= factor * T_.row(c);
      }
    }
  }
}

// z0 is zero, and so are its multiples.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::MeetEnd(int entering) {
  for (int i = 0; i < size_; ++i) {
    if (FollowsCover(i, entering)) T_(i, 0) = Entry(0);
  }
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Pivot(int row, int entering) {
  if constexpr (kFractionFree<Scalar>) {
    EliminateIntegers(row);
  } else {
    Eliminate(row);
  }
  basis_[row] = entering;
  ++verdict_.statistics[Counter::kPivots];
}

template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Eliminate(int row) {
  const Entry pivot = column_[row];
  for (int c = 0; c <= size_; ++c) {
    if (!IsSurelyZero(T_(row, c))) T_(row, c) /= pivot;
  }
  for (int i = 0; i < size_; ++i) {
    if (i == row || IsSurelyZero(column_[i])) continue;
    for (int c = 0; c <= size_; ++c) {
      if (!IsSurelyZero(T_(row, c))) T_(i, c) -= column_[i] * T_(row, c);
    }
  }
}

// By minors: the denominator, |det B|, divides every product of the rule of three (Edmonds 1967, Bareiss 1968).
// Only z0 comes in on a negative pivot.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::EliminateIntegers(int row) {
  if constexpr (kFractionFree<Scalar>) {  // over other scalars nothing calls it
    using F = Fractions<Scalar>;
    Entry pivot = column_[row];
    if (pivot < 0) {
      pivot = -pivot;
      for (int c = 0; c <= size_; ++c) T_(row, c) = -T_(row, c);
    }
    for (int i = 0; i < size_; ++i) {
      if (i == row) continue;
      for (int c = 0; c <= size_; ++c) {
        Entry& entry = T_(i, c);
        entry *= pivot;
        F::SubtractProduct(entry, column_[i], T_(row, c));
        F::DivideExactly(entry, denominator_);
      }
    }
    denominator_ = std::move(pivot);
  }
}

template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::BudgetSpent() {
  if (verdict_.statistics[Counter::kPivots] >= request_.limits.pivots) {
    verdict_.reason = "pivots";
  } else if (request_.limits.Stopped()) {
    verdict_.reason = kStopped;
  } else {
    for (int i = 0; kIsExact<Scalar> && i < size_; ++i) {
      if (MayExceedBits(i) && BitLength<Scalar>::Of(Value(i)) > request_.limits.bits) verdict_.reason = "bits";
    }
  }
  return !verdict_.reason.empty();
}

// Before common factors are found, which takes time.
template <class Scalar, int Rows>
bool LemkeAlgorithm<Scalar, Rows>::MayExceedBits(int i) const {
  const auto bits = &BitLength<Entry>::Of;
  const std::int64_t unit = basis_[i] < size_ ? bits(row_units_[basis_[i]]) : 0;
  return std::max(bits(T_(i, 0)), bits(denominator_) + unit) > request_.limits.bits;
}

// ---- Answers -----------------------------------------------------------------------------------

// Of the basic variable of row i.
template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::Value(int i) const {
  if constexpr (kFractionFree<Scalar>) {
    const int variable = basis_[i];
    const Entry divisor = variable < size_ ? Entry(denominator_ * row_units_[variable]) : denominator_;
    return Fractions<Scalar>::Quotient(T_(i, 0), divisor);
  } else {
    return T_(i, 0);
  }
}

// Adds the force that a variable of the path stands for, if any.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::AddForce(int variable, const Scalar& value, Vector& f) const {
  if (variable < size_ || variable == Artificial()) return;
  const Component& z = ComponentOf(variable);
  if (z.block == Block::kMultiplier) return;
  if (z.block == Block::kNormal || (polygons_ == nullptr && z.corner == 0)) {
    f[z.row] += value;
  } else if (polygons_ == nullptr) {
    f[z.row] -= value;
  } else {
    const Planar<Scalar>& d = (*polygons_)[z.contact].corner(z.corner);
    for (int k = 0; k < 2; ++k) f[z.row + k] += value * d[k];
  }
}

// f and a of the present basis.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::Extract() {
  const Scalar unit = unit_b_ / unit_A_;
  for (int i = 0; i < problem_->rows(); ++i) f_[i] = Scalar(0);
  for (int i = 0; i < size_; ++i) {
    if (basis_[i] >= size_) AddForce(basis_[i], Value(i) * unit, f_);
  }
  a_ = problem_->b;
  for (int i = 0; i < problem_->rows(); ++i) {
    for (int j = 0; j < problem_->rows(); ++j) {
      if (!IsSurelyZero(f_[j])) a_[i] += problem_->A(i, j) * f_[j];
    }
  }
}

// The forces per unit of the entering variable, in the units of the tableau.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::ComputeRay(int entering) {
  for (int i = 0; i < problem_->rows(); ++i) ray_[i] = Scalar(0);
  AddForce(entering, Scalar(1), ray_);
  for (int i = 0; i < size_; ++i) {
    if (basis_[i] < size_) continue;
    if constexpr (kFractionFree<Scalar>) {
      Entry change = -column_[i];
      if (entering < size_) change *= row_units_[entering];
      AddForce(basis_[i], Fractions<Scalar>::Quotient(change, denominator_), ray_);
    } else {
      AddForce(basis_[i], Scalar(-column_[i]), ray_);
    }
  }
}

// On polygons what is found is where Newton's method begins, whose answer the gate judges.
template <class Scalar, int Rows>
Outcome LemkeAlgorithm<Scalar, Rows>::JudgeSolution() {
  if constexpr (!kIsExact<Scalar>) {
    if (polygons_ != nullptr) return Outcome::kSolved;
    // The gate looks more closely, and refines.
    if (!(MeasureLeniently(*problem_, FrictionLaw::kCoulomb, f_, a_).error <= residual_tolerance_)) {
      verdict_.reason = kImprecise;
      return Outcome::kUndecided;
    }
  }
  return Outcome::kSolved;
}

// Over inexact scalars a ray counts if its forces show it: A ray = 0 to the tolerance of pivots and b'ray < 0
// far beyond it. Otherwise what limits the step may have been lost in rounding.
template <class Scalar, int Rows>
Outcome LemkeAlgorithm<Scalar, Rows>::JudgeRay() {
  const Problem& problem = *problem_;
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

// ---- The trace ---------------------------------------------------------------------------------

template <class Scalar, int Rows>
std::string LemkeAlgorithm<Scalar, Rows>::NameOf(int variable) const {
  if (variable == Artificial()) return "z0";
  const bool is_w = variable < size_;
  const Component& component = ComponentOf(variable);
  const std::string contact = std::to_string(component.contact + 1);
  if (component.block == Block::kMultiplier) return (is_w ? "m" : "l") + contact;
  const std::string letter = is_w ? "a" : "f";
  if (component.block == Block::kNormal) return letter + "N" + contact;
  if (polygons_ == nullptr) return letter + (component.corner == 0 ? "+" : "-") + contact;
  return letter + std::to_string(component.corner) + "." + contact;
}

template <class Scalar, int Rows>
int LemkeAlgorithm<Scalar, Rows>::RowOf(int variable) const {
  return variable == Artificial() ? -1 : ComponentOf(variable).row;
}

// What one of the variable in the tableau is in N or m/s^2. z0 covers accelerations.
template <class Scalar, int Rows>
Scalar LemkeAlgorithm<Scalar, Rows>::UnitOf(int variable) const {
  if (variable == Artificial()) return unit_b_;
  const bool is_multiplier = ComponentOf(variable).block == Block::kMultiplier;
  return (variable < size_) == is_multiplier ? Scalar(unit_b_ / unit_A_) : unit_b_;
}

// Before the pivot; row -1: a ray.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::RecordStep(int row, int entering) {
  ComputeRay(entering);
  Extract();
  stiction::Pivot<Scalar>& pivot = trace_->pivots.emplace_back();
  pivot.drive = static_cast<int>(trace_->pivots.size());
  pivot.driven = RowOf(entering);
  pivot.limiting = row < 0 ? -1 : RowOf(basis_[row]);
  pivot.entering = NameOf(entering);
  if (row >= 0) pivot.leaving = NameOf(basis_[row]);
  pivot.df = ray_ * Scalar(unit_b_ / unit_A_ / UnitOf(entering));
  pivot.da = problem_->A * pivot.df;
  pivot.f = f_;
  pivot.a = a_;
  if (trace_->pivots.size() > 1) pivot.cover = trace_->pivots[trace_->pivots.size() - 2].cover;
}

// After it.
template <class Scalar, int Rows>
void LemkeAlgorithm<Scalar, Rows>::RecordPoint(int row) {
  stiction::Pivot<Scalar>& pivot = trace_->pivots.back();
  Extract();
  pivot.s = Value(row) * UnitOf(basis_[row]);
  pivot.f = f_;
  pivot.a = a_;
  pivot.cover = Scalar(0);
  for (int i = 0; i < size_; ++i) {
    if (basis_[i] == Artificial()) pivot.cover = Value(i) * unit_b_;
  }
}

}  // namespace stiction
