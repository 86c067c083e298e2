// SPDX-License-Identifier: Apache-2.0
// The laws of one contact, smoothed: equations h(f, a) = 0 with a parameter m > 0 (N) that become the law as m
// goes to 0. (Functions of Chen, Harker, Kanzow and Smale, on the second-order cone as by Fukushima, Luo and
// Tseng; cited from memory.)
//
//   normal   h = fN - p(fN - r aN),   p(z) = (z + sqrt(z^2 + 4 m^2)) / 2 in place of max(0, z); its solutions
//            are fN > 0, aN > 0 with fN r aN = m^2
//   static   x = (fN, fF / mu),  y = (aN + mu s, mu aF),  s^2 = abs(aF)^2 + e^2 in place of abs(aF):
//            h = x - P(x - r y), friction rows times mu. P(z) replaces max(0, .) by p in the nearest point of
//            the cone abs(zF) <= zN, which is  (p(z+) + p(z-)) / 2,  (p(z+) - p(z-)) / 2 zF / abs(zF)  with
//            z+- = zN +- abs(zF)
//
// x in the cone, y in the cone and x.y = 0 is Coulomb's law (De Saxce's change of variables, cited from
// memory). Where a contact sticks, the smoothed law keeps its force away from the bounds of friction.
//
// Units: r kg, m N, e m/s^2. Floating-point scalars.

#pragma once

#include <Eigen/Core>
#include <cmath>

namespace stiction {

// p(z) and its derivative.
template <class Scalar>
struct SmoothPositive {
  Scalar value, slope;

  SmoothPositive(const Scalar& z, const Scalar& m) {
    using std::hypot;
    const Scalar root = hypot(z, 2 * m);
    value = z > 0 ? (root + z) / 2 : 2 * m * m / (root - z);
    slope = value / root;
  }
};

template <class Scalar>
struct SmoothStatic {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;

  Vector h;
  Matrix by_f, by_a;  // derivatives

  // Requires mu > 0, r > 0, m > 0, e > 0.
  SmoothStatic(const Vector& f, const Vector& a, const Scalar& mu, const Scalar& r, const Scalar& m,
               const Scalar& e) {
    using std::hypot;
    const Vector unit(1, mu, mu), x = f.cwiseQuotient(unit);
    const Scalar s = hypot(hypot(a[1], a[2]), e);
    Vector z = x - r * a.cwiseProduct(unit);
    z[0] -= r * mu * s;
    const Scalar length = hypot(z[1], z[2]);
    const Vector u = length > 0 ? Vector(0, z[1] / length, z[2] / length) : Vector(0, 1, 0);
    const SmoothPositive<Scalar> most(z[0] + length, m), least(z[0] - length, m);
    const Scalar mean = (most.value + least.value) / 2, half = (most.value - least.value) / 2;
    h = unit.cwiseProduct(x - mean * Vector::Unit(0) - half * u);

    const Scalar along = (most.slope + least.slope) / 2, mixed = (most.slope - least.slope) / 2;
    const Scalar across = length > m / 1e6 ? Scalar(half / length) : along;  // the limit
    Matrix P = across * Matrix::Identity();
    P(0, 0) = along;
    P += (along - across) * u * u.transpose();
    P.row(0) += mixed * u.transpose();
    P.col(0) += mixed * u;
    by_f = unit.asDiagonal() * (Matrix::Identity() - P) * unit.cwiseInverse().asDiagonal();
    Matrix y = unit.asDiagonal();
    y(0, 1) = mu * a[1] / s;
    y(0, 2) = mu * a[2] / s;
    by_a = r * unit.asDiagonal() * P * y;
  }
};

}  // namespace stiction
