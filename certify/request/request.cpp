// SPDX-License-Identifier: Apache-2.0
#include "certify/request/request.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/claims.h"
#include "certify/claims/policy_ends.h"
#include "certify/request/entries.h"
#include "corpus/grouped.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"

namespace stiction {
namespace {

bool IsFloating(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::kFloat || arithmetic == Arithmetic::kDouble ||
         arithmetic == Arithmetic::kQuad;
}

std::vector<std::string_view> ArithmeticsOf(const MethodFacts& facts, int dimension) {
  std::vector<std::string_view> names;
  for (int i = 0; i < kArithmeticCount; ++i) {
    if (facts.IsBuilt(dimension, static_cast<Arithmetic>(i))) names.push_back(kArithmeticNames[i]);
  }
  return names;
}

std::vector<std::string_view> MethodsOf(int dimension, Arithmetic arithmetic) {
  std::vector<std::string_view> names;
  for (const MethodFacts& facts : AllMethods()) {
    if (facts.IsBuilt(dimension, arithmetic)) names.push_back(facts.name);
  }
  return names;
}

// The law of this name; of none, `usual`.
FrictionLaw LawNamed(const std::string& law, FrictionLaw usual, int dimension, const std::string& source,
                     std::string_view dashes) {
  if (law.empty()) return usual;
  if (law != "baraff" && law != "coulomb")
    throw InputError(fmt::format("{}law: found {}, expected baraff or coulomb", dashes, law));
  if (dimension == 2)
    throw InputError(source, "dimension", "2",
                     fmt::format("3: {}law chooses a law of friction in space", dashes));
  return law == "coulomb" ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
}

Arithmetic ArithmeticNamed(const Wanted& wanted) {
  const auto at = std::find(kArithmeticNames.begin(), kArithmeticNames.end(), wanted.arithmetic);
  if (at == kArithmeticNames.end())
    throw InputError(
        fmt::format("{}arithmetic: found {}, expected one of {}; 'stiction methods' says which a "
                    "method has",
                    wanted.dashes, wanted.arithmetic, fmt::join(kArithmeticNames, ", ")));
  return static_cast<Arithmetic>(at - kArithmeticNames.begin());
}

void RequireMethod(const Wanted& wanted) {
  if (wanted.method == kAutomatic || FindMethodFacts(wanted.method) != nullptr) return;
  std::vector<std::string_view> names = {kAutomatic};
  for (const MethodFacts& facts : AllMethods()) names.push_back(facts.name);
  throw InputError(fmt::format("{}method: found {}, expected one of {}", wanted.dashes, wanted.method,
                               fmt::join(names, ", ")));
}

void RequirePathMethod(const Wanted& wanted) {
  std::vector<std::string_view> followed;
  for (const MethodFacts& facts : AllMethods())
    if (facts.HasPath()) followed.push_back(facts.name);
  if (std::find(followed.begin(), followed.end(), wanted.method) == followed.end())
    throw InputError(fmt::format("{}method: found {}, expected one with a path: {}", wanted.dashes,
                                 wanted.method, fmt::join(followed, ", ")));
}

void RequirePathArithmetic(const Wanted& wanted) {
  const auto& all = kPathArithmetics;
  if (std::find(all.begin(), all.end(), wanted.arithmetic) == all.end())
    throw InputError(fmt::format("{}arithmetic: found {}, expected one of {}", wanted.dashes, wanted.arithmetic,
                                 fmt::join(all, ", ")));
}

// All but the arithmetic.
Request NamedRequest(const Wanted& wanted, const AnyProblem& problem, const std::string& source) {
  Request request = wanted.request;
  const MethodFacts* facts = FindMethodFacts(wanted.method);
  request.method = facts != nullptr ? facts->name : kAutomatic;
  request.policy = ParsePolicy(wanted.policy);
  const FrictionLaw usual = wanted.method == "baraff" ? FrictionLaw::kBaraff : FrictionLaw::kCoulomb;
  request.law = LawNamed(wanted.law, usual, problem.dimension(), source, wanted.dashes);
  if (!AreSides(wanted.request.sides))
    throw InputError(
        fmt::format("{}sides: found {}, expected {}", wanted.dashes, wanted.request.sides, kSidesExpected));
  if (wanted.method != "baraff" && request.policy != Policy{})
    throw InputError(fmt::format("{0}policy {1}: expected {0}method baraff, of which it is a reading",
                                 wanted.dashes, wanted.policy));
  return request;
}

// Over floating-point numbers the methods of space solve Coulomb's law, which is more than (21), (22) ask.
void RequireLaw(const Wanted& wanted, const Request& request) {
  if (wanted.law != "baraff" || request.method == "baraff" || request.arithmetic == Arithmetic::kExact) return;
  throw InputError(
      fmt::format("{0}law baraff: found {0}method {1} over {2}, expected {0}arithmetic exact, or {0}method "
                  "baraff; over {2} {1} "
                  "solves Coulomb's law, of which every solution is one of {0}law baraff",
                  wanted.dashes, request.method, Name(request.arithmetic)));
}

void RequireBuilt(const Request& request, const AnyProblem& problem, const std::string& source) {
  const std::string refusal = Refusal(request.method, problem.dimension(), request.arithmetic);
  if (!refusal.empty()) throw InputError(source + ": " + refusal);
}

// The option that asks for all of A, as its name and value; empty where none does.
std::string AsksForDense(const Wanted& wanted, const AnyProblem& problem) {
  const auto methods = MethodsOfEntries(problem);
  const bool is_sparse = std::find(methods.begin(), methods.end(), wanted.method) != methods.end();
  const auto option = [&wanted](std::string_view name, const std::string& value) {
    return fmt::format("{}{} {}", wanted.dashes, name, value);
  };
  if (wanted.method != kAutomatic && !is_sparse) return option("method", wanted.method);
  if (!wanted.arithmetic.empty() && wanted.arithmetic != "double")
    return option("arithmetic", wanted.arithmetic);
  if (wanted.policy != "paper") return option("policy", wanted.policy);
  if (!wanted.law.empty() && wanted.law != "coulomb") return option("law", wanted.law);
  return "";
}

void RequireMemory(const Wanted& wanted, const AnyProblem& problem, const std::string& source) {
  if (problem.rows() <= kMostDenseRows) return;
  const std::string dense = AsksForDense(wanted, problem);
  if (dense.empty()) return;
  throw InputError(source, "rows", std::to_string(problem.rows()),
                   fmt::format("at most {} with {}, for which A is dense; without it A stays sparse",
                               kMostDenseRows, dense));
}

}  // namespace

std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic) {
  const bool filtered = arithmetic == Arithmetic::kFiltered && dimension == 2;
  const bool any =
      method == kAutomatic && (IsFloating(arithmetic) || arithmetic == Arithmetic::kExact || filtered);
  const MethodFacts* facts = FindMethodFacts(method);
  if (any || (facts != nullptr && facts->IsBuilt(dimension, arithmetic))) return "";
  const char* where = dimension == 2 ? "the plane" : "space";
  std::string text =
      fmt::format("method {} with arithmetic {} in {}: not built", method, Name(arithmetic), where);
  const auto arithmetics =
      facts == nullptr ? std::vector<std::string_view>() : ArithmeticsOf(*facts, dimension);
  if (!arithmetics.empty()) return text + fmt::format("; expected one of {}", fmt::join(arithmetics, ", "));
  const auto methods = MethodsOf(dimension, arithmetic);
  if (!methods.empty())
    return text +
           fmt::format("; methods with arithmetic {} there: {}", Name(arithmetic), fmt::join(methods, ", "));
  return text + "; expected one of float, double, quad, filtered, exact";
}

