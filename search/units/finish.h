// SPDX-License-Identifier: Apache-2.0
// Finishing a finding: certified, put through the whole grid of policies, minimized, certified again.

#pragma once

#include <functional>
#include <optional>

#include "corpus/store/store.h"
#include "search/units/exact_methods.h"

namespace stiction {

// The finding with everything filled in, or empty if it was cancelled. A loop of at most four contacts that the
// whole planar grid shows is minimized so that the whole grid still shows it, any other so that its own policy
// does; the signature is kept either way. Certificates pass CheckCertificate before they are returned
// (InternalError otherwise). Ipopt is asked for a solution of the problem as found. A finding that exact
// arithmetic solves gets the certificate of its solution and no minimized form; neither does a disagreement of
// methods. Problem and minimized form each get the certificate that a solution exists. A cycle whose minimized
// form is safe becomes a safe-cycle, and one on which methods disagree a disagreement of methods; its signature
// stays.
std::optional<Finding> FinishFinding(const Finding& finding, const Limits& limits,
                                     const std::function<bool()>& cancelled, const ExactMethods& methods = {});

// "cycle": 1320, "solved": 216: outcomes over the whole planar grid.
// Fewer than all once `cancelled`.
Json GridCounts(
    const ExactProblem& problem, const Limits& limits,
    const std::function<bool()>& cancelled = [] { return false; });

}  // namespace stiction
