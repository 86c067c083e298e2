// SPDX-License-Identifier: Apache-2.0
// What is asked by names, by the program and from Python: of a solver, of a run that is followed, of a
// certificate. Whatever the names do not fit is refused here, so that both refuse the same.

#pragma once

#include <array>
#include <string>
#include <string_view>

#include "certify/claims/certificate.h"
#include "certify/exact/enumerate.h"
#include "certify/request/solve_in.h"

namespace stiction {

// Why a method is not to be had so, and what is; empty if it is.
std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic);

// Where nobody asks for an arithmetic: exact, unless the method is not built so, or problem and method are of
// the kind that doubles are for; then double or interval. And why, in words.
struct ArithmeticChoice {
  Arithmetic arithmetic = Arithmetic::kExact;
  std::string why;
};
ArithmeticChoice UsualArithmetic(std::string_view method, const AnyProblem& problem);

// Of `request`, method, arithmetic, policy and law are set by their names here.
struct Wanted {
  std::string method{kAutomatic};
  std::string arithmetic = "";  // empty: the usual one
  std::string policy = "paper";
  std::string law = "";  // the paper's of method baraff and of runs that are followed, otherwise Coulomb's
  Request request = {};
  std::string_view dashes = "--";  // before the name of an option, where an error tells of it
};

// Of the friction polygons in space.
inline constexpr std::string_view kSidesExpected = "a multiple of 4, at least 4";
inline constexpr bool AreSides(int sides) { return sides >= 4 && sides % 4 == 0; }

// The request, checked against the table of methods. A polygon reading of the published algorithm in space is
// complete driving. InputError that names what is no name or does not fit the problem of `source`, as what asks
// for all of an A that is too large for it.
Request RequestOf(const Wanted& wanted, const AnyProblem& problem, const std::string& source);

// Likewise of a run that is followed step by step: of a method with a path, under no other's name, and by
// default exact where it is built so, otherwise over doubles.
Request PathRequestOf(const Wanted& wanted, const AnyProblem& problem, const std::string& source);
// What it can be followed in: not over intervals, which have bounds of the forces in place of forces.
inline constexpr std::array<std::string_view, 5> kPathArithmetics = {"exact", "float", "double", "quad",
                                                                     "filtered"};

// SolveIn, whose InputError then names the source.
Solution SolveAsked(const AnyProblem& problem, const Request& request, const std::string& source,
                    Stopwatch* watch = nullptr);

// ---- Certificates ----

// What became of the claim (certify/claims/claim_answer.h). Of what is wanted policy, or "*", law, of claim
// existence in space alone, and the limits of the request are read. `factors`: of the problem, where it has
// some.
SharedJson CertificateOf(const std::string& claim, const Wanted& wanted, const ExactProblem& problem,
                         const std::string& source, const ExactFactors* factors,
                         const EnumerationWatch& watch = {});

// CheckCertificate of a text, which InputError refuses that is too long for one, or no JSON.
CheckReport CheckText(const std::string& text, const std::string& source, const std::string& digest);

}  // namespace stiction
