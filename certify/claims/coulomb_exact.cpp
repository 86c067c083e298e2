// SPDX-License-Identifier: Apache-2.0
// `coulomb-exact`: within a box there is a solution of Coulomb's law in space, with no bound on an angle.
//
// Directions of slip are roots, so that in general no solution is rational. Where modes are given, a solution
// is a zero of quadratic equations F, and Krawczyk's test shows over rationals that a box X around x has one:
// with any Y,
//
//   x - Y F(x) + (I - Y F'(X)) (X - x)   lies inside X.
//
// Of each contact
//
//   mode    unknowns              equations                                      positive in all of X
//   hold    fN                    aN = 0
//   break                                                                        aN
//   touch   fN                    aN = 0                                         fN
//   stick   fN, fF                aN = 0, aF = 0                                 fN, mu^2 fN^2 - fF.fF
//   slip    fN, (c, s), v         aN = 0, c^2 + s^2 = 1, aF = v (c, s)           fN, v
//
// with fF = -mu fN (c, s) where it slips, fF = -mu fN slip of a sliding contact. Rows of A and b with a = 0
// that follow from others by given weights have neither equation nor unknown: their forces are given.
// certificates.md has the proof.
#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "certify/claims/certificate.h"
#include "certify/claims/claim.h"
#include "certify/claims/existence.h"
#include "certify/exact/bodies.h"
#include "certify/exact/centring.h"
#include "certify/exact/dependent_rows.h"
#include "certify/exact/krawczyk.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "corpus/rounded.h"
#include "solver/problem/gate.h"
#include "solver/problem/units.h"
#include "solver/solve.h"

namespace stiction {
namespace {

// ---- Unknowns ----------------------------------------------------------------------------------

enum class Behavior : std::uint8_t { kHold, kBreak, kTouch, kStick, kSlip };
constexpr std::array<std::string_view, 5> kBehaviors = {"hold", "break", "touch", "stick", "slip"};

std::vector<Behavior> BehaviorsOf(const Contact<Rational>& contact) {
  using enum Behavior;
  if (contact.kind == ContactKind::kBilateral) return {kHold};
  if (contact.kind == ContactKind::kStatic && contact.mu > 0) return {kBreak, kStick, kSlip};
  return {kBreak, kTouch};
}

// The numbers of the unknowns, contact by contact: forces, then direction and speed of slip.
struct Layout {
  std::vector<Behavior> behaviors;
  std::vector<int> normal;              // row by contact
  std::vector<std::vector<int>> still;  // by contact: rows with a = 0
  std::vector<bool> fixed;              // by row: its force is given
  std::vector<int> kept;                // rows with a = 0 whose forces are unknowns
  std::vector<int> force;               // unknown by row
  std::vector<int> slip;                // unknown c by contact, before s and v
  int size = 0;

  // Of the modes alone; Fix is to follow.
  template <class Problem>
  Layout(const Problem& problem, std::vector<Behavior> modes) : behaviors(std::move(modes)) {
    int row = 0;
    for (std::size_t i = 0; i < behaviors.size(); ++i) {
      normal.push_back(row);
      const int count = behaviors[i] == Behavior::kStick ? 3 : behaviors[i] == Behavior::kBreak ? 0 : 1;
      auto& rows = still.emplace_back(count);
      std::iota(rows.begin(), rows.end(), row);
      row += problem.contacts[i].HasFrictionRows() ? 3 : 1;
    }
    Fix(std::vector<bool>(row, false));
  }

  void Fix(std::vector<bool> rows) {
    fixed = std::move(rows);
    kept.clear();
    force.assign(fixed.size(), -1);
    slip.assign(behaviors.size(), -1);
    size = 0;
    for (std::size_t i = 0; i < behaviors.size(); ++i) {
      for (const int row : still[i]) {
        if (fixed[row]) continue;
        kept.push_back(row);
        force[row] = size++;
      }
      if (behaviors[i] != Behavior::kSlip) continue;
      slip[i] = size;
      size += 3;
    }
  }
};

// ---- Equations ---------------------------------------------------------------------------------

// What is positive.
enum class Positive : std::uint8_t { kForce, kCone, kAcceleration, kSpeed };
std::string_view Name(Positive kind) {
  constexpr std::array<std::string_view, 4> kNames = {"fN", "mu^2 fN^2 - fF.fF", "aN", "the speed of slip"};
  return kNames[static_cast<int>(kind)];
}

template <class Scalar>
struct Condition {
  int contact;
  Positive kind;
  Quadratic<Scalar> q;
};

// Equations and strict inequalities of the modes, at one point.
template <class Scalar>
class BoxSystem {
 public:
  using Vector = typename ContactProblem<Scalar>::Vector;
  using Matrix = typename ContactProblem<Scalar>::Matrix;

