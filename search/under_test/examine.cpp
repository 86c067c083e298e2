// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/examine.h"

#include <algorithm>

namespace stiction {

Examined Examine(SolverProcess& process, const ContactProblem<double>& posed, double seconds) {
  const SolverReply reply = process.Solve(posed, seconds);
  if (reply.end == SolverEnd::kCrashed) return {.kind = "crash", .what = reply.how};
  if (reply.end == SolverEnd::kHung) return {.kind = "hang", .what = reply.how};
  if (reply.end == SolverEnd::kStopped) return {.kind = "stopped", .what = ""};
  const SolverUnderTest& about = process.about();
  if (!reply.solved) {
    const bool in_space = about.law == SolverLaw::kCoulomb && posed.dimension == 3;
    const auto solution = in_space ? NearSolution(posed) : SolutionUnder(about.law, posed);
    return {.kind = solution ? "refused-solvable" : "refused", .what = ""};
  }
  Examined judged = JudgeForces(posed, about.law, *ParseRational(about.accuracy), reply.f);
  if (!reply.is_in_range) judged.what = "out-of-range";  // and not finite
  return judged;
}

void MemoryWindows::Add(std::int64_t calls, std::int64_t memory) {
  for (int end = 0; end < kEnds; ++end)
    if (calls == calls_ >> (kEnds - 1 - end)) memory_[static_cast<std::size_t>(end)] = memory;
}

std::int64_t MemoryWindows::Growth() const {
  constexpr double kSteady = 0.75;  // of the growth before; what fills up falls to a half and less
  const double slack = static_cast<double>(least_) / 8;  // memory is taken in pieces
  if (std::ranges::find(memory_, 0) != memory_.end()) return 0;
  double before = 0;
  for (std::size_t end = 1; end < memory_.size(); ++end) {
    const std::int64_t calls = (calls_ >> (memory_.size() - 1 - end)) - (calls_ >> (memory_.size() - end));
    const auto growth = static_cast<double>(memory_[end] - memory_[end - 1]), span = static_cast<double>(calls);
    if (growth <= 0 || growth + slack < kSteady * before * span) return 0;
    before = growth / span;
  }
  const std::int64_t added = memory_.back() - memory_.front();
  return added < least_ ? 0 : std::max<std::int64_t>(1, added / (calls_ - (calls_ >> (kEnds - 1))));
}

std::int64_t LeakOf(SolverProcess& process, const ContactProblem<double>& posed, std::int64_t calls) {
  process.Restart();
  MemoryWindows windows(calls, LeastLeak(process));
  for (std::int64_t call = 1; call <= calls; ++call) {
    if (process.Solve(posed).end != SolverEnd::kAnswered) return 0;
    windows.Add(call, process.Memory());
  }
  return windows.Growth();
}

std::int64_t LeastLeak(const SolverProcess& process) {
  constexpr std::int64_t kOfLibrary = std::int64_t{1} << 16, kOfProgram = std::int64_t{1} << 22;
  return process.IsLibrary() ? kOfLibrary : kOfProgram;
}

}  // namespace stiction
