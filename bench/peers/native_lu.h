// SPDX-License-Identifier: Apache-2.0
// Eigen's LU once more, compiled for the processor that builds it (-march=native), beside the LU of the tables,
// which has the instructions that every x86-64 processor has. No type of Eigen's here: native_lu.cpp has its
// own.

#pragma once

#include <memory>

namespace stiction {

class NativeLu {
 public:
  NativeLu();
  ~NativeLu();
  // Solves A x = -b; A: rows x rows by columns.
  void Solve(int rows, const double* A, const double* b, double* x);

  static const char* Instructions();  // that Eigen uses there

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace stiction
