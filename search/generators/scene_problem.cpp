// SPDX-License-Identifier: Apache-2.0
// scenes: bodies that touch and do not overlap (scenes.h); fine-scenes: the same of finer numbers.

#include <array>

#include "search/generators/body_problem.h"
#include "search/generators/generator.h"
#include "search/generators/scenes.ipp"

namespace stiction::generators {
namespace {

// The problem of a design.
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

}  // namespace

Generator MakeScenes() {
  static constexpr GeneratorRow kRow = {
      .name = "scenes",
      .distribution =
          "1 to 3 planar bodies at rest that touch and do not overlap: convex polygons of "
          "uniform density, with rational coordinates and Pythagorean normals, on a floor, "
          "between walls (all up to 37 degrees off), on, beside and wedged between each other, "
          "under gravity and, with probability 1/2, applied forces and moments; every body has a "
          "contact, and one at least is on the floor. A = J M^-1 J', b = J M^-1 F. Two bodies "
          "have one friction coefficient. Problem files carry the scene.",
      .exact_in_double = false,
      .has_gravity = true,
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillScene(kCoarseScenes, given.gravity_only, choices, problem);
  });
}

Generator MakeFineScenes() {
  static constexpr GeneratorRow kRow = {
      .name = "fine-scenes",
      .distribution =
          "As scenes, with numbers of three to four digits for slopes, places, shapes and masses "
          "where those have one or two: for optimizers. Not part of a campaign that names no "
          "generators.",
      .exact_in_double = false,
      .has_gravity = true,
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillScene(kFineScenes, given.gravity_only, choices, problem);
  });
}

}  // namespace stiction::generators
