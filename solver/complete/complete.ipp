// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h, in the order of complete_driving.md.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_IPP_
#define STICTION_SOLVER_COMPLETE_COMPLETE_IPP_

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "solver/complete/complete.h"
#include "solver/complete/complete_ties.ipp"
#include "solver/linear/direction.ipp"
#include "solver/problem/check.h"
#include "solver/problem/residual.h"

namespace stiction {

// ---- The run: from node to node --------------------------------------------------------------

template <class Scalar, int Rows>
CompleteVerdict CompleteDriving<Scalar, Rows>::Run(const Problem& problem, Path<Scalar>* path) {
  Start(problem, path);
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
void CompleteDriving<Scalar, Rows>::Start(const Problem& problem, Path<Scalar>* path) {
  const int rows = problem.rows();
  problem_ = &problem;
  path_ = path;
  if (path_ != nullptr) path_->clear();
  layout_.Assign(problem.contacts);
  scale_ = MakeScale(problem, options_.tolerances);
  direction_.Start(problem, options_.update_from);
  if constexpr (Rows == Eigen::Dynamic) state_.f.resize(rows);
  for (int row = 0; row < rows; ++row) state_.f[row] = Scalar(0);
  state_.a = problem.b;
  Reset<IndexSet, Rows>(state_.sets, rows, IndexSet::kNone);
  verdict_ = {};
  most_pieces_ = MostPieces();
  ended_ = false;
  driven_ = 0;
  side_ = 1;
  up_ = true;
}

// One less than the number of words: four cells for a contact with mu > 0, two for any other.
template <class Scalar, int Rows>
std::int64_t CompleteDriving<Scalar, Rows>::MostPieces() const {
  std::int64_t words = 1;
  for (const auto& contact : problem_->contacts) {
    if (words > std::numeric_limits<std::int64_t>::max() / 4) return std::numeric_limits<std::int64_t>::max();
    words *= contact.HasFrictionRows() && Sign(contact.mu) > 0 ? 4 : 2;
  }
  return words - 1;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::End(Outcome outcome, std::string_view reason) {
  verdict_.outcome = outcome;
  verdict_.reason = reason;
  ended_ = true;
}

// All contacts are finished. An inexact answer is measured, with accelerations free of the path's rounding.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Solved() {
  if constexpr (!kIsExact<Scalar>) {
    if (!IsFinite()) return End(Outcome::kUndecided, "a number is not finite");
    state_.a = problem_->b;
    for (int i = 0; i < problem_->rows(); ++i) {
      for (int j = 0; j < problem_->rows(); ++j) state_.a[i] += problem_->A(i, j) * state_.f[j];
    }
    const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
    const Scalar tolerance = std::max(Scalar(options_.residual), least);
    const Scalar residual = NaturalResidual(*problem_, state_.f, state_.a);
    if (!(residual <= tolerance)) return End(Outcome::kUndecided, "the residual is above the tolerance");
  }
  End(Outcome::kSolved);
}

// What the theory excludes is an internal error over exact scalars, and rounding over inexact ones.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Impossible(const char* what) {
  if constexpr (kIsExact<Scalar>) STICTION_FAIL(what);
  End(Outcome::kUndecided, what);
}

// No facet ahead. Over inexact scalars one may have been lost to rounding.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Unlimited() {
  if constexpr (kIsExact<Scalar>) return End(Outcome::kRay);
  End(Outcome::kUndecided, "a ray");
}

// A node of P_v, reached from below: the next variable is at rest, or its stage begins.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Up() {
  side_ = 1;
  if (driven_ == problem_->rows()) return Solved();
  const int row = driven_;
  if (layout_.IsNormal(row)) {
    const int sign = SignAt(DrivenForce(), {Facet::Kind::kAcceleration, row, 1});
    if (Ended()) return;
    if (sign < 0) return TraceStage(DrivenForce());
    state_.sets[row] = IndexSet::kSeparating;
    ++driven_;
    if (!layout_.HasFriction(row)) return;
    state_.sets[row + 1] = IndexSet::kSuspended;
    ++driven_;
  } else if (Sign(problem_->contacts[layout_.ContactOf(row)].mu) == 0) {
    state_.sets[row] = IndexSet::kSuspended;
    ++driven_;
  } else {
    const int sign = SignAt(DrivenForce(), {Facet::Kind::kAcceleration, row, 1});
    if (Ended()) return;
    side_ = -sign;
    TraceStage(DrivenForce());
  }
}

