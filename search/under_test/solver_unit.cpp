// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/solver_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/properties.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/adversary/optimized_unit.h"
#include "search/under_test/simple_scene.h"
#include "search/units/collector.h"
#include "search/units/minimize.h"
#include "search/units/regenerate.h"
#include "search/units/work_meter.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr int kMostProcesses = 100;    // of a unit, which ends early where so many crashed or hung
constexpr int kProcessesOfSleep = 20;  // that one counts for that sleeps: it takes minutes
// Of a candidate to be simpler: a hang is tried many times, and what is left of it once more in full.
constexpr double kSecondsOfCandidate = 0.1;
// An error that is kept while a problem is made simpler, in accuracies that the solver states: one that is
// easily seen, and not one that another rounding hides.
constexpr int kClearError = 10;

constexpr double kLeastError = 1e-30, kMostError = 1e30;  // of a logarithm
constexpr int kTurnsOfTime = 3;                           // of which the shortest counts

// Leaks are looked for where a unit's own memory grew as that of a leak does: of the problems at which it grew
// the last ones are tried, each in few calls, and that with which it grows most in many, twice in new
// processes. All that is as many calls as the unit has problems, at most.
constexpr std::int64_t kLeakSuspects = 8;
constexpr std::int64_t CallsOfSuspect(std::int64_t problems) { return problems / 4 / kLeakSuspects; }
constexpr std::int64_t CallsOfLeak(std::int64_t problems) { return problems * 3 / 8; }

// The power of ten below the ratio of the largest to the smallest entry of the diagonal; 0 where there is none.
int SpreadOf(const ContactProblem<double>& problem) {
  double least = 0, most = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    const double own = problem.A(i, i);
    if (!(own > 0)) continue;
    least = least > 0 ? std::min(least, own) : own;
    most = std::max(most, own);
  }
  int spread = 0;
  for (double bound = 10 * least; least > 0 && bound <= most; bound *= 10) ++spread;
  return spread;
}

std::int64_t& CounterOf(UnderTestTally& tally, std::string_view kind) {
  std::int64_t* found = nullptr;
  ForEachCounter(tally, [&](std::string_view name, std::int64_t& counter) {
    std::string dashed(name);
    std::ranges::replace(dashed, '_', '-');
    if (dashed == kind) found = &counter;
  });
  STICTION_CHECK(found != nullptr, fmt::format("no counter of {}", kind));
  return *found;
}

SharedJson FactsOf(const Examined& examined, std::int64_t contacts, std::int64_t leak) {
  SharedJson facts = {{"contacts", contacts}, {"kind", std::string(examined.kind)}, {"what", examined.what}};
  if (examined.kind == "silent-wrong" && std::isfinite(examined.error)) facts.Add({{"error", examined.error}});
  if (leak > 0) facts.Add({{"bytes", leak}});
  return facts;
}

