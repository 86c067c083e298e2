// SPDX-License-Identifier: Apache-2.0
// Evolution: mutants and crossings of recorded choices.

#include <algorithm>
#include <bit>

#include "search/adversary/optimizer.h"

namespace stiction {
namespace {

std::int64_t Below(Choices& random, std::size_t size) {
  return random.Integer(0, static_cast<std::int64_t>(size) - 1);
}

// Another value of its range, near or far.
std::int64_t Changed(const Choice& choice, Choices& random) {
  const std::int64_t span = choice.high - choice.low;
  if (span == 0) return choice.value;
  if (random.Integer(0, 2) == 0) return random.Integer(choice.low, choice.high);
  const int bits = std::bit_width(static_cast<std::uint64_t>(span));
  const std::int64_t most = std::int64_t{1} << random.Integer(0, bits - 1);
  const std::int64_t length = random.Integer(1, most);
  const std::int64_t step = random.Integer(0, 1) == 0 ? length : -length;
  return std::clamp(choice.value + step, choice.low, choice.high);
}

// One to a few choices changed; now and then one taken out or put in, which shifts what follows.
std::vector<std::int64_t> Mutant(const std::vector<Choice>& parent, Choices& random) {
  std::vector<std::int64_t> values;
  for (const Choice& choice : parent) values.push_back(choice.value);
  if (values.empty()) return values;
  int changes = 1;
  while (changes < 16 && random.Integer(0, 1) == 1) ++changes;
  for (int k = 0; k < changes; ++k) {
    const auto at = static_cast<std::size_t>(Below(random, parent.size()));
    values[at] = random.Integer(0, 7) == 0 ? values[static_cast<std::size_t>(Below(random, parent.size()))]
                                           : Changed(parent[at], random);
  }
  if (random.Integer(0, 31) == 0) values.erase(values.begin() + Below(random, values.size()));
  if (random.Integer(0, 31) == 0 && !values.empty()) {
    const auto at = Below(random, values.size());
    const std::int64_t value = values[static_cast<std::size_t>(Below(random, values.size()))];
    values.insert(values.begin() + at, value);
  }
  return values;
}

// The head of one and the tail of another, or some contacts of one among those of the other: rows of J come in
// periods of two per contact.
std::vector<std::int64_t> Crossed(const std::vector<std::int64_t>& left, const std::vector<std::int64_t>& right,
                                  int contacts, Choices& random) {
  std::vector<std::int64_t> child = left;
  const std::size_t common = std::min(left.size(), right.size());
  if (common == 0) return child;
  if (random.Integer(0, 1) == 0) {
    const auto cut = Below(random, common);
    child.resize(static_cast<std::size_t>(cut));
    child.insert(child.end(), right.begin() + cut, right.end());
    return child;
  }
  const auto first = static_cast<std::size_t>(Below(random, common));
  const auto taken = static_cast<std::uint64_t>(random.Integer(1, (std::int64_t{1} << contacts) - 1));
  for (std::size_t i = first; i < common; ++i) {
    const std::size_t contact = (i - first) / 2 % static_cast<std::size_t>(contacts);
    if ((taken >> contact & 1) != 0) child[i] = right[i];
  }
  return child;
}

// Lower, or another of the palette.
MuChoice ChangedFriction(const Attempt& attempt, const MuChoice& mu, Choices& random) {
  const Optimization& o = attempt.optimization();
  if (o.objective->lowers_friction)
    return Lowered(mu, static_cast<int>(random.Integer(1, 8)), LargestMuPart(o.like.generator));
  return o.palette[static_cast<std::size_t>(Below(random, o.palette.size()))];
}

}  // namespace

Optimized Evolve(const Optimization& optimization) {
  Attempt attempt(optimization);
  Choices& random = attempt.random();
  attempt.Begin();
  while (!attempt.Ended()) {
    if (random.Integer(0, 63) == 0) {  // a new line
      attempt.Try(attempt.Random());
      continue;
    }
    const Assessed parent = attempt.Draw();
    Candidate child = parent.candidate;
    if (random.Integer(0, 7) == 0) {
      child.choices = Crossed(child.choices, attempt.Draw().candidate.choices, child.contacts, random);
    } else {
      child.choices = Mutant(parent.made, random);
    }
    const bool lowers = optimization.objective->lowers_friction;
    if ((!lowers || parent.worth.value) && random.Integer(0, 3) == 0)
      child.mu = ChangedFriction(attempt, child.mu, random);
    if (!attempt.Try(child) || !lowers || !parent.worth.value) continue;
    // While it goes down, further down.
    while (!attempt.Ended()) {
      const MuChoice lower = Lowered(child.mu, 4, LargestMuPart(child.generator));
      if (lower == child.mu) break;
      child.mu = lower;
      if (!attempt.TryValue(child)) break;
    }
  }
  return attempt.Take();
}

}  // namespace stiction
