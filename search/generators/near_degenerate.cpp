// SPDX-License-Identifier: Apache-2.0
// near-degenerate: rows that are nearly dependent, forces near the ends of their ranges.

#include <algorithm>
#include <array>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// Forces f0 at or near the boundary of every contact's conditions: open (fN = 0), at a friction limit
// (fF = +-mu fN), or inside. Integers: fN is a multiple of mu's denominator. abs(f0) <= 4 * 64.
std::array<int, kMaxRows> DrawBoundaryForces(int contacts, const std::array<MuChoice, kMaxContacts>& mu,
                                             Choices& choices) {
  std::array<int, kMaxRows> f0;
  for (int i = 0; i < contacts; ++i) {
    const int state = static_cast<int>(choices.Integer(0, 3));
    const int size = state == 0 ? 0 : static_cast<int>(choices.Integer(1, 4));
    const int limit = size * mu[i].numerator;
    f0[2 * i] = size * mu[i].denominator;
    f0[2 * i + 1] = state == 3 ? -limit : limit;
    if (state == 1) f0[2 * i + 1] = static_cast<int>(choices.Integer(-limit, limit));
  }
  return f0;
}

// J = 2^k [C 0] + N with C, N in [-3, 3], 2 <= k <= 16: nearly of the rank of C. b = J (e - J' f0) with e
// in [-1, 1] or e = 0: the acceleration at f0 is J e, small beside b, or zero.
//
// Bounds: abs(J) <= 3 * 2^k + 3 <= 2^(k + 2), abs(A) <= 2^(2k + 8) <= 2^40, abs(J' f0) <= 16 * 2^(k + 2) *
// 2^8 = 2^(k + 14), abs(b) <= 16 * 2^(k + 2) * (2^(k + 14) + 1) <= 2^52 + 2^22.
template <class Scalar, int Rows>
int FillNearDegenerate(const std::array<MuChoice, kMaxContacts>& mu, Choices& choices,
                       ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int columns = static_cast<int>(choices.Integer(1, rows));
  const int coarse_columns = static_cast<int>(choices.Integer(1, columns));
  const int scale = 1 << choices.Integer(2, 16);
  std::array<int, kMaxRows * kMaxRows> coarse;
  choices.ForEach<-3, 3>(rows * coarse_columns, [&coarse](int i, int value) { coarse[i] = value; });
  std::fill(coarse.begin() + rows * coarse_columns, coarse.begin() + rows * columns, 0);
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<-3, 3>(rows * columns, [entries, &coarse, scale](int i, int value) {
    entries[i] = Scalar(scale * coarse[i] + value);
  });
  const std::array<int, kMaxRows> f0 = DrawBoundaryForces(rows / 2, mu, choices);
  std::array<int, kMaxRows> e{};
  if (choices.Integer(0, 3) != 0) {
    choices.ForEach<-1, 1>(columns, [&e](int i, int value) { e[i] = value; });
  }
  SetGram(J, columns, problem);
  const auto y = [&](int k) {
    Scalar sum = Scalar(e[k]);
    for (int i = 0; i < rows; ++i) sum -= J(i, k) * Scalar(f0[i]);
    return sum;
  };
  SetImage(J, columns, y, problem);
  return columns;
}

}  // namespace

Generator MakeNearDegenerate() {
  static constexpr GeneratorRow kRow = {
      .name = "near-degenerate",
      .distribution =
          "J = 2^k [C 0] + N with integers in [-3, 3] and k in 2..16, so that its rows are "
          "nearly dependent; A = J J', b = -A f0 + J e where every contact of f0 is open, at a "
          "friction limit or inside, and e is 0 (probability 1/4) or of integers in [-1, 1].",
      .exact_in_double = true,
      .most_mu_part = 64,  // forces are multiples of it, and must stay exact
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillNearDegenerate(given.mu, choices, problem);
  });
}

}  // namespace stiction::generators
