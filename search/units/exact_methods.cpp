// SPDX-License-Identifier: Apache-2.0
#include "search/units/exact_methods.h"

#include "certify/claims/safe.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/feasibility_nlp.h"
#include "certify/exact/filtered.h"
#include "certify/exact/published_space.h"
#include "certify/exact/solve.h"
#include "certify/exact/space.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

Feasibility AskIpopt(const ExactProblem& problem) {
  try {
    thread_local IpoptProposer proposer;
    const double before = proposer.ipopt_seconds();
    const Answer<Rational> answer = proposer.ProposeSolution(problem);
    return {std::string(Name(answer.outcome)), answer.counters[Counter::kStarts],
            proposer.ipopt_seconds() - before};
  } catch (const InputError&) {  // it is not installed, or not for such a problem
    return {"unavailable", 0, 0};
  }
}

// A row of the table of methods.
ExactMethod ByName(const char* method) {
  return [method](const ExactProblem& problem, const Limits& limits) {
    return Solve(problem, {.method = method, .limits = limits});
  };
}

}  // namespace

ExactMethods::ExactMethods()
    : published(RunExact),
      filtered(RunPublishedFiltered),
      complete(ByName("complete")),
      complete_filtered(RunCompleteFiltered),
      lemke(ByName("lemke")),
      modes([](const ExactProblem& problem) { return EnumerateModes(problem); }),
      is_safe(IsSafeIfSmall),
      ipopt(AskIpopt),
      published_in_space(RunIntervalsInSpace),
      complete_in_space([](const ExactProblem& problem, const Limits& limits) {
        return SolveInSpace(problem, {.law = FrictionLaw::kBaraff, .limits = limits});
      }) {}

}  // namespace stiction
