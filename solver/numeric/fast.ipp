// SPDX-License-Identifier: Apache-2.0
// Definitions for fast.h, in its order.

#pragma once

#include <algorithm>
#include <limits>

#include "solver/numeric/fast.h"

namespace stiction {

// Numbers that were measured (bench --suite peers), not derived.
inline constexpr int FirstSweeps(int rows) { return rows <= 4 ? 1 : rows <= 12 ? 2 : 4; }
inline constexpr int kMoreSweeps = 20;
inline constexpr int kPublishedPivots = 10;  // per row, of the published algorithm
inline constexpr std::int64_t kPublishedWork =
    4'000'000'000;                         // its pivots times rows x rows: 10 a row up to 730 rows
inline constexpr int kFewRows = 16;        // up to which complete driving costs less than more sweeps
inline constexpr int kRounds = 3;          // of sweeps and exchanges
inline constexpr double kRounding = 1e-9;  // of the largest A_ii: asymmetry that rounding makes
inline constexpr double kShift = 1e-9;     // of the diagonal, where columns of M are dependent
inline constexpr double kRefined = 1e-13;  // of the largest b_i
inline constexpr int kRefinements = 4;     // of forces of a shifted M
inline constexpr int kPatience = 4;        // exchanges in a row without fewer violations than ever,
inline constexpr int kSingles = 10;        // then exchanges of one contact each

// ---- The run ---------------------------------------------------------------------------------

template <class Scalar>
RunEnd<> FastSolver<Scalar>::Run(const Problem& problem, std::span<const Cell> guess) {
  Start(problem);
  Guess(guess);
  bool found = Find() && Verify();
  if (!found && !IsSymmetric(Scalar(0))) {  // only one triangle was read where the cells suggest symmetry
    distrust_ = true;
    found = Find() && Verify();
  }
  if (found) {
    verdict_.outcome = Outcome::kSolved;
  } else {
    FallBack();
  }
  return verdict_;
}

template <class Scalar>
void FastSolver<Scalar>::Start(const Problem& problem) {
  const int rows = problem.rows(), contacts = static_cast<int>(problem.contacts.size());
  problem_ = &problem;
  verdict_ = {.statistics = {Counter::kSweeps, Counter::kExchanges, Counter::kFactorizations, Counter::kUpdates,
                             Counter::kPublished, Counter::kFallbacks}};
  f_.resize(rows);
  a_.resize(rows);
  inverse_.resize(rows);
  cells_.resize(contacts);
  next_.resize(contacts);
  row_of_.resize(contacts);
  if (static_cast<int>(unknowns_.size()) <= rows) {
    unknowns_.resize(rows + 1);
    limit_.resize(rows + 1);
    u_.resize(rows + 1);
    correction_.resize(rows + 1);
    factor_.Reserve(rows);
  }
  ForEachContact(problem, [this](int contact, int row, int) { row_of_[contact] = row; });
  frictionless_ = rows == contacts;
  distrust_ = false;
  shift_ = Scalar(0);
  max_A_ = max_b_ = Scalar(0);
  for (int i = 0; i < rows; ++i) {
    f_[i] = Scalar(0);
    a_[i] = problem.b[i];
    inverse_[i] = problem.A(i, i) > 0 ? 1 / problem.A(i, i) : Scalar(0);
    max_A_ = std::max(max_A_, Scalar(Abs(problem.A(i, i))));
    max_b_ = std::max(max_b_, Scalar(Abs(problem.b[i])));
  }
  unit_ = max_A_ > 0 ? 1 / max_A_ : Scalar(0);
  const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
  pivot_ = std::max(Scalar(request_.tolerances.pivot), least);
  zero_a_ = std::max(Scalar(request_.tolerances.acceleration), least);
  zero_f_ = std::max(Scalar(request_.tolerances.force), least);
}

// Whether a contact's friction has cells of its own.
template <class Scalar>
bool HasFrictionCells(const Contact<Scalar>& contact) {
  return contact.kind == ContactKind::kStatic && contact.mu > 0;
}

template <class Scalar>
void FastSolver<Scalar>::Guess(std::span<const Cell> guess) {
  is_given_ = guess.size() == cells_.size();
  if (!is_given_) {
    Sweep(FirstSweeps(problem_->rows()));
    return TakeCells();
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Contact<Scalar>& contact = problem_->contacts[i];
    const bool open = guess[i] == Cell::kBreak || guess[i] == Cell::kNone;
    const bool has_cells = HasFrictionCells(contact);
    cells_[i] = contact.kind == ContactKind::kBilateral ? Cell::kFree
                : open                                  ? Cell::kBreak
                : !has_cells                            ? Cell::kFree
                : guess[i] == Cell::kFree               ? Cell::kStick
                                                        : guess[i];
  }
}

// Cells that the forces of a linear system do not violate.
template <class Scalar>
bool FastSolver<Scalar>::Find() {
  if (ExchangeUntilSettled()) return true;
  if (frictionless_ && !distrust_) return IsSymmetric(Scalar(kRounding) * max_A_) && ActiveSet();
  const int rounds = problem_->rows() > kFewRows ? kRounds : 1;
  for (int round = 1; round < rounds && !(shift_ > 0); ++round) {
    Project();
    SetAccelerations();
    Sweep(kMoreSweeps);
    TakeCells();
    if (ExchangeUntilSettled()) return true;
  }
  return false;
}

// Where many contacts share few bodies, guesses of cells meet dependent rows, and the path of complete driving
// many ties. The published algorithm may loop there, but as a rule it does not, and soon ends in a solution.
template <class Scalar>
bool FastSolver<Scalar>::SolveAsPublished() {
  ++verdict_.statistics[Counter::kPublished];
  published_.request() = request_;
  published_.request().policy = {};
  const auto rows = static_cast<std::int64_t>(problem_->rows());
  std::int64_t& pivots = published_.request().limits.pivots;
  pivots = std::min({pivots, kPublishedPivots * rows, kPublishedWork / (rows * rows)});
  if (published_.Run(*problem_).outcome != Outcome::kSolved) return false;
  const auto& state = published_.state();
  f_ = state.f;
  SetAccelerations();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const int row = row_of_[i];
    const bool has_cells = HasFrictionCells(problem_->contacts[i]);
    cells_[i] = CellOf(state.sets[row], has_cells ? state.sets[row + 1] : IndexSet::kNone);
  }
  return Verify();
}

