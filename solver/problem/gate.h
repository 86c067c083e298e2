// SPDX-License-Identifier: Apache-2.0
// The gate: upper bounds of the strict errors of forces (errors.h), by which alone they are called solved.
//
// Accelerations are computed anew. Over m forces that are not zero, u = 2^-53, a row summed in doubles is off
// by at most
//
//   E_i = (m + 2) u (abs(b_i) + S_i)                          C.-P. Jeannerod and S. Rump, 2013
//
// which counts as an error of it. That decides most rows; one where E_i is above a sixteenth of what the row
// may miss is summed again with twice the digits (Dot2; T. Ogita, S. Rump and S. Oishi, 2005), which leaves
//
//   E_i = u abs(a_i) + 2 (m + 2)^2 u^2 (abs(b_i) + S_i)
//
// far below tau S_i = 8 u S_i. So a solution that is right to its last digit is never refused for the gate's
// own rounding. Problems of float are measured in doubles, where their products are exact; wider numbers in
// themselves. Where products leave the range of doubles, the problem is scaled first, which changes no error
// (row_scale.h).

#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "solver/problem/answer.h"
#include "solver/problem/errors.h"
#include "solver/problem/row_scale.h"

namespace stiction {

// x + y = sum + error, exactly (D. Knuth).
inline double TwoSum(double x, double y, double& error) {
  const double sum = x + y, part = sum - x;
  error = (x - (sum - part)) + (y - part);
  return sum;
}

template <class Scalar>
class GateMeter {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  // Accelerations that are at most `noise` count as none.
  template <class Problem>
  Errors<double> Bound(const Problem& problem, FrictionLaw law, const Vector& f, const Gate& gate,
                       double noise = 0) {
    Accelerate(problem, f, gate);
    for (int i = 0; i < a_.size() && noise > 0; ++i)
      if (Abs(a_[i]) <= Scalar(noise)) a_[i] = Scalar(0);
    constexpr double kSlack = 1 + 1e-12;  // of the units, which round by a few u
    return Converted<double>(MeasureErrors(problem, law, f, a_, meter_, Scalar(gate.theta()), &rounding_),
                             [](const Scalar& x) { return static_cast<double>(x) * kSlack; });
  }

  // a = A f + b, off by at most rounding()[i].
  template <class Problem>
  void Accelerate(const Problem& problem, const Vector& f, const Gate& gate) {
    const int rows = problem.rows();
    a_ = problem.b;
    size_.assign(rows, Scalar(0));
    forces_ = 0;
    for (int j = 0; j < rows; ++j) forces_ += f[j] != 0;
    ForEachEntry(problem.A, [&](int i, int j, const auto& x) {
      const Scalar product = Scalar(x) * f[j];
      a_[i] += product;
      size_[i] += Abs(product);
    });
    const Scalar unit = std::numeric_limits<Scalar>::epsilon() / 2, share = Scalar(forces_ + 2) * unit;
    const Scalar least = Scalar(forces_ + 2) * std::numeric_limits<Scalar>::min();  // of what underflows
    rounding_.resize(rows);
    doubtful_.assign(rows, false);
    bool is_doubtful = false;
    for (int i = 0; i < rows; ++i) {
      const Scalar free = Abs(Scalar(problem.b[i]));
      rounding_[i] = share * (free + size_[i]) * (1 + share) + (size_[i] > 0 ? least : Scalar(0));
      if (16 * rounding_[i] <= Scalar(gate.eps) * free + Scalar(gate.tau) * size_[i]) continue;
      doubtful_[i] = rounding_[i] > 0;
      is_doubtful = is_doubtful || doubtful_[i];
    }
    if constexpr (std::is_same_v<Scalar, double>) {
      if (is_doubtful) AccelerateFinely(problem, f);
    }
  }

  const Vector& a() const { return a_; }
  const std::vector<Scalar>& rounding() const { return rounding_; }
  const ErrorMeter<Scalar>& meter() const { return meter_; }
  bool IsDoubtful(int row) const { return doubtful_[row]; }

 private:
  template <class Problem>
  void AccelerateFinely(const Problem& problem, const Vector& f) {
    const int rows = problem.rows();
    low_.assign(rows, 0);
    for (int i = 0; i < rows; ++i)
      if (doubtful_[i]) a_[i] = problem.b[i];
    ForEachEntry(problem.A, [&](int i, int j, double x) {
      if (!doubtful_[i] || x == 0 || f[j] == 0) return;
      const double product = x * f[j];
      double error;
      a_[i] = TwoSum(a_[i], product, error);
      low_[i] += error + std::fma(x, f[j], -product);
    });
    const double unit = kTold<double>, share = (forces_ + 2) * unit;
    const double least = (forces_ + 2) * 0x1p-1020;  // where the error of a product underflows
    for (int i = 0; i < rows; ++i) {
      if (!doubtful_[i]) continue;
      a_[i] += low_[i];
      rounding_[i] = unit * std::abs(a_[i]) + 2 * share * share * (std::abs(problem.b[i]) + size_[i]) +
                     (size_[i] > 0 ? least : 0);
    }
  }

  Vector a_;
  std::vector<Scalar> size_, rounding_;
  std::vector<double> low_;
  std::vector<bool> doubtful_;  // by row: summed with twice the digits
  int forces_ = 0;              // that are not zero
  ErrorMeter<Scalar> meter_;
};

namespace internal {

// Whether a sum left the range of doubles, or a product what they tell apart.
template <class Problem>
bool LeavesRange(const Problem& problem, const GateMeter<double>& meter, const Gate& gate) {
  const double least = (problem.rows() + 2) * 0x1p-1018;
  for (int i = 0; i < problem.rows(); ++i) {
    if (!std::isfinite(meter.a()[i]) || !std::isfinite(meter.rounding()[i])) return true;
    const double size = meter.meter().size(i);
    if (size > 0 && !(least <= gate.eps * std::abs(problem.b[i]) + gate.tau * size)) return true;
  }
  return false;
}

}  // namespace internal

// Problem: of double, dense, sparse or in factors, or dense of wider numbers. Infinite if a number is not
// finite.
template <class Problem, class Vector>
Errors<double> BoundErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Gate& gate,
                           GateMeter<typename Vector::Scalar>& meter, double noise = 0) {
  Errors<double> errors = meter.Bound(problem, law, f, gate, noise);
  if constexpr (std::is_same_v<Problem, ContactProblem<double>> ||
                std::is_same_v<Problem, SparseContactProblem<double>>) {
    if (!f.allFinite() || (errors.is_finite && !internal::LeavesRange(problem, meter, gate))) return errors;
    const RowScale scale = FindScale(problem);
    Vector scaled = f;
    for (int i = 0; i < scaled.size(); ++i) scaled[i] = std::ldexp(f[i], -scale.f[i]);
    errors = meter.Bound(Scaled(problem, scale), law, scaled, gate, 0);
  }
  return errors;
}

template <class Problem, class Vector>
Errors<double> BoundErrors(const Problem& problem, FrictionLaw law, const Vector& f, const Gate& gate) {
  GateMeter<typename Vector::Scalar> meter;
  return BoundErrors(problem, law, f, gate, meter);
}

}  // namespace stiction