  // `given`: forces by row, of fixed rows. x: the unknowns.
  BoxSystem(const ContactProblem<Scalar>& problem, const Layout& layout, const Vector& given, const Vector& x)
      : problem_(problem), layout_(layout), x_(x), f_(problem.rows(), Constant(Scalar(0))) {
    for (std::size_t i = 0; i < layout.behaviors.size(); ++i) SetForces(static_cast<int>(i), given);
    for (std::size_t i = 0; i < layout.behaviors.size(); ++i) AddConditions(static_cast<int>(i));
  }

  Vector Values() const {
    Vector values(equations_.size());
    for (int k = 0; k < values.size(); ++k) values[k] = equations_[k].value;
    return values;
  }

  Matrix Slopes() const {
    Matrix slopes(equations_.size(), layout_.size);
    for (int k = 0; k < slopes.rows(); ++k)
      for (int j = 0; j < layout_.size; ++j) slopes(k, j) = equations_[k].slopes[j];
    return slopes;
  }

  const std::vector<Quadratic<Scalar>>& equations() const { return equations_; }
  const std::vector<Condition<Scalar>>& positive() const { return positive_; }
  const Quadratic<Scalar>& f(int row) const { return f_[row]; }

 private:
  using Q = Quadratic<Scalar>;

  Q Constant(const Scalar& value) const {
    return {value, std::vector<Scalar>(layout_.size, Scalar(0)), Scalar(0)};
  }
  Q Unknown(int k) const {
    Q q = Constant(x_[k]);
    q.slopes[k] = Scalar(1);
    return q;
  }
  // Of linear functions.
  Q Product(const Scalar& factor, const Q& p, const Q& q) const {
    Q product = Constant(Scalar(0));
    product.Add(factor * q.value, p);
    product.Add(factor * p.value, q);
    product.value = factor * p.value * q.value;
    Scalar of_p = Scalar(0), of_q = Scalar(0);
    for (int k = 0; k < layout_.size; ++k) {
      of_p += Abs(p.slopes[k]);
      of_q += Abs(q.slopes[k]);
    }
    product.bend = Abs(factor) * of_p * of_q;
    return product;
  }
  Q Acceleration(int row) const {
    Q a = Constant(problem_.b[row]);
    for (int j = 0; j < problem_.rows(); ++j) a.Add(problem_.A(row, j), f_[j]);
    return a;
  }

  void SetForces(int i, const Vector& given) {
    const Contact<Scalar>& contact = problem_.contacts[i];
    const int normal = layout_.normal[i];
    for (const int row : layout_.still[i])
      f_[row] = layout_.fixed[row] ? Constant(given[row]) : Unknown(layout_.force[row]);
    for (int k = 0; k < 2; ++k) {
      if (layout_.behaviors[i] == Behavior::kSlip)
        f_[normal + 1 + k] = Product(-contact.mu, f_[normal], Unknown(layout_.slip[i] + k));
      if (layout_.behaviors[i] == Behavior::kTouch && contact.kind == ContactKind::kSliding)
        f_[normal + 1 + k] = Product(-contact.mu, f_[normal], Constant(contact.slip[k]));
    }
  }

