// SPDX-License-Identifier: Apache-2.0
// game: a game of two players as static friction. With friction forces divided by mu, and friction rows times
// mu, let
//
//   P_ii = 1, P_ij = e max(M_ij, M_ji),  Q_ij = e M_ij - P_ij,  A = [P Q; Q' R],  R_ii = 2 + mu_i^2,
//   bN = -e,  bF_i = -(4 + mu_i^2)
//
// for costs 1 <= M_ij <= 2. Every contact slips, and the forces are fN = fF = x with x >= 0, M x >= 1,
// x.(M x - 1) = 0: divided by their sum, the symmetric equilibria. (From fN.aN = 0 and abs(fF) <= fN follows
// e fN.M fN <= e 1.fN, so 1.fN <= 1 and aF < 0; then aN = e (M fN - 1).)

#include <algorithm>
#include <array>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

enum GameKind { kAnyGame, kSymmetric, kCoordination, kNearRockPaperScissors, kGameKinds };

// In eighths, of what was drawn: 0 to 8 for each pair.
int Cost(GameKind kind, int n, int i, int j, const std::array<int, kMaxContacts * kMaxContacts>& drawn) {
  const int own = drawn[n * i + j], shared = drawn[n * std::min(i, j) + std::max(i, j)];
  if (kind == kSymmetric) return 8 + shared;
  if (kind == kCoordination) return i == j ? 8 + shared / 4 : 16 - shared / 4;
  if (kind == kAnyGame) return 8 + own;
  return i == j ? 10 : (j + 1) % n == i ? 8 : (i + 1) % n == j ? 16 : 8 + own;
}

template <class Scalar, int Rows>
int FillGame(const Given& given, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int n = problem.rows() / 2;
  const auto kind = static_cast<GameKind>(choices.Integer(0, kGameKinds - 1));
  const auto e = Scalar(1.0 / static_cast<double>(1 << choices.Integer(7, 12)));
  std::array<int, kMaxContacts * kMaxContacts> drawn;
  choices.ForEach<0, 8>(n * n, [&drawn](int k, int value) { drawn[k] = value; });
  const auto cost = [&](int i, int j) { return Scalar(Cost(kind, n, i, j, drawn) / 8.0); };
  for (int i = 0; i < n; ++i) {
    // Friction that can do nothing has units of its own.
    const auto unit = [&](int k) { return given.mu[k].numerator == 0 ? Scalar(1) : problem.contacts[k].mu; };
    const Scalar square = unit(i) * unit(i);
    for (int j = 0; j < n; ++j) {
      const Scalar P = i == j ? Scalar(1) : Scalar(e * std::max(cost(i, j), cost(j, i)));
      problem.A(2 * i, 2 * j) = P;
      problem.A(2 * i, 2 * j + 1) = (e * cost(i, j) - P) / unit(j);
      problem.A(2 * j + 1, 2 * i) = problem.A(2 * i, 2 * j + 1);
      problem.A(2 * i + 1, 2 * j + 1) = i == j ? Scalar((2 + square) / square) : Scalar(0);
    }
    problem.b[2 * i] = -e;
    problem.b[2 * i + 1] = -(4 + square) / unit(i);
  }
  return 2 * n;
}

}  // namespace

Generator MakeGame() {
  static constexpr GeneratorRow kRow = {
      .name = "game",
      .distribution =
          "A game of two players with n strategies: its symmetric equilibria are the solutions, where every "
          "contact "
          "slips. Costs are multiples of 1/8 in [1, 2]: any; symmetric; of coordination, near 1 for the same "
          "strategy "
          "and near 2 for others; or those of rock, paper, scissors for neighbours in a ring and any for "
          "others. e = "
          "2^-k, k in 7..12. A is definite. Not part of a campaign that names no generators.",
  };
  return GeneratorOf<kRow>(
      [](const Given& given, Choices& choices, auto& problem) { return FillGame(given, choices, problem); });
}

}  // namespace stiction::generators
