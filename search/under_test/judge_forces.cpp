// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/judge_forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <variant>

#include "certify/exact/properties.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/record/kinds.h"
#include "corpus/rounded.h"
#include "search/under_test/solver_process.h"
#include "solver/problem/check.h"
#include "solver/problem/gate.h"
#include "solver/problem/lenient.h"

namespace stiction {
namespace {

using ForceVector = ExactProblem::Vector;

bool IsCoulombs(SolverLaw law, int dimension) {
  return law == SolverLaw::kFrictionless || law == SolverLaw::kCoulomb ||
         (law == SolverLaw::kPyramid && dimension == 2);
}

// What a condition misses, and its name.
struct Missed {
  Rational amount = 0;
  const char* name = "";

  void Add(const Rational& more, const char* of) {
    if (more > amount) *this = {more, of};
  }
};

// The conditions of a contact, by how much each is missed.
class ContactJudge {
 public:
  ContactJudge(const ExactProblem& problem, const ForceVector& f, const ForceVector& a,
               const LenientUnits<Rational>& units)
      : problem_(problem), f_(f), a_(a), units_(units) {
    layout_.Assign(problem.contacts, problem.dimension);
  }

  // Of all contacts, each row between its limits.
  Missed Within(const std::vector<Rational>& limits) const {
    Missed worst;
    for (int i = 0; i < layout_.ContactCount(); ++i) {
      const Missed missed = Of(i, &limits);
      worst.Add(missed.amount, missed.name);
    }
    return worst;
  }

  // `limits`: of the friction of each row, where they are not mu times the normal force.
  Missed Of(int contact, const std::vector<Rational>* limits) const {
    const int n = layout_.NormalRowOf(contact);
    Missed missed;
    if (problem_.contacts[contact].kind == ContactKind::kBilateral) {
      missed.Add(InAcceleration(abs(a_[n]), n), "moves");
      return missed;
    }
    missed.Add(InForce(-f_[n], n), "pulls");
    missed.Add(InAcceleration(-a_[n], n), "moves-inward");
    missed.Add(std::min(InForce(f_[n], n), InAcceleration(a_[n], n)), "presses-and-separates");
    if (!problem_.contacts[contact].HasFrictionRows()) return missed;
    if (limits != nullptr || problem_.dimension == 2) {
      for (int row = n + 1; row < n + problem_.dimension; ++row)
        AddFriction(f_[row], a_[row], limits != nullptr ? (*limits)[row] : LimitOf(contact, n),
                    units_.friction(contact), InAcceleration(abs(a_[row]), row), missed);
    } else {
      const Rational force = Length(f_[n + 1], f_[n + 2]);
      const Rational beyond = std::max<Rational>(0, force - LimitOf(contact, n));
      missed.Add(InUnits(beyond, units_.friction(contact)), "friction-beyond-limit");
    }
    return missed;
  }

 private:
  Rational LimitOf(int contact, int n) const {
    return problem_.contacts[contact].mu * std::max<Rational>(0, f_[n]);
  }
  static void AddFriction(const Rational& force, const Rational& a, const Rational& limit, const Rational& unit,
                          const Rational& slip, Missed& missed) {
    const auto in_unit = [&unit](const Rational& x) { return InUnits(std::max<Rational>(0, x), unit); };
    missed.Add(in_unit(Rational(abs(force) - limit)), "friction-beyond-limit");
    const bool drives = force * a > 0;
    const Rational below = drives ? Rational(abs(force) + limit) : Rational(limit - abs(force));
    missed.Add(std::min(in_unit(below), slip), drives ? "friction-drives-slip" : "slips-below-limit");
  }
  Rational InForce(const Rational& x, int row) const {
    return InUnits(std::max<Rational>(0, x), units_.force(row));
  }
  Rational InAcceleration(const Rational& x, int row) const {
    return InUnits(std::max<Rational>(0, x), units_.acceleration(row));
  }

