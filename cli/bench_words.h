// SPDX-License-Identifier: Apache-2.0
// The words of `stiction bench`, as rows: what the program stiction-bench reads, and what the help, the man
// pages and the completion say of it.

#pragma once

#include "bench/suite.h"
#include "cli/verb.h"

namespace stiction {

inline constexpr const char* kBenchPurpose = "Benchmark tables: timings, by hand and never as a test";

void AddBenchWords(Verb& verb, BenchOptions& o);

}  // namespace stiction
