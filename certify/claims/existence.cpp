// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/existence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "certify/claims/certificate.h"
#include "certify/claims/no_solution.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"

namespace stiction {

namespace {

// Of an answer that is solved.
Existence Solved(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (!answer.bound) return {SolutionCertificate(problem, answer.f), answer.method};
  return {CoulombCertificate(problem, answer.f, *answer.bound), answer.method};
}

// "complete: out of drives".
std::string HowItEnded(const Answer<Rational>& answer) {
  const std::string name(answer.method);
  if (answer.outcome == Outcome::kLimit) return name + ": out of " + answer.reason;
  const std::string end = name + ": " + std::string(Name(answer.outcome));
  return answer.reason.empty() ? end : end + ", " + answer.reason;
}

std::string HowItEnded(const Enumeration& modes) {
  switch (modes.end) {
    case EnumerationEnd::kCancelled:
      return "enumerate: stopped";
    case EnumerationEnd::kLimit:
      return "enumerate: out of linear programs";
    case EnumerationEnd::kOpen:
      return "enumerate: a contact mode that nothing refutes";
    case EnumerationEnd::kComplete:
    case EnumerationEnd::kFirstSolution:
      break;
  }
  return "enumerate: nothing";
}

Existence Undecided(const std::vector<std::string>& ends) {
  return {nullptr, "none", fmt::format("{}", fmt::join(ends, "; "))};
}

Existence DecideInSpace(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                        FrictionLaw law) {
  std::vector<std::string> ends;
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.IsAutomatic(3) || method.name == "enumerate") continue;  // whose proof is wanted
    try {
      const Answer<Rational> answer = SolveBy(method, problem, {.law = law, .limits = limits});
      if (answer.Solved() && answer.bound != Rational(0)) return Solved(problem, answer);
      ends.push_back(answer.Solved()
                         ? std::string(method.name) + ": forces without a bound on the angle of slip"
                         : HowItEnded(answer));
    } catch (const RangeError& error) {  // Coulomb's law is solved over doubles before it is exactly
      ends.push_back(std::string(method.name) + ": " + error.what());
    }
  }
  const Enumeration modes = RefuteInSpace(problem, options);
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  ends.push_back(HowItEnded(modes));
  return Undecided(ends);
}

}  // namespace

Existence DecideExistence(const ExactProblem& problem, const Limits& limits, const EnumerationOptions& options,
                          FrictionLaw law) {
  if (problem.dimension == 3) return DecideInSpace(problem, limits, options, law);
  std::vector<std::string> ends;
  if (problem.rows() < kCellsFirst) {
    const ExactAnswer answer = RunCompleteFiltered(problem, limits);
    if (answer.Solved()) return Solved(problem, answer);
    ends.push_back(HowItEnded(answer));
  } else {
    const Answer<Rational> answer = Solve(problem, {.method = "fast", .limits = limits});
    if (answer.Solved()) return Solved(problem, answer);
    ends.push_back(HowItEnded(answer));
  }
  const Answer<Rational> answer =
      Solve(problem, {.method = "lemke", .limits = limits});  // complete driving is done
  if (answer.Solved()) return Solved(problem, answer);
  ends.push_back(HowItEnded(answer));
  EnumerationOptions first = options;
  first.first_solution_only = true;
  const Enumeration modes = EnumerateModes(problem, first);
  if (!modes.solutions.empty()) return {SolutionCertificate(problem, modes.solutions.front().f), "enumerate"};
  if (modes.ProvesNoSolution()) return {NoSolutionCertificate(problem, modes), "enumerate"};
  ends.push_back(HowItEnded(modes));
  return Undecided(ends);
}

}  // namespace stiction