  void AddConditions(int i) {
    const Behavior behavior = layout_.behaviors[i];
    const int normal = layout_.normal[i], slip = layout_.slip[i];
    for (const int row : layout_.still[i])
      if (!layout_.fixed[row]) equations_.push_back(Acceleration(row));
    if (behavior == Behavior::kSlip) {
      const Q c = Unknown(slip), s = Unknown(slip + 1), speed = Unknown(slip + 2);
      Q circle = Constant(Scalar(-1));
      circle.Add(Scalar(1), Product(Scalar(1), c, c));
      circle.Add(Scalar(1), Product(Scalar(1), s, s));
      equations_.push_back(std::move(circle));
      for (int k = 0; k < 2; ++k) {
        Q& along = equations_.emplace_back(Acceleration(normal + 1 + k));
        along.Add(Scalar(-1), Product(Scalar(1), speed, k == 0 ? c : s));
      }
      positive_.push_back({i, Positive::kSpeed, speed});
    }
    if (behavior != Behavior::kBreak && behavior != Behavior::kHold)
      positive_.push_back({i, Positive::kForce, f_[normal]});
    if (behavior == Behavior::kStick) {
      const Scalar& mu = problem_.contacts[i].mu;
      Q cone = Product(mu * mu, f_[normal], f_[normal]);
      for (int k = 1; k <= 2; ++k) cone.Add(Scalar(-1), Product(Scalar(1), f_[normal + k], f_[normal + k]));
      positive_.push_back({i, Positive::kCone, std::move(cone)});
    }
    if (behavior == Behavior::kBreak) positive_.push_back({i, Positive::kAcceleration, Acceleration(normal)});
  }

  const ContactProblem<Scalar>& problem_;
  const Layout& layout_;
  const Vector x_;
  std::vector<Q> f_;  // by row
  std::vector<Q> equations_;
  std::vector<Condition<Scalar>> positive_;
};

// ---- Checking ----------------------------------------------------------------------------------

struct FixedForce {
  Rational f;
  ExactVector weights;  // of the rows that are kept
};
using FixedForces = std::map<int, FixedForce>;  // by row

ExactVector Given(const FixedForces& fixed, int rows) {
  ExactVector given = ExactVector::Constant(rows, Rational(0));
  for (const auto& [row, force] : fixed) given[row] = force.f;
  return given;
}

std::vector<Behavior> ReadBehaviors(const Json& json, const ExactProblem& problem) {
  RequireList(json, "witness.modes", problem.contacts.size(), "modes");
  std::vector<Behavior> behaviors;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    std::vector<std::string_view> names;
    for (const Behavior behavior : BehaviorsOf(problem.contacts[i]))
      names.push_back(kBehaviors[static_cast<int>(behavior)]);
    const auto* name = json[i].get_ptr<const std::string*>();  // null if it is no text
    if (name == nullptr || std::ranges::find(names, *name) == names.end())
      throw Rejected{ElementPath("witness.modes", static_cast<int>(i)), Shown(json[i]),
                     fmt::format("one of {}", fmt::join(names, ", "))};
    behaviors.push_back(static_cast<Behavior>(std::ranges::find(kBehaviors, *name) - kBehaviors.begin()));
  }
  return behaviors;
}

// In the order of rows, each of which has a = 0; the layout has them then.
FixedForces ReadFixed(const Json& json, Layout& layout) {
  RequireList(json, "witness.fixed");
  std::vector<bool> fixed(layout.fixed.size(), false);
  int last = -1;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const std::string path = ElementPath("witness.fixed", static_cast<int>(k));
    RequireKeys(json[k], path, {"f", "row", "weights"});
    const std::int64_t row = ReadInteger(json[k]["row"], path + ".row", last + 1);
    if (row >= std::ssize(layout.force) || layout.force[row] < 0)
      throw Rejected{path + ".row", std::to_string(row), "a row whose acceleration is zero"};
    last = static_cast<int>(row);
    fixed[last] = true;
  }
  layout.Fix(std::move(fixed));
  FixedForces forces;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const std::string path = ElementPath("witness.fixed", static_cast<int>(k));
    forces[json[k]["row"].get<int>()] = {
        ReadNumber(json[k]["f"], path + ".f"),
        ReadVector(json[k]["weights"], path + ".weights", static_cast<int>(layout.kept.size()))};
  }
  return forces;
}

ExactMatrix ReadSquare(const Json& json, const std::string& path, int size) {
  RequireList(json, path, static_cast<std::size_t>(size), "rows");
  ExactMatrix M(size, size);
  for (int i = 0; i < size; ++i) M.row(i) = ReadVector(json[i], ElementPath(path, i), size).transpose();
  return M;
}

