// SPDX-License-Identifier: Apache-2.0
// Definitions for coulomb.h.

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/numeric/coulomb.h"
#include "solver/numeric/one_contact.h"
#include "solver/numeric/smooth_law.h"

namespace stiction {

inline constexpr int kFirstSweeps = 20;    // then four times as many each time
inline constexpr int kStepsOfNewton = 60;  // at a time

template <class Scalar, class ProblemType>
RunEnd<> CoulombSolver<Scalar, ProblemType>::Run(const Problem& problem, const Vector* start) {
  Start(problem);
  if (start != nullptr) {
    f_ = *start;
    Improve();
  } else if (start_ == CoulombStart::kSweeps) {
    Sweep(kFirstSweeps);
    Improve();
  }
  for (int factor = 1; factor <= 8 && request_.sides > 0 && !Done(); factor *= 2)
    FromPolygon(factor * request_.sides);
  RunEnd<> verdict;
  verdict.statistics = statistics_;
  verdict.outcome = Reached() ? Outcome::kSolved : Outcome::kUndecided;
  if (!Reached()) verdict.reason = request_.limits.Stopped() ? kStopped : "the residual is above the tolerance";
  return verdict;
}

template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::Start(const Problem& problem) {
  problem_ = &problem;
  statistics_ = {Counter::kSweeps, Counter::kNewtonSteps, Counter::kStarts, Counter::kPolygons,
                 Counter::kPieces};
  first_row_.assign(1, 0);
  r_.clear();
  own_.clear();
  weight_.resize(problem.rows());
  Scalar largest = 0;
  for (const auto& contact : problem.contacts) {
    const int row = first_row_.back(), size = contact.HasFrictionRows() ? 3 : 1;
    Block own = Block::Zero();
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) own(i, j) = problem.A.coeff(row + i, row + j);
      largest = std::max(largest, own(i, i));
    }
    const Scalar trace = own.trace();
    own_.push_back(own);
    r_.push_back(trace > 0 ? 1 / trace : Scalar(1));
    weight_.segment(row, size).setConstant(1 / r_.back());
    first_row_.push_back(row + size);
  }
  free_ = problem.rows() > 0 ? Scalar(problem.b.cwiseAbs().maxCoeff() / largest) : Scalar(0);
  rho_ = 0;
  followed_ = false;
  f_ = Vector::Zero(problem.rows());
  best_f_ = f_;
  best_a_ = problem.b;
  best_ = MeasureErrors(problem, FrictionLaw::kCoulomb, best_f_, best_a_, meter_, theta()).Largest();
}

template <class Scalar, class ProblemType>
bool CoulombSolver<Scalar, ProblemType>::Reached() const {
  return best_ <= std::max(Scalar(ResidualOf<Scalar>(request_)), 8 * std::numeric_limits<Scalar>::epsilon());
}

template <class Scalar, class ProblemType>
bool CoulombSolver<Scalar, ProblemType>::Done() const {
  return Reached() || request_.limits.Stopped() || statistics_[Counter::kNewtonSteps] >= most_newton_steps;
}

template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::FromPolygon(int sides) {
  if constexpr (std::is_same_v<Problem, ContactProblem<Scalar>>) {
    driving_.request().tolerances = request_.tolerances;
    driving_.request().limits = request_.limits;
    const RunEnd<> verdict = driving_.Run(
        *problem_,
        std::vector<FrictionPolygon<Scalar>>(problem_->contacts.size(), FrictionPolygon<Scalar>(sides)));
    ++statistics_[Counter::kPolygons];
    statistics_[Counter::kPieces] += verdict.statistics[Counter::kPieces];
    f_ = driving_.f();
    if (f_.allFinite()) Improve();
  }
}

// From f_. A proximal stage costs as much as thousands of sweeps, the more the larger the problem.
template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::Improve() {
  constexpr int kRounds = 5;
  ++statistics_[Counter::kStarts];
  if (problem_->rows() == 0) return;
  Newton();
  int count = kFirstSweeps;
  for (int round = 0; round < kRounds && !Done(); ++round, count *= 4) {
    if (count > problem_->rows()) {
      FollowPath();
      Approach();
    }
    if (Done()) return;
    Sweep(count);
    Newton();
  }
  if (!Done()) Approach();
}