template <class Scalar>
void FastSolver<Scalar>::FallBack() {
  verdict_.outcome = Outcome::kUndecided;
  verdict_.reason = "no cells were found";
  if (!drives || !PublishedHandles(*problem_)) return;
  if (SolveAsPublished()) {
    verdict_.outcome = Outcome::kSolved;
    verdict_.reason = {};
    return;
  }
  ++verdict_.statistics[Counter::kFallbacks];
  driving_.request() = request_;
  const RunEnd<> driven = driving_.Run(*problem_);
  f_ = driving_.f();
  SetAccelerations();
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i] = driving_.CellOf(static_cast<int>(i));
  const bool verified = Verify();
  verdict_.outcome = driven.outcome;
  verdict_.reason = driven.reason;
  if (verified || driven.outcome != Outcome::kSolved) return;
  verdict_.outcome = Outcome::kUndecided;
  verdict_.reason = "the residual is above the tolerance";
}

template <class Scalar>
std::string FastSolver<Scalar>::Word() const {
  std::string word;
  for (const Cell cell : cells_) word += Name(cell);
  return word;
}

// The errors of f alone: a is A f + b already, unless a force had to be moved. All of A enters, so that one
// number that is not finite spoils the answer.
template <class Scalar>
bool FastSolver<Scalar>::Verify() {
  if (Project()) SetAccelerations();
  const Scalar spoiled = (problem_->A.array() - problem_->A.array()).sum();
  const Scalar least = 8 * std::numeric_limits<Scalar>::epsilon();
  a_told_ = a_;
  const Scalar noise = Scalar(request_.noise);
  for (Scalar& x : a_told_) x = Abs(x) <= noise ? Scalar(0) : x;
  const Errors<Scalar> errors = MeasureErrors(*problem_, FrictionLaw::kCoulomb, f_, a_told_, meter_,
                                              WorkingTheta<Scalar>(request_.residual, problem_->rows()));
  return errors.Largest() + spoiled <= std::max(Scalar(ResidualOf<Scalar>(request_)), least);
}

