// SPDX-License-Identifier: Apache-2.0
// Coulomb's law in space, with the round cone: friction of a slipping contact is opposite to its acceleration.
//
// Four methods take turns, from one start (Improve):
//
//   Sweeps    contact by contact the force that solves its law while the others keep theirs (one_contact.h).
//   Newton    on the map of Alart and Curnier (cited from memory), per static contact with r > 0:
//               sN = fN - r aN,  sF = fF - r aF,   fN - max(0, sN)  and  fF - P(sF),
//             P the nearest point of the disc of radius mu max(0, sN), whose zeros are the solutions. It is
//             piecewise smooth; with a line search it converges near a solution, quadratically.
//   Path      Newton's method on smoothed laws (smooth_law.h), from f = 0 and a wide m to m = 0, once. A step
//             may make its map larger: the path has turns where b is a little out of range(A).
//   Approach  proximal steps (the regularization of Rockafellar, cited from memory): f becomes the solution
//             of the problem with A + rho / r and b - rho / r f, by Newton's method; rho falls from step to
//             step, and rises where Newton's method fails. A solution f of the problem is a fixed point.
//
// Sweeps cost least and are many; where A is singular, as with more contacts than bodies can tell apart,
// Newton's steps are long, and the other two lead. The smoothed law keeps the forces of contacts that stick
// inside their cones; what the others end at are bounds, and near them they slow down. Starts, in this order: f
// = 0; then the solutions of complete driving on polygons of more and more sides, which exist wherever A is
// semidefinite and b in range(A). A need not be symmetric.
//
// Over floating-point scalars only. `solved` means measured errors (problem/errors.h) of at most
// Request::residual; whatever else is undecided: nothing is claimed of it.
// Singular A: Newton's matrix uses A + d / r, d tiny; the map does not, so its zeros are unchanged.
// Shapes  f, a: rows x 1. All kinds of contacts. Requires dimension 3.
// Cost    O(rows^3) per Newton step, also within proximal ones; O(rows^2) per sweep. With a sparse A a sparse
//         LU factorization, and the entries of A.

#pragma once

#include <cstdint>

#include "solver/complete/complete.h"
#include "solver/numeric/contact_slope.h"
#include "solver/problem/errors.h"
#include "solver/problem/problem.h"

namespace stiction {

enum class CoulombStart : std::uint8_t {
  kSweeps,    // from f = 0; complete driving behind it
  kComplete,  // complete driving at once
};

// Of a request tolerances and limits, which are those of complete driving, residual and sides are read: sides
// of the first polygon; 2, 4 and 8 times as many follow; 0: none.
//
// Reusable. Memory is kept between runs. Problem: a ContactProblem, or a SparseContactProblem, which complete
// driving does not take: without polygons.
template <class Scalar, class ProblemType = ContactProblem<Scalar>>
class CoulombSolver {
 public:
  using Problem = ProblemType;
  using Vector = typename Problem::Vector;

  explicit CoulombSolver(const Request& request = {}, CoulombStart start = CoulombStart::kSweeps)
      : request_(request), start_(start) {}

  Request& request() { return request_; }

  std::int64_t most_newton_steps = std::int64_t{1} << 40;  // in all

  // With `start` (rows x 1, N) it begins there, with Newton's method.
  RunEnd<> Run(const Problem& problem, const Vector* start = nullptr);

  // The best point found.
  const Vector& f() const { return best_f_; }
  const Vector& a() const { return best_a_; }

 private:
  using Matrix = typename Problem::Matrix;
  using Triple = std::array<Scalar, 3>;
  using Block = Eigen::Matrix<Scalar, 3, 3>;
  using Slopes = std::vector<ContactSlope<Scalar>>;

  void Start(const Problem& problem);
  Scalar theta() const { return WorkingTheta<Scalar>(request_.residual, problem_->rows()); }
  bool Reached() const;
  bool Done() const;
  void FromPolygon(int sides);
  void Improve();
  void Sweep(int count);
  Triple ForceOf(int i) const;
  bool Newton();
  void Approach();
  bool LineSearch(const Vector& map, const Vector& step);
  void FollowPath();
  Vector SmoothMap(const Vector& f, const Scalar& m, Slopes* slopes) const;
  bool SmoothStep(const Scalar& m, const Vector& map, const Slopes& slopes);
  void Note();
  Vector Answer(const Vector& f) const;
  Vector Map(const Vector& f, const Vector& a) const;
  ContactSlope<Scalar> SlopeOf(int i) const;

  Request request_;
  CoulombStart start_;
  CompleteDriving<Scalar> driving_;
  const Problem* problem_ = nullptr;
  std::vector<int> first_row_;
  std::vector<Scalar> r_;    // by contact
  std::vector<Block> own_;   // its block of A, in the first entries
  Scalar free_ = Scalar(0);  // max abs(b) / max A_ii: forces that b asks for
  Vector weight_;            // by row, 1 / r
  Scalar rho_ = Scalar(0);
  Vector center_;  // of a proximal step
  bool followed_ = false;
  Matrix regular_;
  Vector f_, a_;
  Vector best_f_, best_a_;
  ErrorMeter<Scalar> meter_;
  Scalar best_ = Scalar(0);
  Counters statistics_;
};

extern template class CoulombSolver<float>;
extern template class CoulombSolver<double>;
extern template class CoulombSolver<double, SparseContactProblem<double>>;

}  // namespace stiction
