// SPDX-License-Identifier: Apache-2.0
// Certificates: `stiction-certificate`, version 1; certify/certificates.md describes them.

#pragma once

#include <string>
#include <vector>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "solver/problem/solution.h"

namespace stiction {

struct ExactRun;  // certify/exact/exact.h

// ---- Making. Each returns a certificate that CheckCertificate accepts. -----------------------

// Requires: f is a solution (FindViolation is empty); otherwise InternalError.
SharedJson SolutionCertificate(const ExactProblem& problem, const ExactProblem::Vector& f);
// Requires: dimension 3, FindViolation is empty by Coulomb's law up to this bound; otherwise InternalError.
SharedJson CoulombCertificate(const ExactProblem& problem, const ExactProblem::Vector& f,
                              const Rational& bound);
// `symmetric` or `not-symmetric`.
Json SymmetryCertificate(const ExactProblem& problem);
// `psd` or `not-psd`. Of an asymmetric matrix only `not-psd` can be certified: otherwise InputError.
Json SemidefiniteCertificate(const ExactProblem& problem);
// `definite` or `not-definite`, in the same way.
Json DefiniteCertificate(const ExactProblem& problem);
// `in-range` or `not-in-range`.
Json RangeCertificate(const ExactProblem& problem);
// `h` or `not-h` (hypothesis.h); null if neither is shown, which is rare and happens in space only. InputError
// for problems with sliding contacts.
Json HypothesisCertificate(const ExactProblem& problem);
// `exists`: A is semidefinite and (H) holds, so there is a solution (existence.md, theorem 1); null if either
// is not shown. InputError for an asymmetric A and for sliding contacts, of which the theorem does not speak.
Json ExistsCertificate(const ExactProblem& problem);
// `cycle`, for those of the policies that end in one; in space, of frictionless and static contacts, for the
// first that is proved to. A null value if none is.
SharedJson CycleCertificate(const ExactProblem& problem, const std::vector<Policy>& policies,
                            const Limits& limits);

// Steps as certificates and `replay --json` write them.
Json PivotToJson(const Pivot<Rational>& pivot, const std::vector<std::string>& names);
// The outer state that recurs.
Json CycleStateToJson(const ExactRun& run, const std::vector<std::string>& names);

// ---- Checking --------------------------------------------------------------------------------

struct CheckReport {
  bool accepted = false;
  std::string claim;         // as far as it could be read
  std::string reason;        // why it was rejected: JSON path, found, expected
  bool is_too_dear = false;  // rejected for the work that it asks for, not for what it says
  std::string digest;        // of the problem (corpus/record/digest.h), as far as it could be read
  SharedJson facts;          // of an accepted certificate: policies, start, period, ...
};

// A certificate comes from anywhere; no honest one has come near these, nor near kMostJsonDepth and
// kMostCharactersOfNumber. All else that bounds a check goes by the length of what is read: Budget (witness.h).
inline constexpr std::size_t kMostBytesOfCertificate = std::size_t{1} << 25;
inline constexpr int kMostRowsOfCertificate = 3000;

// `source` names the certificate in reasons; `digest`, where it is not empty, is that of the problem which the
// certificate must speak of. Never throws for a bad certificate.
CheckReport CheckCertificate(const Json& certificate, const std::string& source,
                             const std::string& digest = {});

// The policies that a `cycle` or a `counterexample` names.
std::vector<Policy> CertifiedPolicies(const Json& certificate);

}  // namespace stiction
