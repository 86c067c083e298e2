// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/optimized_solver_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/adversary/optimized_unit.h"
#include "search/under_test/examine.h"
#include "search/under_test/solver_unit.h"

namespace stiction {
namespace {

constexpr double kLeastError = 1e-30, kMostError = 1e30;  // of a logarithm
constexpr int kTurnsOfTime = 3;                           // of which the shortest counts

// What the solver makes of candidates, with the findings that it leaves.
class Aim {
 public:
  Aim(const Campaign& campaign, std::int64_t unit, SolverProcess& process, const TellFinding& tell)
      : campaign_(campaign), unit_(unit), process_(process), tell_(tell) {}

  Tried Try(const Candidate& candidate, const ContactProblem<double>& problem) {
    const ContactProblem<double> posed = PosedFor(campaign_.solver.law, problem);
    const Examined examined = Examine(process_, posed);
    if (examined.Fails()) Find(candidate, posed, examined);
    ++index_;
    const bool by_time = campaign_.objective == "time";
    const std::optional<double> value = by_time ? TimeOf(posed, examined) : ErrorOf(examined);
    return {value, {examined.says_solved, static_cast<std::int64_t>(std::floor(value.value_or(0)))}};
  }

  // Counts of signatures, and the first of each.
  Record record;
  std::vector<Finding> findings;

 private:
  static std::optional<double> ErrorOf(const Examined& examined) {
    if (!examined.says_solved || examined.kind == "not-finite" || examined.kind == "unjudged")
      return std::nullopt;
    return std::log10(std::clamp(examined.error, kLeastError, kMostError));
  }

  // Of what it answers, in seconds; Examine has warmed it up.
  std::optional<double> TimeOf(const ContactProblem<double>& posed, const Examined& examined) {
    if (examined.kind == "crash" || examined.kind == "hang") return std::nullopt;
    double least = kSolverSeconds;
    for (int turn = 0; turn < kTurnsOfTime; ++turn) {
      const double before = process_.Seconds();
      process_.Solve(posed);
      least = std::min(least, process_.Seconds() - before);
    }
    return std::log10(std::max(least, 1e-9));
  }

  void Find(const Candidate& candidate, const ContactProblem<double>& posed, const Examined& examined) {
    const std::string signature = examined.Signature(posed.contacts.size());
    if (++record.signatures[signature] > 1) return;
    if (static_cast<std::int64_t>(findings.size()) >= campaign_.representatives_per_unit) return;
    const std::string generator(Row(candidate.generator).name);
    ProblemFile file = FileOf(candidate, fmt::format("{}-{}-{}", generator, unit_, index_));
    file.problem = Unrounded(posed);
    if (campaign_.solver.law == SolverLaw::kFrictionless) file.scene = {};  // it has friction
    findings.push_back(SolverFinding(campaign_, unit_, index_, process_, JsonText(ToJson(file)), examined));
    tell_(findings.back());
  }

  const Campaign& campaign_;
  std::int64_t unit_, index_ = 0;
  SolverProcess& process_;
  const TellFinding& tell_;
};

}  // namespace

UnitResult RunOptimizedSolverUnit(const Campaign& campaign, std::int64_t unit, SolverProcess& process,
                                  const std::vector<Candidate>& parents, const std::function<bool()>& cancelled,
                                  const TellFinding& tell) {
  process.Restart();
  Aim aim(campaign, unit, process, tell);
  UnitResult result =
      RunOptimizedUnit(campaign, unit, parents, cancelled,
                       [&aim](const Candidate& candidate, const ContactProblem<double>& problem) {
                         return aim.Try(candidate, problem);
                       });
  result.record = std::move(aim.record);
  result.candidates = std::move(aim.findings);
  return result;
}

}  // namespace stiction
