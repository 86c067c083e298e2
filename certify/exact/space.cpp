// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/space.h"

#include <algorithm>

#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/refine.h"

namespace stiction {
namespace {

// What a point of Newton's method says that every contact does, each direction in its own unit.
std::vector<SpaceMode> ModesNear(const ExactProblem& problem, const ExactVector& f, const ExactVector& a) {
  std::vector<SpaceMode> modes;
  const auto step = [&problem](int row, int other) -> Rational {
    const Rational& own = std::max(problem.A(row, row), problem.A(other, other));
    return own > 0 ? Rational(1 / own) : Rational(1);
  };
  ForEachContact(problem, [&](int i, int row, int) {
    const Contact<Rational>& contact = problem.contacts[i];
    SpaceMode mode = {Law::kFree, {Rational(0), Rational(0)}};
    if (contact.kind == ContactKind::kBilateral) {
      mode.law = Law::kHold;
    } else if (f[row] <= step(row, row) * a[row]) {
      mode.law = Law::kBreak;
    } else if (contact.kind == ContactKind::kStatic && contact.mu > 0) {
      const Planar<Rational> friction = TangentialOf(f, row), slip = TangentialOf(a, row);
      const Rational r = step(row + 1, row + 2);
      const Planar<Rational> target = {Rational(friction[0] - r * slip[0]),
                                       Rational(friction[1] - r * slip[1])};
      const Rational limit = contact.mu * f[row];
      mode.law = Dot(target, target) <= limit * limit ? Law::kInside : Law::kCorner;
      mode.direction = NearDirection(target, 45);
    }
    modes.push_back(mode);
  });
  return modes;
}

// These modes, solved exactly.
std::optional<ExactVector> SolveNear(const ExactProblem& problem, const ExactVector& f) {
  return SolveModes(problem, ModesNear(problem, f, Accelerations(problem, f)), f);
}

// Where Newton's method goes from f.
std::optional<ExactVector> NewtonPoint(const ContactProblem<double>& rounded, const ExactVector& f) {
  CoulombSolver<double> solver({.sides = 0});  // from f only
  const ContactProblem<double>::Vector start = f.unaryExpr([](const Rational& x) { return ToDouble(x); });
  if (!start.allFinite() || !rounded.A.allFinite() || !rounded.b.allFinite()) return std::nullopt;
  if (solver.Run(rounded, &start).outcome != Outcome::kSolved) return std::nullopt;
  const Refined refined = Refine(rounded, FrictionLaw::kCoulomb, GateOf<double>(), solver.f());
  return refined.f.unaryExpr([](double x) { return Rational(x); });
}

// Friction turned against the slip that it leaves, again and again, until the bound is enough or falls no more.
std::optional<ExactVector> Turned(const ExactProblem& problem, ExactVector f) {
  constexpr int kTurns = 8;
  std::optional<ExactVector> best;
  std::optional<Rational> least = CoulombBound(problem, f);
  for (int turn = 0; turn < kTurns && least && *least < EnoughBound(); ++turn) {
    const auto next = SolveNear(problem, f);
    const auto bound = next ? CoulombBound(problem, *next) : std::nullopt;
    if (!bound || *bound <= *least) break;
    best = f = *next;
    least = bound;
  }
  return best;
}

// Corners opposite to the accelerations of slipping contacts, with `bits` binary places.
bool RefineAgainst(const ExactProblem& problem, OnPolygons& run, int bits) {
  bool added = false;
  ForEachContact(problem, [&](int i, int row, int) {
    const bool slips = run.word[i].law == Law::kCorner || run.word[i].law == Law::kEdge;
    if (!slips) return;
    const Planar<Rational> a = TangentialOf(run.answer.a, row);
    added = run.polygons[i].Insert(NearDirection({Rational(-a[0]), Rational(-a[1])}, bits)) || added;
  });
  return added;
}

// The same toward Coulomb's law.
bool TryCoulomb(const ExactProblem& problem, const ContactProblem<double>& rounded, OnPolygons& run,
                Answer<Rational>& answer) {
  const auto consider = [&](const std::optional<ExactVector>& f) {
    const auto bound = f ? CoulombBound(problem, *f) : std::nullopt;
    if (!bound || (answer.Solved() && *bound <= *answer.bound)) return;
    Accept(problem, *f, answer);
    answer.bound = *bound;
  };
  consider(run.answer.f);
  if (const auto near = NewtonPoint(rounded, run.answer.f)) consider(SolveNear(problem, *near));
  if (answer.Solved() && *answer.bound < EnoughBound()) consider(Turned(problem, answer.f));
  return answer.bound >= EnoughBound() || !RefineAgainst(problem, run, 4 + 2 * run.refinements);
}

}  // namespace

const Rational& EnoughBound() {
  static const Rational enough = 1 - Rational(kSolvedResidual<double> * kSolvedResidual<double> / 4);
  return enough;
}

void CallBounded(Answer<Rational>& answer) {
  if (!answer.Solved() || !answer.bound || *answer.bound >= EnoughBound()) return;
  answer.outcome = Outcome::kUndecided;
  answer.reason = "the angle between friction and slip is bounded, and not small enough to be called solved";
}

Answer<Rational> SolveInSpace(const ExactProblem& problem, const Request& request, SpaceEngine engine) {
  if (request.law == FrictionLaw::kBaraff) return SolveWeakly(problem, request, engine);
  const ContactProblem<double> rounded = Rounded<double>(problem);
  const auto toward = [&](OnPolygons& run, Answer<Rational>& answer) {
    return TryCoulomb(problem, rounded, run, answer);
  };
  Answer<Rational> answer = SolveOnPolygons(problem, request, engine, toward);
  CallBounded(answer);
  return answer;
}

Answer<Rational> SolveNear(const ExactProblem& problem, const Request& request, const Eigen::VectorXd& f) {
  Answer<Rational> answer;
  answer.law = request.law;
  answer.counters = kCompleteCounters;
  answer.counters.Tell(Counter::kRefinements) = 0;
  answer.reason = "the modes near these forces are no solution";
  if (f.size() != problem.rows() || !f.allFinite()) return answer;
  const ExactVector near = f.unaryExpr([](double x) { return Rational(x); });
  const auto exact = SolveNear(problem, near);
  if (!exact) return answer;
  if (request.law == FrictionLaw::kCoulomb) {
    const auto bound = CoulombBound(problem, *exact);
    if (!bound || *bound <= 0) return answer;
    answer.bound = *bound;
  } else if (FindViolation(problem, *exact)) {
    return answer;
  }
  Accept(problem, *exact, answer);
  CallBounded(answer);
  return answer;
}

Answer<Rational> SolveNearFast(const ExactProblem& problem, const Request& request) {
  Eigen::VectorXd f;
  try {
    f = Solve(Rounded<double>(problem), {.method = "fast", .limits = request.limits, .sides = request.sides}).f;
  } catch (const InputError&) {  // doubles do not hold the problem
  }
  Answer<Rational> answer = SolveNear(problem, request, f);
  if (answer.outcome == Outcome::kUndecided && !answer.bound)
    answer.reason = "the modes of the fast method's point are no solution";
  return answer;
}

}  // namespace stiction
