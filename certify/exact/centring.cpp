// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/centring.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace stiction {
namespace {

class Centring {
 public:
  Centring(const Eigen::MatrixXd& unfelt, const std::vector<CentredCone>& cones) : cones_(cones) {
    const auto rows = unfelt.rows(), columns = unfelt.cols();
    moves_ = Eigen::MatrixXd::Zero(rows + 1, columns + 1);
    moves_.topLeftCorner(rows, columns) = unfelt;
    moves_(rows, columns) = 1;
  }

  Eigen::VectorXd Run(const Eigen::VectorXd& z) const {
    Eigen::VectorXd point(z.size() + 1);
    point << z, Start(z);
    for (double weight = 1; weight > 5e-5; weight /= 10)
      for (int step = 0; step < 30 && Improve(weight, point); ++step) continue;
    return point.head(z.size());
  }

 private:
  // t + weight (sum of logarithms of what is positive), with its derivatives.
  struct Barrier {
    double value;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
  };

  // By how much a cone is made narrower for t = 1.
  static double Share(const CentredCone& cone) { return std::min(1.0, cone.mu); }

  double Start(const Eigen::VectorXd& z) const {
    double t = 0.5;
    for (const CentredCone& cone : cones_) {
      const double friction = cone.has_friction ? std::hypot(z[cone.first + 1], z[cone.first + 2]) : 0;
      t = std::min(t, (cone.mu * z[cone.first] - friction) / Share(cone));
    }
    return t - 0.1;
  }

  // Empty where something is not positive.
  std::optional<Barrier> At(const Eigen::VectorXd& point, double weight) const {
    const int last = static_cast<int>(point.size()) - 1;
    const double rest = 1 - point[last];
    if (rest <= 0) return std::nullopt;
    Barrier barrier{point[last] + weight * std::log(rest), Eigen::VectorXd::Zero(last + 1),
                    Eigen::MatrixXd::Zero(last + 1, last + 1)};
    barrier.gradient[last] = 1 - weight / rest;
    barrier.hessian(last, last) = -weight / (rest * rest);
    for (const CentredCone& cone : cones_)
      if (!Add(cone, point, weight, barrier)) return std::nullopt;
    return barrier;
  }

  // log(w'Sw), w = J (z, t), S = diag(1, -1, -1).
  static bool Add(const CentredCone& cone, const Eigen::VectorXd& point, double weight, Barrier& barrier) {
    const int last = static_cast<int>(point.size()) - 1;
    const int second = cone.has_friction ? cone.first + 1 : last,
              third = cone.has_friction ? cone.first + 2 : last;
    const std::array<int, 4> at = {cone.first, second, third, last};
    Eigen::Matrix<double, 3, 4> J = Eigen::Matrix<double, 3, 4>::Zero();
    J(0, 0) = cone.mu;
    J(0, 3) = -Share(cone);
    J(1, 1) = J(2, 2) = cone.has_friction ? 1 : 0;
    const Eigen::Vector3d S(1, -1, -1);
    const Eigen::Vector3d w = J * Eigen::Vector4d(point[at[0]], point[at[1]], point[at[2]], point[at[3]]);
    const Eigen::Vector3d Sw = S.cwiseProduct(w);
    const double q = w.dot(Sw);
    if (w[0] <= 0 || q <= 0) return false;
    barrier.value += weight * std::log(q);
    const Eigen::Matrix3d curvature =
        Eigen::Matrix3d((2 / q * S).asDiagonal()) - 4 / (q * q) * Sw * Sw.transpose();
    const Eigen::Vector4d gradient = 2 * weight / q * J.transpose() * Sw;
    const Eigen::Matrix4d hessian = weight * J.transpose() * curvature * J;
    for (int i = 0; i < 4; ++i) {
      barrier.gradient[at[i]] += gradient[i];
      for (int j = 0; j < 4; ++j) barrier.hessian(at[i], at[j]) += hessian(i, j);
    }
    return true;
  }

  // A step of Newton's method; false at the end.
  bool Improve(double weight, Eigen::VectorXd& point) const {
    const auto here = At(point, weight);
    if (!here) return false;
    Eigen::MatrixXd concave = -(moves_.transpose() * here->hessian * moves_);
    concave.diagonal().array() += 1e-14 * concave.diagonal().maxCoeff();
    const Eigen::VectorXd step = moves_ * concave.partialPivLu().solve(moves_.transpose() * here->gradient);
    const double slope = here->gradient.dot(step);
    if (!(slope > 1e-10 * weight)) return false;
    for (double size = 1; size > 1e-12; size /= 2) {
      const auto there = At(point + size * step, weight);
      if (!there || there->value < here->value + 0.1 * size * slope) continue;
      point += size * step;
      return true;
    }
    return false;
  }

  const std::vector<CentredCone>& cones_;
  Eigen::MatrixXd moves_;  // of z and t
};

}  // namespace

Eigen::VectorXd Centred(const Eigen::VectorXd& z, const Eigen::MatrixXd& unfelt,
                        const std::vector<CentredCone>& cones) {
  return Centring(unfelt, cones).Run(z);
}

}  // namespace stiction
