// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/elites.h"

#include <algorithm>

#include "solver/problem/check.h"
#include "solver/problem/solution.h"

namespace stiction {
namespace {

bool Worse(const Assessed& left, const Assessed& right) { return left.worth < right.worth; }

}  // namespace

std::optional<std::size_t> Elites::PlaceFor(const Assessed& assessed) const {
  const auto same = std::find_if(all_.begin(), all_.end(), [&assessed](const Assessed& other) {
    return other.behaviour == assessed.behaviour;
  });
  if (same != all_.end()) {
    if (assessed.worth < same->worth) return std::nullopt;  // equal ones replace it, so that all drifts
    return static_cast<std::size_t>(same - all_.begin());
  }
  if (all_.size() < kMost) return all_.size();
  const auto worst = std::min_element(all_.begin(), all_.end(), Worse);
  if (!(worst->worth < assessed.worth)) return std::nullopt;
  return static_cast<std::size_t>(worst - all_.begin());
}

bool Elites::Admit(Assessed assessed) {
  if (!PlaceFor(assessed)) return false;
  if (assessed.worth.value) assessor_.Confirm(assessed);
  const auto place = PlaceFor(assessed);
  if (!place) return false;
  if (on_loop_ && assessed.confirmed && IsLoop(static_cast<Outcome>(assessed.behaviour[0]))) on_loop_(assessed);
  if (*place == all_.size())
    all_.push_back(std::move(assessed));
  else
    all_[*place] = std::move(assessed);
  return true;
}

const Assessed& Elites::Best() const {
  STICTION_CHECK(!all_.empty(), "there is a best one");
  return *std::max_element(all_.begin(), all_.end(), Worse);
}

const Assessed& Elites::Draw(Choices& random) const {
  STICTION_CHECK(!all_.empty(), "there is somebody to draw");
  const auto last = static_cast<std::int64_t>(all_.size()) - 1;
  const auto rounds = random.Integer(0, 1) == 0 ? random.Integer(1, 4) : 16;
  const Assessed* drawn = nullptr;
  for (std::int64_t k = 0; k < rounds; ++k) {
    const Assessed& next = all_[static_cast<std::size_t>(random.Integer(0, last))];
    if (drawn == nullptr || Worse(*drawn, next)) drawn = &next;
  }
  return *drawn;
}

}  // namespace stiction
