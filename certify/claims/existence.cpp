// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/existence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "certify/claims/certificate.h"
#include "certify/exact/filtered.h"
#include "certify/exact/solve.h"
#include "corpus/rounded.h"
#include "solver/in_turn.h"

namespace stiction {

namespace {

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

// ---- What an answer makes of the claim -------------------------------------------------------------

ClaimAnswer DecidedBy(std::string_view method, SharedJson certificate, const std::string& otherwise) {
  ClaimAnswer answer = ByCertificate(std::move(certificate), otherwise);
  if (answer.state != ClaimState::kNotDecided) answer.method = method;
  return answer;
}

ClaimAnswer ByForces(const ExactProblem& problem, const Answer<Rational>& answer) {
  if (!answer.Solved()) return DecidedBy(answer.method, {}, HowItEnded(answer));
  if (!answer.bound) return DecidedBy(answer.method, SolutionCertificate(problem, answer.f), "");
  if (*answer.bound != 0)
    return DecidedBy(answer.method, CoulombCertificate(problem, answer.f, *answer.bound), "");
  return DecidedBy(answer.method, {},
                   std::string(answer.method) + ": forces without a bound on the angle of slip");
}

ClaimAnswer ByModes(const ExactProblem& problem, const Enumeration& modes) {
  SharedJson certificate;
  if (!modes.solutions.empty()) certificate = SolutionCertificate(problem, modes.solutions.front().f);
  if (modes.ProvesNoSolution()) certificate = NoSolutionCertificate(problem, modes);
  return DecidedBy("enumerate", std::move(certificate), HowItEnded(modes));
}

// ---- What is tried -----------------------------------------------------------------------------------

Runs<ClaimAnswer> RunsInPlane(const ExactProblem& problem, const Request& request,
                              const EnumerationWatch& watch) {
  const auto by = [&](std::string_view method) {
    return ByForces(problem, Solve(problem, {.method = method, .limits = request.limits}));
  };
  const auto first = [&, by] {
    return problem.rows() < kCellsFirst ? ByForces(problem, RunCompleteFiltered(problem, request.limits))
                                        : by("fast");
  };
  const auto enumerate = [&] {
    return ByModes(problem, EnumerateModes(problem, request, [&watch](const Enumeration& so_far) {
                     return UntilSolved(so_far) && (!watch || watch(so_far));
                   }));
  };
  return {first, [by] { return by("lemke"); }, enumerate};  // complete driving is done
}

Runs<ClaimAnswer> RunsInSpace(const ExactProblem& problem, const Request& request,
                              const EnumerationWatch& watch) {
  Runs<ClaimAnswer> runs;
  for (const Method<Rational>& method : Methods<Rational>()) {
    if (!method.IsAutomatic(3) || method.name == "enumerate") continue;  // whose proof is wanted
    runs.emplace_back([&] {
      try {
        return ByForces(problem, SolveBy(method, problem, {.law = request.law, .limits = request.limits}));
      } catch (const RangeError& error) {  // Coulomb's law is solved over doubles before it is exactly
        return DecidedBy(method.name, {}, std::string(method.name) + ": " + error.what());
      }
    });
  }
  runs.emplace_back([&] { return ByModes(problem, RefuteInSpace(problem, request, watch)); });
  return runs;
}

}  // namespace

ClaimAnswer DecideExistence(const ExactProblem& problem, const Request& request,
                            const EnumerationWatch& watch) {
  std::vector<std::string> ends;
  const auto decides = [&ends](const ClaimAnswer& answer) {
    ends.push_back(answer.reason);
    return answer.state != ClaimState::kNotDecided;
  };
  ClaimAnswer answer = InTurn(
      problem.dimension == 2 ? RunsInPlane(problem, request, watch) : RunsInSpace(problem, request, watch),
      decides, [](const ClaimAnswer&, const ClaimAnswer&) { return false; });
  if (answer.state == ClaimState::kNotDecided) answer.reason = fmt::format("{}", fmt::join(ends, "; "));
  return answer;
}

}  // namespace stiction
