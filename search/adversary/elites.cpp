// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/elites.h"

#include <algorithm>

#include "solver/problem/check.h"

namespace stiction {
namespace {

bool Worse(const Judged& left, const Judged& right) { return left.score < right.score; }

}  // namespace

std::optional<std::size_t> Elites::PlaceFor(const Judged& judged) const {
  const auto same = std::find_if(all_.begin(), all_.end(),
                                 [&judged](const Judged& other) { return other.behaviour == judged.behaviour; });
  if (same != all_.end()) {
    if (judged.score < same->score) return std::nullopt;  // equal ones replace it, so that all drifts
    return static_cast<std::size_t>(same - all_.begin());
  }
  if (all_.size() < kMost) return all_.size();
  const auto worst = std::min_element(all_.begin(), all_.end(), Worse);
  if (!(worst->score < judged.score)) return std::nullopt;
  return static_cast<std::size_t>(worst - all_.begin());
}

bool Elites::Admit(Judged judged) {
  if (!PlaceFor(judged)) return false;
  judge_.Confirm(judged);
  const auto place = PlaceFor(judged);
  if (!place) return false;
  if (on_loop_ && IsLoop(static_cast<Outcome>(judged.behaviour[0]))) on_loop_(judged);
  if (*place == all_.size())
    all_.push_back(std::move(judged));
  else
    all_[*place] = std::move(judged);
  return true;
}

const Judged& Elites::Best() const {
  STICTION_CHECK(!all_.empty(), "there is a best one");
  return *std::max_element(all_.begin(), all_.end(), Worse);
}

const Judged& Elites::Draw(Choices& random) const {
  STICTION_CHECK(!all_.empty(), "there is somebody to draw");
  const auto last = static_cast<std::int64_t>(all_.size()) - 1;
  const auto rounds = random.Integer(1, 4);
  const Judged* drawn = nullptr;
  for (std::int64_t k = 0; k < rounds; ++k) {
    const Judged& next = all_[static_cast<std::size_t>(random.Integer(0, last))];
    if (drawn == nullptr || Worse(*drawn, next)) drawn = &next;
  }
  return *drawn;
}

}  // namespace stiction