// Ends early where only roundings move.
template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::Sweep(int count) {
  a_ = problem_->A * f_ + problem_->b;
  for (; count > 0 && !request_.limits.Stopped(); --count) {
    ++statistics_[Counter::kSweeps];
    bool moved = false;
    for (std::size_t i = 0; i < r_.size(); ++i) {
      const int row = first_row_[i], size = first_row_[i + 1] - row;
      const Triple to = ForceOf(static_cast<int>(i));
      for (int k = 0; k < size; ++k) {
        const Scalar change = to[k] - f_[row + k];
        if (change == 0) continue;
        moved = moved || Abs(change) > 4 * std::numeric_limits<Scalar>::epsilon() * Abs(to[k]);
        f_[row + k] = to[k];
        a_ += change * problem_->A.col(row + k);
      }
    }
    if (!moved) return;
  }
}

// The force that solves the law of contact i while the others keep theirs; the present one if there is none.
template <class Scalar, class ProblemType>
auto CoulombSolver<Scalar, ProblemType>::ForceOf(int i) const -> Triple {
  const auto& contact = problem_->contacts[i];
  const int row = first_row_[i];
  const Block& A = own_[i];
  if (contact.kind == ContactKind::kStatic) {
    const Eigen::Matrix<Scalar, 3, 1> f = f_.template segment<3>(row);
    if (!(A(0, 0) > 0)) return {f[0], f[1], f[2]};
    return SolveOneContact<Scalar>(A, a_.template segment<3>(row) - A * f, contact.mu);
  }
  const bool slides = contact.kind == ContactKind::kSliding;
  Triple force = {Scalar(1), Scalar(0), Scalar(0)};  // per fN
  Scalar inertia = A(0, 0), alone = a_[row] - A(0, 0) * f_[row];
  for (int k = 1; k <= 2 && slides; ++k) {
    force[k] = -contact.mu * contact.slip[k - 1];
    inertia += A(0, k) * force[k];
    alone -= A(0, k) * f_[row + k];
  }
  Scalar fN = inertia > 0 ? Scalar(-alone / inertia) : f_[row];
  if (contact.kind != ContactKind::kBilateral) fN = std::max(Scalar(0), fN);
  return {fN, fN * force[1], fN * force[2]};
}

// Keeps f_ if it is the best so far.
template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::Note() {
  const Vector a = problem_->A * f_ + problem_->b;
  const Scalar residual = MeasureErrors(*problem_, FrictionLaw::kCoulomb, f_, a, meter_, theta()).Largest();
  if (!(residual < best_)) return;
  best_ = residual;
  best_f_ = f_;
  best_a_ = a;
}

// The accelerations of the map: those of the problem, or of the proximal one.
template <class Scalar, class ProblemType>
auto CoulombSolver<Scalar, ProblemType>::Answer(const Vector& f) const -> Vector {
  Vector a = problem_->A * f + problem_->b;
  if (rho_ > 0) a += rho_ * weight_.cwiseProduct(f - center_);
  return a;
}

// From f_, until the map is that of rounding or falls no more; with rho > 0, to a hundredth. Whether it got
// there.
template <class Scalar, class ProblemType>
bool CoulombSolver<Scalar, ProblemType>::Newton() {
  using std::pow, std::sqrt;
  const Scalar root = sqrt(std::numeric_limits<Scalar>::epsilon());
  Scalar shift = pow(std::numeric_limits<Scalar>::epsilon(), Scalar(2) / 3);
  regular_ = WithDiagonal<Scalar>(problem_->A, std::max(rho_, shift) * weight_);
  Slopes slopes(r_.size());
  a_ = Answer(f_);
  Note();
  Vector map = Map(f_, a_);
  Scalar before = map.norm();
  const Scalar enough = rho_ > 0 ? before / 100 : Scalar(0);
  int idle = 0;
  for (int step = 0; step < kStepsOfNewton && idle < (Reached() ? 1 : rho_ > 0 ? 10 : 3); ++step) {
    if (best_ <= 4 * std::numeric_limits<Scalar>::epsilon()) return true;
    if (request_.limits.Stopped() || statistics_[Counter::kNewtonSteps] >= most_newton_steps) return false;
    ++statistics_[Counter::kNewtonSteps];
    for (std::size_t i = 0; i < r_.size(); ++i) slopes[i] = SlopeOf(static_cast<int>(i));
    const auto improves = [&] {
      return LineSearch(map, SolveLinear<Scalar>(JoinSlopes(slopes, first_row_, regular_), -map));
    };
    if (!improves()) {  // where A is singular, a shorter step along what does not matter
      if (shift >= root) return false;
      shift = root;
      regular_ = WithDiagonal<Scalar>(problem_->A, std::max(rho_, shift) * weight_);
      if (!improves()) return false;
    }
    Note();
    map = Map(f_, a_);
    const Scalar now = map.norm();
    if (now <= enough) return true;
    idle = now < Scalar(0.9) * before ? 0 : idle + 1;
    before = now;
  }
  return Reached();
}

