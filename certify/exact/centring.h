// SPDX-License-Identifier: Apache-2.0
// Forces in the middle of their cones: where accelerations do not tell forces apart, those furthest from all
// edges.

#pragma once

#include <Eigen/Core>
#include <vector>

namespace stiction {

// The friction cone of the forces z[first], and with friction of the two behind it; without, z[first] >= 0.
struct CentredCone {
  int first;
  double mu;  // 1 without friction
  bool has_friction;
};

// z changed along the columns of `unfelt`, such that all cones hold by the largest t, at most 1 and nearly:
// Newton's method on a logarithmic barrier. z is in units of its largest force, and need not be in its cones.
Eigen::VectorXd Centred(const Eigen::VectorXd& z, const Eigen::MatrixXd& unfelt,
                        const std::vector<CentredCone>& cones);

}  // namespace stiction
