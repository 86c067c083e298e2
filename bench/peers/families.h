// SPDX-License-Identifier: Apache-2.0
// Problems with structure: buildings (bench/structure.h), scenes of the corpus as a simulation meets them,
// scenes of the search, and rows that nearly depend on each other.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "solver/problem/problem.h"

namespace stiction {

// All problems of a family have as many rows, and contacts of one kind: static or frictionless.
struct StructuredFamily {
  std::string name;   // "wall-6x5"
  std::string title;  // in a sentence
  int dimension = 2;
  bool friction = true;
  int problems = 0;  // at most
  std::function<std::vector<ContactProblem<double>>(int problems, std::uint64_t seed)> make;
};

// `scenes`: folder of the corpus's scenes. InputError, when a family of them is made, if one cannot be read.
std::vector<StructuredFamily> StructuredFamilies(const std::filesystem::path& scenes);

}  // namespace stiction
