// SPDX-License-Identifier: Apache-2.0
// Coulomb's law by Newton's method in the space of bodies, for problems in factors, in the plane and in space.
//
//   proximal   from f, the problem with A + eps D and b - eps D f; D has one number a contact, its largest
//   A_ii.
//              Its forces are a function of the accelerations v of the bodies alone, contact by contact:
//                a = J v + c,   p = f - inv(eps D) a,   f+ = the point of the law's cone that p asks for
//              (fN+ = max(0, pN); fF+ the nearest point to pF of the interval or disc of radius mu fN+).
//              At a fixed point f the problem itself is solved, whatever eps is.
//   Newton     on R(v) = M (v - w) - J' f+(v), which is piecewise smooth, in the plane piecewise linear. Its
//              matrix is M + J' S J with a block S = -df+/da per contact: as large as the bodies' velocities,
//              whatever the number of contacts, with entries where two bodies touch. Where nothing slips it is
//              symmetric and positive definite. Its ordering is kept as long as the same bodies touch.
//
// The method of multipliers in other words: J. C. Simo, T. A. Laursen, Computers and Structures 42, 1992; P.
// Alart, A. Curnier, Computer Methods in Applied Mechanics and Engineering 92, 1991 (both cited from memory).
//
// From forces near a solution, as those of the frame before, one or two points with small eps end it; of forces
// that are not unique it takes some near the start. Called solved are forces whose errors (problem/errors.h)
// are at most `residual`; whatever else is undecided, and the best forces are returned.
// Shapes  f, a: rows x 1; v: velocities x 1. For contacts of all kinds. Doubles.
// Cost    a sparse LDL' or, where something slips, LU factorization per step of Newton's method.

#pragma once

#include <vector>

#include "solver/numeric/best_forces.h"
#include "solver/numeric/body_matrix.h"
#include "solver/problem/options.h"

namespace stiction {

// Of a request residual, noise and limits.stop are read.
//
// Reusable. Memory and the ordering are kept between runs; answers do not depend on earlier ones.
class BodyNewton {
 public:
  using Problem = FactoredProblem<double>;
  using Vector = Eigen::VectorXd;

  explicit BodyNewton(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }

  static constexpr double kAim = 1e-12, kWarmEps = 1e-6;
  static constexpr int kPoints = 100, kFailures = 1000, kSteps = 20;
  double aim = kAim;           // error at which it ends; above it, and good enough, when points gain nothing
  double warm_eps = kWarmEps;  // the first eps with a start
  int points = kPoints;        // proximal problems tried
  int failures = kFailures;    // proximal problems that Newton's method may not solve
  int steps = kSteps;          // of Newton's method for a proximal problem
  BestForces::Measure measure = BestForces::Measure::kStrict;  // of errors
  bool measures_start = true;  // and stays there, if it is a solution; false: only where nothing else is found

  // With `start` (rows x 1, N) it begins there.
  RunEnd<> Run(const Problem& problem, const Vector* start = nullptr);

  // The best forces that the last run found, and a = A f + b.
  const Vector& f() const { return best_.f(); }
  const Vector& a() const { return best_.a(); }

 private:
  using Block = BodyMatrix::Block;

  void Start(const Problem& problem, const Vector* start);
  bool Settle();
  void Backtrack(const Vector& step);
  void Evaluate();
  bool Factor();

  Request request_;
  RunEnd<> verdict_;
  const Problem* problem_ = nullptr;
  BodyMatrix matrix_;
  std::vector<double> near_, largest_;  // of one contact's columns, and of those of all

  double eps_ = 0;
  Vector center_;  // of the proximal point
  Vector v_, f_, R_;
  std::vector<Block> slopes_, factored_;  // S by contact, now and of the factors
  double factored_eps_ = 0;
  bool symmetric_ = true, is_factored_ = false;
  double size_ = 0;  // what R is made of
  BestForces best_;
};

}  // namespace stiction
