// SPDX-License-Identifier: Apache-2.0
#include "solver/linear/sparse_lu.h"

#include <klu.h>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr double kSuits = 1e-6;  // of y: the largest residual with pivots of another matrix

// KLU does not write through these, but does not say so.
double* Values(const SparseLu::Matrix& K) { return const_cast<double*>(K.valuePtr()); }
int* Columns(const SparseLu::Matrix& K) { return const_cast<int*>(K.outerIndexPtr()); }
int* Rows(const SparseLu::Matrix& K) { return const_cast<int*>(K.innerIndexPtr()); }

}  // namespace

struct SparseLu::Factors {
  Factors() {
    klu_defaults(&common);
    common.scale = -1;  // rows as they are, entries not checked
  }
  ~Factors() {
    klu_free_numeric(&numbers, &common);
    klu_free_symbolic(&order, &common);
  }

  bool Choose(const Matrix& K) {
    klu_free_numeric(&numbers, &common);
    numbers = klu_factor(Columns(K), Rows(K), Values(K), order, &common);
    has_own_pivots = numbers != nullptr && common.status == KLU_OK;
    return has_own_pivots;
  }

  Vector Solve(const Vector& y) {
    Vector x = y;
    klu_solve(order, numbers, static_cast<int>(x.size()), 1, x.data(), &common);
    return x;
  }

  klu_common common;
  klu_symbolic* order = nullptr;
  klu_numeric* numbers = nullptr;
  bool is_chosen = false;       // pivots serve what is factored next
  bool has_own_pivots = false;  // those of the matrix itself
};

SparseLu::SparseLu() : factors_(std::make_unique<Factors>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

void SparseLu::Order(const Matrix& K) {
  STICTION_CHECK(K.isCompressed() && K.rows() == K.cols(), "a compressed square matrix");
  ForgetPivots();
  klu_free_numeric(&factors_->numbers, &factors_->common);
  klu_free_symbolic(&factors_->order, &factors_->common);
  factors_->order = klu_analyze(static_cast<int>(K.cols()), Columns(K), Rows(K), &factors_->common);
}

void SparseLu::ForgetPivots() { factors_->is_chosen = false; }

bool SparseLu::Factor(const Matrix& K) {
  Factors& factors = *factors_;
  if (K.cols() == 0) return true;  // KLU orders no empty matrix
  if (factors.order == nullptr) return false;
  factors.has_own_pivots = false;
  if (!factors.is_chosen ||
      klu_refactor(Columns(K), Rows(K), Values(K), factors.order, factors.numbers, &factors.common) == 0) {
    factors.is_chosen = factors.Choose(K);
  }
  return factors.is_chosen;
}

auto SparseLu::Solve(const Matrix& K, const Vector& y) -> Vector {
  if (y.size() == 0) return y;
  Vector x = factors_->Solve(y);
  if (factors_->has_own_pivots) return x;
  if ((y - K * x).cwiseAbs().maxCoeff() <= kSuits * y.cwiseAbs().maxCoeff()) return x;
  factors_->is_chosen = factors_->Choose(K);
  return factors_->is_chosen ? factors_->Solve(y) : x;
}

}  // namespace stiction
