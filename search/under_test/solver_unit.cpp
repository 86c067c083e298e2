// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/solver_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "search/under_test/examine.h"
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
constexpr std::int64_t kLeakSuspected = std::int64_t{1}
                                        << 16;  // bytes that the last three quarters of a unit add

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

Json FactsOf(const Examined& examined, std::size_t contacts, std::int64_t leak) {
  Json facts = {{"contacts", contacts}, {"kind", examined.kind}, {"what", examined.what}};
  if (examined.kind == "silent-wrong" && std::isfinite(examined.error)) facts["error"] = examined.error;
  if (leak > 0) facts["bytes"] = leak;
  return facts;
}

class SolverUnit {
 public:
  SolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process)
      : campaign_(campaign),
        unit_(unit),
        task_(TaskOf(Schedule(campaign), unit)),
        process_(process),
        surroundings_(SurroundingsOf(campaign)) {
    result_.problems = UnitProblems(campaign, task_);
    warm_ = result_.problems / 4;
  }

  std::optional<UnitResult> Run(const std::function<bool()>& cancelled) {
    const double before = process_.Seconds();
    process_.Restart();
    const std::int64_t whole = result_.problems;
    for (result_.problems = 0; result_.problems < whole && lost_ < kMostProcesses; ++result_.problems) {
      if (cancelled()) return std::nullopt;
      Try(result_.problems);
    }
    if (lost_ < kMostProcesses && last_memory_ - first_memory_ >= kLeakSuspected) TryLeak();
    result_.time = meter_.Read();
    result_.time.doubles += std::llround(1e6 * (process_.Seconds() - before));
    return std::move(result_);
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
    UnderTestTally& tally = TallyOfDrawn();
    ++tally.problems;
    ++CounterOf(tally, examined.kind);
    tally.misses_coulomb += examined.misses_coulomb;
    if (examined.kind == "crash" || examined.kind == "hang")
      lost_ += examined.what == kAsleep ? kProcessesOfSleep : 1;
    if (examined.Fails()) Find(index, examined, 0);
    WatchMemory(index);
  }

  // From a quarter of the unit on; a new process begins anew.
  void WatchMemory(std::int64_t index) {
    const std::int64_t memory = process_.Memory();
    if (index < warm_ || memory == 0 || last_memory_ == 0) first_memory_ = memory;
    last_memory_ = memory;
  }

  // Of the problems of the unit one that leaks, by halves of which that is kept where memory grows more.
  void TryLeak() {
    std::int64_t first = 0, size = result_.problems;
    while (size > 1) {
      const std::int64_t half = size / 2;
      const bool second = GrowthOf(first, half) < GrowthOf(first + half, size - half);
      first += second ? half : 0;
      size = second ? size - half : half;
    }
    Draw(first);
    const std::int64_t bytes = LeakOf(process_, posed_);
    if (bytes == 0) return;
    ++TallyOfDrawn().leak;
    Find(first, {.kind = "leak", .what = ""}, bytes);
  }

  // Bytes that memory grows by in a new process that solves these problems, in turn, for a second time.
  std::int64_t GrowthOf(std::int64_t first, std::int64_t size) {
    constexpr std::int64_t kLeastCalls = 500;
    process_.Restart();
    const auto solve_all = [&] {
      for (std::int64_t call = 0; call < std::max(kLeastCalls, size); ++call) {
        Draw(first + call % size);
        process_.Solve(posed_);
      }
      return process_.Memory();
    };
    const std::int64_t before = solve_all();
    return solve_all() - before;
  }

  void Find(std::int64_t index, const Examined& examined, std::int64_t leak) {
    const std::string signature = examined.Signature(posed_.contacts.size());
    if (++result_.record.signatures[signature] > 1) return;
    if (static_cast<std::int64_t>(result_.candidates.size()) >= campaign_.representatives_per_unit) return;
    result_.candidates.push_back(SolverFinding(campaign_, unit_, index, process_,
                                               ToJson(FileOf(campaign_, unit_, index, ExactOf(posed_))).dump(),
                                               examined, leak));
  }

  const Campaign& campaign_;
  std::int64_t unit_;
  Task task_;
  SolverProcess& process_;
  Surroundings surroundings_;
  UnitResult result_;
  WorkMeter meter_;
  ContactProblem<double> problem_, posed_;
  Drawn drawn_;
  std::int64_t first_memory_ = 0, last_memory_ = 0;
  std::int64_t warm_ = 0;  // problems after which memory should no longer grow
  int lost_ = 0;           // processes
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

// What a problem has of the paper's hypotheses: one that is made simpler keeps it.
struct Hypotheses {
  bool is_symmetric, is_semidefinite, is_in_range;

  static Hypotheses Of(const ExactProblem& problem) {
    const bool symmetric = IsSymmetric(problem);
    return {symmetric, symmetric && IsPositiveSemidefinite(problem), IsInRange(problem)};
  }
  bool Allow(const ExactProblem& problem) const {
    return (!is_symmetric || IsSymmetric(problem)) && (!is_semidefinite || IsPositiveSemidefinite(problem)) &&
           (!is_in_range || IsInRange(problem));
  }
};