// Up to `tolerance`: an A from which bilateral rows were eliminated is symmetric but for rounding.
template <class Scalar>
bool FastSolver<Scalar>::IsSymmetric(Scalar tolerance) const {
  for (int j = 0; j < problem_->rows(); ++j) {
    for (int i = 0; i < j; ++i) {
      if (!(Abs(problem_->A(i, j) - problem_->A(j, i)) <= tolerance)) return false;
    }
  }
  return true;
}

// The nearest forces that the laws allow; whether they differ from f.
template <class Scalar>
bool FastSolver<Scalar>::Project() {
  bool changed = false;
  const auto set = [this, &changed](int row, Scalar force) {
    changed |= force != f_[row];
    f_[row] = force;
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Contact<Scalar>& contact = problem_->contacts[i];
    const int row = row_of_[i];
    if (contact.kind != ContactKind::kBilateral) set(row, std::max(f_[row], Scalar(0)));
    if (!contact.HasFrictionRows()) continue;
    const Scalar bound = contact.mu * f_[row];
    set(row + 1, contact.kind == ContactKind::kSliding ? Scalar(-contact.slip[0] * bound)
                                                       : std::clamp(f_[row + 1], Scalar(-bound), bound));
  }
  return changed;
}

// a += A(:, row) factor
template <class Scalar>
void FastSolver<Scalar>::AddColumn(int row, Scalar factor) {
  const int rows = problem_->rows();
  const Scalar* __restrict column = problem_->A.data() + static_cast<std::ptrdiff_t>(row) * rows;
  Scalar* __restrict a = a_.data();
  for (int i = 0; i < rows; ++i) a[i] += factor * column[i];
}

// ---- Gauss-Seidel ----------------------------------------------------------------------------

template <class Scalar>
void FastSolver<Scalar>::Sweep(int sweeps) {
  verdict_.statistics[Counter::kSweeps] += sweeps;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Contact<Scalar>& contact = problem_->contacts[i];
      const int row = row_of_[i];
      const Scalar step = -a_[row] * inverse_[row];
      Push(row, contact.kind == ContactKind::kBilateral ? step : std::max(step, Scalar(-f_[row])));
      if (contact.HasFrictionRows()) SweepFriction(contact, row + 1);
    }
  }
}

template <class Scalar>
void FastSolver<Scalar>::SweepFriction(const Contact<Scalar>& contact, int row) {
  const Scalar bound = contact.mu * f_[row - 1];
  const Scalar wanted = contact.kind == ContactKind::kSliding
                            ? Scalar(-contact.slip[0] * bound)
                            : std::clamp(Scalar(f_[row] - a_[row] * inverse_[row]), Scalar(-bound), bound);
  Push(row, wanted - f_[row]);
}

template <class Scalar>
void FastSolver<Scalar>::Push(int row, Scalar step) {
  if (step == 0) return;
  f_[row] += step;
  AddColumn(row, step);
}

// The cells of the forces that a step of all contacts at once, without a product, would leave.
template <class Scalar>
void FastSolver<Scalar>::TakeCells() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Contact<Scalar>& contact = problem_->contacts[i];
    const int row = row_of_[i];
    const Scalar normal = f_[row] - a_[row] * inverse_[row];
    const bool closed = (normal > 0) | (contact.kind == ContactKind::kBilateral);
    cells_[i] = closed ? Cell::kFree : Cell::kBreak;
    if (!HasFrictionCells(contact) || !closed) continue;
    const Scalar bound = contact.mu * normal, friction = f_[row + 1] - a_[row + 1] * inverse_[row + 1];
    cells_[i] = friction >= bound ? Cell::kUpper : friction <= -bound ? Cell::kLower : Cell::kStick;
  }
}