// Of Krawczyk's test.
double BoxOperations(const ExactProblem& problem, std::size_t fixed, std::int64_t unknowns) {
  const auto size = static_cast<double>(std::max<std::int64_t>(unknowns, 0));
  return ProductOperations(problem.rows(), 2 * static_cast<double>(fixed) + 4) +
         ProductOperations(size, 2 * size + 4);
}

// Of all that is multiplied with each other.
void RequireCheap(const ExactProblem& problem, int size, const FixedForces& fixed, const ExactVector& x,
                  const Rational& radius, const ExactMatrix& inverse) {
  std::vector<Rational> point(x.data(), x.data() + x.size()), friction, weights;
  point.push_back(radius);
  for (const auto& [row, force] : fixed) {
    point.push_back(force.f);
    weights.insert(weights.end(), force.weights.begin(), force.weights.end());
  }
  for (const Contact<Rational>& contact : problem.contacts)
    friction.insert(friction.end(), {contact.mu, contact.slip[0], contact.slip[1]});
  Cost(BoxOperations(problem, fixed.size(), size))
      .LongestRow(problem)
      .Numbers(point, 2)
      .Numbers(friction, 2)
      .Numbers({inverse.data(), static_cast<std::size_t>(inverse.size())})
      .Numbers(weights);
}

// Where the rows that are kept have a = 0, fixed ones have it, whatever the forces.
void RequireDependence(const ExactProblem& problem, const std::vector<int>& kept, const FixedForces& fixed) {
  const int rows = problem.rows();
  const auto entry = [&](int i, int j) -> const Rational& { return j < rows ? problem.A(i, j) : problem.b[i]; };
  for (const auto& [row, force] : fixed) {
    std::vector<int> weighty;
    for (int k = 0; k < force.weights.size(); ++k)
      if (force.weights[k] != 0) weighty.push_back(k);
    for (int j = 0; j <= rows; ++j) {
      Rational sum = 0;
      for (const int k : weighty)
        if (entry(kept[k], j) != 0) sum += force.weights[k] * entry(kept[k], j);
      RequireEqual(sum, entry(row, j), fmt::format("witness.fixed: row {}, column {}", row, j));
    }
  }
}

Json CheckCoulombExact(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"fixed", "inverse", "modes", "radius", "x"});
  if (problem.dimension != 3) throw Rejected{"problem.dimension", "2", "3: this claim is checked in space"};
  Layout layout(problem, ReadBehaviors(witness["modes"], problem));
  const Rational radius = ReadNumber(witness["radius"], "witness.radius");
  if (radius <= 0) throw Rejected{"witness.radius", ToString(radius), "a number > 0"};
  RequireList(witness["fixed"], "witness.fixed");
  const std::size_t fixed_rows = witness["fixed"].size();  // that they are as many is seen below
  Cost(BoxOperations(problem, fixed_rows, layout.size - static_cast<std::int64_t>(fixed_rows)));
  const FixedForces fixed = ReadFixed(witness["fixed"], layout);
  const ExactVector x = ReadVector(witness["x"], "witness.x", layout.size);
  const ExactMatrix inverse = ReadSquare(witness["inverse"], "witness.inverse", layout.size);
  RequireCheap(problem, layout.size, fixed, x, radius, inverse);
  RequireDependence(problem, layout.kept, fixed);
  const ExactVector given = Given(fixed, problem.rows());
  const BoxSystem<Rational> system(problem, layout, given, x);
  if (const auto leaving = FindLeaving(system.equations(), inverse, radius))
    throw Rejected{ElementPath("witness.inverse", leaving->first),
                   fmt::format("{:.3g} radii", ToDouble(leaving->second / radius)),
                   "a distance below the radius, as Krawczyk's test asks for"};
  for (const Condition<Rational>& condition : system.positive())
    if (condition.q.Least(radius) <= 0)
      throw Rejected{ElementPath("witness.modes", condition.contact), "a number <= 0 somewhere in the box",
                     fmt::format("{} > 0", Name(condition.kind))};
  return {{"unknowns", layout.size}, {"radius", ToString(radius)}};
}

// ---- Making ------------------------------------------------------------------------------------

