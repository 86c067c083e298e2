// SPDX-License-Identifier: Apache-2.0
#include "certify/request/rest.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "certify/exact/bodies.h"
#include "certify/exact/interval.h"
#include "certify/exact/rest.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/numeric/fast.h"
#include "solver/problem/row_scale.h"
#include "solver/problem/units.h"
#include "solver/solve.h"

namespace stiction {
namespace {

template <class Scalar>
bool MayPreferRest(const Answer<Scalar>& answer, const Request& request) {
  return request.method == kAutomatic && !request.trace && answer.Solved() && !request.limits.Stopped();
}

// Squares of accelerations, of contacts as if A_ii were 1: no units of theirs change it.
Rational Motion(const AnyProblem& problem, const ExactVector& a) {
  const ExactVector diagonal = problem.entries().A.diagonal();
  Rational sum = 0;
  for (int i = 0; i < a.size(); ++i)
    if (diagonal[i] > 0) sum += a[i] * a[i] / diagonal[i];
  return sum;
}

// In space, of solutions whose contacts slip, the one of Newton's method in the space of bodies if it moves
// less: its steps are those of the least change.
void PreferLessMotion(const AnyProblem& problem, const Request& request, ExactAnswer& answer) {
  if (problem.dimension() != 3 || answer.law != FrictionLaw::kCoulomb || answer.a.isZero(0)) return;
  ExactAnswer other;
  if (problem.factors() != nullptr) {
    Request by_newton = request;
    by_newton.method = kNewtonBodies;
    other = SolveByBodiesExactly(*problem.factors(), by_newton);
  } else {
    try {
      other = SolveNear(problem, request, SolveBy(NewtonBodiesRow(), Rounded<double>(problem), request).f);
    } catch (const InputError&) {  // doubles do not hold the problem
      return;
    }
  }
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

// By how much f is outside of the cone of a contact, in forces of `row` on.
double OutsideCone(const Contact<double>& contact, const Eigen::VectorXd& f, int row, int rows) {
  if (contact.kind == ContactKind::kBilateral) return 0;
  const double beyond = rows > 1 ? TangentLength(f, row, rows) - Limit(contact.mu, f[row]) : 0.0;
  return std::max(-f[row], beyond);
}

// Edges of the cones, in space of octagons around them; with them the same problem without friction, of forces
// x >= 0 along the edges.
std::pair<Eigen::MatrixXd, ContactProblem<double>> AlongCones(const ContactProblem<double>& problem) {
  constexpr int kSides = 8;
  const double around = 1 / std::cos(std::numbers::pi / kSides);
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(problem.rows(), kSides * std::ssize(problem.contacts));
  ContactProblem<double> pushing;
  ForEachContact(problem, [&](int i, int row, int rows) {
    const Contact<double>& contact = problem.contacts[i];
    const int edges = rows == 1 || contact.mu == 0 ? 1 : rows == 2 ? 2 : kSides;
    for (int k = 0; k < edges; ++k) {
      auto edge = E.col(std::ssize(pushing.contacts));
      const double angle = 2 * std::numbers::pi * k / kSides;
      edge[row] = 1;
      if (edges == 2) edge[row + 1] = k == 0 ? contact.mu : -contact.mu;
      if (edges == kSides) edge.segment(row + 1, 2) << std::cos(angle), std::sin(angle);
      if (edges == kSides) edge.segment(row + 1, 2) *= contact.mu * around;
      const bool is_held = contact.kind == ContactKind::kBilateral;
      pushing.contacts.push_back({is_held ? ContactKind::kBilateral : ContactKind::kFrictionless, 0, {}});
    }
  });
  E.conservativeResize(Eigen::NoChange, std::ssize(pushing.contacts));
  pushing.A = E.transpose() * problem.A * E;
  pushing.b = E.transpose() * problem.b;
  return {E, pushing};
}

// Forces that leave no acceleration, as doubles find them: the only such ones, in or out of their cones (true);
// or of forces in the cones those that leave the least (false). Empty where none are found. Of forces along the
// edges those that push and never pull leave the least where A is semidefinite; b is next to nothing along
// some, so what is noise there counts as none.
std::pair<Eigen::VectorXd, bool> BalanceOf(const ContactProblem<double>& problem) {
  constexpr int kFewRows = 4 * kQuickRows;
  constexpr double kRegular = 1e-6, kRounding = 1e-9;
  if (problem.A != problem.A.transpose()) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(problem.A);
    if (factors.rcond() > kRegular) return {-factors.solve(problem.b), true};
    if (problem.rows() > kFewRows) return {};
    return {-problem.A.completeOrthogonalDecomposition().solve(problem.b), false};
  }
  const Eigen::LDLT<Eigen::MatrixXd> factors(problem.A);
  const Eigen::VectorXd pivots = factors.vectorD();
  if (pivots.minCoeff() > kRegular * pivots.maxCoeff()) return {-factors.solve(problem.b), true};
  if (problem.rows() > kFewRows || pivots.minCoeff() < -kRounding * pivots.maxCoeff()) return {};
  const auto [E, pushing] = AlongCones(problem);
  FastSolver<double> solver({.noise = kRounding});
  if (solver.Run(pushing).outcome != Outcome::kSolved) return {};
  return {E * solver.f(), false};
}

// Forces f, but of groups of contacts that move and may rest those that doubles find for them; f itself where
// doubles do not tell. Empty where they tell that no group that moves has forces under which it rests: the only
// ones that leave no acceleration are clearly outside of their cones, or all in their cones clearly leave some.
template <class Moving>
std::optional<Eigen::VectorXd> RestByDoubles(const ContactProblem<double>& given, const Moving& moving,
                                             Eigen::VectorXd f) {
  constexpr double kClearly = 1e-6;
  const bool is_open = std::ranges::any_of(given.contacts, [](const auto& contact) {
    return contact.kind == ContactKind::kSliding || !std::isfinite(contact.mu);
  });
  if (is_open || given.rows() == 0) return f;
  const RowScale scale = FindScale(given);
  const ContactProblem<double> problem = Scaled(given, scale);  // b of each group is about 1
  const auto balance = BalanceOf(problem);
  const Eigen::VectorXd& found = balance.first;
  const bool is_only = balance.second;
  if (found.size() == 0 || !found.allFinite()) return f;
  const Eigen::VectorXd left = problem.A * found + problem.b;
  Groups groups;
  groups.Find(problem);
  std::vector<char> moves(problem.contacts.size(), false), leaves = moves;
  const double clear = is_only ? kClearly * found.cwiseAbs().maxCoeff() : kClearly;
  ForEachContact(problem, [&](int i, int row, int rows) {
    const int group = groups.Of(i);
    for (int k = row; k < row + rows; ++k) moves[group] |= moving[k] != 0;
    const double misses = is_only ? OutsideCone(problem.contacts[i], found, row, rows)
                                  : left.segment(row, rows).cwiseAbs().maxCoeff();
    leaves[group] |= misses > clear;
  });
  bool may_rest = false;
  for (int k = 0; k < f.size(); ++k) {
    const int group = groups.OfRow(k);
    if (!moves[group] || leaves[group]) continue;
    f[k] = std::ldexp(found[k], scale.f[k]);
    may_rest = true;
  }
  return may_rest ? std::optional(std::move(f)) : std::nullopt;
}

// Whether a group of contacts moves that is small enough to look for forces at rest.
template <class Factors, class Moving>
bool MoveInSmallGroups(const Factors& problem, const Moving& moving) {
  if (moving.isZero(0)) return false;
  Groups groups;
  groups.Find(problem);
  std::vector<int> rows(problem.contacts.size(), 0);
  std::vector<char> moves(rows.size(), false);
  for (int k = 0; k < moving.size(); ++k) {
    ++rows[groups.OfRow(k)];
    moves[groups.OfRow(k)] |= moving[k] != 0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (moves[i] && rows[i] <= kQuickRows) return true;
  return false;
}

}  // namespace

void PreferRest(const AnyProblem& problem, const ContactProblem<double>* rounded, const Request& request,
                ExactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  const auto* factors = problem.factors();
  const ExactVector a =
      factors != nullptr ? factors->Accelerations(answer.f) : Accelerations(problem, answer.f);
  if (a.isZero(0)) return;
  if (rounded != nullptr && !RestByDoubles(*rounded, a, Eigen::VectorXd::Zero(a.size()))) return;
  const bool is_small = factors == nullptr || MoveInSmallGroups(*factors, a);
  auto rest = is_small ? ForcesAtRest(problem, answer.f, a) : std::nullopt;
  if (!rest) return PreferLessMotion(problem, request, answer);
  answer.f = std::move(rest->f);
  answer.a = Accelerations(problem, answer.f);
  answer.word.clear();
  answer.moves_elsewhere = true;
  if (answer.bound) answer.bound = CoulombBound(problem, answer.f).value_or(0);
}

namespace {

// Accelerations that are no rounding, of contacts in their own units or by enclosures; the others are zero.
template <class Problem>
Eigen::VectorXd MovingRows(const Problem& problem, const InexactAnswer& answer) {
  constexpr double kMoves = 1e-6;
  LenientUnits<double> units;
  units.Take(problem, answer.f);
  Eigen::VectorXd moving = Eigen::VectorXd::Zero(answer.a.size());
  for (int i = 0; i < moving.size(); ++i) {
    const bool moves = answer.a_enclosed.empty()
                           ? std::abs(answer.a[i]) > kMoves * units.acceleration(i)
                           : answer.a_enclosed[i].low > 0 || answer.a_enclosed[i].high < 0;
    if (moves) moving[i] = answer.a[i];
  }
  return moving;
}

}  // namespace

bool MayRest(const FactoredProblem<double>& problem, const InexactAnswer& answer) {
  return answer.Solved() && MoveInSmallGroups(problem, MovingRows(problem, answer));
}

void PreferRest(const ContactProblem<double>& rounded, const std::function<const AnyProblem&()>& file,
                const Request& request, InexactAnswer& answer) {
  if (!MayPreferRest(answer, request)) return;
  const Eigen::VectorXd moving = MovingRows(rounded, answer);
  if (moving.isZero(0)) return;
  const auto by_doubles = RestByDoubles(rounded, moving, answer.f);
  if (!by_doubles) return;
  const auto take = [&](Eigen::VectorXd f) {
    InexactAnswer resting = answer;
    resting.f = std::move(f);
    JudgeAnswer(rounded, ResidualOf<double>(request), resting);
    return resting;
  };
  const auto become = [&answer](InexactAnswer resting) {
    resting.word.clear();
    resting.moves_elsewhere = true;
    answer = std::move(resting);
  };
  if (answer.f_enclosed.empty() && *by_doubles != answer.f) {
    InexactAnswer resting = take(*by_doubles);
    if (resting.Solved() && (MovingRows(rounded, resting).array() != 0).count() < (moving.array() != 0).count())
      return become(std::move(resting));
  }
  const auto exact = [](double x) { return Rational(x); };
  const auto rest = ForcesAtRest(file(), answer.f.unaryExpr(exact), moving.unaryExpr(exact));
  if (!rest) return;
  InexactAnswer resting = take(rest->f.unaryExpr([](const Rational& x) { return ToDouble(x); }));
  if (!resting.Solved()) return;
  if (!answer.f_enclosed.empty()) resting.a = answer.a;
  for (int i = 0; i < static_cast<int>(answer.f_enclosed.size()); ++i) {
    if (!rest->rests[i]) continue;
    const Interval around = Around(rest->f[i]);
    resting.f_enclosed[i] = {around.inf(), around.sup()};
    resting.a_enclosed[i] = {0, 0};
    resting.a[i] = 0;
  }
  become(std::move(resting));
}

}  // namespace stiction
