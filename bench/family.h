// SPDX-License-Identifier: Apache-2.0
// Problems on which methods are compared: positive definite, of numbers so large that ties are improbable.
//
//   A = J J' + I    J square, entries uniform integers in [-1000, 1000]
//   b               uniform integers in [-10^6, 10^6]; a normal's is made <= 0 with probability 3/5
//
// The generators of the search (search/generators/generators.h) promise less: A positive semidefinite, b in
// range(A). They can be compared on, too, with the same friction.
//
// Friction: problem `index` is of class index mod 8, so that every class is as frequent: classes 0 to 6 have
// 0, 1/5, 1/2, 1, 2, 5 and 10 at all contacts, in class 7 every contact draws one of them; a generator draws
// one for all contacts in half of class 7.

#ifndef STICTION_BENCH_FAMILY_H_
#define STICTION_BENCH_FAMILY_H_

#include <cstdint>
#include <optional>

#include "corpus/exact_problem.h"
#include "search/generators/generators.h"

namespace stiction {

struct BenchProblem {
  ExactProblem exact;
  ContactProblem<double> rounded;  // each number of `exact` to the nearest double
};

// A function of its arguments. Without a generator: the family above; `contacts` is then not bounded.
BenchProblem MakeBenchProblem(std::optional<GeneratorId> generator, int contacts, std::uint64_t seed,
                              std::int64_t index);

// The same family with frictionless contacts: one row each.
BenchProblem MakeFrictionless(int contacts, std::uint64_t seed, std::int64_t index);

}  // namespace stiction

#endif  // STICTION_BENCH_FAMILY_H_
