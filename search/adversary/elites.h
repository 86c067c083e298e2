// SPDX-License-Identifier: Apache-2.0
// Elites: the best candidates of every behaviour. Every value is one over rationals; how near a candidate
// without one is to a loop may be one over doubles.

#ifndef STICTION_SEARCH_ADVERSARY_ELITES_H_
#define STICTION_SEARCH_ADVERSARY_ELITES_H_

#include <functional>
#include <vector>

#include "search/adversary/assessor.h"

namespace stiction {

class Elites {
 public:
  static constexpr std::size_t kMost = 48;

  // `on_loop` is called for every loop that is taken in.
  explicit Elites(Assessor& assessor, std::function<void(const Assessed&)> on_loop = {})
      : assessor_(assessor), on_loop_(std::move(on_loop)) {}

  // Whether the candidate was taken in: it is no worse than the one of its behaviour, or has a new one and is
  // not the worst of a full house. What would be taken in with a value is confirmed first, and then asked
  // again.
  bool Admit(Assessed assessed);

  bool empty() const { return all_.empty(); }
  // In the order in which behaviours came.
  const std::vector<Assessed>& all() const { return all_; }
  // Requires: not empty.
  const Assessed& Best() const;
  // The best of a few drawn at random.
  const Assessed& Draw(Choices& random) const;

 private:
  // Where it would stand; all_.size() for a new place, none if it is not wanted.
  std::optional<std::size_t> PlaceFor(const Assessed& assessed) const;

  Assessor& assessor_;
  std::function<void(const Assessed&)> on_loop_;
  std::vector<Assessed> all_;
};

}  // namespace stiction

#endif  // STICTION_SEARCH_ADVERSARY_ELITES_H_
