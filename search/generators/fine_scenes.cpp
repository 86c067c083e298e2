// SPDX-License-Identifier: Apache-2.0
// fine-scenes: scenes of finer numbers.

#include "search/generators/generator.h"
#include "search/generators/scene_problem.h"

namespace stiction::generators {

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
