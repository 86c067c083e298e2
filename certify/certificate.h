// SPDX-License-Identifier: Apache-2.0
// Certificates: `stiction-certificate`, version 1; README.md of this folder describes them.

#ifndef STICTION_CERTIFY_CERTIFICATE_H_
#define STICTION_CERTIFY_CERTIFICATE_H_

#include <string>
#include <vector>

#include "corpus/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

struct ExactRun;  // certify/exact.h

// ---- Making. Each returns a certificate that CheckCertificate accepts. -----------------------

// Requires: f is a solution (FindViolation is empty; in space FindWeakViolation); otherwise InternalError.
Json SolutionCertificate(const ExactProblem& problem, const ExactProblem::Vector& f);
// Requires: dimension 3, FindCoulombViolation is empty for this bound; otherwise InternalError.
Json CoulombCertificate(const ExactProblem& problem, const ExactProblem::Vector& f, const Rational& bound);
// `symmetric` or `not-symmetric`.
Json SymmetryCertificate(const ExactProblem& problem);
// `psd` or `not-psd`. Of an asymmetric matrix only `not-psd` can be certified: otherwise InputError.
Json SemidefiniteCertificate(const ExactProblem& problem);
// `in-range` or `not-in-range`.
Json RangeCertificate(const ExactProblem& problem);
// `h` or `not-h` (hypothesis.h); null if neither is shown, which happens in space only. InputError for problems
// with sliding contacts.
Json HypothesisCertificate(const ExactProblem& problem);
// `cycle` or `stall`, for those of the policies that end in it; a null value if none does.
Json LoopCertificate(const ExactProblem& problem, Outcome loop, const std::vector<Policy>& policies,
                     const Limits& limits);

// Steps as certificates and `replay --json` write them.
Json PivotToJson(const Pivot<Rational>& pivot, const std::vector<std::string>& names);
// The state that recurs, for a cycle or a stall.
Json LoopStateToJson(const ExactRun& run, const std::vector<std::string>& names);
Json VectorToJson(const ExactProblem::Vector& values);

// ---- Checking --------------------------------------------------------------------------------

struct CheckReport {
  bool accepted = false;
  std::string claim;   // as far as it could be read
  std::string reason;  // why it was rejected: JSON path, found, expected
  Json facts;          // of an accepted certificate: policies, start, period, ...
};

// `source` names the certificate in reasons. Never throws for a bad certificate.
CheckReport CheckCertificate(const Json& certificate, const std::string& source);

// What a certificate claims: outcome of a loop certificate, policies it names.
std::vector<Policy> CertifiedPolicies(const Json& loop_certificate);

}  // namespace stiction

#endif  // STICTION_CERTIFY_CERTIFICATE_H_
