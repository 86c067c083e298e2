// SPDX-License-Identifier: Apache-2.0
// Definitions for complete_space.h.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_IPP_

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "solver/complete/complete_space.h"
#include "solver/complete/complete_space_cells.ipp"
#include "solver/complete/complete_space_ties.ipp"
#include "solver/complete/polygon_residual.h"

namespace stiction {

// ---- The run: from node to node --------------------------------------------------------------

template <class Scalar>
CompleteVerdict SpatialDriving<Scalar>::Run(const Problem& problem, const Polygons& polygons, Path* path) {
  Start(problem, polygons, path);
  if (!Ended()) HoldBilateral();
  while (!Ended()) {
    if (up_) {
      Up();
    } else {
      Down();
    }
  }
  return verdict_;
}

template <class Scalar>
void SpatialDriving<Scalar>::Start(const Problem& problem, const Polygons& polygons, Path* path) {
  problem_ = &problem;
  polygons_ = &polygons;
  path_ = path;
  if (path_ != nullptr) path_->clear();
  const int contacts = static_cast<int>(problem.contacts.size());
  first_row_.assign(1, 0);
  for (const auto& contact : problem.contacts)
    first_row_.push_back(first_row_.back() + (contact.HasFrictionRows() ? 3 : 1));
  scale_ = MakeScale(problem, options_.tolerances);
  f_ = Vector::Constant(problem.rows(), Scalar(0));
  a_ = problem.b;
  df_ = da_ = f_;
  rho_ = Scalar(0);
  word_.assign(contacts, {});
  shapes_.assign(contacts, {});
  verdict_ = {};
  most_pieces_ = MostPieces();
  ended_ = false;
  up_ = true;
  driven_ = 0;
  stage_ = SpaceStage::kNone;
  if (!IsFinite()) End(Outcome::kUndecided, "a number is not finite");
}

// Bilateral contacts one after the other: a = 0 there by their own forces. One whose acceleration follows from
// those before keeps its force zero; if that acceleration is not zero, nothing can stop it.
template <class Scalar>
void SpatialDriving<Scalar>::HoldBilateral() {
  for (std::size_t i = 0; i < word_.size(); ++i) {
    if (problem_->contacts[i].kind != ContactKind::kBilateral) continue;
    driven_ = static_cast<int>(i);
    stage_ = SpaceStage::kNormal;
    const int row = first_row_[i];
    if (Direction() <= 0)
      return End(Outcome::kUndecided, "A is not definite on independent bilateral contacts");
    const int curvature = Sign(da_[row], scale_.rate);
    if (curvature < 0) return End(Outcome::kUndecided, "A is not semidefinite on bilateral contacts");
    if (curvature > 0) {
      Advance(Scalar(-a_[row] / da_[row]));
      SetCell(driven_, {Law::kHold, 0});
      continue;
    }
    SetCell(driven_, {Law::kHold, 1});
    const int sign = Sign(a_[row], scale_.acceleration);
    if (sign == 0) continue;
    if (sign > 0) df_ = Vector(-df_);
    return Unlimited();
  }
  driven_ = 0;
  stage_ = SpaceStage::kNone;
}

// One less than the number of words.
template <class Scalar>
std::int64_t SpatialDriving<Scalar>::MostPieces() const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  std::int64_t words = 1;
  for (std::size_t i = 0; i < word_.size(); ++i) {
    if (problem_->contacts[i].kind == ContactKind::kBilateral) continue;
    const std::int64_t cells = HasFriction(static_cast<int>(i)) ? 2 * (*polygons_)[i].sides() + 2 : 2;
    if (words > kMost / cells) return kMost;
    words *= cells;
  }
  return words - 1;
}

template <class Scalar>
void SpatialDriving<Scalar>::End(Outcome outcome, std::string_view reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
  ended_ = true;
}

// All contacts are finished. An inexact answer is computed anew from its word, and measured.
template <class Scalar>
void SpatialDriving<Scalar>::Solved() {
  if constexpr (!kIsExact<Scalar>) {
    const Vector path_end = f_;
    const Scalar tolerance = std::max(Scalar(options_.residual), 8 * std::numeric_limits<Scalar>::epsilon());
    if (!SolveLastWord() || !(PolygonResidual(*problem_, *polygons_, f_, a_) <= tolerance)) {
      f_ = path_end;
      ComputeAccelerations();
    }
    if (!(PolygonResidual(*problem_, *polygons_, f_, a_) <= tolerance))
      return End(Outcome::kUndecided, "the residual is above the tolerance");
  }
  End(Outcome::kSolved);
}

