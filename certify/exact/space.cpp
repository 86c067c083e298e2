// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/space.h"

#include <algorithm>

#include "certify/exact/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/refine.h"

namespace stiction {
namespace {

// What a point of Newton's method says that every contact does.
std::vector<SpaceMode> ModesNear(const ExactProblem& problem, const ExactVector& f, const ExactVector& a) {
  std::vector<SpaceMode> modes;
  Rational max_A = 0;
  for (int i = 0; i < problem.rows(); ++i) max_A = std::max<Rational>(max_A, problem.A(i, i));
  const Rational r = max_A > 0 ? Rational(1 / max_A) : Rational(1);
  int row = 0;
  for (const Contact<Rational>& contact : problem.contacts) {
    SpaceMode mode = {Law::kFree, {Rational(0), Rational(0)}};
    if (contact.kind == ContactKind::kBilateral) {
      mode.law = Law::kHold;
    } else if (f[row] <= r * a[row]) {
      mode.law = Law::kBreak;
    } else if (contact.kind == ContactKind::kStatic && contact.mu > 0) {
      const Planar<Rational> friction = TangentialOf(f, row), slip = TangentialOf(a, row);
      const Planar<Rational> target = {Rational(friction[0] - r * slip[0]),
                                       Rational(friction[1] - r * slip[1])};
      const Rational limit = contact.mu * f[row];
      mode.law = Dot(target, target) <= limit * limit ? Law::kInside : Law::kCorner;
      mode.direction = NearDirection(target, 45);
    }
    modes.push_back(mode);
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return modes;
}

// The word of Newton's method from f, solved exactly.
std::optional<ExactVector> NewtonSolution(const ExactProblem& problem, const ContactProblem<double>& rounded,
                                          const ExactVector& f) {
  CoulombSolver<double> solver({.sides = 0});  // from f only
  const ContactProblem<double>::Vector start = f.unaryExpr([](const Rational& x) { return ToDouble(x); });
  if (!start.allFinite() || !rounded.A.allFinite() || !rounded.b.allFinite()) return std::nullopt;
  if (solver.Run(rounded, &start).outcome != Outcome::kSolved) return std::nullopt;
  const Refined refined = Refine(rounded, FrictionLaw::kCoulomb, GateOf<double>(), solver.f());
  const ExactVector near = refined.f.unaryExpr([](double x) { return Rational(x); });
  return SolveModes(problem, ModesNear(problem, near, Accelerations(problem, near)), near);
}

// The cosine from which on an angle is at most that up to which forces are called solved.
const Rational& EnoughBound() {
  static const Rational enough = 1 - Rational(kSolvedResidual<double> * kSolvedResidual<double> / 4);
  return enough;
}

// Friction turned against the slip that it leaves, again and again, until the bound is enough or falls no more.
std::optional<ExactVector> Turned(const ExactProblem& problem, ExactVector f) {
  constexpr int kTurns = 8;
  std::optional<ExactVector> best;
  std::optional<Rational> least = CoulombBound(problem, f);
  for (int turn = 0; turn < kTurns && least && *least < EnoughBound(); ++turn) {
    const auto next = SolveModes(problem, ModesNear(problem, f, Accelerations(problem, f)), f);
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
  int row = 0;
  for (std::size_t i = 0; i < run.word.size(); ++i) {
    const bool slips = run.word[i].law == Law::kCorner || run.word[i].law == Law::kEdge;
    if (slips) {
      const Planar<Rational> a = TangentialOf(run.answer.a, row);
      added = run.polygons[i].Insert(NearDirection({Rational(-a[0]), Rational(-a[1])}, bits)) || added;
    }
    row += problem.contacts[i].HasFrictionRows() ? 3 : 1;
  }
  return added;
}

// The same toward Coulomb's law.
bool TryCoulomb(const ExactProblem& problem, const ContactProblem<double>& rounded, OnPolygons& run,
                Answer<Rational>& answer) {
  const auto consider = [&](const ExactVector& f) {
    const auto bound = CoulombBound(problem, f);
    if (!bound || (answer.Solved() && *bound <= *answer.bound)) return;
    Accept(problem, f, answer);
    answer.bound = *bound;
  };
  consider(run.answer.f);
  if (const auto f = NewtonSolution(problem, rounded, run.answer.f)) consider(*f);
  if (answer.Solved() && *answer.bound < EnoughBound())
    if (const auto f = Turned(problem, answer.f)) consider(*f);
  return answer.bound >= EnoughBound() || !RefineAgainst(problem, run, 4 + 2 * run.refinements);
}

// Forces whose friction is further from the slip than a solution's may be are no solution: they are told, with
// their bound.
void CallBounded(Answer<Rational>& answer) {
  if (!answer.Solved() || !answer.bound || *answer.bound >= EnoughBound()) return;
  answer.outcome = Outcome::kUndecided;
  answer.reason = "the angle between friction and slip is bounded, and not small enough to be called solved";
}

}  // namespace

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
  const auto exact = SolveModes(problem, ModesNear(problem, near, Accelerations(problem, near)), near);
  if (!exact) return answer;
  const auto bound = CoulombBound(problem, *exact);
  if (request.law == FrictionLaw::kBaraff ? FindWeakViolation(problem, *exact).has_value()
                                          : !bound || *bound <= 0)
    return answer;
  Accept(problem, *exact, answer);
  if (request.law == FrictionLaw::kCoulomb) answer.bound = *bound;
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

std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactVector& f) {
  constexpr int kPlaces = 200;
  if (FindCoulombViolation(problem, f, 0)) return std::nullopt;
  const ExactVector a = Accelerations(problem, f);
  Rational least = 1;  // of the squared cosines
  int row = 0;
  for (const Contact<Rational>& contact : problem.contacts) {
    if (contact.kind == ContactKind::kStatic) {
      const Rational power = Dot(TangentialOf(f, row), TangentialOf(a, row)), limit = contact.mu * f[row];
      const Rational full = limit * limit * Dot(TangentialOf(a, row), TangentialOf(a, row));
      if (full != 0) least = std::min<Rational>(least, power * power / full);
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  if (least == 1) return Rational(1);
  mpz_class root = (least.get_num() << (2 * kPlaces)) / least.get_den();
  root = sqrt(root);
  mpz_class gap = (mpz_class(1) << kPlaces) - root;  // 1 - c, in units of 2^-200
  const int spare = static_cast<int>(mpz_sizeinbase(gap.get_mpz_t(), 2)) - 8;
  if (spare > 0) gap = ((gap >> spare) + 1) << spare;
  Rational bound(mpz_class((mpz_class(1) << kPlaces) - gap), mpz_class(1) << kPlaces);
  bound.canonicalize();
  return bound < 0 ? Rational(0) : bound;
}

}  // namespace stiction
