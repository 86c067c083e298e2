// SPDX-License-Identifier: Apache-2.0
// What a run of the published algorithm leaves behind: verdict, statistics, trace.

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/problem/counters.h"
#include "solver/problem/index_sets.h"
#include "solver/problem/options.h"

namespace stiction {

// kNoSolution is a proof that there is none. Runs along a path prove no such thing: the other outcomes are
// theirs, and what counts runs counts those.
enum class Outcome : std::uint8_t { kSolved, kCycle, kStall, kRay, kSingular, kLimit, kUndecided, kNoSolution };
inline constexpr int kOutcomeCount = 7;  // of runs along a path
inline constexpr std::array<std::string_view, kOutcomeCount> kOutcomeNames = {
    "solved", "cycle", "stall", "ray", "singular", "limit", "undecided"};

inline constexpr std::string_view Name(Outcome outcome) {
  return outcome == Outcome::kNoSolution ? "no-solution" : kOutcomeNames[static_cast<int>(outcome)];
}

// Endless: a state recurs, with `start` and `period`. (No run has stalled: readings.md, 6.)
inline constexpr bool IsLoop(Outcome outcome) {
  return outcome == Outcome::kCycle || outcome == Outcome::kStall;
}

// All but `contact` relative.
template <class Scalar>
struct Errors {
  Scalar acceleration = Scalar(0), force = Scalar(0);  // the largest of any contact
  Scalar backward = Scalar(0);       // the least eps such that eps abs(A), eps abs(b) takes the first away
  Scalar amplification = Scalar(1);  // largest size of what acts at a row and may cancel, in units of the row
  int contact = -1;                  // where the largest of the first two is; none where there is no error
  bool is_finite = true;             // otherwise the largest is infinite

  const Scalar& Largest() const { return std::max(acceleration, force); }
};

// The same in other numbers: convert(x) of every number x.
template <class To, class From, class Convert>
Errors<To> Converted(const Errors<From>& errors, Convert convert) {
  return {convert(errors.acceleration),  convert(errors.force), convert(errors.backward),
          convert(errors.amplification), errors.contact,        errors.is_finite};
}

// Counters of one run; readings.md, 4.
struct Statistics {
  std::int64_t drives = 0;
  std::int64_t steps = 0;
  std::int64_t pivots = 0;
  std::int64_t zero_steps = 0;
  std::int64_t longest_zero_run = 0;
  std::int64_t bounces = 0;
  std::int64_t give_ups = 0;
  std::int64_t singular_directions = 0;
  std::int64_t outer_scans = 0;

  bool operator==(const Statistics&) const = default;
};

// visit(count, value)
template <class S, class Visit>
void ForEachCount(S& s, Visit visit) {
  visit(Counter::kDrives, s.drives);
  visit(Counter::kSteps, s.steps);
  visit(Counter::kPivots, s.pivots);
  visit(Counter::kZeroSteps, s.zero_steps);
  visit(Counter::kLongestZeroRun, s.longest_zero_run);
  visit(Counter::kBounces, s.bounces);
  visit(Counter::kGiveUps, s.give_ups);
  visit(Counter::kSingularDirections, s.singular_directions);
  visit(Counter::kOuterScans, s.outer_scans);
}

// visit(name, help, counter)
template <class S, class Visit>
void ForEachField(S& s, Visit visit) {
  ForEachCount(s, [&visit](Counter c, auto& value) {
    visit(kCounterNames[static_cast<int>(c)].name.data(), kCounterNames[static_cast<int>(c)].help.data(),
          value);
  });
}

inline Counters CountersOf(const Statistics& s) {
  Counters counters;
  ForEachCount(s, [&counters](Counter c, std::int64_t value) { counters.Tell(c) = value; });
  return counters;
}
inline const Counters& CountersOf(const Counters& counters) { return counters; }

// What a drive works toward: the conditions of its variable, or a friction force of zero.
enum class DriveGoal : std::uint8_t { kEstablish, kZero };

inline constexpr std::string_view Name(DriveGoal goal) {
  return goal == DriveGoal::kEstablish ? "establish" : "zero";
}

// Why a path of complete driving goes on in another way than forward at a step.
enum class PathTurn : std::uint8_t { kNone, kFold, kDescent };

// One step of a path method and what it did. Variables are named by their row: the normal of a contact, or the
// first of its tangential rows. What a method does not have keeps its default.
template <class Scalar>
struct Pivot {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  int drive = 0;  // drives, stages of complete driving, or pivots of Lemke's method, counted from 1
  int driven = 0;
  DriveGoal goal = DriveGoal::kEstablish;
  Vector df, da;  // direction per unit step
  Scalar s = Scalar(0);
  int limiting = 0;                 // -1: no limit, the step is a ray
  IndexSet from = IndexSet::kNone;  // of the limiting variable
  IndexSet to = IndexSet::kNone;
  IndexSet wanted = IndexSet::kNone;  // differs from `to` if it was given up
  bool gave_up = false;
  Vector f, a;                 // after the step
  std::vector<IndexSet> sets;  // after the step

  // In space (5.6): NCF is kAtUpper, on the first tangential row; the driven and the limiting row stand for the
  // axes that the contact has at the time, and df shows along which a friction force is driven.
  bool turned_away = false;                     // slip=redirect: the limiting contact opposes aF no more
  std::vector<std::array<Scalar, 2>> recorded;  // by contact: d of those in NCF after the step, otherwise zero

  // Complete driving.
  std::string word;                 // the cell of every contact during the step, with blanks between them
  int determinant = 0;              // sign of the reduced determinant during the step
  PathTurn turn = PathTurn::kNone;  // how the path came to this step

  // Lemke's method: components of z and w by name ("fN1", "aN1", "f+1", "z0", ...), and z0 after the step.
  std::string entering, leaving;
  Scalar cover = Scalar(0);
};

// The history of a run, kept only where asked for.
template <class Scalar>
struct Trace {
  bool keep_pivots = true;
  std::vector<Pivot<Scalar>> pivots;
  // Switches whose values would have acted differently somewhere in this run. Policies that agree on
  // them run alike.
  SwitchMask consulted = 0;
};

// The end of a run, and its counters. start and period: in drives for a cycle, in steps for a stall
// (readings.md, 2, 3); zero for methods that have no loops.
template <class Counted = Counters>
struct RunEnd {
  Outcome outcome = Outcome::kUndecided;
  std::string_view reason = {};  // which limit, or why undecided; static text
  Counted statistics = {};
  std::int64_t start = 0;
  std::int64_t period = 0;
};
using Verdict = RunEnd<Statistics>;  // of the published algorithm, whose counters stores add up

}  // namespace stiction
