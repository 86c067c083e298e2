// SPDX-License-Identifier: Apache-2.0
#include "search/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "corpus/stopwatch.h"
#include "corpus/store/store_lock.h"
#include "search/adversary/optimized_unit.h"
#include "search/testimony.h"
#include "search/under_test/solver_unit.h"
#include "search/units/backlog.h"
#include "search/units/finish.h"
#include "search/units/unit.h"
#include "search/units/work_meter.h"

namespace stiction {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

double ThreadSeconds() { return ReadSeconds(CLOCK_THREAD_CPUTIME_ID); }

std::int64_t ProblemsIn(const Record& record) {
  std::int64_t problems = 0;
  for (const auto& [key, tally] : record.under_test) problems += tally.problems;
  return problems + ProblemsOf(record);
}

double ShareOf(const Campaign& campaign, const SearchOptions& options) {
  if (options.only_finish) return 1;
  return options.finishing.value_or(campaign.objective.empty() ? kFinishingShare : kFinishingShareOfObjective);
}

// What a thread works with.
struct Worker {
  Worker(const Campaign& campaign, const SearchOptions& options, const std::function<bool()>& stopped)
      : runner(campaign) {
    if (campaign.solver.name.empty()) return;
    if (options.solver.empty())
      throw InputError(fmt::format("{}: found a search that tests {}, expected --solver FILE with it",
                                   options.store.string(), campaign.solver.name));
    solver = std::make_unique<SolverProcess>(options.solver, stopped);
    if (solver->about() != campaign.solver)
      throw InputError(fmt::format("--solver: found {} {}, expected {} {}, which this search tests",
                                   solver->about().name, solver->about().version, campaign.solver.name,
                                   campaign.solver.version));
  }
  // Processor time of this thread and its solver.
  double Seconds() const { return ThreadSeconds() + (solver ? solver->Seconds() : 0); }

  UnitRunner runner;
  std::unique_ptr<SolverProcess> solver;  // null: the published algorithm is searched
};

class Search {
 public:
  Search(const Campaign& campaign, const CampaignIdentity& identity, const SearchOptions& options)
      : campaign_(campaign),
        options_(options),
        lock_(options.store, options.shard),
        store_(options.store, identity),
        done_(store_.Units()),
        heritage_(campaign, options.shard),
        share_(ShareOf(campaign, options)),
        backlog_(options.only_finish ? std::nullopt : std::optional(kMostFinished)) {
    RequireSound(store_, options.store.string());
    for (const auto& [unit, text] : store_.Elites())
      heritage_.Add(unit, ElitesFromText(text, options.store.string()));
    for (const bool done : {true, false}) {  // what is finished takes its place first
      for (Finding& finding : store_.Findings()) {
        if (finding.done != done) continue;
        if (options.only_finish && !done && !options.shard.Owns(finding.unit)) continue;
        known_.insert(finding.signature);
        backlog_.Add(std::move(finding));
      }
    }
    TakeStock();
    progress_.only_finishes = options.only_finish;
    if (options.only_finish) wanted_units_ = 0;
    if (!options.problems) return;
    wanted_units_ = UnitsFor(campaign, *options.problems);
    progress_.units_wanted =
        (*wanted_units_ - options.shard.index + options.shard.count - 1) / options.shard.count;
    progress_.units_done = std::min(done_.Count(), *progress_.units_wanted);
  }

  SearchReport Run(const std::function<void(const SearchProgress&)>& show) {
    if (options_.started) options_.started(progress_);
    start_ = Clock::now();
    if (options_.minutes)
      deadline_ =
          start_ + std::chrono::duration_cast<Clock::duration>(duration<double>(*options_.minutes * 60));
    std::vector<std::jthread> workers;
    running_ = options_.threads;
    for (int i = 0; i < options_.threads; ++i) workers.emplace_back([this] { RunThread(); });
    std::unique_lock lock(mutex_);
    const auto tell = [&] {
      const SearchProgress progress = Progress();
      progress_.news.clear();
      lock.unlock();
      show(progress);
      lock.lock();
    };
    while (!changed_.wait_for(lock, std::chrono::milliseconds(500), [this] { return running_ == 0; })) tell();
    if (failure_) std::rethrow_exception(failure_);
    tell();
    return {End(), Progress()};
  }

