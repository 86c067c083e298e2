// SPDX-License-Identifier: Apache-2.0
// MUTANT(k): whether this process runs with the k-th bug (mutate.py). The environment variable STICTION_MUTANT
// chooses it, and is read once; without it there is none.

#ifndef STICTION_TESTS_MUTATION_MUTANT_H_
#define STICTION_TESTS_MUTATION_MUTANT_H_

#include <cstdlib>

namespace stiction::testing {

inline int ChosenMutant() {
  static const int chosen = [] {
    const char* text = std::getenv("STICTION_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return chosen;
}

}  // namespace stiction::testing

#define MUTANT(k) (::stiction::testing::ChosenMutant() == (k))

#endif  // STICTION_TESTS_MUTATION_MUTANT_H_
