// SPDX-License-Identifier: Apache-2.0
// Problems in other numbers.

#ifndef STICTION_CORPUS_ROUNDED_H_
#define STICTION_CORPUS_ROUNDED_H_

#include "corpus/problem_file.h"

namespace stiction {

// convert(x) of every number x.
template <class To, class From, class Convert>
ContactProblem<To> Converted(const ContactProblem<From>& problem, Convert convert) {
  ContactProblem<To> result;
  result.dimension = problem.dimension;
  for (const Contact<From>& contact : problem.contacts) {
    result.contacts.push_back(
        {contact.kind, convert(contact.mu), {convert(contact.slip[0]), convert(contact.slip[1])}});
  }
  result.A = problem.A.unaryExpr(convert);
  result.b = problem.b.unaryExpr(convert);
  return result;
}

// Every number at its nearest double, and that at its nearest Scalar.
template <class Scalar>
ContactProblem<Scalar> Rounded(const ExactProblem& problem) {
  return Converted<Scalar>(problem, [](const Rational& x) { return static_cast<Scalar>(ToDouble(x)); });
}

}  // namespace stiction

#endif  // STICTION_CORPUS_ROUNDED_H_
