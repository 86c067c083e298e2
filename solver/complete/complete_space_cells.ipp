// SPDX-License-Identifier: Apache-2.0
// Definitions for complete_space.h: the cells of a contact, each with its unknowns, equations and facets.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_CELLS_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_CELLS_IPP_

#include <utility>

#include "solver/complete/complete_space.h"

namespace stiction {

template <class Scalar>
bool SpatialDriving<Scalar>::HasFriction(int contact) const {
  return problem_->contacts[contact].kind == ContactKind::kStatic && Sign(problem_->contacts[contact].mu) > 0;
}

// The force of a contact per unit of its normal force, where that alone determines it: (24).
template <class Scalar>
auto SpatialDriving<Scalar>::FreeColumn(int contact) const -> Triple {
  const auto& law = problem_->contacts[contact];
  if (law.kind != ContactKind::kSliding) return {Scalar(1), Scalar(0), Scalar(0)};
  return {Scalar(1), Scalar(-law.mu * law.slip[0]), Scalar(-law.mu * law.slip[1])};
}

template <class Scalar>
void SpatialDriving<Scalar>::SetCell(int contact, const SpaceCell& cell) {
  word_[contact] = cell;
  shapes_[contact] = ShapeOf(contact, cell);
}

template <class Scalar>
auto SpatialDriving<Scalar>::ShapeOf(int contact, const SpaceCell& cell) const -> Shape {
  const Scalar zero(0), one(1);
  const Triple normal = {one, zero, zero}, x = {zero, one, zero}, y = {zero, zero, one};
  const bool driven = contact == driven_ && stage_ == SpaceStage::kFriction;
  const FrictionPolygon<Scalar>& polygon = (*polygons_)[contact];
  const Scalar& mu = problem_->contacts[contact].mu;
  const int k = cell.side;
  Shape shape;
  const auto force = [&](Triple factors, Beyond beyond, SpaceCell to = {}, Scalar radius = Scalar(0)) {
    shape.facets.push_back(
        {contact, std::move(factors), {zero, zero, zero}, std::move(radius), false, beyond, to});
  };
  const auto acceleration = [&](Triple factors, Beyond beyond, SpaceCell to = {}) {
    shape.facets.push_back({contact, {zero, zero, zero}, std::move(factors), zero, true, beyond, to});
  };
  const auto tangential = [&](const Planar<Scalar>& v) { return Triple{zero, v[0], v[1]}; };
  const auto opposite = [&](const Planar<Scalar>& v) { return Triple{zero, Scalar(-v[0]), Scalar(-v[1])}; };
  // The force of a corner per unit of fN; while friction is driven, fN alone.
  const auto corner = [&] {
    if (driven) return normal;
    return Triple{one, Scalar(mu * polygon.corner(k)[0]), Scalar(mu * polygon.corner(k)[1])};
  };
  switch (cell.law) {
    case Law::kNone:
      if (contact == driven_ && stage_ == SpaceStage::kNormal) shape.facets = {DrivenAmount(), StageEnd()};
      return shape;
    case Law::kHold:
      if (cell.side == 0) shape.columns = shape.rows = {normal};
      return shape;
    case Law::kBreak:
      if (HasFriction(contact)) {
        acceleration(normal, Beyond::kCorners);
      } else {
        acceleration(normal, Beyond::kCell, {Law::kFree, 0});
      }
      return shape;
    case Law::kFree:
      shape.columns = {FreeColumn(contact)};
      shape.rows = {normal};
      force(normal, Beyond::kCell, {Law::kBreak, 0});
      return shape;
    case Law::kCorner:
      shape.columns = {corner()};
      shape.rows = {normal};
      if (driven) {
        shape.facets.push_back(DrivenAmount());
      } else {
        force(normal, Beyond::kCell, {Law::kBreak, 0});
      }
      acceleration(tangential(polygon.edge(k)), Beyond::kCell, {Law::kEdge, k});
      acceleration(opposite(polygon.edge(k - 1)), Beyond::kCell, {Law::kEdge, polygon.Wrap(k - 1)});
      break;
    case Law::kEdge: {
      const Planar<Scalar>&from = polygon.corner(k), &to = polygon.corner(k + 1);
      shape.columns = {corner(), tangential(polygon.edge(k))};
      shape.rows = {normal, tangential(polygon.edge(k))};
      // The cross products of fF with both corners: the shares of the other one.
      force({zero, Scalar(-from[1]), from[0]}, Beyond::kCell, {Law::kCorner, k});
      force({zero, to[1], Scalar(-to[0])}, Beyond::kCell, {Law::kCorner, polygon.Wrap(k + 1)});
      acceleration(opposite(polygon.normal(k)), Beyond::kCell, {Law::kInside, 0});
      break;
    }
    case Law::kInside:
      shape.columns = shape.rows = {normal, x, y};
      for (int j = 0; j < polygon.sides(); ++j) {
        Triple factors = opposite(polygon.normal(j));
        if (!driven) factors[0] = mu * polygon.reach(j);
        force(std::move(factors), Beyond::kCell, {Law::kEdge, j}, driven ? polygon.reach(j) : zero);
      }
      break;
  }
  if (driven) shape.facets.push_back(StageEnd());
  return shape;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_CELLS_IPP_