// ---- Exchanges -------------------------------------------------------------------------------

template <class Scalar>
bool FastSolver<Scalar>::ExchangeUntilSettled() {
  int fewest = std::numeric_limits<int>::max(), patience = kPatience;
  for (int left = kSingles; left > 0; left -= patience < 0) {
    if (!SolveCells()) return false;
    const int moves = ListMoves();
    if (moves == 0) return true;
    if (dropped_ && Shift()) continue;
    if (moves < fewest) {
      fewest = moves;
      patience = kPatience;
    } else if (shift_ > 0) {
      return false;
    } else {
      --patience;
    }
    if (frictionless_ && !distrust_ && (dropped_ || patience < 0)) return false;
    Move(patience < 0);
    ++verdict_.statistics[Counter::kExchanges];
  }
  return false;
}

// Forces and accelerations of the cells. Returns false where they are not determined. With friction, where
// columns of M depend on others, M + shift D is factored instead, D the diagonal of A, and u refined until
// M u = -b: of all such forces about the least, which as a rule are well inside their cones.
template <class Scalar>
bool FastSolver<Scalar>::SolveCells() {
  if (!FactorCells() && !(Shift() && FactorCells())) return false;
  SolveFactored(u_.data());
  SetForces();
  for (int left = shift_ > 0 ? kRefinements : 0; left > 0 && !IsRefined(); --left) {
    SolveFactored(correction_.data());
    for (int j = 0; j < size_; ++j) u_[j] += correction_[j];
    SetForces();
  }
  Scalar max_f = max_b_ * unit_;
  for (int j = 0; j < size_; ++j) max_f = std::max(max_f, Scalar(Abs(u_[j])));
  least_f_ = zero_f_ * max_f;
  least_a_ = zero_a_ * max_A_ * max_f;
  return true;
}

// Written without branches, since which contacts are closed is hard to predict: entries beyond size_ are
// written too.
template <class Scalar>
void FastSolver<Scalar>::ListUnknowns() {
  int size = 0;
  symmetric_ = true;
  const auto add = [this, &size](int row, Scalar limit, bool kept) {
    unknowns_[size] = row;
    limit_[size] = limit;
    u_[size] = -problem_->b[row];
    size += kept;
  };
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    const Contact<Scalar>& contact = problem_->contacts[i];
    const Cell cell = cells_[i];
    if (!contact.HasFrictionRows()) {
      add(row_of_[i], Scalar(0), cell != Cell::kBreak);
      continue;
    }
    const int sign = (cell == Cell::kUpper) - (cell == Cell::kLower);
    const Scalar along = contact.kind == ContactKind::kSliding ? Scalar(-contact.slip[0]) : Scalar(sign);
    const Scalar limit = along * contact.mu;
    add(row_of_[i], limit, cell != Cell::kBreak);
    add(row_of_[i] + 1, Scalar(0), cell == Cell::kStick);
    symmetric_ &= (cell == Cell::kBreak) | (limit == 0);
  }
  size_ = size;
}

// For the rest of the run; unless cells were given, all closed contacts stick at first. Whether there is
// something to try anew.
template <class Scalar>
bool FastSolver<Scalar>::Shift() {
  if (frictionless_ || shift_ > 0) return false;
  shift_ = Scalar(kShift);
  for (std::size_t i = 0; i < cells_.size() && !is_given_; ++i)
    if (cells_[i] != Cell::kBreak && HasFrictionCells(problem_->contacts[i])) cells_[i] = Cell::kStick;
  return true;
}

template <class Scalar>
bool FastSolver<Scalar>::FactorCells() {
  ListUnknowns();
  return IsSolvedAsSymmetric() ? FactorSymmetric() : FactorGeneral();
}

