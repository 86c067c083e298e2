// SPDX-License-Identifier: Apache-2.0
// Tables of the benchmarks, for people and for JSON.

#ifndef STICTION_BENCH_TABLE_H_
#define STICTION_BENCH_TABLE_H_

#include <string>

#include "corpus/json.h"

namespace stiction {

// Rows are objects with the same keys.
struct BenchTable {
  std::string name, title;
  Json rows = Json::array();
};

// On standard output. In cells, objects count by name; arrays are quartiles.
void Print(const BenchTable& table);

}  // namespace stiction

#endif  // STICTION_BENCH_TABLE_H_
