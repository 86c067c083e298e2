// SPDX-License-Identifier: Apache-2.0
// Assembling over doubles for simulation, and over rationals.

#include "scene/assemble.ipp"

#include "scene/explain.ipp"

namespace stiction {

#define STICTION_INSTANTIATE(Kind, Scalar)                                                                 \
  template std::vector<BodyDynamics<Scalar, Kind::kDof>> DynamicsOf(const SceneIn<Kind, Scalar>&);         \
  template std::vector<ConstraintIn<Kind, Scalar>> JointConstraints(const SceneIn<Kind, Scalar>&);         \
  template ConstraintIn<Kind, Scalar> ContactConstraint(const SceneIn<Kind, Scalar>&,                      \
                                                        const TouchPointIn<Kind, Scalar>&);                \
  template ModelIn<Kind, Scalar> Assemble(                                                                 \
      const SceneIn<Kind, Scalar>&, const std::vector<TouchPointIn<Kind, Scalar>>&, Level, bool,           \
      const std::type_identity_t<Scalar>&, const std::type_identity_t<Scalar>&);                           \
  template ContactProblem<Scalar> DenseProblemOf(const std::vector<BodyDynamics<Scalar, Kind::kDof>>&,     \
                                                 const std::vector<ConstraintIn<Kind, Scalar>>&,           \
                                                 const Island&);                                           \
  template FactoredProblem<Scalar> FactoredProblemOf(const std::vector<BodyDynamics<Scalar, Kind::kDof>>&, \
                                                     const std::vector<ConstraintIn<Kind, Scalar>>&,       \
                                                     const Island&);                                       \
  template void AddResponse(const std::vector<BodyDynamics<Scalar, Kind::kDof>>&,                          \
                            const std::vector<ConstraintIn<Kind, Scalar>>&, const Island&,                 \
                            const typename ContactProblem<Scalar>::Vector&,                                \
                            std::vector<Eigen::Matrix<Scalar, Kind::kDof, 1>>&);                           \
  template std::vector<Eigen::Matrix<Scalar, Kind::kDof, 1>> BodyAccelerations(                            \
      const ModelIn<Kind, Scalar>&, const std::vector<typename ContactProblem<Scalar>::Vector>&);          \
  template typename ContactProblem<Scalar>::Vector ExtendForces(                                           \
      const ModelIn<Kind, Scalar>&, const std::vector<typename ContactProblem<Scalar>::Vector>&,           \
      const ModelIn<Kind, Scalar>&);                                                                       \
  template std::vector<std::string> Explain(const SceneIn<Kind, Scalar>&,                                  \
                                            const std::vector<TouchPointIn<Kind, Scalar>>&,                \
                                            const ModelIn<Kind, Scalar>&, Level)

STICTION_INSTANTIATE(Plane, double);
STICTION_INSTANTIATE(Plane, mpq_class);
STICTION_INSTANTIATE(Space, double);
STICTION_INSTANTIATE(Space, mpq_class);

#undef STICTION_INSTANTIATE

}  // namespace stiction
