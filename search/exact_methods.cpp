// SPDX-License-Identifier: Apache-2.0
#include "search/exact_methods.h"

#include "certify/enumerate.h"
#include "certify/exact.h"
#include "certify/existence.h"
#include "certify/feasibility_nlp.h"
#include "certify/filtered.h"
#include "certify/published_space.h"
#include "certify/safe.h"
#include "certify/space.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

FeasibilityAnswer AskIpopt(const ExactProblem& problem) {
  ProposalStatistics statistics;
  try {
    thread_local IpoptProposer proposer;
    const bool solved = proposer.ProposeSolution(problem, {}, statistics).has_value();
    return {solved ? "solved" : "undecided", statistics.starts, statistics.ipopt_seconds};
  } catch (const InputError&) {  // it is not installed, or not for such a problem
    return {"unavailable", statistics.starts, statistics.ipopt_seconds};
  }
}

}  // namespace

ExactMethods::ExactMethods()
    : published(RunExact),
      filtered(RunPublishedFiltered),
      complete([](const ExactProblem& problem, const Limits& limits) { return RunComplete(problem, limits); }),
      complete_filtered(RunCompleteFiltered),
      lemke(RunLemke),
      modes([](const ExactProblem& problem) { return EnumerateModes(problem); }),
      is_safe(IsSafeIfSmall),
      ipopt(AskIpopt),
      published_in_space(RunIntervalsInSpace),
      complete_in_space([](const ExactProblem& problem, const Limits& limits) {
        return SolveInSpace(problem, {.limits = limits});
      }) {}

}  // namespace stiction
