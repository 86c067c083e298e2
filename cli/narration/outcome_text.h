// SPDX-License-Identifier: Apache-2.0
// Numbers and outcomes, for programs and for people.

#pragma once

#include <string>
#include <string_view>

#include "corpus/json_text.h"
#include "corpus/rational.h"
#include "solver/problem/solution.h"

namespace stiction {

// Numbers over rationals, for people: as they are, or rounded where they are long.
enum class FractionText { kFull, kShort };
// "-2/3". Short: what takes more than twenty characters is the decimal of the double that it is, or, where it
// is none, six digits behind a ~.
std::string Text(const Rational& x, FractionText fractions = FractionText::kFull);
std::string Text(double x, FractionText = FractionText::kFull);  // six digits
std::string ShortText(double x);                                 // "3e-16"

// Of the start and the period of a loop.
inline constexpr std::string_view UnitOf(Outcome loop) { return loop == Outcome::kStall ? "step" : "drive"; }

// "cycle: the state after 3 drives recurs 4 drives later, for ever"
std::string DescribeEnd(Outcome outcome, std::string_view reason, std::int64_t start, std::int64_t period);
template <class End>
std::string Describe(const End& end) {
  return DescribeEnd(end.outcome, end.reason, end.start, end.period);
}

}  // namespace stiction
