// SPDX-License-Identifier: Apache-2.0
// exceptional: contacts that jam, loaded where sticking would need forces without bound.
//
// Contact i has friction mu = p / q, a direction d of integers, abs(d) = 5, and d' across it. A force of
// (5 q s, p s d) is on the boundary of its cone, and u = mu fN - d.fF / 5 tells how far from it along d.
//
//   kernel     A v = 0 for one to three v in the cone. Each has contacts of its own, the first of them on the
//              boundary, others there or inside.
//   critical   b = -A x, where x of some contacts on the boundary is s (5 q, p d) + w (0, p d'): u = 0, w /= 0.
//   So
//              x + r v never is in the cone, and tends to it: sticking is a limit that no forces reach.
//   beside     u = +-p 2^-k instead: r of about 2^k reaches it, or none.
//
// There is a solution all the same, with forces that stay bounded (certify/existence.md): others than x slip.
//
// Bounds, for p, q <= 16: abs(v) <= 160, abs(J) <= 2 * 3 * 160 < 2^10, abs(x) <= 320, before it is scaled by
// 2^k, k <= 14. abs(A) <= 32 * 2^20, abs(J'x) <= 24 * 2^10 * 2^9 * 2^14 < 2^38, abs(b) <= 32 * 2^10 * 2^38 =
// 2^53.

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

constexpr int kNone = -1;
constexpr int kMostKernel = 3;
constexpr int kLength = 5;
constexpr std::array<std::array<int, 2>, 12> kDirections = {
    {{3, 4}, {4, 3}, {-3, 4}, {-4, 3}, {3, -4}, {4, -3}, {-3, -4}, {-4, -3}, {5, 0}, {0, 5}, {-5, 0}, {0, -5}}};
using Rows3 = std::array<int, 3 * kMaxContacts>;

// What is decided before A and b are made.
struct Jam {
  int kernel = 1;                         // how many v
  std::array<int, kMaxContacts> of = {};  // the v that a contact has a part in, or kNone
  Rows3 v = {}, x = {};
  std::array<int, kMaxContacts> apart = {};  // the acceleration of a contact that separates, or 0
  int scale = 1;                             // of x: 2^k
};

void SetForce(int contact, int normal, int along_1, int along_2, Rows3& force) {
  force[3 * contact] = normal;
  force[3 * contact + 1] = along_1;
  force[3 * contact + 2] = along_2;
}

int DrawIn(int low, int high, Choices& choices) { return static_cast<int>(choices.Integer(low, high)); }

// The part of a contact in v and x. `first`: it is on the boundary, and critical.
void DrawPart(int contact, const MuChoice& mu, bool first, int beside, Choices& choices, Jam& jam) {
  const int p = mu.numerator, q = kLength * mu.denominator;
  const std::array<int, 2> d = kDirections[DrawIn(0, 11, choices)];
  const bool in_kernel = jam.of[contact] != kNone;
  const bool on_boundary = in_kernel && (first || choices.Integer(0, 3) != 0);
  if (on_boundary) {
    const int s = DrawIn(1, 2, choices);
    SetForce(contact, q * s, p * s * d[0], p * s * d[1], jam.v);
  } else if (in_kernel) {
    const int along = DrawIn(-2, 2, choices), across = DrawIn(-2, 2, choices);
    SetForce(contact, q, p * along, p * across, jam.v);
  }
  if (on_boundary && (first || choices.Integer(0, 1) == 1)) {
    const int s = DrawIn(-2, 2, choices), size = DrawIn(1, 2, choices);
    const int w = choices.Integer(0, 1) == 0 ? size : -size;
    SetForce(contact, jam.scale * q * s + beside * mu.denominator, jam.scale * p * (s * d[0] - w * d[1]),
             jam.scale * p * (s * d[1] + w * d[0]), jam.x);
  } else if (!in_kernel && choices.Integer(0, 1) == 1) {
    jam.apart[contact] = DrawIn(1, 3, choices);
  } else {  // it sticks
    const int s = DrawIn(1, 2, choices), along = DrawIn(-3, 3, choices), across = DrawIn(-3, 3, choices);
    SetForce(contact, jam.scale * q * s, jam.scale * p * along, jam.scale * p * across, jam.x);
  }
}