class SolverUnit {
 public:
  SolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process, const TellFinding& tell)
      : campaign_(campaign),
        unit_(unit),
        task_(TaskOf(Schedule(campaign), unit)),
        process_(process),
        tell_(tell),
        surroundings_(SurroundingsOf(campaign)),
        whole_(UnitProblems(campaign, task_, unit)),
        windows_(whole_, LeastLeak(process)) {}

  std::optional<UnitResult> Run(const std::function<bool()>& cancelled) {
    const double before = process_.Seconds();
    process_.Restart();
    for (; result_.problems < whole_ && lost_ < kMostProcesses; ++result_.problems) {
      Try(result_.problems);
      if (cancelled()) return std::nullopt;
    }
    if (MayLeak()) TryLeak(cancelled);
    if (cancelled()) return std::nullopt;
    result_.time = meter_.Read();
    result_.time.doubles += std::llround(1e6 * (process_.Seconds() - before));
    return std::move(result_);
  }

  UnitResult RunOptimized(const std::vector<Candidate>& parents, const std::function<bool()>& cancelled) {
    process_.Restart();
    std::int64_t index = 0;
    UnitResult result = RunOptimizedUnit(
        campaign_, unit_, parents, cancelled,
        [&](Assessed& assessed, const ContactProblem<double>& problem) { Assess(index++, problem, assessed); });
    result.record = std::move(result_.record);
    result.candidates = std::move(result_.candidates);
    return result;
  }

 private:
  void Draw(std::int64_t index) {
    const Spending spending(meter_, &ProcessorTime::generation);
    Choices choices(
        ProblemSeed(campaign_.seed, static_cast<std::uint64_t>(unit_), static_cast<std::uint64_t>(index)));
    drawn_ = Generate(task_.generator, task_.contacts, surroundings_, choices, problem_);
    posed_ = PosedFor(campaign_.solver.law, problem_);
  }

  UnderTestTally& TallyOfDrawn() {
    return result_.record
        .under_test[{std::string(Row(task_.generator).name), task_.contacts,
                     Strata::NameOf(campaign_, drawn_.friction), drawn_.rank, SpreadOf(posed_)}];
  }

  void Try(std::int64_t index) {
    Draw(index);
    const Examined examined = Examine(process_, posed_);
    if (examined.kind == "stopped") return;
    UnderTestTally& tally = TallyOfDrawn();
    ++tally.problems;
    ++CounterOf(tally, examined.kind);
    tally.misses_coulomb += examined.misses_coulomb;
    tally.neither += examined.is_neither;
    if (examined.kind == "crash" || examined.kind == "hang")
      lost_ += examined.what == kAsleep || examined.what == kNoGreeting ? kProcessesOfSleep : 1;
    if (examined.Fails()) FindDrawn(index, examined);
    WatchMemory(index);
  }

  // A candidate of an optimizer, as number `index`.
  void Assess(std::int64_t index, const ContactProblem<double>& problem, Assessed& assessed) {
    posed_ = PosedFor(campaign_.solver.law, problem);
    const Examined examined = Examine(process_, posed_);
    if (examined.Fails()) {
      Find(index, examined, 0, [&] {
        const std::string_view generator = Row(assessed.candidate.generator).name;
        ProblemFile file = FileOf(assessed.candidate, fmt::format("{}-{}-{}", generator, unit_, index));
        file.problem = Unrounded(posed_);
        if (campaign_.solver.law == SolverLaw::kFrictionless) file.scene = {};  // it has friction
        return file;
      });
    }
    const std::optional<double> value = campaign_.objective == "time" ? TimeOf(examined) : ErrorOf(examined);
    assessed.worth.value = value;
    assessed.behaviour = {examined.says_solved, static_cast<std::int64_t>(std::floor(value.value_or(0)))};
  }

  static std::optional<double> ErrorOf(const Examined& examined) {
    if (!examined.says_solved || examined.kind == "not-finite" || examined.kind == "unjudged")
      return std::nullopt;
    return std::log10(std::clamp(examined.error, kLeastError, kMostError));
  }

  // Of what it answers, in seconds; Examine has warmed it up.
  std::optional<double> TimeOf(const Examined& examined) {
    if (examined.kind == "crash" || examined.kind == "hang") return std::nullopt;
    double least = kSolverSeconds;
    for (int turn = 0; turn < kTurnsOfTime; ++turn) {
      const double before = process_.Seconds();
      process_.Solve(posed_);
      least = std::min(least, process_.Seconds() - before);
    }
    return std::log10(std::max(least, 1e-9));
  }

  void WatchMemory(std::int64_t index) {
    const std::int64_t memory = process_.Memory();
    is_one_process_ = is_one_process_ && memory > 0;
    windows_.Add(index + 1, memory);
    if (memory > memory_ && memory_ > 0) suspects_[static_cast<std::size_t>(grown_++ % kLeakSuspects)] = index;
    memory_ = memory;
  }

  bool MayLeak() const {
    if (campaign_.no_leaks || !is_one_process_ || CallsOfLeak(whole_) < kLeastCallsOfLeak) return false;
    return result_.problems == whole_ && windows_.Growth() > 0;
  }

  // Of a problem that leaks twice, as it will when it is looked at again.
  void TryLeak(const std::function<bool()>& cancelled) {
    std::int64_t worst = -1, most = 0;
    for (std::int64_t k = 0; k < std::min(grown_, kLeakSuspects); ++k) {
      const std::int64_t index = suspects_[static_cast<std::size_t>(k)];
      const std::int64_t growth = GrowthOf(index);
      if (cancelled()) return;
      if (growth > most) worst = index;
      most = std::max(most, growth);
    }
    if (worst < 0) return;
    Draw(worst);
    std::int64_t bytes = 0;
    for (int turn = 0; turn < 2; ++turn) {
      bytes = LeakOf(process_, posed_, CallsOfLeak(whole_));
      if (bytes == 0 || cancelled()) return;
    }
    ++TallyOfDrawn().leak;
    FindDrawn(worst, {.kind = "leak", .what = ""}, bytes);
  }

  // Bytes that memory grows by in the second half of the calls with this problem alone.
  std::int64_t GrowthOf(std::int64_t index) {
    Draw(index);
    process_.Restart();
    std::int64_t half = 0;
    const std::int64_t calls = CallsOfSuspect(whole_);
    for (std::int64_t call = 0; call < calls; ++call) {
      if (process_.Solve(posed_).end != SolverEnd::kAnswered) return 0;
      if (call == calls / 2) half = process_.Memory();
    }
    return process_.Memory() - half;
  }

  void FindDrawn(std::int64_t index, const Examined& examined, std::int64_t leak = 0) {
    Find(index, examined, leak, [&] { return FileOf(campaign_, unit_, index, Unrounded(posed_)); });
  }

  // What the solver did with problem `index`, of which file() is the problem; `leak`: bytes of a call.
  template <class MakeFile>
  void Find(std::int64_t index, const Examined& examined, std::int64_t leak, MakeFile file) {
    std::string signature = examined.Signature(posed_.contacts.size());
    if (++result_.record.signatures[signature] > 1) return;
    if (static_cast<std::int64_t>(result_.candidates.size()) >= campaign_.representatives_per_unit) return;
    Finding& finding = result_.candidates.emplace_back(FindingAt(campaign_, task_, unit_, index));
    finding.signature = std::move(signature);
    finding.kind = examined.kind;
    finding.inexact_outcome = Name(examined.says_solved ? Outcome::kSolved : Outcome::kUndecided);
    finding.exact_outcome = Name(Outcome::kUndecided);
    finding.problem = JsonText(ToJson(file()));
    finding.facts = JsonText(SharedJson{{"library", process_.IsLibrary()},
                                        {"found", FactsOf(examined, posed_.contacts.size(), leak)}});
    tell_(finding);
  }

  const Campaign& campaign_;
  std::int64_t unit_;
  Task task_;
  SolverProcess& process_;
  const TellFinding& tell_;
  Surroundings surroundings_;
  UnitResult result_;
  WorkMeter meter_;
  ContactProblem<double> problem_, posed_;
  Drawn drawn_;
  std::int64_t whole_;  // problems
  MemoryWindows windows_;
  bool is_one_process_ = true;
  std::int64_t memory_ = 0, grown_ = 0;  // after the last problem; how often it was more than before
  std::array<std::int64_t, kLeakSuspects> suspects_ = {};  // at which it was, the last ones
  int lost_ = 0;                                           // processes
};