// f from the equations of the word; false if they do not determine it.
template <class Scalar>
bool SpatialDriving<Scalar>::SolveLastWord() {
  Assemble();
  const int k = static_cast<int>(equations_.size());
  RowMajorMatrix<Scalar> M(k, k + 1);
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) M(i, j) = Along(equations_[i].contact, equations_[i].row, columns_[j].image);
    M(i, k) = Along(equations_[i].contact, equations_[i].row, problem_->b);
  }
  const auto z = OrientedNullVector(M, scale_.rate);
  if (!z || Sign((*z)[k]) == 0) return false;
  for (int row = 0; row < problem_->rows(); ++row) f_[row] = Scalar(0);
  for (int j = 0; j < k; ++j) {
    const Column& column = columns_[j];
    for (int r = 0; r < Size(column.contact); ++r)
      f_[first_row_[column.contact] + r] += column.force[r] * ((*z)[j] / (*z)[k]);
  }
  ComputeAccelerations();
  return IsFinite();
}

// a = A f + b, free of the path's rounding.
template <class Scalar>
void SpatialDriving<Scalar>::ComputeAccelerations() {
  a_ = problem_->b;
  for (int i = 0; i < problem_->rows(); ++i) {
    for (int j = 0; j < problem_->rows(); ++j) a_[i] += problem_->A(i, j) * f_[j];
  }
}

// What the theory excludes is an internal error over exact scalars, and rounding over inexact ones.
template <class Scalar>
void SpatialDriving<Scalar>::Impossible(const char* what) {
  if constexpr (kIsExact<Scalar>) STICTION_CHECK(false, what);
  End(Outcome::kUndecided, what);
}

template <class Scalar>
void SpatialDriving<Scalar>::Unlimited() {
  if constexpr (kIsExact<Scalar>) return End(Outcome::kRay);
  End(Outcome::kUndecided, "a ray");
}

// A node reached from below. At the level of a normal the stage is kNone, at that of a friction kFriction, with
// the contact in any corner.
template <class Scalar>
void SpatialDriving<Scalar>::Up() {
  if (driven_ == static_cast<int>(word_.size())) return Solved();
  if (problem_->contacts[driven_].kind == ContactKind::kBilateral) {
    ++driven_;
    return;
  }
  if (stage_ == SpaceStage::kFriction) {
    const int corner = CornerAt(driven_, DrivenAmount());
    if (Ended()) return;
    SetCell(driven_, {Law::kCorner, corner});
    return TraceStage(DrivenAmount());
  }
  EnterNormal();
  Facet acceleration = StageEnd();
  acceleration.acceleration[0] = Scalar(1);
  const int sign = SignAt(DrivenAmount(), acceleration);
  if (Ended()) return;
  if (sign < 0) return TraceStage(DrivenAmount());
  FinishDriven({Law::kBreak, 0});
}

// A node reached from above: the contact that was established last is driven again.
template <class Scalar>
void SpatialDriving<Scalar>::Down() {
  if (stage_ == SpaceStage::kFriction) {  // back at rho = 0
    EnterNormal();
    return TraceStage(StageEnd());
  }
  SetCell(driven_, {});
  do {
    if (driven_ == 0) return Impossible("the path returned to f = 0");
    --driven_;
  } while (problem_->contacts[driven_].kind == ContactKind::kBilateral);
  const SpaceCell cell = word_[driven_];
  if (cell.law == Law::kBreak) return;  // the same point is a node of this contact's normal
  if (cell.law == Law::kFree) {
    EnterNormal();
  } else {
    EnterFriction(cell);
  }
  TraceStage(StageEnd());
}

template <class Scalar>
void SpatialDriving<Scalar>::EnterNormal() {
  stage_ = SpaceStage::kNormal;
  SetCell(driven_, {});
}

template <class Scalar>
void SpatialDriving<Scalar>::EnterFriction(const SpaceCell& cell) {
  stage_ = SpaceStage::kFriction;
  rho_ = problem_->contacts[driven_].mu * f_[first_row_[driven_]];
  SetCell(driven_, cell);
}

template <class Scalar>
void SpatialDriving<Scalar>::FinishDriven(const SpaceCell& cell) {
  stage_ = SpaceStage::kNone;
  SetCell(driven_, cell);
  ++driven_;
}