// How a problem fails, of a kind: leaks are looked for where one is sought.
Examined FailureOf(SolverProcess& process, const ContactProblem<double>& posed, std::string_view kind,
                   double seconds, std::int64_t& leak) {
  if (kind != "leak") return Examine(process, posed, seconds);
  leak = LeakOf(process, posed);
  return {.kind = leak > 0 ? "leak" : "passed", .what = ""};
}

// As finish.cpp does; empty where none is known, or the law has others: certificates are of Coulomb's.
std::string CertificateOfSolution(SolverLaw law, const ExactProblem& problem, const Limits& limits) {
  const bool in_space = law == SolverLaw::kCoulomb && problem.dimension == 3;
  const bool of_coulomb = law != SolverLaw::kBox && law != SolverLaw::kFindex;
  if (!in_space && (!of_coulomb || !SolutionUnder(law, *InDoubles(problem)))) return "";
  const FrictionLaw friction = in_space ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
  const Json certificate = DecideExistence(problem, limits, {}, friction).certificate;
  if (certificate.is_null() || !CheckCertificate(certificate, "solution").accepted) return "";
  return JsonText(certificate);
}

}  // namespace

std::optional<UnitResult> RunSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                        const std::function<bool()>& cancelled) {
  return SolverUnit(campaign, unit, process).Run(cancelled);
}

Finding SolverFinding(const Campaign& campaign, std::int64_t unit, std::int64_t index,
                      const SolverProcess& process, const std::string& problem, const Examined& examined,
                      std::int64_t leak) {
  const Task task = TaskOf(Schedule(campaign), unit);
  const std::size_t contacts = static_cast<std::size_t>(task.contacts);
  Finding finding;
  finding.signature = examined.Signature(contacts);
  finding.kind = examined.kind;
  finding.unit = unit;
  finding.index = index;
  finding.generator = Row(task.generator).name;
  finding.contacts = task.contacts;
  finding.policy = PolicyName(campaign.policies.front());
  finding.inexact_outcome = Name(examined.says_solved ? Outcome::kSolved : Outcome::kUndecided);
  finding.exact_outcome = Name(Outcome::kUndecided);
  finding.problem = problem;
  finding.facts = Json{{"library", process.IsLibrary()}, {"found", FactsOf(examined, contacts, leak)}}.dump();
  return finding;
}

std::optional<Finding> FinishSolverFinding(const Finding& finding, const Campaign& campaign,
                                           SolverProcess& process, const std::function<bool()>& cancelled) {
  Finding finished = finding;
  finished.done = true;
  const ExactProblem problem = ParseProblem(finding.problem, finding.signature).problem;
  const SolverLaw law = campaign.solver.law;
  Json facts = ParseJson(finding.facts, finding.signature);
  std::int64_t leak = 0;
  // In a process that has seen no other problem.
  const auto alone = [&](const ExactProblem& tried) {
    process.Restart();
    return FailureOf(process, *InDoubles(tried), finding.kind, kSolverSeconds, leak);
  };
  const Examined sought = alone(problem);
  const auto alike = [&sought](const Examined& examined) {
    return examined.kind == sought.kind && examined.what == sought.what;
  };
  const auto fails = [&](const ContactProblem<double>& posed) {
    return alike(FailureOf(process, posed, finding.kind, kSecondsOfCandidate, leak));
  };
  const bool again = sought.Fails() && sought.Signature(problem.contacts.size()) == finding.signature;
  facts["alone"] = again;
  finished.existence = CertificateOfSolution(law, problem, campaign.limits);
  const Hypotheses kept = Hypotheses::Of(problem);
  MinimizeOptions options;
  options.cancelled = cancelled;
  options.lacks = [&](const ExactProblem& candidate) -> std::optional<std::string> {
    const auto posed = InDoubles(candidate);
    if (!posed) return "a number is no double";
    if (!kept.Allow(candidate)) return "it leaves the hypotheses";
    if (!fails(*posed)) return "it fails otherwise, or not at all";
    return std::nullopt;
  };
  if (again && !options.lacks(problem)) {  // also after a problem, as minimizing asks it
    Minimized minimized = Minimize(problem, options);
    if (minimized.cancelled || cancelled()) return std::nullopt;
    const Examined last = alone(minimized.problem);
    if (alike(last)) {
      ProblemFile file;
      file.name = finding.signature;
      file.problem = minimized.problem;
      file.origin = Json{{"parent", fmt::format("{}-{}-{}", finding.generator, finding.unit, finding.index)},
                         {"minimized", true}};
      finished.minimized = ToJson(file).dump();
      finished.minimized_existence = CertificateOfSolution(law, minimized.problem, campaign.limits);
      facts["minimized"] = FactsOf(last, minimized.problem.contacts.size(), leak);
    }
    const auto scene = SimpleSceneOf(finding, campaign, fails, cancelled);
    if (cancelled()) return std::nullopt;
    if (scene && alike(alone(PosedFileOf(*scene, law, finding.signature).problem)))
      facts["scene"] = ToJson(*scene);
  }
  finished.facts = facts.dump();
  return finished;
}

}  // namespace stiction
