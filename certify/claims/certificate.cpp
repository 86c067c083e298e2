// SPDX-License-Identifier: Apache-2.0
// The format of certificates, and their check: structure to the letter, then the claim from the problem alone.

#include "certify/claims/certificate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "certify/claims/claims.h"
#include "certify/claims/witness.h"
#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "corpus/record/problem_file.h"

namespace stiction {

namespace {

// The check of the claim, which the report names from now on.
WitnessCheck& ReadClaim(const Json& certificate, CheckReport& report) {
  RequireKeys(certificate, "certificate", {"claim", "format", "problem", "version", "witness"});
  if (certificate["format"] != "stiction-certificate") {
    throw Rejected{"format", Shown(certificate["format"]), "\"stiction-certificate\""};
  }
  if (!certificate["version"].is_number_integer() || certificate["version"] != 1) {
    throw Rejected{"version", Shown(certificate["version"]), "1"};
  }
  if (certificate["claim"].is_string()) report.claim = certificate["claim"].get<std::string>();
  std::vector<std::string_view> names;
  for (const Claim& claim : AllClaims()) {
    if (claim.check == nullptr) continue;
    if (claim.name == report.claim) return *claim.check;
    names.push_back(claim.name);
  }
  std::sort(names.begin(), names.end());
  throw Rejected{"claim", Shown(certificate["claim"]), fmt::format("one of {}", fmt::join(names, ", "))};
}

// Before a matrix is made of them. What is no list of contacts is refused where it is read.
void RequireFewRows(const Json& problem) {
  if (!problem.is_object() || !problem.contains("contacts") || !problem.contains("dimension")) return;
  const std::size_t with_friction = problem["dimension"] == 3 ? 3 : 2;
  std::size_t rows = 0;
  for (const Json& contact : problem["contacts"])
    rows += contact.is_object() && contact.contains("mu") ? with_friction : 1;
  if (rows > kMostRowsOfCertificate)
    throw Rejected{"problem.contacts", fmt::format("contacts of {} rows", rows),
                   fmt::format("at most {}", kMostRowsOfCertificate)};
  const std::int64_t most = Budget::MostCells(), cells = static_cast<std::int64_t>(rows * rows);
  if (cells > most)
    RefuseCost(fmt::format("{} rows, a matrix of {} entries", rows, cells),
               fmt::format(" of {}, by its length of {}", most, Budget::Length()));
}

// Digits of numerator and denominator of what a text stands for, its exponent written out; 0 if it is no
// number, or one that is refused where it is read.
std::int64_t DigitsOf(std::string_view text) {
  std::int64_t digits = 0, places = 0, exponent = 0;
  bool in_fraction = false;
  if (text.size() > kMostCharactersOfNumber) return 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c >= '0' && c <= '9') {
      digits += digits > 0 || c != '0';
      places += in_fraction;
    } else if (c == '/') {
      return digits + DigitsOf(text.substr(k + 1));
    } else if (c == '.') {
      in_fraction = true;
    } else if (c == 'e' || c == 'E') {
      const auto sign = text.substr(k + 1).starts_with('+') ? 2 : 1;
      const auto end = std::from_chars(text.data() + k + sign, text.data() + text.size(), exponent);
      if (end.ec != std::errc() || std::abs(exponent) > 10000) return 0;
      break;
    } else if (c != '-') {
      return 0;
    }
  }
  return digits == 0 ? 0 : digits + std::abs(exponent - places);
}

std::int64_t AllDigits(const Json& json) {
  if (const auto* text = json.get_ptr<const std::string*>()) return DigitsOf(*text);
  std::int64_t digits = 0;
  if (json.is_structured())
    for (const Json& item : json) digits += AllDigits(item);
  return digits;
}

// Before any is read.
void RequireFewDigits(const Json& certificate) {
  const std::int64_t digits = AllDigits(certificate["problem"]) + AllDigits(certificate["witness"]);
  const std::int64_t most = Budget::MostDigits();
  if (digits > most)
    RefuseCost(fmt::format("numbers of {} digits", digits),
               fmt::format(" of {} in all, by its length of {}", most, Budget::Length()));
}

std::string ReasonOf(const Rejected& rejected) {
  return rejected.path + ": found " + rejected.found + ", expected " + rejected.expected;
}

}  // namespace

CheckReport CheckCertificate(const Json& certificate, const std::string& source, const std::string& digest) {
  CheckReport report;
  try {
    WitnessCheck& check = ReadClaim(certificate, report);
    const Budget budget({&certificate["problem"], &certificate["witness"]});
    RequireFewDigits(certificate);
    RequireFewRows(certificate["problem"]);
    const ExactProblem problem = ProblemFromJson(certificate["problem"], source, "problem", true);
    report.digest = ProblemDigest(problem);
    if (!digest.empty() && report.digest != digest) {
      throw Rejected{"problem", report.digest, digest + ", the problem that was asked for"};
    }
    report.facts = check(problem, certificate["witness"]);
    report.accepted = true;
  } catch (const TooDear& rejected) {
    report.is_too_dear = true;
    report.reason = ReasonOf(rejected);
  } catch (const Rejected& rejected) {
    report.reason = ReasonOf(rejected);
  } catch (const InputError& error) {
    report.reason = error.what();
  }
  return report;
}

std::vector<Policy> CertifiedPolicies(const Json& certificate) {
  std::vector<Policy> policies;
  const Json& witness = certificate["witness"];
  if (witness.contains("policy")) return {ParsePolicy(witness["policy"].get<std::string>())};
  for (const Json& run : witness["runs"]) {
    for (const Json& name : run["policies"]) policies.push_back(ParsePolicy(name.get<std::string>()));
  }
  return policies;
}

}  // namespace stiction
