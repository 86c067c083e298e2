// SPDX-License-Identifier: Apache-2.0
#include "solver/numeric/refine.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/problem/gate.h"
#include "solver/problem/lenient.h"
#include "solver/problem/pressing.h"
#include "solver/problem/row_scale.h"

namespace stiction {
namespace {

using RefinedProblem = ContactProblem<double>;
using RefinedVector = RefinedProblem::Vector;

constexpr int kMostRows = 1200;     // beyond which a dense factorization takes too long
constexpr int kFewRows = 60;        // up to which it is tried whatever is missed
constexpr int kRounds = 4;          // of modes that change
constexpr int kSteps = 4;           // of Newton's method, for given modes
constexpr double kShift = 1e-9;     // beside diagonals of about 1
constexpr double kHopeless = 1e-3;  // backward errors that no noise explains
constexpr double kTouches = 1e-9;   // of all that acts at a contact without force: beyond, it separates
constexpr double kNoise = 1024;     // taus of the largest force: less is nothing, if need be
constexpr double kRank = 1e-11;     // of the largest pivot: what is smaller is rounding

// Onto the limit mu fN, which changes less by fN where mu > 1.
void Limit(const Contact<double>& contact, int tangents, double* fN, double* fF) {
  const double force = tangents == 1 ? std::abs(fF[0]) : std::hypot(fF[0], fF[1]);
  const double limit = contact.mu * *fN;
  if (force == 0 || force == limit) return;
  if (contact.mu > 1) {
    *fN = force / contact.mu;
    return;
  }
  for (int k = 0; k < tangents; ++k) fF[k] *= limit / force;
}

void CleanContact(const Contact<double>& contact, Motion motion, int tangents, const double* a, double* f) {
  if (contact.kind == ContactKind::kBilateral) return;
  if (motion == Motion::kSeparates || !(f[0] > 0)) {
    std::fill(f, f + tangents + 1, 0.0);
    return;
  }
  if (tangents == 0) return;
  if (contact.kind == ContactKind::kSliding) {
    for (int k = 0; k < tangents; ++k) f[k + 1] = -contact.mu * contact.slip[k] * f[0];
    return;
  }
  const double force = std::hypot(f[1], tangents == 2 ? f[2] : 0.0);
  if (motion == Motion::kRests) {
    if (force > contact.mu * f[0]) Limit(contact, tangents, f, f + 1);
    return;
  }
  if (contact.mu == 0) {
    std::fill(f + 1, f + tangents + 1, 0.0);
    return;
  }
  double power = 0, speed = 0;
  for (int k = 1; k <= tangents; ++k) {
    power += f[k] * a[k];
    speed = std::hypot(speed, a[k]);
  }
  if (power <= 0 && force > 0) return Limit(contact, tangents, f, f + 1);
  for (int k = 1; k <= tangents && speed > 0; ++k) f[k] = -contact.mu * f[0] * (a[k] / speed);
}

// Newton's method on the equations of given modes; the problem in units that suit it.
class Refinement {
 public:
  Refinement(const RefinedProblem& problem, FrictionLaw law, const Gate& gate)
      : scale_(FindScale(problem)), problem_(Scaled(problem, scale_)), law_(law), gate_(gate) {}

  // The least forces of the same modes, or about them, if they pass.
  Refined Loosen(RefinedVector f, const Errors<double>& errors) {
    const Refined given{f, errors};
    for (int i = 0; i < f.size(); ++i) f[i] = std::ldexp(f[i], -scale_.f[i]);
    best_ = {f, Errors<double>{}};
    best_.errors.acceleration = std::numeric_limits<double>::infinity();
    FindModes(f);
    if (!Solve(f, Way::kShifted, /*from_zero=*/true) || !Keep(f) || !Passes()) return given;
    for (int i = 0; i < f.size(); ++i) best_.f[i] = std::ldexp(best_.f[i], scale_.f[i]);
    return best_;
  }

  // Better forces, with their errors.
  Refined Improve(RefinedVector f, const Errors<double>& errors) {
    for (int i = 0; i < f.size(); ++i) f[i] = std::ldexp(f[i], -scale_.f[i]);
    best_ = {std::move(f), errors};
    for (const Way way : {Way::kElimination, Way::kShifted, Way::kLeastSquares}) {
      RefinedVector now = best_.f;
      for (int round = 0; round < kRounds && !Passes(); ++round) {
        FindModes(now);
        if (!Solve(now, way) || !Keep(now)) break;
      }
      if (Passes()) break;
    }
    Refined told = best_;
    for (int i = 0; i < told.f.size(); ++i) told.f[i] = std::ldexp(told.f[i], scale_.f[i]);
    return told;
  }

