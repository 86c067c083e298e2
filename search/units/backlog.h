// SPDX-License-Identifier: Apache-2.0
// The findings that wait to be finished: how many, which comes next, and for how long.
//
// Fewest contacts first: they are the quickest to minimize and the most wanted. Of one kind and number of
// contacts at most so many are finished or wait; a grave one always waits. What has no room is left out until
// somebody asks for all. None of this changes what a search finds.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "corpus/store/store.h"

namespace stiction {

class Backlog {
 public:
  // Of one kind and number of contacts; empty: all.
  explicit Backlog(std::optional<std::int64_t> most) : most_(most) {}

  struct Entry {
    int tries = 0;  // that ran out of time
    Finding finding;

    bool operator<(const Entry& other) const;
  };

  // A representative, finished or not. One of the same signature before gives way.
  void Add(Finding finding);
  // The next one, which is in work until it is given back.
  std::optional<Entry> Take();
  void GiveBack(Entry entry);

  std::int64_t waiting() const { return static_cast<std::int64_t>(waiting_.size()); }
  std::int64_t left_out() const { return static_cast<std::int64_t>(left_out_.size()); }

 private:
  using Class = std::pair<std::string, int>;  // kind, contacts
  struct Admitted {
    Class of;
    std::int64_t unit = 0, index = 0;
  };
  void Forget(const std::string& signature);

  std::optional<std::int64_t> most_;
  std::set<Entry> waiting_;
  std::map<std::string, Admitted> admitted_;  // finished, waiting or in work, by signature
  std::map<Class, std::int64_t> sizes_;       // of what is admitted
  std::set<std::string> left_out_;
};

// How long a thread may work on findings, beside its units.
//
// A share of its processor time, and after the last unit half a minute at least, so that a short search brings
// its findings home. A try takes two seconds at first and four times as much at each further one of the same
// finding. While there are units a try may go that far beyond the share, which the units after it make up for;
// after the last one it may not.
struct FinishingTime {
  static constexpr double kFirstTry = 2;        // seconds
  static constexpr double kAfterLastUnit = 30;  // at least, of one thread
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  double share = 0;                     // 0 to 1; 0: none, 1: no bound
  double searching = 0, finishing = 0;  // processor seconds that the thread has spent

  // Seconds for a finding that was tried so often in vain. Not positive: none now.
  double ForTry(int tries, bool units_left) const {
    if (share <= 0) return 0;
    if (share >= 1) return kNoBound;
    const double left = share / (1 - share) * searching - finishing;
    const double one_try = kFirstTry * std::pow(4, tries);
    if (units_left) return left >= 0 ? left + one_try : 0;
    return std::min(one_try, std::max(left, kAfterLastUnit - finishing));
  }
};

}  // namespace stiction
