// SPDX-License-Identifier: Apache-2.0
// bilateral: some contacts are bilateral constraints.

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {

Generator MakeBilateral() {
  static constexpr GeneratorRow kRow = {
      .name = "bilateral",
      .distribution =
          "As integers, but one contact for certain, and each other with probability 1/2, is a "
          "bilateral constraint (4.5), of one row. Not part of a campaign that names no "
          "generators.",
      .exact_in_double = true,
      .other_kind = ContactKind::kBilateral,
  };
  return GeneratorOf<kRow>([](const Given&, Choices& choices, auto& problem) {
    return WithOtherKinds(kRow.other_kind, choices, problem);
  });
}

}  // namespace stiction::generators
