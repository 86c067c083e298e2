// SPDX-License-Identifier: Apache-2.0
// Gaussian elimination as it is written down: three loops, no blocks, no exchange of rows. What the paper's
// "two to three times as long as Gaussian elimination" is held against, beside Eigen's blocked LU.

#pragma once

#include <Eigen/Core>

namespace stiction {

class PlainGauss {
 public:
  // A x = -b. Of use where no pivot is zero, as for A definite; its time is the same for any A.
  void Solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
    M_ = A;
    x_ = -b;
    const int n = static_cast<int>(b.size());
    for (int k = 0; k < n; ++k) {
      for (int i = k + 1; i < n; ++i) Subtract(k, i);
    }
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) x_[i] -= M_(i, j) * x_[j];
      x_[i] /= M_(i, i);
    }
  }
  const Eigen::VectorXd& x() const { return x_; }

 private:
  // Takes from row i what of row k makes its entry in column k zero.
  void Subtract(int k, int i) {
    const double* from = &M_(k, 0);
    double* to = &M_(i, 0);
    const double factor = to[k] / from[k];
    for (int j = k + 1; j < M_.cols(); ++j) to[j] -= factor * from[j];
    x_[i] -= factor * x_[k];
  }

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M_;
  Eigen::VectorXd x_;
};

}  // namespace stiction
