// SPDX-License-Identifier: Apache-2.0
// A claim: what it says, of which problems, and side by side what makes its certificate and what checks it.
//
// A file <name>.cpp of this folder with a function `ClaimRows <Name>Claims()` has the claims of one idea, a row
// for each. The build finds it; nothing else names it.

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "certify/claims/claim_answer.h"
#include "certify/claims/witness.h"
#include "certify/exact/enumerate.h"
#include "corpus/json_text.h"
#include "corpus/record/factors.h"
#include "solver/problem/options.h"

namespace stiction {

// Of the request limits are read, and by `existence` law; of what is claimed of runs all policies.
using ClaimMaker = ClaimAnswer(const ExactProblem&, const Request&, const std::vector<Policy>& policies,
                               const EnumerationWatch&);

inline void RequireAny(const ExactProblem&, const std::string&) {}

struct Claim {
  std::string_view name;
  WitnessCheck* check = nullptr;  // null where certificates bear other names

  std::string_view meaning = {};  // in words
  // Whether it is so; null where the claim is not asked for by this name.
  ClaimMaker* certify = nullptr;
  // InputError, by its place in `source`, for a problem of which it is not made.
  void (*require)(const ExactProblem&, const std::string& source) = RequireAny;
  std::string_view proves = {};  // in words, of solutions; empty for what speaks of something else
  bool negative = false;         // whether it says that another claim is false
  // The certificate that factors of the problem make: as its witness, or by forces that they are solved for.
  // Null where they show nothing.
  SharedJson (*by_factors)(const ExactProblem&, const ExactFactors&, const Request&) = nullptr;

  // By factors, of a problem that has some and where they show it, otherwise by `certify`, which is not null.
  ClaimAnswer Decide(const ExactProblem& problem, const Request& request, const std::vector<Policy>& policies,
                     const ExactFactors* factors, const EnumerationWatch& watch = {}) const;
};

// The claims of a file. Files are told in the order of their places.
struct ClaimRows {
  int place;
  std::span<const Claim> claims;
};

// Of the problem alone; `Make` as for ByCertificate.
template <auto* Make>
ClaimAnswer Alone(const ExactProblem& problem, const Request&, const std::vector<Policy>&,
                  const EnumerationWatch&) {
  return ByCertificate(Make(problem));
}

// What claims are made of: planar problems; those in space; planar problems of frictionless and static
// contacts, of which alone `what` is said. InputError that names the place in `source` otherwise.
void RequirePlanar(const ExactProblem& problem, const std::string& source);
void RequireSpace(const ExactProblem& problem, const std::string& source);
void RequireHandled(const ExactProblem& problem, const std::string& source, const std::string& what);

// ---- Shared by several claims; Rejected for what is not so -------------------------------------

void RequireSymmetric(const ExactProblem& problem);
// witness.f is a solution, and witness.a is A f + b.
void RequireSolution(const ExactProblem& problem, const Json& witness);
// D, once A = L diag(D) L' with D >= 0, which is symmetric.
ExactVector RequireFactors(const ExactProblem& problem, const Json& witness);
void RequireDefinite(const ExactProblem& problem, const Json& witness);

// A = L diag(D) L', as a witness has it.
Json FactorsToJson(const LdltFactors& factors);
// InputError: a claim of symmetric A only, whose symmetric part meets it.
void RequireSymmetricToClaim(const ExactProblem& problem, const std::string& claim);

}  // namespace stiction