// Proximal steps.
template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::Approach() {
  constexpr int kMostSteps = 30, kMostFailures = 4;
  rho_ = Scalar(0.01);
  for (int step = 0, failures = 0; step < kMostSteps && failures <= kMostFailures && !Done(); ++step) {
    center_ = f_;
    if (Newton()) {
      rho_ /= 3;
    } else {
      ++failures;
      f_ = center_;
      rho_ = std::min(10 * rho_, Scalar(1));
    }
  }
  rho_ = 0;
  if (Reached()) Newton();
}

// The smoothed laws with m from a tenth of the forces that b asks for downward, each by Newton's method from
// the last; then the best point that was met.
template <class Scalar, class ProblemType>
void CoulombSolver<Scalar, ProblemType>::FollowPath() {
  constexpr int kMostSteps = 1000, kStepsEach = 60, kFew = 2;
  if (std::exchange(followed_, true)) return;
  const std::int64_t end = statistics_[Counter::kNewtonSteps] + kMostSteps;
  f_.setZero();
  Slopes slopes;
  for (Scalar m = free_ / 10; m > Scalar(1e-9) * free_ && statistics_[Counter::kNewtonSteps] < end;) {
    int steps = 0;
    for (; steps < kStepsEach && !Done(); ++steps) {
      const Vector map = SmoothMap(f_, m, &slopes);
      if (map.norm() <= m / 1000) break;
      if (!SmoothStep(m, map, slopes)) break;
      Note();
    }
    if (Done()) break;
    m /= steps <= kFew ? 4 : 2;
  }
  f_ = best_f_;
  Newton();
}

// A step of Newton's method, which may make the map larger; false if there is none.
template <class Scalar, class ProblemType>
bool CoulombSolver<Scalar, ProblemType>::SmoothStep(const Scalar& m, const Vector& map, const Slopes& slopes) {
  ++statistics_[Counter::kNewtonSteps];
  const Vector step = SolveLinear<Scalar>(JoinSlopes(slopes, first_row_, problem_->A), -map);
  if (!step.allFinite()) return false;
  const Scalar most = 20 * map.norm();
  for (Scalar t = 1; t > Scalar(1e-3); t /= 2) {
    const Vector f = f_ + t * step;
    if (!(SmoothMap(f, m, nullptr).norm() < most)) continue;
    f_ = f;
    return true;
  }
  return false;
}

