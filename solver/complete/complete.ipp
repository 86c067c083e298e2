// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h, in the order of complete_driving.md.

#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "solver/complete/complete.h"
#include "solver/complete/complete_cells.ipp"
#include "solver/complete/complete_end.ipp"
#include "solver/complete/complete_ties.ipp"
#include "solver/linear/direction.ipp"

namespace stiction {

// ---- The run: from node to node --------------------------------------------------------------

template <class Scalar, int Rows>
RunEnd<> CompleteDriving<Scalar, Rows>::Run(const Problem& problem, Trace<Scalar>* trace) {
  return Follow(problem, nullptr, trace);
}

template <class Scalar, int Rows>
RunEnd<> CompleteDriving<Scalar, Rows>::Run(const Problem& problem, const Polygons& polygons,
                                            Trace<Scalar>* trace) requires(Rows == Eigen::Dynamic) {
  return Follow(problem, &polygons, trace);
}

template <class Scalar, int Rows>
RunEnd<> CompleteDriving<Scalar, Rows>::Follow(const Problem& problem, const Polygons* polygons,
                                               Trace<Scalar>* trace) {
  Start(problem, polygons, trace);
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

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Start(const Problem& problem, const Polygons* polygons,
                                          Trace<Scalar>* trace) {
  problem_ = &problem;
  polygons_ = polygons;
  trace_ = trace;
  if (trace_ != nullptr) trace_->pivots.clear();
  if constexpr (Rows == Eigen::Dynamic) {
    layout_.Assign(problem.contacts, problem.dimension);
    f_.resize(problem.rows());
  }
  scale_ = MakeScale(problem, request_.tolerances);
  direction_.Start(problem, update_from_);
  for (int row = 0; row < problem.rows(); ++row) f_[row] = Scalar(0);
  a_ = problem.b;
  rho_ = Scalar(0);
  word_.assign(layout_.ContactCount(), {});
  unknowns_.Start(problem);
  verdict_ = {.statistics = kCompleteCounters};
  most_pieces_ = MostPieces();
  ended_ = false;
  up_ = true;
  driven_ = 0;
  stage_ = Stage::kNormal;
  if (!IsFinite()) End(Outcome::kUndecided, "a number is not finite");
}

// Bilateral contacts one after the other: a = 0 there by their own forces. One whose acceleration follows from
// those before keeps its force zero; if that acceleration is not zero, nothing can stop it.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::HoldBilateral() {
  const int contacts = static_cast<int>(word_.size());
  for (int i = 0; i < contacts; ++i) {
    if (!IsBilateral(i)) continue;
    driven_ = i;
    EnterNormal();
    const int row = RowOf(i);
    if (Direction() <= 0)
      return End(Outcome::kUndecided, "A is not definite on independent bilateral contacts");
    const Scalar& change = direction_.da()[row];
    const int curvature = Sign(change, scale_.rate);
    if (curvature < 0) return End(Outcome::kUndecided, "A is not semidefinite on bilateral contacts");
    SetCell(i, {Law::kHold, curvature > 0 ? 0 : 1});
    if (curvature > 0) {
      Advance(Scalar(-a_[row] / change));
      continue;
    }
    const int sign = Sign(a_[row], scale_.acceleration);
    if (sign != 0) return Unlimited(-sign);
  }
  driven_ = 0;
}

// The cells of all stages: the stage of a contact has each of its own with every word of the contacts before.
template <class Scalar, int Rows>
std::int64_t CompleteDriving<Scalar, Rows>::MostPieces() const {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  std::int64_t words = 1, pieces = 0;
  const int contacts = static_cast<int>(word_.size());
  for (int i = 0; i < contacts; ++i) {
    if (IsBilateral(i)) continue;
    std::int64_t cells = 2, of_stages = 1;
    if (HasFriction(i)) {
      cells = InSpace() ? 2 * (*polygons_)[i].sides() + 2 : 4;
      of_stages = InSpace() ? cells : 3;
    }
    if (words > kMost / (2 * cells)) return kMost;
    pieces += words * of_stages;
    words *= cells;
  }
  return pieces;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::End(Outcome outcome, std::string_view reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
  ended_ = true;
}

// What the theory excludes is an internal error over exact scalars, and rounding over inexact ones.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Impossible(const char* what) {
  if constexpr (kIsExact<Scalar>) STICTION_FAIL(what);
  End(Outcome::kUndecided, what);
}

// No facet ahead. Over inexact scalars one may have been lost to rounding.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Unlimited(int sign) {
  ray_ = direction_.df();
  if (sign < 0) ray_ = -ray_;
  if constexpr (kIsExact<Scalar>) return End(Outcome::kRay);
  End(Outcome::kUndecided, "a ray");
}

