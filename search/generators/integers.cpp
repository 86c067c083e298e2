// SPDX-License-Identifier: Apache-2.0
// integers: everything is a small integer; bilateral, sliding, space: the same with other contacts.

#include <cstdint>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// One contact at least, and each other with probability 1/2, is of another kind. Dynamic sizes.
template <class Scalar>
int WithOtherKinds(ContactKind kind, Choices& choices, ContactProblem<Scalar>& problem) {
  const auto contacts = static_cast<std::int64_t>(problem.contacts.size());
  const std::int64_t certain = choices.Integer(0, contacts - 1);
  for (std::int64_t i = 0; i < contacts; ++i) {
    if (i != certain && choices.Integer(0, 1) == 0) continue;
    Contact<Scalar>& contact = problem.contacts[static_cast<std::size_t>(i)];
    contact.kind = kind;
    if (kind == ContactKind::kBilateral) contact.mu = Scalar(0);
    if (kind == ContactKind::kSliding) contact.slip[0] = Scalar(choices.Integer(0, 1) == 0 ? 1 : -1);
  }
  const int rows = RowCount(problem.contacts, 2);
  problem.A.resize(rows, rows);
  problem.b.resize(rows);
  return FillIntegers(choices, problem);
}

}  // namespace

Generator MakeIntegers() {
  static constexpr GeneratorRow kRow = {
      .name = "integers",
      .distribution =
          "J of integers in [-5, 5], its number of columns uniform in 1..2n; A = J J', and b = J "
          "y or b = A x with integers in [-5, 5].",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillIntegers(choices, problem); });
}

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

Generator MakeSpace() {
  static constexpr GeneratorRow kRow = {
      .name = "space",
      .distribution =
          "Contacts of space, with two rows of friction: J of integers in [-5, 5], its number of "
          "columns uniform in 1..3n; A = J J', and b = J y or b = A x with integers in [-5, 5]. "
          "Run over doubles, what they suspect over intervals, and existence by complete driving "
          "on polygons, over rationals. Not part of a campaign that names no generators.",
      .exact_in_double = true,
      .dimension = 3,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillIntegers(choices, problem); });
}

}  // namespace stiction::generators
