// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "certify/exact/bodies.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/polygons.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

using SparseColumns = Eigen::SparseMatrix<Rational>;
using SparseRows = ExactFactors::Matrix::Rows;
using Entries = std::vector<Eigen::Triplet<Rational>>;

constexpr double kMotion = 1e-6;    // in units of its own an acceleration that is none
constexpr double kPressure = 1e-9;  // likewise a force, and what is left to the limit of friction
constexpr double kAskedResidual =
    1e-12;                         // the residual of doubles that are asked for: directions of slow slips
constexpr int kBinaryPlaces = 40;  // binary, of the largest force, in forces that the equations leave free

// The direction of friction of a contact at its limit, against the acceleration or, where that is slow, along
// the force; zero where it sticks. Directions that differ by rounding are one, the first that is told: contacts
// that sit at the limit on others that slip slip with them.
Planar<Rational> SlipOf(const FactoredProblem<double>& problem, int i, int row, int rows,
                        const Eigen::VectorXd& f, const Eigen::VectorXd& a, const LenientUnits<double>& units,
                        std::vector<Planar<Rational>>& told) {
  constexpr int kBits = 50;
  constexpr double kAlike = 1e-10;
  const double friction = TangentLength(f, row, rows);
  const double slip = TangentLength(a, row, rows) / units.acceleration(row + 1);
  if (!(slip > kMotion) && friction < (1 - kPressure) * problem.contacts[i].mu * f[row]) return {};
  const bool by_motion = slip * units.force(row + 1) > friction;
  const Eigen::VectorXd along =
      by_motion ? Eigen::VectorXd(-a.segment(row + 1, rows - 1)) : f.segment(row + 1, rows - 1);
  if (rows == 2) return {Rational(along[0] > 0 ? 1 : -1), Rational(0)};
  const Eigen::VectorXd unit = along.normalized();
  for (const Planar<Rational>& one : told)
    if (std::hypot(ToDouble(one[0]) - unit[0], ToDouble(one[1]) - unit[1]) < kAlike) return one;
  told.push_back(NearDirection({Rational(along[0]), Rational(along[1])}, kBits));
  return told.back();
}

// What contacts do, as linear equations: rows with a = 0, and E with f = E x, of as many unknowns x.
std::pair<std::vector<int>, Entries> ModesNearDoubles(const ExactFactors& problem,
                                                      const FactoredProblem<double>& rounded,
                                                      const Eigen::VectorXd& f, const Eigen::VectorXd& a) {
  std::pair<std::vector<int>, Entries> modes;
  const auto add = [&modes](int row) {
    modes.second.emplace_back(row, std::ssize(modes.first), Rational(1));
    modes.first.push_back(row);
  };
  LenientUnits<double> units;
  units.Take(rounded, f);
  std::vector<Planar<Rational>> told;
  ForEachContact(problem, [&](int i, int row, int rows) {
    const Contact<Rational>& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) return add(row);
    if (a[row] > kMotion * units.acceleration(row) || !(f[row] > kPressure * units.force(row))) return;
    add(row);
    if (rows == 1) return;
    const int unknown = static_cast<int>(std::ssize(modes.first)) - 1;
    const bool slides = contact.kind == ContactKind::kSliding;
    const Planar<Rational> friction = slides ? Planar<Rational>{-contact.slip[0], -contact.slip[1]}
                                             : SlipOf(rounded, i, row, rows, f, a, units, told);
    const bool sticks = !slides && friction == Planar<Rational>{};
    for (int k = 1; k < rows; ++k) {
      if (sticks) {
        add(row + k);
      } else if (friction[k - 1] != 0) {
        modes.second.emplace_back(row + k, unknown, Rational(contact.mu * friction[k - 1]));
      }
    }
  });
  return modes;
}

// The nearest multiple of 2^-places.
Rational NearMultiple(double x, int places) {
  return Rational(std::nearbyint(std::ldexp(x, places))) / (Rational(mpz_class(1) << std::max(places, 0)));
}

