// SPDX-License-Identifier: Apache-2.0
// One problem given to a solver under test: how it fails, if it does.

#pragma once

#include <array>
#include <cstdint>

#include "search/under_test/judge_forces.h"
#include "search/under_test/solver_process.h"

namespace stiction {

// The problem as posed. What takes longer than so many seconds of processor time hangs.
Examined Examine(SolverProcess& process, const ContactProblem<double>& posed, double seconds = kSolverSeconds);

// Memory in windows of calls, each twice as long as the one before, after an eighth of the calls. What leaks
// grows in each by as much a call as in the one before, or nearly; what is collected late, or kept for later,
// does not.
class MemoryWindows {
 public:
  // Of so many calls in all; `least`: bytes that they add at least.
  MemoryWindows(std::int64_t calls, std::int64_t least) : calls_(calls), least_(least) {}

  // After so many calls; of a process that ended or was started anew nothing is said.
  void Add(std::int64_t calls, std::int64_t memory);
  // Bytes a call; 0 if it does not leak.
  std::int64_t Growth() const;

 private:
  static constexpr int kEnds = 4;  // of the first eighth, quarter, half, and the whole
  std::int64_t calls_, least_;
  std::array<std::int64_t, kEnds> memory_ = {};
};

// Fewer calls than this say nothing of leaks.
inline constexpr std::int64_t kLeastCallsOfLeak = 1000;

// Bytes that the solver keeps of every call with this problem, alone in a new process, in so many calls; 0 if
// it does not leak.
std::int64_t LeakOf(SolverProcess& process, const ContactProblem<double>& posed, std::int64_t calls);

// What a leak adds at least. Libraries are seen to the page. A program may run in a language that collects its
// garbage late: what it takes before it does is no leak.
std::int64_t LeastLeak(const SolverProcess& process);

}  // namespace stiction
