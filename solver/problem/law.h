// SPDX-License-Identifier: Apache-2.0
// The laws of friction in space.

#ifndef STICTION_SOLVER_PROBLEM_LAW_H_
#define STICTION_SOLVER_PROBLEM_LAW_H_

#include <cstdint>
#include <string_view>

namespace stiction {

// Friction in space. kBaraff: (21), (22), which leave the direction of slip free. kCoulomb: friction opposite
// to the acceleration, which implies them. In the plane they are the same.
enum class FrictionLaw : std::uint8_t { kBaraff, kCoulomb };
inline constexpr std::string_view Name(FrictionLaw law) {
  return law == FrictionLaw::kBaraff ? "baraff" : "coulomb";
}

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_LAW_H_
