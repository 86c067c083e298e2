// SPDX-License-Identifier: Apache-2.0
// The methods over rationals; the published algorithm for one policy, or for the whole grid.
//
// The published algorithm takes any planar problem here. Bilateral and sliding contacts leave it before a run
// (solver/problem/reduction.h), and the run is told in the terms of the whole problem: rows and contacts are
// the problem's, bilateral variables stand in C from the start (4.5), and forces and accelerations are those of
// all rows. Where they cannot leave it, the run ends in `singular` before its first step, and the reason says
// why.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "corpus/exact_problem.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

struct ExactRun {
  Policy policy;
  Verdict verdict;
  ExactProblem::Vector initial_f;  // before the first step: zero but for bilateral contacts
  Trace<Rational> trace;
  // Where it stands when it ends: what recurs in a loop (readings.md, 2 and 3), accelerations, df of a ray.
  std::vector<IndexSet> sets;
  ExactProblem::Vector f, a, ray;
  int last_driven_contact = -1;
  std::vector<IndexSet> last_left;  // in the last drive
  bool last_step_zero = false;
};

// Requires dimension 2.
ExactRun RunExact(const ExactProblem& problem, const Request& request);

// Policies that take the same steps on a problem. The trace is that of the first of them.
struct PolicyClass {
  std::vector<Policy> policies;
  SwitchMask consulted = 0;
  Verdict verdict;
};

// Runs every policy of the list, but policies that agree on all switches that a run consulted only once:
// a switch is consulted where its values would act differently, so these take the same steps.
// Stops, with what it has, once `cancelled`.
std::vector<PolicyClass> RunPolicies(
    const ExactProblem& problem, const std::vector<Policy>& policies, const Limits& limits,
    const std::function<bool()>& cancelled = [] { return false; });

// Whether every policy of the list ends in `outcome`; stops at the first that does not.
bool AllEndIn(Outcome outcome, const ExactProblem& problem, const std::vector<Policy>& policies,
              const Limits& limits);

// "N1", "F1", "N2", ... by row.
std::string VariableName(const RowLayout<Eigen::Dynamic>& layout, int row);
std::vector<std::string> VariableNames(const ExactProblem& problem);

}  // namespace stiction
