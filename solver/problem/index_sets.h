// SPDX-License-Identifier: Apache-2.0
// Index sets: in which of the paper's sets each variable is (sections 4.1 and 5.3; readings.md, 1).

#pragma once

#include <array>
#include <cstdint>

namespace stiction {

enum class IndexSet : std::uint8_t {
  kNone,        // in no set: ignored, the force rests
  kClamped,     // C    normal, a = 0
  kSeparating,  // NC   normal, f = 0
  kSticking,    // CF   friction, a = 0
  kAtLower,     // NC-  friction, f = -mu fN
  kAtUpper,     // NC+  friction, f = +mu fN
  kSuspended,   // friction at rest while fN = 0, filed again when the normal is clamped
};
inline constexpr int kIndexSetCount = 7;

// The paper's names, as they stand in JSON: none, C, NC, CF, NC-, NC+, suspended.
inline constexpr std::array<const char*, kIndexSetCount> kIndexSetNames = {"none", "C",   "NC",       "CF",
                                                                           "NC-",  "NC+", "suspended"};

inline const char* Name(IndexSet set) { return kIndexSetNames[static_cast<int>(set)]; }

// +1 in NC+, -1 in NC-, 0 elsewhere: f = LimitSign mu fN is kept.
inline constexpr int LimitSign(IndexSet set) {
  return set == IndexSet::kAtUpper ? 1 : set == IndexSet::kAtLower ? -1 : 0;
}

// Whether the variable's acceleration is kept at zero by its force: C or CF.
inline constexpr bool IsUnknown(IndexSet set) {
  return set == IndexSet::kClamped || set == IndexSet::kSticking;
}

// Whether a friction variable is in one of CF, NC-, NC+.
inline constexpr bool IsFrictionSet(IndexSet set) { return set == IndexSet::kSticking || LimitSign(set) != 0; }

}  // namespace stiction