 private:
  // How equations are solved. Elimination, of M or of M + shift I; or the least change by least squares, which
  // also keeps contacts without force where they touch.
  enum class Way : std::uint8_t { kElimination, kShifted, kLeastSquares };
  enum class Equation : std::uint8_t { kAcceleration, kLimit, kDirection };
  // An unknown force and the equation that goes with it.
  struct Unknown {
    int row;
    int contact;
    Equation equation;
  };

  bool Passes() const { return best_.errors.Largest() <= gate_.eps; }

  // The modes that are nearest relative to all that acts at a row: beside forces that cancel noise is large in
  // the units of the gate, and would pass for slip.
  void FindModes(const RefinedVector& f) {
    meter_.Bound(problem_, law_, f, Gate{1, 1});
    modes_ = meter_.meter().modes();
  }

  // Cleans the forces by their modes, and keeps them if they are the best so far. Whether they are.
  bool Keep(RefinedVector& f) {
    FindModes(f);
    Clean(problem_, modes_, meter_.a(), f);
    const Errors<double> errors = meter_.Bound(problem_, law_, f, gate_);
    if (!(errors.Largest() < best_.errors.Largest())) return false;
    best_ = {f, errors};
    return true;
  }

  // The direction of friction at its limit.
  std::array<double, 2> Direction(const RefinedVector& f, int row, int tangents) const {
    std::array<double, 2> d = {f[row + 1], tangents == 2 ? f[row + 2] : 0};
    double length = std::hypot(d[0], d[1]);
    if (length == 0) {
      d = {-meter_.a()[row + 1], tangents == 2 ? -meter_.a()[row + 2] : 0};
      length = std::hypot(d[0], d[1]);
    }
    return length > 0 ? std::array<double, 2>{d[0] / length, d[1] / length} : std::array<double, 2>{0, 0};
  }

  // Whether no more than noise moves the contact.
  bool Touches(int row) const {
    return std::abs(meter_.a()[row]) <= kTouches * (std::abs(problem_.b[row]) + meter_.meter().size(row));
  }

  // Contacts whose normal force is noise bear nothing.
  void DropNoise(RefinedVector& f) const {
    const double noise = kNoise * gate_.tau * f.lpNorm<Eigen::Infinity>();
    int row = 0;
    for (const auto& contact : problem_.contacts) {
      const int rows = RowsOf(contact, problem_.dimension);
      if (contact.kind != ContactKind::kBilateral && f[row] <= noise) f.segment(row, rows).setZero();
      row += rows;
    }
  }

  void ListUnknowns(const RefinedVector& f, Way way) {
    unknowns_.clear();
    idle_.clear();
    directions_.clear();
    row_of_.clear();
    int row = 0;
    for (int i = 0; i < static_cast<int>(problem_.contacts.size()); ++i) {
      const auto& contact = problem_.contacts[i];
      const int tangents = RowsOf(contact, problem_.dimension) - 1;
      row_of_.push_back(row);
      directions_.push_back({0, 0});
      const bool bilateral = contact.kind == ContactKind::kBilateral;
      const bool least = way == Way::kLeastSquares;
      const bool presses = f[row] > 0 || (!least && meter_.a()[row] < 0);
      if (least && !bilateral && !(f[row] > 0) && Touches(row)) idle_.push_back(row);
      if (bilateral || (modes_[i].motion != Motion::kSeparates && presses)) {
        unknowns_.push_back({row, i, Equation::kAcceleration});
        if (contact.kind == ContactKind::kSliding) {
          for (int k = 0; k < tangents; ++k) directions_[i][k] = -contact.slip[k];
        } else if (tangents > 0 && contact.mu > 0 && modes_[i].motion == Motion::kRests) {
          for (int k = 1; k <= tangents; ++k) unknowns_.push_back({row + k, i, Equation::kAcceleration});
        } else if (tangents > 0 && contact.mu > 0) {
          directions_[i] = Direction(f, row, tangents);
          if (tangents == 2) {
            unknowns_.push_back({row + 1, i, Equation::kLimit});
            unknowns_.push_back({row + 2, i, Equation::kDirection});
          }
        }
      }
      row += tangents + 1;
    }
  }

  // Whether friction follows the normal force of the contact, by mu times its direction.
  bool Follows(int contact) const {
    const bool sliding = problem_.contacts[contact].kind == ContactKind::kSliding;
    return sliding || (problem_.dimension == 2 && directions_[contact][0] != 0);
  }

