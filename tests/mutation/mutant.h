// SPDX-License-Identifier: Apache-2.0
// MUTANT(k): whether this process runs with the k-th bug (mutate.py), which the environment variable
// STICTION_MUTANT chooses, read once; without it there is none. That the place was reached is noted in the file
// that STICTION_REACHED names, a byte for each bug, which the processes of a test share.

#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace stiction::testing {

constexpr int kMostMutants = 4096;  // as in mutate.py

struct Mutants {
  char unnoted[kMostMutants] = {};
  char* reached = unnoted;
  int chosen = 0;

  constexpr Mutants() = default;

  void Read() {
    if (const char* text = std::getenv("STICTION_MUTANT")) chosen = std::atoi(text);
    const char* name = std::getenv("STICTION_REACHED");
    const int file = name == nullptr ? -1 : open(name, O_RDWR | O_CLOEXEC);
    if (file < 0) return;
    void* shared = mmap(nullptr, kMostMutants, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (shared != MAP_FAILED) reached = static_cast<char*>(shared);
  }
};

inline constinit Mutants mutants;
inline const bool mutants_are_read = (mutants.Read(), true);

}  // namespace stiction::testing

#define MUTANT(k) (::stiction::testing::mutants.reached[k] = 1, ::stiction::testing::mutants.chosen == (k))
