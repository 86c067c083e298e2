// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/properties.h"

#include "corpus/stop.h"
#include "solver/linear/elimination.ipp"

namespace stiction {
namespace {

// x with L'x = y for a unit lower triangular L.
ExactVector SolveTransposed(const ExactMatrix& L, ExactVector y) {
  for (int i = static_cast<int>(y.size()) - 1; i >= 0; --i) {
    for (int k = i + 1; k < y.size(); ++k) y[i] -= L(k, i) * y[k];
  }
  return y;
}

// y with y'Sy < 0 for a Schur complement S whose leading entry, at k, has no legal pivot. Empty if it has.
std::optional<ExactVector> CurvatureOfSchur(const ExactMatrix& S, int k) {
  const int size = static_cast<int>(S.rows());
  ExactVector y = ExactVector::Zero(size);
  if (S(k, k) < 0) {
    y[k] = 1;
    return y;
  }
  if (S(k, k) > 0) return std::nullopt;
  for (int i = k + 1; i < size; ++i) {
    if (S(i, k) == 0) continue;
    y[k] = -(S(i, i) + 1) / (2 * S(i, k));  // y'Sy = 2 y_k S_ik + S_ii = -1
    y[i] = 1;
    return y;
  }
  return std::nullopt;
}

// One column of A = L diag(D) L': S becomes the next Schur complement.
void EliminateColumn(ExactMatrix& S, ExactMatrix& L, int k) {
  const int size = static_cast<int>(S.rows());
  if (S(k, k) == 0) return;
  for (int i = k + 1; i < size; ++i) L(i, k) = S(i, k) / S(k, k);
  for (int i = k + 1; i < size; ++i) {
    if (L(i, k) == 0) continue;
    for (int j = k + 1; j < size; ++j) S(i, j) -= L(i, k) * S(k, j);
  }
}

}  // namespace

std::optional<std::pair<int, int>> FindAsymmetry(const ExactMatrix& A) {
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = i + 1; j < A.cols(); ++j) {
      if (A(i, j) != A(j, i)) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

std::variant<LdltFactors, Obstacle> DecideSemidefinite(const ExactMatrix& A) {
  const int size = static_cast<int>(A.rows());
  ExactMatrix S = (A + A.transpose()) / Rational(2);
  LdltFactors factors{ExactMatrix::Identity(size, size), ExactVector::Zero(size)};
  for (int k = 0; k < size; ++k) {
    Stop::Check();
    if (const auto y = CurvatureOfSchur(S, k)) {
      const ExactVector x = SolveTransposed(factors.L, *y);
      return Obstacle{x, x.dot(A * x)};
    }
    factors.D[k] = S(k, k);
    EliminateColumn(S, factors.L, k);
  }
  return factors;
}

std::variant<LdltFactors, Obstacle> DecideDefinite(const ExactMatrix& A) {
  auto decision = DecideSemidefinite(A);
  const auto* factors = std::get_if<LdltFactors>(&decision);
  for (int k = 0; factors != nullptr && k < factors->D.size(); ++k) {
    if (factors->D[k] == 0) return Obstacle{SolveTransposed(factors->L, ExactVector::Unit(A.rows(), k)), 0};
  }
  return decision;
}

int RankOf(const ExactMatrix& A) {
  const int size = static_cast<int>(A.rows());
  Elimination<Rational> elimination;
  elimination.Assign(A);
  elimination.Run(size, size, size);
  return elimination.rank();
}

bool IsSymmetric(const ExactProblem& problem) { return !FindAsymmetry(problem.A); }

bool IsPositiveSemidefinite(const ExactProblem& problem) {
  return std::holds_alternative<LdltFactors>(DecideSemidefinite(problem.A));
}

// Without witnesses.
bool IsInRange(const ExactProblem& problem) {
  const int size = problem.rows();
  ExactMatrix M(size, size + 1);
  M.leftCols(size) = problem.A;
  M.col(size) = problem.b;
  Elimination<Rational> elimination;
  elimination.Assign(M);
  elimination.Run(size, size, size + 1);
  return elimination.IsConsistent(size);
}

bool MeetsAssumptions(const ExactProblem& problem) {
  return IsSymmetric(problem) && IsPositiveSemidefinite(problem) && IsInRange(problem);
}

}  // namespace stiction