  // How the accelerations change with an unknown.
  RefinedVector ResponseTo(const Unknown& unknown) const {
    RefinedVector response = problem_.A.col(unknown.row);
    if (unknown.row != row_of_[unknown.contact] || !Follows(unknown.contact)) return response;
    const auto& contact = problem_.contacts[unknown.contact];
    for (int k = 0; k + 1 < problem_.dimension; ++k)
      response += contact.mu * directions_[unknown.contact][k] * problem_.A.col(unknown.row + 1 + k);
    return response;
  }

  void Assemble(const RefinedVector& f, Way way) {
    const int size = static_cast<int>(unknowns_.size()), idle = static_cast<int>(idle_.size());
    M_.resize(size + idle, size);
    for (int j = 0; j < size; ++j) {
      const RefinedVector response = ResponseTo(unknowns_[j]);
      for (int i = 0; i < size; ++i) M_(i, j) = Entry(unknowns_[i], unknowns_[j], f, response);
      for (int i = 0; i < idle; ++i) M_(size + i, j) = response[idle_[i]];
    }
    for (int i = 0; i < size && way == Way::kShifted; ++i)
      if (unknowns_[i].equation == Equation::kAcceleration) M_(i, i) += kShift;
    if (way == Way::kLeastSquares) {
      least_.setThreshold(kRank);
      least_.compute(M_);
    } else {
      lu_.compute(M_);
    }
  }

  double Entry(const Unknown& of, const Unknown& by, const RefinedVector& f,
               const RefinedVector& response) const {
    if (of.equation == Equation::kAcceleration) return response[of.row];
    const int normal = row_of_[of.contact], first = normal + 1;
    const std::array<double, 2>& d = directions_[of.contact];
    const bool own = of.contact == by.contact;
    if (of.equation == Equation::kLimit) {
      if (!own) return 0;
      return by.row == normal ? -problem_.contacts[of.contact].mu : d[by.row - first];
    }
    if (law_ == FrictionLaw::kBaraff) return own && by.row != normal ? Across(d, by.row - first) : 0;
    double entry = response[first] * d[1] - response[first + 1] * d[0];
    const double force = std::hypot(f[first], f[first + 1]);
    if (own && by.row != normal && force > 0)
      entry += (by.row == first ? -meter_.a()[first + 1] : meter_.a()[first]) / force;
    return entry;
  }
  static double Across(const std::array<double, 2>& d, int k) { return k == 0 ? -d[1] : d[0]; }

  RefinedVector Residual(const RefinedVector& f) const {
    const RefinedVector& a = meter_.a();
    RefinedVector residual(unknowns_.size() + idle_.size());
    for (std::size_t i = 0; i < idle_.size(); ++i) residual[unknowns_.size() + i] = a[idle_[i]];
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& unknown = unknowns_[i];
      const int normal = row_of_[unknown.contact], first = normal + 1;
      const std::array<double, 2>& d = directions_[unknown.contact];
      if (unknown.equation == Equation::kAcceleration) {
        residual[i] = a[unknown.row];
      } else if (unknown.equation == Equation::kLimit) {
        residual[i] = std::hypot(f[first], f[first + 1]) - problem_.contacts[unknown.contact].mu * f[normal];
      } else {
        residual[i] = law_ == FrictionLaw::kBaraff ? 0 : a[first] * d[1] - a[first + 1] * d[0];
      }
    }
    return residual;
  }

  // Of contacts that slip in space, to where friction has turned.
  void Turn(const RefinedVector& f) {
    for (const Unknown& unknown : unknowns_)
      if (unknown.equation == Equation::kLimit)
        directions_[unknown.contact] = Direction(f, row_of_[unknown.contact], 2);
  }

  void Follow(RefinedVector& f) const {
    for (const Unknown& unknown : unknowns_) {
      if (unknown.row != row_of_[unknown.contact] || !Follows(unknown.contact)) continue;
      const auto& contact = problem_.contacts[unknown.contact];
      for (int k = 0; k + 1 < problem_.dimension; ++k)
        f[unknown.row + 1 + k] = contact.mu * directions_[unknown.contact][k] * f[unknown.row];
    }
  }

  // M times the change, M without its shift: nothing is left of what M does not feel. There the shift makes
  // large forces of rounding.
  RefinedVector WithoutShift(RefinedVector residual, const RefinedVector& change) const {
    for (int i = 0; i < residual.size(); ++i)
      if (unknowns_[i].equation == Equation::kAcceleration) residual[i] -= kShift * change[i];
    return residual;
  }

