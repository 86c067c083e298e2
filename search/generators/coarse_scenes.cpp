// SPDX-License-Identifier: Apache-2.0
// scenes: bodies that touch and do not overlap (scenes.h).

#include "search/generators/generator.h"
#include "search/generators/scene_problem.h"

namespace stiction::generators {

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

}  // namespace stiction::generators