using Doubles = ContactProblem<double>;

// Why nothing is shown.
struct NothingShown {
  std::string why;
};

// Strict inequalities count that hold by so much of their units.
constexpr double kNondegenerate = 1e-6;

Doubles InDoubles(const ExactProblem& problem) {
  try {
    return Rounded<double>(problem);
  } catch (const InputError&) {
    throw NothingShown{"doubles do not hold the problem"};
  }
}

// Forces near which a solution is looked for.
Doubles::Vector ForcesNear(const Doubles& problem, const Limits& limits) {
  for (const std::string_view method : {"fast", "complete"}) {
    const Answer<double> answer = Solve(problem, {.method = method, .limits = limits});
    if (answer.Solved()) return answer.f;
  }
  throw NothingShown{"no forces were found near which to look"};
}

// The same in factors: in the middle of their cones.
Doubles::Vector ForcesOfBodies(const ExactFactors& factors, const Limits& limits) {
  InexactAnswer answer = SolveByBodies(factors, {.method = kInteriorPoint, .limits = limits});
  if (!answer.Solved()) throw NothingShown{"no forces were found near which to look"};
  return std::move(answer.f);
}

// Of every contact, the largest of its rows.
struct ContactUnits {
  std::vector<double> force, acceleration;
};

// Of forces by what acts, of accelerations by what the gate asks of them: beside a jam a slow slip is one.
ContactUnits UnitsOf(const Doubles& problem, const Doubles::Vector& f) {
  LenientUnits<double> of_rows;
  of_rows.Take(problem, f);
  GateMeter<double> gate;
  gate.Bound(problem, FrictionLaw::kCoulomb, f, GateOf<double>());
  ContactUnits units;
  ForEachContact(problem, [&](int, int first, int rows) {
    double force = 0, acceleration = 0;
    for (int row = first; row < first + rows; ++row) {
      force = std::max(force, of_rows.force(row));
      acceleration = std::max(acceleration, gate.meter().unit(row));
    }
    units.force.push_back(force > 0 ? force : 1);
    units.acceleration.push_back(acceleration > 0 ? acceleration : 1);
  });
  return units;
}

// What accelerations say; forces may rest on the edge of a cone although others with the same accelerations do
// not.
std::vector<Behavior> BehaviorsNear(const ExactProblem& problem, const Doubles::Vector& a,
                                    const ContactUnits& units) {
  std::vector<Behavior> behaviors;
  ForEachContact(problem, [&](int i, int row, int) {
    const auto allowed = BehaviorsOf(problem.contacts[i]);
    const double zero = kNondegenerate * units.acceleration[i];
    if (allowed.size() == 1 || a[row] > zero) {
      behaviors.push_back(allowed[0]);
    } else {
      const bool slips = allowed.size() == 3 && std::hypot(a[row + 1], a[row + 2]) > zero;
      behaviors.push_back(slips ? Behavior::kSlip : allowed[1]);
    }
  });
  return behaviors;
}

// What one newton in a row with a = 0 does, friction along with it.
Doubles::Vector ColumnOf(const Doubles& problem, const Layout& layout, int i, int row,
                         const Doubles::Vector& a) {
  Doubles::Vector column = problem.A.col(row);
  const Contact<double>& contact = problem.contacts[i];
  std::array<double, 2> along = {0, 0};
  if (layout.behaviors[i] == Behavior::kTouch) along = contact.slip;
  if (layout.behaviors[i] == Behavior::kSlip) {
    const double speed = std::hypot(a[row + 1], a[row + 2]);
    along = {a[row + 1] / speed, a[row + 2] / speed};
  }
  for (int k = 0; k < 2; ++k)
    if (along[k] != 0) column -= contact.mu * along[k] * problem.A.col(row + 1 + k);
  return column;
}

// Whether all contacts that touch have their forces clearly inside of their cones.
bool AreInside(const Doubles& problem, const Layout& layout, const Doubles::Vector& f,
               const ContactUnits& units) {
  for (std::size_t i = 0; i < layout.still.size(); ++i) {
    const int row = layout.normal[i];
    const double edge = 10 * kNondegenerate * units.force[i], mu = problem.contacts[i].mu;
    const bool sticks = layout.behaviors[i] == Behavior::kStick;
    const bool touches = layout.behaviors[i] != Behavior::kBreak && layout.behaviors[i] != Behavior::kHold;
    if (touches && !(f[row] > edge)) return false;
    if (sticks && !(mu * f[row] - TangentLength(f, row, 3) > std::min(1.0, mu) * edge)) return false;
  }
  return true;
}

