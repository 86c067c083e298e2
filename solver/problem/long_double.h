// SPDX-License-Identifier: Apache-2.0
// LongDouble: what measures answers over doubles. Where long double is not that of x86, as in WebAssembly,
// cli/live has the same numbers by integers.

#ifndef STICTION_SOLVER_PROBLEM_LONG_DOUBLE_H_
#define STICTION_SOLVER_PROBLEM_LONG_DOUBLE_H_

#ifdef STICTION_PORTABLE_NUMBERS
#include "solver/problem/answer.h"
#include "solver/problem/extended.h"
#endif

namespace stiction {

#ifdef STICTION_PORTABLE_NUMBERS
using LongDouble = Extended;
template <>
inline constexpr Arithmetic kArithmeticOf<Extended> = Arithmetic::kLongDouble;
#else
using LongDouble = long double;
#endif

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_LONG_DOUBLE_H_
