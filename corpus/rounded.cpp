// SPDX-License-Identifier: Apache-2.0
#include "corpus/rounded.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "corpus/json_text.h"
#include "solver/problem/answer.h"

namespace stiction {
namespace {

// Whether x keeps its digits: it is zero, or normal, or exactly what it stands for.
template <class Scalar>
bool Holds(const Rational& exact, Scalar x) {
  if (!std::isfinite(x)) return false;
  const bool is_normal = std::abs(x) >= std::numeric_limits<Scalar>::min();
  return is_normal || (x == 0 && Sign(exact) == 0) || Rational(static_cast<double>(x)) == exact;
}

// `path`(): where the number stands.
template <class Scalar, class Path>
Scalar Round(const Rational& exact, const Path& path) {
  const double nearest = ToDouble(exact);
  const auto x = static_cast<Scalar>(nearest);
  if (!Holds(exact, nearest) || !Holds(exact, x)) throw RangeError(path(), exact, Name(kArithmeticOf<Scalar>));
  return x;
}

template <class Scalar>
Contact<Scalar> RoundedContact(const Contact<Rational>& contact, std::size_t i) {
  const auto slip = [i] { return fmt::format("contacts[{}].slip", i); };
  return {contact.kind,
          Round<Scalar>(contact.mu, [i] { return fmt::format("contacts[{}].mu", i); }),
          {Round<Scalar>(contact.slip[0], slip), Round<Scalar>(contact.slip[1], slip)}};
}

}  // namespace

RangeError::RangeError(const std::string& path, const Rational& found, std::string_view arithmetic)
    : InputError(fmt::format("{}: found {}, expected a number {}", path, Shortened(ToString(found)),
                             abs(found) > 1 ? fmt::format("in the range of {}", arithmetic)
                                            : fmt::format("that {} holds with all its digits", arithmetic))) {}

template <class Scalar>
ContactProblem<Scalar> Rounded(const ExactProblem& problem) {
  ContactProblem<Scalar> result;
  result.dimension = problem.dimension;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i)
    result.contacts.push_back(RoundedContact<Scalar>(problem.contacts[i], i));
  const int rows = problem.rows();
  result.A.resize(rows, rows);
  result.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    result.b[i] = Round<Scalar>(problem.b[i], [i] { return fmt::format("b[{}]", i); });
    for (int j = 0; j < rows; ++j)
      result.A(i, j) = Round<Scalar>(problem.A(i, j), [i, j] { return fmt::format("A[{}][{}]", i, j); });
  }
  return result;
}

template ContactProblem<float> Rounded(const ExactProblem&);
template ContactProblem<double> Rounded(const ExactProblem&);

}  // namespace stiction
