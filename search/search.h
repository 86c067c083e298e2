// SPDX-License-Identifier: Apache-2.0
// The search: units and findings of a campaign, on all cores, into a store.
//
// Threads take the units of the shard in ascending order and, in turn, findings to finish, which take a bounded
// share of their processor time (backlog.h). What the store holds in the end depends on which units were run
// and on nothing else, but for which findings are finished already, and the work that it took.

#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "search/campaign.h"

namespace stiction {

inline constexpr double kFinishingShare = 0.2;              // of processor time
inline constexpr double kFinishingShareOfObjective = 0.05;  // where what is sought is better candidates
inline constexpr std::int64_t kMostFinished = 100;          // of one kind and number of contacts

struct SearchProgress {
  double seconds = 0;
  std::int64_t problems = 0;         // that the store holds
  std::int64_t problems_before = 0;  // of these, what it held before this call
  std::int64_t units_done = 0;       // of this shard, with those of earlier calls if --problems is given
  std::optional<std::int64_t> units_wanted;  // of this shard
  std::int64_t groups = 0;                   // signatures that the store holds
  std::int64_t findings = 0;                 // likewise
  std::int64_t finished = 0;                 // in this call
  std::int64_t pending = 0;                  // representatives to finish
  bool only_finishes = false;
  std::int64_t left_out = 0;  // for which there is no room (backlog.h)
  ProcessorTime time;         // in this call
  // Since the last report: representatives of groups that the store did not have, and what turned out to be
  // grave.
  std::vector<Finding> news;
};

struct SearchOptions {
  std::filesystem::path store;
  std::string build;    // that works
  std::string machine;  // likewise; empty: not recorded
  Shard shard;
  int threads = 1;
  std::optional<double> minutes;         // wall clock, everything counted
  std::optional<std::int64_t> problems;  // of the whole campaign, rounded up to whole units
  std::optional<double> finishing;  // share of processor time, 0 to 1; by default as above; 0: none, 1: all
  std::vector<std::string> solver;  // runs the solver under test (under_test/solver_process.h); empty: none
  bool only_finish = false;         // no units: all findings that are not finished
  const std::atomic<bool>* interrupted = nullptr;
  // The store is open: called before the first unit.
  std::function<void(const SearchProgress&)> started = {};
};

// kDone: all that was asked for was done, before or now. kLeft: all units were run, and findings are not
// finished (SearchOptions::finishing).
enum class SearchEnd { kDone, kLeft, kTimeUp, kInterrupted };

struct SearchReport {
  SearchEnd end = SearchEnd::kDone;
  SearchProgress progress;
};

// InputError that names the holder if another process works on the shard; OutputError if the store cannot be
// written, which loses the units that were being worked on and nothing else.
// `show` is called about twice a second from the calling thread; the search does not wait for it.
SearchReport RunSearch(const Campaign& campaign, const CampaignIdentity& identity, const SearchOptions& options,
                       const std::function<void(const SearchProgress&)>& show);

}  // namespace stiction