  const ExactProblem& problem_;
  const ForceVector &f_, &a_;
  const LenientUnits<Rational>& units_;
  RowLayout<Eigen::Dynamic> layout_;
};

// Forces of the normals alone; empty where they are not unique, or not found.
std::optional<ForceVector> NormalForces(const ContactProblem<double>& posed) {
  const ContactProblem<double> normals = PosedFor(SolverLaw::kFrictionless, posed);
  if (!std::holds_alternative<LdltFactors>(DecideDefinite(Unrounded(normals).A))) return std::nullopt;
  return SolutionUnder(SolverLaw::kFrictionless, normals);
}

}  // namespace

bool Examined::Fails() const { return IsOfSolver(kind); }

std::string Examined::Signature(std::size_t contacts) const {
  STICTION_CHECK(Fails(), "a signature is of a failure");
  return fmt::format("{}{}{}-{}c", kind, what.empty() ? "" : "-", what, contacts);
}

std::optional<std::vector<Rational>> LimitsOf(const ContactProblem<double>& posed, SolverLaw law,
                                              const ForceVector& f) {
  std::vector<Rational> limits(posed.rows(), Rational(0));
  std::optional<ForceVector> normals;
  std::vector<double> fixed;
  if (law == SolverLaw::kBox) fixed = FixedBounds(posed);
  if (law == SolverLaw::kFindex && !(normals = NormalForces(posed))) return std::nullopt;
  ForEachContact(posed, [&](int i, int row, int count) {
    const Rational mu(posed.contacts[i].mu);
    const Rational limit = law == SolverLaw::kBox      ? Rational(fixed[i])
                           : law == SolverLaw::kFindex ? Rational(mu * abs((*normals)[i]))
                                                       : Rational(mu * std::max<Rational>(0, f[row]));
    for (int k = 1; k < count; ++k) limits[row + k] = limit;
  });
  return limits;
}

namespace {

// What forces of idle groups are, in units of the whole problem; they are set to zero where that is within the
// accuracy. Nothing where no force acts on any contact. Where A_ii = 0 a force does no work, has the unit of
// the largest force, and is taken for itself, for any may be right.
Rational TakeOutIdle(const ContactProblem<double>& posed, const Rational& accuracy, Eigen::VectorXd& f) {
  Groups groups;
  groups.Find(posed);
  std::vector<bool> idle(posed.contacts.size(), true);  // by the first contact of a group
  for (int i = 0; i < posed.rows(); ++i)
    if (posed.b[i] != 0) idle[groups.OfRow(i)] = false;
  const ExactProblem problem = Unrounded(posed);
  const ForceVector forces = f.unaryExpr([](double x) { return Rational(x); });
  const Rational given = abs(forces.dot(problem.b)), done = abs(forces.dot(problem.A * forces));
  const Rational work = std::min(given, done);
  if (work == 0) return 0;
  Rational most = 0, largest = 0, workless = 0;  // squared
  for (const Rational& force : forces) most = std::max<Rational>(most, force * force);
  for (int i = 0; i < posed.rows(); ++i) {
    if (!idle[groups.OfRow(i)]) continue;
    const Rational square = forces[i] * forces[i];
    if (posed.A(i, i) > 0) {
      largest = std::max<Rational>(largest, square * problem.A(i, i) / work);
    } else if (square <= accuracy * accuracy * most) {
      workless = std::max<Rational>(workless, square / most);
      f[i] = 0;
    }
  }
  if (largest > accuracy * accuracy) return SquareRoot<Rational>::Of(workless);
  for (int i = 0; i < posed.rows(); ++i)
    if (idle[groups.OfRow(i)] && posed.A(i, i) > 0) f[i] = 0;
  return SquareRoot<Rational>::Of(std::max(largest, workless));
}

// By the strict gate, which accuses more than is asked here: what it lets pass needs no rationals.
bool IsSolved(const ContactProblem<double>& posed, double accuracy, const Eigen::VectorXd& f) {
  return accuracy > 0 &&
         BoundErrors(posed, FrictionLaw::kCoulomb, f, GateOf<double>(accuracy)).Largest() <= accuracy;
}

Examined JudgeLoaded(const ContactProblem<double>& posed, SolverLaw law, const Rational& accuracy,
                     const Eigen::VectorXd& f) {
  Examined judged = {.kind = "passed", .what = "", .says_solved = true};
  const bool is_coulombs = IsCoulombs(law, posed.dimension);
  if (is_coulombs && IsSolved(posed, std::min(ToDouble(accuracy), kSolvedResidual<double>), f)) {
    const Eigen::VectorXd a = posed.A * f + posed.b;
    judged.error = std::min(MeasureLeniently(posed, FrictionLaw::kCoulomb, f, a).error, ToDouble(accuracy));
    return judged;
  }
  const ExactProblem problem = Unrounded(posed);
  const ForceVector exact_f = f.unaryExpr([](double x) { return Rational(x); });
  const ForceVector a = Accelerations(problem, exact_f);
  LenientUnits<Rational> units;
  const LenientError<Rational> found = MeasureLeniently(problem, FrictionLaw::kCoulomb, exact_f, a, units);
  const ContactJudge contacts(problem, exact_f, a, units);
  Rational error = found.error;
  Missed worst;
  if (is_coulombs) {
    if (error > accuracy) worst = contacts.Of(found.contact, nullptr);
  } else {
    const auto limits = LimitsOf(posed, law, exact_f);
    if (!limits) return {.kind = "unjudged", .what = "", .says_solved = true};
    worst = contacts.Within(*limits);
    judged.misses_coulomb = worst.amount <= accuracy && error > accuracy;
    error = worst.amount;
  }
  judged.error = ToDouble(error);
  if (error <= accuracy) {
    judged.is_neither = is_coulombs && !IsSolved(posed, ToDouble(accuracy), f);
    return judged;
  }
  // In space what is left is the direction of friction; in the plane a mode that is missed by a little in each
  // part.
  judged.what = worst.amount * 2 >= error ? worst.name : "friction-askew";
  judged.kind = "silent-wrong";
  return judged;
}

}  // namespace

Examined JudgeForces(const ContactProblem<double>& posed, SolverLaw law, const Rational& accuracy,
                     const Eigen::VectorXd& f) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!f.allFinite()) return {.kind = "not-finite", .what = "", .error = kInfinity, .says_solved = true};
  Examined judged = JudgeLoaded(posed, law, accuracy, f);
  if (judged.what.empty() && !judged.misses_coulomb) return judged;
  Eigen::VectorXd loaded = f;
  const Rational of_idle = TakeOutIdle(posed, accuracy, loaded);
  if (loaded == f) return judged;
  judged = JudgeLoaded(posed, law, accuracy, loaded);
  judged.error = std::max(judged.error, ToDouble(of_idle));
  return judged;
}

