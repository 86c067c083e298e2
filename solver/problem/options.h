// SPDX-License-Identifier: Apache-2.0
// Request: what is asked of a problem. Its parts are said once: the policy switches (readings of the published
// text) and the numbers (tolerances, limits). Command line, JSON, --help, validation and the policy grid all
// read the two tables of this file.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stiction {

// Friction in space. kBaraff: (21), (22), which leave the direction of slip free. kCoulomb: friction opposite
// to the acceleration, which implies them. In the plane they are the same.
enum class FrictionLaw : std::uint8_t { kBaraff, kCoulomb };
inline constexpr std::string_view Name(FrictionLaw law) {
  return law == FrictionLaw::kBaraff ? "baraff" : "coulomb";
}

// ---- Policy: one reading of the published algorithm (readings.md) ----------------------------

enum class Scan : std::uint8_t { kLowest, kNormalsFirst, kMostViolated, kHighest };
enum class Resume : std::uint8_t { kRestart, kRound };
enum class Admit : std::uint8_t { kLazy, kEager };
enum class File : std::uint8_t { kNo, kYes };
enum class GiveUp : std::uint8_t { kFirst, kPrevious, kSecond };
enum class Drop : std::uint8_t { kContact, kVariable };
enum class Rezero : std::uint8_t { kRescan, kContinue };
enum class Ties : std::uint8_t { kSets, kContacts };
enum class Apex : std::uint8_t { kKept, kSuspended };
enum class Slip : std::uint8_t { kLiteral, kRedirect, kPolygon };

// The defaults are the reference policy, `paper`.
struct Policy {
  Scan scan = Scan::kLowest;
  Resume resume = Resume::kRestart;
  Admit admit = Admit::kLazy;
  File file = File::kNo;
  GiveUp give_up = GiveUp::kFirst;
  Drop drop = Drop::kContact;
  Rezero rezero = Rezero::kRescan;
  Ties ties = Ties::kSets;
  Apex apex = Apex::kKept;
  Slip slip = Slip::kLiteral;

  bool operator==(const Policy&) const = default;
};

// Rows of the table of switches, in the order in which a policy is written.
enum class PolicySwitch : std::uint8_t {
  kScan,
  kResume,
  kAdmit,
  kFile,
  kGiveUp,
  kDrop,
  kRezero,
  kTies,
  kApex,
  kSlip,
};
inline constexpr int kPolicySwitchCount = 10;

struct PolicyValue {
  std::string_view name;
  std::string_view meaning;
};

struct PolicySwitchRow {
  PolicySwitch id;
  std::string_view name;
  std::string_view question;        // what the text leaves open
  std::string_view reads;           // where the paper speaks of it
  std::vector<PolicyValue> values;  // the first is the reference
  bool planar;                      // part of the grid of planar problems
  int (*get)(const Policy&);
  void (*set)(Policy&, int value);
};

// The table itself (options.cpp).
const std::array<PolicySwitchRow, kPolicySwitchCount>& PolicySwitches();

// The switches that differ from `paper`, in table order ("give-up=second,ties=contacts"), or "paper".
std::string PolicyName(const Policy& policy);

// Reads a policy as PolicyName writes it; any order, and explicit defaults, are accepted.
// Throws std::invalid_argument that names the word and what was expected.
Policy ParsePolicy(std::string_view text);

// The whole planar grid in table order, the last switch varying fastest: 1536 policies.
const std::vector<Policy>& PlanarGrid();

// A policy as ParsePolicy reads it, or "*": the planar grid.
std::vector<Policy> ParsePolicies(std::string_view text);

// A set of switches as bits.
using SwitchMask = std::uint16_t;
inline constexpr SwitchMask Bit(PolicySwitch s) { return static_cast<SwitchMask>(1u << static_cast<int>(s)); }

// Whether two policies have the same values on every switch of the mask.
bool AgreeOn(SwitchMask mask, const Policy& left, const Policy& right);

// ---- Numbers ---------------------------------------------------------------------------------

// Tolerances of inexact runs, relative to the scale of the problem: accelerations to max abs(b)
// (m/s^2), forces to max abs(b) / max A_ii (N), pivots to the entries of their column. Exact runs
// read none of them.
struct Tolerances {
  double acceleration = 1e-10;
  double force = 1e-10;
  double pivot = 1e-11;
  double loop_grain = 1e-6;

  bool operator==(const Tolerances&) const = default;
};

// Budgets; a run that spends one ends in `limit` and says which.
struct Limits {
  std::int64_t drives = 10000;
  std::int64_t pivots = 100000;
  std::int64_t bits = 100000;
  std::int64_t programs = 1000000;  // linear, of enumerations of contact modes alone; no command asks for it
  // Set by somebody who no longer waits: the run ends `undecided`, soon. No part of what a run is.
  const std::atomic<bool>* stop = nullptr;

