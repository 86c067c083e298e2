// SPDX-License-Identifier: Apache-2.0
// ADMM: alternating directions of multipliers, on the cone of friction, in the plane and in space.
//
// Coulomb's law with a = A f + b is, with g = mu abs(aF) added to the normal acceleration of each contact (De
// Saxce's term; cited from memory), complementarity of forces and the dual cone: K is where f is, a + g is in
// K*, and f.(a + g) = 0. For g at rest that is a convex program where A is semidefinite; here g follows the
// multipliers from step to step. In units D of each contact, with the penalty rho:
//
//   x = inv(A + rho D) (rho D (z - w) - b - g)     quadratic part
//   y = alpha x + (1 - alpha) z                    over-relaxed, alpha = 1.6
//   z = nearest point of K to y + w,   w = w + y - z
//
// -rho D w is in K*, and tends to a + g. The penalty is balanced: where x - z, relative to forces, and rho D
// times the change of z, relative to the multipliers, are far from each other, rho moves by the root of their
// ratio, and the matrix is factored again; the longer it runs, the rarer.
//
// Where 200 steps do not halve the error, alpha goes half the way to 1, and a smaller share of g is new in a
// step: with g of large mu over-relaxed steps can go round in circles.
//
// Sources Boyd, Parikh, Chu, Peleato and Eckstein 2011; with contacts Acary, Bremond and Huber 2018 (both cited
//         from memory).
// Shapes  f, a: rows x 1. Static and frictionless contacts; A need not be symmetric. Floating-point scalars.
// Ensures `solved` means measured errors (problem/errors.h) of at most AdmmOptions::residual. Nothing else is
//         claimed: while g moves there is no theorem of convergence.
// Cost    O(rows^2) per step, O(rows^3) per factorization.

#ifndef STICTION_SOLVER_NUMERIC_ADMM_H_
#define STICTION_SOLVER_NUMERIC_ADMM_H_

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "solver/problem/errors.h"
#include "solver/problem/options.h"
#include "solver/problem/problem.h"
#include "solver/problem/solution.h"
#include "solver/problem/units.h"

namespace stiction {

struct AdmmOptions {
  Limits limits = {};              // of which only `stop` is read
  double residual = 1e-8;          // largest error of an answer that is called solved
  std::int64_t iterations = 5000;  // at most
  double relaxation = 1.6;         // alpha, 1 to 2, of the first steps
  double share = 0.5;              // of g that is new in a step, of the first steps
  double penalty = 1;              // the first rho

  bool operator==(const AdmmOptions&) const = default;
};

struct AdmmStatistics {
  std::int64_t iterations = 0;
  std::int64_t factorizations = 0;

  bool operator==(const AdmmStatistics&) const = default;
};

// visit(name, help, counter)
template <class S, class Visit>
requires std::is_same_v<std::remove_const_t<S>, AdmmStatistics>
void ForEachField(S& s, Visit visit) {
  visit("iterations", "steps of alternating directions", s.iterations);
  visit("factorizations", "factorizations of A with a penalty", s.factorizations);
}

using AdmmVerdict = RunEnd<AdmmStatistics>;  // solved, undecided

// Reusable.
template <class Scalar>
class Admm {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;
  using Matrix = typename Problem::Matrix;

  explicit Admm(const AdmmOptions& options = {}) : options_(options) {}

  AdmmVerdict Run(const Problem& problem) {
    Start(problem);
    while (!Done()) {
      const Vector before = z_;
      Step();
      if (statistics_.iterations % kEvery != 0) continue;
      Note();
      Balance(before);
    }
    AdmmVerdict verdict;
    verdict.statistics = statistics_;
    verdict.outcome = Reached() ? Outcome::kSolved : Outcome::kUndecided;
    if (!Reached())
      verdict.reason = options_.limits.Stopped() ? kStopped : "the residual is above the tolerance";
    return verdict;
  }

  // The best point found.
  const Vector& f() const { return best_f_; }

 private:
  static constexpr int kEvery = 10;         // steps between two looks at the errors
  static constexpr double kUnbalanced = 5;  // ratio of residuals from which rho moves
  static constexpr double kMostMove = 10;   // of rho at a time
  static constexpr int kPatience = 200;     // steps in which the error is to be halved
  static constexpr double kLeastShare = 0.125;

  struct Part {
    int row, size;
    Scalar mu;
  };

  void Start(const Problem& problem) {
    problem_ = &problem;
    statistics_ = {};
    parts_.clear();
    D_.resize(problem.rows());
    int row = 0;
    for (const auto& contact : problem.contacts) {
      const int size = contact.HasFrictionRows() ? problem.dimension : 1;
      const Scalar mean = problem.A.diagonal().segment(row, size).sum() / Scalar(size);
      D_.segment(row, size).setConstant(mean > 0 ? mean : Scalar(1));
      parts_.push_back({row, size, contact.mu});
      row += size;
    }
    rho_ = Scalar(options_.penalty);
    pause_ = kEvery;
    next_ = pause_;
    relaxation_ = Scalar(options_.relaxation);
    share_ = Scalar(options_.share);
    x_ = z_ = w_ = g_ = best_f_ = Vector::Zero(problem.rows());
    best_ = expected_ = std::numeric_limits<Scalar>::infinity();
    hopeful_ = 0;
    Note();
    if (!Reached()) Factor();
  }

