// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/examine.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/record/kinds.h"
#include "solver/problem/check.h"

namespace stiction {

bool Examined::Fails() const { return IsOfSolver(kind); }

std::string Examined::Signature(std::size_t contacts) const {
  STICTION_CHECK(Fails(), "a signature is of a failure");
  return fmt::format("{}{}{}-{}c", kind, what.empty() ? "" : "-", what, contacts);
}

Examined Examine(SolverProcess& process, const ContactProblem<double>& posed, double seconds) {
  const SolverReply reply = process.Solve(posed, seconds);
  if (reply.end == SolverEnd::kCrashed) return {.kind = "crash", .what = reply.how};
  if (reply.end == SolverEnd::kHung) return {.kind = "hang", .what = reply.how};
  const SolverUnderTest& about = process.about();
  if (!reply.solved) {
    const bool in_space = about.law == SolverLaw::kCoulomb && posed.dimension == 3;
    const auto solution = in_space ? NearSolution(posed) : SolutionUnder(about.law, posed);
    return {.kind = solution ? "refused-solvable" : "refused", .what = ""};
  }
  Examined examined = {.kind = "not-finite", .what = "", .says_solved = true};
  if (!reply.f.allFinite()) return examined;
  const JudgedForces judged = JudgeForces(posed, about.law, *ParseRational(about.accuracy), reply.f);
  examined.kind = !judged.is_known ? "unjudged" : judged.miss.empty() ? "passed" : "silent-wrong";
  examined.what = judged.miss;
  examined.error = judged.error;
  examined.misses_coulomb = judged.misses_coulomb;
  return examined;
}

std::int64_t LeakOf(SolverProcess& process, const ContactProblem<double>& posed) {
  constexpr int kCalls = 150, kWindows = 3;
  process.Restart();
  std::int64_t before = 0, growth = 0;
  for (int window = 0; window <= kWindows; ++window) {  // in the first it warms up
    for (int call = 0; call < kCalls; ++call)
      if (process.Solve(posed).end != SolverEnd::kAnswered) return 0;
    const std::int64_t now = process.Memory();
    if (window > 0 && now <= before) return 0;
    if (window > 0) growth += now - before;
    before = now;
  }
  return growth / (kWindows * kCalls);
}

}  // namespace stiction
