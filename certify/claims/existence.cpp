// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/existence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
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

ClaimAnswer DecidedBy(std::string_view method, Json certificate) {
  ClaimAnswer answer = ByCertificate(std::move(certificate));
  answer.method = method;
  return answer;
}

// Of an answer that is solved.
ClaimAnswer DecidedBy(const ExactProblem& problem, const Answer<Rational>& answer) {
  return DecidedBy(answer.method, answer.bound ? CoulombCertificate(problem, answer.f, *answer.bound)
                                               : SolutionCertificate(problem, answer.f));
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
    case EnumerationEnd::kStopped:
      return "enumerate: stopped";
    case EnumerationEnd::kLimit:
      return "enumerate: out of linear programs";
    case EnumerationEnd::kOpen:
      return "enumerate: a contact mode that nothing refutes";
    case EnumerationEnd::kComplete:
      break;
  }
  return "enumerate: nothing";
}

ClaimAnswer Undecided(const std::vector<std::string>& ends) {
  return ByCertificate(nullptr, fmt::format("{}", fmt::join(ends, "; ")));
}

ClaimAnswer DecideInSpace(const ExactProblem& problem, const Request& request, const EnumerationWatch& watch) {
  std::vector<std::string> ends;
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.IsAutomatic(3) || method.name == "enumerate") continue;  // whose proof is wanted
    try {
      const Answer<Rational> answer = SolveBy(method, problem, {.law = request.law, .limits = request.limits});
      if (answer.Solved() && answer.bound != Rational(0)) return DecidedBy(problem, answer);
      ends.push_back(answer.Solved()
                         ? std::string(method.name) + ": forces without a bound on the angle of slip"
                         : HowItEnded(answer));
    } catch (const RangeError& error) {  // Coulomb's law is solved over doubles before it is exactly
      ends.push_back(std::string(method.name) + ": " + error.what());
    }
  }
  const Enumeration modes = RefuteInSpace(problem, request, watch);
  if (modes.ProvesNoSolution()) return DecidedBy("enumerate", NoSolutionCertificate(problem, modes));
  ends.push_back(HowItEnded(modes));
  return Undecided(ends);
}

}  // namespace

ClaimAnswer DecideExistence(const ExactProblem& problem, const Request& request,
                            const EnumerationWatch& watch) {
  if (problem.dimension == 3) return DecideInSpace(problem, request, watch);
  const Limits& limits = request.limits;
  std::vector<std::string> ends;
  if (problem.rows() < kCellsFirst) {
    const ExactAnswer answer = RunCompleteFiltered(problem, limits);
    if (answer.Solved()) return DecidedBy(problem, answer);
    ends.push_back(HowItEnded(answer));
  } else {
    const Answer<Rational> answer = Solve(problem, {.method = "fast", .limits = limits});
    if (answer.Solved()) return DecidedBy(problem, answer);
    ends.push_back(HowItEnded(answer));
  }
  const Answer<Rational> answer =
      Solve(problem, {.method = "lemke", .limits = limits});  // complete driving is done
  if (answer.Solved()) return DecidedBy(problem, answer);
  ends.push_back(HowItEnded(answer));
  const Enumeration modes = EnumerateModes(problem, request, [&watch](const Enumeration& so_far) {
    return UntilSolved(so_far) && (!watch || watch(so_far));
  });
  if (!modes.solutions.empty())
    return DecidedBy("enumerate", SolutionCertificate(problem, modes.solutions.front().f));
  if (modes.ProvesNoSolution()) return DecidedBy("enumerate", NoSolutionCertificate(problem, modes));
  ends.push_back(HowItEnded(modes));
  return Undecided(ends);
}

}  // namespace stiction
