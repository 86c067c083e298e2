// SPDX-License-Identifier: Apache-2.0
// Problems for tests: with known behaviour, at random, and equivalent to each other.

#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certify/exact/exact.h"
#include "search/generators/exponential.h"
#include "search/generators/generators.h"
#include "solver/complete/polygon.h"
#include "solver/complete/polygon_errors.h"
#include "solver/problem/lenient.h"

namespace stiction::testing {

using ExactVector = ExactProblem::Vector;
using ExactMatrix = ExactProblem::Matrix;

// STICTION_TESTS: "all" in the first build of the matrix and at night, "short" in the others.
inline bool TestsAre(std::string_view asked) {
  const char* const tests = std::getenv("STICTION_TESTS");
  return tests != nullptr && tests == asked;
}
inline bool Short() { return TestsAre("short"); }
inline bool All() { return TestsAre("all"); }

// So many, or a quarter of them.
inline int Few(int count) { return Short() ? count / 4 : count; }

// The largest strict error of forces, of whatever scalar, at one theta: of Coulomb's law, of (21), (22), of the
// law on polygons.
template <class Problem, class Vector>
auto ErrorOf(const Problem& problem, const Vector& f, const Vector& a,
             FrictionLaw law = FrictionLaw::kCoulomb) {
  using Scalar = typename Vector::Scalar;
  ErrorMeter<Scalar> meter;
  return MeasureErrors(problem, law, f, a, meter, Scalar(Scalar(1) / Scalar(1024))).Largest();
}
template <class Problem, class Vector>
auto WeakErrorOf(const Problem& problem, const Vector& f, const Vector& a) {
  return ErrorOf(problem, f, a, FrictionLaw::kBaraff);
}
// The lenient one, of what a method takes for solved before the gate looks.
template <class Problem, class Vector>
auto LenientErrorOf(const Problem& problem, const Vector& f, const Vector& a) {
  return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, a).error;
}
template <class Problem, class Polygons, class Vector>
auto PolygonErrorOf(const Problem& problem, const Polygons& polygons, const Vector& f, const Vector& a) {
  using Scalar = typename Vector::Scalar;
  return PolygonErrors(problem, polygons, f, a, Scalar(1)).Largest();
}

// min h_k^2 / n_k^2
inline Rational InnerRadiusSquared(const FrictionPolygon<Rational>& polygon) {
  Rational least(1);
  for (int k = 0; k < polygon.sides(); ++k)
    least = std::min(least,
                     Rational(polygon.reach(k) * polygon.reach(k) / Dot(polygon.normal(k), polygon.normal(k))));
  return least;
}

inline Rational Number(const std::string& text) { return ParseRational(text).value(); }

inline ExactVector Vector(const std::vector<Rational>& values) {
  ExactVector vector(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) vector[i] = values[i];
  return vector;
}

inline ExactMatrix Matrix(const std::vector<std::vector<Rational>>& rows) {
  ExactMatrix matrix(rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) matrix.row(i) = Vector(rows[i]).transpose();
  return matrix;
}

// Static contacts, one per mu; a negative mu stands for a frictionless contact.
inline ExactProblem MakeProblem(const std::vector<Rational>& mu, const std::vector<std::vector<Rational>>& A,
                                const std::vector<Rational>& b) {
  ExactProblem problem;
  for (const Rational& x : mu) {
    const bool rough = x >= 0;
    problem.contacts.push_back({rough ? ContactKind::kStatic : ContactKind::kFrictionless, rough ? x : 0, {}});
  }
  problem.A = Matrix(A);
  problem.b = Vector(b);
  return problem;
}

// Cycles under most policies.
inline ExactProblem ReferenceProblem() {
  return MakeProblem({1, 1}, {{7, -2, -6, 0}, {-2, 9, -1, -7}, {-6, -1, 7, 3}, {0, -7, 3, 7}}, {2, -1, -2, 2});
}

// Positive definite, nondegenerate, with a give-up on the way to its solution.
inline ExactProblem GiveUpProblem() {
  return MakeProblem({1, 2}, {{4, 1, -5, 1}, {1, 3, 1, 1}, {-5, 1, 9, -1}, {1, 1, -1, 1}},
                     {Rational(1, 1000), 1, -1, -2});
}

// One contact with three isolated solutions, (0, 0), (3, -2), (1, -1).
inline ExactProblem ThreeSolutions() { return MakeProblem({1}, {{1, 2}, {2, 5}}, {1, 4}); }

// A positive semidefinite, b not in its range, no solution.
inline ExactProblem NoSolution() { return MakeProblem({1}, {{1, -1}, {-1, 1}}, {-1, 0}); }

