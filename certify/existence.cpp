// SPDX-License-Identifier: Apache-2.0
#include "certify/existence.h"

#include "certify/certificate.h"
#include "certify/exact.h"
#include "certify/no_solution.h"
#include "certify/solve.h"

namespace stiction {

CompleteRun RunComplete(const ExactProblem& problem, const Limits& limits, KeepPath keep) {
  CompleteOptions options;
  options.limits = limits;
  CompleteDriving<Rational> driving(options);
  CompleteRun run;
  Trace<Rational> trace;
  run.verdict = driving.Run(problem, keep == KeepPath::kYes ? &trace : nullptr);
  run.path = std::move(trace.pivots);
  run.f = driving.f();
  run.a = driving.a();
  if (run.verdict.outcome == Outcome::kRay) run.ray = driving.ray();
  run.word = driving.Word();
  return run;
}

LemkeRun RunLemke(const ExactProblem& problem, const Limits& limits) {
  LemkeOptions options;
  options.limits = limits;
  LemkeAlgorithm<Rational> lemke(options);
  LemkeRun run;
  run.verdict = lemke.Run(problem);
  if (run.verdict.outcome == Outcome::kSolved) {
    run.f = lemke.f();
    run.a = lemke.a();
  } else if (run.verdict.outcome == Outcome::kRay) {
    run.ray = lemke.ray();
  }
  return run;
}

Existence DecideExistence(const ExactProblem& problem, const Limits& limits,
                          const EnumerationOptions& options) {
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.automatic || !method.has_path || !method.IsBuilt(problem.dimension)) continue;
    const Answer<Rational> answer = SolveBy(method, problem, {.limits = limits});
    if (answer.Solved()) return {SolutionCertificate(problem, answer.f), answer.method};
  }
  if (problem.dimension == 3) return {nullptr, "none"};
  EnumerationOptions first = options;
  first.first_solution_only = true;
  const Enumeration modes = EnumerateModes(problem, first);
  if (!modes.solutions.empty()) return {SolutionCertificate(problem, modes.solutions.front().f), "enumerate"};
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  return {nullptr, "none"};
}

}  // namespace stiction