// Whether accelerations of the unknowns are rounding; if not, correction_ is what a step is made of.
template <class Scalar>
bool FastSolver<Scalar>::IsRefined() {
  Scalar missed(0);
  for (int j = 0; j < size_; ++j) {
    Scalar a = a_[unknowns_[j]];
    correction_[j] = -a;
    missed = std::max(missed, Scalar(Abs(a)));
  }
  return missed <= Scalar(kRefined) * max_b_;
}

template <class Scalar>
bool FastSolver<Scalar>::IsSolvedAsSymmetric() const {
  return symmetric_ && !distrust_;
}

template <class Scalar>
void FastSolver<Scalar>::SolveFactored(Scalar* y) const {
  IsSolvedAsSymmetric() ? factor_.SolveSymmetric(y) : factor_.SolveGeneral(y);
}

template <class Scalar>
bool FastSolver<Scalar>::FactorSymmetric() {
  for (int j = 0; j < size_; ++j) {
    const Scalar* from = problem_->A.data() + static_cast<std::ptrdiff_t>(unknowns_[j]) * problem_->rows();
    Scalar* to = factor_.Column(j);
    for (int i = j; i < size_; ++i) to[i] = from[unknowns_[i]];
    to[j] += shift_ * from[unknowns_[j]];
  }
  ++verdict_.statistics[Counter::kFactorizations];
  dropped_ = factor_.FactorSymmetric(size_, pivot_) > 0;
  return true;
}

template <class Scalar>
bool FastSolver<Scalar>::FactorGeneral() {
  const int rows = problem_->rows();
  for (int j = 0; j < size_; ++j) {
    const Scalar* from = problem_->A.data() + static_cast<std::ptrdiff_t>(unknowns_[j]) * rows;
    Scalar* to = factor_.Column(j);
    const Scalar limit = limit_[j];
    if (limit == 0) {
      for (int i = 0; i < size_; ++i) to[i] = from[unknowns_[i]];
    } else {
      for (int i = 0; i < size_; ++i) to[i] = from[unknowns_[i]] + limit * from[unknowns_[i] + rows];
    }
    to[j] += shift_ * from[unknowns_[j]];
  }
  ++verdict_.statistics[Counter::kFactorizations];
  dropped_ = false;
  return factor_.FactorGeneral(size_, pivot_);
}

// f of the unknowns, and a = A f + b.
template <class Scalar>
void FastSolver<Scalar>::SetForces() {
  f_.setZero();
  a_ = problem_->b;
  for (int j = 0; j < size_; ++j) {
    const int row = unknowns_[j];
    f_[row] = u_[j];
    AddColumn(row, u_[j]);
    if (limit_[j] == 0) continue;
    f_[row + 1] = limit_[j] * u_[j];
    AddColumn(row + 1, f_[row + 1]);
  }
}

template <class Scalar>
void FastSolver<Scalar>::SetAccelerations() {
  a_ = problem_->b;
  for (int row = 0; row < problem_->rows(); ++row) {
    if (f_[row] != 0) AddColumn(row, f_[row]);
  }
}

// Fills in next_ and counts the contacts that violate their cells.
template <class Scalar>
int FastSolver<Scalar>::ListMoves() {
  int moves = 0;
  for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
    next_[i] = NextCell(i);
    moves += next_[i] != cells_[i];
  }
  return moves;
}

template <class Scalar>
Cell FastSolver<Scalar>::NextCell(int i) const {
  const Contact<Scalar>& contact = problem_->contacts[i];
  const int normal = row_of_[i], friction = normal + 1;
  const Cell cell = cells_[i];
  const bool open = cell == Cell::kBreak;
  const bool closes = open & (a_[normal] < -least_a_);
  const bool opens = !open & (contact.kind != ContactKind::kBilateral) & (f_[normal] < -least_f_);
  if (!HasFrictionCells(contact)) return closes ? Cell::kFree : opens ? Cell::kBreak : cell;
  if (closes) return a_[friction] < 0 ? Cell::kUpper : Cell::kLower;
  if (opens) return Cell::kBreak;
  if (cell == Cell::kStick) {
    const Scalar bound = contact.mu * f_[normal] + least_f_;
    return f_[friction] > bound ? Cell::kUpper : f_[friction] < -bound ? Cell::kLower : cell;
  }
  if (cell == Cell::kUpper && a_[friction] > least_a_) return Cell::kStick;
  if (cell == Cell::kLower && a_[friction] < -least_a_) return Cell::kStick;
  return cell;
}

