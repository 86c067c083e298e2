// SPDX-License-Identifier: Apache-2.0
// What a search asks of exact arithmetic. Tests put wrong answers in the place of these, to see that every
// alarm of a search rings.

#ifndef STICTION_SEARCH_EXACT_METHODS_H_
#define STICTION_SEARCH_EXACT_METHODS_H_

#include <functional>
#include <optional>

#include "certify/enumerate.h"
#include "certify/exact.h"
#include "certify/existence.h"
#include "certify/safe.h"

namespace stiction {

struct ExactMethods {
  std::function<ExactRun(const ExactProblem&, const PublishedOptions&)> published = RunExact;
  std::function<CompleteRun(const ExactProblem&, const Limits&)> complete =
      [](const ExactProblem& problem, const Limits& limits) { return RunComplete(problem, limits); };
  std::function<LemkeRun(const ExactProblem&, const Limits&)> lemke = RunLemke;
  std::function<Enumeration(const ExactProblem&)> modes = [](const ExactProblem& problem) {
    return EnumerateModes(problem);
  };
  std::function<std::optional<bool>(const ExactProblem&)> is_safe = IsSafeIfSmall;
};

}  // namespace stiction

#endif  // STICTION_SEARCH_EXACT_METHODS_H_