namespace {

// Under fixed bounds of friction, verified: with f = x - L for friction the problem without friction
//
//   u = A x + (b - A L) + v >= 0, x >= 0, u x = 0        s = 2 L - x >= 0, v >= 0, s v = 0
//
// by Lemke's method, v beside tangents alone. Empty where a contact is bilateral, or none is found.
std::optional<ForceVector> SolutionWithin(const ExactProblem& posed, const std::vector<Rational>& limits) {
  const auto is_held = [](const auto& contact) { return contact.kind == ContactKind::kBilateral; };
  if (std::any_of(posed.contacts.begin(), posed.contacts.end(), is_held)) return std::nullopt;
  std::vector<int> tangents;
  ForEachContact(posed, [&](int, int row, int count) {
    for (int k = 1; k < count; ++k) tangents.push_back(row + k);
  });
  const int rows = posed.rows(), bounded = static_cast<int>(tangents.size());
  ForceVector shift = ForceVector::Zero(rows);
  for (const int row : tangents) shift[row] = limits[row];
  ExactProblem doubled;
  doubled.contacts.assign(rows + bounded, {ContactKind::kFrictionless, 0, {}});
  doubled.A.setZero(rows + bounded, rows + bounded);
  doubled.A.topLeftCorner(rows, rows) = posed.A;
  doubled.b = ForceVector::Zero(rows + bounded);
  doubled.b.head(rows) = posed.b - posed.A * shift;
  for (int k = 0; k < bounded; ++k) {
    doubled.A(tangents[k], rows + k) = 1;
    doubled.A(rows + k, tangents[k]) = -1;
    doubled.b[rows + k] = 2 * limits[tangents[k]];
  }
  const ExactAnswer answer = Solve(doubled, {.method = "lemke"});
  if (!answer.Solved()) return std::nullopt;
  const ForceVector f = answer.f.head(rows) - shift;
  const ForceVector a = Accelerations(posed, f);
  LenientUnits<Rational> units;
  units.Take(posed, f);
  if (ContactJudge(posed, f, a, units).Within(limits).amount > 0) return std::nullopt;
  return f;
}

}  // namespace

std::optional<ForceVector> SolutionUnder(SolverLaw law, const ContactProblem<double>& posed) {
  ExactProblem exact = Unrounded(posed);
  if (law == SolverLaw::kBox || law == SolverLaw::kFindex) {
    const auto limits = LimitsOf(posed, law, ForceVector::Zero(posed.rows()));
    return limits ? SolutionWithin(exact, *limits) : std::nullopt;
  }
  if (law == SolverLaw::kFrictionless) exact.dimension = 2;  // normals are the same in space
  if (exact.dimension != 2) return std::nullopt;
  const ExactAnswer answer = Solve(exact, {.method = "complete"});
  if (!answer.Solved() || FindViolation(exact, answer.f)) return std::nullopt;
  return answer.f;
}

std::optional<ForceVector> NearSolution(const ContactProblem<double>& posed) {
  const auto answer = Solve(posed);
  if (!answer.Solved()) return std::nullopt;
  return answer.f.unaryExpr([](double x) { return Rational(x); });
}

}  // namespace stiction