ArithmeticChoice UsualArithmetic(std::string_view method, const AnyProblem& problem) {
  using enum Arithmetic;
  const int most = MostExactRows(problem.dimension());
  if (method == kAutomatic && StaysSparse(problem)) {
    if (problem.factors() != nullptr)
      return {kDouble, Counted(problem.rows(), "row") + " in factors: over doubles, A is not formed"};
    return {kDouble, fmt::format("more than {} rows: over doubles, A sparse", kMostDenseRows)};
  }
  if (method == kAutomatic && problem.rows() > most)
    return {kDouble, fmt::format("{} rows, more than {}: rationals would take long", problem.rows(), most)};
  if (method == "fast") return {kDouble, "the method is made for doubles"};
  if (Refusal(method, problem.dimension(), kExact).empty())
    return {kExact, "nothing is lost, and there are few rows"};
  if (Refusal(method, problem.dimension(), kInterval).empty())
    return {kInterval, "the method takes roots: intervals prove what they decide"};
  return {kDouble, "the method is built for nothing better"};
}

Request RequestOf(const Wanted& wanted, const AnyProblem& problem, const std::string& source) {
  RequireMethod(wanted);
  RequireMemory(wanted, problem, source);
  Request request = NamedRequest(wanted, problem, source);
  const bool polygon = wanted.method == "baraff" && request.policy == ParsePolicy("slip=polygon");
  if (problem.dimension() == 3 && polygon) request.method = "complete";  // which that reading is
  request.arithmetic =
      wanted.arithmetic.empty() ? UsualArithmetic(request.method, problem).arithmetic : ArithmeticNamed(wanted);
  RequireBuilt(request, problem, source);
  RequireLaw(wanted, request);
  return request;
}

