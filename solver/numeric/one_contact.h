// SPDX-License-Identifier: Apache-2.0
// One static contact in space by itself: the force f with a = W f + q that obeys Coulomb's law.
//
//   parts    f = 0 where qN >= 0
//   sticks   a = 0, where abs(fF) <= mu fN then
//   slips    aN = 0, aF = -x fF with x > 0, and abs(fF) = mu fN
//
// With aN = 0, fN = n - p.fF and aF = S fF + c; so fF(x) = -inv(S + x) c, and x is the root of the slack
// mu fN / abs(fF) - 1, which is nearly a straight line for large x. Regula falsi finds it, with the Illinois
// weights. Where W is positive definite there is a root: the slack is negative at x = 0, unless the contact
// sticks, and positive for large x.
//
// Shapes  W 3 x 3, q 3 x 1: normal, then tangential. Floating-point scalars.

#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

#include "solver/problem/scalar.h"

namespace stiction {

template <class Scalar>
class SlippingContact {
 public:
  using Triple = std::array<Scalar, 3>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  // Requires W_NN > 0.
  SlippingContact(const Matrix& W, const Vector& q, const Scalar& mu)
      : mu_(mu), n_(-q[0] / W(0, 0)), size_(W(0, 0)) {
    for (int i = 0; i < 2; ++i) {
      p_[i] = W(0, i + 1) / W(0, 0);
      c_[i] = q[i + 1] + W(i + 1, 0) * n_;
      for (int j = 0; j < 2; ++j) S_[i][j] = W(i + 1, j + 1) - W(i + 1, 0) * W(0, j + 1) / W(0, 0);
    }
  }

  // Without friction.
  Triple Frictionless() const { return {n_, Scalar(0), Scalar(0)}; }

  Triple Force(const Scalar& x) const {
    const Scalar s00 = S_[0][0] + x, s11 = S_[1][1] + x, determinant = Determinant(x);
    const Scalar f1 = (S_[0][1] * c_[1] - s11 * c_[0]) / determinant;
    const Scalar f2 = (S_[1][0] * c_[0] - s00 * c_[1]) / determinant;
    return {n_ - p_[0] * f1 - p_[1] * f2, f1, f2};
  }

  // Not negative where Force(x) is in the cone. Rounding can make S indefinite; then it is negative too.
  Scalar Slack(const Scalar& x) const {
    using std::hypot;
    if (!(Determinant(x) > 0 && S_[0][0] + x > 0)) return Scalar(-1);
    const Triple force = Force(x);
    const Scalar length = hypot(force[1], force[2]);
    return length > 0 ? mu_ * force[0] / length - 1 : Scalar(1);
  }

  // Requires Slack(0) < 0 and mu > 0. Ensures Slack(x) >= 0 up to rounding, if that is anywhere.
  Scalar Root() const {
    constexpr int kMost = 60;
    const Scalar tiny = 4 * std::numeric_limits<Scalar>::epsilon();
    Scalar low = 0, high = size_ + Abs(S_[0][0]) + Abs(S_[1][1]), at_low = Slack(low), at_high = Slack(high);
    for (int k = 0; k < kMost && at_high < 0; ++k) {
      low = high;
      at_low = at_high;
      high *= 4;
      at_high = Slack(high);
    }
    int last = 0;
    for (int k = 0; k < kMost && high - low > tiny * high; ++k) {
      Scalar x = (low * at_high - high * at_low) / (at_high - at_low);
      if (!(x > low && x < high)) x = (low + high) / 2;
      const Scalar at = Slack(x);
      if (Abs(at) <= tiny) return x;
      (at < 0 ? low : high) = x;
      (at < 0 ? at_low : at_high) = at;
      const int side = at < 0 ? -1 : 1;
      if (side == last) (at < 0 ? at_high : at_low) /= 2;
      last = side;
    }
    return high;
  }

 private:
  Scalar Determinant(const Scalar& x) const { return (S_[0][0] + x) * (S_[1][1] + x) - S_[0][1] * S_[1][0]; }

  Scalar mu_, n_, size_;  // size: W_NN, not zero where S is
  Scalar p_[2], c_[2], S_[2][2];
};

// Requires W_NN > 0.
template <class Scalar>
std::array<Scalar, 3> SolveOneContact(const Eigen::Matrix<Scalar, 3, 3>& W,
                                      const Eigen::Matrix<Scalar, 3, 1>& q, const Scalar& mu) {
  if (q[0] >= 0) return {Scalar(0), Scalar(0), Scalar(0)};
  const SlippingContact<Scalar> contact(W, q, mu);
  if (mu == 0) return contact.Frictionless();
  return contact.Force(contact.Slack(0) >= 0 ? Scalar(0) : contact.Root());
}

}  // namespace stiction