  bool Stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
  bool operator==(const Limits&) const = default;
};

struct NumberRow {
  std::string_view name;
  std::string_view unit;
  std::string_view help;
  double min;
  double max;
};

template <class Visit>
void ForEachField(Tolerances& t, Visit visit) {
  visit(NumberRow{"acceleration-tolerance", "of max abs(b)",
                  "accelerations below this are zero (inexact arithmetics)", 0, 1e-2},
        t.acceleration);
  visit(NumberRow{"force-tolerance", "of max abs(b) / max A_ii",
                  "forces and steps below this are zero (inexact arithmetics)", 0, 1e-2},
        t.force);
  visit(NumberRow{"pivot-tolerance", "of the largest entry",
                  "pivots and rates below this are zero (inexact arithmetics)", 0, 1e-2},
        t.pivot);
  visit(NumberRow{"loop-grain", "of max abs(b) / max A_ii",
                  "forces are rounded to this before states are compared (inexact arithmetics)", 1e-15, 1},
        t.loop_grain);
}

template <class Visit>
void ForEachField(Limits& limits, Visit visit) {
  visit(NumberRow{"max-drives", "drives", "budget of a run", 1, 1e12}, limits.drives);
  visit(NumberRow{"max-pivots", "steps", "budget of a run", 1, 1e12}, limits.pivots);
  visit(NumberRow{"max-bits", "bits", "longest numerator or denominator of an exact force", 1, 1e12},
        limits.bits);
}

// Unknowns from which on direction systems are updated, not solved afresh (updated_system.h), >= 1. Eight
// planar contacts have less.
inline constexpr int kUpdateFrom = 16;

enum class Arithmetic : std::uint8_t { kFloat, kDouble, kQuad, kInterval, kFiltered, kExact };
inline constexpr int kArithmeticCount = 6;
inline constexpr std::array<std::string_view, kArithmeticCount> kArithmeticNames = {
    "float", "double", "quad", "interval", "filtered", "exact"};

inline constexpr std::array<Arithmetic, kArithmeticCount> kArithmetics = {
    Arithmetic::kFloat,    Arithmetic::kDouble,   Arithmetic::kQuad,
    Arithmetic::kInterval, Arithmetic::kFiltered, Arithmetic::kExact};

inline constexpr std::string_view Name(Arithmetic arithmetic) {
  return kArithmeticNames[static_cast<int>(arithmetic)];
}

// What a filtered run is decided on, in this order: balls around doubles, around double-doubles, rationals.
enum class Rung : std::uint8_t { kDouble, kDoubleDouble, kExact };
inline constexpr int kRungCount = 3;
inline constexpr std::array<std::string_view, kRungCount> kRungNames = {"double", "double-double", "exact"};
inline constexpr std::string_view Name(Rung rung) { return kRungNames[static_cast<int>(rung)]; }

template <class Scalar>
inline constexpr Arithmetic kArithmeticOf = Arithmetic::kExact;
template <>
inline constexpr Arithmetic kArithmeticOf<float> = Arithmetic::kFloat;
template <>
inline constexpr Arithmetic kArithmeticOf<double> = Arithmetic::kDouble;

// Why a run that was stopped (Limits::stop) is undecided.
inline constexpr std::string_view kStopped = "stopped";

// ---- Request: what is asked of a problem -----------------------------------------------------

inline constexpr std::string_view kAutomatic = "auto";

class DependentRows;  // enclosure.h

struct Request {
  std::string_view method = kAutomatic;        // a name of the table, which outlives the request
  Arithmetic arithmetic = Arithmetic::kExact;  // of the call by names (certify/request/solve_in.h)
  FrictionLaw law = FrictionLaw::kCoulomb;     // in space; of the method baraff it is kBaraff
  Policy policy = {};                          // of the published algorithm
  Tolerances tolerances = {};                  // of inexact arithmetics
  Limits limits = {};
  double residual = 0;                 // largest error of an answer that is called solved; 0: kSolvedResidual
  double noise = 0;                    // accelerations up to it are rounding of b, and no error; m/s^2
  int sides = 8;                       // of friction polygons in space, a multiple of 4; 0: none
  bool trace = false;                  // whether the answer has the path of its method
  bool confirm = true;                 // whether suspicions are run again
  DependentRows* dependent = nullptr;  // over enclosures: rows that follow from others; null: none are known

  bool operator==(const Request&) const = default;
};

}  // namespace stiction
