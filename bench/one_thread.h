// SPDX-License-Identifier: Apache-2.0
// One thread for every package that is measured.
//
// BLAS and OpenMP start as many threads as there are cores, whatever the size of a matrix, unless the
// environment says otherwise when they are loaded: before main. So the program is started once more with these
// variables.

#ifndef STICTION_BENCH_ONE_THREAD_H_
#define STICTION_BENCH_ONE_THREAD_H_

#include <array>

namespace stiction {

inline constexpr std::array kThreadVariables = {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS",
                                                "BLIS_NUM_THREADS"};

// Returns where all of them are 1; otherwise sets them and starts this program anew with the same arguments.
// First of all in main. Programs started from this one inherit them. InputError if it cannot be started.
void RequireOneThread(char** argv);

}  // namespace stiction

#endif  // STICTION_BENCH_ONE_THREAD_H_
