// SPDX-License-Identifier: Apache-2.0
#include "search/generators/exponential.h"

#include <algorithm>
#include <array>
#include <utility>

#include "search/generators/drawing.h"
#include "search/generators/generator.h"

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

// ---- The generator ------------------------------------------------------------------------------

namespace stiction::generators {
namespace {

// y with L' y = (8^-n - 1, ..., 8^-1 - 1), in units of 8^-n: abs(y) <= 3 * 2^24. With the sums S_i = y_i +
// ... + y_n, row i reads y_i + 2 S_(i+1), so S_i = b_i - S_(i+1): between -1 and 0.
std::array<std::int64_t, kMaxContacts> ExponentialCoefficients(int contacts) {
  std::array<std::int64_t, kMaxContacts> y{};
  std::int64_t sum = 0;
  for (int i = contacts - 1; i >= 0; --i) {
    const std::int64_t b = (std::int64_t{1} << (3 * i)) - (std::int64_t{1} << (3 * contacts));
    y[i] = b - 2 * sum;
    sum = b - sum;
  }
  return y;
}

// Places of the contacts: as they come, or, with probability 1/2, in random order.
std::array<int, kMaxContacts> DrawPlaces(int contacts, Choices& choices) {
  std::array<int, kMaxContacts> places;
  for (int i = 0; i < contacts; ++i) places[i] = i;
  if (choices.Integer(0, 1) == 0) return places;
  for (int i = 0; i + 1 < contacts; ++i) std::swap(places[i], places[i + choices.Integer(0, contacts - 1 - i)]);
  return places;
}

// 0 with probability 1/2, otherwise 2^-k with k uniform.
double DrawSmall(int least, int most, Choices& choices) {
  if (choices.Integer(0, 1) == 0) return 0;
  return 1.0 / static_cast<double>(std::int64_t{1} << choices.Integer(least, most));
}

// Columns 0 to n - 1 belong to the normals, column n + i to the friction of contact i of the family.
//
// Bounds, without the factors 4^(n-i), which are powers of two of whole rows: J in units of 2^-20, abs(J) <=
// 2^21 + 1, so that abs(A) <= 9 (2^21 + 1)^2 < 2^46; y in units of 8^-n >= 2^-24, abs(J y) <= 8 (2^21 + 1) 3
// 2^24 + 2^44 < 2^50. The moves of J are less than 1/2 beside its inverse, so that the normals stay
// independent.
template <class Scalar, int Rows>
int FillExponential(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows(), contacts = rows / 2;
  const bool scaled = choices.Integer(0, 1) == 1;
  const std::array<int, kMaxContacts> place = DrawPlaces(contacts, choices);
  const double move = DrawSmall(8, 20, choices);
  const double coupling = DrawSmall(0, 8, choices);
  const int missing = choices.Integer(0, 1) == 0 ? 0 : static_cast<int>(choices.Integer(0, contacts));
  std::array<int, kMaxRows * kMaxContacts> moves{};
  if (move > 0 || coupling > 0)
    choices.ForEach<-1, 1>(rows * contacts, [&moves](int i, int value) { moves[i] = value; });
  auto J = MakeJacobian<Scalar, Rows>(rows, rows);
  for (int i = 0; i < contacts; ++i) {
    const int normal = 2 * place[i];
    const double scale = scaled ? static_cast<double>(std::int64_t{1} << (2 * (contacts - 1 - i))) : 1.0;
    for (int k = 0; k < contacts; ++k) {
      const double entry = k < i ? 0 : k == i ? 1 : 2;
      J(normal, k) = Scalar(scale * (entry + move * moves[rows * k + 2 * i]));
      J(normal + 1, k) = Scalar(scale * coupling * moves[rows * k + 2 * i + 1]);
      J(normal, contacts + k) = Scalar(0);
      J(normal + 1, contacts + k) = Scalar(k == i && i >= missing ? scale : 0.0);
    }
  }
  SetGram(J, rows, problem);
  const std::array<std::int64_t, kMaxContacts> of_normals = ExponentialCoefficients(contacts);
  const double unit = static_cast<double>(std::int64_t{1} << (3 * contacts));
  std::array<int, kMaxRows> of_friction;
  choices.ForEach<-4, 4>(contacts, [&of_friction](int i, int value) { of_friction[i] = value; });
  const auto y = [&](int k) {
    return Scalar(k < contacts ? static_cast<double>(of_normals[k]) / unit : 0.25 * of_friction[k - contacts]);
  };
  SetImage(J, rows, y, problem);
  return rows - missing;  // columns of friction that are zero
}

}  // namespace

Generator MakeExponential() {
  static constexpr GeneratorRow kRow = {
      .name = "exponential",
      .distribution =
          "The normals are the family on which n contacts without friction take 2^n - 1 pivots: "
          "J = L', ones on the diagonal and 2 above, b = (8^(i-n-1) - 1). Every friction row has "
          "a column of its own, or, with probability 1/2, a number of them uniform in 0..n have "
          "none; b of it is J y, y of multiples of 1/4 in [-1, 1]. With probability 1/2 each: "
          "the rows of contact i times 4^(n-i); contacts in random order; entries of J moved by "
          "multiples of 2^-k in [-2^-k, 2^-k], k in 8..20; friction coupled to the normals' "
          "columns by multiples of 2^-k in [-2^-k, 2^-k], k in 0..8. A = J J'.",
      .exact_in_double = true,
  };
  return GeneratorOf<kRow>(
      [](const Given&, Choices& choices, auto& problem) { return FillExponential(choices, problem); });
}

}  // namespace stiction::generators
