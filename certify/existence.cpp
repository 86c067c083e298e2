// SPDX-License-Identifier: Apache-2.0
#include "certify/existence.h"

#include "certify/certificate.h"
#include "certify/exact.h"
#include "certify/filtered.h"
#include "certify/no_solution.h"
#include "certify/solve.h"
#include "certify/verify_solution.h"

namespace stiction {

namespace {

// From here on the path itself costs more, even with certified signs, than the equations of its end.
constexpr int kFewRows = 24;

// A run of a method that takes frictionless and static contacts only, on what bilateral and sliding ones leave;
// forces and accelerations are those of the whole problem, all else is of what remains.
template <class Run>
Run OnRemainder(const ExactProblem& problem, Run (*run)(const ExactProblem&, const Limits&),
                const Limits& limits) {
  const Reduction<Rational> reduction(problem);
  Run result;
  if (reduction.end() != ReductionEnd::kReduced) {
    result.verdict.outcome = Outcome::kSingular;
    result.verdict.reason = Reason(reduction.end());
    return result;
  }
  result = run(reduction.problem(), limits);
  if (result.verdict.outcome == Outcome::kSolved) {
    result.f = reduction.Forces(result.f);
    result.a = Accelerations(problem, result.f);
  }
  if (result.ray.size() > 0) result.ray = reduction.Direction(result.ray);
  return result;
}

}  // namespace

CompleteRun RunComplete(const ExactProblem& problem, const Limits& limits, KeepPath keep) {
  if (Reduction<Rational>::Concerns(problem)) {
    return OnRemainder<CompleteRun>(
        problem, [](const ExactProblem& rest, const Limits& of) { return RunComplete(rest, of); }, limits);
  }
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
  if (Reduction<Rational>::Concerns(problem)) return OnRemainder<LemkeRun>(problem, &RunLemke, limits);
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

namespace {

// Of an answer that is solved.
Existence Solved(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (answer.bound.empty()) return {SolutionCertificate(problem, answer.f), answer.method};
  return {CoulombCertificate(problem, answer.f, *ParseRational(answer.bound)), answer.method};
}

Existence DecideInSpace(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                        FrictionLaw law) {
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.IsAutomatic(3) || method.name == "enumerate") continue;  // whose proof is wanted
    const Answer<Rational> answer = SolveBy(method, problem, {.limits = limits, .law = law});
    if (answer.Solved() && answer.bound != "0") return Solved(problem, answer);
  }
  const Enumeration modes = RefuteInSpace(problem, options);
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  return {nullptr, "none"};
}

}  // namespace

Existence DecideExistence(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                          FrictionLaw law) {
  if (problem.dimension == 3) return DecideInSpace(problem, limits, options, law);
  if (problem.rows() <= kFewRows) {
    const CompleteRun complete = RunCompleteFiltered(problem, limits).run;
    if (complete.verdict.outcome == Outcome::kSolved)
      return {SolutionCertificate(problem, complete.f), "complete"};
  } else {
    const Answer<Rational> answer = Solve(problem, "fast", {.limits = limits});
    if (answer.Solved()) return Solved(problem, answer);
  }
  const Answer<Rational> answer = Solve(problem, "lemke", {.limits = limits});  // complete driving is done
  if (answer.Solved()) return Solved(problem, answer);
  EnumerationOptions first = options;
  first.first_solution_only = true;
  const Enumeration modes = EnumerateModes(problem, first);
  if (!modes.solutions.empty()) return {SolutionCertificate(problem, modes.solutions.front().f), "enumerate"};
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  return {nullptr, "none"};
}

}  // namespace stiction
