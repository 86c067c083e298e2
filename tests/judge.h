// SPDX-License-Identifier: Apache-2.0
// A judge of solutions: forces that are called a solution are held against rationals, without a root and
// without a tolerance but the one that was promised.

#ifndef STICTION_TESTS_JUDGE_H_
#define STICTION_TESTS_JUDGE_H_

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "certify/solve.h"
#include "certify/space.h"
#include "certify/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/problem/residual.h"

namespace stiction::testing {

// What the arithmetic made of the problem.
inline ExactProblem AsRun(const ExactProblem& problem, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::kExact) return problem;
  if (arithmetic == Arithmetic::kFloat) return Unrounded(Rounded<float>(problem));
  return Unrounded(Rounded<double>(problem));
}

// Of a contact in space at its first row: whether no part of its weak residual (weak_residual.h) exceeds
// `most`.
inline bool IsWeaklyWithin(const Contact<Rational>& contact, const Rational* f, const Rational* a,
                           const Rational& r, const Rational& most) {
  const auto within = [&most](const Rational& x) { return abs(x) <= most; };
  if (contact.kind == ContactKind::kBilateral) return within(r * a[0]);
  if (!within(std::min<Rational>(f[0], r * a[0]))) return false;
  if (contact.kind == ContactKind::kFrictionless) return true;
  const Rational limit = contact.mu * f[0];
  if (contact.kind == ContactKind::kSliding) {
    const Rational x = f[1] + limit * contact.slip[0], y = f[2] + limit * contact.slip[1];
    return x * x + y * y <= most * most;
  }
  const Rational force = f[1] * f[1] + f[2] * f[2], answer = a[1] * a[1] + a[2] * a[2];  // squares
  const Rational along = f[1] * a[1] + f[2] * a[2], above = limit + most, below = limit - most;
  const bool in_cone = above >= 0 && force <= above * above;
  const bool at_limit = below <= 0 || force >= below * below;
  const bool opposes = along <= 0 || r * r * along * along <= most * most * force;
  return in_cone && (at_limit || r * r * answer <= most * most) && opposes;
}

// Whether the weak residual of forces is at most `bound`.
inline bool IsWeakSolution(const ExactProblem& problem, const ExactVector& f, const Rational& bound) {
  const ExactVector a = Accelerations(problem, f);
  const Residual<Rational> scale = MeasureScale(problem, f, a);
  const Rational most = scale.scale > 0 ? Rational(bound * scale.scale) : bound;
  int row = 0;
  for (const Contact<Rational>& contact : problem.contacts) {
    if (!IsWeaklyWithin(contact, &f[row], &a[row], scale.r, most)) return false;
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return true;
}

inline bool IsSolutionWithin(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                             const Rational& bound) {
  if (problem.dimension == 2) return NaturalResidual(problem, f, Accelerations(problem, f)) <= bound;
  if (law == FrictionLaw::kCoulomb) return CoulombResidualBound(problem, f) <= bound;
  return IsWeakSolution(problem, f, bound);
}

// What is wrong with an exact answer that is called solved; empty if nothing is.
inline std::string FaultOf(const ExactProblem& problem, const ExactAnswer& answer) {
  if (answer.f.size() != problem.rows()) return "solved without forces";
  if (answer.a != Accelerations(problem, answer.f)) return "accelerations of other forces";
  const bool weak = answer.law == FrictionLaw::kBaraff;
  const auto violation = problem.dimension == 2 ? FindViolation(problem, answer.f)
                         : weak                 ? FindWeakViolation(problem, answer.f)
                                : FindCoulombViolation(problem, answer.f, *ParseRational(answer.bound));
  return violation ? "called solved: " + *violation : "";
}

inline std::string FaultOf(const ExactProblem& problem, const InexactAnswer& answer, double bound) {
  if (answer.f.size() != problem.rows()) return "solved without forces";
  if (!answer.f.allFinite()) return "forces that are not finite";
  const ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const Rational most = Rational(bound) * (1 + Rational(1, 1 << 30));  // the gate measures in long double
  return IsSolutionWithin(problem, f, answer.law, most) ? "" : "called solved, with a larger residual";
}

// What is wrong with a solution of the problem that calls itself solved; empty if nothing is, or if it does
// not.
inline std::string FaultOf(const ExactProblem& problem, const SolveRequest& request, const Solution& solution) {
  if (solution.outcome() != Outcome::kSolved) return "";
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  const bool filtered = request.arithmetic == Arithmetic::kFiltered;  // to the end, or with rounded forces
  const ExactProblem ran = filtered && exact ? problem : AsRun(problem, request.arithmetic);
  if (exact) return FaultOf(ran, *exact);
  const double usual =
      request.arithmetic == Arithmetic::kFloat ? kSolvedResidual<float> : kSolvedResidual<double>;
  const double bound = request.options.residual > 0 ? request.options.residual : usual;
  return FaultOf(ran, std::get<InexactAnswer>(solution.answer), bound);
}

}  // namespace stiction::testing

#endif  // STICTION_TESTS_JUDGE_H_
