// SPDX-License-Identifier: Apache-2.0
// Where the problems of the suites of rungs come from: a generator at a size, or a dial at a setting.

#ifndef STICTION_BENCH_SOURCES_H_
#define STICTION_BENCH_SOURCES_H_

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "corpus/problem_file.h"

namespace stiction {

struct Source {
  std::string family;
  int setting = 0;           // contacts of a generator
  bool has_solution = true;  // that there is one is known
  bool is_large = false;
  std::function<ExactProblem(std::uint64_t seed, std::int64_t index)> make;
};

// All generators of the plane, at each of the sizes.
std::vector<Source> GeneratorSources(const std::vector<int>& sizes);

// The dials that are named, all if none is, at all their settings. InputError names one that is not known.
std::vector<Source> DialSources(const std::vector<std::string>& families);

}  // namespace stiction

#endif  // STICTION_BENCH_SOURCES_H_
