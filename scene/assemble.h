// SPDX-License-Identifier: Apache-2.0
// Assemble: a scene and its contacts become the smallest problems that represent them.
//
// Rows. With n the normal from b to a, t = n turned by a quarter, p the point, r = p - centre of mass:
//
//   J_N = (n, r_a x n | -n, -(r_b x n))       J_F the same with t
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
// bias, the velocity-dependent part, is the second derivative of what the row measures where no body
// accelerates. Normal rows measure the gap g of the surfaces themselves, a corner or disc at c of a:
//
//   against an edge of b with a point q   g = n.(c - q) - radius, dn/dt = w_b t:
//       bias = n.(c'' - q'') + 2 w_b t.(c' - q') - w_b^2 n.(c - q)
//   against a corner or disc at d of b    g = abs(c - d) - radii:
//       bias = n.(c'' - d'') + (t.(c' - d'))^2 / abs(c - d)
//
// with c'' = -w_a^2 (c - x_a) of a point that turns with its body, likewise q'', d''. [Baraff94], section 3
// takes such terms into b without writing them out. Tangential rows measure the relative acceleration of the
// two material points, which is the derivative of the tangential velocity where that is zero, as it is at
// static contacts:
//       bias = t.(-w_a^2 r_a + w_b^2 r_b)
//
// Only what is required (`minimal`), each step exact:
//   frictionless contacts have one row; contacts that part have none (at the level of forces); inner contacts
//   of a face are dropped (FindRedundant); islands are problems of their own. Joints are bilateral rows, which
//   solver/problem/reduction.h eliminates before a method runs.

#ifndef STICTION_SCENE_ASSEMBLE_H_
#define STICTION_SCENE_ASSEMBLE_H_

#include <string>
#include <vector>

#include "scene/contacts.h"
#include "scene/mechanics.h"

namespace stiction {

enum class Level : std::uint8_t { kForces, kImpulses, kPositions };
inline constexpr std::array kLevelNames = {"forces", "impulses", "positions"};

template <class Scalar>
struct AssembleOptions {
  Level level = Level::kForces;
  Scalar step = Scalar(0);    // h, s; 0: the instant itself
  Scalar before = Scalar(0);  // of the step before, s; velocities are those of its middle; 0: of this instant
  // False: islands together, redundant contacts kept, friction rows for every contact, and, with a step > 0,
  // contacts that part. (At the instant itself those have no row: f = 0 is no condition of (15).)
  bool minimal = true;
  // Contacts, by number:
  std::vector<bool> held;     // that count as static whatever their tangential speed
  std::vector<bool> closing;  // that stay although they part; step > 0
};

enum class OmissionReason : std::uint8_t { kSeparating, kRedundant };

struct Omission {
  int contact = 0;
  OmissionReason reason = OmissionReason::kSeparating;
};

template <class Scalar, int Dof = 3>
struct SceneModel {
  std::vector<BodyDynamics<Scalar, Dof>> bodies;
  std::vector<Constraint<Scalar, Dof>> constraints;  // that the problems hold
  std::vector<Island> islands;
  std::vector<Omission> omitted;
  std::vector<int>
      colliding;  // contacts that approach faster than `rest`; at the level of forces they count as at rest

  // That of an island.
  ContactProblem<Scalar> Problem(std::size_t island) const {
    return DenseProblemOf(bodies, constraints, islands[island]);
  }
  SparseContactProblem<Scalar> SparseProblem(std::size_t island) const {
    return SparseProblemOf(bodies, constraints, islands[island]);
  }
};

// What assembling and stepping ask of a scene, in the plane or in space (assemble_space.h). Both have the
// functions DynamicsOf, JointConstraints and ContactConstraint.
template <class SceneType>
struct SceneTypes;

template <class Number>
struct SceneTypes<Scene<Number>> {
  using Scalar = Number;
  using Touch = TouchPoint<Number>;
  static constexpr int kDimension = 2, kDof = 3;
  using Model = SceneModel<Number, kDof>;
};

template <class Scalar>
std::vector<BodyDynamics<Scalar, 3>> DynamicsOf(const Scene<Scalar>& scene);

// Rows of a joint, in order: J, bias and error; b is not set.
template <class Scalar>
std::vector<Constraint<Scalar, 3>> JointConstraints(const Scene<Scalar>& scene);

// Normal and tangential row of a contact likewise.
template <class Scalar>
Constraint<Scalar, 3> ContactConstraint(const Scene<Scalar>& scene, const TouchPoint<Scalar>& contact);

template <class SceneType, class Types = SceneTypes<SceneType>>
typename Types::Model Assemble(const SceneType& scene, const std::vector<typename Types::Touch>& contacts,
                               const AssembleOptions<typename Types::Scalar>& options = {});

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

// Line by line what was modelled, what was left out, and why that is exact.
template <class SceneType, class Types = SceneTypes<SceneType>>
std::vector<std::string> Explain(const SceneType& scene, const std::vector<typename Types::Touch>& contacts,
                                 const typename Types::Model& model,
                                 const AssembleOptions<typename Types::Scalar>& options);

}  // namespace stiction

#endif  // STICTION_SCENE_ASSEMBLE_H_
