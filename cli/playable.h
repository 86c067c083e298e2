// SPDX-License-Identifier: Apache-2.0
// What the viewer plays: a run that is followed, what intervals say of it, and beside it complete driving.

#pragma once

#include <optional>
#include <string>

#include "certify/request/request.h"
#include "corpus/record/problem_file.h"
#include "reports/viewer.h"

namespace stiction {

// `solution`: that of what is wanted; `picture`: of its scene, or null; `source`: in errors. InputError for a
// run of more steps than a page has room for.
Playable PlayableOf(const Wanted& wanted, const ProblemFile& file, const SharedJson& picture,
                    const Solution& solution, const std::optional<InexactAnswer>& over_intervals,
                    const std::string& source, const std::string& command);

// The published algorithm on a finding of a report; nothing where it has no page. `path`: of the problem's
// file.
std::optional<Playable> PlayFinding(const ProblemFile& file, const std::string& policy,
                                    const std::string& path);

}  // namespace stiction
