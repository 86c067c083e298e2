// SPDX-License-Identifier: Apache-2.0
// Units of a campaign with an objective that test a solver: an optimizer's candidates in the place of random
// problems (adversary/optimized_unit.h), and what the solver does wrong on the way as findings.

#ifndef STICTION_SEARCH_UNDER_TEST_OPTIMIZED_SOLVER_UNIT_H_
#define STICTION_SEARCH_UNDER_TEST_OPTIMIZED_SOLVER_UNIT_H_

#include <functional>
#include <vector>

#include "search/adversary/candidate.h"
#include "search/under_test/solver_process.h"
#include "search/under_test/solver_unit.h"
#include "search/units/unit.h"

namespace stiction {

// Findings are counted by signature; nothing else is, since nothing is drawn at random. Of the objective `time`
// the unit depends on the machine. May end early when cancelled.
UnitResult RunOptimizedSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                  const std::vector<Candidate>& parents, const std::function<bool()>& cancelled,
                                  const TellFinding& tell);

}  // namespace stiction

#endif  // STICTION_SEARCH_UNDER_TEST_OPTIMIZED_SOLVER_UNIT_H_