// Forces of the rows with a = 0, in the order of `kept` with nothing fixed: inside their cones, if others with
// the same accelerations are.
Eigen::VectorXd CentredForces(const Doubles& problem, const Layout& layout, const Doubles::Vector& f,
                              const Doubles::Vector& a) {
  const int count = static_cast<int>(layout.kept.size());
  Eigen::MatrixXd columns(count, problem.rows());  // transposed
  Eigen::VectorXd z(count);
  std::vector<CentredCone> cones;
  int at = 0;
  for (std::size_t i = 0; i < layout.still.size(); ++i) {
    const Behavior behavior = layout.behaviors[i];
    if (behavior == Behavior::kStick) cones.push_back({at, problem.contacts[i].mu, true});
    if (behavior == Behavior::kTouch || behavior == Behavior::kSlip) cones.push_back({at, 1, false});
    for (const int row : layout.still[i]) {
      z[at] = f[row];
      columns.row(at++) = ColumnOf(problem, layout, static_cast<int>(i), row, a).transpose();
    }
  }
  if (count == 0 || cones.empty()) return z;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(columns);
  factors.setThreshold(1e-10);
  const Eigen::MatrixXd all = factors.householderQ() * Eigen::MatrixXd::Identity(count, count);
  const Eigen::MatrixXd unfelt = all.rightCols(count - factors.rank());
  const double scale = z.cwiseAbs().maxCoeff();
  if (unfelt.cols() == 0 || scale == 0) return z;
  return scale * Centred(z / scale, unfelt, cones);
}

// The rows of (A b), or those of (J c), of which the same follow from others.
ExactMatrix RowsOf(const ExactProblem& problem, const ExactFactors* factors) {
  const int rows = problem.rows(), last = factors != nullptr ? static_cast<int>(factors->w.size()) : rows;
  ExactMatrix M(rows, last + 1);
  M.leftCols(last) = factors != nullptr ? ExactMatrix(factors->A.J()) : problem.A;
  M.col(last) = factors != nullptr ? factors->c : problem.b;
  return M;
}

// Fixes rows that follow from others; their forces are to be set.
FixedForces FixDependent(const ExactProblem& problem, const ExactFactors* factors, const Doubles& rounded,
                         Layout& layout) {
  const std::vector<int> zero = layout.kept;
  const int count = static_cast<int>(zero.size());
  if (count == 0) return {};
  Eigen::MatrixXd columns(problem.rows(), count);
  for (int k = 0; k < count; ++k) columns.col(k) = rounded.A.row(zero[k]).transpose();
  const auto order = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).colsPermutation().indices();
  std::vector<int> ordered;  // as doubles would take them
  for (int k = 0; k < count; ++k) ordered.push_back(zero[order[k]]);
  FixedForces forces;
  std::vector<bool> fixed(problem.rows(), false);
  for (auto& [row, weights] : WeightsOfDependent(RowsOf(problem, factors), ordered)) {
    forces[row].weights = std::move(weights);
    fixed[row] = true;
  }
  layout.Fix(std::move(fixed));
  return forces;
}

// The nearest multiple of 2^-places.
Rational Short(const Rational& x, int places) {
  const mpz_class unit = mpz_class(1) << std::max(places, 0);
  mpz_class multiple = 2 * x.get_num() * unit + x.get_den();
  mpz_fdiv_q(multiple.get_mpz_t(), multiple.get_mpz_t(), mpz_class(2 * x.get_den()).get_mpz_t());
  Rational result(multiple, unit);
  result.canonicalize();
  return result;
}

// So many binary digits of the largest.
int PlacesOf(double largest, int digits) { return largest > 0 ? digits - std::ilogb(largest) - 1 : digits; }

