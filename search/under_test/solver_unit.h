// SPDX-License-Identifier: Apache-2.0
// A unit of a campaign that tests a solver, and what becomes of its findings.
//
// The solver's process is new at the beginning of a unit, and after a crash or a hang: what it keeps between
// problems comes from the unit alone, so that units are the same whoever runs them. Problems are drawn over
// doubles, and what a finding has is what the solver was given.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "search/adversary/candidate.h"
#include "search/campaign.h"
#include "search/under_test/examine.h"
#include "search/under_test/solver_process.h"
#include "search/units/unit.h"

namespace stiction {

// Gets what a unit finds when it finds it: the unit may not come to its end.
using TellFinding = std::function<void(const Finding&)>;

// Half a unit is none: empty if it was cancelled.
std::optional<UnitResult> RunSolverUnit(
    const Campaign& campaign, std::int64_t unit, SolverProcess& process, const std::function<bool()>& cancelled,
    const TellFinding& tell = [](const Finding&) {});

// The same with an objective: an optimizer's candidates in the place of random problems
// (adversary/optimized_unit.h), and what the solver does wrong on the way as findings. These are counted by
// signature; nothing else is, since nothing is drawn at random. Of the objective `time` the unit depends on the
// machine. May end early when cancelled.
UnitResult RunOptimizedSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                  const std::vector<Candidate>& parents, const std::function<bool()>& cancelled,
                                  const TellFinding& tell);

// The finding seen again with the problem alone in a new process, and made small while it fails alike: the same
// kind of failure, in the same way. Beside it the certificate that there is a solution, where one is known. A
// failure that the problem alone does not show stays as it was found. Empty if it was cancelled.
std::optional<Finding> FinishSolverFinding(const Finding& finding, const Campaign& campaign,
                                           SolverProcess& process, const std::function<bool()>& cancelled);

}  // namespace stiction