  RefinedVector ChangeFor(const RefinedVector& residual, Way way) const {
    if (way == Way::kLeastSquares) return least_.solve(residual);
    RefinedVector change = lu_.solve(residual);
    if (way == Way::kShifted) change = lu_.solve(WithoutShift(residual, change));
    return change;
  }

  // Steps from f, by the modes that were found of it. False if they lead nowhere.
  bool Solve(RefinedVector& f, Way way, bool from_zero = false) {
    if (way == Way::kLeastSquares) DropNoise(f);
    ListUnknowns(f, way);
    if (unknowns_.empty()) return true;
    if (static_cast<int>(unknowns_.size()) > kMostRows) return false;
    const bool turns = problem_.dimension == 3;  // the equations change with the direction of friction
    for (const Unknown& unknown : unknowns_)
      if (from_zero && unknown.equation == Equation::kAcceleration) f[unknown.row] = 0;
    Follow(f);
    for (int step = 0; step < kSteps; ++step) {
      meter_.Accelerate(problem_, f, Gate{0, 0});  // every row with twice the digits
      if (step == 0 || turns) {
        if (step > 0) Turn(f);
        Assemble(f, way);
      }
      const RefinedVector change = ChangeFor(Residual(f), way);
      if (!change.allFinite()) return false;
      for (std::size_t i = 0; i < unknowns_.size(); ++i) f[unknowns_[i].row] -= change[i];
      Follow(f);
    }
    return f.allFinite();
  }

  RowScale scale_;
  RefinedProblem problem_;
  FrictionLaw law_;
  Gate gate_;
  GateMeter<double> meter_;
  std::vector<NearestMode<double>> modes_;
  std::vector<Unknown> unknowns_;
  std::vector<int> idle_;                          // normal rows of contacts that touch without force
  std::vector<std::array<double, 2>> directions_;  // by contact: of friction at its limit
  std::vector<int> row_of_;
  Eigen::MatrixXd M_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_;
  Refined best_;
};

// Forces that press against each other by far more than b asks for lend their rounding to rows that need none
// of it.
bool IsJammed(const RefinedProblem& problem, const Gate& gate, const RefinedVector& f) {
  return Pressing(problem, f) * std::sqrt(gate.tau) > 1;
}

// Whether what is missed may be noise.
bool IsNear(const RefinedProblem& problem, FrictionLaw law, const RefinedVector& f) {
  const RefinedVector a = problem.A * f + problem.b;
  return MeasureLeniently(problem, law, f, a).error < kHopeless;
}

// f, f cleaned or f improved: the first that passes, or the best.
Refined Better(const RefinedProblem& problem, FrictionLaw law, const Gate& gate, RefinedVector f,
               GateMeter<double>& meter) {
  Refined best{f, BoundErrors(problem, law, f, gate, meter)};
  const auto passes = [&] { return best.errors.Largest() <= gate.eps; };
  if (!best.errors.is_finite || passes()) return best;
  meter.Bound(problem, law, f, Gate{1, 1});
  Clean(problem, meter.meter().modes(), meter.a(), f);
  const Errors<double> cleaned = BoundErrors(problem, law, f, gate, meter);
  if (cleaned.Largest() < best.errors.Largest()) best = {f, cleaned};
  const bool is_cheap = problem.rows() <= kFewRows;
  if (passes() || !(is_cheap || IsNear(problem, law, best.f))) return best;
  Refined improved = Refinement(problem, law, gate).Improve(best.f, best.errors);
  improved.errors = BoundErrors(problem, law, improved.f, gate, meter);  // in the units of the problem
  return improved.errors.Largest() < best.errors.Largest() ? improved : best;
}

}  // namespace

void Clean(const RefinedProblem& problem, const std::vector<NearestMode<double>>& modes, const RefinedVector& a,
           RefinedVector& f) {
  ForEachContact(problem, [&](int i, int row, int count) {
    CleanContact(problem.contacts[i], modes[i].motion, count - 1, a.data() + row, f.data() + row);
  });
}

Refined Refine(const RefinedProblem& problem, FrictionLaw law, const Gate& gate, RefinedVector f) {
  GateMeter<double> meter;
  Refined best = Better(problem, law, gate, std::move(f), meter);
  const auto passes = [&gate](const Refined& of) { return of.errors.Largest() <= gate.eps; };
  if (!passes(best) || !IsJammed(problem, gate, best.f)) return best;
  Refined loose = Refinement(problem, law, gate).Loosen(best.f, best.errors);
  loose.errors = BoundErrors(problem, law, loose.f, gate, meter);
  return passes(loose) && !IsJammed(problem, gate, loose.f) ? loose : best;
}

}  // namespace stiction
