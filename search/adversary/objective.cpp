// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/objective.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "certify/claims/robust.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/feasibility_nlp.h"
#include "corpus/named_rows.h"
#include "corpus/rounded.h"
#include "search/adversary/trial.h"

namespace stiction {
namespace {

using Value = std::optional<double>;

constexpr int kMostContactsEnumerated = 4;

// ---- Rows --------------------------------------------------------------------------------------

// Of any run: `value` of a trial over either kind of numbers.
template <class F>
Objective OfRuns(Objective row, F) {
  row.inexact = [](InexactTrial& trial) -> Value { return F{}(trial); };
  row.exact = [](ExactTrial& trial) -> Value { return F{}(trial); };
  return row;
}

// Of loops.
template <class F>
Objective OfLoops(Objective row, F) {
  row.of_loops = true;
  row.inexact = [](InexactTrial& trial) -> Value { return trial.Loops() ? Value(F{}(trial)) : Value(); };
  row.exact = [](ExactTrial& trial) -> Value { return trial.Loops() ? Value(F{}(trial)) : Value(); };
  return row;
}

// Of rationals alone.
template <class F>
Objective Exactly(Objective row, F) {
  row.exact = [](ExactTrial& trial) -> Value { return F{}(trial); };
  return row;
}

// A counter of runs that end solved: what a loop counts is only when it was noticed.
template <auto kCounter, class Scalar>
Value OfSolved(Trial<Scalar>& trial) {
  if (!trial.Solves()) return std::nullopt;
  return static_cast<double>(trial.Published().statistics.*kCounter);
}

// ---- Values ------------------------------------------------------------------------------------

template <class Scalar>
Scalar LargestFriction(const Trial<Scalar>& trial) {
  Scalar mu(0);
  for (const auto& contact : trial.problem().contacts) mu = std::max(mu, contact.mu);
  return mu;
}

Value NegativeCondition(const ContactProblem<double>& problem) {
  const auto condition = Condition(problem);
  return condition ? Value(-*condition) : Value();
}

// Largest difference of a force between doubles and rationals, relative to the largest force.
Value RoundingError(ExactTrial& trial) {
  InexactTrial rounded(Rounded<double>(trial.problem()), trial.policy(), trial.limits());
  if (!trial.Solves() || !rounded.Solves()) return std::nullopt;
  const auto& exact = trial.PublishedForces();
  const auto& inexact = rounded.PublishedForces();
  Rational largest = 0, apart = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    largest = std::max<Rational>(largest, abs(exact[i]));
    apart = std::max<Rational>(apart, abs(exact[i] - Rational(inexact[i])));
  }
  if (largest == 0 || apart == 0) return std::nullopt;
  return std::log10(ToDouble(apart / largest));
}

double DifferentEnds(ExactTrial& trial) {
  std::set<std::tuple<Outcome, std::int64_t, std::int64_t>> ends;
  for (const PolicyClass& equal : RunPolicies(trial.problem(), PlanarGrid(), trial.limits()))
    ends.insert({equal.verdict.outcome, equal.verdict.start, equal.verdict.period});
  return static_cast<double>(ends.size());
}

Value NumberOfSolutions(ExactTrial& trial) {
  if (trial.contacts() > kMostContactsEnumerated) return std::nullopt;
  return static_cast<double>(EnumerateModes(trial.problem()).distinct_witnesses);
}

Value Radius(ExactTrial& trial) {
  if (!trial.Loops()) return std::nullopt;
  const auto radius = RadiusOfLoop(trial.problem(), {.policy = trial.policy(), .limits = trial.limits()});
  return radius ? Value(ToDouble(*radius)) : Value();
}

// One more than all of them if none led to a solution.
double StartsOfIpopt(ExactTrial& trial) {
  thread_local IpoptProposer proposer;
  const Answer<Rational> answer = proposer.ProposeSolution(trial.problem());
  return static_cast<double>(answer.Solved() ? answer.counters[Counter::kStarts] : proposer.starts + 1);
}

}  // namespace