// A sum of problems that do not feel each other.
inline ExactProblem Decoupled(const ExactProblem& left, const ExactProblem& right) {
  ExactProblem both = left;
  both.contacts.insert(both.contacts.end(), right.contacts.begin(), right.contacts.end());
  const int m = left.rows(), n = right.rows();
  both.A = ExactMatrix::Constant(m + n, m + n, Rational(0));
  both.b = ExactVector::Constant(m + n, Rational(0));
  both.A.topLeftCorner(m, m) = left.A;
  both.A.bottomRightCorner(n, n) = right.A;
  both.b.head(m) = left.b;
  both.b.tail(n) = right.b;
  return both;
}

inline ExactProblem NoContacts() { return MakeProblem({}, {}, {}); }

template <class Scalar, int Rows = Eigen::Dynamic>
ContactProblem<Scalar, Rows> Random(GeneratorId id, int contacts, std::uint64_t index) {
  Choices choices(ProblemSeed(1994, 2 * contacts, index));
  ContactProblem<Scalar, Rows> problem;
  Generate(id, contacts, kDefaultPalette, choices, problem);
  return problem;
}

// Bodies' worth of degrees of freedom, and contacts of every kind on them: A = J J', b = J c. With repeated
// bilateral rows, so that A_BB is singular.
inline ExactProblem RandomMixed(std::uint64_t seed, bool sliding) {
  Choices choices(seed);
  ExactProblem problem;
  const int contacts = static_cast<int>(choices.Integer(1, 5));
  for (int i = 0; i < contacts; ++i) {
    Contact<Rational> contact;
    const std::int64_t kind = choices.Integer(0, sliding ? 3 : 2);
    contact.kind = static_cast<ContactKind>(kind);
    if (contact.HasFrictionRows()) contact.mu = Rational(choices.Integer(0, 4)) / 2;
    if (contact.kind == ContactKind::kSliding) contact.slip[0] = choices.Integer(0, 1) == 0 ? 1 : -1;
    problem.contacts.push_back(contact);
  }
  const int rows = RowCount(problem.contacts, 2), columns = static_cast<int>(choices.Integer(2, 2 + rows));
  ExactMatrix J(rows, columns);
  ExactVector c(columns);
  for (int j = 0; j < columns; ++j) {
    c[j] = choices.Integer(-9, 9);
    for (int i = 0; i < rows; ++i) J(i, j) = choices.Integer(-3, 3);
  }
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  int first = -1;
  for (int i = 0; i < contacts; ++i) {
    if (problem.contacts[i].kind != ContactKind::kBilateral) continue;
    const int row = layout.NormalRowOf(i);
    if (first >= 0 && choices.Integer(0, 2) == 0) J.row(row) = J.row(first) * Rational(-2);
    if (first < 0) first = row;
  }
  problem.A = J * J.transpose();
  problem.b = J * c;
  return problem;
}

// The problem with a bilateral contact as its first and, in twice its units, as its last: what they leave of it
// is the problem itself (solver/problem/reduction.h).
inline ExactProblem Bordered(const ExactProblem& problem) {
  const int rows = problem.rows();
  const Rational d = 2, b = -3;
  ExactVector u(rows);
  for (int i = 0; i < rows; ++i) u[i] = i % 3 - 1;
  ExactProblem bordered = problem;
  const Contact<Rational> bilateral = {ContactKind::kBilateral, 0, {}};
  bordered.contacts.insert(bordered.contacts.begin(), bilateral);
  bordered.contacts.push_back(bilateral);
  bordered.A.resize(rows + 2, rows + 2);
  bordered.A << d, u.transpose(), 2 * d, u, problem.A + u * u.transpose() / d, 2 * u, 2 * d, 2 * u.transpose(),
      4 * d;
  bordered.b.resize(rows + 2);
  bordered.b << b, problem.b + u * b / d, 2 * b;
  return bordered;
}

// Random problems that cycle under `paper`.
struct CyclingSeed {
  GeneratorId id;
  int contacts;
  std::uint64_t index;
};
inline const std::vector<CyclingSeed>& CyclingSeeds() {
  using enum GeneratorId;
  static const std::vector<CyclingSeed> seeds = {
      {kIntegers, 2, 33448}, {kIntegers, 2, 94452}, {kIntegers, 2, 103791}, {kIntegers, 3, 4099},
      {kIntegers, 3, 29345}, {kPsd, 2, 15609},      {kPsd, 2, 41295},       {kPsd, 3, 16840},
  };
  return seeds;
}
inline ExactProblem Cycling(const CyclingSeed& seed) {
  return Random<Rational>(seed.id, seed.contacts, seed.index);
}

