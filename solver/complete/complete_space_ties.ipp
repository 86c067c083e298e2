// SPDX-License-Identifier: Apache-2.0
// Definitions for complete_space.h: linear functions of (f, a), and their signs under the symbolic perturbation
// of b (complete_driving.md, parts 5 and 9).

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_TIES_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_TIES_IPP_

#include <utility>

#include "solver/complete/complete_space.h"

namespace stiction {

// Columns and equations of the present cell, the column of the driven amount last.
template <class Scalar>
void SpatialDriving<Scalar>::Assemble() {
  columns_.clear();
  equations_.clear();
  for (int i = 0; i < static_cast<int>(shapes_.size()); ++i) {
    for (const Triple& column : shapes_[i].columns)
      columns_.push_back({i, column, Scalar(0), Image(i, column)});
    for (const Triple& row : shapes_[i].rows) equations_.push_back({i, row});
  }
  if (driven_ == static_cast<int>(word_.size())) return;
  Column driven = {driven_, FreeColumn(driven_), Scalar(0), {}};
  if (stage_ == SpaceStage::kFriction) {
    const SpaceCell& cell = word_[driven_];
    driven.force = {Scalar(0), Scalar(0), Scalar(0)};
    driven.radius = Scalar(1);
    if (cell.law != Law::kInside) {
      const Planar<Scalar>& corner = (*polygons_)[driven_].corner(cell.side);
      driven.force = {Scalar(0), corner[0], corner[1]};
    }
  }
  driven.image = Image(driven_, driven.force);
  columns_.push_back(std::move(driven));
}

// A times the force of one contact.
template <class Scalar>
auto SpatialDriving<Scalar>::Image(int contact, const Triple& force) const -> Vector {
  Vector image = Vector::Constant(problem_->rows(), Scalar(0));
  for (int r = 0; r < Size(contact); ++r) {
    if (Sign(force[r]) == 0) continue;
    const int column = first_row_[contact] + r;
    for (int row = 0; row < problem_->rows(); ++row) image[row] += problem_->A(row, column) * force[r];
  }
  return image;
}

template <class Scalar>
Scalar SpatialDriving<Scalar>::Along(int contact, const Triple& row, const Vector& values) const {
  Scalar sum(0);
  for (int r = 0; r < Size(contact); ++r) {
    if (Sign(row[r]) != 0) sum += row[r] * values[first_row_[contact] + r];
  }
  return sum;
}

template <class Scalar>
Scalar SpatialDriving<Scalar>::Value(const Facet& facet, const Vector& f, const Vector& a,
                                     const Scalar& radius) const {
  if (facet.of_acceleration) return Along(facet.contact, facet.acceleration, a);
  return Along(facet.contact, facet.force, f) + facet.radius * radius;
}

// The rate of a facet function with the unknown of a column.
template <class Scalar>
Scalar SpatialDriving<Scalar>::Coefficient(const Facet& facet, const Column& column) const {
  if (facet.of_acceleration) return Along(facet.contact, facet.acceleration, column.image);
  Scalar rate = facet.radius * column.radius;
  if (facet.contact != column.contact) return rate;
  for (int r = 0; r < Size(column.contact); ++r) rate += facet.force[r] * column.force[r];
  return rate;
}

// The sign of `of` at the present point, which lies on the facet `at` of the present cell.
template <class Scalar>
int SpatialDriving<Scalar>::SignAt(const Facet& at, const Facet& of) {
  int sign = Sign(Present(of), of.of_acceleration ? scale_.acceleration : scale_.force);
  if (sign != 0) return sign;
  ++verdict_.statistics.ties;
  sign = FirstSign(Gradient(at, of), of.of_acceleration);
  if (sign == 0) Impossible("a sign");
  return sign;
}

// Rates of change, with b, of `of` at the point of the present cell on the facet `at`: that point solves the
// k equations of the cell and at = 0, and a combination of these with the factors y has the rates of `of`.
template <class Scalar>
auto SpatialDriving<Scalar>::Gradient(const Facet& at, const Facet& of) -> Row {
  Assemble();
  const int k = static_cast<int>(equations_.size());
  RowMajorMatrix<Scalar> M(k + 1, k + 2);
  for (int j = 0; j <= k; ++j) {
    for (int i = 0; i < k; ++i) M(j, i) = Along(equations_[i].contact, equations_[i].row, columns_[j].image);
    M(j, k) = Coefficient(at, columns_[j]);
    M(j, k + 1) = Coefficient(of, columns_[j]);
  }
  Row gradient = Row::Constant(problem_->rows(), Scalar(0));
  const auto z = OrientedNullVector(M, scale_.rate);
  if (!z || Sign(z->back()) == 0) return gradient;  // has no sign
  const auto add = [&](int contact, const Triple& row, const Scalar& factor) {
    for (int r = 0; r < Size(contact); ++r) gradient[first_row_[contact] + r] += factor * row[r];
  };
  const Scalar scale = Scalar(1) / z->back();
  if (of.of_acceleration) add(of.contact, of.acceleration, Scalar(1));
  for (int i = 0; i < k; ++i) add(equations_[i].contact, equations_[i].row, Scalar((*z)[i] * scale));
  if (at.of_acceleration) add(at.contact, at.acceleration, Scalar((*z)[k] * scale));
  return gradient;
}

// The sign of (eps0 e_N + (eps1, eps2, ...)).gradient for eps0 >> eps1 >> ... > 0. Bilateral rows have no
// infinitesimal: they are equations.
template <class Scalar>
int SpatialDriving<Scalar>::FirstSign(const Row& gradient, bool of_acceleration) const {
  Scalar tolerance = scale_.pivot;
  if constexpr (!kIsExact<Scalar>) {
    if (!of_acceleration) tolerance *= scale_.pivot / scale_.rate;
  }
  const auto held = [this](std::size_t i) { return problem_->contacts[i].kind == ContactKind::kBilateral; };
  Scalar normals(0);
  for (std::size_t i = 0; i < word_.size(); ++i) {
    if (!held(i)) normals += gradient[first_row_[i]];
  }
  int sign = Sign(normals, tolerance);
  for (std::size_t i = 0; i < word_.size(); ++i) {
    for (int row = first_row_[i]; row < first_row_[i + 1] && sign == 0 && !held(i); ++row) {
      sign = Sign(gradient[row], tolerance);
    }
  }
  return sign;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_TIES_IPP_