// The facet where the stage starts: fN = 0 or rho = 0.
template <class Scalar>
auto SpatialDriving<Scalar>::DrivenAmount() const -> Facet {
  Facet facet;
  facet.contact = driven_;
  facet.beyond = Beyond::kStart;
  (stage_ == SpaceStage::kFriction ? facet.radius : facet.force[0]) = Scalar(1);
  return facet;
}

// The facet where it ends: aN = 0 or rho = mu fN.
template <class Scalar>
auto SpatialDriving<Scalar>::StageEnd() const -> Facet {
  Facet facet;
  facet.contact = driven_;
  facet.beyond = Beyond::kEnd;
  if (stage_ == SpaceStage::kFriction) {
    facet.force[0] = problem_->contacts[driven_].mu;
    facet.radius = Scalar(-1);
  } else {
    facet.acceleration[0] = Scalar(-1);
    facet.of_acceleration = true;
  }
  return facet;
}

// The corner where fF.aF is least, at the present point, which lies on the facet `at`.
template <class Scalar>
int SpatialDriving<Scalar>::CornerAt(int contact, const Facet& at) {
  const FrictionPolygon<Scalar>& polygon = (*polygons_)[contact];
  const auto sign_along = [&](int k) {
    Facet along;
    along.contact = contact;
    along.acceleration = {Scalar(0), polygon.edge(k)[0], polygon.edge(k)[1]};
    along.of_acceleration = true;
    return SignAt(at, along);
  };
  int before = sign_along(-1);
  for (int k = 0; k < polygon.sides() && !Ended(); ++k) {
    const int after = sign_along(k);
    if (before < 0 && after > 0) return k;
    before = after;
  }
  if (!Ended()) Impossible("no corner opposes the acceleration");
  return 0;
}

// ---- One stage: from facet to facet ----------------------------------------------------------

template <class Scalar>
void SpatialDriving<Scalar>::TraceStage(Facet entry) {
  ++verdict_.statistics.stages;
  int last_turn = 0;
  while (true) {
    if (BudgetSpent()) return;
    const int determinant = Direction();
    if (Ended()) return;
    if (Sign(Value(entry, df_, da_, driven_rate_)) <= 0) {
      return Impossible("the direction leads out of the cell");
    }
    ++verdict_.statistics.pieces;
    verdict_.statistics.folds += determinant * last_turn < 0;
    if (determinant != 0) last_turn = determinant;
    CollectFacets();
    Record(determinant);
    if (candidates_.empty()) return Unlimited();
    const int nearest = Nearest(entry);
    if (Ended()) return;
    const Facet reached = *candidates_[nearest].facet;
    Advance(candidates_[nearest].s);
    if (path_ != nullptr) {
      path_->back().s = candidates_[nearest].s;
      path_->back().ends = reached.beyond == Beyond::kEnd;
      path_->back().descends = reached.beyond == Beyond::kStart;
    }
    if (reached.beyond == Beyond::kStart) {
      up_ = false;
      ++verdict_.statistics.descents;
      if (stage_ == SpaceStage::kNormal) stage_ = SpaceStage::kNone;
      return;
    }
    if (reached.beyond == Beyond::kEnd) {
      up_ = true;
      if (stage_ == SpaceStage::kFriction) return FinishDriven(word_[driven_]);
      if (!HasFriction(driven_)) return FinishDriven({Law::kFree, 0});
      rho_ = Scalar(0);
      stage_ = SpaceStage::kFriction;
      return SetCell(driven_, {Law::kCorner, 0});
    }
    entry = Cross(reached);
    if (Ended()) return;
  }
}

// The oriented null vector of the present cell: df, da and the rate of the driven amount. Returns the sign of
// the reduced determinant.
template <class Scalar>
int SpatialDriving<Scalar>::Direction() {
  Assemble();
  const int k = static_cast<int>(equations_.size());
  RowMajorMatrix<Scalar> M(k, k + 1);
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j <= k; ++j) M(i, j) = Along(equations_[i].contact, equations_[i].row, columns_[j].image);
  }
  const auto z = OrientedNullVector(M, scale_.rate);
  if (!z) {
    Impossible("the direction is not unique");
    return 0;
  }
  for (int row = 0; row < problem_->rows(); ++row) df_[row] = da_[row] = Scalar(0);
  for (int j = 0; j <= k; ++j) {
    if (Sign((*z)[j]) == 0) continue;
    const Column& column = columns_[j];
    for (int r = 0; r < Size(column.contact); ++r)
      df_[first_row_[column.contact] + r] += column.force[r] * (*z)[j];
    for (int row = 0; row < problem_->rows(); ++row) da_[row] += column.image[row] * (*z)[j];
  }
  driven_rate_ = (*z)[k];
  return Sign((*z)[k]);
}

