// SPDX-License-Identifier: Apache-2.0
// Eigen under another name, so that no function compiled here is taken for one of the same name elsewhere.
#define Eigen EigenNative
#include "bench/peers/native_lu.h"

#include <Eigen/LU>

namespace stiction {

struct NativeLu::Memory {
  EigenNative::PartialPivLU<EigenNative::MatrixXd> lu;
};

NativeLu::NativeLu() : memory_(std::make_unique<Memory>()) {}
NativeLu::~NativeLu() = default;

void NativeLu::Solve(int rows, const double* A, const double* b, double* x) {
  using Vector = EigenNative::VectorXd;
  memory_->lu.compute(EigenNative::Map<const EigenNative::MatrixXd>(A, rows, rows));
  EigenNative::Map<Vector>(x, rows) = memory_->lu.solve(-EigenNative::Map<const Vector>(b, rows));
}

const char* NativeLu::Instructions() { return EigenNative::SimdInstructionSetsInUse(); }

}  // namespace stiction