 private:
  // What earlier calls left, which is told with what this one brings.
  void TakeStock() {
    const Record total = store_.Total();
    progress_.problems = ProblemsIn(total);
    if (!campaign_.objective.empty())
      for (const auto& [unit, text] : store_.Elites())
        progress_.problems += ElitesFromText(text, options_.store.string()).evaluations;
    progress_.problems_before = progress_.problems;
    for (const auto& [signature, count] : total.signatures) {
      progress_.findings += count;
      signatures_.insert(signature);
    }
    progress_.groups = static_cast<std::int64_t>(signatures_.size());
  }

  bool Interrupted() const { return options_.interrupted != nullptr && *options_.interrupted; }
  bool TimeUp() const { return deadline_ && Clock::now() >= *deadline_; }
  bool Stopped() const { return failed_ || Interrupted() || TimeUp(); }

  SearchEnd End() const {
    if (Interrupted()) return SearchEnd::kInterrupted;
    if (abandoned_ || UnitsLeft()) return SearchEnd::kTimeUp;
    if (backlog_.waiting() == 0) return SearchEnd::kDone;
    return TimeUp() ? SearchEnd::kTimeUp : SearchEnd::kLeft;
  }

  SearchProgress Progress() const {  // under the mutex
    SearchProgress progress = progress_;
    progress.seconds = duration<double>(Clock::now() - start_).count();
    progress.pending = backlog_.waiting();
    progress.left_out = backlog_.left_out();
    return progress;
  }

