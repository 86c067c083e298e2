// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/neighbour.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "certify/exact/verify_solution.h"
#include "corpus/rational.h"
#include "solver/complete/polygon.h"

namespace stiction {
namespace {

int Signed(const Rational& x) { return x < 0 ? -1 : x > 0 ? 1 : 0; }

// A row of `wanted` accelerations that is in reach: b and A change by the same share of what they may.
struct Reach {
  Rational eps, tau;

  void Move(ExactProblem& problem, const ExactVector& f, int row, const Rational& free,
            const Rational& change) const {
    if (change == 0) return;
    Rational size = 0;
    for (int j = 0; j < problem.rows(); ++j) size += abs(problem.A(row, j) * f[j]);
    const Rational most = eps * free + tau * size;
    if (most == 0) {
      problem.b[row] += change;  // out of reach, as the check will say
      return;
    }
    const Rational share = change / most;
    problem.b[row] += share * eps * free;
    for (int j = 0; j < problem.rows(); ++j)
      problem.A(row, j) += share * tau * abs(problem.A(row, j)) * Signed(f[j]);
  }
};

// A contact in its mode.
class ContactMaker {
 public:
  ContactMaker(const ExactProblem& given, FrictionLaw law, const Reach& reach, const Gate& gate)
      : given_(given), law_(law), reach_(reach), theta_(gate.theta()) {}

  // Forces as the mode wants them.
  void Force(int i, int row, Motion motion, ExactVector& f, ExactProblem& problem) const {
    Contact<Rational>& contact = problem.contacts[i];
    const int tangents = RowsOf(contact, given_.dimension) - 1;
    if (contact.kind == ContactKind::kBilateral) return;
    if (motion == Motion::kSeparates || f[row] <= 0) {
      for (int k = 0; k <= tangents; ++k) f[row + k] = 0;
      return;
    }
    if (tangents == 0) return;
    if (contact.kind == ContactKind::kSliding) return SlideAs(row, tangents, f, contact);
    const Rational limit = contact.mu * f[row];
    const Rational square = tangents == 1 ? Rational(f[row + 1] * f[row + 1])
                                          : Rational(f[row + 1] * f[row + 1] + f[row + 2] * f[row + 2]);
    if (square == 0 || (motion == Motion::kRests && square <= limit * limit)) return;
    if (tangents == 1) {
      contact.mu = abs(f[row + 1]) / f[row];
      return;
    }
    contact.mu = RationalLength(f[row + 1], f[row + 2]) / f[row];
  }

  // Accelerations as the mode wants them: the change of each row.
  void Accelerate(int i, int row, Motion motion, const ExactVector& f, const ExactVector& a,
                  ExactProblem& problem) const {
    const Contact<Rational>& contact = problem.contacts[i];
    const int tangents = RowsOf(contact, given_.dimension) - 1;
    const bool open = contact.kind != ContactKind::kBilateral && (motion == Motion::kSeparates || f[row] == 0);
    if (!open || a[row] < 0) reach_.Move(problem, f, row, abs(given_.b[row]), Rational(-a[row]));
    if (open || contact.kind != ContactKind::kStatic || contact.mu * f[row] == 0) return;
    const Rational free = TangentLength(given_.b, row, tangents + 1);
    std::array<Rational, 2> change = {Rational(0), Rational(0)};
    FrictionAt<Rational> at{contact.mu * f[row], change, change, contact.mu * f[row], change, tangents == 1};
    for (int k = 0; k < tangents; ++k) {
      at.f[k] = f[row + 1 + k];
      at.a[k] = a[row + 1 + k];
      Rational size = 0;
      for (int j = 0; j < given_.rows(); ++j) size += abs(given_.A(row + 1 + k, j) * f[j]);
      at.unit[k] = free + theta_ * size;
    }
    change = at.a;
    if (motion == Motion::kSlips)
      change = law_ == FrictionLaw::kBaraff && tangents == 2 ? MissOfFreeSlip(at).a : MissOfSlip(at).a;
    for (int k = 0; k < tangents; ++k) reach_.Move(problem, f, row + 1 + k, free, Rational(-change[k]));
  }

 private:
  static void SlideAs(int row, int tangents, ExactVector& f, Contact<Rational>& contact) {
    if (contact.mu == 0) return;
    if (tangents == 1) {
      contact.mu = abs(f[row + 1]) / f[row];
      return;
    }
    for (int k = 0; k < tangents; ++k) contact.slip[k] = -f[row + 1 + k] / (contact.mu * f[row]);
  }

  // Turns a vector by less than 2^-80, so that its length, which it returns, is rational.
  static Rational RationalLength(Rational& x, Rational& y) {
    const Rational length = SquareRoot<Rational>::Of(Rational(x * x + y * y));
    const bool right = x >= 0;
    const Rational t = y / (length + abs(x));
    const Planar<Rational> on_circle = OnCircle(t);
    x = right ? Rational(length * on_circle[0]) : Rational(-length * on_circle[0]);
    y = length * on_circle[1];
    return length;
  }

