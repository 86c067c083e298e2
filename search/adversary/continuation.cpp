// SPDX-License-Identifier: Apache-2.0
// Continuation: from a loop along a line as far as it stays one and becomes better, then along another line.
//
// In the interior of the parameters with one word the conditions of a loop are polynomial inequalities, so a
// line stays inside up to a border; where it leaves, the run beyond is another word, which is looked at like
// any candidate. Steps are doubled as long as they are taken in and halved where they are not.

#include <algorithm>

#include "search/adversary/optimizer.h"

namespace stiction {
namespace {

// One coordinate, two, or all of them, by directions of up to 2^-3 of each range.
std::vector<double> Direction(const std::vector<Choice>& made, const std::vector<std::size_t>& wide,
                              Choices& random) {
  std::vector<double> direction(made.size(), 0.0);
  const auto size = static_cast<std::int64_t>(wide.size());
  const auto kind = random.Integer(0, 2);
  const auto set = [&](std::size_t i) {
    const double span = static_cast<double>(made[i].high - made[i].low);
    direction[i] = span / 8 * static_cast<double>(random.Integer(-1024, 1024)) / 1024;
  };
  if (kind == 2) {
    for (const std::size_t i : wide) set(i);
  } else {
    for (std::int64_t k = 0; k <= kind; ++k) set(wide[static_cast<std::size_t>(random.Integer(0, size - 1))]);
  }
  return direction;
}

Candidate Moved(const Assessed& from, const std::vector<double>& direction, double step) {
  Candidate moved = from.candidate;
  for (std::size_t i = 0; i < from.made.size(); ++i) {
    const auto by = static_cast<std::int64_t>(direction[i] * step);
    moved.choices[i] = std::clamp(from.made[i].value + by, from.made[i].low, from.made[i].high);
  }
  return moved;
}

// As far as the line is good.
void Walk(Attempt& attempt, const Assessed& from, const std::vector<double>& direction, double first) {
  double step = first, reached = 0;
  bool growing = true;
  for (int k = 0; k < 12 && !attempt.Ended(); ++k) {
    Candidate moved = Moved(from, direction, reached + step);
    if (moved.choices != from.candidate.choices && attempt.Try(std::move(moved))) {
      reached += step;
      if (growing) step *= 2;
    } else {
      growing = false;
      step /= 4;
    }
  }
}

void LowerFriction(Attempt& attempt, Candidate candidate) {
  for (int k = 2; k <= 10 && !attempt.Ended(); ++k) {
    while (!attempt.Ended()) {
      Candidate lowered = candidate;
      lowered.mu = Lowered(candidate.mu, k, LargestMuPart(candidate.generator));
      if (lowered.mu == candidate.mu || !attempt.TryValue(lowered)) break;
      candidate = lowered;
    }
  }
}

}  // namespace

Optimized Continue(const Optimization& optimization) {
  Attempt attempt(optimization);
  Choices& random = attempt.random();
  attempt.Begin();
  while (!attempt.Ended()) {
    const Assessed from = random.Integer(0, 1) == 0 ? attempt.Best() : attempt.Draw();
    if (optimization.objective->lowers_friction && from.worth.value && random.Integer(0, 15) == 0)
      LowerFriction(attempt, from.candidate);
    const std::vector<std::size_t> wide = WideChoices(from.made);
    if (wide.empty()) {
      attempt.Try(attempt.Random());
      continue;
    }
    const std::vector<double> direction = Direction(from.made, wide, random);
    const double first = 1.0 / static_cast<double>(1 << random.Integer(0, 10));
    Walk(attempt, from, direction, first);
  }
  return attempt.Take();
}

}  // namespace stiction
