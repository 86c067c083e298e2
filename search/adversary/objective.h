// SPDX-License-Identifier: Apache-2.0
// Objectives: what an optimized search makes large, functions of one problem. Higher is worse for the solver.
//
// A new one is a row of the table in objective.cpp. Optimizers exploit tolerances, so a value over doubles is
// only ever a reason to look again: it is the one over rationals that counts (optimizer.h).

#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "corpus/rational.h"

namespace stiction {

template <class Scalar>
class Trial;  // trial.h
using InexactTrial = Trial<double>;
using ExactTrial = Trial<Rational>;

struct Objective {
  std::string_view name;  // on the command line
  std::string_view help;
  std::string_view unit;  // of what is shown
  // Shown is this times the value: -1 where less is worse for the solver.
  int sign = 1;
  bool of_loops = false;         // loops alone have a value; what is near to one leads there
  bool of_definite = false;      // nothing else leads there
  bool lowers_friction = false;  // optimizers change mu too
  // Empty where the problem has no value. Null: there is no shortcut over doubles.
  std::optional<double> (*inexact)(InexactTrial&) = nullptr;
  std::optional<double> (*exact)(ExactTrial&) = nullptr;
  bool of_solver = false;  // of a solver under test: neither of these
  // Taken unless another one is asked for: what reports/measured/adversary.md has as the best.
  std::string_view optimizer = "evolution";
};

// The table itself.
std::span<const Objective> Objectives();
// Null if none has this name.
const Objective* FindObjective(std::string_view name);

}  // namespace stiction
