// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/bounds.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "corpus/record/asymmetry.h"
#include "corpus/stop.h"

namespace stiction {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Dense = Eigen::VectorXd;

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;

Sparse ToDoubles(const AnyProblem& problem) { return problem.entries().A.unaryExpr(&ToDouble); }

ExactVector ToExact(const Dense& values) {
  return values.unaryExpr([](double x) { return Rational(x); });
}

Sparse SymmetricPart(const AnyProblem& problem) { return ToDoubles(Symmetrized(problem)); }

Sparse Shifted(const Sparse& S, double shift) {
  Sparse identity(S.rows(), S.cols());
  identity.setIdentity();
  return S + shift * identity;
}

double LargestRowSum(const Sparse& S) {
  Dense sums = Dense::Zero(S.rows());
  for (int j = 0; j < S.outerSize(); ++j) {
    for (Sparse::InnerIterator entry(S, j); entry; ++entry) sums[entry.row()] += std::abs(entry.value());
  }
  return S.rows() == 0 ? 0 : sums.maxCoeff();
}

// least of the header for one shift, if the factorization succeeds.
std::optional<double> LeastWithShift(const Sparse& S, double shift) {
  Stop::Check();
  const Sparse B = Shifted(S, shift);
  const Eigen::SimplicialLLT<Sparse> cholesky(B);
  if (cholesky.info() != Eigen::Success) return std::nullopt;
  const Sparse L = cholesky.matrixL();
  Eigen::VectorXi terms = Eigen::VectorXi::Zero(S.rows());  // of an entry of L L', by row
  for (int j = 0; j < L.outerSize(); ++j) {
    for (Sparse::InnerIterator entry(L, j); entry; ++entry) {
      if (!std::isfinite(entry.value())) return std::nullopt;
      ++terms[entry.row()];
    }
  }
  const Dense diagonal = B.diagonal();
  const double g = (terms.maxCoeff() + 2) * kUnit;
  const double rounding = g * diagonal.sum() + kUnit * (LargestRowSum(S) + diagonal.cwiseAbs().maxCoeff()) +
                          std::numeric_limits<double>::min() * static_cast<double>(S.rows());
  return -shift - 2 * rounding;
}

// A direction of negative curvature from the factors of L D L' without pivoting: L'x = e_k, D_k < 0.
std::optional<ExactVector> ProposeNegative(const Sparse& S) {
  const Eigen::SimplicialLDLT<Sparse> factors(S);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Dense D = factors.vectorD();
  int k = 0;
  if (!D.allFinite() || D.minCoeff(&k) >= 0) return std::nullopt;
  Dense x = factors.matrixU().solve(Dense(Dense::Unit(S.rows(), k)));
  x = factors.permutationPinv() * x;
  if (!x.allFinite()) return std::nullopt;
  return ToExact(x);
}

// abs(A x - b) / abs(b), b /= 0.
double RelativeResidual(const AnyProblem& problem, const ExactVector& x) {
  const ExactVector residual = problem.entries().A * x - problem.b();
  const Rational square = residual.squaredNorm() / problem.b().squaredNorm();
  return std::sqrt(ToDouble(square)) * (1 + 4 * kUnit);
}

// x_k+1 = x_k + inv(S + s I) (b - A x_k), s = shift: converges to a solution of least squares where A = S is
// semidefinite; eigenvalues below s / steps hardly take part. The best of these points.
Dense ProximalPoint(const Sparse& S, const Sparse& A, const Dense& b, double shift, int steps) {
  Dense x = Dense::Zero(b.size()), best = x;
  const Eigen::SimplicialLDLT<Sparse> factors(Shifted(S, shift));
  if (factors.info() != Eigen::Success) return best;
  double least = b.norm();
  for (int k = 0; k < steps; ++k) {
    x += factors.solve(b - A * x);
    const double residual = (b - A * x).norm();
    if (!(residual < least) || !x.allFinite()) break;
    least = residual;
    best = x;
  }
  return best;
}

}  // namespace

