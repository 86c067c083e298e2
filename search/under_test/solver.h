// SPDX-License-Identifier: Apache-2.0
// A solver under test, as it says what it is; README.md.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace stiction {

// What its forces are to satisfy; each is judged by its own conditions (judge_forces.h).
enum class SolverLaw : std::uint8_t { kFrictionless, kBox, kFindex, kPyramid, kCoulomb };
inline constexpr std::array<std::string_view, 5> kSolverLawNames = {"frictionless", "box", "findex", "pyramid",
                                                                    "coulomb"};

struct SolverUnderTest {
  std::string name;  // empty: none
  std::string version;
  SolverLaw law = SolverLaw::kCoulomb;
  std::string accuracy;  // of what it calls solved, relative (solver/problem/errors.h): a number as text

  bool operator==(const SolverUnderTest&) const = default;
};

}  // namespace stiction
