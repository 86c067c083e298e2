// SPDX-License-Identifier: Apache-2.0
// Definitions for complete.h: what a run leaves behind. Answers over inexact scalars are measured, pieces of
// the path recorded.

#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/complete/complete.h"
#include "solver/complete/polygon_errors.h"
#include "solver/problem/lenient.h"

namespace stiction {

// All contacts are finished. An inexact answer is measured, with accelerations free of the path's rounding; in
// space the forces are computed anew from the word, too.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Solved() {
  if constexpr (!kIsExact<Scalar>) {
    if (!IsFinite()) return End(Outcome::kUndecided, "a number is not finite");
    const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
    const Scalar tolerance = std::max(Scalar(ResidualOf<Scalar>(request_)), least);
    if (!InSpace() || !SolveLastWord(tolerance)) ComputeAccelerations();
    if (!(Residual() <= tolerance)) return End(Outcome::kUndecided, "the residual is above the tolerance");
  }
  End(Outcome::kSolved);
}

// f from the equations of the word; false, with f as it was, if they do not determine it to the tolerance.
template <class Scalar, int Rows>
bool CompleteDriving<Scalar, Rows>::SolveLastWord(const Scalar& tolerance) {
  using System = DirectionSystem<Scalar, Rows>;
  if (direction_.SolveForces(*problem_, unknowns_, scale_) != System::Status::kRegular) return false;
  const Vector path_end = std::exchange(f_, direction_.df());
  ComputeAccelerations();
  if (Residual() <= tolerance) return true;
  f_ = path_end;
  return false;
}

// a = A f + b, free of the path's rounding.
template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::ComputeAccelerations() {
  a_ = problem_->b;
  for (int i = 0; i < problem_->rows(); ++i) {
    for (int j = 0; j < problem_->rows(); ++j) a_[i] += problem_->A(i, j) * f_[j];
  }
}

template <class Scalar, int Rows>
Scalar CompleteDriving<Scalar, Rows>::Residual() const {
  // The gate looks more closely, and refines.
  if (InSpace()) return PolygonErrors(*problem_, *polygons_, f_, a_, Scalar(1)).Largest();
  return MeasureLeniently(*problem_, FrictionLaw::kCoulomb, f_, a_).error;
}

// ---- The trace -------------------------------------------------------------------------------

// In the plane.
template <class Scalar, int Rows>
std::vector<IndexSet> CompleteDriving<Scalar, Rows>::Sets() const {
  std::vector<IndexSet> sets(InSpace() ? 0 : problem_->rows(), IndexSet::kNone);
  for (int i = 0; i < static_cast<int>(word_.size()) && !InSpace(); ++i) {
    const auto of_contact = SetsOf(word_[i]);
    sets[RowOf(i)] = of_contact[0];
    if (Size(i) == 2) sets[RowOf(i) + 1] = FrictionIsDriven(i) ? IndexSet::kNone : of_contact[1];
  }
  return sets;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::Record(int determinant, PathTurn turn) {
  if (trace_ == nullptr || !trace_->keep_pivots) return;
  Pivot<Scalar>& pivot = trace_->pivots.emplace_back();
  pivot.drive = static_cast<int>(verdict_.statistics[Counter::kStages]);
  pivot.driven = RowOf(driven_) + (stage_ == Stage::kFriction);
  pivot.df = direction_.df();
  pivot.da = direction_.da();
  pivot.limiting = -1;
  pivot.f = f_;
  pivot.a = a_;
  pivot.sets = Sets();
  pivot.word = Name(word_, problem_->dimension);
  pivot.determinant = determinant;
  pivot.turn = turn;
}

template <class Scalar, int Rows>
void CompleteDriving<Scalar, Rows>::RecordEnd(const Candidate& reached) {
  if (trace_ == nullptr || !trace_->keep_pivots) return;
  Pivot<Scalar>& pivot = trace_->pivots.back();
  pivot.s = reached.s;
  pivot.limiting = RowOf(reached.facet.contact) + !reached.facet.OfNormal();
  pivot.f = f_;
  pivot.a = a_;
  const std::vector<IndexSet> before = std::exchange(pivot.sets, Sets());
  if (InSpace()) return;
  pivot.from = before[pivot.limiting];
  pivot.to = pivot.wanted = pivot.sets[pivot.limiting];
}

// The names of the cells of the last run.
template <class Scalar, int Rows>
std::string CompleteDriving<Scalar, Rows>::Word() const {
  if (InSpace()) return Name(word_, 3);
  std::string word;
  for (const LawCell& cell : word_) word += Name(cell, 2);
  return word;
}

}  // namespace stiction