CurvatureBounds BoundCurvature(const AnyProblem& problem) {
  CurvatureBounds bounds;
  if (problem.rows() == 0) {
    bounds.least = 0;
    return bounds;
  }
  const Sparse S = SymmetricPart(problem);
  bounds.scale = S.diagonal().cwiseAbs().maxCoeff();
  if (const auto x = ProposeNegative(S)) {
    const Rational value = x->dot(problem.entries().A * *x);
    if (value < 0) {
      bounds.negative = Obstacle{*x, value};
      bounds.most = ToDouble(value / x->squaredNorm());
    }
  }
  // From a shift down, which shows more than semidefinite, to larger and larger shifts up.
  const double grain = kUnit * (S.diagonal().cwiseAbs().sum() + LargestRowSum(S));
  if (!bounds.negative) bounds.least = LeastWithShift(S, -64 * grain);
  for (double shift = 0; !bounds.least && shift < 1e6 * grain / kUnit; shift = shift == 0 ? grain : 4 * shift) {
    bounds.least = LeastWithShift(S, shift);
  }
  return bounds;
}

RangeDistance BoundRangeDistance(const AnyProblem& problem) {
  RangeDistance best{ExactVector::Constant(problem.rows(), Rational(0)), 1, 1};
  const Dense b = problem.b().unaryExpr(&ToDouble);
  if (b.size() == 0 || b.cwiseAbs().maxCoeff() == 0) return {best.x, 0, 0};
  const Sparse S = SymmetricPart(problem), A = ToDoubles(problem);
  const double scale = LargestRowSum(S);
  constexpr double kShifts[] = {1e-8, 1e-10, 1e-12};
  for (const double shift : kShifts) {
    Stop::Check();
    const ExactVector x = ToExact(ProximalPoint(S, A, b, shift * scale, shift == kShifts[0] ? 10 : 40));
    const double distance = RelativeResidual(problem, x);
    if (shift == kShifts[0]) best.rough = distance;
    if (distance < best.distance) {
      best.x = x;
      best.distance = distance;
    }
  }
  return best;
}

bool IsRegularModuloPrime(const AnyProblem& problem) {
  if (const auto* factors = problem.factors(); factors != nullptr && factors->w.size() < problem.rows())
    return false;
  constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;
  const mpz_class prime(std::to_string(kPrime));
  const auto multiply = [](std::uint64_t x, std::uint64_t y) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(static_cast<Wide>(x) * y % kPrime);
  };
  const auto inverse = [&multiply](std::uint64_t x) {  // x^(p - 2)
    std::uint64_t power = 1;
    for (std::uint64_t exponent = kPrime - 2; exponent > 0; exponent >>= 1, x = multiply(x, x)) {
      if (exponent & 1) power = multiply(power, x);
    }
    return power;
  };
  const auto residue = [&prime](const mpz_class& x) {
    mpz_class rest;
    mpz_fdiv_r(rest.get_mpz_t(), x.get_mpz_t(), prime.get_mpz_t());
    return static_cast<std::uint64_t>(rest.get_ui());
  };
  const int rows = problem.rows();
  std::vector<std::vector<std::uint64_t>> M(rows, std::vector<std::uint64_t>(rows));
  bool has_residues = true;
  ForEachEntry(problem.entries().A, [&](int i, int j, const Rational& value) {
    const std::uint64_t denominator = residue(value.get_den());
    has_residues &= denominator != 0;
    M[i][j] = multiply(residue(value.get_num()), inverse(denominator));
  });
  if (!has_residues) return false;
  for (int k = 0; k < rows; ++k) {
    Stop::Check();
    int pivot = k;
    while (pivot < rows && M[pivot][k] == 0) ++pivot;
    if (pivot == rows) return false;
    std::swap(M[k], M[pivot]);
    const std::uint64_t scale = inverse(M[k][k]);
    for (int i = k + 1; i < rows; ++i) {
      if (M[i][k] == 0) continue;
      const std::uint64_t factor = kPrime - multiply(M[i][k], scale);
      for (int j = k; j < rows; ++j) M[i][j] = (M[i][j] + multiply(factor, M[k][j])) % kPrime;
    }
  }
  return true;
}

}  // namespace stiction
