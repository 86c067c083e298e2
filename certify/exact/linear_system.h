// SPDX-License-Identifier: Apache-2.0
// Linear systems of equations and inequalities, and quadratic programs, over integers: solved exactly by CGAL's
// QP_solver over Gmpz.
//
// Nothing that comes out is to be believed: callers check points, combinations and rays against what they ask.

#ifndef STICTION_CERTIFY_EXACT_LINEAR_SYSTEM_H_
#define STICTION_CERTIFY_EXACT_LINEAR_SYSTEM_H_

#include <cstdint>
#include <variant>
#include <vector>

#include "corpus/rational.h"

namespace stiction {

enum class Relation { kFree, kZero, kAtLeastZero, kAtMostZero };

// Whether `value` stands in the relation to zero.
bool Holds(Relation relation, const Rational& value);

// Find x with x_j >= 0 where j is not free, and coefficients x + constant {=, >=, <=} 0 in every row.
struct LinearSystem {
  struct Row {
    std::vector<mpz_class> coefficients;
    mpz_class constant;
    Relation relation;
  };
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
struct RationalRow {
  std::vector<Rational> coefficients;
  Rational constant;
  Relation relation = Relation::kZero;
};
struct Multipliers {
  std::vector<Rational> values;  // as Combination
};
std::variant<Point, Multipliers> Solve(const std::vector<bool>& free, const std::vector<RationalRow>& rows);

// Minimize x'Mx / 2 + c'x over x >= 0. M: symmetric, positive semidefinite, by rows.
struct QuadraticProgram {
  std::vector<std::vector<mpz_class>> M;
  std::vector<mpz_class> c;
};

struct QuadraticEnd {
  bool bounded = true;
  Point x;  // where it is least; if unbounded, a direction x >= 0 with M x = 0 and c'x < 0
  std::int64_t iterations = 0;
};

// Bland's rule here too. Requires a variable.
QuadraticEnd Minimize(const QuadraticProgram& program);

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_LINEAR_SYSTEM_H_