  void RunThread() {
    try {
      Worker worker(campaign_, options_, [this] { return Stopped(); });
      FinishingTime time{share_};
      while (!Stopped()) {
        if (FinishOne(worker, time)) continue;
        const double before = worker.Seconds();
        if (RunOneUnit(worker)) {
          time.searching += worker.Seconds() - before;
        } else if (Idle(time)) {
          break;
        }
      }
    } catch (const InputError&) {
      // A solver that was asked what it is when the search ended is no failure of it.
      const std::lock_guard lock(mutex_);
      abandoned_ = true;
      if (!failure_ && !Stopped()) failure_ = std::current_exception();
      failed_ = failed_ || failure_;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
    const std::lock_guard lock(mutex_);
    --running_;
    changed_.notify_all();
  }

  bool UnitsLeft() const { return !wanted_units_ || next_unit_ < *wanted_units_; }  // under the mutex

  // Whether no other thread can still bring something that there is time to finish. Otherwise waits a little.
  bool Idle(const FinishingTime& time) {
    std::unique_lock lock(mutex_);
    const bool finished = backlog_.waiting() == 0 || time.ForTry(0, UnitsLeft()) <= 0;
    if (busy_ == 0 && finished) return !UnitsLeft();
    changed_.wait_for(lock, std::chrono::milliseconds(20));
    return false;
  }

  std::optional<std::int64_t> NextUnit() {  // under the mutex
    while (UnitsLeft()) {
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
  std::optional<UnitResult> Run(Worker& worker, std::int64_t unit, const std::vector<Candidate>& parents) {
    const auto stopped = [this] { return Stopped(); };
    const auto tell = [this](const Finding& finding) { KeepAtOnce(finding); };
    if (campaign_.objective.empty()) {
      if (worker.solver) return RunSolverUnit(campaign_, unit, *worker.solver, stopped, tell);
      return worker.runner.Run(unit);
    }
    WorkMeter meter;  // candidates are tried and confirmed in turn: all of it counts as what is not named
    UnitResult result = worker.solver
                            ? RunOptimizedSolverUnit(campaign_, unit, *worker.solver, parents, stopped, tell)
                            : RunOptimizedUnit(campaign_, unit, parents, stopped);
    result.time = meter.Read();
    if (Stopped()) return std::nullopt;
    return result;
  }

  // Of a unit that is still being run, and may take long or never come to its end.
  void KeepAtOnce(const Finding& finding) {
    const std::lock_guard lock(mutex_);
    if (known_.contains(finding.signature) || !store_.AddFinding(finding)) return;
    known_.insert(finding.signature);
    signatures_.insert(finding.signature);
    progress_.groups = static_cast<std::int64_t>(signatures_.size());
    progress_.news.push_back(finding);
    backlog_.Add(finding);
    changed_.notify_all();
  }

  bool RunOneUnit(Worker& worker) {
    std::unique_lock lock(mutex_);
    const auto unit = NextUnit();
    if (!unit) return false;
    ++busy_;
    in_work_.insert(*unit);
    const auto parents = campaign_.objective.empty() ? std::vector<Candidate>() : heritage_.ParentsOf(*unit);
    lock.unlock();
    const std::optional<UnitResult> run = Run(worker, *unit, parents);
    lock.lock();
    --busy_;
    in_work_.erase(*unit);
    if (!run) return abandoned_ = true;
    const UnitResult& result = *run;
    if (!result.elites.empty()) heritage_.Add(*unit, ElitesFromText(result.elites, "a unit"));
    const Work work = WorkOf(result.time);
    // A group's former representative may be waiting; a smaller one takes its place.
    for (Finding& finding :
         store_.AddUnit(options_.shard, *unit, result.record, result.candidates, result.elites, work)) {
      if (known_.insert(finding.signature).second) progress_.news.push_back(finding);
      backlog_.Add(std::move(finding));
    }
    Spend(result.time);
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

  bool FinishOne(Worker& worker, FinishingTime& share) {
    std::unique_lock lock(mutex_);
    if (share.ForTry(0, UnitsLeft()) <= 0) return false;
    std::optional<Backlog::Entry> entry = backlog_.Take();
    if (!entry) return false;
    ++busy_;
    const double allowed = share.ForTry(entry->tries, UnitsLeft());
    lock.unlock();
    const double start = worker.Seconds();
    double seconds_of_ipopt = 0;  // in a process of its own
    const auto spent = [&] { return std::max(0.0, worker.Seconds() - start) + seconds_of_ipopt; };
    ExactMethods methods;
    methods.ipopt = [&, ask = methods.ipopt](const ExactProblem& problem) {
      const Feasibility answer = ask(problem);
      seconds_of_ipopt += answer.seconds;
      return answer;
    };
    const auto cancelled = [&] { return Stopped() || spent() > allowed; };
    const auto finished = worker.solver
                              ? FinishSolverFinding(entry->finding, campaign_, *worker.solver, cancelled)
                              : FinishFinding(entry->finding, campaign_.limits, cancelled, methods);
    share.finishing += spent();
    ProcessorTime time;
    time.finishing = static_cast<std::int64_t>(1e6 * spent());
    lock.lock();
    --busy_;
    Spend(time);
    const Work work = WorkOf(time);
    if (finished) {
      store_.Finish(*finished, work);
      ++progress_.finished;
      if (IsGrave(finished->kind) && !IsGrave(entry->finding.kind)) progress_.news.push_back(*finished);
    } else {
      store_.AddWork(entry->finding.unit, work);
      entry->tries += !Stopped();
      backlog_.GiveBack(*std::move(entry));
    }
    changed_.notify_all();
    return true;
  }

  Work WorkOf(const ProcessorTime& time) const {
    Work work{{options_.build}, time};
    if (!options_.machine.empty()) work.machines.insert(options_.machine);
    return work;
  }

  void Spend(const ProcessorTime& time) {  // under the mutex
    Work sum{{}, progress_.time};
    sum.Add({{}, time});
    progress_.time = sum.time;
  }

  const Campaign& campaign_;
  const SearchOptions& options_;
  StoreLock lock_;
  Store store_;  // under the mutex
  UnitSet done_;
  Heritage heritage_;               // under the mutex
  double share_;                    // of processor time, for finishing
  Backlog backlog_;                 // under the mutex
  std::set<std::int64_t> in_work_;  // likewise
  std::optional<std::int64_t> wanted_units_;
  Clock::time_point start_;
  std::optional<Clock::time_point> deadline_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t next_unit_ = 0;
  std::set<std::string> known_;  // signatures that have a representative
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