std::span<const Objective> Objectives() {
  static const std::array kRows = {
      OfRuns({"steps", "steps of the published algorithm until it has solved the problem", "steps"},
             [](auto& t) { return OfSolved<&Statistics::steps>(t); }),
      OfRuns({"steps-per-contact", "the same by contact", "steps a contact"},
             [](auto& t) {
               const Value steps = OfSolved<&Statistics::steps>(t);
               return steps ? Value(*steps / t.contacts()) : steps;
             }),
      OfRuns({"zero-steps", "steps of length zero, of a run that solves", "steps"},
             [](auto& t) { return OfSolved<&Statistics::zero_steps>(t); }),
      OfRuns({"zero-run", "the longest run of them within a drive", "steps"},
             [](auto& t) { return OfSolved<&Statistics::longest_zero_run>(t); }),
      OfRuns({"give-ups", "variables that a run gives up and yet solves", "give-ups"},
             [](auto& t) { return OfSolved<&Statistics::give_ups>(t); }),
      OfRuns({.name = "scans",
              .help = "scans for a violated condition, of a run that solves",
              .unit = "scans",
              .optimizer = "continuation"},
             [](auto& t) { return OfSolved<&Statistics::outer_scans>(t); }),
      OfRuns({.name = "memory",
              .help = "the longest chain of forces given up, each while the one before rested",
              .unit = "forces",
              .optimizer = "continuation"},
             [](auto& t) { return static_cast<double>(LongestMemory(t)); }),
      OfLoops({"period", "drives of a loop's period", "drives"},
              [](auto& t) { return static_cast<double>(t.Published().period); }),
      OfLoops({"start", "drives before a loop begins", "drives"},
              [](auto& t) { return static_cast<double>(t.Published().start); }),
      OfRuns({"distance", "how near a run comes to a state that it was in, relative to its forces", "", -1},
             [](auto& t) {
               const Value distance = DistanceToLoop(t);
               return distance ? Value(-*distance) : distance;
             }),
      OfRuns({"pivot", "the smallest pivot, relative to its diagonal entry: -log10", "decades"},
             [](auto& t) {
               const Value pivot = SmallestPivot(t);
               return pivot ? Value(-std::log10(*pivot)) : pivot;
             }),
      Exactly({"bits", "the longest number of an exact run", "bits"},
              [](ExactTrial& t) { return static_cast<double>(LongestNumber(t)); }),
      OfLoops({.name = "condition",
               .help = "condition number of a definite A with a loop",
               .unit = "",
               .sign = -1,
               .of_definite = true},
              [](auto& t) {
                if constexpr (std::is_same_v<std::remove_reference_t<decltype(t)>, InexactTrial>)
                  return NegativeCondition(t.problem());
                else
                  return NegativeCondition(Rounded<double>(t.problem()));
              }),
      OfLoops({.name = "friction",
               .help = "the friction coefficient of a loop",
               .unit = "mu",
               .sign = -1,
               .lowers_friction = true},
              [](auto& t) { return -AsDouble(LargestFriction(t)); }),
      Exactly({.name = "rounding",
               .help = "error of the forces over doubles, relative to the largest: log10",
               .unit = "decades",
               .optimizer = "continuation"},
              [](ExactTrial& t) { return RoundingError(t); }),
      Exactly({"policies", "different ends (outcome, start, period) over the grid of policies", "ends"},
              [](ExactTrial& t) { return DifferentEnds(t); }),
      Exactly(
          {"ipopt",
           "starts of Ipopt until one led to a solution, 21 if none did; as the machine's libraries have it",
           "starts"},
          [](ExactTrial& t) { return StartsOfIpopt(t); }),
      OfRuns({"folds", "folds of complete driving", "folds"},
             [](auto& t) { return static_cast<double>(t.Complete().statistics[Counter::kFolds]); }),
      OfRuns({"descents", "descents of complete driving", "descents"},
             [](auto& t) { return static_cast<double>(t.Complete().statistics[Counter::kDescents]); }),
      OfRuns({"pieces", "linear pieces of complete driving", "pieces"},
             [](auto& t) { return static_cast<double>(t.Complete().statistics[Counter::kPieces]); }),
      Exactly({"solutions", "different solutions among all contact modes, up to four contacts", "solutions"},
              [](ExactTrial& t) { return NumberOfSolutions(t); }),
      Exactly({.name = "margin",
               .help = "least relative gap of any decision of a loop: how robust it is",
               .unit = "",
               .of_loops = true},
              [](ExactTrial& t) { return Margin(t); }),
      Exactly({.name = "radius",
               .help = "how far all numbers of a loop may move at once while it stays, proved by intervals",
               .unit = "",
               .of_loops = true},
              [](ExactTrial& t) { return Radius(t); }),
      // Of a solver under test, whose process under_test/solver_unit.h asks.
      Objective{.name = "error",
                .help = "with --solver: error of what it calls solved (solver/problem/errors.h): log10",
                .unit = "decades",
                .of_solver = true},
      Objective{.name = "time",
                .help = "with --solver: processor time that it takes, in seconds: log10",
                .unit = "decades",
                .of_solver = true},
  };
  return kRows;
}

const Objective* FindObjective(std::string_view name) { return RowNamed(Objectives(), name); }

}  // namespace stiction