  const ExactProblem& given_;
  FrictionLaw law_;
  Reach reach_;
  Rational theta_;
};

std::string OutOfReach(const char* what, int row, int column = -1) {
  return column < 0 ? fmt::format("{} of row {} is out of reach", what, row + 1)
                    : fmt::format("{} of row {}, column {} is out of reach", what, row + 1, column + 1);
}

// The first number that differs by too much.
std::optional<std::string> FindDistance(const ExactProblem& given, const Rational& eps, const Rational& tau,
                                        const ExactProblem& near) {
  for (int i = 0; i < given.rows(); ++i)
    for (int j = 0; j < given.rows(); ++j)
      if (abs(near.A(i, j) - given.A(i, j)) > tau * abs(given.A(i, j))) return OutOfReach("A", i, j);
  std::optional<std::string> fault;
  ForEachContact(given, [&](int i, int row, int rows) {
    if (fault) return;
    const auto &contact = given.contacts[i], &other = near.contacts[i];
    if (abs(near.b[row] - given.b[row]) > eps * abs(given.b[row])) fault = OutOfReach("b", row);
    Rational square = 0, turned = 0;
    for (int k = 1; k < rows; ++k) square += given.b[row + k] * given.b[row + k];
    for (int k = 1; k < rows; ++k) {
      const Rational change = near.b[row + k] - given.b[row + k];
      if (change * change > eps * eps * square) fault = OutOfReach("b", row + k);
      const Rational turn = other.slip[k - 1] - contact.slip[k - 1];
      turned += turn * turn;
    }
    if (abs(other.mu - contact.mu) > eps * contact.mu) fault = OutOfReach("mu", row);
    if (turned > eps * eps) fault = OutOfReach("slip", row);
    if (other.kind != contact.kind) fault = OutOfReach("kind", row);
  });
  return fault;
}

// The first row that notices what became of the forces.
std::optional<std::string> FindNotice(const ExactProblem& given, const ExactVector& f, const Rational& eps,
                                      const Rational& tau, const ExactVector& near) {
  const Rational turn(std::ldexp(1.0, -80));
  ExactVector ghosts = ExactVector::Constant(f.size(), Rational(0));
  std::optional<std::string> fault;
  ForEachContact(given, [&](int, int row, int rows) {
    Rational friction = 0;
    for (int k = 1; k < rows; ++k) friction += abs(f[row + k]);
    for (int k = 0; k < rows; ++k) {
      const Rational change = abs(near[row + k] - f[row + k]);
      if (near[row + k] == 0) {
        ghosts[row + k] = change;
      } else if (change > (k == 0 ? Rational(0) : Rational(turn * friction))) {
        fault = OutOfReach("force", row + k);
      }
    }
  });
  for (int i = 0; i < given.rows() && !fault; ++i) {
    Rational noticed = 0, size = 0;
    Rational free = abs(given.b[i]);
    for (int j = 0; j < given.rows(); ++j) {
      noticed += abs(given.A(i, j)) * ghosts[j];
      size += abs(given.A(i, j) * near[j]);
    }
    ForEachContact(given, [&](int, int row, int rows) {
      if (i > row && i < row + rows) free = TangentLength(given.b, row, rows);
    });
    if (noticed > eps * free + tau * size) fault = OutOfReach("what forces of parting contacts do", i);
  }
  return fault;
}

}  // namespace

Neighbour MakeNeighbour(const ExactProblem& problem, const ExactVector& f, FrictionLaw law, const Gate& gate) {
  ErrorMeter<Rational> meter;
  MeasureErrors(problem, law, f, Accelerations(problem, f), meter, Rational(gate.theta()));
  const std::vector<NearestMode<Rational>>& modes = meter.modes();
  Neighbour near{problem, f};
  const ContactMaker maker(problem, law, {Rational(gate.eps), Rational(gate.tau)}, gate);
  ForEachContact(problem,
                 [&](int i, int row, int) { maker.Force(i, row, modes[i].motion, near.f, near.problem); });
  const ExactVector a = Accelerations(problem, near.f);
  ForEachContact(problem, [&](int i, int row, int) {
    maker.Accelerate(i, row, modes[i].motion, near.f, a, near.problem);
  });
  return near;
}

std::optional<std::string> CheckNeighbour(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                          const Gate& gate, const Neighbour& neighbour) {
  const Rational eps(gate.eps), tau(gate.tau);
  if (auto fault = FindDistance(problem, eps, tau, neighbour.problem)) return fault;
  if (auto fault = FindNotice(problem, f, eps, tau, neighbour.f)) return fault;
  return FindViolation(neighbour.problem, neighbour.f, law);
}

std::optional<std::string> FindMiss(const ExactProblem& problem, const ExactVector& f, FrictionLaw law,
                                    const Gate& gate) {
  if (gate.eps == 0) return FindViolation(problem, f, law);
  return CheckNeighbour(problem, f, law, gate, MakeNeighbour(problem, f, law, gate));
}

double ExactResidual(const ExactProblem& problem, const ExactVector& f, const Gate& gate) {
  ErrorMeter<Rational> meter;
  const ExactVector a = Accelerations(problem, f);
  return ToDouble(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a, meter, Rational(gate.theta())).Largest());
}

}  // namespace stiction
