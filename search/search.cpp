// SPDX-License-Identifier: Apache-2.0
#include "search/search.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <tuple>
#include <vector>

#include "corpus/store_lock.h"
#include "search/adversary/optimized_unit.h"
#include "search/finish.h"
#include "search/unit.h"

namespace stiction {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

// Fewest contacts first: they are the quickest to minimize and the most wanted.
struct FinishOrder {
  bool operator()(const Finding& left, const Finding& right) const {
    return std::tie(left.contacts, left.unit, left.index, left.signature) <
           std::tie(right.contacts, right.unit, right.index, right.signature);
  }
};

class Search {
 public:
  Search(const Campaign& campaign, const CampaignIdentity& identity, const SearchOptions& options)
      : campaign_(campaign),
        options_(options),
        lock_(options.store, options.shard),
        store_(options.store, identity),
        done_(store_.Units()),
        heritage_(campaign, options.shard) {
    for (const auto& [unit, text] : store_.Elites())
      heritage_.Add(unit, ElitesFromText(text, options.store.string()));
    for (Finding& finding : store_.Pending()) pending_.insert(std::move(finding));
    if (!options.problems) return;
    wanted_units_ = UnitsFor(campaign, *options.problems);
    progress_.units_wanted =
        (*wanted_units_ - options.shard.index + options.shard.count - 1) / options.shard.count;
    progress_.units_done = std::min(done_.Count(), *progress_.units_wanted);
  }