// A node reached from below: the driven contact is at rest, or its stage begins. The friction of a node is in
// any corner.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Up() {
  if (driven_ == static_cast<int>(word_.size())) return Solved();
  if (IsBilateral(driven_)) {
    ++driven_;
    return;
  }
  if (stage_ == Stage::kFriction) {
    const int corner = CornerAt(driven_, DrivenAmount());
    if (Ended()) return;
    if (corner != word_[driven_].side) SetCell(driven_, {Law::kCorner, corner});
    return TraceStage(DrivenAmount());
  }
  EnterNormal();
  const int sign = SignAt(DrivenAmount(), {Kind::kAcceleration, driven_});  // 0: the run has ended
  if (sign < 0) TraceStage(DrivenAmount());
  if (sign > 0) FinishDriven({Law::kBreak, 0});
}

// A node reached from above: what was established last is driven again.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Down() {
  if (stage_ == Stage::kFriction) {  // back at rho = 0
    EnterNormal();
    return TraceStage(StageEnd());
  }
  int before = driven_;
  do {
    if (before == 0) return Impossible("the path returned to f = 0");
    --before;
  } while (IsBilateral(before));
  const LawCell cell = word_[before];
  if (cell.law == Law::kInside && !InSpace()) return DownToStick(before);
  const int above = std::exchange(driven_, before);
  SetCell(above, {});
  if (cell.law != Law::kBreak && cell.law != Law::kFree) {
    EnterFriction(cell, Scalar(problem_->contacts[driven_].mu * f_[RowOf(driven_)]));
    return TraceStage(StageEnd());
  }
  EnterNormal();
  // In B the same point is a node of this contact's normal.
  if (cell.law == Law::kFree) TraceStage(StageEnd());
}

