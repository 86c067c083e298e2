// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h: signs of facet functions under the symbolic perturbation of b
// (complete_driving.md, part 5).

#pragma once

#include <vector>

#include "solver/complete/complete.h"
#include "solver/linear/elimination.ipp"

namespace stiction {

// The sign of `of` at the present point, which lies on the facet `at` of the present cell.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::SignAt(const Facet& at, const Facet& of) {
  const bool of_acceleration = of.OfAcceleration();
  int sign = Sign(Present(of), of_acceleration ? scale_.acceleration : scale_.force);
  if (sign != 0) return sign;
  ++verdict_.statistics[Counter::kTies];
  sign = FirstSign(Gradient(at, of), of_acceleration);
  if (sign == 0) Impossible("a sign");
  return sign;
}

// The sign of (eps0 e_N + (eps1, eps2, ...)) . gradient for eps0 >> eps1 >> ... > 0 (part 5). Rates of forces
// and of distances are in the unit of 1 / A, those of accelerations are ratios. Bilateral rows have no
// infinitesimal: they are equations.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::FirstSign(const Row& gradient, bool of_acceleration) const {
  Scalar tolerance = scale_.pivot;
  if constexpr (!kIsExact<Scalar>) {
    if (!of_acceleration) tolerance *= scale_.pivot / scale_.rate;
  }
  const int contacts = static_cast<int>(word_.size());
  Scalar normals = Scalar(0);
  for (int i = 0; i < contacts; ++i) {
    if (!IsBilateral(i)) normals += gradient[RowOf(i)];
  }
  int sign = Sign(normals, tolerance);
  for (int i = 0; i < contacts; ++i) {
    if (IsBilateral(i)) continue;
    for (int row = RowOf(i), end = row + Size(i); row < end && sign == 0; ++row)
      sign = Sign(gradient[row], tolerance);
  }
  return sign;
}

// The rate of a facet function with the unknown of a force. `driven`: that is the driven amount.
template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::Coefficient(const Facet& facet, const RowCombination<Scalar>& force,
                                                  bool driven) const {
  const int row = RowOf(facet.contact);
  const auto component = [&](int r) {
    const int s = row + r - force.row;
    if (s < 0 || s >= force.size) return Scalar(0);
    return force.unit ? Scalar(1) : force.factors[s];
  };
  const auto image = [&](int r) { return RowTimes<Scalar>(problem_->A, row + r, force); };
  return Evaluate(facet, component, image, Scalar(driven && stage_ == Stage::kFriction ? 1 : 0));
}

// The point solves G u = -(b of the equations): the equations are those of the unknowns, and the facet `at`; u
// are the unknowns and the driven amount. So the gradient takes one solution of the transposed system, G' y =
// (coefficients of `of`).
template <class Scalar, int Rows>
auto CompleteDriving<Scalar, Rows>::Gradient(const Facet& at, const Facet& of) const -> Row {
  std::vector<int> rows;
  for (int row = 0; row < problem_->rows(); ++row) {
    if (unknowns_.IsUnknown(row)) rows.push_back(row);
  }
  const int size = static_cast<int>(rows.size());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(size + 1, size + 2);
  for (int i = 0; i <= size; ++i) {
    const bool driven = i == size;
    const RowCombination<Scalar>& force = driven ? unknowns_.Driven() : unknowns_.Force(rows[i]);
    for (int j = 0; j < size; ++j) M(i, j) = EntryOf<Scalar>(unknowns_.Rest(rows[j]), problem_->A, force);
    M(i, size) = Coefficient(at, force, driven);
    M(i, size + 1) = Coefficient(of, force, driven);
  }
  Row gradient(problem_->rows());
  for (int row = 0; row < problem_->rows(); ++row) gradient[row] = Scalar(0);
  Elimination<Scalar> system;
  system.Assign(M);
  system.Run(size + 1, size + 1, size + 2);
  if (system.rank() <= size) return gradient;  // has no sign
  system.BackSubstitute(size + 1);
  AddGradient(of, Scalar(1), gradient);
  for (int i = 0; i < size; ++i) AddTo<Scalar>(gradient, unknowns_.Rest(rows[i]), Scalar(-system.Solution(i)));
  AddGradient(at, Scalar(-system.Solution(size)), gradient);
  return gradient;
}

// b moves accelerations alone.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::AddGradient(const Facet& facet, const Scalar& factor, Row& gradient) const {
  if (!facet.OfAcceleration()) return;
  const auto none = [](int) { return Scalar(0); };
  for (int r = 0; r < Size(facet.contact); ++r) {
    const auto unit = [r](int component) { return Scalar(component == r ? 1 : 0); };
    gradient[RowOf(facet.contact) + r] += factor * Evaluate(facet, none, unit, Scalar(0));
  }
}

}  // namespace stiction