// ---- Finishing -------------------------------------------------------------------------------

// The exact problem as the solver is given it; empty where a number is no double.
std::optional<ContactProblem<double>> InDoubles(const ExactProblem& problem) {
  const auto fits = [](const Rational& x) { return IsExactDouble(x); };
  ContactProblem<double> posed;
  posed.dimension = problem.dimension;
  for (const auto& contact : problem.contacts) {
    if (!fits(contact.mu)) return std::nullopt;
    posed.contacts.push_back({contact.kind, ToDouble(contact.mu), {}});
  }
  if (!std::all_of(problem.A.data(), problem.A.data() + problem.A.size(), fits) ||
      !std::all_of(problem.b.data(), problem.b.data() + problem.b.size(), fits))
    return std::nullopt;
  posed.A = problem.A.unaryExpr([](const Rational& x) { return ToDouble(x); });
  posed.b = problem.b.unaryExpr([](const Rational& x) { return ToDouble(x); });
  return posed;
}

bool EachRowMoves(const ExactProblem& problem) {
  bool all = true;
  for (int i = 0; i < problem.rows(); ++i) all = all && problem.A(i, i) > 0;
  return all;
}

// What a problem that is made simpler keeps: it is one that bodies make, with A symmetric and semidefinite and
// b in its range; every row moves under its own force, and something acts, where that was so at first.
bool KeepsPromises(const ExactProblem& found, const ExactProblem& problem) {
  const bool is_found = problem.rows() == found.rows() && problem.A == found.A && problem.b == found.b;
  if (is_found) return true;  // of doubles, which are not quite what bodies make
  if ((EachRowMoves(found) && !EachRowMoves(problem)) || (!found.b.isZero() && problem.b.isZero()))
    return false;
  return MeetsAssumptions(problem);
}

// Whether a failure is the one that is sought: the same in kind and way and, of what is wrong, as clear.
bool FailsAlike(const Examined& sought, const Examined& examined, const SolverUnderTest& about) {
  return examined.kind == sought.kind && examined.what == sought.what &&
         (examined.kind != "silent-wrong" ||
          examined.error >= std::min(sought.error, kClearError * std::stod(about.accuracy)));
}

