// SPDX-License-Identifier: Apache-2.0
// Problems in factors drawn at random, for tests.

#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "solver/problem/gate.h"
#include "tests/factored.h"

namespace stiction::testing {

class DrawFactors {
 public:
  explicit DrawFactors(unsigned seed) : random_(seed) {}

  double Number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  int Integer(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

  // Contacts of the kinds given on fewer velocities than rows, so that A is singular. Without sliding contacts
  // it has solutions: b is in range(A).
  FactoredProblem<double> Problem(int dimension, const std::vector<ContactKind>& kinds) {
    std::vector<Contact<double>> contacts;
    for (int i = Integer(1, 8); i > 0; --i) {
      Contact<double> contact;
      contact.kind = kinds[static_cast<std::size_t>(Integer(0, static_cast<int>(kinds.size()) - 1))];
      if (contact.HasFrictionRows()) contact.mu = Integer(0, 4) / 4.0;
      if (contact.kind == ContactKind::kSliding) contact.slip = {1, 0};
      contacts.push_back(contact);
    }
    const int rows = RowCount(contacts, dimension), velocities = Integer(1, rows);
    const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(rows, velocities, [this] { return Number(); });
    const Eigen::VectorXd w = Eigen::VectorXd::NullaryExpr(velocities, [this] { return Number(); });
    return InFactors(dimension, contacts, J, w, Eigen::VectorXd::Zero(rows));
  }

  // A power of two per contact, of all its rows.
  Eigen::VectorXd Units(const FactoredProblem<double>& problem) {
    Eigen::VectorXd D(problem.rows());
    int row = 0;
    for (const auto& contact : problem.contacts) {
      const double unit = std::ldexp(1.0, Integer(-30, 30));
      for (int k = contact.HasFrictionRows() ? problem.dimension : 1; k > 0; --k) D[row++] = unit;
    }
    return D;
  }

 private:
  std::mt19937 random_;
};

inline double GateErrorOf(const FactoredProblem<double>& problem, const Eigen::VectorXd& f) {
  return BoundErrors(DenseOf(problem), FrictionLaw::kCoulomb, f, GateOf<double>()).Largest();
}

// J -> D J, c -> D c.
inline FactoredProblem<double> InOtherUnits(const FactoredProblem<double>& problem, const Eigen::VectorXd& D) {
  const Eigen::MatrixXd J = problem.A.J();
  return InFactors(problem.dimension, problem.contacts, D.asDiagonal() * J, problem.w,
                   D.cwiseProduct(problem.c));
}

}  // namespace stiction::testing
