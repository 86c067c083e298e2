// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/extreme.h"

#include <string>

namespace stiction::fuzz {
namespace {

using Vector = ExactProblem::Vector;
using Matrix = ExactProblem::Matrix;

constexpr int kMostContacts = 4;
constexpr std::array kScales = {0,   0,  0,   0,   0,    8,   -8,   16,  -16,  30,  -30,  38,  -38,
                                -45, 60, -60, 100, -100, 150, -150, 200, -200, 250, -250, 300, -300};
constexpr std::array kSmallScales = {0, 0, 0, 1, -1, 2, -2, 4, -4, 8, -8, 16, -16};
constexpr std::array kNear = {0, 4, 8, 10, 12, 16};  // 0: equal; k: but for 1e-k

Rational PowerOfTen(int exponent) { return *ParseRational("1e" + std::to_string(exponent)); }

template <std::size_t Count>
Rational PickScale(Bytes& bytes, const std::array<int, Count>& exponents) {
  return PowerOfTen(bytes.Pick(exponents));
}

// ---- Contacts ----------------------------------------------------------------------------------

std::array<Rational, 2> PickSlip(Bytes& bytes, int dimension) {
  constexpr std::array<std::array<int, 3>, 6> kUnits = {
      {{1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {3, 4, 5}, {-5, 12, 13}, {8, -15, 17}}};
  const auto& [x, y, length] = bytes.Pick(kUnits);
  if (dimension == 2) return {Rational(x < 0 ? -1 : 1), Rational(0)};
  return {Rational(x, length), Rational(y, length)};
}

// Statements of their own: in one, compilers choose which byte comes first.
Rational PickFriction(Bytes& bytes) {
  const int numerator = (bytes.Integer(0, 9) + 1) % 10;
  const int denominator = bytes.Integer(1, 4);
  return Rational(numerator) / denominator * PickScale(bytes, kSmallScales);
}

std::vector<Contact<Rational>> SomeContacts(Bytes& bytes, int dimension) {
  using enum ContactKind;
  constexpr std::array kKinds = {kStatic, kStatic, kStatic, kFrictionless, kBilateral, kSliding};
  std::vector<Contact<Rational>> contacts;
  const int count = (bytes.Integer(0, kMostContacts) + 1) % (kMostContacts + 1);  // one for a zero byte
  for (int i = 0; i < count; ++i) {
    Contact<Rational>& contact = contacts.emplace_back();
    contact.kind = bytes.Pick(kKinds);
    if (contact.HasFrictionRows()) contact.mu = PickFriction(bytes);
    if (contact.kind == kSliding) contact.slip = PickSlip(bytes, dimension);
  }
  return contacts;
}

int RowsOf(const Contact<Rational>& contact, int dimension) {
  return contact.HasFrictionRows() ? dimension : 1;
}

// ---- A and b -----------------------------------------------------------------------------------

Matrix SmallIntegers(Bytes& bytes, int rows, int columns) {
  Matrix J(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) J(i, j) = bytes.Integer(-3, 3) + (i == j ? 1 : 0);
  }
  return J;
}

// Some contacts get the rows of the first, or almost.
void Repeat(Bytes& bytes, const ExactProblem& problem, Matrix& J) {
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const int rows = RowsOf(contact, problem.dimension);
    const bool repeats = bytes.Integer(0, 3) == 1;
    for (int k = 0; repeats && k < rows && k < row; ++k) {
      J.row(row + k) = J.row(k) * Rational(bytes.Integer(0, 7) == 1 ? -2 : 1);
      const int digits = bytes.Pick(kNear);
      if (digits > 0) J(row + k, 0) += PowerOfTen(-digits);
    }
    row += rows;
  }
}

Vector Masses(Bytes& bytes, int columns) {
  Vector W(columns);
  for (int j = 0; j < columns; ++j) {
    const int mass = bytes.Integer(1, 9);
    W[j] = PickScale(bytes, kScales) / mass;
  }
  return W;
}

// What the paper excludes.
void BreakAssumptions(Bytes& bytes, ExactProblem& problem) {
  const int rows = problem.rows();
  const int how = bytes.Integer(0, 15);
  const Rational size = PowerOfTen(-bytes.Pick(kNear));
  if (rows == 0) return;
  const int i = bytes.Integer(0, rows - 1), j = bytes.Integer(0, rows - 1);
  if (how == 1 || how == 2) problem.b[i] += size;  // off the range
  if (how == 3) problem.A(i, i) -= size;           // indefinite
  if (how == 4) problem.A(i, j) += size;           // asymmetric
  if (how == 5) problem.A = -problem.A;
  if (how == 6) problem.A = Matrix::Constant(rows, rows, Rational(0));
}

// ---- Scales ------------------------------------------------------------------------------------

// f = s f' row by row: the same problem in other units, but for mu.
void Stretch(Bytes& bytes, ExactProblem& problem) {
  if (bytes.Integer(0, 3) != 1) return;
  for (int i = 0; i < problem.rows(); ++i) {
    const Rational s = PickScale(bytes, kSmallScales);
    problem.A.row(i) *= s;
    problem.A.col(i) *= s;
    problem.b[i] *= s;
  }
}

void Scale(Bytes& bytes, ExactProblem& problem) {
  const Rational A = PickScale(bytes, kScales), b = PickScale(bytes, kScales);
  problem.A *= A;
  problem.b *= b;
}

// Single numbers at the ends of the ranges of doubles and floats.
void Scatter(Bytes& bytes, ExactProblem& problem) {
  constexpr std::array kSpecial = {
      "0",    "5e-324", "-3e-320", "2.2250738585072014e-308", "1.7976931348623157e308", "1e-45", "3.4e38",
      "1e16", "-1",     "1/3"};
  const int rows = problem.rows();
  for (int count = bytes.Integer(0, 3); rows > 0 && count > 0; --count) {
    const int i = bytes.Integer(0, rows - 1), j = bytes.Integer(0, rows);
    const Rational x = *ParseRational(bytes.Pick(kSpecial));
    if (j == rows) {
      problem.b[i] = x;
    } else {
      problem.A(i, j) = problem.A(j, i) = x;
    }
  }
}

}  // namespace

ExactProblem ExtremeProblem(Bytes& bytes) {
  ExactProblem problem;
  problem.dimension = 2 + bytes.Integer(0, 1);
  problem.contacts = SomeContacts(bytes, problem.dimension);
  const int rows = RowCount(problem.contacts, problem.dimension), columns = rows + bytes.Integer(-2, 2);
  Matrix J = SmallIntegers(bytes, rows, std::max(columns, 1));
  Repeat(bytes, problem, J);
  problem.A = J * Masses(bytes, static_cast<int>(J.cols())).asDiagonal() * J.transpose();
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) problem.b[i] = 0;
  for (int j = 0; j < J.cols(); ++j) problem.b += J.col(j) * Rational(bytes.Integer(-9, 9));
  BreakAssumptions(bytes, problem);
  Stretch(bytes, problem);
  Scale(bytes, problem);
  Scatter(bytes, problem);
  return problem;
}

}  // namespace stiction::fuzz
