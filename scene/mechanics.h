// SPDX-License-Identifier: Apache-2.0
// Mechanics: from rows of a Jacobian to problems a = A f + b. Knows nothing of geometry; plane and space alike.
//
// Dof is the number of velocities of a body: 3 in the plane (x, y, spin), 6 in space.
//
//   A = J W J'        W the inverses of the bodies' mass matrices; formed from the given J without further
//                     rounding over rationals: symmetric, positive semidefinite, range(A) = range(J)
//   accelerations     W (F + J' f)
//
// An island is a set of bodies that constraints connect; fixed bodies connect nothing. Each island is a problem
// of its own: the A of all is the block diagonal of theirs. An island keeps J; A is formed when a method asks
// for it, and only from rows that share a body which can move.

#pragma once

#include <array>
#include <vector>

#include "solver/problem/forms.h"

namespace stiction {

template <class Scalar, int Dof>
struct BodyDynamics {
  using Vector = Eigen::Matrix<Scalar, Dof, 1>;
  using Matrix = Eigen::Matrix<Scalar, Dof, Dof>;

  bool fixed = false;
  Matrix M, W;      // mass matrix and its inverse, zero if fixed
  Vector velocity;  // and spin
  Vector force;     // gravity, applied and gyroscopic forces and moments; zero if fixed
  Vector imposed = Vector::Constant(Scalar(0));  // acceleration of a fixed body, whatever acts on it

  Vector FreeAcceleration() const { return fixed ? imposed : Vector(W * force); }
};

// One row: the velocity of the constraint is J[0] v_first + J[1] v_second.
template <class Scalar, int Dof>
struct ConstraintRow {
  std::array<Eigen::Matrix<Scalar, Dof, 1>, 2> J;
  Scalar bias = Scalar(0);   // the acceleration of the constraint where the bodies have none
  Scalar error = Scalar(0);  // gap of a normal row, displacement of a joint's, 0 of a tangential one
  Scalar b = Scalar(0);      // what the problem gets
};

// One contact of a problem, and where it comes from.
template <class Scalar, int Dof>
struct Constraint {
  std::array<int, 2> bodies = {0, 0};
  Contact<Scalar> law;
  std::vector<ConstraintRow<Scalar, Dof>> rows;  // normal, then tangential
  bool from_joint = false;
  int source = 0;  // number of the joint or of the contact
  int part = 0;    // which row of the joint
};

template <class Kind, class Scalar>
using RowIn = ConstraintRow<Scalar, Kind::kDof>;
template <class Kind, class Scalar>
using ConstraintIn = Constraint<Scalar, Kind::kDof>;

template <class Scalar, int Dof>
Scalar Velocity(const Constraint<Scalar, Dof>& constraint, int row,
                const std::vector<BodyDynamics<Scalar, Dof>>& bodies) {
  Scalar velocity(0);
  for (int side = 0; side < 2; ++side)
    velocity += constraint.rows[row].J[side].dot(bodies[constraint.bodies[side]].velocity);
  return velocity;
}

struct Island {
  std::vector<int> bodies;       // that can move, ascending
  std::vector<int> constraints;  // in order
  int rows = 0;
};

// The islands that have constraints, ordered by their first one; all in one if `together`. Constraints between
// bodies that cannot move are in none.
template <class Scalar, int Dof>
std::vector<Island> FindIslands(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                const std::vector<Constraint<Scalar, Dof>>& constraints, bool together);

// The island's problem from its constraints' laws, rows and b: with all of A, rows x rows, and in factors,
// whose velocities are those of the island's bodies in their order.
template <class Scalar, int Dof>
ContactProblem<Scalar> DenseProblemOf(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                      const std::vector<Constraint<Scalar, Dof>>& constraints,
                                      const Island& island);
template <class Scalar, int Dof>
FactoredProblem<Scalar> FactoredProblemOf(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                                          const std::vector<Constraint<Scalar, Dof>>& constraints,
                                          const Island& island);

// W J' f of an island's forces, added to `change`, a vector per body.
template <class Scalar, int Dof>
void AddResponse(const std::vector<BodyDynamics<Scalar, Dof>>& bodies,
                 const std::vector<Constraint<Scalar, Dof>>& constraints, const Island& island,
                 const typename ContactProblem<Scalar>::Vector& f,
                 std::vector<Eigen::Matrix<Scalar, Dof, 1>>& change);

// Numbers of constraints that can be dropped: no acceleration of any solution changes. Each of them has the
// bodies and the law of two others, j and k (or of one, j = k), and with some 0 <= w <= 1
//
//   J_N = w J_N[j] + (1 - w) J_N[k],  b_N >= w b_N[j] + (1 - w) b_N[k],  J_F and b_F equal to theirs
//
// (b_F matters to static contacts only), as the inner contacts of a flat face have in the plane.
//
// Proof. Let aN = w aN[j] + (1 - w) aN[k] + d, d >= 0 the excess of b_N, and aF = aF[j] = aF[k].
//   A solution without the constraint is one with it at f = 0: aN >= 0 by the formula; fN aN = 0; fF = 0.
//   A solution with it, forces (fN, fF): give w (fN, fF) to j, the rest to k. J' f, so every acceleration,
//   stays as it is. Where fN > 0, aN = 0, so aN[j] = 0 if w > 0, and aN[k] = 0 if w < 1: (15) holds for those
//   that get some. abs(fF) <= mu fN adds up, as mu is the same; aF > 0 had all of them at -mu fN, aF < 0 at mu
//   fN, and for aF = 0 nothing else is asked: (16) holds. Sliding: fF = -mu slip fN adds up.    QED
// In space a frictionless constraint is dropped likewise where it is such a mean of three others: the points of
// a face inside the hull of the rest. The proof is the same with three shares. With friction it would be wrong:
// forces at the corners also turn about the normal, so J_F differs, and only constraints at one point agree.
// Different mu break it: the wrenches that the two can give need not contain that of a rough contact between.
// Over doubles equality is to 1e-12 of the numbers compared. What a plane parts from all others of its bodies,
// by more than that, is no mean of them and not compared further. Numbers ascending.
template <class Scalar, int Dof>
std::vector<int> FindRedundant(const std::vector<Constraint<Scalar, Dof>>& constraints);

}  // namespace stiction
