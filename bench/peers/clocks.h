// SPDX-License-Identifier: Apache-2.0
// The clocks that show that one thread works, and what is said of it.

#ifndef STICTION_BENCH_PEERS_CLOCKS_H_
#define STICTION_BENCH_PEERS_CLOCKS_H_

#include <string>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

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

#endif  // STICTION_BENCH_PEERS_CLOCKS_H_
