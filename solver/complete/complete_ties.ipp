// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h: facet functions, and their signs under the symbolic perturbation of b
// (complete_driving.md, part 5).

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_TIES_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_TIES_IPP_

#include <vector>

#include "solver/complete/complete.h"
#include "solver/linear/elimination.ipp"

namespace stiction {

template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::Value(const Facet& facet, const Vector& f, const Vector& a) const {
  const int row = facet.row;
  Scalar value = facet.kind == Facet::Kind::kAcceleration ? a[row] : f[row];
  if (facet.kind == Facet::Kind::kBound) {
    const Scalar bound = problem_->contacts[layout_.ContactOf(row)].mu * f[row - 1];
    return facet.sign > 0 ? Scalar(bound - value) : Scalar(bound + value);
  }
  return facet.sign > 0 ? value : Scalar(-value);
}

// The sign of `of` at the present point, which lies on the facet `at` of the present cell.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::SignAt(const Facet& at, const Facet& of) {
  const Scalar& tolerance = of.kind == Facet::Kind::kAcceleration ? scale_.acceleration : scale_.force;
  int sign = Sign(Value(of, state_.f, state_.a), tolerance);
  if (sign != 0) return sign;
  ++verdict_.statistics.ties;
  sign = FirstSign(Gradient(at, of), of.kind);
  if (sign == 0) Impossible("a sign");
  return sign;
}

// The sign of (eps0 e_N + (eps1, eps2, ...)) . gradient for eps0 >> eps1 >> ... > 0 (part 5). Rates of forces
// and of distances are in the unit of 1 / A, those of accelerations are ratios.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::FirstSign(const Row& gradient, Facet::Kind kind) const {
  Scalar tolerance = scale_.pivot;
  if constexpr (!kIsExact<Scalar>) {
    if (kind != Facet::Kind::kAcceleration) tolerance *= scale_.pivot / scale_.rate;
  }
  Scalar normals = Scalar(0);
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
    normals += gradient[layout_.NormalRowOf(contact)];
  }
  int sign = Sign(normals, tolerance);
  for (int row = 0; row < problem_->rows() && sign == 0; ++row) sign = Sign(gradient[row], tolerance);
  return sign;
}

// f_row per unit of the unknown of `column`: friction at a limit goes with its normal.
template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::ForceCoefficient(int row, int column) const {
  if (row == column) return Scalar(1);
  const int limit = row == column + 1 ? FrictionLimitSign(layout_, state_.sets, column) : 0;
  if (limit == 0) return Scalar(0);
  return Scalar(limit) * problem_->contacts[layout_.ContactOf(column)].mu;
}

template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::Coefficient(const Facet& facet, int column) const {
  const int row = facet.row;
  const Scalar sign(facet.sign);
  switch (facet.kind) {
    case Facet::Kind::kForce:
      return sign * ForceCoefficient(row, column);
    case Facet::Kind::kBound:
      return problem_->contacts[layout_.ContactOf(row)].mu * ForceCoefficient(row - 1, column) -
             sign * ForceCoefficient(row, column);
    case Facet::Kind::kAcceleration:
      break;
  }
  Scalar rate = problem_->A(row, column);
  const int limit = FrictionLimitSign(layout_, state_.sets, column);
  if (limit != 0) rate += ForceCoefficient(column + 1, column) * problem_->A(row, column + 1);
  return sign * rate;
}

// The point solves G u = -(b of the equations): the equations are a = 0 for the unknowns' rows, and the facet
// `at`; u are the forces of the unknowns and of the driven variable. So the gradient takes one solution of
// the transposed system, G' y = (coefficients of `of`).
template <class Scalar, int Rows>
auto CompleteDriving<Scalar, Rows>::Gradient(const Facet& at, const Facet& of) const -> Row {
  std::vector<Facet> equations;
  std::vector<int> columns;
  for (int row = 0; row < driven_; ++row) {
    if (!IsUnknown(state_.sets[row])) continue;
    equations.push_back({Facet::Kind::kAcceleration, row, 1});
    columns.push_back(row);
  }
  equations.push_back(at);
  columns.push_back(driven_);
  const int size = static_cast<int>(columns.size());
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(size, size + 1);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) M(i, j) = Coefficient(equations[j], columns[i]);
    M(i, size) = Coefficient(of, columns[i]);
  }
  Row gradient(problem_->rows());
  for (int row = 0; row < problem_->rows(); ++row) gradient[row] = Scalar(0);
  Elimination<Scalar> system;
  system.Assign(M);
  system.Run(size, size, size + 1);
  if (system.rank() < size) return gradient;  // has no sign
  system.BackSubstitute(size);
  const auto add = [&gradient](const Facet& facet, const Scalar& factor) {
    if (facet.kind == Facet::Kind::kAcceleration) gradient[facet.row] += Scalar(facet.sign) * factor;
  };
  add(of, Scalar(1));
  for (int i = 0; i < size; ++i) add(equations[i], Scalar(-system.Solution(i)));
  return gradient;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_TIES_IPP_
