// SPDX-License-Identifier: Apache-2.0
#include "search/exact_methods.h"

#include "certify/enumerate.h"
#include "certify/exact.h"
#include "certify/existence.h"
#include "certify/filtered.h"
#include "certify/published_space.h"
#include "certify/safe.h"
#include "certify/space.h"

namespace stiction {

ExactMethods::ExactMethods()
    : published(RunExact),
      filtered(RunPublishedFiltered),
      complete([](const ExactProblem& problem, const Limits& limits) { return RunComplete(problem, limits); }),
      complete_filtered(RunCompleteFiltered),
      lemke(RunLemke),
      modes([](const ExactProblem& problem) { return EnumerateModes(problem); }),
      is_safe(IsSafeIfSmall),
      published_in_space(RunIntervalsInSpace),
      complete_in_space([](const ExactProblem& problem, const Limits& limits) {
        return SolveInSpace(problem, {.limits = limits});
      }) {}

}  // namespace stiction
