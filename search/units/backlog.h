// SPDX-License-Identifier: Apache-2.0
// The findings that wait to be finished: how many, and which comes next.
//
// Fewest contacts first: they are the quickest to minimize and the most wanted. Of one kind and number of
// contacts at most so many are finished or wait; a grave one always waits. What has no room is left out until
// somebody asks for all. None of this changes what a search finds.

#ifndef STICTION_SEARCH_UNITS_BACKLOG_H_
#define STICTION_SEARCH_UNITS_BACKLOG_H_

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace stiction

#endif  // STICTION_SEARCH_UNITS_BACKLOG_H_
