// SPDX-License-Identifier: Apache-2.0
#include "certify/verify_solution.h"

#include <fmt/format.h>

namespace stiction {
namespace {

std::optional<std::string> Broken(int contact, const char* condition, const Rational& found) {
  return fmt::format("contact {}: {} is broken, found {}", contact + 1, condition, ToString(found));
}

std::optional<std::string> NormalViolation(int contact, const Rational& f, const Rational& a) {
  if (f < 0) return Broken(contact, "fN >= 0", f);
  if (a < 0) return Broken(contact, "aN >= 0", a);
  const Rational product = f * a;
  if (product != 0) return Broken(contact, "fN aN = 0", product);
  return std::nullopt;
}

std::optional<std::string> FrictionViolation(int contact, const Rational& bound, const Rational& f,
                                             const Rational& a) {
  const Rational slack = bound - abs(f);
  if (slack < 0) return Broken(contact, "abs(fF) <= mu fN", slack);
  const Rational power = a * f;
  if (power > 0) return Broken(contact, "aF fF <= 0", power);
  const Rational product = a * slack;
  if (product != 0) return Broken(contact, "aF (mu fN - abs(fF)) = 0", product);
  return std::nullopt;
}

}  // namespace

ExactProblem::Vector Accelerations(const ExactProblem& problem, const ExactProblem::Vector& f) {
  ExactProblem::Vector a = problem.b;
  for (int i = 0; i < a.size(); ++i) {
    for (int j = 0; j < a.size(); ++j) {
      if (f[j] != 0) a[i] += problem.A(i, j) * f[j];
    }
  }
  return a;
}

std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f) {
  const ExactProblem::Vector a = Accelerations(problem, f);
  int row = 0;
  for (int contact = 0; contact < static_cast<int>(problem.contacts.size()); ++contact) {
    const Contact<Rational>& law = problem.contacts[contact];
    if (auto violation = NormalViolation(contact, f[row], a[row])) return violation;
    if (law.HasFrictionRows()) {
      const Rational bound = law.mu * f[row];
      if (auto violation = FrictionViolation(contact, bound, f[row + 1], a[row + 1])) return violation;
      ++row;
    }
    ++row;
  }
  return std::nullopt;
}

}  // namespace stiction
