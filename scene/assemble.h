// SPDX-License-Identifier: Apache-2.0
// Assemble: a scene and its contacts become the smallest problems that represent them.
//
// Rows and their bias are in rows.h. In space a contact has one row of friction more, given forces include the
// gyroscopic moment -w x (I w), and problems are of dimension 3: their law is Coulomb's, with the round cone.
//
// Levels: what the problem says, by its b. WF are the accelerations that the given forces cause.
//
//   forces       a = A f + b at this instant, (15), (16) of [Baraff94]: b = J WF + bias. Contacts that part
//                faster than `rest` are left out: they have no force, whatever aN. A tangential speed above
//                `rest` makes a contact sliding (24). With a step h > 0 what is there already counts as well.
//                Velocities v are those of the middle of the step before, of length h' (0: of this instant),
//                and v + k W (F + J' f), k = (h + h') / 2, those of the middle of this one. With them the gap
//                after the motion x += h v is gap + h J v + h^2 bias / 2, to second order, so
//                  b_N = J WF + (J v + h bias / 2 + max(gap, 0) / h) / k,   friction and joints without gap,
//                says that it stays open. A kept contact has J v = h' bias / 2: then b = J WF + bias as above;
//                what rest there is of velocities that should be zero is taken away. A contact that parts may
//                be back before the end of the step: it is left out only as long as it is not `closing`.
//   impulses     velocities after = A p + b, b = J v - h' bias / 2 (b_N += max(gap, 0) / h): an inelastic
//   collision with
//                restitution 0, Coulomb's law between impulse and velocity after; friction is static
//                throughout, and whatever slips is at its limit by the law itself. Unless driven bodies close
//                on each other, every problem of this kind has a solution: gaps are >= 0, so b is in range(A) +
//                K* (complete_driving.md, 5). (Restitution 0 and laws at this level: D. E. Stewart, J. C.
//                Trinkle, IJNME 39, 1996, 2673-2691, cited from memory.)
//   positions    displacements after = A l + b, b the gaps and the displacements of joints: the least
//                correction, in the metric of the masses, that mends overlap and joints to first order. No
//                friction.
//
// Only what is required (`minimal`), each step exact:
//   frictionless contacts have one row; contacts that part have none (at the level of forces); inner contacts
//   of a face are dropped (FindRedundant); islands are problems of their own. Joints are bilateral rows, which
//   solver/problem/reduction.h eliminates before a method runs.

#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "scene/contacts.h"
#include "scene/mechanics.h"

namespace stiction {

enum class Level : std::uint8_t { kForces, kImpulses, kPositions };
inline constexpr std::array kLevelNames = {"forces", "impulses", "positions"};

template <class Scalar, int Dof = 3>
struct SceneModel {
  std::vector<BodyDynamics<Scalar, Dof>> bodies;
  std::vector<Constraint<Scalar, Dof>> constraints;  // that the problems hold
  std::vector<Island> islands;
  // Contacts that were left out: they part; their force is one of others.
  std::vector<int> parting, redundant;
  // Contacts that approach faster than `rest`; at the level of forces they count as at rest.
  std::vector<int> colliding;

  // That of an island.
  ContactProblem<Scalar> Problem(std::size_t island) const {
    return DenseProblemOf(bodies, constraints, islands[island]);
  }
  FactoredProblem<Scalar> InFactors(std::size_t island) const {
    return FactoredProblemOf(bodies, constraints, islands[island]);
  }
};

template <class Kind, class Scalar>
using ModelIn = SceneModel<Scalar, Kind::kDof>;

// minimal  false: islands together, redundant contacts kept, friction rows for every contact, and, with a step,
//          contacts that part. (At the instant itself those have no row: f = 0 is no condition of (15).)
// step     h, s; 0: the instant itself
// before   h', of the step before, s; velocities are those of its middle; 0: of this instant
template <class Kind, class Scalar>
ModelIn<Kind, Scalar> Assemble(const SceneIn<Kind, Scalar>& scene,
                               const std::vector<TouchPointIn<Kind, Scalar>>& contacts,
                               Level level = Level::kForces, bool minimal = true,
                               const std::type_identity_t<Scalar>& step = Scalar(0),
                               const std::type_identity_t<Scalar>& before = Scalar(0));

// Accelerations of all bodies (x, y, spin; x, y, z, three spins) under gravity, applied forces and f, a vector
// of forces per island.
template <class Scalar, int Dof>
std::vector<Eigen::Matrix<Scalar, Dof, 1>> BodyAccelerations(
    const SceneModel<Scalar, Dof>& model, const std::vector<typename ContactProblem<Scalar>::Vector>& f);

// The forces of `minimal` as forces of the one problem of `full`, a model of the same scene and contacts with
// minimal = false: zero where a contact or row was left out.
template <class Scalar, int Dof>
typename ContactProblem<Scalar>::Vector ExtendForces(
    const SceneModel<Scalar, Dof>& minimal, const std::vector<typename ContactProblem<Scalar>::Vector>& f,
    const SceneModel<Scalar, Dof>& full);

// Line by line what was modelled at this level, what was left out, and why that is exact.
template <class Kind, class Scalar>
std::vector<std::string> Explain(const SceneIn<Kind, Scalar>& scene,
                                 const std::vector<TouchPointIn<Kind, Scalar>>& contacts,
                                 const ModelIn<Kind, Scalar>& model, Level level);

}  // namespace stiction