template <class Scalar>
void SpatialDriving<Scalar>::CollectFacets() {
  candidates_.clear();
  for (const Shape& shape : shapes_) {
    for (const Facet& facet : shape.facets) {
      Scalar rate = -Value(facet, df_, da_, driven_rate_);
      if (Sign(rate, facet.of_acceleration ? scale_.rate : scale_.pivot) <= 0) continue;
      Scalar s = Present(facet) / rate;
      if (!kIsExact<Scalar> && s < 0) s = Scalar(0);  // by rounding only
      candidates_.push_back({&facet, std::move(rate), std::move(s)});
    }
  }
}

// The candidate that is reached first. Ties are told by the parts of the distances in the infinitesimals.
template <class Scalar>
int SpatialDriving<Scalar>::Nearest(const Facet& entry) {
  int nearest = 0;
  const int count = static_cast<int>(candidates_.size());
  for (int i = 1; i < count; ++i) {
    if (candidates_[i].s < candidates_[nearest].s) nearest = i;
  }
  const Scalar reach = candidates_[nearest].s + scale_.force;
  std::optional<Row> least;
  for (int i = 0; i < count; ++i) {
    if (i == nearest || candidates_[i].s > reach) continue;
    if (!least) {
      ++verdict_.statistics.ties;
      least = Gradient(entry, *candidates_[nearest].facet) / candidates_[nearest].rate;
    }
    const Row parts = Gradient(entry, *candidates_[i].facet) / candidates_[i].rate;
    const int order = FirstSign(parts - *least, false);
    if (order == 0) {
      Impossible("a tie");
      return nearest;
    }
    if (order > 0) continue;
    nearest = i;
    least = parts;
  }
  return nearest;
}

template <class Scalar>
void SpatialDriving<Scalar>::Advance(const Scalar& s) {
  if (Sign(s) == 0) return;
  for (int row = 0; row < problem_->rows(); ++row) {
    f_[row] += s * df_[row];
    a_[row] += s * da_[row];
  }
  if (stage_ == SpaceStage::kFriction) rho_ += s * driven_rate_;
}

// Into the cell beyond; returns the facet as that cell sees it. The present point lies on `reached`.
template <class Scalar>
auto SpatialDriving<Scalar>::Cross(const Facet& reached) -> Facet {
  const int contact = reached.contact;
  const SpaceCell from = word_[contact];
  SpaceCell to = reached.cell;
  if (reached.beyond == Beyond::kCorners) to = {Law::kCorner, CornerAt(contact, reached)};
  if (Ended()) return reached;
  SetCell(contact, to);
  for (const Facet& facet : shapes_[contact].facets) {
    if (facet.beyond == Beyond::kCorners || (facet.beyond == Beyond::kCell && facet.cell == from)) return facet;
  }
  Impossible("a facet has one side only");
  return reached;
}

template <class Scalar>
bool SpatialDriving<Scalar>::BudgetSpent() {
  if (verdict_.statistics.pieces >= most_pieces_) {
    Impossible("more pieces than cells");
  } else if (verdict_.statistics.pieces >= options_.limits.pivots) {
    End(Outcome::kLimit, "pieces");
  } else if (!IsFinite()) {
    End(Outcome::kUndecided, "a number is not finite");
  }
  return Ended();
}

template <class Scalar>
bool SpatialDriving<Scalar>::IsFinite() const {
  if constexpr (!kIsExact<Scalar>) {
    Scalar sum(0);
    for (int row = 0; row < problem_->rows(); ++row) sum += Abs(f_[row]) + Abs(a_[row]);
    return sum <= std::numeric_limits<Scalar>::max();
  }
  return true;
}

template <class Scalar>
void SpatialDriving<Scalar>::Record(int determinant) {
  if (path_ == nullptr) return;
  path_->push_back({driven_, stage_, word_, determinant, df_, da_, driven_rate_, Scalar(0), false, false});
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_IPP_