  bool Reached() const {
    return best_ <= std::max(Scalar(options_.residual), 8 * std::numeric_limits<Scalar>::epsilon());
  }

  bool Done() const {
    return Reached() || options_.limits.Stopped() || statistics_.iterations >= options_.iterations ||
           !z_.allFinite();
  }

  void Factor() {
    Matrix penalized = problem_->A;
    penalized.diagonal() += rho_ * D_;
    factor_.compute(penalized);
    ++statistics_.factorizations;
  }

  void Step() {
    ++statistics_.iterations;
    Vector right = rho_ * D_.cwiseProduct(z_ - w_) - problem_->b;
    for (const Part& part : parts_) {
      Scalar& g = g_[part.row];
      g += share_ * (DeSaxce(part) - g);
      right[part.row] -= g;
    }
    x_ = factor_.solve(right);
    w_ += relaxation_ * x_ + (1 - relaxation_) * z_;  // y + w
    z_ = w_;
    for (const Part& part : parts_) Project(part);
    w_ -= z_;
  }

  // mu abs(aF), by the multipliers.
  Scalar DeSaxce(const Part& part) const {
    const Scalar speed = rho_ * D_[part.row] * w_.segment(part.row + 1, part.size - 1).norm();
    return speed > 0 ? Scalar(part.mu * speed) : Scalar(0);
  }

  // z becomes the nearest point of the cone.
  void Project(const Part& part) {
    Scalar& normal = z_[part.row];
    auto friction = z_.segment(part.row + 1, part.size - 1);
    const Scalar length = friction.norm(), mu = part.mu;
    if (!(length > 0)) {
      normal = std::max(Scalar(0), normal);
    } else if (mu * length <= -normal) {
      normal = 0;
      friction.setZero();
    } else if (length > mu * normal) {
      const bool flat = mu <= 1;  // neither product leaves the range
      const Scalar limit =
          flat ? mu * (normal + mu * length) / (1 + mu * mu) : (normal / mu + length) / (1 + 1 / mu / mu);
      normal = flat ? (normal + mu * length) / (1 + mu * mu) : limit / mu;
      friction *= limit / length;
    }
  }

  // Keeps the point if it is the best. Where the best gets no better, steps become more cautious.
  void Note() {
    const Vector a = problem_->A * z_ + problem_->b;
    const Scalar error = MeasureErrors(*problem_, FrictionLaw::kCoulomb, z_, a, meter_,
                                       WorkingTheta<Scalar>(options_.residual, problem_->rows()))
                             .Largest();
    if (error < best_) {
      best_ = error;
      best_f_ = z_;
    }
    if (best_ < expected_ / 2) {
      expected_ = best_;
      hopeful_ = statistics_.iterations;
    } else if (statistics_.iterations - hopeful_ >= kPatience) {
      relaxation_ = 1 + (relaxation_ - 1) / 2;
      share_ = std::max(Scalar(kLeastShare), share_ / 2);
      hopeful_ = statistics_.iterations;
    }
  }

  Scalar Size(const Vector& forces) const {
    using std::sqrt;
    return sqrt(forces.cwiseAbs2().dot(D_));
  }

  void Balance(const Vector& before) {
    using std::sqrt;
    if (statistics_.iterations < next_ || Reached()) return;
    const Scalar forces = std::max(Size(x_), Size(z_)), multipliers = Size(w_);
    const Scalar primal = Size(x_ - z_), dual = Size(z_ - before);
    if (!(forces > 0 && multipliers > 0 && primal > 0 && dual > 0)) return;
    const Scalar ratio = (primal / forces) / (dual / multipliers);
    if (ratio < kUnbalanced && ratio > 1 / Scalar(kUnbalanced)) return;
    const Scalar most(kMostMove);
    const Scalar factor = std::clamp(Scalar(sqrt(ratio)), Scalar(1 / most), most);
    rho_ *= factor;
    w_ /= factor;
    Factor();
    pause_ += pause_ / 2;
    next_ = statistics_.iterations + pause_;
  }

  AdmmOptions options_;
  const Problem* problem_ = nullptr;
  std::vector<Part> parts_;
  Eigen::PartialPivLU<Matrix> factor_;
  Vector D_;  // by row: the mean of its contact's diagonal of A
  Vector x_, z_, w_, g_;
  Scalar relaxation_ = Scalar(1), share_ = Scalar(1);  // alpha; of g that is new in a step
  Scalar rho_ = Scalar(1);
  std::int64_t pause_ = 0, next_ = 0;  // steps between two moves of rho; the step of the next
  Vector best_f_;
  Scalar best_ = Scalar(0), expected_ = Scalar(0);  // errors: of best_f_; of which half is expected
  std::int64_t hopeful_ = 0;                        // the step at which it was met, or was given up
  ErrorMeter<Scalar> meter_;
  AdmmStatistics statistics_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_NUMERIC_ADMM_H_