// A frictionless problem, positive definite; numbers so large that ties are improbable.
inline ExactProblem RandomFrictionless(int contacts, std::uint64_t seed) {
  Choices choices(seed);
  const int columns = contacts + 1;
  std::vector<std::vector<Rational>> J(contacts), A(contacts, std::vector<Rational>(contacts));
  std::vector<Rational> b;
  for (auto& row : J) {
    for (int k = 0; k < columns; ++k) row.push_back(choices.Integer(-1000, 1000));
    b.push_back(choices.Integer(-1000000, 300000));
  }
  for (int i = 0; i < contacts; ++i) {
    for (int j = 0; j < contacts; ++j) {
      A[i][j] = i == j ? 1 : 0;
      for (int k = 0; k < columns; ++k) A[i][j] += J[i][k] * J[j][k];
    }
  }
  return MakeProblem(std::vector<Rational>(contacts, -1), A, b);
}

// ---- Other number types ----------------------------------------------------------------------

template <class Scalar>
Scalar To(const Rational& x) {
  if constexpr (kIsExact<Scalar>) {
    return x;
  } else {
    return static_cast<Scalar>(ToDouble(x));
  }
}

template <class Scalar, int Rows = Eigen::Dynamic>
ContactProblem<Scalar, Rows> As(const ExactProblem& problem) {
  ContactProblem<Scalar, Rows> other;
  other.dimension = problem.dimension;
  if constexpr (Rows == Eigen::Dynamic) {
    other.contacts.resize(problem.contacts.size());
    other.A.resize(problem.rows(), problem.rows());
    other.b.resize(problem.rows());
  }
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    other.contacts[i].kind = problem.contacts[i].kind;
    other.contacts[i].mu = To<Scalar>(problem.contacts[i].mu);
  }
  for (int i = 0; i < problem.rows(); ++i) {
    other.b[i] = To<Scalar>(problem.b[i]);
    for (int j = 0; j < problem.rows(); ++j) other.A(i, j) = To<Scalar>(problem.A(i, j));
  }
  return other;
}

// ---- Equivalent problems ---------------------------------------------------------------------

inline RowLayout<Eigen::Dynamic> LayoutOf(const ExactProblem& problem) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  return layout;
}

// f = s f' with a sign or unit for every row: A' = S A S, b' = S b, mu' = mu abs(s_N / s_F).
inline ExactProblem InUnits(const ExactProblem& problem, const std::vector<Rational>& s) {
  ExactProblem other = problem;
  for (int i = 0; i < problem.rows(); ++i) {
    other.b[i] *= s[i];
    for (int j = 0; j < problem.rows(); ++j) other.A(i, j) *= s[i] * s[j];
  }
  const auto layout = LayoutOf(problem);
  for (int contact = 0; contact < layout.ContactCount(); ++contact) {
    const int row = layout.NormalRowOf(contact);
    if (layout.HasFriction(row)) other.contacts[contact].mu *= abs(Rational(s[row] / s[row + 1]));
  }
  return other;
}

// Contacts in the order of `order`; `rows` lists the old row of each new one.
inline ExactProblem Permuted(const ExactProblem& problem, const std::vector<int>& order,
                             std::vector<int>* rows = nullptr) {
  const auto layout = LayoutOf(problem);
  ExactProblem other = problem;
  std::vector<int> old;
  for (std::size_t k = 0; k < order.size(); ++k) {
    other.contacts[k] = problem.contacts[order[k]];
    const int row = layout.NormalRowOf(order[k]);
    old.push_back(row);
    if (layout.HasFriction(row)) old.push_back(row + 1);
  }
  for (int i = 0; i < problem.rows(); ++i) {
    other.b[i] = problem.b[old[i]];
    for (int j = 0; j < problem.rows(); ++j) other.A(i, j) = problem.A(old[i], old[j]);
  }
  if (rows != nullptr) *rows = old;
  return other;
}

inline ExactProblem Reversed(const ExactProblem& problem, std::vector<int>* rows = nullptr) {
  std::vector<int> order;
  for (int i = static_cast<int>(problem.contacts.size()) - 1; i >= 0; --i) order.push_back(i);
  return Permuted(problem, order, rows);
}

// A policy of the planar grid, every one as likely.
inline Policy RandomPolicy(Choices& choices) {
  return PlanarGrid()[choices.Integer(0, static_cast<std::int64_t>(PlanarGrid().size()) - 1)];
}

}  // namespace stiction::testing
