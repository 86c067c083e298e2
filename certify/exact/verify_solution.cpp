// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/verify_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "solver/problem/units.h"

namespace stiction {

// ---- Accelerations -------------------------------------------------------------------------------

namespace {

using Parts = Fractions<Rational>;
using Integer = Parts::Integer;

// sum / (unit D): a row of A f + b over integers, where f = F / D.
struct RowSum {
  Integer sum, unit;

  // sum / unit += x y
  void Add(const Rational& x, const Integer& y) {
    const Integer& denominator = Parts::Denominator(x);
    if (denominator == unit) return Parts::AddProduct(sum, Parts::Numerator(x), y);
    if (unit % denominator != 0) {
      Integer grown = unit;
      Parts::Include(grown, x);
      sum *= Integer(grown / unit);
      unit = std::move(grown);
    }
    Parts::AddProduct(sum, Parts::Numerator(x, unit), y);
  }
};

// Forces over a common denominator.
struct IntegerForces {
  Integer denominator;
  std::vector<std::pair<int, Integer>> numerators;  // of rows with a force
};

// Empty where that denominator is much longer than those of the forces, as of bodies that do not touch.
std::optional<IntegerForces> OverIntegers(const ExactProblem::Vector& f) {
  constexpr std::int64_t kLonger = 4;
  IntegerForces forces = {CommonDenominator<Rational>(f), {}};
  std::int64_t longest = 0;
  for (const Rational& x : f) longest = std::max(longest, BitLength<Integer>::Of(Parts::Denominator(x)));
  if (BitLength<Integer>::Of(forces.denominator) > kLonger * longest) return std::nullopt;
  for (int j = 0; j < f.size(); ++j)
    if (f[j] != 0) forces.numerators.emplace_back(j, Parts::Numerator(f[j], forces.denominator));
  return forces;
}

}  // namespace

ExactProblem::Vector Accelerations(const ExactProblem& problem, const ExactProblem::Vector& f) {
  ExactProblem::Vector a = problem.b;
  const auto forces = OverIntegers(f);
  for (int i = 0; i < a.size(); ++i) {
    if (!forces) {
      for (int j = 0; j < a.size(); ++j)
        if (f[j] != 0) a[i] += problem.A(i, j) * f[j];
      continue;
    }
    RowSum row = {Integer(Parts::Numerator(a[i]) * forces->denominator), Parts::Denominator(a[i])};
    for (const auto& [j, numerator] : forces->numerators)
      if (problem.A(i, j) != 0) row.Add(problem.A(i, j), numerator);
    a[i] = row.sum == 0 ? Rational(0) : Parts::Quotient(row.sum, Integer(row.unit * forces->denominator));
  }
  return a;
}

// ---- The law -------------------------------------------------------------------------------------

namespace {

// Friction of a static contact: lengths in the plane, of aF with its sign; in space their squares.
struct Friction {
  Rational limit, force, a, power;  // mu fN, abs(fF), aF; fF.aF
};

Friction FrictionOf(const ExactProblem& problem, int contact, int row, const ExactProblem::Vector& f,
                    const ExactProblem::Vector& a) {
  const Rational limit = problem.contacts[contact].mu * f[row];
  const Rational &fx = f[row + 1], &ax = a[row + 1];
  if (problem.dimension == 2) return {limit, abs(fx), ax, fx * ax};
  const Rational &fy = f[row + 2], &ay = a[row + 2];
  return {limit * limit, fx * fx + fy * fy, ax * ax + ay * ay, fx * ax + fy * ay};
}

// `together`: conditions on both f and a count, too.
std::optional<std::string> FindBroken(const ExactProblem& problem, const ExactProblem::Vector& f,
                                      const ExactProblem::Vector& a, bool together, FrictionLaw law,
                                      const Rational& bound) {
  const bool plane = problem.dimension == 2;
  std::optional<std::string> broken;
  ForEachContact(problem, [&](int i, int row, int rows) {
    if (broken) return;
    const auto require = [&](bool holds, const char* condition, const Rational& found) {
      if (!holds && !broken)
        broken = fmt::format("contact {}: {} is broken, found {}", i + 1, condition, ToString(found));
    };
    const Contact<Rational>& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) return require(a[row] == 0, "aN = 0", a[row]);
    require(f[row] >= 0, "fN >= 0", f[row]);
    require(a[row] >= 0, "aN >= 0", a[row]);
    if (together) require(f[row] == 0 || a[row] == 0, "fN aN = 0", f[row] * a[row]);
    if (contact.kind == ContactKind::kSliding) {
      for (int k = 1; k < rows; ++k) {
        const Rational gap = f[row + k] + contact.mu * f[row] * contact.slip[k - 1];
        require(gap == 0, plane ? "fF + mu u fN = 0" : "fF = -mu fN slip", gap);
      }
    }
    if (contact.kind != ContactKind::kStatic) return;
    const Friction friction = FrictionOf(problem, i, row, f, a);
    const Rational slack = friction.limit - friction.force;
    require(slack >= 0, plane ? "abs(fF) <= mu fN" : "fF.fF <= mu^2 fN^2", slack);
    if (!together) return;
    require(friction.power <= 0, plane ? "aF fF <= 0" : "fF.aF <= 0", friction.power);
    if (plane || law == FrictionLaw::kBaraff) {
      const Rational product = friction.a * slack;
      require(product == 0, plane ? "aF (mu fN - abs(fF)) = 0" : "aF = 0 or abs(fF) = mu fN", product);
    } else {
      const Rational excess = friction.power * friction.power - bound * bound * friction.limit * friction.a;
      require(excess >= 0, "(fF.aF)^2 >= c^2 mu^2 fN^2 aF.aF", excess);
    }
  });
  return broken;
}

}  // namespace

