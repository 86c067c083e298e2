// SPDX-License-Identifier: Apache-2.0
// Quad: Boost's binary floating point of 113 bits, IEEE's binary128, the same on every compiler; all methods
// that floating-point scalars have run over it.

#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "corpus/rounded.h"
#include "solver/solve.h"

namespace stiction {

using Quad = boost::multiprecision::cpp_bin_float_quad;

template <>
inline constexpr bool kIsRounded<Quad> = true;
template <>
inline constexpr Arithmetic kArithmeticOf<Quad> = Arithmetic::kQuad;

// As for the other wide numbers: what is solved are doubles.
template <>
inline ContactProblem<Quad> Rounded(const ExactProblem& problem) {
  return Converted<Quad>(Rounded<double>(problem), [](double x) { return Quad(x); });
}

template <>
std::span<const Method<Quad>> Methods<Quad>();

extern template Answer<Quad> Solve(const ContactProblem<Quad>&, const Request&);
extern template const Method<Quad>* FindMethod(std::string_view);
extern template void JudgeAnswer(const ContactProblem<Quad>&, double, Answer<Quad>&);

}  // namespace stiction