Request PathRequestOf(const Wanted& wanted, const AnyProblem& problem, const std::string& source) {
  RequirePathMethod(wanted);
  Request request = NamedRequest(wanted, problem, source);
  request.trace = true;
  if (wanted.law.empty()) request.law = FrictionLaw::kBaraff;
  if (!wanted.arithmetic.empty()) {
    RequirePathArithmetic(wanted);
    request.arithmetic = ArithmeticNamed(wanted);
  } else if (!Refusal(request.method, problem.dimension(), Arithmetic::kExact).empty()) {
    request.arithmetic = Arithmetic::kDouble;
  }
  RequireBuilt(request, problem, source);
  return request;
}

Solution SolveAsked(const AnyProblem& problem, const Request& request, const std::string& source,
                    Stopwatch* watch) {
  try {
    return SolveIn(problem, request, watch);
  } catch (const InputError& error) {
    throw InputError(source + ": " + error.what());
  }
}

// ---- Certificates ----

SharedJson CertificateOf(const std::string& claim, const Wanted& wanted, const ExactProblem& problem,
                         const std::string& source, const ExactFactors* factors,
                         const EnumerationWatch& watch) {
  Request request = wanted.request;
  request.law = LawNamed(wanted.law, FrictionLaw::kCoulomb, problem.dimension, source, wanted.dashes);
  if (!wanted.law.empty() && claim != "existence")
    throw InputError(
        fmt::format("{0}law {1}: expected {0}claim existence, found {2}, of which no law is chosen",
                    wanted.dashes, wanted.law, claim));
  return CertifyClaim(problem, source, claim, request, PoliciesAsked(wanted.policy, problem.dimension), factors,
                      watch);
}

CheckReport CheckText(const std::string& text, const std::string& source, const std::string& digest) {
  if (text.size() > kMostBytesOfCertificate)
    throw InputError(source, "", fmt::format("{} bytes", text.size()),
                     fmt::format("a certificate of at most {}", kMostBytesOfCertificate));
  const JsonPlace root(text, source);
  const bool is_problem = root.HasFormat("stiction-problem", true) && !root.Optional("claim");
  if (!is_problem) return CheckCertificate(root.json(), source, digest);
  CheckReport report;
  report.reason = fmt::format(
      "found a problem, expected a certificate; stiction certify {} -o certificate.json writes one of it",
      source);
  return report;
}

}  // namespace stiction
