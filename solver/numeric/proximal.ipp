// SPDX-License-Identifier: Apache-2.0
// Definitions of proximal.h.

#pragma once

#include <Eigen/SparseLU>
#include <limits>

#include "solver/numeric/proximal.h"
#include "solver/problem/check.h"

namespace stiction {

inline constexpr double kFirstProximalEps = 0.1;
inline constexpr int kProximalPoints = 200;  // proximal problems tried
inline constexpr int kProximalNewton = 12;   // steps of Newton's method for each of them

template <class Scalar>
RunEnd<> ProximalNewton<Scalar>::Run(const Problem& problem) {
  Start(problem);
  const Scalar kHopeless(1e6);  // so large an eps keeps f where it is
  constexpr int kIdle = 4;      // points that gain nothing before a solution is good enough
  Scalar eps(kFirstProximalEps), best = Measured();
  int idle = 0;
  while (!(best <= Scalar(aim_))) {
    const bool is_good = best <= Scalar(ResidualOf<Scalar>(request_));
    if (verdict_.statistics[Counter::kPoints] == kProximalPoints || eps > kHopeless ||
        (is_good && idle == kIdle)) {
      if (is_good) break;
      verdict_.reason = eps > kHopeless ? "Newton's method settles for no eps" : "too many proximal points";
      return verdict_;
    }
    if (request_.limits.Stopped()) {
      verdict_.reason = kStopped;
      return verdict_;
    }
    ++verdict_.statistics[Counter::kPoints];
    ++idle;
    Regularize(eps);
    if (!Settle()) {
      eps *= 3;
      continue;
    }
    f_ = trial_;
    for (std::size_t i = 0; i < row_of_.size(); ++i)  // no limit holds its rounding
      if (problem.contacts[i].HasFrictionRows() && problem.contacts[i].mu == 0) f_[row_of_[i] + 1] = Scalar(0);
    a_ = problem.A * f_ + problem.b;
    eps /= 2;
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

// The largest error of f_, with the rounding of A f.
template <class Scalar>
Scalar ProximalNewton<Scalar>::Measured() const {
  const Errors<Scalar> errors = MeasureErrors(*problem_, FrictionLaw::kCoulomb, f_, a_);
  return errors.Largest() + std::numeric_limits<Scalar>::epsilon() * errors.amplification;
}

template <class Scalar>
void ProximalNewton<Scalar>::Start(const Problem& problem) {
  STICTION_CHECK(problem.dimension == 2, "proximal points are for planar problems");
  problem_ = &problem;
  verdict_ = {.statistics = {Counter::kPoints, Counter::kFactorizations}};
  const int rows = problem.rows();
  f_ = Vector::Zero(rows);
  a_ = problem.b;
  best_f_ = f_;
  best_a_ = a_;
  D_ = problem.A.diagonal();
  const Scalar largest = rows > 0 ? D_.maxCoeff() : Scalar(0);
  for (Scalar& d : D_) {
    if (!(d > 0)) d = largest > 0 ? largest : Scalar(1);
  }
  proximal_.contacts = problem.contacts;
  row_of_ = NormalRowsOf(problem);
}

// The proximal problem of f_.
template <class Scalar>
void ProximalNewton<Scalar>::Regularize(Scalar eps) {
  proximal_.b = problem_->b - eps * D_.cwiseProduct(f_);
  typename Problem::Matrix shift(problem_->rows(), problem_->rows());
  shift.setIdentity();
  shift.diagonal() = eps * D_;
  proximal_.A = problem_->A + shift;
}

// Solves the proximal problem into trial_; false if the cells do not come to rest.
template <class Scalar>
bool ProximalNewton<Scalar>::Settle() {
  trial_ = f_;
  trial_a_ = proximal_.A * trial_ + proximal_.b;
  Vector before;
  for (int step = 0; step < kProximalNewton; ++step) {
    before = trial_;
    TakeCells();
    ListUnknowns();
    if (!SolveCells()) return false;
    trial_a_ = proximal_.A * trial_ + proximal_.b;
    if (trial_.size() == 0) return true;
    // Forces come to rest: cells of contacts that carry nothing may go on changing with the rounding.
    if ((trial_ - before).cwiseAbs().maxCoeff() <= kSettled * trial_.cwiseAbs().maxCoeff()) return true;
  }
  return false;
}

// The cell of each contact: where f - inv(D) a lies.
template <class Scalar>
void ProximalNewton<Scalar>::TakeCells() {
  cells_.clear();
  for (std::size_t c = 0; c < problem_->contacts.size(); ++c) {
    const auto& contact = problem_->contacts[c];
    const int row = row_of_[c];
    const auto wanted = [&](int i) { return trial_[i] - trial_a_[i] / proximal_.A.coeff(i, i); };
    Cell cell = Cell::kFree;
    if (contact.kind != ContactKind::kBilateral && !(wanted(row) > 0)) {
      cell = Cell::kBreak;
    } else if (contact.kind == ContactKind::kStatic) {
      const Scalar limit = contact.mu * wanted(row);
      const Scalar friction = wanted(row + 1);
      cell = friction > limit ? Cell::kUpper : friction < -limit ? Cell::kLower : Cell::kStick;
    }
    cells_.push_back(cell);
  }
}

// Rows whose force the cells leave free; friction elsewhere follows its normal force or is zero.
template <class Scalar>
void ProximalNewton<Scalar>::ListUnknowns() {
  unknowns_.clear();
  unknown_of_.assign(problem_->rows(), -1);
  follows_ = Vector::Zero(problem_->rows());
  const auto add = [this](int row) {
    unknown_of_[row] = static_cast<int>(unknowns_.size());
    unknowns_.push_back(row);
  };
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto& contact = problem_->contacts[c];
    const int row = row_of_[c];
    if (cells_[c] == Cell::kBreak) continue;
    add(row);
    if (cells_[c] == Cell::kStick) add(row + 1);
    if (cells_[c] == Cell::kUpper) follows_[row] = contact.mu;
    if (cells_[c] == Cell::kLower) follows_[row] = -contact.mu;
    if (contact.kind == ContactKind::kSliding) follows_[row] = -contact.mu * contact.slip[0];
  }
}

// trial_: the forces that leave the rows of unknowns_ without acceleration. False if they are not determined.
template <class Scalar>
bool ProximalNewton<Scalar>::SolveCells() {
  const int size = static_cast<int>(unknowns_.size());
  trial_.setZero();
  if (size == 0) return true;
  std::vector<Eigen::Triplet<Scalar>> entries;
  const auto add_column = [&](int row, int column, Scalar factor) {
    for (typename Problem::Matrix::InnerIterator entry(proximal_.A, row); entry; ++entry) {
      const int unknown = unknown_of_[entry.row()];
      if (unknown >= 0) entries.emplace_back(unknown, column, factor * entry.value());
    }
  };
  for (int k = 0; k < size; ++k) {
    add_column(unknowns_[k], k, Scalar(1));
    if (follows_[unknowns_[k]] != 0) add_column(unknowns_[k] + 1, k, follows_[unknowns_[k]]);
  }
  typename Problem::Matrix M(size, size);
  M.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<typename Problem::Matrix> factors(M);
  ++verdict_.statistics[Counter::kFactorizations];
  if (factors.info() != Eigen::Success) return false;
  const Vector solution = factors.solve(-proximal_.b(unknowns_));
  for (int k = 0; k < size; ++k) {
    const int row = unknowns_[k];
    trial_[row] = solution[k];
    if (follows_[row] != 0) trial_[row + 1] = follows_[row] * solution[k];
  }
  return true;
}

}  // namespace stiction
