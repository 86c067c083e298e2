// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/linear_system.h"

#include <CGAL/Gmpz.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <boost/iterator/transform_iterator.hpp>

#include "corpus/stop.h"
#include "solver/problem/check.h"

namespace stiction {

bool Holds(Relation relation, const Rational& value) {
  switch (relation) {
    case Relation::kFree:
      return true;
    case Relation::kZero:
      return value == 0;
    case Relation::kAtLeastZero:
      return value >= 0;
    case Relation::kAtMostZero:
      return value <= 0;
  }
  return false;
}

namespace {

mpz_class FromCgal(const CGAL::Gmpz& x) { return mpz_class(x.mpz()); }

Rational FromCgal(const CGAL::Quotient<CGAL::Gmpz>& x) {
  Rational number(FromCgal(x.numerator()), FromCgal(x.denominator()));
  number.canonicalize();
  return number;
}

// Columns of a program, which every pivot of QP_solver reads: there it stops (corpus/stop.h).
template <class Column>
auto Stopping(Column column) {
  return boost::make_transform_iterator(column, [](const auto& values) {
    Stop::Check();
    return values;
  });
}

CGAL::Quadratic_program_options BlandsRule() {
  CGAL::Quadratic_program_options options;
  options.set_pricing_strategy(CGAL::QP_BLAND);
  return options;
}

CGAL::Comparison_result ToCgal(Relation relation) {
  if (relation == Relation::kZero) return CGAL::EQUAL;
  return relation == Relation::kAtLeastZero ? CGAL::LARGER : CGAL::SMALLER;
}

// Without variables QP_solver is not asked: a row decides by itself.
std::variant<Point, Combination> SolveWithoutVariables(const LinearSystem& system) {
  for (std::size_t i = 0; i < system.rows.size(); ++i) {
    if (Holds(system.rows[i].relation, system.rows[i].constant)) continue;
    Combination combination(system.rows.size());
    combination[i] = -sgn(system.rows[i].constant);
    return combination;
  }
  return Point();
}

// `scale`: by which the row is multiplied, > 0.
LinearSystem::Row IntegerRow(const RationalRow& rational, mpz_class& scale) {
  scale = rational.constant.get_den();
  for (const Rational& x : rational.coefficients) scale = lcm(scale, x.get_den());
  const auto scaled = [&scale](const Rational& x) { return mpz_class(x.get_num() * (scale / x.get_den())); };
  LinearSystem::Row row{{}, scaled(rational.constant), rational.relation};
  for (const Rational& x : rational.coefficients) row.coefficients.push_back(scaled(x));
  return row;
}

}  // namespace

std::variant<Point, Combination> Solve(const LinearSystem& system) {
  const int variables = static_cast<int>(system.free.size()), rows = static_cast<int>(system.rows.size());
  if (variables == 0) return SolveWithoutVariables(system);
  CGAL::Quadratic_program<CGAL::Gmpz> program(CGAL::SMALLER, true, 0, false, 0);
  for (int i = 0; i < rows; ++i) {
    const LinearSystem::Row& row = system.rows[i];
    program.set_r(i, ToCgal(row.relation));
    program.set_b(i, -CGAL::Gmpz(row.constant.get_mpz_t()));
    for (int j = 0, column = 0; j < variables; ++j) {
      const CGAL::Gmpz coefficient(row.coefficients[j].get_mpz_t());
      program.set_a(column++, i, coefficient);
      if (system.free[j]) program.set_a(column++, i, -coefficient);
    }
  }
  const auto stopping = CGAL::make_nonnegative_linear_program_from_iterators(
      program.get_n(), program.get_m(), Stopping(program.get_a()), program.get_b(), program.get_r(),
      program.get_c());
  const auto solution = CGAL::solve_nonnegative_linear_program(stopping, CGAL::Gmpz(), BlandsRule());
  if (solution.is_infeasible()) {
    Combination combination;
    auto lambda = solution.infeasibility_certificate_begin();
    for (int i = 0; i < rows; ++i, ++lambda) combination.push_back(-FromCgal(*lambda));
    return combination;
  }
  STICTION_CHECK(solution.is_optimal(), "a feasibility program is either infeasible or solved");
  Point x;
  auto value = solution.variable_values_begin();
  for (int j = 0; j < variables; ++j) {
    x.push_back(FromCgal(*value++));
    if (system.free[j]) x.back() -= FromCgal(*value++);
  }
  return x;
}

std::variant<Point, Multipliers> Solve(const std::vector<bool>& free, const std::vector<RationalRow>& rows) {
  LinearSystem system{free, {}};
  std::vector<mpz_class> scales(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) system.rows.push_back(IntegerRow(rows[i], scales[i]));
  auto answer = Solve(system);
  if (Point* x = std::get_if<Point>(&answer)) return std::move(*x);
  const Combination& combination = std::get<Combination>(answer);
  Multipliers multipliers;
  for (std::size_t i = 0; i < rows.size(); ++i) multipliers.values.emplace_back(combination[i] * scales[i]);
  return multipliers;
}

// QP_solver is given twice the matrix of x'Dx, below its diagonal: that is M.
Answer<Rational> Minimize(const std::vector<std::vector<mpz_class>>& M, const std::vector<mpz_class>& c) {
  const int variables = static_cast<int>(c.size());
  CGAL::Quadratic_program<CGAL::Gmpz> program(CGAL::SMALLER, true, 0, false, 0);
  for (int i = 0; i < variables; ++i) {
    program.set_c(i, CGAL::Gmpz(c[i].get_mpz_t()));
    for (int j = 0; j <= i; ++j) program.set_d(i, j, CGAL::Gmpz(M[i][j].get_mpz_t()));
  }
  const auto stopping = CGAL::make_nonnegative_quadratic_program_from_iterators(
      program.get_n(), program.get_m(), program.get_a(), program.get_b(), program.get_r(),
      Stopping(program.get_d()), program.get_c());
  const auto solution = CGAL::solve_nonnegative_quadratic_program(stopping, CGAL::Gmpz(), BlandsRule());
  Answer<Rational> answer;
  answer.counters = {{Counter::kIterations, solution.number_of_iterations()}};
  if (solution.is_optimal()) {
    answer.outcome = Outcome::kSolved;
    answer.f.resize(variables);
    auto value = solution.variable_values_begin();
    for (Rational& x : answer.f) x = FromCgal(*value++);
  } else {
    STICTION_CHECK(solution.is_unbounded(), "f >= 0 is never infeasible");
    answer.outcome = Outcome::kRay;
    answer.ray.resize(variables);
    auto value = solution.unboundedness_certificate_begin();
    for (Rational& x : answer.ray) x = Rational(FromCgal(*value++));
  }
  return answer;
}

}  // namespace stiction
