// SPDX-License-Identifier: Apache-2.0
// Buildings: what stacks, walls and discs in a channel ask for.
//
// Stacks and walls stand: mu from 3/10 to 1, gravity up to 1/20 off the vertical. In the plane faces touch in
// two points, in space in four, so A is singular wherever bodies are stacked, and b is in its range. Random
// matrices are not so: there A has its rank by construction, and no force is large beside another.

#pragma once

#include "search/generators/choices.h"
#include "solver/problem/forms.h"
#include "solver/problem/problem.h"

namespace stiction {

struct Building {
  int dimension = 2;
  bool friction = true;
  int decades = 0;  // masses are 1, 10, ..., 10^decades kg; at most 18
};

ContactProblem<double> StackProblem(int boxes, const Building& building, Choices& choices);
ContactProblem<double> WallProblem(int courses, int bricks, const Building& building, Choices& choices);
// The same, of which A is not formed.
FactoredProblem<double> WallInFactors(int courses, int bricks, const Building& building, Choices& choices);
// Of the plane.
ContactProblem<double> ChannelProblem(int discs, const Building& building, Choices& choices);

}  // namespace stiction
