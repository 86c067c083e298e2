// SPDX-License-Identifier: Apache-2.0
// Problems with structure, for comparisons: what stacks, walls and discs in a channel ask for, scenes of the
// corpus as a simulation meets them, scenes of the search, and rows that nearly depend on each other. Random
// matrices are none of this: there A is definite or has its rank by construction, and no force is large beside
// another.
//
// Stacks and walls stand: mu from 3/10 to 1, gravity up to 1/20 off the vertical. In the plane faces touch in
// two points, in space in four, so A is singular wherever bodies are stacked, and b is in its range.

#ifndef STICTION_BENCH_STRUCTURE_H_
#define STICTION_BENCH_STRUCTURE_H_

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "search/choices.h"
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

// One of them, in the plane, with friction and masses from 1 to 10^decades, at most 10^18.
ContactProblem<double> StackProblem(int boxes, int decades, Choices& choices);
ContactProblem<double> SpaceStackProblem(int boxes, int decades, Choices& choices);  // in space
ContactProblem<double> WallProblem(int courses, int bricks, int decades, Choices& choices);

}  // namespace stiction

#endif  // STICTION_BENCH_STRUCTURE_H_
