// SPDX-License-Identifier: Apache-2.0
// Certificates put together, and their witnesses read.
//
// A witness comes from anywhere. What the functions below expect of it and do not find is thrown as `Rejected`,
// and ends the check of the certificate: CheckCertificate (certificate.h) makes a reason of it.

#ifndef STICTION_CERTIFY_WITNESS_H_
#define STICTION_CERTIFY_WITNESS_H_

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "certify/modes.h"
#include "corpus/json_text.h"
#include "corpus/problem_file.h"

namespace stiction {

// ---- Making ------------------------------------------------------------------------------------

// `stiction-certificate`, version 1, of this claim.
Json MakeCertificate(const char* claim, const ExactProblem& problem, Json witness);

// ---- Reading -----------------------------------------------------------------------------------

struct Rejected {
  std::string path, found, expected;
};

// An object with exactly these keys, in any order.
void RequireKeys(const Json& json, const std::string& path, const std::set<std::string>& keys);
void RequireEqual(const Rational& found, const Rational& expected, const std::string& path);
// A list; of `size` items.
void RequireList(const Json& json, const std::string& path);
void RequireList(const Json& json, const std::string& path, std::size_t size, const char* items);

Rational ReadNumber(const Json& json, const std::string& path);
std::int64_t ReadInteger(const Json& json, const std::string& path, std::int64_t least);
ExactVector ReadVector(const Json& json, const std::string& path, int size);
// Modes of the first contacts of the problem, of their kinds.
ModeWord ReadPrefix(const Json& json, const std::string& path, const ExactProblem& problem);

// A check of a witness against its problem: the facts of an accepted one, otherwise Rejected is thrown.
using WitnessCheck = Json(const ExactProblem&, const Json& witness);

// What the check finds wrong; empty if it accepts.
std::optional<Rejected> FindFault(WitnessCheck& check, const ExactProblem& problem, const Json& witness);

}  // namespace stiction

#endif  // STICTION_CERTIFY_WITNESS_H_
