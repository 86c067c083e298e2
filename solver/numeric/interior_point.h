// SPDX-License-Identifier: Apache-2.0
// Coulomb's law by an interior point method in the space of bodies, for problems in factors, in the plane and
// in space: forces from nothing, where Newton's method (body_newton.h) has no start that is near.
//
// v: accelerations of the bodies, a = J v + c of the contacts, M (v - w) = J' f. Per contact, with R = mu fN
// and g = fF / R, pairs of positive numbers (fN, y) and, where friction is static, (l, s) whose products go to
// zero:
//
//   y = aN                                     fN y = tau wN
//   aF + l g = 0,   s = R / 2 (1 - |g|^2)      l s  = tau wF
//
// With tau = 0 that is the law itself: s > 0 sticks, l > 0 slips, y > 0 separates. Nothing is smoothed, no cone
// is needed, and plane and space are one code. Sliding contacts, fF = -mu slip fN, have the first pair alone,
// bilateral ones none.
//
//   step     two right-hand sides of one factorization of K = M + J' D J (body_matrix.h): predictor, corrector
//            (S. Mehrotra, SIAM J. Optimization 2, 1992). Forces may move by dx against a miss of delta A_cc
//            dx, which is gone when dx is; and the change of y comes from the row of its product, not from du:
//            so y of a contact that hardly feels an impact stays right in its own unit.
//   snap     each contact put exactly into the mode that f - a / A_cc asks for; this is what is judged. tau
//            goes far below rounding.
//   finish   Newton's method from where the path ends: to rounding where that is a solution; where it is none
//            Newton's method mostly finds one.
//   attempts other weights, starts and deltas, where neither ends in a solution. No proof of an end.
//   curve    some paths turn back: past a fold tau has to rise before it falls, and no step to a smaller tau
//            gets there. So later attempts go by the length of the curve of all (v, f, pairs, tau), along its
//            tangent, and return to it across the tangent by Newton's method (E. L. Allgower, K. Georg,
//            Numerical Continuation Methods, 1990). Lengths are relative changes of the pairs and of tau.
//
// Called solved are forces whose errors (problem/errors.h) are at most `residual`; whatever else is undecided,
// and the best forces are returned. S. J. Wright, Primal-Dual Interior-Point Methods, 1997, has the frame of
// it.
//
// Shapes  f, a: rows x 1; v: velocities x 1. For contacts of all kinds. Doubles.
// Cost    an LU factorization a step, as large as the bodies; 20 to 60 steps an attempt.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/numeric/best_forces.h"
#include "solver/numeric/body_matrix.h"
#include "solver/numeric/body_newton.h"
#include "solver/problem/options.h"

namespace stiction {

// Of a request residual, noise and limits.stop are read.
//
// Reusable. Memory and the ordering are kept between runs; answers do not depend on earlier ones.
class InteriorPoint {
 public:
  using Problem = FactoredProblem<double>;
  using Vector = Eigen::VectorXd;

  explicit InteriorPoint(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }

  static constexpr int kAttempts = 24;  // at most
  static constexpr double kAim = 1e-10;
  double aim = kAim;  // error at which a path ends
  double loose = 0;   // error at which no attempt follows after some, though it is undecided; 0: none
  BestForces::Measure measure = BestForces::Measure::kStrict;  // of errors

  RunEnd<> Run(const Problem& problem);

  // The best forces that the last run found, their error, and a = A f + b.
  const Vector& f() const { return best_.f(); }
  const Vector& a() const { return best_.a(); }
  double error() const { return best_.error(); }
  // Whether they are solved by the strict measure, too.
  bool IsStrict() const { return is_strict_; }

 private:
  // Numbers whose product goes to tau times the weight; their changes, those of the predictor, and what
  // x dy + y dx is to be.
  struct Pair {
    double x = 1, y = 1, weight = 1;
    double dx = 0, dy = 0, ahead_x = 0, ahead_y = 0, aim = 0;
  };
  struct State {
    ContactKind kind = ContactKind::kStatic;  // frictionless also where mu is 0
    Pair normal, slip;                        // (fN, y); (l, s)
    std::array<double, 2> g{}, e{};           // fF / R; its direction
    double length = 0;                        // of g
    double miss = 0, slack_miss = 0;          // y - aN; s - R / 2 (1 - |g|^2)
    std::array<double, 2> slip_miss{};        // aF + l g
    double give = 0, Q = 0;                   // l / R + delta A_cc; (l / R + delta A_cc) s + l |g|^2
    double along = 0;                         // D_pN / D_NN
  };
  struct Attempt {
    double step = 0.9;    // of the way to the boundary
    double delta = 1e-8;  // of A_cc
    double first = 1;     // scale of the start
    double spread = 0;    // scatter of weights
    double kappa = 30;    // weight of slip beside normals
    bool curve = false;   // by its length
  };
  static constexpr int kTurnCount = 9, kFirstTurns = 3;
  static const std::array<Attempt, kTurnCount> kTurns;

  int MostAttempts() const;
  void Begin(const Attempt& attempt);
  void Follow();
  void FollowCurve();
  bool ReturnToCurve(Vector& tangent, double& tau, int& left, int& corrections, double& cosine);
  void Finish(bool is_last);
  template <class Visit>
  void ForEachPair(Visit visit);
  double MeanProduct();
  bool Diverges() const;
  void Offer();
  void TakeResiduals();
  void Aim(double sigma, double tau, bool corrects);
  bool SolveStep();
  double Longest();
  double LongestInside(std::size_t contact) const;
  void Move(double length);
  Vector WayOfStep(double tau);
  Vector Relative(const Vector& way) const;
  void MoveAlong(const Vector& way, double length, double& tau);
  void TakeForces();
  double Chance();

  Request request_;
  RunEnd<> verdict_;
  const Problem* problem_ = nullptr;
  BodyMatrix matrix_;
  Attempt attempt_;
  std::uint64_t seed_ = 1;
  double most_b_ = 0;  // the largest abs(b_i) of any row, each as if its A_ii were 1
  int pairs_ = 0;
  bool is_strict_ = false;
  std::vector<State> states_;            // by contact
  std::vector<BodyMatrix::Block> D_;     // by contact
  Vector v_, f_, dv_, df_, unbalanced_;  // the last: M (v - w) - J' f
  Vector end_;                           // forces that the path was judged by last
  BestForces best_;
  BodyNewton newton_;
};

}  // namespace stiction
