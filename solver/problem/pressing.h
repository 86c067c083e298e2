// SPDX-License-Identifier: Apache-2.0
// How hard bodies press against each other beside what acts on them.

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/problem/problem.h"

namespace stiction {

// The ratio of the largest force to the largest free acceleration, of every row as if its A_ii were 1; 0 where
// b = 0. Where there is no solution, forces that grow without end nearly are one: only the ratio tells. Shapes:
// f rows x 1.
template <class Problem, class Vector>
double Pressing(const Problem& problem, const Vector& f) {
  double forces = 0, free = 0;
  for (int i = 0; i < f.size(); ++i) {
    const double own = std::sqrt(std::abs(static_cast<double>(problem.A.coeff(i, i))));
    forces = std::max(forces, std::abs(static_cast<double>(f[i])) * own);
    if (own > 0) free = std::max(free, std::abs(static_cast<double>(problem.b[i])) / own);
  }
  return free > 0 ? forces / free : 0;
}

// Of every contact the number of its island: A couples it with the others there, by more than rounding.
template <class Problem>
std::vector<int> IslandOfContact(const Problem& problem) {
  std::vector<int> contact_of, island(problem.contacts.size());
  for (std::size_t i = 0; i < island.size(); ++i) {
    island[i] = static_cast<int>(i);
    contact_of.insert(contact_of.end(), RowsOf(problem.contacts[i], problem.dimension), island[i]);
  }
  const auto root = [&island](int i) {
    while (island[i] != i) i = island[i] = island[island[i]];
    return i;
  };
  const auto size = [&problem](int i) { return std::abs(static_cast<double>(problem.A.coeff(i, i))); };
  constexpr double kCoupled = 1e-15;
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) {
      if (std::abs(static_cast<double>(problem.A.coeff(i, j))) >
          kCoupled * std::sqrt(size(i)) * std::sqrt(size(j)))
        island[root(contact_of[i])] = root(contact_of[j]);
    }
  }
  for (int i = 0; i < static_cast<int>(island.size()); ++i) island[i] = root(i);
  return island;
}

// What a row misses of the law in its own unit, sqrt(A_ii): a contact that sinks, or is pressed and parts;
// friction below its limit that slips, or at it drives. A force that is rounding beside `forces` is none.
// `own`, f, a: of the rows of the contact.
template <class Contact>
double MissedBy(const Contact& contact, int count, const double* own, const double* f, const double* a,
                double forces) {
  const auto in_own = [&](int k) { return own[k] > 0 ? a[k] / own[k] : 0; };
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * forces;
  const bool presses = contact.kind == ContactKind::kBilateral || f[0] * own[0] > rounding;
  const double normal = presses ? std::abs(in_own(0)) : -in_own(0);
  if (!presses || contact.kind != ContactKind::kStatic) return normal;
  double force = 0, power = 0, slip = 0;
  for (int k = 1; k < count; ++k) {
    force = std::hypot(force, f[k]);
    power += f[k] * in_own(k);
    slip = std::hypot(slip, in_own(k));
  }
  const double mu = static_cast<double>(contact.mu);
  if (mu == 0) return normal;
  const bool at_limit = force > 0 && force >= (1 - 1e-6) * mu * f[0];
  return std::max(normal, at_limit ? power / force : slip);
}

// Whether the rounding of forces moves rows by all that acts on an island, or by a part of it that is missed:
// then nothing tells them from forces that grow without end where there is no solution. tau: that of the gate.
// Shapes: f, a = A f + b rows x 1, of doubles.
template <class Problem>
bool HidesWhatActs(const Problem& problem, const Eigen::VectorXd& f, const Eigen::VectorXd& a, double tau) {
  constexpr double kAll = 1.0 / 4, kPart = 1.0 / 256;
  double forces = 0, least = std::numeric_limits<double>::infinity();  // least: of what acts anywhere
  for (int i = 0; i < f.size(); ++i) {
    const double own = std::sqrt(std::abs(static_cast<double>(problem.A.coeff(i, i))));
    const double free = std::abs(static_cast<double>(problem.b[i]));
    forces = std::max(forces, std::abs(f[i]) * own);
    if (own > 0 && free > 0) least = std::min(least, free / own);
  }
  if (!(forces * tau * static_cast<double>(f.size()) > kPart * least)) return false;
  std::vector<double> own(f.size());
  for (int i = 0; i < f.size(); ++i) own[i] = std::sqrt(std::abs(static_cast<double>(problem.A.coeff(i, i))));
  struct Island {
    double forces = 0, free = 0, missed = 0;
    int rows = 0;
  };
  const std::vector<int> island_of = IslandOfContact(problem);
  std::vector<Island> islands(problem.contacts.size());
  for (const bool measures : {false, true}) {
    int row = 0;
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
      Island& island = islands[island_of[c]];
      const int count = RowsOf(problem.contacts[c], problem.dimension);
      for (int i = row; i < row + count && !measures; ++i) {
        island.forces = std::max(island.forces, std::abs(f[i]) * own[i]);
        if (own[i] > 0)
          island.free = std::max(island.free, std::abs(static_cast<double>(problem.b[i])) / own[i]);
        ++island.rows;
      }
      if (measures)
        island.missed = std::max(
            island.missed, MissedBy(problem.contacts[c], count, &own[row], &f[row], &a[row], island.forces));
      row += count;
    }
  }
  return std::any_of(islands.begin(), islands.end(), [tau](const Island& island) {
    if (!(island.free > 0)) return false;
    const double hidden = island.forces * tau / island.free;
    return hidden > kAll || (hidden * island.rows > kPart && island.missed / island.free > kPart);
  });
}

}  // namespace stiction