  SearchReport Run(const std::function<void(const SearchProgress&)>& show) {
    start_ = Clock::now();
    if (options_.minutes)
      deadline_ =
          start_ + std::chrono::duration_cast<Clock::duration>(duration<double>(*options_.minutes * 60));
    std::vector<std::jthread> workers;
    running_ = options_.threads;
    for (int i = 0; i < options_.threads; ++i) workers.emplace_back([this] { Work(); });
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, std::chrono::milliseconds(500), [this] { return running_ == 0; }))
      show(Progress());
    if (failure_) std::rethrow_exception(failure_);
    show(Progress());
    return {End(), Progress()};
  }

 private:
  bool Interrupted() const { return options_.interrupted != nullptr && *options_.interrupted; }
  bool TimeUp() const { return deadline_ && Clock::now() >= *deadline_; }
  bool Stopped() const { return failed_ || Interrupted() || TimeUp(); }

  SearchEnd End() const {
    if (Interrupted()) return SearchEnd::kInterrupted;
    const bool unfinished = abandoned_ || !pending_.empty() || !wanted_units_ || next_unit_ < *wanted_units_;
    return unfinished ? SearchEnd::kTimeUp : SearchEnd::kDone;
  }

  SearchProgress Progress() const {  // under the mutex
    SearchProgress progress = progress_;
    progress.seconds = duration<double>(Clock::now() - start_).count();
    progress.pending = static_cast<std::int64_t>(pending_.size());
    return progress;
  }

  void Work() {
    try {
      UnitRunner runner(campaign_);
      double searching = 0, finishing = 0;  // seconds of this thread
      while (!Stopped()) {
        const auto before = Clock::now();
        // Half of the time goes to finishing, as long as there is something to finish; little of it where what
        // is sought is better candidates.
        const int weight = campaign_.objective.empty() ? 1 : 16;
        if (weight * finishing <= searching && FinishOne()) {
          finishing += duration<double>(Clock::now() - before).count();
        } else if (RunOneUnit(runner)) {
          searching += duration<double>(Clock::now() - before).count();
        } else if (!FinishOne() && Idle()) {
          break;
        }
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
    const std::lock_guard lock(mutex_);
    --running_;
    changed_.notify_all();
  }

  // Whether no other thread can still bring something to finish. Otherwise waits a little.
  bool Idle() {
    std::unique_lock lock(mutex_);
    if (busy_ == 0 && pending_.empty()) return wanted_units_ && next_unit_ >= *wanted_units_;
    changed_.wait_for(lock, std::chrono::milliseconds(20));
    return false;
  }

  std::optional<std::int64_t> NextUnit() {  // under the mutex
    while (!wanted_units_ || next_unit_ < *wanted_units_) {
      const std::int64_t unit = next_unit_;
      const bool wanted = options_.shard.Owns(unit) && !done_.Contains(unit);
      if (wanted && IsWaiting(unit)) return std::nullopt;
      ++next_unit_;
      if (wanted) return unit;
    }
    return std::nullopt;
  }

  // Units of an optimized search start from what earlier epochs left.
  bool IsWaiting(std::int64_t unit) const {
    const auto epoch = [this](std::int64_t u) { return Heritage::EpochOf(u, options_.shard); };
    return !campaign_.objective.empty() && !in_work_.empty() && epoch(*in_work_.begin()) < epoch(unit);
  }

  // Empty if it was cancelled: half an optimized unit is none.
  std::optional<UnitResult> Run(UnitRunner& runner, std::int64_t unit, const std::vector<Candidate>& parents) {
    if (campaign_.objective.empty()) return runner.Run(unit);
    UnitResult result = RunOptimizedUnit(campaign_, unit, parents, [this] { return Stopped(); });
    if (Stopped()) return std::nullopt;
    return result;
  }

  bool RunOneUnit(UnitRunner& runner) {
    std::unique_lock lock(mutex_);
    const auto unit = NextUnit();
    if (!unit) return false;
    ++busy_;
    in_work_.insert(*unit);
    const auto parents = campaign_.objective.empty() ? std::vector<Candidate>() : heritage_.ParentsOf(*unit);
    lock.unlock();
    const std::optional<UnitResult> run = Run(runner, *unit, parents);
    lock.lock();
    --busy_;
    in_work_.erase(*unit);
    if (!run) return abandoned_ = true;
    const UnitResult& result = *run;
    if (!result.elites.empty()) heritage_.Add(*unit, ElitesFromText(result.elites, "a unit"));
    // A group's former representative may be waiting here; a smaller one takes its place.
    for (Finding& finding :
         store_.AddUnit(options_.shard, *unit, result.record, result.candidates, result.elites)) {
      std::erase_if(pending_, [&](const Finding& other) { return other.signature == finding.signature; });
      pending_.insert(std::move(finding));
    }
    ++progress_.units_done;
    progress_.problems += result.problems;
    for (const auto& [signature, count] : result.record.signatures) {
      progress_.findings += count;
      signatures_.insert(signature);
    }
    progress_.groups = static_cast<std::int64_t>(signatures_.size());
    changed_.notify_all();
    return true;
  }

  bool FinishOne() {
    std::unique_lock lock(mutex_);
    if (pending_.empty()) return false;
    const Finding finding = std::move(pending_.extract(pending_.begin()).value());
    ++busy_;
    lock.unlock();
    const auto finished = FinishFinding(finding, campaign_.limits, [this] { return Stopped(); });
    lock.lock();
    --busy_;
    if (finished) {
      store_.Finish(*finished);
    } else {
      pending_.insert(finding);
    }
    changed_.notify_all();
    return true;
  }

  const Campaign& campaign_;
  const SearchOptions& options_;
  StoreLock lock_;
  Store store_;  // under the mutex
  UnitSet done_;
  Heritage heritage_;               // under the mutex
  std::set<std::int64_t> in_work_;  // likewise
  std::optional<std::int64_t> wanted_units_;
  Clock::time_point start_;
  std::optional<Clock::time_point> deadline_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t next_unit_ = 0;
  std::set<Finding, FinishOrder> pending_;
  std::set<std::string> signatures_;
  SearchProgress progress_;
  int busy_ = 0;
  bool abandoned_ = false;  // a unit was
  int running_ = 0;
  std::exception_ptr failure_;
  std::atomic<bool> failed_ = false;
};

}  // namespace

SearchReport RunSearch(const Campaign& campaign, const CampaignIdentity& identity, const SearchOptions& options,
                       const std::function<void(const SearchProgress&)>& show) {
  return Search(campaign, identity, options).Run(show);
}

}  // namespace stiction
