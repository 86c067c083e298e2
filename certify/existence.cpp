// SPDX-License-Identifier: Apache-2.0
#include "certify/existence.h"

#include "certify/certificate.h"
#include "certify/no_solution.h"
#include "certify/space.h"
#include "solver/problem/reduction.ipp"

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
  if (problem.dimension == 3) {
    SpaceOptions space;
    space.limits = limits;
    const SpaceSolution solution = SolveInSpace(problem, space);
    if (solution.outcome != Outcome::kSolved) return {nullptr, "none"};
    return {SolutionCertificate(problem, solution.f), "complete"};
  }
  const Reduction<Rational> reduction(problem);  // 4.5, 6
  if (reduction.end() == ReductionEnd::kReduced) {
    const CompleteRun complete = RunComplete(reduction.problem(), limits);
    if (complete.verdict.outcome == Outcome::kSolved)
      return {SolutionCertificate(problem, reduction.Forces(complete.f)), "complete"};
    const LemkeRun lemke = RunLemke(reduction.problem(), limits);
    if (lemke.verdict.outcome == Outcome::kSolved)
      return {SolutionCertificate(problem, reduction.Forces(lemke.f)), "lemke"};
  }
  EnumerationOptions first = options;
  first.first_solution_only = true;
  const Enumeration modes = EnumerateModes(problem, first);
  if (!modes.solutions.empty()) return {SolutionCertificate(problem, modes.solutions.front().f), "enumerate"};
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  return {nullptr, "none"};
}

}  // namespace stiction