// In the plane a friction stage ended at aF = 0, on the side of its force.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::DownToStick(int contact) {
  const Facet upward = {Kind::kSide, contact};
  const int sign = SignAt(DrivenAmount(), upward);
  if (Ended()) return;
  const int above = std::exchange(driven_, contact);
  SetCell(above, {});
  const int corner = sign > 0 ? 0 : 1;
  EnterFriction({Law::kCorner, corner}, Present({Kind::kSide, contact, corner}));
  TraceStage({Kind::kOpposed, contact, corner});
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::EnterNormal() {
  stage_ = Stage::kNormal;
  SetCell(driven_, {});
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::EnterFriction(LawCell cell, const Scalar& radius) {
  stage_ = Stage::kFriction;
  rho_ = radius;
  SetCell(driven_, cell);
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::FinishDriven(LawCell cell) {
  stage_ = Stage::kNormal;
  const int finished = driven_++;
  SetCell(finished, cell);
}

// ---- One stage: from facet to facet ----------------------------------------------------------

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::TraceStage(Facet entry) {
  ++verdict_.statistics[Counter::kStages];
  PathTurn turn = up_ ? PathTurn::kNone : PathTurn::kDescent;
  int last_turn = 0;
  while (true) {
    if (BudgetSpent()) return;
    const int determinant = Direction();
    if (Ended()) return;
    if (Sign(Value(entry, direction_.df(), direction_.da(), rate_)) <= 0) {
      return Impossible("the direction leads out of the cell");
    }
    ++verdict_.statistics[Counter::kPieces];
    if (determinant * last_turn < 0) {
      ++verdict_.statistics[Counter::kFolds];
      turn = PathTurn::kFold;
    }
    if (determinant != 0) last_turn = determinant;
    CollectFacets();
    Record(determinant, std::exchange(turn, PathTurn::kNone));
    if (kEncloses<Scalar> && candidates_.empty() && !may_be_ahead_.empty()) Unsure<Scalar>::Refuse();
    if (candidates_.empty()) return Unlimited();
    const int nearest = Nearest(entry);
    if (Ended()) return;
    const Candidate& reached = candidates_[nearest];
    const bool ends = reached.facet.beyond == Beyond::kStart || reached.facet.beyond == Beyond::kEnd;
    Advance(reached.s);
    if constexpr (kMeetsLimits<Scalar>) Snap(reached.facet);
    if constexpr (kEncloses<Scalar>) MeetDependentZeros(dependent_rows_, a_);
    if (ends) {
      EndStage(reached.facet);
    } else {
      entry = Cross(reached.facet);
    }
    RecordEnd(reached);
    if (ends || Ended()) return;
  }
}

// The oriented null vector of the present cell. Returns the sign of the reduced determinant.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::Direction() {
  const std::optional<int> determinant = direction_.SolveOriented(*problem_, unknowns_, scale_);
  if (!determinant) Impossible("the direction is not unique");
  if constexpr (kEncloses<Scalar>) MeetDependentZeros(dependent_rows_, direction_.da());
  rate_ = Scalar(determinant.value_or(0));
  return determinant.value_or(0);
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::CollectFacets() {
  candidates_.clear();
  may_be_ahead_.clear();
  for (int i = 0; i <= driven_; ++i)
    ForEachFacet(i, [this](auto kind, const Facet& facet) { this->Offer(kind, facet); });
}

template <class Scalar, int Rows>
template <class OfKind>
void CompleteDriving<Scalar, Rows>::Offer(OfKind kind, const Facet& facet) {
  const auto value = [&](const Vector& f, const Vector& a, const Scalar& radius) {
    return InSpace() ? SpatialValue(facet, f, a, radius) : PlanarValue(kind, facet, f, a, radius);
  };
  Scalar rate = -value(direction_.df(), direction_.da(), rate_);
  if constexpr (kEncloses<Scalar>) {
    if (!Unsure<Scalar>::MayBePositive(rate)) return;
    if (!Unsure<Scalar>::TellsSign(rate)) {
      may_be_ahead_.push_back(Unsure<Scalar>::Earliest(value(f_, a_, rho_), rate));
      return;
    }
  }
  if (Sign(rate, facet.OfAcceleration() ? scale_.rate : scale_.pivot) <= 0) return;
  Scalar s = value(f_, a_, rho_) / rate;
  if (!kIsExact<Scalar> && s < 0) s = Scalar(0);  // by rounding only
  candidates_.push_back({facet, std::move(rate), std::move(s)});
}

// The candidate that is reached first. Ties are told by the parts of the distances in the infinitesimals.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::Nearest(const Facet& entry) {
  int nearest = 0;
  const int count = static_cast<int>(candidates_.size());
  for (int i = 1; i < count; ++i) {
    if constexpr (kEncloses<Scalar>) {  // those far away may tie: what is nearest is held against all below
      const Scalar before = candidates_[nearest].s - candidates_[i].s;
      if (Unsure<Scalar>::TellsSign(before) && before > 0) nearest = i;
    } else {
      if (candidates_[i].s < candidates_[nearest].s) nearest = i;
    }
  }
  if constexpr (kEncloses<Scalar>) {  // what is surely beyond does not matter
    for (const Scalar& earliest : may_be_ahead_) {
      if (!(earliest > candidates_[nearest].s)) Unsure<Scalar>::Refuse();
    }
  }
  const Scalar reach = candidates_[nearest].s + scale_.force;
  std::optional<Row> least;  // parts of the nearest candidate, once there is a tie
  for (int i = 0; i < count; ++i) {
    if (i == nearest || candidates_[i].s > reach) continue;
    if (!least) {
      ++verdict_.statistics[Counter::kTies];
      least = Gradient(entry, candidates_[nearest].facet) / candidates_[nearest].rate;
    }
    const Row parts = Gradient(entry, candidates_[i].facet) / candidates_[i].rate;
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

// f += s df, a += s da.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Advance(const Scalar& s) {
  if (kIsExact<Scalar> && IsSurelyZero(s)) return;
  const auto& df = direction_.df();
  const auto& da = direction_.da();
  for (int row = 0; row < problem_->rows(); ++row) {
    if (!kIsExact<Scalar> || !IsSurelyZero(df[row])) f_[row] += s * df[row];
    if (!kIsExact<Scalar> || !IsSurelyZero(da[row])) a_[row] += s * da[row];
  }
  if (stage_ == Stage::kFriction) rho_ += s * rate_;
}

// Over inexact scalars and enclosures the facet that was reached is met exactly, and so are the equations of
// the cells, where they are those of single rows.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Snap(const Facet& reached) {
  const int row = RowOf(reached.contact);
  const Scalar& mu = problem_->contacts[reached.contact].mu;
  if (reached.kind == Kind::kForce) f_[row] = Scalar(0);
  if (reached.kind == Kind::kAcceleration) a_[row] = Scalar(0);
  if (reached.kind == Kind::kRadius) rho_ = Scalar(0);
  if (reached.kind == Kind::kRest) rho_ = mu * f_[row];
  if (reached.kind == Kind::kOpposed && !InSpace()) a_[row + 1] = Scalar(0);
  if (reached.kind == Kind::kBound && !InSpace()) f_[row + 1] = Scalar(1 - 2 * reached.k) * mu * f_[row];
  SnapToCells();
}

// Accelerations that rest, and forces that follow another.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::SnapToCells() {
  for (int row = 0; row < problem_->rows(); ++row) {
    if (unknowns_.Rests(row)) a_[row] = Scalar(0);
  }
  for (int i = 0; i <= driven_; ++i) {
    const Law law = word_[i].law;
    if (law != Law::kCorner && law != Law::kFree) continue;
    const int row = RowOf(i);
    const RowCombination<Scalar>& force = unknowns_.Force(row);
    for (int r = 1; r < force.size; ++r) f_[row + r] = force.factors[r] * f_[row];
    if (!FrictionIsDriven(i)) continue;
    const RowCombination<Scalar>& radial = unknowns_.Driven();
    for (int r = 0; r < radial.size; ++r)
      f_[radial.row + r] = radial.unit ? rho_ : Scalar(radial.factors[r] * rho_);
  }
}

