// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/outcome_text.h"

#include <fmt/format.h>

#include <cmath>

#include "corpus/record/loop_sentence.h"

namespace stiction {

std::string Text(const Rational& x, FractionText fractions) {
  constexpr std::size_t kLong = 20;
  std::string text = ToString(x);
  if (fractions == FractionText::kFull || text.size() <= kLong) return text;
  const double nearest = ToDouble(x);
  if (!std::isfinite(nearest)) return text;
  return Rational(nearest) == x ? fmt::format("{}", nearest) : fmt::format("~{:.6g}", nearest);
}

std::string Text(double x, FractionText) { return fmt::format("{:.6g}", x + 0.0); }  // no -0
std::string ShortText(double x) { return x == 0 ? "0" : fmt::format("{:.0e}", x); }

std::string DescribeEnd(Outcome outcome, std::string_view reason, std::int64_t start, std::int64_t period) {
  if (IsLoop(outcome)) {
    // A reason stands behind a loop in space alone, which stays in a box (certify/exact/published_space.h).
    const ProvedRun run{reason.empty() ? ProofKind::kStates : ProofKind::kBox, start, period};
    return fmt::format("{}: {}", Name(outcome), LoopSentence(run, UnitOf(outcome)));
  }
  if (outcome == Outcome::kLimit) return fmt::format("limit: out of {}", reason);
  const std::string name(Name(outcome));
  return reason.empty() ? name : fmt::format("{}: {}", name, reason);
}

}  // namespace stiction