// The smoothed laws of all contacts and, if asked for, their derivative.
template <class Scalar, class ProblemType>
auto CoulombSolver<Scalar, ProblemType>::SmoothMap(const Vector& f, const Scalar& m, Slopes* slopes) const
    -> Vector {
  const Vector a = problem_->A * f + problem_->b;
  Vector map = f;
  if (slopes != nullptr) slopes->assign(r_.size(), {});
  ContactSlope<Scalar> unused;
  for (std::size_t i = 0; i < r_.size(); ++i) {
    const auto& contact = problem_->contacts[i];
    const int row = first_row_[i];
    const Scalar r = r_[i];
    ContactSlope<Scalar>& slope = slopes != nullptr ? (*slopes)[i] : unused;
    if (contact.kind == ContactKind::kBilateral) {
      map[row] = r * a[row];
      slope.by_a(0, 0) = r;
      continue;
    }
    if (contact.kind == ContactKind::kStatic && contact.mu > 0) {
      const SmoothStatic<Scalar> law(f.template segment<3>(row), a.template segment<3>(row), contact.mu, r, m,
                                     m / r * (m / free_));
      map.template segment<3>(row) = law.h;
      slope = {law.by_f, law.by_a};
      continue;
    }
    const SmoothPositive<Scalar> normal(f[row] - r * a[row], m);
    map[row] = f[row] - normal.value;
    slope.by_a(0, 0) = normal.slope * r;
    slope.by_f(0, 0) = 1 - normal.slope;
    if (!contact.HasFrictionRows()) continue;
    for (int k = 1; k <= 2; ++k) {  // zero without friction
      slope.by_f(k, k) = 1;
      if (contact.kind != ContactKind::kSliding) continue;
      map[row + k] += contact.mu * contact.slip[k - 1] * f[row];
      slope.by_f(k, 0) = contact.mu * contact.slip[k - 1];
    }
  }
  return map;
}

// f += t step for the first t = 1, 1/2, 1/4, ... that makes the map smaller; false if there is none.
template <class Scalar, class ProblemType>
bool CoulombSolver<Scalar, ProblemType>::LineSearch(const Vector& map, const Vector& step) {
  if (!step.allFinite()) return false;
  const Scalar present = map.squaredNorm();
  for (Scalar t = 1; t > Scalar(1e-3); t /= 2) {
    const Vector f = f_ + t * step;
    const Vector a = Answer(f);
    if (!(Map(f, a).squaredNorm() < (1 - t / 1000) * present)) continue;
    f_ = f;
    a_ = a;
    return true;
  }
  return false;
}

template <class Scalar, class ProblemType>
auto CoulombSolver<Scalar, ProblemType>::Map(const Vector& f, const Vector& a) const -> Vector {
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

// Derivatives of the map of contact i, on the piece of the present point.
template <class Scalar, class ProblemType>
auto CoulombSolver<Scalar, ProblemType>::SlopeOf(int i) const -> ContactSlope<Scalar> {
  using std::hypot;
  const auto& contact = problem_->contacts[i];
  const int row = first_row_[i];
  const Scalar r = r_[i];
  const Scalar normal = f_[row] - r * a_[row];
  const bool open = contact.kind != ContactKind::kBilateral && normal <= 0;
  ContactSlope<Scalar> slope;
  (open ? slope.by_f : slope.by_a)(0, 0) = open ? Scalar(1) : r;
  if (!contact.HasFrictionRows()) return slope;
  if (contact.kind == ContactKind::kSliding) {
    for (int k = 1; k <= 2; ++k) {
      slope.by_f(k, k) = 1;
      slope.by_f(k, 0) = contact.mu * contact.slip[k - 1];
    }
    return slope;
  }
  const Scalar x = f_[row + 1] - r * a_[row + 1], y = f_[row + 2] - r * a_[row + 2];
  const Scalar length = hypot(x, y), radius = open ? Scalar(0) : contact.mu * normal;
  if (length <= radius && !open) {
    slope.by_a(1, 1) = slope.by_a(2, 2) = r;
    return slope;
  }
  slope.by_f(1, 1) = slope.by_f(2, 2) = 1;
  if (open || length == 0) return slope;
  // fF - radius u, u = s / length: its derivative is 1 - mu u dsN - radius / length (1 - u u') ds.
  const Scalar u[2] = {x / length, y / length};
  const Scalar shrink = radius / length;
  for (int k = 0; k < 2; ++k) {
    slope.by_a(1 + k, 0) = contact.mu * u[k] * r;
    slope.by_f(1 + k, 0) = -contact.mu * u[k];
    for (int j = 0; j < 2; ++j) {
      const Scalar across = shrink * ((k == j ? 1 : 0) - u[k] * u[j]);
      slope.by_a(1 + k, 1 + j) = across * r;
      slope.by_f(1 + k, 1 + j) -= across;
    }
  }
  return slope;
}

}  // namespace stiction