// The driven amount is established, or back at zero.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::EndStage(const Facet& reached) {
  up_ = reached.beyond == Beyond::kEnd;
  verdict_.statistics[Counter::kDescents] += !up_;
  if (!up_) return;
  if (stage_ == Stage::kNormal && HasFriction(driven_)) return EnterFriction({Law::kCorner, 0}, Scalar(0));
  FinishDriven(reached.cell);
}

// Into the cell beyond; returns the facet as that cell sees it. The present point lies on `reached`.
template <class Scalar, int Rows>
auto CompleteDriving<Scalar, Rows>::Cross(const Facet& reached) -> Facet {
  const int contact = reached.contact;
  const LawCell from = word_[contact];
  LawCell to = reached.cell;
  if (reached.beyond == Beyond::kCorners) to = {Law::kCorner, CornerAt(contact, reached)};
  SetCell(contact, to);
  Facet entry = reached;
  bool found = false;
  ForEachFacet(contact, [&](auto, const Facet& facet) {
    const bool back = facet.beyond == Beyond::kCell && facet.cell == from;
    if (found || !(back || facet.beyond == Beyond::kCorners)) return;
    found = true;
    entry = facet;
  });
  if (!found) Impossible("a facet has one side only");
  return entry;
}

template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::BudgetSpent() {
  if (verdict_.statistics[Counter::kPieces] >= most_pieces_) {
    Impossible("more pieces than cells");
  } else if (verdict_.statistics[Counter::kPieces] >= request_.limits.pivots) {
    End(Outcome::kLimit, "pieces");
  } else if (request_.limits.Stopped()) {
    End(Outcome::kUndecided, kStopped);
  } else if (!IsFinite()) {
    End(Outcome::kUndecided, "a number is not finite");
  }
  return Ended();
}

template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::IsFinite() const {
  if constexpr (!kIsExact<Scalar>) {
    Scalar sum = Scalar(0);
    for (int row = 0; row < problem_->rows(); ++row) sum += Abs(f_[row]) + Abs(a_[row]);
    return sum <= std::numeric_limits<Scalar>::max();
  }
  return true;
}

}  // namespace stiction
