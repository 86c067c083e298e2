// SPDX-License-Identifier: Apache-2.0
// A rational of whose integers nothing is said (Fractions): the solver's templates then eliminate over
// fractions.

#pragma once

#include "corpus/exact_problem.h"

namespace stiction {

struct PlainRational : Rational {
  using Rational::Rational;
  PlainRational() = default;
  PlainRational(const Rational& x) : Rational(x) {}
};

inline ContactProblem<PlainRational> Plain(const ExactProblem& problem) {
  ContactProblem<PlainRational> plain;
  for (const auto& contact : problem.contacts) plain.contacts.push_back({contact.kind, contact.mu, {}});
  plain.A = problem.A.cast<PlainRational>();
  plain.b = problem.b.cast<PlainRational>();
  return plain;
}

}  // namespace stiction