// f with a = 0 in the rows of the modes. Of these rows the first that are independent in J have the unknowns of
// the equations, as many as the bodies' velocities at most; other forces are near f.
std::optional<ExactVector> SolveLinearModes(const ExactFactors& problem,
                                            const std::pair<std::vector<int>, Entries>& modes,
                                            const Eigen::VectorXd& near) {
  const auto& [still, along] = modes;
  const int rows = problem.rows(), count = static_cast<int>(std::ssize(still));
  SparseColumns E(rows, count);
  E.setFromTriplets(along.begin(), along.end());
  SparseRows J(count, problem.w.size());
  Entries entries;
  for (int k = 0; k < count; ++k)
    for (SparseRows::InnerIterator of(problem.A.J(), still[k]); of; ++of)
      entries.emplace_back(k, of.col(), of.value());
  J.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> kept = IndependentRows(J);
  const double largest = near.size() > 0 ? near.cwiseAbs().maxCoeff() : 0;
  const int places = largest > 0 ? kBinaryPlaces - std::ilogb(largest) : kBinaryPlaces;
  ExactVector x(count);
  for (int k = 0; k < count; ++k) x[k] = NearMultiple(near[still[k]], std::max(places, 0));
  for (const int k : kept) x[k] = 0;
  const int unknowns = static_cast<int>(std::ssize(kept));
  const SparseColumns responses = problem.A.JW().transpose() * E;
  SparseColumns chosen(count, unknowns);
  for (int j = 0; j < unknowns; ++j) chosen.insert(kept[j], j) = Rational(1);
  const SparseColumns system =
      SparseColumns(chosen.transpose()) * SparseColumns(SparseColumns(J) * SparseColumns(responses * chosen));
  const ExactVector given = J * ExactVector(responses * x);
  ExactMatrix M = ExactMatrix::Constant(unknowns, unknowns, Rational(0));
  for (int j = 0; j < unknowns; ++j)
    for (SparseColumns::InnerIterator of(system, j); of; ++of) M(of.row(), j) = of.value();
  ExactVector right(unknowns);
  for (int j = 0; j < unknowns; ++j) right[j] = -problem.b[still[kept[j]]] - given[kept[j]];
  const auto solved = SolveByLifting(M, right, ExactVector::Constant(unknowns, Rational(0)));
  if (!solved) return std::nullopt;
  for (int j = 0; j < unknowns; ++j) x[kept[j]] = (*solved)[j];
  return E * x;
}

}  // namespace

// Directions of slip are turned against the accelerations that they leave once, where that betters the bound.
ExactAnswer SolveByBodiesExactly(const ExactFactors& problem, const Request& request) {
  constexpr int kTurns = 2;
  Request asked = request;
  asked.residual = kAskedResidual;
  if (asked.method != kNewtonBodies)
    asked.method = kInteriorPoint;  // whose forces are in the middle of their cones
  const InexactAnswer near = SolveByBodies(problem, asked);
  ExactAnswer answer;
  answer.method = near.method;
  answer.law = FrictionLaw::kCoulomb;
  answer.reason = "the modes near the forces of doubles are no solution";
  if (near.f.size() != problem.rows()) return answer;
  const FactoredProblem<double> rounded = InDoubles(problem);
  const ExactProblem law{problem.dimension, problem.contacts, {}, {}};
  Eigen::VectorXd toward = near.a;
  for (int turn = 0; turn < kTurns && !(answer.bound >= EnoughBound()); ++turn) {
    auto f = SolveLinearModes(problem, ModesNearDoubles(problem, rounded, near.f, toward), near.f);
    if (!f) break;
    ExactVector a = problem.Accelerations(*f);
    const auto bound = CoulombBound(law, *f, a);
    if (!bound || *bound <= answer.bound.value_or(0)) break;
    toward = a.unaryExpr(&ToDouble);
    answer.f = *std::move(f);
    answer.a = std::move(a);
    answer.bound = bound;
    answer.outcome = Outcome::kSolved;
    answer.reason.clear();
  }
  CallBounded(answer);
  if (problem.dimension == 2) answer.bound.reset();
  return answer;
}

}  // namespace stiction