std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         FrictionLaw law, const Rational& bound) {
  return FindViolation(problem, f, Accelerations(problem, f), law, bound);
}

std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         const ExactProblem::Vector& a, FrictionLaw law,
                                         const Rational& bound) {
  return FindBroken(problem, f, a, /*together=*/true, law, bound);
}

std::optional<std::string> FindViolationApart(const ExactProblem& problem, const ExactProblem::Vector& f,
                                              const ExactProblem::Vector& a) {
  return FindBroken(problem, f, a, /*together=*/false, FrictionLaw::kBaraff, 1);
}

std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactProblem::Vector& f) {
  return CoulombBound(problem, f, Accelerations(problem, f));
}

std::optional<Rational> CoulombBound(const ExactProblem& problem, const ExactProblem::Vector& f,
                                     const ExactProblem::Vector& a) {
  constexpr int kPlaces = 200;
  if (FindViolation(problem, f, a, FrictionLaw::kCoulomb, 0)) return std::nullopt;
  Rational least = 1;  // of the squared cosines
  ForEachContact(problem, [&](int i, int row, int) {
    if (problem.contacts[i].kind != ContactKind::kStatic || problem.dimension == 2) return;
    const Friction friction = FrictionOf(problem, i, row, f, a);
    const Rational full = friction.limit * friction.a;
    if (full != 0) least = std::min<Rational>(least, friction.power * friction.power / full);
  });
  if (least == 1) return Rational(1);
  using F = Fractions<Rational>;
  using Integer = F::Integer;
  const Integer one = Integer(1) << kPlaces;
  const Integer square = (F::Numerator(least) << (2 * kPlaces)) / F::Denominator(least);
  Integer gap = one - Integer(sqrt(square));  // 1 - c, in units of 2^-200
  const int spare = static_cast<int>(BitLength<Integer>::Of(gap)) - 8;
  if (spare > 0) gap = ((gap >> spare) + 1) << spare;
  return std::max(Rational(0), F::Quotient(one - gap, one));
}

}  // namespace stiction