// How a problem fails, of a kind: leaks are looked for where one is sought, in so many calls.
Examined FailureOf(SolverProcess& process, const ContactProblem<double>& posed, std::string_view kind,
                   double seconds, std::int64_t calls, std::int64_t& leak) {
  if (kind != "leak") return Examine(process, posed, seconds);
  leak = LeakOf(process, posed, calls);
  return {.kind = leak > 0 ? "leak" : "passed", .what = ""};
}

// As finish.cpp does; empty where none is known, or the law has others: certificates are of Coulomb's.
std::string CertificateOfSolution(SolverLaw law, const ExactProblem& problem, const Limits& limits) {
  const bool in_space = law == SolverLaw::kCoulomb && problem.dimension == 3;
  const bool of_coulomb = law != SolverLaw::kBox && law != SolverLaw::kFindex;
  if (!in_space && (!of_coulomb || !SolutionUnder(law, *InDoubles(problem)))) return "";
  const FrictionLaw friction = in_space ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
  const SharedJson certificate = DecideExistence(problem, {.law = friction, .limits = limits}).certificate;
  if (!certificate || !CheckCertificate(certificate, "solution").accepted) return "";
  return JsonText(certificate);
}

}  // namespace

std::optional<UnitResult> RunSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                        const std::function<bool()>& cancelled, const TellFinding& tell) {
  return SolverUnit(campaign, unit, process, tell).Run(cancelled);
}

UnitResult RunOptimizedSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                  const std::vector<Candidate>& parents, const std::function<bool()>& cancelled,
                                  const TellFinding& tell) {
  return SolverUnit(campaign, unit, process, tell).RunOptimized(parents, cancelled);
}

std::optional<Finding> FinishSolverFinding(const Finding& finding, const Campaign& campaign,
                                           SolverProcess& process, const std::function<bool()>& cancelled) {
  Finding finished = finding;
  finished.done = true;
  const ExactProblem problem = ParseProblem(finding.problem, finding.signature).problem;
  const SolverLaw law = campaign.solver.law;
  SharedJson facts = JsonPlace(finding.facts, finding.signature).json();
  std::int64_t leak = 0;
  const Task task = TaskOf(Schedule(campaign), finding.unit);
  const std::int64_t calls = CallsOfLeak(UnitProblems(campaign, task, finding.unit));
  // In a process that has seen no other problem.
  const auto alone = [&](const ExactProblem& tried) {
    process.Restart();
    return FailureOf(process, *InDoubles(tried), finding.kind, kSolverSeconds, calls, leak);
  };
  const Examined sought = alone(problem);
  if (cancelled()) return std::nullopt;
  const auto alike = [&](const Examined& examined) { return FailsAlike(sought, examined, campaign.solver); };
  const auto fails = [&](const ContactProblem<double>& posed) {
    return alike(FailureOf(process, posed, finding.kind, kSecondsOfCandidate, calls, leak));
  };
  const bool again = sought.Fails() && sought.Signature(problem.contacts.size()) == finding.signature;
  facts.Add({{"alone", again}});
  finished.existence = CertificateOfSolution(law, problem, campaign.limits);
  MinimizeOptions options;
  options.cancelled = cancelled;
  options.keeps = [&](const ExactProblem& candidate) {
    const auto posed = InDoubles(candidate);
    return posed && KeepsPromises(problem, candidate) && fails(*posed);
  };
  if (again && options.keeps(problem)) {  // also after a problem, as minimizing asks it
    Minimized minimized = Minimize(problem, options);
    if (minimized.cancelled || cancelled()) return std::nullopt;
    const Examined last = alone(minimized.problem);
    if (cancelled()) return std::nullopt;
    if (alike(last)) {
      ProblemFile file;
      file.name = finding.signature;
      file.problem = minimized.problem;
      file.origin = {{"parent", fmt::format("{}-{}-{}", finding.generator, finding.unit, finding.index)},
                     {"minimized", true}};
      finished.minimized = JsonText(ToJson(file));
      finished.minimized_existence = CertificateOfSolution(law, minimized.problem, campaign.limits);
      facts.Add({{"minimized", FactsOf(last, std::ssize(minimized.problem.contacts), leak)}});
    }
    const auto scene = SimpleSceneOf(finding, campaign, fails, cancelled);
    if (scene && alike(alone(PosedFileOf(*scene, law, finding.signature).problem)))
      facts.Add({{"scene", ToJson(*scene)}});
  }
  if (cancelled()) return std::nullopt;
  finished.facts = JsonText(facts);
  return finished;
}

}  // namespace stiction
