// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h: the cells of a contact, each with its unknowns and facets.

#pragma once

#include <utility>

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
void CompleteDriving<Scalar, Rows>::SetCell(int contact, LawCell cell) {
  const Law from = std::exchange(word_[contact], cell).law;
  if (from != Law::kNone || cell.law != Law::kNone) SetUnknowns(contact, cell);
  if (contact == driven_) SetDriven();
}

// ---- Unknowns --------------------------------------------------------------------------------

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetUnknowns(int contact, LawCell cell) {
  const int row = RowOf(contact), size = Size(contact);
  auto& forces = unknowns_.forces;
  auto& rests = unknowns_.rests;
  for (int r = 0; r < size; ++r) rests[row + r].size = 0;
  if (cell.law == Law::kNone || cell.law == Law::kBreak) return;
  if (cell.law != Law::kHold || cell.side == 0) rests[row].SetUnit(row);
  if (cell.law == Law::kHold) return forces[row].SetUnit(row);
  if (cell.law == Law::kFree) return SetFreeForce(contact, forces[row]);
  if (cell.law == Law::kInside) {
    for (int r = row; r < row + size; ++r) {
      forces[r].SetUnit(r);
      rests[r].SetUnit(r);
    }
    return;
  }
  SetCornerForce(contact, cell.side, forces[row]);
  if (cell.law != Law::kEdge) return;
  const Planar<Scalar>& edge = (*polygons_)[contact].edge(cell.side);
  forces[row + 1].Set(row + 1, edge[0], edge[1]);
  rests[row + 1].Set(row + 1, edge[0], edge[1]);
}

// The driven force: fN, friction in a corner per unit of rho, or inside nothing.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetDriven() {
  const LawCell& cell = word_[driven_];
  if (stage_ == Stage::kNormal) {
    SetFreeForce(driven_, unknowns_.driven);
  } else if (cell.law == Law::kInside) {
    unknowns_.driven.Set(0);
  } else {
    SetRadial(driven_, cell.side, unknowns_.driven);
  }
}

// The force of a contact per unit of its normal force, where that alone determines it: (24).
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetFreeForce(int contact, RowCombination<Scalar>& force) const {
  const auto& law = problem_->contacts[contact];
  if (law.kind != ContactKind::kSliding) return force.SetUnit(RowOf(contact));
  force.Set(RowOf(contact), Scalar(1), Scalar(-law.mu * law.slip[0]), Scalar(-law.mu * law.slip[1]));
}

// The force of a corner per unit of fN; while friction is driven, fN alone.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetCornerForce(int contact, int k, RowCombination<Scalar>& force) const {
  const int row = RowOf(contact);
  if (FrictionIsDriven(contact)) return force.SetUnit(row);
  const Scalar& mu = problem_->contacts[contact].mu;
  if (!InSpace()) return force.Set(row, Scalar(1), k == 0 ? mu : Scalar(-mu));
  const Planar<Scalar>& corner = (*polygons_)[contact].corner(k);
  force.Set(row, Scalar(1), Scalar(mu * corner[0]), Scalar(mu * corner[1]));
}

// Friction in a corner, per unit of the radius.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SetRadial(int contact, int k, RowCombination<Scalar>& force) const {
  const int row = RowOf(contact) + 1;
  if (!InSpace()) return k == 0 ? force.SetUnit(row) : force.Set(row, Scalar(-1));
  const Planar<Scalar>& corner = (*polygons_)[contact].corner(k);
  force.Set(row, corner[0], corner[1]);
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

