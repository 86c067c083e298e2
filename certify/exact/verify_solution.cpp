// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/verify_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace stiction {
namespace {

std::optional<std::string> Broken(int contact, const char* condition, const Rational& found) {
  return fmt::format("contact {}: {} is broken, found {}", contact + 1, condition, ToString(found));
}

std::optional<std::string> NormalViolation(int contact, const Rational& f, const Rational& a) {
  if (f < 0) return Broken(contact, "fN >= 0", f);
  if (a < 0) return Broken(contact, "aN >= 0", a);
  const Rational product = f * a;
  if (product != 0) return Broken(contact, "fN aN = 0", product);
  return std::nullopt;
}

std::optional<std::string> FrictionViolation(int contact, const Rational& bound, const Rational& f,
                                             const Rational& a) {
  const Rational slack = bound - abs(f);
  if (slack < 0) return Broken(contact, "abs(fF) <= mu fN", slack);
  const Rational power = a * f;
  if (power > 0) return Broken(contact, "aF fF <= 0", power);
  const Rational product = a * slack;
  if (product != 0) return Broken(contact, "aF (mu fN - abs(fF)) = 0", product);
  return std::nullopt;
}

std::optional<std::string> PlanarViolation(int i, const Contact<Rational>& law, int row,
                                           const ExactProblem::Vector& f, const ExactProblem::Vector& a) {
  if (law.kind == ContactKind::kBilateral) {
    return a[row] == 0 ? std::nullopt : Broken(i, "aN = 0", a[row]);
  }
  if (auto violation = NormalViolation(i, f[row], a[row])) return violation;
  if (!law.HasFrictionRows()) return std::nullopt;
  const Rational bound = law.mu * f[row];
  if (law.kind == ContactKind::kStatic) return FrictionViolation(i, bound, f[row + 1], a[row + 1]);
  const Rational excess = f[row + 1] + bound * law.slip[0];
  return excess == 0 ? std::nullopt : Broken(i, "fF + mu u fN = 0", excess);
}

// The rows of one contact in space, their forces and accelerations.
struct ContactInSpace {
  int number;
  const Contact<Rational>& law;
  Rational f_n, f_x, f_y, a_n, a_x, a_y;  // the tangential ones 0 without friction rows

  Rational Bound() const { return law.mu * f_n; }
  Rational Force() const { return f_x * f_x + f_y * f_y; }         // squared
  Rational Acceleration() const { return a_x * a_x + a_y * a_y; }  // squared
  Rational Power() const { return f_x * a_x + f_y * a_y; }
};

std::optional<std::string> CapViolation(const ContactInSpace& c) {
  const Rational slack = c.Bound() * c.Bound() - c.Force();
  if (slack < 0) return Broken(c.number, "fF.fF <= mu^2 fN^2", slack);
  if (c.Power() > 0) return Broken(c.number, "fF.aF <= 0", c.Power());
  return std::nullopt;
}

std::optional<std::string> WeakViolation(const ContactInSpace& c) {
  if (auto violation = CapViolation(c)) return violation;
  const Rational product = c.Acceleration() * (c.Bound() * c.Bound() - c.Force());
  if (product != 0) return Broken(c.number, "aF = 0 or abs(fF) = mu fN", product);
  return std::nullopt;
}

std::optional<std::string> CoulombViolation(const ContactInSpace& c, const Rational& bound) {
  if (auto violation = CapViolation(c)) return violation;
  const Rational limit = bound * c.Bound();
  const Rational excess = c.Power() * c.Power() - limit * limit * c.Acceleration();
  if (excess < 0) return Broken(c.number, "(fF.aF)^2 >= c^2 mu^2 fN^2 aF.aF", excess);
  return std::nullopt;
}

std::optional<std::string> SlidingViolation(const ContactInSpace& c) {
  for (const Rational& gap :
       {Rational(c.f_x + c.Bound() * c.law.slip[0]), Rational(c.f_y + c.Bound() * c.law.slip[1])}) {
    if (gap != 0) return Broken(c.number, "fF = -mu fN slip", gap);
  }
  return std::nullopt;
}

// static_violation(contact) is the condition of a static contact.
template <class StaticViolation>
std::optional<std::string> FindViolationInSpace(const ExactProblem& problem, const ExactProblem::Vector& f,
                                                StaticViolation static_violation) {
  const ExactProblem::Vector a = Accelerations(problem, f);
  int row = 0;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const Contact<Rational>& law = problem.contacts[i];
    const bool tangential = law.HasFrictionRows();
    const auto at = [&](const ExactProblem::Vector& values, int k) {
      return k == 0 || tangential ? values[row + k] : Rational(0);
    };
    const ContactInSpace c = {i, law, at(f, 0), at(f, 1), at(f, 2), at(a, 0), at(a, 1), at(a, 2)};
    std::optional<std::string> violation;
    if (law.kind == ContactKind::kBilateral) {
      if (c.a_n != 0) violation = Broken(i, "aN = 0", c.a_n);
    } else {
      violation = NormalViolation(i, c.f_n, c.a_n);
    }
    if (!violation && law.kind == ContactKind::kStatic) violation = static_violation(c);
    if (!violation && law.kind == ContactKind::kSliding) violation = SlidingViolation(c);
    if (violation) return violation;
    row += tangential ? 3 : 1;
  }
  return std::nullopt;
}

}  // namespace

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

std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f) {
  return FindViolation(problem, f, Accelerations(problem, f));
}

std::optional<std::string> FindViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                         const ExactProblem::Vector& a) {
  int row = 0;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    if (auto violation = PlanarViolation(i, problem.contacts[i], row, f, a)) return violation;
    row += problem.contacts[i].HasFrictionRows() ? 2 : 1;
  }
  return std::nullopt;
}

std::optional<std::string> FindWeakViolation(const ExactProblem& problem, const ExactProblem::Vector& f) {
  return FindViolationInSpace(problem, f, WeakViolation);
}

std::optional<std::string> FindCoulombViolation(const ExactProblem& problem, const ExactProblem::Vector& f,
                                                const Rational& bound) {
  return FindViolationInSpace(problem, f,
                              [&bound](const ContactInSpace& c) { return CoulombViolation(c, bound); });
}

}  // namespace stiction
