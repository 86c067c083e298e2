// SPDX-License-Identifier: Apache-2.0
// A generator as its file makes it: a row of the table, and what fills problems over every scalar.
//
//   Generator MakeSmall() {
//     static constexpr GeneratorRow kRow = {.name = "small", ...};
//     // All of a problem but its contacts, which are there; returns what rank(A) is at most, by construction.
//     return GeneratorOf<kRow>([](const Given&, Choices& choices, auto& problem) { ... });
//   }

#pragma once

#include <array>
#include <tuple>

#include "corpus/rational.h"
#include "search/generators/choices.h"
#include "search/generators/generators.h"

namespace stiction::generators {

// What is settled before a problem is filled. Its contacts are static, of these friction coefficients.
struct Given {
  std::array<MuChoice, kMaxContacts> mu;
  bool gravity_only = false;
};

template <class Scalar, int Rows>
using Filling = int (*)(const Given&, Choices&, ContactProblem<Scalar, Rows>&);

struct Generator {
  GeneratorRow row;
  // Fixed sizes are null unless row.IsPlain().
  std::tuple<Filling<double, 2>, Filling<double, 4>, Filling<double, 6>, Filling<double, 8>,
             Filling<double, 10>, Filling<double, 12>, Filling<double, 14>, Filling<double, 16>,
             Filling<double, Eigen::Dynamic>, Filling<Rational, Eigen::Dynamic>>
      fill;
};

// `Fill` is a generic function without a state.
template <const GeneratorRow& kRow, class Fill>
Generator GeneratorOf(Fill) {
  const auto of = []<class Scalar, int Rows>(Filling<Scalar, Rows>) -> Filling<Scalar, Rows> {
    if constexpr (Rows == Eigen::Dynamic || kRow.IsPlain()) {
      return [](const Given& given, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
        return Fill()(given, choices, problem);
      };
    } else {
      return nullptr;
    }
  };
  return {kRow,
          std::apply([of](auto... none) { return std::tuple(of(none)...); }, decltype(Generator::fill)())};
}

#define STICTION_DECLARE_GENERATOR(name) Generator Make##name();
STICTION_GENERATORS(STICTION_DECLARE_GENERATOR)
#undef STICTION_DECLARE_GENERATOR

}  // namespace stiction::generators
