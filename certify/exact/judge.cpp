// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/judge.h"

#include <algorithm>
#include <vector>

#include "certify/exact/verify_solution.h"
#include "corpus/rational.h"

namespace stiction {
namespace {

// x is at most y, both not negative, as their squares are.
bool IsAtMost(const Rational& square, const Rational& y) { return y >= 0 && square <= y * y; }

// Roots of units are rounded down, within 2^-100.
class Judge {
 public:
  Judge(const ExactProblem& problem, const ExactVector& f, FrictionLaw law, const Rational& bound)
      : problem_(problem), f_(f), a_(Accelerations(problem, f)), law_(law), bound_(bound) {
    layout_.Assign(problem.contacts, problem.dimension);
    const std::vector<Rational> work = WorkByContact();
    for (int i = 0; i < problem.rows(); ++i) {
      Rational sum = 0;
      for (int j = 0; j < problem.rows(); ++j) {
        const Rational asked = problem.A(j, j) != 0 ? Rational(problem.b[j] / problem.A(j, j)) : Rational(0);
        sum += abs(problem.A(i, j)) * std::max<Rational>(abs(f[j]), abs(asked));
      }
      const Rational own = abs(problem.A(i, i));
      const Rational root = SquareRoot<Rational>::Of(Rational(own * work[layout_.ContactOf(i)]));
      const Rational unit = abs(problem.b[i]) + std::min<Rational>(sum, root);
      acceleration_.push_back(Rational(bound * unit));
      force_.push_back(own > 0 ? Rational(bound * unit / own) : Rational(0));
    }
  }

  // The first condition that is missed by more than the bound; empty if there is none.
  std::string Fault() const {
    for (int i = 0; i < static_cast<int>(problem_.contacts.size()); ++i) {
      const std::string fault = FaultOf(problem_.contacts[i], layout_.NormalRowOf(i));
      if (!fault.empty()) return "contact " + std::to_string(i + 1) + ": " + fault;
    }
    return "";
  }

 private:
  // f'Af of the contacts that A couples, from neighbour to neighbour.
  std::vector<Rational> WorkByContact() const {
    const int contacts = static_cast<int>(problem_.contacts.size());
    std::vector<int> group(contacts, -1);
    std::vector<Rational> work(contacts, Rational(0));
    for (int seed = 0; seed < contacts; ++seed) {
      if (group[seed] >= 0) continue;
      std::vector<int> found = {seed};
      group[seed] = seed;
      for (std::size_t k = 0; k < found.size(); ++k) {
        for (int other = 0; other < contacts; ++other) {
          if (group[other] >= 0 || !Couples(found[k], other)) continue;
          group[other] = seed;
          found.push_back(other);
        }
      }
      Rational done = 0;
      for (int i = 0; i < problem_.rows(); ++i)
        if (group[layout_.ContactOf(i)] == seed) done += f_[i] * (a_[i] - problem_.b[i]);
      for (const int contact : found) work[contact] = abs(done);
    }
    return work;
  }

  bool Couples(int one, int other) const {
    for (int i = 0; i < problem_.rows(); ++i) {
      if (layout_.ContactOf(i) != one) continue;
      for (int j = 0; j < problem_.rows(); ++j)
        if (layout_.ContactOf(j) == other && (problem_.A(i, j) != 0 || problem_.A(j, i) != 0)) return true;
    }
    return false;
  }

  std::string FaultOf(const Contact<Rational>& contact, int n) const {
    const Rational &fN = f_[n], &aN = a_[n];
    if (contact.kind == ContactKind::kBilateral) return abs(aN) <= acceleration_[n] ? "" : "it moves";
    if (fN < -force_[n]) return "it pulls";
    if (aN < -acceleration_[n]) return "it accelerates inward";
    if (fN > force_[n] && aN > acceleration_[n]) return "it presses, and separates";
    return contact.HasFrictionRows() ? FaultOfFriction(contact, n) : "";
  }

  std::string FaultOfFriction(const Contact<Rational>& contact, int n) const {
    const int tangents = problem_.dimension - 1;
    Rational force = 0, speed = 0, along = 0, away = 0, unit_a = 0, unit_f = 0;  // squares, but along
    const Rational limit = contact.mu * std::max<Rational>(0, f_[n]);
    for (int k = 1; k <= tangents; ++k) {
      force += f_[n + k] * f_[n + k];
      speed += a_[n + k] * a_[n + k];
      along += f_[n + k] * a_[n + k];
      const Rational gap = f_[n + k] + contact.mu * f_[n] * contact.slip[k - 1];
      away += gap * gap;
      unit_a = std::max(unit_a, acceleration_[n + k]);
      unit_f = std::max(unit_f, force_[n + k]);
    }
    const Rational most = std::max<Rational>(unit_f, contact.mu * force_[n]);
    if (contact.kind == ContactKind::kSliding)
      return IsAtMost(away, most) ? "" : "friction is not that of its slip";
    if (!IsAtMost(force, Rational(limit + most))) return "friction is beyond its limit";
    if (IsAtMost(speed, unit_a)) return "";  // at rest
    const Rational below = limit - most;
    if (below > 0 && force < below * below) return "it slips, and friction is below its limit";
    if (IsAtMost(force, unit_f)) return "";  // without friction
    if (law_ == FrictionLaw::kBaraff && problem_.dimension == 3)
      return along <= 0 || along * along <= most * most * speed || along * along <= unit_a * unit_a * force
                 ? ""
                 : "friction drives the slip";
    // Opposed to y = aF - unit_a / most fF, which is aF but for what may be missed: abs(fF + limit y / abs(y))
    // <= most, squared: 2 limit fF.y / abs(y) <= most^2 - force - limit^2.
    const Rational s = most > 0 ? Rational(unit_a / most) : Rational(0);
    const Rational towards = along - s * force, length = speed - 2 * s * along + s * s * force;
    // Where fF - aF / s lies within the disc, what the law wants there is no friction at its limit.
    if (length < s * s * limit * limit) return "friction does not oppose the slip";
    const Rational side = most * most - force - limit * limit, product = 2 * limit * towards;
    const bool holds = product <= 0 ? side >= 0 || product * product >= side * side * length
                                    : side >= 0 && product * product <= side * side * length;
    return holds ? "" : "friction does not oppose the slip";
  }

  const ExactProblem& problem_;
  const ExactVector& f_;
  ExactVector a_;
  FrictionLaw law_;
  Rational bound_;
  RowLayout<Eigen::Dynamic> layout_;
  std::vector<Rational> acceleration_, force_;  // what may be missed
};

}  // namespace

std::optional<std::string> FindMiss(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                    const Rational& bound) {
  const std::string fault = Judge(problem, f, law, bound).Fault();
  return fault.empty() ? std::nullopt : std::optional(fault);
}

}  // namespace stiction
