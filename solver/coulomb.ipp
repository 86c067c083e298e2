// SPDX-License-Identifier: Apache-2.0
// Definitions for coulomb.h.

#ifndef STICTION_SOLVER_COULOMB_IPP_
#define STICTION_SOLVER_COULOMB_IPP_

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/complete_space.ipp"
#include "solver/coulomb.h"
#include "solver/residual.h"

namespace stiction {

template <class Scalar>
CoulombVerdict CoulombSolver<Scalar>::Run(const Problem& problem, const Vector* start) {
  Start(problem);
  if (start != nullptr) {
    f_ = *start;
    Newton();
  } else if (options_.start == CoulombStart::kSweeps) {
    Sweep(options_.sweeps);
    Newton();
  }
  for (int factor = 1; factor <= 8 && options_.sides > 0 && !Reached(); factor *= 2)
    FromPolygon(factor * options_.sides);
  CoulombVerdict verdict;
  verdict.statistics = statistics_;
  verdict.residual = static_cast<double>(best_);
  verdict.outcome = Reached() ? Outcome::kSolved : Outcome::kUndecided;
  if (!Reached()) verdict.reason = "the residual is above the tolerance";
  return verdict;
}

template <class Scalar>
void CoulombSolver<Scalar>::Start(const Problem& problem) {
  problem_ = &problem;
  statistics_ = {};
  first_row_.assign(1, 0);
  r_.clear();
  Scalar max_A = 0;
  for (const auto& contact : problem.contacts) {
    const int row = first_row_.back(), size = contact.HasFrictionRows() ? 3 : 1;
    Scalar trace = 0;
    for (int k = row; k < row + size; ++k) trace += problem.A(k, k);
    max_A = std::max(max_A, trace);
    r_.push_back(trace > 0 ? 1 / trace : Scalar(1));
    first_row_.push_back(row + size);
  }
  regular_ = problem.A;
  const Scalar shift = std::pow(std::numeric_limits<Scalar>::epsilon(), Scalar(0.75)) * (max_A > 0 ? max_A : 1);
  for (int i = 0; i < problem.rows(); ++i) regular_(i, i) += shift;
  f_ = Vector::Zero(problem.rows());
  best_f_ = f_;
  best_a_ = problem.b;
  best_ = CoulombResidual(problem, best_f_, best_a_);
}

template <class Scalar>
bool CoulombSolver<Scalar>::Reached() const {
  return best_ <= std::max(Scalar(options_.residual), 8 * std::numeric_limits<Scalar>::epsilon());
}

template <class Scalar>
void CoulombSolver<Scalar>::FromPolygon(int sides) {
  driving_.options().tolerances = options_.tolerances;
  driving_.options().limits = options_.limits;
  const CompleteVerdict verdict = driving_.Run(
      *problem_,
      std::vector<FrictionPolygon<Scalar>>(problem_->contacts.size(), FrictionPolygon<Scalar>(sides)));
  ++statistics_.polygons;
  statistics_.pieces += verdict.statistics.pieces;
  f_ = driving_.f();
  if (!f_.allFinite()) return;
  Newton();
}

// Projected steps contact by contact; a = A f + b is kept up to date.
template <class Scalar>
void CoulombSolver<Scalar>::Sweep(int count) {
  using std::hypot;
  a_ = problem_->A * f_ + problem_->b;
  for (; count > 0; --count) {
    ++statistics_.sweeps;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      const auto& contact = problem_->contacts[i];
      const int row = first_row_[i], size = first_row_[i + 1] - row;
      const Scalar r = r_[i];
      Triple to = {f_[row] - r * a_[row], Scalar(0), Scalar(0)};
      if (contact.kind != ContactKind::kBilateral && contact.kind != ContactKind::kStatic)
        to[0] = std::max(Scalar(0), to[0]);
      if (contact.kind == ContactKind::kSliding)
        to = {to[0], -contact.mu * to[0] * contact.slip[0], -contact.mu * to[0] * contact.slip[1]};
      if (contact.kind == ContactKind::kStatic) {
        const Scalar shifted = to[0] - r * contact.mu * hypot(a_[row + 1], a_[row + 2]);
        to = ProjectOnCone<Scalar>({shifted, f_[row + 1] - r * a_[row + 1], f_[row + 2] - r * a_[row + 2]},
                                   contact.mu);
      }
      for (int k = 0; k < size; ++k) {
        const Scalar change = to[k] - f_[row + k];
        if (change == 0) continue;
        f_[row + k] = to[k];
        a_ += change * problem_->A.col(row + k);
      }
    }
  }
}

// Computes a, and keeps the point if it is the best so far. Returns its residual.
template <class Scalar>
Scalar CoulombSolver<Scalar>::Note() {
  a_ = problem_->A * f_ + problem_->b;
  const Scalar residual = CoulombResidual(*problem_, f_, a_);
  if (residual < best_) {
    best_ = residual;
    best_f_ = f_;
    best_a_ = a_;
  }
  return residual;
}