template <class Scalar>
void FastSolver<Scalar>::Move(bool last_only) {
  if (!last_only) return cells_.swap(next_);
  int i = static_cast<int>(cells_.size()) - 1;
  while (next_[i] == cells_[i]) --i;
  cells_[i] = next_[i];
}

// ---- Active set ------------------------------------------------------------------------------

template <class Scalar>
bool FastSolver<Scalar>::ActiveSet() {
  if (!StartActiveSet()) return false;
  while (verdict_.statistics[Counter::kUpdates] < request_.limits.pivots) {
    const int contact = MostViolated();
    if (contact < 0) return true;
    if (!Enter(contact)) return false;
    Descend();
    SetForces();
  }
  return false;
}

// Forces >= 0 that are best for their contacts, with a regular matrix: what is dropped or negative leaves.
template <class Scalar>
bool FastSolver<Scalar>::StartActiveSet() {
  while (true) {
    bool left = false;
    for (int j = 0; j < size_; ++j) {
      const bool bilateral = problem_->contacts[unknowns_[j]].kind == ContactKind::kBilateral;
      if (!factor_.IsDropped(j) && (bilateral || u_[j] > 0)) continue;
      if (bilateral) return false;
      cells_[unknowns_[j]] = Cell::kBreak;
      left = true;
    }
    if (!left) return true;
    if (!SolveCells()) return false;
  }
}

template <class Scalar>
int FastSolver<Scalar>::MostViolated() const {
  int worst = -1;
  for (int i = 0; i < problem_->rows(); ++i) {
    if (cells_[i] == Cell::kBreak && a_[i] < (worst < 0 ? -least_a_ : a_[worst])) worst = i;
  }
  return worst;
}

template <class Scalar>
bool FastSolver<Scalar>::Enter(int contact) {
  for (int j = 0; j < size_; ++j) u_[j] = problem_->A(unknowns_[j], contact);
  if (!factor_.Append(u_.data(), problem_->A(contact, contact), pivot_)) return false;
  ++verdict_.statistics[Counter::kUpdates];
  unknowns_[size_] = contact;
  limit_[size_++] = Scalar(0);
  cells_[contact] = Cell::kFree;
  return true;
}

// Toward the best forces of the unknowns; those that reach zero on the way leave.
template <class Scalar>
void FastSolver<Scalar>::Descend() {
  while (true) {
    for (int j = 0; j < size_; ++j) u_[j] = -problem_->b[unknowns_[j]];
    factor_.SolveSymmetric(u_.data());
    Scalar step = Scalar(1);
    const int blocking = Blocking(step);
    if (blocking < 0) return;
    for (int j = 0; j < size_; ++j) {
      Scalar& f = f_[unknowns_[j]];
      f += step * (u_[j] - f);
    }
    Leave(blocking);
  }
}

template <class Scalar>
int FastSolver<Scalar>::Blocking(Scalar& step) const {
  int blocking = -1;
  for (int j = 0; j < size_; ++j) {
    if (!(u_[j] < 0) || problem_->contacts[unknowns_[j]].kind == ContactKind::kBilateral) continue;
    const Scalar f = f_[unknowns_[j]], reach = f / (f - u_[j]);
    if (blocking >= 0 && reach >= step) continue;
    blocking = j;
    step = reach;
  }
  return blocking;
}

template <class Scalar>
void FastSolver<Scalar>::Leave(int j) {
  ++verdict_.statistics[Counter::kUpdates];
  f_[unknowns_[j]] = Scalar(0);
  cells_[unknowns_[j]] = Cell::kBreak;
  factor_.Remove(j);
  --size_;
  for (int k = j; k < size_; ++k) unknowns_[k] = unknowns_[k + 1];
}

}  // namespace stiction
