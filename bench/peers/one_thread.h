// SPDX-License-Identifier: Apache-2.0
// One thread for every package that is measured, and the clocks that show it.
//
// BLAS and OpenMP start as many threads as there are cores, whatever the size of a matrix, unless the
// environment says otherwise when they are loaded: before main. So the program is started once more with these
// variables.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

inline constexpr std::array kThreadVariables = {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS",
                                                "BLIS_NUM_THREADS"};

// Returns where all of them are 1; otherwise sets them and starts this program anew with the same arguments.
// First of all in main. Programs started from this one inherit them. InputError if it cannot be started.
void RequireOneThread(char** argv);

// s: wall-clock time; processor time of all threads, and of the calling one. On one thread the last two are
// equal, and no more than the first.
struct Clocks {
  double wall = 0, all = 0, own = 0;

  // What other programs do not lengthen.
  double Least() const { return wall < all ? wall : all; }
  Clocks& operator+=(const Clocks& other);
  friend Clocks operator-(const Clocks& left, const Clocks& right);
};
Clocks ReadClocks();

// Threads of this process now.
int ThreadCount();
// File names of the libraries that this process has loaded and that are a BLAS or LAPACK.
std::vector<std::string> LoadedBlas();

// Variables and libraries; the same in a sentence.
Json ThreadsJson();
std::string ThreadsText();

Json ToJson(const Clocks& clocks);
// The clocks of a run that is over, with ThreadCount(): where a second thread would show.
std::string ClocksText(const Clocks& clocks);

}  // namespace stiction
