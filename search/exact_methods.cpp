// SPDX-License-Identifier: Apache-2.0
#include "search/exact_methods.h"

#include "certify/enumerate.h"
#include "certify/exact.h"
#include "certify/existence.h"
#include "certify/safe.h"

namespace stiction {

ExactMethods::ExactMethods()
    : published(RunExact),
      complete([](const ExactProblem& problem, const Limits& limits) { return RunComplete(problem, limits); }),
      lemke(RunLemke),
      modes([](const ExactProblem& problem) { return EnumerateModes(problem); }),
      is_safe(IsSafeIfSmall) {}

}  // namespace stiction
