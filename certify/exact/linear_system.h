// SPDX-License-Identifier: Apache-2.0
// Linear systems of equations and inequalities, and quadratic programs, over integers: solved exactly by CGAL's
// QP_solver over Gmpz.
//
// Nothing that comes out is to be believed: callers check points, combinations and rays against what they ask.

#pragma once

#include <variant>
#include <vector>

#include "corpus/rational.h"
#include "solver/problem/answer.h"

namespace stiction {

enum class Relation { kFree, kZero, kAtLeastZero, kAtMostZero };

// Whether `value` stands in the relation to zero.
bool Holds(Relation relation, const Rational& value);

// coefficients x + constant {=, >=, <=} 0
template <class Number>
struct LinearRow {
  std::vector<Number> coefficients;
  Number constant;
  Relation relation = Relation::kZero;
};

// Find x with x_j >= 0 where j is not free, and every row.
struct LinearSystem {
  using Row = LinearRow<mpz_class>;
  std::vector<bool> free;  // by variable
  std::vector<Row> rows;
};

using Point = std::vector<Rational>;  // x

// By row, >= 0 on rows >= 0, <= 0 on rows <= 0: combination'coefficients <= 0 (= 0 where x_j is free), and
// combination'constant < 0.
using Combination = std::vector<mpz_class>;

// A solution, or a combination that shows that there is none. Bland's rule, since degenerate systems are the
// usual case here and QP_solver's other rules may cycle. A free variable is the difference of two.
std::variant<Point, Combination> Solve(const LinearSystem& system);

// The same with rational coefficients: rows are scaled to integers, and the combination is of the rows as they
// are.
using RationalRow = LinearRow<Rational>;
struct Multipliers {
  std::vector<Rational> values;  // as Combination
};
std::variant<Point, Multipliers> Solve(const std::vector<bool>& free, const std::vector<RationalRow>& rows);

// Minimize f'Mf / 2 + c'f over f >= 0: solved, or ray, which is >= 0 with M ray = 0 and c'ray < 0. Counter:
// iterations. Bland's rule here too. Requires M symmetric and positive semidefinite, a row at least.
Answer<Rational> Minimize(const std::vector<std::vector<mpz_class>>& M, const std::vector<mpz_class>& c);

}  // namespace stiction
