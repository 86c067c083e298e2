// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/outcome_text.h"

#include <fmt/format.h>

#include <cmath>

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

std::string Describe(const Verdict& verdict) {
  const char* unit = verdict.outcome == Outcome::kCycle ? "drives" : "steps";
  if (IsLoop(verdict.outcome)) {
    return fmt::format("{}: the state after {} {} stands again {} {} later, for ever", Name(verdict.outcome),
                       verdict.start, unit, verdict.period, unit);
  }
  if (verdict.outcome == Outcome::kLimit) return fmt::format("limit: out of {}", verdict.reason);
  const std::string name(Name(verdict.outcome));
  return verdict.reason.empty() ? name : fmt::format("{}: {}", name, verdict.reason);
}

}  // namespace stiction
