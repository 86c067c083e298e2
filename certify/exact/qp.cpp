// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/qp.h"

#include <fmt/format.h>

#include "certify/exact/linear_system.h"
#include "certify/exact/verify_solution.h"
#include "corpus/input_error.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

void RequireConvex(const ExactMatrix& A) {
  if (const auto place = FindAsymmetry(A)) {
    const auto [i, j] = *place;
    throw InputError(fmt::format("A[{}][{}], A[{}][{}]: found {}, {}, expected a symmetric A for equation (5)",
                                 i, j, j, i, ToString(A(i, j)), ToString(A(j, i))));
  }
  const auto decision = DecideSemidefinite(A);
  const auto* curvature = std::get_if<Obstacle>(&decision);
  if (curvature == nullptr) return;
  std::string contacts;
  for (int i = 0; i < A.rows(); ++i) {
    if (curvature->x[i] != 0) contacts += (contacts.empty() ? "" : ", ") + std::to_string(i);
  }
  throw InputError(fmt::format(
      "A: found x'Ax = {} for an x on contacts[{}], expected a positive semidefinite A for equation (5)",
      ToString(curvature->value), contacts));
}

template <class Values>
mpz_class Denominator(const Values& values) {
  mpz_class common = 1;
  for (const Rational& x : values.reshaped()) common = lcm(common, x.get_den());
  return common;
}

mpz_class Scaled(const Rational& x, const mpz_class& denominator) {
  return x.get_num() * (denominator / x.get_den());
}

bool IsRay(const ExactProblem& problem, const ExactVector& v) {
  for (const Rational& x : v) {
    if (x < 0) return false;
  }
  return ExactVector(problem.A * v).isZero(0) && problem.b.dot(v) < 0;
}

}  // namespace

void RequireFrictionless(const ExactProblem& problem) {
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (problem.contacts[i].kind == ContactKind::kFrictionless) continue;
    throw InputError(fmt::format("contacts[{}].kind: found {}, expected frictionless for equation (5)", i,
                                 Name(problem.contacts[i].kind)));
  }
}

// With integers M = p A and c = q b: f = (p / q) x, x where x'Mx / 2 + c'x is least.
Answer<Rational> SolveQp(const ExactProblem& problem) {
  RequireFrictionless(problem);
  RequireConvex(problem.A);
  const int rows = problem.rows();
  if (rows == 0) {
    Answer<Rational> nothing;
    nothing.outcome = Outcome::kSolved;
    return nothing;
  }
  const mpz_class p = Denominator(problem.A), q = Denominator(problem.b);
  std::vector<std::vector<mpz_class>> M;
  std::vector<mpz_class> c;
  for (int i = 0; i < rows; ++i) {
    c.push_back(Scaled(problem.b[i], q));
    std::vector<mpz_class>& row = M.emplace_back();
    for (int j = 0; j < rows; ++j) row.push_back(Scaled(problem.A(i, j), p));
  }
  Answer<Rational> run = Minimize(M, c);
  if (!run.Solved()) {
    STICTION_CHECK(IsRay(problem, run.ray), "the direction of an unbounded program shows it");
    return run;
  }
  Rational unit(p, q);
  unit.canonicalize();
  run.f *= unit;
  STICTION_CHECK(!FindViolation(problem, run.f), "the least value of the program is a solution");
  run.a = Accelerations(problem, run.f);
  return run;
}

}  // namespace stiction
