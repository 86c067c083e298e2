// SPDX-License-Identifier: Apache-2.0
// Definitions of body_newton.h.

#pragma once

#include <algorithm>
#include <limits>

#include "solver/numeric/body_newton.h"

namespace stiction {

inline constexpr double kFirstBodyEps = 1e-2, kLeastBodyEps = 1e-7;
inline constexpr int kBodyNewton = 20;   // steps of Newton's method for a proximal problem
inline constexpr int kBodyHalvings = 6;  // of a step that does not make R smaller

template <class Scalar>
RunEnd<> BodyNewton<Scalar>::Run(const Problem& problem, const Vector* start) {
  Start(problem, start);
  constexpr int kIdle = 3;  // points that gain nothing before a solution is good enough
  const Scalar kHopeless(1e4), least(kLeastBodyEps);
  eps_ = Scalar(start != nullptr ? warm_eps : kFirstBodyEps);
  Scalar best = Measured();
  best_f_ = f_;
  best_a_ = a_;
  int idle = 0, failures = 0;
  while (!(best <= Scalar(aim))) {
    const bool is_good = best <= Scalar(ResidualOf<Scalar>(request_));
    if (request_.limits.Stopped() && !is_good) {
      verdict_.reason = kStopped;
      return verdict_;
    }
    if (request_.limits.Stopped()) break;
    if (verdict_.statistics[Counter::kPoints] == points || eps_ > kHopeless || (is_good && idle == kIdle)) {
      if (is_good) break;
      verdict_.reason = eps_ > kHopeless ? "Newton's method settles for no eps" : "too many proximal points";
      return verdict_;
    }
    ++verdict_.statistics[Counter::kPoints];
    ++idle;
    const Vector v = v_;
    if (!Settle()) {
      if (++failures > this->failures) {
        verdict_.reason = "Newton's method settles too rarely";
        return verdict_;
      }
      v_ = v;
      eps_ *= 3;
      continue;
    }
    center_ = f_;
    eps_ = std::max(std::min(least, eps_), Scalar(eps_ / 10));
    const Scalar now = Measured();
    if (now < best / 2) idle = 0;
    if (!(now < best)) continue;
    best = now;
    best_f_ = f_;
    best_a_ = a_;
  }
  verdict_.outcome = Outcome::kSolved;
  return verdict_;
}

template <class Scalar>
void BodyNewton<Scalar>::Start(const Problem& problem, const Vector* start) {
  problem_ = &problem;
  verdict_ = {.statistics = {Counter::kPoints, Counter::kNewtonSteps, Counter::kFactorizations}};
  is_factored_ = false;
  lu_.ForgetPivots();
  TakePieces();
  TakePattern();
  if (start != nullptr) {
    center_ = *start;
  } else {
    center_.setZero(problem.rows());
  }
  f_ = center_;
  v_ = problem.w + problem.Responses(f_);
}

// The rows of J by contact, and D.
template <class Scalar>
void BodyNewton<Scalar>::TakePieces() {
  const auto& J = problem_->A.J();
  pieces_.clear();
  columns_.clear();
  entries_.clear();
  D_.clear();
  Scalar largest(0);
  int row = 0, slot = 0;
  for (const auto& contact : problem_->contacts) {
    Piece piece;
    piece.row = row;
    piece.rows = contact.HasFrictionRows() ? problem_->dimension : 1;
    piece.column = static_cast<int>(columns_.size());
    piece.entry = static_cast<int>(entries_.size());
    piece.slot = slot;
    for (int i = row; i < row + piece.rows; ++i) {
      for (typename Problem::Matrix::Rows::InnerIterator of(J, i); of; ++of)
        columns_.push_back(static_cast<int>(of.col()));
    }
    std::sort(columns_.begin() + piece.column, columns_.end());
    columns_.erase(std::unique(columns_.begin() + piece.column, columns_.end()), columns_.end());
    piece.columns = static_cast<int>(columns_.size()) - piece.column;
    slot += piece.columns * piece.columns;
    entries_.resize(entries_.size() + static_cast<std::size_t>(piece.rows * piece.columns), Scalar(0));
    Scalar own(0);
    for (int i = 0; i < piece.rows; ++i) {
      const auto begin = columns_.begin() + piece.column;
      for (typename Problem::Matrix::Rows::InnerIterator of(J, row + i); of; ++of) {
        const auto at = std::lower_bound(begin, columns_.end(), static_cast<int>(of.col())) - begin;
        entries_[piece.entry + i * piece.columns + at] = of.value();
      }
      own = std::max(own, Scalar(problem_->A.coeff(row + i, row + i)));
    }
    D_.push_back(own);
    largest = std::max(largest, own);
    pieces_.push_back(piece);
    row += piece.rows;
  }
  for (Scalar& d : D_) {
    if (!(d > 0)) d = largest > 0 ? largest : Scalar(1);
  }
  int width = 0;
  for (const Piece& piece : pieces_) width = std::max(width, piece.columns);
  near_.resize(width);
}

// K's pattern, its ordering, and where the pieces and M stand in it; kept where they are those of the run
// before.
template <class Scalar>
void BodyNewton<Scalar>::TakePattern() {
  std::vector<int> rows;
  for (const Piece& piece : pieces_) rows.push_back(piece.columns);
  const Matrix& M = problem_->M;
  std::vector<int> mass(M.innerIndexPtr(), M.innerIndexPtr() + M.nonZeros());
  mass.insert(mass.end(), M.outerIndexPtr(), M.outerIndexPtr() + M.outerSize() + 1);
  if (rows == known_rows_ && columns_ == known_columns_ && mass == known_mass_ && K_.cols() == M.cols()) return;
  known_rows_ = rows;
  known_columns_ = columns_;
  known_mass_ = mass;
  std::vector<Eigen::Triplet<Scalar>> places;
  for (int k = 0; k < M.outerSize(); ++k) {
    for (typename Matrix::InnerIterator of(M, k); of; ++of) places.emplace_back(of.row(), k, Scalar(1));
  }
  for (const Piece& piece : pieces_) {
    for (int j = 0; j < piece.columns; ++j) {
      for (int i = 0; i < piece.columns; ++i)
        places.emplace_back(columns_[piece.column + i], columns_[piece.column + j], Scalar(1));
    }
  }
  K_.resize(M.rows(), M.cols());
  K_.setFromTriplets(places.begin(), places.end());
  const auto slot = [this](int i, int j) {
    const int *from = K_.innerIndexPtr() + K_.outerIndexPtr()[j],
              *to = K_.innerIndexPtr() + K_.outerIndexPtr()[j + 1];
    return static_cast<int>(std::lower_bound(from, to, i) - K_.innerIndexPtr());
  };
  mass_slots_.clear();
  for (int k = 0; k < M.outerSize(); ++k) {
    for (typename Matrix::InnerIterator of(M, k); of; ++of) mass_slots_.push_back(slot(of.row(), k));
  }
  slots_.clear();
  for (const Piece& piece : pieces_) {
    for (int j = 0; j < piece.columns; ++j) {
      for (int i = 0; i < piece.columns; ++i)
        slots_.push_back(slot(columns_[piece.column + i], columns_[piece.column + j]));
    }
  }
  if (K_.cols() > 0) ldlt_.analyzePattern(K_);  // the orderings of Eigen take no empty matrix
  lu_knows_ = false;
}

// The largest error of f_, with the rounding of its accelerations.
template <class Scalar>
Scalar BodyNewton<Scalar>::Measured() {
  a_ = problem_->A.J() * (problem_->w + problem_->Responses(f_)) + problem_->c;
  told_a_ = a_;
  for (Scalar& x : told_a_) x = Abs(x) <= Scalar(request_.noise) ? Scalar(0) : x;
  const Errors<Scalar> errors = MeasureErrors(*problem_, FrictionLaw::kCoulomb, f_, told_a_, meter_,
                                              WorkingTheta<Scalar>(request_.residual, problem_->rows()));
  return errors.Largest() + std::numeric_limits<Scalar>::epsilon() * errors.amplification;
}

// Solves the proximal problem of center_ from v_ on; false if Newton's method does not come to rest. It does
// where R is rounding, and where it no longer falls on a piece that is linear, or nearly.
template <class Scalar>
bool BodyNewton<Scalar>::Settle() {
  const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon(), small(1e-9);
  Evaluate();
  if (R_.size() == 0) return true;  // there are no velocities: f_ is all that it can be
  Scalar before = std::numeric_limits<Scalar>::infinity();
  for (int step = 0; step <= kBodyNewton; ++step) {
    const Scalar now = R_.cwiseAbs().maxCoeff();
    if (now <= rounding * size_ || (now <= small * size_ && !(now < before / 2))) return true;
    if (step == kBodyNewton) break;
    before = now;
    ++verdict_.statistics[Counter::kNewtonSteps];
    if (request_.limits.Stopped() || !Factor()) break;
    Backtrack(Solved(R_));
    if (!v_.allFinite()) break;
  }
  return false;
}

// v_ less the step, or less a part of it that makes R smaller; where none of some does, less the last of them.
template <class Scalar>
void BodyNewton<Scalar>::Backtrack(const Vector& step) {
  const Vector from = v_;
  const Scalar norm = R_.norm();
  Scalar part(1);
  for (int halvings = 0;; ++halvings, part /= 2) {
    v_ = from - part * step;
    Evaluate();
    if (halvings == kBodyHalvings || R_.norm() <= (1 - part / 1000) * norm) return;
  }
}

// f_, slopes_ and R_ of v_.
template <class Scalar>
void BodyNewton<Scalar>::Evaluate() {
  slopes_.resize(pieces_.size());
  f_.resize(problem_->rows());
  symmetric_ = true;
  R_ = problem_->M * (v_ - problem_->w);
  size_ = R_.size() > 0 ? R_.cwiseAbs().maxCoeff() : Scalar(0);
  largest_.assign(near_.size(), Scalar(0));
  for (std::size_t c = 0; c < pieces_.size(); ++c) {
    const Piece& piece = pieces_[c];
    const int* columns = columns_.data() + piece.column;
    const Scalar* J = entries_.data() + piece.entry;
    const Scalar slope = 1 / (eps_ * D_[c]);
    const int width = piece.columns;
    for (int k = 0; k < width; ++k) near_[k] = v_[columns[k]];
    std::array<Scalar, 3> p{};
    for (int i = 0; i < piece.rows; ++i) {
      Scalar a = problem_->c[piece.row + i];
      for (int k = 0; k < width; ++k) a += J[i * width + k] * near_[k];
      p[i] = center_[piece.row + i] - a * slope;
    }
    Law(static_cast<int>(c), p, slope);
    if (f_[piece.row] == 0) continue;  // and with it its friction
    std::fill(near_.begin(), near_.begin() + width, Scalar(0));
    for (int i = 0; i < piece.rows; ++i) {
      const Scalar force = f_[piece.row + i];
      for (int k = 0; k < width; ++k) {
        const Scalar part = J[i * width + k] * force;
        near_[k] += part;
        largest_[k] = std::max(largest_[k], Scalar(Abs(part)));
      }
    }
    for (int k = 0; k < width; ++k) R_[columns[k]] -= near_[k];
  }
  for (const Scalar part : largest_) size_ = std::max(size_, part);
}

// The forces that p asks for, and their slope.
template <class Scalar>
void BodyNewton<Scalar>::Law(int contact, const std::array<Scalar, 3>& p, Scalar slope) {
  const Contact<Scalar>& law = problem_->contacts[contact];
  const Piece& piece = pieces_[contact];
  Block& S = slopes_[contact];
  S = {};
  Scalar* f = f_.data() + piece.row;
  for (int i = 0; i < piece.rows; ++i) f[i] = 0;
  if (law.kind != ContactKind::kBilateral && !(p[0] > 0)) return;
  f[0] = p[0];
  S[0][0] = slope;
  if (!law.HasFrictionRows()) return;
  const Scalar limit = law.mu * p[0];
  if (law.kind == ContactKind::kSliding) {
    for (int i = 1; i < piece.rows; ++i) {
      f[i] = -law.slip[i - 1] * limit;
      S[i][0] = -law.slip[i - 1] * law.mu * slope;
    }
    symmetric_ &= law.mu == 0;
    return;
  }
  const Scalar length = piece.rows == 2 ? Scalar(Abs(p[1])) : Length(p[1], p[2]);
  if (length <= limit) {
    for (int i = 1; i < piece.rows; ++i) {
      f[i] = p[i];
      S[i][i] = slope;
    }
    return;
  }
  symmetric_ &= law.mu == 0;
  for (int i = 1; i < piece.rows; ++i) {
    const Scalar ti = p[i] / length;
    f[i] = limit * ti;
    S[i][0] = law.mu * ti * slope;
    for (int j = 1; j < piece.rows && piece.rows == 3; ++j)
      S[i][j] = limit / length * ((i == j) - ti * p[j] / length) * slope;
  }
}

template <class Scalar>
bool BodyNewton<Scalar>::Factor() {
  if (is_factored_ && eps_ == factored_eps_ && slopes_ == factored_) return true;
  ++verdict_.statistics[Counter::kFactorizations];
  Scalar* K = K_.valuePtr();
  std::fill(K, K + K_.nonZeros(), Scalar(0));
  const Scalar* M = problem_->M.valuePtr();
  for (std::size_t k = 0; k < mass_slots_.size(); ++k) K[mass_slots_[k]] += M[k];
  for (std::size_t c = 0; c < pieces_.size(); ++c) {
    const Block& S = slopes_[c];
    if (S[0][0] == 0) continue;
    const Piece& piece = pieces_[c];
    const Scalar* J = entries_.data() + piece.entry;
    const int* slot = slots_.data() + piece.slot;
    for (int j = 0; j < piece.columns; ++j) {
      std::array<Scalar, 3> SJ{};
      for (int i = 0; i < piece.rows; ++i) {
        for (int k = 0; k < piece.rows; ++k) SJ[i] += S[i][k] * J[k * piece.columns + j];
      }
      for (int k = 0; k < piece.columns; ++k, ++slot) {
        Scalar sum(0);
        for (int i = 0; i < piece.rows; ++i) sum += J[i * piece.columns + k] * SJ[i];
        K[*slot] += sum;
      }
    }
  }
  uses_lu_ = !symmetric_;
  if (uses_lu_) {
    if (!lu_knows_) lu_.Order(K_);
    lu_knows_ = true;
    is_factored_ = lu_.Factor(K_);
  } else {
    ldlt_.factorize(K_);
    is_factored_ = ldlt_.info() == Eigen::Success;
  }
  factored_eps_ = eps_;
  factored_ = slopes_;
  return is_factored_;
}

template <class Scalar>
auto BodyNewton<Scalar>::Solved(const Vector& y) -> Vector {
  if (uses_lu_) return lu_.Solve(K_, y);
  return ldlt_.solve(y);
}

}  // namespace stiction