// From f_, until the residual is that of rounding or does not fall any more.
template <class Scalar>
void CoulombSolver<Scalar>::Newton() {
  ++statistics_.starts;
  Scalar before = Note();
  constexpr int kMostSweeps = 1000;
  int idle = 0, rest = 20;
  for (int step = 0; step < options_.newton_steps && problem_->rows() > 0; ++step) {
    if (best_ <= 4 * std::numeric_limits<Scalar>::epsilon() || (Reached() && idle > 4)) return;
    ++statistics_.newton_steps;
    const Matrix J = Slope();
    const Vector map = Map(f_, a_);
    if (!LineSearch(J.partialPivLu().solve(-map)) && !LineSearch(DampedStep(J, map))) {
      if (rest > kMostSweeps) return;
      Sweep(rest);
      rest *= 2;
    }
    const Scalar residual = Note();
    idle = residual < before / 2 ? 0 : idle + 1;
    before = residual;
  }
}

// The step of Levenberg and Marquardt: it stays bounded where J is singular.
template <class Scalar>
auto CoulombSolver<Scalar>::DampedStep(const Matrix& J, const Vector& map) const -> Vector {
  Matrix normal = J.transpose() * J;
  const Scalar damping = map.squaredNorm() / (map.squaredNorm() + f_.squaredNorm()) * normal.trace();
  normal.diagonal().array() += damping / static_cast<Scalar>(f_.size());
  return normal.ldlt().solve(-J.transpose() * map);
}

// f += t step for the first t = 1, 1/2, 1/4, ... that makes the map smaller; false if there is none.
template <class Scalar>
bool CoulombSolver<Scalar>::LineSearch(const Vector& step) {
  if (!step.allFinite()) return false;
  const Scalar present = Map(f_, a_).squaredNorm();
  for (Scalar t = 1; t > Scalar(1e-3); t /= 2) {
    const Vector f = f_ + t * step;
    const Vector a = problem_->A * f + problem_->b;
    if (!(Map(f, a).squaredNorm() < (1 - t / 1000) * present)) continue;
    f_ = f;
    return true;
  }
  return false;
}

template <class Scalar>
auto CoulombSolver<Scalar>::Map(const Vector& f, const Vector& a) const -> Vector {
  using std::hypot;
  Vector map(f.size());
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const auto& contact = problem_->contacts[i];
    const int row = first_row_[i];
    const Scalar r = r_[i];
    if (contact.kind == ContactKind::kBilateral) {
      map[row] = r * a[row];
      continue;
    }
    const Scalar normal = std::max(Scalar(0), f[row] - r * a[row]);
    map[row] = f[row] - normal;
    if (!contact.HasFrictionRows()) continue;
    Scalar x = -contact.mu * f[row] * contact.slip[0], y = -contact.mu * f[row] * contact.slip[1];
    if (contact.kind == ContactKind::kStatic) {
      x = f[row + 1] - r * a[row + 1];
      y = f[row + 2] - r * a[row + 2];
      const Scalar length = hypot(x, y), radius = contact.mu * normal;
      if (length > radius) {
        x *= radius / length;
        y *= radius / length;
      }
    }
    map[row + 1] = f[row + 1] - x;
    map[row + 2] = f[row + 2] - y;
  }
  return map;
}

template <class Scalar>
auto CoulombSolver<Scalar>::Slope() const -> Matrix {
  Matrix J = Matrix::Zero(problem_->rows(), problem_->rows());
  for (std::size_t i = 0; i < r_.size(); ++i) SlopeOfContact(static_cast<int>(i), J);
  return J;
}

// Rows of contact i of the derivative of the map, on the piece of the present point.
template <class Scalar>
void CoulombSolver<Scalar>::SlopeOfContact(int i, Matrix& J) const {
  using std::hypot;
  const auto& contact = problem_->contacts[i];
  const int row = first_row_[i];
  const Scalar r = r_[i];
  const Scalar normal = f_[row] - r * a_[row];
  const bool open = contact.kind != ContactKind::kBilateral && normal <= 0;
  if (open) {
    J(row, row) = 1;
  } else {
    J.row(row) = r * regular_.row(row);
  }
  if (!contact.HasFrictionRows()) return;
  if (contact.kind == ContactKind::kSliding) {
    for (int k = 0; k < 2; ++k) {
      J(row + 1 + k, row + 1 + k) = 1;
      J(row + 1 + k, row) = contact.mu * contact.slip[k];
    }
    return;
  }
  const Scalar x = f_[row + 1] - r * a_[row + 1], y = f_[row + 2] - r * a_[row + 2];
  const Scalar length = hypot(x, y), radius = open ? Scalar(0) : contact.mu * normal;
  if (length <= radius && !open) {
    J.row(row + 1) = r * regular_.row(row + 1);
    J.row(row + 2) = r * regular_.row(row + 2);
    return;
  }
  J(row + 1, row + 1) = J(row + 2, row + 2) = 1;
  if (open || length == 0) return;
  // fF - radius u, u = s / length: its derivative is 1 - mu u dsN - radius / length (1 - u u') ds.
  const Scalar u[2] = {x / length, y / length};
  const Scalar shrink = radius / length;
  for (int k = 0; k < 2; ++k) {
    J.row(row + 1 + k) += contact.mu * u[k] * r * regular_.row(row);
    J(row + 1 + k, row) -= contact.mu * u[k];
    for (int j = 0; j < 2; ++j) {
      const Scalar across = shrink * ((k == j ? 1 : 0) - u[k] * u[j]);
      J.row(row + 1 + k) += across * r * regular_.row(row + 1 + j);
      J(row + 1 + k, row + 1 + j) -= across;
    }
  }
}

}  // namespace stiction

#endif  // STICTION_SOLVER_COULOMB_IPP_
