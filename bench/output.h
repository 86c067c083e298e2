// SPDX-License-Identifier: Apache-2.0
// What suites print: tables, for people and for JSON; and on standard error how far they are.

#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

// Rows are objects with the same keys.
struct BenchTable {
  std::string name, title;
  std::vector<SharedJson> rows = {};
};

// On standard output. In cells, objects count by name; arrays are quartiles.
void Print(const BenchTable& table);

}  // namespace stiction

// The parts of a suite, rows of its tables as a rule, and the steps of the one at hand. Not for what is being
// timed: a step calls a clock.
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
