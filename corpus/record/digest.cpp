// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "solver/problem/check.h"

namespace stiction {
namespace {

template <typename Numbers>
std::string DigestLine(std::string_view first, const Numbers& numbers) {
  std::string line(first);
  for (const Rational& x : numbers) line += " " + ToString(x);
  return line + "\n";
}

std::string ContactLine(const Contact<Rational>& contact, int dimension) {
  std::vector<Rational> numbers;
  if (contact.HasFrictionRows()) numbers.push_back(contact.mu);
  if (contact.kind == ContactKind::kSliding) {
    numbers.insert(numbers.end(), contact.slip.begin(), contact.slip.begin() + dimension - 1);
  }
  return DigestLine(Name(contact.kind), numbers);
}

}  // namespace

std::string Sha256(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned int count = 0;
  const int done = EVP_Digest(text.data(), text.size(), bytes.data(), &count, EVP_sha256(), nullptr);
  STICTION_CHECK(done == 1, "SHA-256 is not available");
  return fmt::format("{:02x}", fmt::join(bytes.begin(), bytes.begin() + count, ""));
}

std::string ProblemDigest(const ExactProblem& problem) {
  std::string text = fmt::format("stiction-problem 1\ndimension {}\n", problem.dimension);
  for (const auto& contact : problem.contacts) text += ContactLine(contact, problem.dimension);
  for (int i = 0; i < problem.rows(); ++i) text += DigestLine("A", problem.A.row(i));
  return "sha256:" + Sha256(text + DigestLine("b", problem.b));
}

}  // namespace stiction
