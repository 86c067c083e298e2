// SPDX-License-Identifier: Apache-2.0
#include "search/generators/exponential.h"

#include <algorithm>

namespace stiction {
namespace {

Rational PowerOfTwo(int exponent) { return Rational(mpz_class(1) << exponent); }

}  // namespace

ExactProblem ExponentialFamily(int contacts, bool scaled) {
  const int n = contacts;
  ExactProblem problem;
  problem.contacts.assign(n, {ContactKind::kFrictionless, 0, {}});
  problem.A.resize(n, n);
  problem.b.resize(n);
  const auto scale = [&](int i) { return scaled ? PowerOfTwo(2 * (n - i)) : Rational(1); };
  for (int i = 1; i <= n; ++i) {
    problem.b[i - 1] = scale(i) * (1 / PowerOfTwo(3 * (n + 1 - i)) - 1);
    for (int j = 1; j <= n; ++j) {
      const int entry = i == j ? 1 + 4 * (n - i) : 2 + 4 * (n - std::max(i, j));
      problem.A(i - 1, j - 1) = scale(i) * scale(j) * entry;
    }
  }
  return problem;
}

}  // namespace stiction
