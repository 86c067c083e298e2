// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/existence.h"

#include "certify/claims/certificate.h"
#include "certify/claims/no_solution.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"

namespace stiction {

namespace {

// Of an answer that is solved.
Existence Solved(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (!answer.bound) return {SolutionCertificate(problem, answer.f), answer.method};
  return {CoulombCertificate(problem, answer.f, *answer.bound), answer.method};
}

Existence DecideInSpace(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                        FrictionLaw law) {
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.IsAutomatic(3) || method.name == "enumerate") continue;  // whose proof is wanted
    const Answer<Rational> answer = SolveBy(method, problem, {.limits = limits, .law = law});
    if (answer.Solved() && answer.bound != Rational(0)) return Solved(problem, answer);
  }
  const Enumeration modes = RefuteInSpace(problem, options);
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  return {nullptr, "none"};
}

}  // namespace

Existence DecideExistence(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                          FrictionLaw law) {
  if (problem.dimension == 3) return DecideInSpace(problem, limits, options, law);
  if (problem.rows() < kCellsFirst) {
    const ExactAnswer answer = RunCompleteFiltered(problem, limits);
    if (answer.Solved()) return Solved(problem, answer);
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
