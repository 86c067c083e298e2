// SPDX-License-Identifier: Apache-2.0
// Refinement: forces that are nearly a solution, made one that the gate lets pass.
//
// Methods leave noise: friction of 1e-15 at a contact that separates, a limit that is passed by a rounding,
// rows of a stack whose forces are off by 1e-12. Two steps take it away, each only where the gate (gate.h) asks
// for it:
//
//   clean    by the mode of every contact: separates, f = 0; friction onto its limit, by changing fF or, where
//   mu > 1,
//            fN, whichever changes less
//   refine   Newton's method on the modes found, a = A f + b with twice the digits (R. Skeel, 1980; N. J.
//   Higham,
//            Accuracy and Stability of Numerical Algorithms, 2002, 12.2), then clean. In the plane one step
//            solves the equations of the modes. Where they are singular, as of forces that are not unique, M +
//            shift I is factored and the steps repeated; last, where contacts touch without force, by the least
//            change by least squares that keeps them there too (orthogonal factorization).
//
// Forces that pass, and press against each other by far more than b asks for, as a method may leave them where
// mu is large, are replaced by about the least ones of the same modes where these pass too: a jam lends its
// roundings.
//
// Forces are taken only if the gate lets them pass, or at least finds smaller errors. Shapes: f rows x 1. Cost:
// of cleaning one product A f; of refining a factorization of the rows that touch.

#pragma once

#include <vector>

#include "solver/problem/errors.h"
#include "solver/problem/problem.h"
#include "solver/problem/solution.h"

namespace stiction {

struct Refined {
  Eigen::VectorXd f;
  Errors<double> errors;  // as the gate bounds them
};

// The forces with the least errors among f, f cleaned and f refined; f itself where it passes.
Refined Refine(const ContactProblem<double>& problem, FrictionLaw law, const Gate& gate, Eigen::VectorXd f);

// Forces by the modes of their contacts, exactly lawful but for what accelerations miss. a = A f + b.
void Clean(const ContactProblem<double>& problem, const std::vector<NearestMode<double>>& modes,
           const Eigen::VectorXd& a, Eigen::VectorXd& f);

}  // namespace stiction
