// SPDX-License-Identifier: Apache-2.0
// sliding: some contacts slide.

#include "search/generators/generator.h"
#include "search/generators/integer_problem.h"

namespace stiction::generators {

Generator MakeSliding() {
  static constexpr GeneratorRow kRow = {
      .name = "sliding",
      .distribution =
          "As integers, but one contact for certain, and each other with probability 1/2, slides "
          "(section 6), to either side: there may be no solution. Not part of a campaign that "
          "names no generators.",
      .exact_in_double = true,
      .other_kind = ContactKind::kSliding,
  };
  return GeneratorOf<kRow>([](const Given&, Choices& choices, auto& problem) {
    return WithOtherKinds(kRow.other_kind, choices, problem);
  });
}

}  // namespace stiction::generators