Doubles::Vector FirstUnknowns(const Layout& layout, const Doubles::Vector& f, const Doubles::Vector& a) {
  Doubles::Vector x(layout.size);
  for (const int row : layout.kept) x[layout.force[row]] = f[row];
  for (std::size_t i = 0; i < layout.slip.size(); ++i) {
    if (layout.slip[i] < 0) continue;
    const double u = a[layout.normal[i] + 1], v = a[layout.normal[i] + 2], speed = std::hypot(u, v);
    x.segment(layout.slip[i], 3) << u / speed, v / speed, speed;
  }
  return x;
}

// Newton's method over doubles.
void Improve(const Doubles& problem, const Layout& layout, const Doubles::Vector& given, Doubles::Vector& x) {
  for (int step = 0; step < 30 && x.size() > 0; ++step) {
    const BoxSystem<double> system(problem, layout, given, x);
    const Doubles::Vector change = system.Slopes().partialPivLu().solve(system.Values());
    x -= change;
    if (!x.allFinite()) throw NothingShown{"Newton's method does not end near the forces that were found"};
    if (change.cwiseAbs().maxCoeff() <= 1e-14 * x.cwiseAbs().maxCoeff()) return;
  }
}

// By how much of its unit a strict inequality holds.
double MarginOf(const Condition<double>& condition, const Doubles& problem, const BoxSystem<double>& system,
                const Layout& layout, const ContactUnits& units) {
  const int i = condition.contact;
  const double value = condition.q.value;
  switch (condition.kind) {
    case Positive::kForce:
      return value / units.force[i];
    case Positive::kCone: {
      const double mu = problem.contacts[i].mu, limit = mu * system.f(layout.normal[i]).value;  // > 0 by then
      return value / (2 * limit * std::min(1.0, mu) * units.force[i]);
    }
    case Positive::kAcceleration:
    case Positive::kSpeed:
      return value / units.acceleration[i];
  }
  return 0;
}

void RequireNondegenerate(const Doubles& problem, const Layout& layout, const BoxSystem<double>& system,
                          const ContactUnits& units) {
  for (const Condition<double>& condition : system.positive()) {
    const double margin = MarginOf(condition, problem, system, layout, units);
    if (margin >= kNondegenerate) continue;
    throw NothingShown{
        fmt::format("near the forces that were found contact {} would {}, and {} is {:.1g} of its unit, "
                    "expected {:.0e} at least",
                    condition.contact + 1, kBehaviors[static_cast<int>(layout.behaviors[condition.contact])],
                    Name(condition.kind), margin, kNondegenerate)};
  }
}

// Newton's method over rationals with a fixed matrix.
ExactVector Refined(const ExactProblem& problem, const Layout& layout, const ExactVector& given,
                    const ExactMatrix& inverse, const Doubles::Vector& near, int places) {
  const auto shorter = [places](const Rational& x) { return Short(x, places + 5); };
  ExactVector x = near.unaryExpr([&](double value) { return shorter(Rational(value)); });
  const Rational enough = Rational(1) / (mpz_class(8) << places);
  for (int step = 0; step < 8; ++step) {
    const ExactVector change = inverse * BoxSystem<Rational>(problem, layout, given, x).Values();
    if (std::ranges::all_of(change, [&](const Rational& value) { return abs(value) < enough; })) break;
    x = ExactVector(x - change).unaryExpr(shorter);
  }
  return x;
}

ExactMatrix ShortInverse(const Eigen::MatrixXd& inverse, int digits) {
  ExactMatrix result(inverse.rows(), inverse.cols());
  for (int i = 0; i < inverse.rows(); ++i) {
    const int places = PlacesOf(inverse.row(i).cwiseAbs().maxCoeff(), digits);
    for (int j = 0; j < inverse.cols(); ++j) result(i, j) = Short(Rational(inverse(i, j)), places);
  }
  return result;
}

Json BoxWitness(const Layout& layout, const FixedForces& fixed, const ExactVector& x,
                const ExactMatrix& inverse, int places) {
  Json modes = Json::array(), given = Json::array();
  for (const Behavior behavior : layout.behaviors) modes.push_back(kBehaviors[static_cast<int>(behavior)]);
  for (const auto& [row, force] : fixed)
    given.push_back({{"row", row}, {"f", ToString(force.f)}, {"weights", ListJson(force.weights)}});
  return {{"modes", modes},
          {"fixed", given},
          {"x", ListJson(x)},
          {"inverse", RowsJson(inverse)},
          {"radius", ToString(Rational(1) / (mpz_class(1) << places))}};
}

