// SPDX-License-Identifier: Apache-2.0
// What generators drew, and what became of it, when it was recorded: hashes, by generator.

#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string_view>
#include <vector>

namespace stiction {

struct Recorded {
  std::string_view generator;
  std::uint64_t bits;    // of its problems over doubles (generators_test.cpp)
  std::uint64_t runs;    // steps and ends of runs on them (algorithm_version_test.cpp)
  std::uint64_t counts;  // and what is made of these besides
};

inline std::vector<Recorded>& AllRecorded() {
  static std::vector<Recorded> all;
  return all;
}

// Adds what a file of tests has recorded: const bool kRecorded = AddRecorded({{...}}).
inline bool AddRecorded(const std::vector<Recorded>& recorded) {
  AllRecorded().insert(AllRecorded().end(), recorded.begin(), recorded.end());
  return true;
}

inline Recorded RecordedOf(std::string_view generator) {
  for (const Recorded& recorded : AllRecorded()) {
    if (recorded.generator == generator) return recorded;
  }
  FAIL("nothing is recorded of " << generator);
  return {};
}

}  // namespace stiction
