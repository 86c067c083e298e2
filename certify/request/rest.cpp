// SPDX-License-Identifier: Apache-2.0
#include "certify/request/rest.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "certify/exact/bodies.h"
#include "certify/exact/interval.h"
#include "certify/exact/rest.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/problem/units.h"
#include "solver/solve.h"

namespace stiction {
namespace {

template <class Scalar>
bool MayPreferRest(const Answer<Scalar>& answer, const Request& request) {
  return request.method == kAutomatic && !request.trace && answer.Solved() && !request.limits.Stopped();
}

// Squares of accelerations, of contacts as if A_ii were 1: no units of theirs change it.
Rational Motion(const ExactProblem& problem, const ExactVector& a) {
  Rational sum = 0;
  for (int i = 0; i < a.size(); ++i)
    if (problem.A(i, i) > 0) sum += a[i] * a[i] / problem.A(i, i);
  return sum;
}

// In space, of solutions whose contacts slip, the one of Newton's method in the space of bodies if it moves
// less: its steps are those of the least change.
void PreferLessMotion(const AnyProblem& problem, const Request& request, ExactAnswer& answer) {
  if (problem.dimension() != 3 || answer.law != FrictionLaw::kCoulomb || answer.a.isZero(0)) return;
  Eigen::VectorXd f;
  try {
    f = problem.factors() != nullptr ? SolveByBodies(*problem.factors(), request).f
                                     : SolveBy(NewtonBodiesRow(), Rounded<double>(problem), request).f;
  } catch (const InputError&) {  // doubles do not hold the problem
    return;
  }
  ExactAnswer other = SolveNear(problem, request, f);
  if (!other.Solved()) return;
  const Rational mine = Motion(problem, answer.a), least = Motion(problem, other.a);
  constexpr double kAlike = 1e-6;  // what bounded directions of slip leave
  if (abs(least - mine) <= Rational(kAlike) * mine) return;
  answer.moves_elsewhere = true;
  if (least > mine) return;
  answer.f = std::move(other.f);
  answer.a = std::move(other.a);
  answer.bound = other.bound;
  answer.word.clear();
}

}  // namespace

void PreferRest(const AnyProblem& problem, const Request& request, ExactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  auto rest = ForcesAtRest(problem, answer.f, Accelerations(problem, answer.f));
  if (!rest) return PreferLessMotion(problem, request, answer);
  answer.f = std::move(rest->f);
  answer.a = Accelerations(problem, answer.f);
  answer.word.clear();
  answer.moves_elsewhere = true;
  if (answer.bound) answer.bound = CoulombBound(problem, answer.f).value_or(0);
}

namespace {

// Accelerations that are no rounding, of contacts in their own units or by enclosures; the others are zero.
ExactVector Moving(const ContactProblem<double>& problem, const InexactAnswer& answer) {
  constexpr double kMoves = 1e-6;
  LenientUnits<double> units;
  units.Take(problem, answer.f);
  ExactVector moving = ExactVector::Zero(answer.a.size());
  for (int i = 0; i < moving.size(); ++i) {
    const bool moves = answer.a_enclosed.empty()
                           ? std::abs(answer.a[i]) > kMoves * units.acceleration(i)
                           : answer.a_enclosed[i].low > 0 || answer.a_enclosed[i].high < 0;
    if (moves) moving[i] = answer.a[i];
  }
  return moving;
}

// By how much f is outside of the cone of a contact, in forces of `row` on.
double OutsideCone(const Contact<double>& contact, const Eigen::VectorXd& f, int row, int rows) {
  if (contact.kind == ContactKind::kBilateral) return 0;
  const double beyond = rows > 1 ? TangentLength(f, row, rows) - Limit(contact.mu, f[row]) : 0.0;
  return std::max(-f[row], beyond);
}

// Whether doubles tell that no group of contacts that moves has forces under which it rests: A is regular, so
// there are no others than -inv(A) b, and those are clearly outside of their cones.
bool CannotRest(const ContactProblem<double>& problem, const ExactVector& moving) {
  constexpr double kRegular = 1e-6, kClearly = 1e-6;
  const bool slides = std::ranges::any_of(
      problem.contacts, [](const auto& contact) { return contact.kind == ContactKind::kSliding; });
  if (slides || problem.A != problem.A.transpose()) return false;
  const Eigen::LDLT<Eigen::MatrixXd> factors(problem.A);
  const Eigen::VectorXd pivots = factors.vectorD();
  if (pivots.size() == 0 || !(pivots.minCoeff() > kRegular * pivots.maxCoeff())) return false;
  const Eigen::VectorXd f = -factors.solve(problem.b);
  if (!f.allFinite()) return false;
  Groups groups;
  groups.Find(problem);
  std::vector<char> moves(problem.contacts.size(), false), leaves = moves;
  const double clear = kClearly * f.cwiseAbs().maxCoeff();
  ForEachContact(problem, [&](int i, int row, int rows) {
    const int group = groups.Of(i);
    for (int k = row; k < row + rows; ++k) moves[group] |= moving[k] != 0;
    leaves[group] |= OutsideCone(problem.contacts[i], f, row, rows) > clear;
  });
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (moves[i] && !leaves[i]) return false;
  return true;
}

}  // namespace

void PreferRest(const ContactProblem<double>& rounded, const std::function<const AnyProblem&()>& file,
                const Request& request, InexactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  const ExactVector moving = Moving(rounded, answer);
  if (moving.isZero(0) || CannotRest(rounded, moving)) return;
  const ExactVector f = answer.f.unaryExpr([](double x) { return Rational(x); });
  const auto rest = ForcesAtRest(file(), f, moving);
  if (!rest) return;
  InexactAnswer resting = answer;
  resting.f = rest->f.unaryExpr([](const Rational& x) { return ToDouble(x); });
  JudgeAnswer(rounded, ResidualOf<double>(request), resting);
  if (!resting.Solved()) return;
  if (!answer.f_enclosed.empty()) resting.a = answer.a;
  for (int i = 0; i < static_cast<int>(answer.f_enclosed.size()); ++i) {
    if (!rest->rests[i]) continue;
    const Interval around = Around(rest->f[i]);
    resting.f_enclosed[i] = {around.inf(), around.sup()};
    resting.a_enclosed[i] = {0, 0};
    resting.a[i] = 0;
  }
  resting.word.clear();
  resting.moves_elsewhere = true;
  answer = std::move(resting);
}

}  // namespace stiction