// A node of P_v, reached from above: the variable established last is driven again.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Down() {
  if (driven_ == 0) return Impossible("the path returned to f = 0");
  if (layout_.IsNormal(driven_)) return DownToContactBefore();
  side_ = 1;
  Release(driven_ - 1, 1, {Facet::Kind::kAcceleration, driven_ - 1, -1});
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::DownToContactBefore() {
  const int normal = layout_.NormalRowOf(layout_.ContactOf(driven_) - 1);
  const int friction = normal + 1;
  if (state_.sets[normal] == IndexSet::kSeparating) {  // B: the same point is a node of the contact's normal
    state_.sets[normal] = IndexSet::kNone;
    if (layout_.HasFriction(normal)) state_.sets[friction] = IndexSet::kNone;
    driven_ = normal;
    return;
  }
  if (!layout_.HasFriction(normal) || state_.sets[friction] == IndexSet::kSuspended) {  // 0
    if (layout_.HasFriction(normal)) state_.sets[friction] = IndexSet::kNone;
    return Release(normal, 1, {Facet::Kind::kAcceleration, normal, -1});
  }
  if (state_.sets[friction] == IndexSet::kSticking) {  // S
    const int side = SignAt(DrivenForce(), {Facet::Kind::kForce, friction, 1});
    if (Ended()) return;
    return Release(friction, side, {Facet::Kind::kAcceleration, friction, -side});
  }
  const int side = LimitSign(state_.sets[friction]);  // +, -
  Release(friction, side, {Facet::Kind::kBound, friction, side});
}

// Enters the stage of a variable at its end, to leave that end.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Release(int row, int side, const Facet& entry) {
  state_.sets[row] = IndexSet::kNone;
  driven_ = row;
  side_ = side;
  TraceStage(entry);
}

// ---- One stage: from facet to facet ----------------------------------------------------------

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::TraceStage(Facet entry) {
  ++verdict_.statistics.stages;
  int last_turn = 0;
  while (true) {
    if (BudgetSpent()) return;
    const std::optional<int> determinant =
        direction_.SolveOriented(*problem_, layout_, state_.sets, driven_, side_, scale_);
    if (!determinant) return Impossible("the direction is not unique");
    if (Sign(Value(entry, direction_.df(), direction_.da())) <= 0) {
      return Impossible("the direction leads out of the cell");
    }
    ++verdict_.statistics.pieces;
    verdict_.statistics.folds += *determinant * last_turn < 0;
    if (*determinant != 0) last_turn = *determinant;
    CollectFacets();
    Record(*determinant);
    if (candidates_.empty()) return Unlimited();
    const int nearest = Nearest(entry);
    if (Ended()) return;
    const Candidate& reached = candidates_[nearest];
    const bool ends = reached.facet.row == driven_;
    Advance(reached);
    if (ends) {
      EndStage(reached.facet);
    } else {
      entry = Cross(reached.facet);
    }
    RecordEnd(reached);
    if (ends || Ended()) return;
  }
}

// The facets that the direction leads to. In S the bounds imply fN >= 0, and so does the bound of a friction
// stage for its own normal.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::CollectFacets() {
  using enum Facet::Kind;
  candidates_.clear();
  for (int row = 0; row < driven_; ++row) {
    switch (state_.sets[row]) {
      case IndexSet::kSeparating:
        Offer({kAcceleration, row, 1});
        break;
      case IndexSet::kClamped:
        if (row + 1 != driven_ || !layout_.HasFriction(row)) {
          if (!layout_.HasFriction(row) || state_.sets[row + 1] != IndexSet::kSticking) Offer({kForce, row, 1});
        }
        break;
      case IndexSet::kSticking:
        Offer({kBound, row, 1});
        Offer({kBound, row, -1});
        break;
      case IndexSet::kAtUpper:
      case IndexSet::kAtLower:
        Offer({kAcceleration, row, -LimitSign(state_.sets[row])});
        break;
      case IndexSet::kNone:
      case IndexSet::kSuspended:
        break;
    }
  }
  Offer(DrivenForce());
  Offer({kAcceleration, driven_, -side_});
  if (!layout_.IsNormal(driven_)) Offer({kBound, driven_, side_});
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Offer(const Facet& facet) {
  Scalar rate = -Value(facet, direction_.df(), direction_.da());
  const Scalar& tolerance = facet.kind == Facet::Kind::kAcceleration ? scale_.rate : scale_.pivot;
  if (Sign(rate, tolerance) <= 0) return;
  Scalar s = Value(facet, state_.f, state_.a) / rate;
  if (!kIsExact<Scalar> && s < 0) s = Scalar(0);  // by rounding only
  candidates_.push_back({facet, std::move(rate), std::move(s)});
}