// visit(kind, facet) for those of the present cell. The kinds of the plane are KindIs.
// Not a switch: a jump by a table is foreseen wrongly half of the time.
template <class Scalar, int Rows>
template <class Visit>
void CompleteDriving<Scalar, Rows>::ForEachFacet(int contact, Visit visit) const {
  const LawCell& cell = word_[contact];
  const int k = cell.side;
  const auto add = [&](auto kind, int k, LawCell to) {
    visit(kind, Facet(kind, contact, k, 1, Beyond::kCell, to));
  };
  if (cell.law == Law::kNone) {
    if (contact != driven_) return;
    visit(KindIs<Kind::kForce>(), DrivenAmount());
    return visit(KindIs<Kind::kAcceleration>(), StageEnd());
  }
  if (cell.law == Law::kBreak) {
    const KindIs<Kind::kAcceleration> kind;
    const Beyond beyond = HasFriction(contact) ? Beyond::kCorners : Beyond::kCell;
    return visit(kind, Facet(kind, contact, 0, 1, beyond, {Law::kFree, 0}));
  }
  if (cell.law < Law::kCorner) {
    if (cell.law == Law::kFree) add(KindIs<Kind::kForce>(), 0, {Law::kBreak, 0});
    return;
  }
  if (cell.law == Law::kCorner) {
    ForEachCornerFacet(contact, k, visit);
  } else if (cell.law == Law::kInside) {
    const int sides = InSpace() ? (*polygons_)[contact].sides() : 2;
    for (int j = 0; j < sides; ++j) add(KindIs<Kind::kBound>(), j, {InSpace() ? Law::kEdge : Law::kCorner, j});
  } else {
    add(Kind::kFromCorner, k, {Law::kCorner, k});
    add(Kind::kToCorner, k, {Law::kCorner, (*polygons_)[contact].Wrap(k + 1)});
    add(Kind::kOpposed, k, {Law::kInside, 0});
  }
  if (FrictionIsDriven(contact)) visit(KindIs<Kind::kRest>(), StageEnd());
}

template <class Scalar, int Rows>
template <class Visit>
void CompleteDriving<Scalar, Rows>::ForEachCornerFacet(int contact, int k, Visit visit) const {
  const bool driven = FrictionIsDriven(contact);
  if (driven) {
    visit(KindIs<Kind::kRadius>(), DrivenAmount());
  } else {
    visit(KindIs<Kind::kForce>(), Facet(Kind::kForce, contact, 0, 1, Beyond::kCell, {Law::kBreak, 0}));
  }
  if (!InSpace()) {
    const KindIs<Kind::kOpposed> kind;
    return visit(kind, Facet(kind, contact, k, 1, driven ? Beyond::kEnd : Beyond::kCell, {Law::kInside, 0}));
  }
  const int before = (*polygons_)[contact].Wrap(k - 1);
  visit(Kind::kAlong, Facet(Kind::kAlong, contact, k, 1, Beyond::kCell, {Law::kEdge, k}));
  visit(Kind::kAlong, Facet(Kind::kAlong, contact, before, -1, Beyond::kCell, {Law::kEdge, before}));
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
Scalar CompleteDriving<Scalar, Rows>::SpatialValue(const Facet& facet, const Vector& f, const Vector& a,
                                                   const Scalar& radius) const {
  const int row = RowOf(facet.contact);
  return Evaluate(
      facet, [&](int r) -> const Scalar& { return f[row + r]; },
      [&](int r) -> const Scalar& { return a[row + r]; }, radius);
}

// The same in the plane, where each is one row's, or two. Kind: KindIs, or the facet's.
template <class Scalar, int Rows>
template <class OfKind>
Scalar CompleteDriving<Scalar, Rows>::PlanarValue(OfKind kind, const Facet& facet, const Vector& f,
                                                  const Vector& a, const Scalar& radius) const {
  const int row = RowOf(facet.contact);
  const auto oriented = [](bool plus, const Scalar& x) { return plus ? x : Scalar(-x); };
  if (kind == Kind::kForce) return f[row];
  if (kind == Kind::kRadius) return radius;
  if (kind == Kind::kAcceleration || kind == Kind::kOpposed) {
    const bool normal = kind == Kind::kAcceleration;
    return oriented(normal ? facet.sign > 0 : facet.k != 0, a[normal ? row : row + 1]);
  }
  if (kind == Kind::kSide) return oriented(facet.k == 0, f[row + 1]);
  const Scalar& mu = problem_->contacts[facet.contact].mu;
  if (kind == Kind::kRest) return mu * f[row] - radius;
  const Scalar bound = FrictionIsDriven(facet.contact) ? radius : Scalar(mu * f[row]);
  return facet.k == 0 ? Scalar(bound - f[row + 1]) : Scalar(bound + f[row + 1]);
}

}  // namespace stiction
