// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "bench/peers/tables.h"
#include "search/generators/choices.h"

namespace stiction {
namespace {

// Uniform in [-1, 1].
double Draw(Choices& choices) { return static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-6; }

double DrawMu(Choices& choices) { return 0.1 + 0.45 * (1 + Draw(choices)); }

Eigen::Vector3d DrawVector(Choices& choices) {
  Eigen::Vector3d v;
  for (double& x : v) x = Draw(choices);
  return v;
}

// Rows: a normal, and two tangents.
Eigen::Matrix3d DrawFrame(Choices& choices) {
  Eigen::Vector3d normal = DrawVector(choices);
  while (normal.norm() > 1 || normal.norm() < 0.1) normal = DrawVector(choices);
  normal.normalize();
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d tangent = normal.cross(Eigen::Vector3d::Unit(least)).normalized();
  Eigen::Matrix3d frame;
  frame << normal.transpose(), tangent.transpose(), normal.cross(tangent).transpose();
  return frame;
}

// Three rows of one contact in the six columns of one body: frame (v + w x r).
Eigen::Matrix<double, 3, 6> ContactRows(const Eigen::Matrix3d& frame, const Eigen::Vector3d& r) {
  Eigen::Matrix<double, 3, 6> rows;
  rows.leftCols<3>() = frame;
  for (int k = 0; k < 3; ++k) rows.row(k).tail<3>() = r.cross(frame.row(k).transpose()).transpose();
  return rows;
}

}  // namespace

PeerProblem MakePlanar(int contacts, bool friction, bool full_rank, std::uint64_t seed) {
  Choices choices(seed);
  const int rows = friction ? 2 * contacts : contacts, rank = full_rank ? rows : std::max(1, rows / 2);
  Eigen::MatrixXd J(rows, rank);
  for (double& x : J.reshaped()) x = Draw(choices);
  PeerProblem problem;
  problem.A = J * J.transpose();
  Eigen::VectorXd y(rank);
  for (double& x : y) x = Draw(choices);
  problem.b = full_rank ? y : Eigen::VectorXd(J * y);
  for (int i = 0; i < contacts; ++i) {
    const double mu = DrawMu(choices);
    problem.contacts.push_back(
        {friction ? ContactKind::kStatic : ContactKind::kFrictionless, friction ? mu : 0, {}});
  }
  return problem;
}

PeerProblem MakeSpatial(int contacts, bool definite, std::uint64_t seed) {
  Choices choices(seed);
  const int bodies = definite ? contacts : std::max(1, contacts / 4);
  Eigen::VectorXd inverse_mass(6 * bodies), F(6 * bodies);
  for (int body = 0; body < bodies; ++body) {
    inverse_mass.segment<3>(6 * body).setConstant(std::exp2(Draw(choices)));
    for (int k = 3; k < 6; ++k) inverse_mass[6 * body + k] = std::exp2(Draw(choices));
  }
  for (double& x : F) x = Draw(choices);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * contacts, 6 * bodies);
  PeerProblem problem;
  problem.dimension = 3;
  for (int i = 0; i < contacts; ++i) {
    const int mine = definite ? i : static_cast<int>(choices.Integer(0, bodies - 1));
    // Any body but this one, or the world, whose number is `others`.
    const int others = definite ? i : bodies - 1;
    const int pick = static_cast<int>(choices.Integer(0, others));
    const Eigen::Matrix3d frame = DrawFrame(choices);
    J.block<3, 6>(3 * i, 6 * mine) = ContactRows(frame, DrawVector(choices));
    const int other = pick < mine ? pick : pick + 1;
    if (pick < others) J.block<3, 6>(3 * i, 6 * other) = -ContactRows(frame, DrawVector(choices));
    problem.contacts.push_back({ContactKind::kStatic, DrawMu(choices), {}});
  }
  const Eigen::MatrixXd weighted = J * inverse_mass.cwiseSqrt().asDiagonal();
  problem.A = weighted * weighted.transpose();
  problem.b = J * inverse_mass.cwiseProduct(F);
  return problem;
}

}  // namespace stiction
