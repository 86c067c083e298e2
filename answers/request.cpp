// SPDX-License-Identifier: Apache-2.0
#include "answers/request.h"

#include <fmt/format.h>

namespace stiction {
namespace {

FrictionLaw LawOf(const Wanted& wanted, int dimension, const std::string& source) {
  if (wanted.law != "baraff" && wanted.law != "coulomb")
    throw InputError(fmt::format("law: found {}, expected baraff or coulomb", wanted.law));
  if (dimension == 2 && wanted.law != "baraff")
    throw InputError(source, "dimension", "2",
                     fmt::format("3: {}law chooses a law of friction in space", wanted.dashes));
  return wanted.law == "coulomb" ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
}

Arithmetic ArithmeticNamed(const std::string& name) {
  const auto arithmetic = FindArithmetic(name);
  if (!arithmetic)
    throw InputError(fmt::format("arithmetic: found {}, expected one that 'stiction methods' lists", name));
  return *arithmetic;
}

}  // namespace

SolveRequest RequestOf(const Wanted& wanted, const ExactProblem& problem, const std::string& source) {
  SolveRequest request{.method = wanted.method, .options = wanted.options};
  request.options.policy = ParsePolicy(wanted.policy);
  request.options.law = LawOf(wanted, problem.dimension, source);
  if (wanted.method != kAutomatic && FindMethodFacts(wanted.method) == nullptr)
    throw InputError(
        fmt::format("method: found {}, expected one that 'stiction methods' lists", wanted.method));
  if (wanted.method != "baraff" && request.options.policy != Policy{})
    throw InputError(fmt::format("{0}policy {1}: expected {0}method baraff, of which it is a reading",
                                 wanted.dashes, wanted.policy));
  const bool polygon = wanted.method == "baraff" && request.options.policy == ParsePolicy("slip=polygon");
  if (problem.dimension == 3 && polygon) request.method = "complete";  // which that reading is
  request.arithmetic = wanted.arithmetic.empty() ? UsualArithmetic(request.method, problem).arithmetic
                                                 : ArithmeticNamed(wanted.arithmetic);
  const std::string refusal = Refusal(request.method, problem.dimension, request.arithmetic);
  if (!refusal.empty()) throw InputError(source + ": " + refusal);
  return request;
}

}  // namespace stiction