// Boxes are tried from a usual size on, until one is right.
Json FindBox(const ExactProblem& problem, const Layout& layout, const FixedForces& fixed,
             const Doubles::Vector& near, const Eigen::MatrixXd& inverse) {
  const ExactVector given = Given(fixed, problem.rows());
  for (const int places : {40, 30, 60, 90, 20}) {
    for (const int digits : {20, 52}) {
      const ExactMatrix Y = ShortInverse(inverse, digits);
      const ExactVector x = Refined(problem, layout, given, Y, near, places);
      const Json witness = BoxWitness(layout, fixed, x, Y, places);
      if (!FindFault(CheckCoulombExact, problem, witness))
        return MakeCertificate("coulomb-exact", problem, witness);
    }
  }
  throw NothingShown{"Krawczyk's test fails in boxes of all sizes that were tried"};
}

Json CertifyBox(const ExactProblem& problem, const ExactFactors* factors, const Limits& limits) {
  const Doubles rounded = InDoubles(problem);
  Doubles::Vector f = factors != nullptr ? ForcesOfBodies(*factors, limits) : ForcesNear(rounded, limits);
  const Doubles::Vector a = rounded.A * f + rounded.b;
  const ContactUnits units = UnitsOf(rounded, f);
  Layout layout(problem, BehaviorsNear(problem, a, units));
  const bool centred_already = factors != nullptr && AreInside(rounded, layout, f, units);
  const Eigen::VectorXd centred =
      centred_already ? Eigen::VectorXd(f(layout.kept)) : CentredForces(rounded, layout, f, a);
  for (std::size_t k = 0; k < layout.kept.size(); ++k) f[layout.kept[k]] = centred[k];
  if (!f.allFinite()) throw NothingShown{"no forces were found in the middle of those that are allowed"};
  FixedForces fixed = FixDependent(problem, factors, rounded, layout);
  Doubles::Vector given = Doubles::Vector::Zero(f.size());
  for (auto& [row, force] : fixed) {
    force.f = Short(Rational(f[row]), PlacesOf(centred.cwiseAbs().maxCoeff(), 30));
    given[row] = ToDouble(force.f);
  }
  Doubles::Vector x = FirstUnknowns(layout, f, a);
  Improve(rounded, layout, given, x);
  const BoxSystem<double> system(rounded, layout, given, x);
  RequireNondegenerate(rounded, layout, system, units);
  const Eigen::MatrixXd inverse = system.Slopes().inverse();
  if (!inverse.allFinite()) throw NothingShown{"the equations of these modes are singular over doubles"};
  return FindBox(problem, layout, fixed, x, inverse);
}

SharedJson BoxByFactors(const ExactProblem& problem, const ExactFactors& factors, const Request& request) {
  if (problem.rows() <= MostExactRows(problem.dimension)) return {};
  try {
    return CertifyBox(problem, &factors, request.limits);
  } catch (const NothingShown&) {
    return {};
  }
}

// Where no box is found, there may be no solution at all.
ClaimAnswer OfCoulombExact(const ExactProblem& problem, const Request& request, const std::vector<Policy>&,
                           const EnumerationWatch& watch) {
  try {
    return ByCertificate(CertifyBox(problem, nullptr, request.limits));
  } catch (const NothingShown& nothing) {
    const SharedJson found =
        DecideExistence(problem, {.law = FrictionLaw::kCoulomb, .limits = request.limits}, watch).certificate;
    const bool none = found && found->at("claim") == "no-solution";
    return ByCertificate(none ? found : SharedJson(), nothing.why);
  }
}

}  // namespace

ClaimRows CoulombExactClaims() {
  static constexpr Claim kClaims[] = {
      Claim{"coulomb-exact", CheckCoulombExact,
            "within a box there is a solution of Coulomb's law itself, in space", OfCoulombExact, RequireSpace,
            "within a box there are forces that meet Coulomb's law", false, BoxByFactors}};
  return {15, kClaims};
}

}  // namespace stiction
