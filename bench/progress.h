// SPDX-License-Identifier: Apache-2.0
// How far the program is, on standard error: the parts of a suite, rows of its tables as a rule, and the steps
// of the one at hand. Not for what is being timed: a step calls a clock.

#ifndef STICTION_BENCH_PROGRESS_H_
#define STICTION_BENCH_PROGRESS_H_

#include <cstdint>
#include <cstdio>
#include <string>

namespace stiction::progress {

// How many parts are to come, and where it is said; first of all.
void Expect(std::size_t parts, std::FILE* out = stderr);
// The next part, of so many steps.
void Begin(const std::string& part, std::int64_t steps);
// So many of its steps more are done, or, with 0, it goes on; from any thread.
void Done(std::int64_t steps = 1);
// Before something is printed.
void Clear();

}  // namespace stiction::progress

#endif  // STICTION_BENCH_PROGRESS_H_