Jam DrawJam(int contacts, const std::array<MuChoice, kMaxContacts>& mu, Choices& choices) {
  Jam jam;
  jam.kernel = DrawIn(1, std::min(kMostKernel, contacts), choices);
  const int beside = DrawIn(-1, 1, choices);
  if (beside != 0) jam.scale = 1 << choices.Integer(1, 14);
  for (int i = 0; i < contacts; ++i) {
    const bool first = i < jam.kernel;
    const int of = first ? i : DrawIn(0, jam.kernel, choices);
    jam.of[i] = of == jam.kernel ? kNone : of;
    DrawPart(i, mu[i], first, beside, choices, jam);
  }
  return jam;
}

// The next row of the same v in which it is not zero; kNone if there is none.
int NextRow(const Jam& jam, int rows, int row) {
  for (int next = row + 1; next < rows; ++next) {
    if (jam.v[next] != 0 && jam.of[next / 3] == jam.of[row / 3]) return next;
  }
  return kNone;
}

// Columns orthogonal to every v: of each row where v is zero, and of each two neighbours where it is not.
template <class Scalar>
void AddOrthogonal(const Jam& jam, int column, std::span<const int> coefficients,
                   Jacobian<Scalar, Eigen::Dynamic>& J) {
  const int rows = static_cast<int>(J.rows());
  for (int row = 0; row < rows; ++row) {
    const int next = NextRow(jam, rows, row);
    if (jam.v[row] == 0) {
      J(row, column) += Scalar(coefficients[row]);
    } else if (next != kNone) {
      const int divisor = std::gcd(jam.v[row], jam.v[next]);
      J(row, column) += Scalar(coefficients[row] * (jam.v[next] / divisor));
      J(next, column) -= Scalar(coefficients[row] * (jam.v[row] / divisor));
    }
  }
}

template <class Scalar>
int FillExceptional(const std::array<MuChoice, kMaxContacts>& mu, Choices& choices,
                    ContactProblem<Scalar>& problem) {
  const int rows = problem.rows(), contacts = rows / 3;
  const Jam jam = DrawJam(contacts, mu, choices);
  const int mixed = DrawIn(1, rows - jam.kernel, choices);
  auto J = MakeJacobian<Scalar, Eigen::Dynamic>(rows, mixed + contacts);
  for (int k = 0; k < mixed + contacts; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = Scalar(0);
  }
  Rows3 coefficients;
  for (int k = 0; k < mixed; ++k) {
    choices.ForEach<-3, 3>(rows, [&coefficients](int i, int value) { coefficients[i] = value; });
    AddOrthogonal(jam, k, coefficients, J);
  }
  int columns = mixed;
  std::array<int, kMaxContacts> acceleration = {};
  for (int i = 0; i < contacts; ++i) {
    if (jam.apart[i] == 0) continue;
    acceleration[columns - mixed] = jam.apart[i];
    J(3 * i, columns++) = Scalar(1);
  }
  SetGram<Scalar, Eigen::Dynamic>(J, columns, problem);
  const auto y = [&](int k) {
    Scalar sum = Scalar(0);
    for (int i = 0; i < rows; ++i) sum -= J(i, k) * Scalar(jam.x[i]);
    sum /= Scalar(jam.scale);
    if (k >= mixed) sum += Scalar(acceleration[k - mixed]);
    return sum;
  };
  SetImage(J, columns, y, problem);
  return std::min(columns, rows - jam.kernel);
}

}  // namespace

Generator MakeExceptional() {
  static constexpr GeneratorRow kRow = {
      .name = "exceptional",
      .distribution =
          "Contacts of space that jam: A v = 0 for 1 to 3 forces v in the cones of friction, on their boundary "
          "(one contact for certain) or inside. b = -A x, where sticking forces x + r v of one contact at "
          "least only tend to their cone as r grows, or are beside that by 2^-k, k in 1..14, with probability "
          "2/3; other contacts stick or separate. J of integers, orthogonal to v, its number of columns "
          "uniform in 1..3n-1 or less; A = J J'. There is always a solution. Not part of a campaign that names "
          "no generators.",
      .exact_in_double = true,
      .dimension = 3,
      .most_mu_part = 16,  // numbers are multiples of it, and must stay exact
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillExceptional(given.mu, choices, problem);
  });
}

}  // namespace stiction::generators
