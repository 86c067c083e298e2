// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h: the cells of a contact, each with its unknowns and facets.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_CELLS_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_CELLS_IPP_

#include "solver/complete/complete.h"

namespace stiction {

template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::Size(int contact) const {
  return problem_->contacts[contact].HasFrictionRows() ? problem_->dimension : 1;
}

template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::HasFriction(int contact) const {
  return problem_->contacts[contact].kind == ContactKind::kStatic && Sign(problem_->contacts[contact].mu) > 0;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetCell(int contact, const LawCell& cell) {
  word_[contact] = cell;
  SetUnknowns(contact, cell);
  if (contact == driven_) SetDriven();
  SetFacets(contact, cell);
}

// ---- Unknowns --------------------------------------------------------------------------------

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetUnknowns(int contact, const LawCell& cell) {
  const int row = RowOf(contact), size = Size(contact);
  const auto unit = [](int r) { return RowCombination<Scalar>::Unit(r); };
  for (int r = 0; r < size; ++r) unknowns_.rests[row + r].size = 0;
  switch (cell.law) {
    case Law::kNone:
    case Law::kBreak:
      return;
    case Law::kHold:
      if (cell.side == 0) unknowns_.Add(row, unit(row), unit(row));
      return;
    case Law::kFree:
      return unknowns_.Add(row, FreeForce(contact), unit(row));
    case Law::kEdge: {
      const RowCombination<Scalar> edge = Tangential(contact, (*polygons_)[contact].edge(cell.side));
      unknowns_.Add(row + 1, edge, edge);
      [[fallthrough]];
    }
    case Law::kCorner:
      return unknowns_.Add(row, CornerForce(contact, cell.side), unit(row));
    case Law::kInside:
      for (int r = 0; r < size; ++r) unknowns_.Add(row + r, unit(row + r), unit(row + r));
  }
}

// The driven force: fN, friction in a corner per unit of rho, or inside nothing.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetDriven() {
  const LawCell& cell = word_[driven_];
  if (stage_ == Stage::kNormal) {
    unknowns_.driven = FreeForce(driven_);
  } else if (cell.law == Law::kInside) {
    unknowns_.driven = {};
  } else {
    unknowns_.driven = Radial(driven_, cell.side);
  }
}

// The force of a contact per unit of its normal force, where that alone determines it: (24).
template <class Scalar, int Rows>
RowCombination<Scalar> CompleteDriving<Scalar, Rows>::FreeForce(int contact) const {
  const auto& law = problem_->contacts[contact];
  if (law.kind != ContactKind::kSliding) return RowCombination<Scalar>::Unit(RowOf(contact));
  return {RowOf(contact),
          Size(contact),
          false,
          {Scalar(1), Scalar(-law.mu * law.slip[0]), Scalar(-law.mu * law.slip[1])}};
}

// The force of a corner per unit of fN; while friction is driven, fN alone.
template <class Scalar, int Rows>
RowCombination<Scalar> CompleteDriving<Scalar, Rows>::CornerForce(int contact, int k) const {
  const int row = RowOf(contact);
  if (FrictionIsDriven(contact)) return RowCombination<Scalar>::Unit(row);
  const Scalar& mu = problem_->contacts[contact].mu;
  if (!InSpace()) return {row, 2, false, {Scalar(1), k == 0 ? mu : Scalar(-mu)}};
  const Planar<Scalar>& corner = (*polygons_)[contact].corner(k);
  return {row, 3, false, {Scalar(1), Scalar(mu * corner[0]), Scalar(mu * corner[1])}};
}

template <class Scalar, int Rows>
RowCombination<Scalar> CompleteDriving<Scalar, Rows>::Tangential(int contact, const Planar<Scalar>& v) const {
  return {RowOf(contact) + 1, 2, false, {v[0], v[1]}};
}

template <class Scalar, int Rows>
RowCombination<Scalar> CompleteDriving<Scalar, Rows>::Radial(int contact, int k) const {
  if (InSpace()) return Tangential(contact, (*polygons_)[contact].corner(k));
  if (k == 0) return RowCombination<Scalar>::Unit(RowOf(contact) + 1);
  return {RowOf(contact) + 1, 1, false, {Scalar(-1)}};
}

// ---- Facets ----------------------------------------------------------------------------------

// The facet where the stage starts: fN = 0 or rho = 0.
template <class Scalar, int Rows>
auto CompleteDriving<Scalar, Rows>::DrivenAmount() const -> Facet {
  const Kind kind = stage_ == Stage::kFriction ? Kind::kRadius : Kind::kForce;
  return {kind, driven_, 0, 1, Beyond::kStart, {}};
}

// The facet where it ends: aN = 0, or rho = mu fN in the present cell.
template <class Scalar, int Rows>
auto CompleteDriving<Scalar, Rows>::StageEnd() const -> Facet {
  if (stage_ == Stage::kFriction) return {Kind::kRest, driven_, 0, 1, Beyond::kEnd, word_[driven_]};
  return {Kind::kAcceleration, driven_, 0, -1, Beyond::kEnd, {Law::kFree, 0}};
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetFacets(int contact, const LawCell& cell) {
  using enum Facet::Kind;
  auto& facets = facets_[contact];
  facets.clear();
  const auto add = [&](Kind kind, int k, const LawCell& to) {
    facets.push_back({kind, contact, k, 1, Beyond::kCell, to});
  };
  const int k = cell.side;
  switch (cell.law) {
    case Law::kNone:
      if (contact == driven_) facets = {DrivenAmount(), StageEnd()};
      return;
    case Law::kHold:
      return;
    case Law::kBreak:
      add(kAcceleration, 0, {Law::kFree, 0});
      if (HasFriction(contact)) facets.back().beyond = Beyond::kCorners;
      return;
    case Law::kFree:
      return add(kForce, 0, {Law::kBreak, 0});
    case Law::kCorner:
      SetCornerFacets(contact, k);
      break;
    case Law::kEdge: {
      add(kFromCorner, k, {Law::kCorner, k});
      add(kToCorner, k, {Law::kCorner, (*polygons_)[contact].Wrap(k + 1)});
      add(kOpposed, k, {Law::kInside, 0});
      break;
    }
    case Law::kInside: {
      const int sides = InSpace() ? (*polygons_)[contact].sides() : 2;
      for (int j = 0; j < sides; ++j) add(kBound, j, {InSpace() ? Law::kEdge : Law::kCorner, j});
    }
  }
  if (FrictionIsDriven(contact)) facets.push_back(StageEnd());
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetCornerFacets(int contact, int k) {
  auto& facets = facets_[contact];
  const bool driven = FrictionIsDriven(contact);
  if (driven) {
    facets.push_back(DrivenAmount());
  } else {
    facets.push_back({Kind::kForce, contact, 0, 1, Beyond::kCell, {Law::kBreak, 0}});
  }
  if (!InSpace()) {
    const Beyond beyond = driven ? Beyond::kEnd : Beyond::kCell;
    facets.push_back({Kind::kOpposed, contact, k, 1, beyond, {Law::kInside, 0}});
    return;
  }
  const int before = (*polygons_)[contact].Wrap(k - 1);
  facets.push_back({Kind::kAlong, contact, k, 1, Beyond::kCell, {Law::kEdge, k}});
  facets.push_back({Kind::kAlong, contact, before, -1, Beyond::kCell, {Law::kEdge, before}});
}

// The corner where fF.aF is least, at the present point, which lies on the facet `at`.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::CornerAt(int contact, const Facet& at) {
  if (!InSpace()) return SignAt(at, {Kind::kOpposed, contact}) > 0 ? 0 : 1;
  const int sides = (*polygons_)[contact].sides();
  int before = SignAt(at, {Kind::kAlong, contact, sides - 1});
  for (int k = 0; k < sides && !Ended(); ++k) {
    const int after = SignAt(at, {Kind::kAlong, contact, k});
    if (before < 0 && after > 0) return k;
    before = after;
  }
  if (!Ended()) Impossible("no corner opposes the acceleration");
  return 0;
}

// ---- Values ----------------------------------------------------------------------------------

// n_k.x, where the tangential components of x are at(1) and at(2).
template <class Scalar, int Rows>
template <class At>
Scalar CompleteDriving<Scalar, Rows>::Outward(int contact, int k, At at) const {
  if (!InSpace()) {
    if (k == 0) return at(1);
    return -at(1);
  }
  const Planar<Scalar>& edge = (*polygons_)[contact].edge(k);
  return edge[1] * at(1) - edge[0] * at(2);
}

// The facet function, given the force, the acceleration and the radius of its contact. It is linear in these.
template <class Scalar, int Rows>
template <class Force, class Acceleration>
Scalar CompleteDriving<Scalar, Rows>::Evaluate(const Facet& facet, Force f, Acceleration a,
                                               const Scalar& radius) const {
  const int i = facet.contact, k = facet.k;
  const Scalar& mu = problem_->contacts[i].mu;
  Scalar value(0);
  switch (facet.kind) {
    case Kind::kForce:
      return f(0);
    case Kind::kRadius:
      return radius;
    case Kind::kRest:
      return mu * f(0) - radius;
    case Kind::kSide:
      return Outward(i, k, f);
    case Kind::kOpposed:
      return -Outward(i, k, a);
    case Kind::kBound:
      value = FrictionIsDriven(i) ? radius : Scalar(mu * f(0));
      if (InSpace()) value *= (*polygons_)[i].reach(k);
      return value - Outward(i, k, f);
    case Kind::kFromCorner:
      return stiction::Cross((*polygons_)[i].corner(k), Planar<Scalar>{f(1), f(2)});
    case Kind::kToCorner:
      return stiction::Cross(Planar<Scalar>{f(1), f(2)}, (*polygons_)[i].corner(k + 1));
    case Kind::kAlong:
      value = Dot((*polygons_)[i].edge(k), Planar<Scalar>{a(1), a(2)});
      break;
    case Kind::kAcceleration:
      value = a(0);
  }
  return facet.sign > 0 ? value : Scalar(-value);
}

template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::Value(const Facet& facet, const Vector& f, const Vector& a,
                                            const Scalar& radius) const {
  const int row = RowOf(facet.contact);
  return Evaluate(
      facet, [&](int r) -> const Scalar& { return f[row + r]; },
      [&](int r) -> const Scalar& { return a[row + r]; }, radius);
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_CELLS_IPP_