// The candidate that is reached first. Ties are told by the parts of the distances in the infinitesimals.
template <class Scalar, int Rows>
int CompleteDriving<Scalar, Rows>::Nearest(const Facet& entry) {
  int nearest = 0;
  const int count = static_cast<int>(candidates_.size());
  for (int i = 1; i < count; ++i) {
    if (candidates_[i].s < candidates_[nearest].s) nearest = i;
  }
  const Scalar reach = candidates_[nearest].s + scale_.force;
  std::optional<Row> least;  // parts of the nearest candidate, once there is a tie
  for (int i = 0; i < count; ++i) {
    if (i == nearest || candidates_[i].s > reach) continue;
    if (!least) {
      ++verdict_.statistics.ties;
      least = Gradient(entry, candidates_[nearest].facet) / candidates_[nearest].rate;
    }
    const Row parts = Gradient(entry, candidates_[i].facet) / candidates_[i].rate;
    const int order = FirstSign(parts - *least, Facet::Kind::kForce);
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

// f += s df, a += s da. Over inexact scalars the facet that was reached is then met exactly.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Advance(const Candidate& reached) {
  if (kIsExact<Scalar> && Sign(reached.s) == 0) return;
  const auto& df = direction_.df();
  const auto& da = direction_.da();
  for (int row = 0; row < problem_->rows(); ++row) {
    if (!kIsExact<Scalar> || Sign(df[row]) != 0) state_.f[row] += reached.s * df[row];
    if (!kIsExact<Scalar> || Sign(da[row]) != 0) state_.a[row] += reached.s * da[row];
  }
  if constexpr (!kIsExact<Scalar>) Snap(reached.facet);
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Snap(const Facet& reached) {
  if (reached.kind == Facet::Kind::kForce) state_.f[reached.row] = Scalar(0);
  if (reached.kind == Facet::Kind::kAcceleration) state_.a[reached.row] = Scalar(0);
  for (int row = 0; row < driven_; ++row) {
    if (IsUnknown(state_.sets[row])) state_.a[row] = Scalar(0);
    const int limit = LimitSign(state_.sets[row]);
    if (limit == 0) continue;
    state_.f[row] = Scalar(limit) * problem_->contacts[layout_.ContactOf(row)].mu * state_.f[row - 1];
  }
  if (reached.kind != Facet::Kind::kBound) return;
  const Scalar& mu = problem_->contacts[layout_.ContactOf(reached.row)].mu;
  state_.f[reached.row] = Scalar(reached.sign) * mu * state_.f[reached.row - 1];
}

// The driven variable is established, or back at zero.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::EndStage(const Facet& reached) {
  up_ = reached.kind != Facet::Kind::kForce;
  if (!up_) {
    ++verdict_.statistics.descents;
    return;
  }
  const bool at_limit = reached.kind == Facet::Kind::kBound;
  state_.sets[driven_] = at_limit                    ? (side_ > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower)
                         : layout_.IsNormal(driven_) ? IndexSet::kClamped
                                                     : IndexSet::kSticking;
  ++driven_;
}

// Into the other cell of a facet of a finished contact; returns that facet as the new cell sees it.
template <class Scalar, int Rows>
Facet CompleteDriving<Scalar, Rows>::Cross(const Facet& reached) {
  using enum Facet::Kind;
  const int row = reached.row;
  switch (reached.kind) {
    case kForce:
      return Open(row);
    case kBound:
      state_.sets[row] = reached.sign > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower;
      return {kAcceleration, row, -reached.sign};
    case kAcceleration:
      break;
  }
  if (layout_.IsNormal(row)) return Close(row);
  const int side = LimitSign(state_.sets[row]);
  state_.sets[row] = IndexSet::kSticking;
  return {kBound, row, side};
}

template <class Scalar, int Rows>
Facet CompleteDriving<Scalar, Rows>::Open(int normal) {
  state_.sets[normal] = IndexSet::kSeparating;
  if (layout_.HasFriction(normal)) state_.sets[normal + 1] = IndexSet::kSuspended;
  return {Facet::Kind::kAcceleration, normal, 1};
}

template <class Scalar, int Rows>
Facet CompleteDriving<Scalar, Rows>::Close(int normal) {
  if (layout_.HasFriction(normal) && Sign(problem_->contacts[layout_.ContactOf(normal)].mu) > 0) {
    const int sign =
        SignAt({Facet::Kind::kAcceleration, normal, 1}, {Facet::Kind::kAcceleration, normal + 1, 1});
    state_.sets[normal + 1] = sign < 0 ? IndexSet::kAtUpper : IndexSet::kAtLower;
  }
  state_.sets[normal] = IndexSet::kClamped;
  return {Facet::Kind::kForce, normal, 1};
}

template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::BudgetSpent() {
  if (verdict_.statistics.pieces >= most_pieces_) {
    Impossible("more pieces than cells");
  } else if (verdict_.statistics.pieces >= options_.limits.pivots) {
    End(Outcome::kLimit, "pieces");
  } else if (!IsFinite()) {
    End(Outcome::kUndecided, "a number is not finite");
  }
  return Ended();
}

template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::IsFinite() const {
  if constexpr (!kIsExact<Scalar>) {
    Scalar sum = Scalar(0);
    for (int row = 0; row < problem_->rows(); ++row) sum += Abs(state_.f[row]) + Abs(state_.a[row]);
    return sum <= std::numeric_limits<Scalar>::max();
  }
  return true;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Record(int determinant) {
  if (path_ == nullptr) return;
  Piece<Scalar>& piece = path_->emplace_back();
  piece.drive = static_cast<int>(verdict_.statistics.stages);
  piece.driven = driven_;
  piece.df = direction_.df();
  piece.da = direction_.da();
  piece.limiting = -1;
  piece.f = state_.f;
  piece.a = state_.a;
  piece.cell.assign(state_.sets.begin(), state_.sets.end());
  piece.sets = piece.cell;
  piece.side = side_;
  piece.determinant = determinant;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::RecordEnd(const Candidate& reached) {
  if (path_ == nullptr) return;
  Piece<Scalar>& piece = path_->back();
  const int row = reached.facet.row;
  piece.s = reached.s;
  piece.limiting = row;
  piece.from = piece.cell[row];
  piece.to = piece.wanted = state_.sets[row];
  piece.f = state_.f;
  piece.a = state_.a;
  piece.sets.assign(state_.sets.begin(), state_.sets.end());
}

// ---- The word --------------------------------------------------------------------------------

template <class Scalar, int Rows>
Cell CompleteDriving<Scalar, Rows>::CellOf(int contact) const {
  const int normal = layout_.NormalRowOf(contact);
  const IndexSet set = state_.sets[normal];
  if (set == IndexSet::kSeparating) return Cell::kBreak;
  if (set != IndexSet::kClamped) return Cell::kNone;
  switch (layout_.HasFriction(normal) ? state_.sets[normal + 1] : IndexSet::kSuspended) {
    case IndexSet::kSuspended:
      return Cell::kFree;
    case IndexSet::kSticking:
      return Cell::kStick;
    case IndexSet::kAtUpper:
      return Cell::kUpper;
    case IndexSet::kAtLower:
      return Cell::kLower;
    default:
      return Cell::kNone;
  }
}

template <class Scalar, int Rows>
std::string CompleteDriving<Scalar, Rows>::Word() const {
  std::string word;
  for (int contact = 0; contact < layout_.ContactCount(); ++contact) word += Name(CellOf(contact));
  return word;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_IPP_
