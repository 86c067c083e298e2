// SPDX-License-Identifier: Apache-2.0
#include "certify/space.h"

#include <algorithm>

#include "certify/verify_solution.h"
#include "corpus/rounded.h"
#include "solver/numeric/coulomb.h"

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
  CoulombOptions options;
  options.sides = 0;  // from f only
  CoulombSolver<double> solver(options);
  const ContactProblem<double>::Vector start = f.unaryExpr([](const Rational& x) { return ToDouble(x); });
  if (!start.allFinite() || !rounded.A.allFinite() || !rounded.b.allFinite()) return std::nullopt;
  if (solver.Run(rounded, &start).outcome != Outcome::kSolved) return std::nullopt;
  const auto exact = [](double x) { return Rational(x); };
  const ExactVector near = solver.f().unaryExpr(exact);
  return SolveModes(problem, ModesNear(problem, near, solver.a().unaryExpr(exact)), near);
}

// Corners opposite to the accelerations of slipping contacts, with `bits` binary places.
bool RefineAgainst(const ExactProblem& problem, const SpaceRun& run, int bits, RationalPolygons& polygons) {
  bool added = false;
  int row = 0;
  for (std::size_t i = 0; i < run.word.size(); ++i) {
    const bool slips = run.word[i].law == Law::kCorner || run.word[i].law == Law::kEdge;
    if (slips) {
      const Planar<Rational> a = TangentialOf(run.a, row);
      added = polygons[i].Insert(NearDirection({Rational(-a[0]), Rational(-a[1])}, bits)) || added;
    }
    row += problem.contacts[i].HasFrictionRows() ? 3 : 1;
  }
  return added;
}

// The same toward Coulomb's law.
bool TryCoulomb(const ExactProblem& problem, const ContactProblem<double>& rounded, const SpaceRun& run,
                RationalPolygons& polygons, SpaceSolution& solution) {
  static const Rational kEnough = 1 - Rational(1, 1 << 20);
  const auto consider = [&](const ExactVector& f) {
    const auto bound = CoulombBound(problem, f);
    if (!bound || (solution.outcome == Outcome::kSolved && *bound <= solution.bound)) return;
    Accept(problem, f, solution);
    solution.bound = *bound;
  };
  consider(run.f);
  if (const auto f = NewtonSolution(problem, rounded, run.f)) consider(*f);
  return solution.bound >= kEnough || !RefineAgainst(problem, run, 4 + 2 * solution.refinements, polygons);
}

}  // namespace

SpaceSolution SolveInSpace(const ExactProblem& problem, const SpaceOptions& options, Trace<Rational>* trace) {
  if (options.law == FrictionLaw::kBaraff) return SolveWeakly(problem, options, trace);
  const ContactProblem<double> rounded = Rounded<double>(problem);
  const auto toward = [&](const SpaceRun& run, RationalPolygons& polygons, SpaceSolution& solution) {
    return TryCoulomb(problem, rounded, run, polygons, solution);
  };
  return SolveOnPolygons(problem, options, toward, trace);
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

// ---- The residual of doubles -----------------------------------------------------------------

namespace {

// value <= the number <= value + gap.
struct Enclosed {
  Rational value = 0, gap = 0;
};

// The gap is at most 2^-100 of the root. Requires x >= 0.
Enclosed SquareRoot(const Rational& x) {
  if (x == 0) return {};
  const auto bits = [](const mpz_class& z) { return static_cast<int>(mpz_sizeinbase(z.get_mpz_t(), 2)); };
  const int places = 110 + std::max(0, bits(x.get_den()) - bits(x.get_num()) + 1) / 2;
  const mpz_class scaled = (x.get_num() << (2 * places)) / x.get_den();
  Rational root(sqrt(scaled), mpz_class(1) << places), unit(1, mpz_class(1) << places);
  root.canonicalize();
  unit.canonicalize();
  return {root, unit};
}

// abs(f - P(f - r (a + mu abs(aF) e_N))), from above. P moves no two points apart; rounding abs(aF) by d
// moves its argument by r mu d. Rounding abs(xF) by d moves P itself by less than 3 d: there
// mu abs(xN) <= max(1, mu^2) abs(xF).
Rational StaticGap(const Rational* f, const Rational* a, const Rational& r, const Rational& mu) {
  const Enclosed slip = SquareRoot(a[1] * a[1] + a[2] * a[2]);
  const Rational x[3] = {Rational(f[0] - r * (a[0] + mu * slip.value)), Rational(f[1] - r * a[1]),
                         Rational(f[2] - r * a[2])};
  const Rational square = x[1] * x[1] + x[2] * x[2];
  Rational to[3] = {x[0], x[1], x[2]}, error = r * mu * slip.gap;
  if (x[0] <= 0 && mu * mu * square <= x[0] * x[0]) {
    to[0] = to[1] = to[2] = 0;
  } else if (x[0] < 0 || square > mu * mu * x[0] * x[0]) {
    const Enclosed length = SquareRoot(square);
    to[0] = (x[0] + mu * length.value) / (1 + mu * mu);
    for (int k = 1; k <= 2; ++k) to[k] = mu * to[0] / length.value * x[k];
    error += 3 * length.gap;
  }
  Rational gap = 0;
  for (int k = 0; k < 3; ++k) gap += (f[k] - to[k]) * (f[k] - to[k]);
  const Enclosed distance = SquareRoot(gap);
  return distance.value + distance.gap + error;
}

Rational GapOf(const Contact<Rational>& contact, const Rational* f, const Rational* a, const Rational& r) {
  if (contact.kind == ContactKind::kStatic) return StaticGap(f, a, r, contact.mu);
  if (contact.kind == ContactKind::kBilateral) return abs(Rational(r * a[0]));
  const Rational normal = f[0] - std::max<Rational>(0, f[0] - r * a[0]);
  Rational square = normal * normal;
  for (int k = 1; k <= 2 && contact.kind == ContactKind::kSliding; ++k) {
    const Rational gap = f[k] + contact.mu * f[0] * contact.slip[k - 1];
    square += gap * gap;
  }
  const Enclosed length = SquareRoot(square);
  return length.value + length.gap;
}

}  // namespace

Rational CoulombResidualBound(const ExactProblem& problem, const ExactVector& f) {
  const ExactVector a = Accelerations(problem, f);
  Rational max_A = 0, max_b = 0, worst = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    max_A = std::max<Rational>(max_A, problem.A(i, i));
    max_b = std::max<Rational>(max_b, abs(problem.b[i]));
  }
  const Rational r = max_A > 0 ? Rational(1 / max_A) : Rational(1);
  int row = 0;
  for (const Contact<Rational>& contact : problem.contacts) {
    worst = std::max<Rational>(worst, GapOf(contact, &f[row], &a[row], r));
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  return max_b > 0 ? Rational(worst / (max_b * r)) : worst;
}

}  // namespace stiction
