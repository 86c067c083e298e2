// SPDX-License-Identifier: Apache-2.0
// Certificates of problems at extremes: what is made is accepted, and nothing else is claimed.

#include "certify/claims/certificate.h"
#include "certify/claims/claims.h"
#include "certify/claims/condition.h"
#include "certify/claims/existence.h"
#include "certify/claims/safe.h"
#include "certify/claims/safety_threshold.h"
#include "corpus/json.h"
#include "solver/problem/check.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/extreme.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

// Lemke's method on polygons of a problem of long numbers multiplies all of these.
constexpr Limits kRunLimits = {.drives = 60, .pivots = 200, .bits = 4000};
constexpr std::int64_t kMostPrograms = 500;

void RequireAccepted(const Json& certificate) {
  if (!certificate.is_object()) return;  // nothing was shown
  const CheckReport report = CheckCertificate(ParseJson(JsonText(certificate), "made"), "made");
  STICTION_CHECK(report.accepted, "a certificate of our own is rejected: " + report.reason);
  const std::string fault = FaultOfClaim(certificate);
  STICTION_CHECK(fault.empty(), "made, though " + fault);
}

Json ExistenceCertificate(const ExactProblem& problem) {
  Request request = {.law = FrictionLaw::kBaraff, .limits = kRunLimits};
  request.limits.programs = kMostPrograms;
  return DecideExistence(problem, request).certificate;
}

std::vector<Policy> PaperAnd(int policy) {
  const Policy& other = PlanarGrid()[static_cast<std::size_t>(policy)];
  return other == Policy{} ? std::vector{other} : std::vector{Policy{}, other};
}

// Friction up to which a problem is safe: none of the two bounds contradicts the other.
void RequireSafeFriction(const ExactProblem& problem) {
  const auto bound = FindConditionBound(problem, FrictionWeights::kUniform);
  const auto friction = bound ? bound->SafeFriction() : std::nullopt;
  const auto threshold = FindSafetyThreshold(problem);
  STICTION_CHECK(!friction || *friction > 0, "a friction coefficient that is not positive");
  STICTION_CHECK(!friction || !threshold || *friction <= threshold->high, "safe by condition, and not safe");
}

template <class Make>
bool Makes(Make make) {
  const auto certificate = Unrefused(make);
  if (certificate) RequireAccepted(*certificate);
  return certificate && certificate->is_object();
}

}  // namespace

bool FuzzCertify(std::string_view input) {
  Bytes bytes(input);
  const int policy = bytes.Integer(0, static_cast<int>(PlanarGrid().size()) - 1);
  const ExactProblem problem = ExtremeProblem(bytes);
  int made = 0;
  for (const auto& make : {SymmetryCertificate, SemidefiniteCertificate, DefiniteCertificate, RangeCertificate,
                           HypothesisCertificate, SafetyCertificate, ExistenceCertificate}) {
    made += Makes([&] { return make(problem); });
  }
  made += Makes([&] { return ConditionCertificate(problem).value_or(Json()); });
  if (problem.dimension == 2) {
    const std::vector<Policy> policies = PaperAnd(policy);
    made += Makes([&]() -> Json { return CycleCertificate(problem, policies, kRunLimits); });
    made += Makes([&] {
      return CertifyClaim(problem, "made", "counterexample", {.limits = kRunLimits}, policies)
          ->at("certificate");
    });
  }
  Unrefused([&problem] {
    RequireSafeFriction(problem);
    return true;
  });
  return made > 0;
}

}  // namespace stiction::fuzz
