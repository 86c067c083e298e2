// SPDX-License-Identifier: Apache-2.0
// The problem of a design (scenes.h).

#ifndef STICTION_SEARCH_GENERATORS_SCENE_PROBLEM_H_
#define STICTION_SEARCH_GENERATORS_SCENE_PROBLEM_H_

#include <array>

#include "search/generators/body_problem.h"
#include "search/generators/scenes.ipp"

namespace stiction::generators {

template <class Scalar, int Rows>
int FillScene(const SceneGrain& grain, bool gravity_only, Choices& choices,
              ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const SceneDesign design = DrawSceneDesign(rows / 2, grain, gravity_only, choices);
  std::array<SceneBody<Scalar>, kMaxBodies> body;
  for (int c = 0; c < design.cells; ++c) body[c] = MakeSceneBody<Scalar>(design, c);
  BodyJacobian<Scalar, Rows> J = NoContacts<Scalar, Rows>(rows, design.cells);
  int contact = 0;
  for (int i = 0; i < design.interfaces; ++i) {
    const SceneInterface& interface = design.interface[i];
    const Vector2<Scalar> normal = NormalOf<Scalar>(design.lines[interface.line]);
    for (int k = 0; k < interface.contacts; ++k, ++contact) {
      if (k > 0) problem.contacts[contact].mu = problem.contacts[contact - 1].mu;
      const Vector2<Scalar> point = PointAt<Scalar>(design, interface, interface.at[k]);
      const auto set = [&](int c, int sign) {
        SetSceneRows<Scalar>(normal, point - body[c].center, contact, c, sign, J);
      };
      set(interface.upper, 1);
      if (interface.lower != kTheWorld) set(interface.lower, -1);
    }
  }
  SetFromBodies(J, design.cells, body, problem);
  return 3 * design.cells;
}

}  // namespace stiction::generators

#endif  // STICTION_SEARCH_GENERATORS_SCENE_PROBLEM_H_
