// SPDX-License-Identifier: Apache-2.0
// Assembling in the plane, over doubles for simulation, and over rationals.

#include "scene/assemble.ipp"

#include "scene/explain.ipp"

namespace stiction {

#define STICTION_INSTANTIATE(Scalar)                                                                          \
  template std::vector<BodyDynamics<Scalar, 3>> DynamicsOf(const Scene<Scalar>&);                             \
  template std::vector<Constraint<Scalar, 3>> JointConstraints(const Scene<Scalar>&);                         \
  template Constraint<Scalar, 3> ContactConstraint(const Scene<Scalar>&, const TouchPoint<Scalar>&);          \
  template SceneModel<Scalar> Assemble(const Scene<Scalar>&, const std::vector<TouchPoint<Scalar>>&,          \
                                       const AssembleOptions<Scalar>&);                                       \
  template ContactProblem<Scalar> DenseProblemOf(const std::vector<BodyDynamics<Scalar, 3>>&,                 \
                                                 const std::vector<Constraint<Scalar, 3>>&, const Island&);   \
  template SparseContactProblem<Scalar> SparseProblemOf(                                                      \
      const std::vector<BodyDynamics<Scalar, 3>>&, const std::vector<Constraint<Scalar, 3>>&, const Island&); \
  template std::vector<Eigen::Matrix<Scalar, 3, 1>> BodyAccelerations(                                        \
      const SceneModel<Scalar, 3>&, const std::vector<typename ContactProblem<Scalar>::Vector>&);             \
  template typename ContactProblem<Scalar>::Vector ExtendForces(                                              \
      const SceneModel<Scalar, 3>&, const std::vector<typename ContactProblem<Scalar>::Vector>&,              \
      const SceneModel<Scalar, 3>&);                                                                          \
  template std::vector<std::string> Explain(const Scene<Scalar>&, const std::vector<TouchPoint<Scalar>>&,     \
                                            const SceneModel<Scalar>&, const AssembleOptions<Scalar>&)

STICTION_INSTANTIATE(double);
STICTION_INSTANTIATE(mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
