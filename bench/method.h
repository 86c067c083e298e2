// SPDX-License-Identifier: Apache-2.0
// The methods that are compared, ready to run. Entry: BenchedMethods().
//
// Every answer is verified: exact ones by FindViolation, doubles by the gate, both outside the time
// taken. A time is one call of an algorithm that keeps its memory between calls, for any number of contacts,
// with the forces copied out: the less of wall-clock time and processor time, since a busy machine interrupts
// what takes longer than its time slices.

#ifndef STICTION_BENCH_METHOD_H_
#define STICTION_BENCH_METHOD_H_

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "bench/family.h"
#include "bench/measure.h"

namespace stiction {

struct BenchMethod {
  std::string name;
  std::string reading;  // policy, cover or formulation
  std::string arithmetic;
  std::string counts;     // what Measure::work is
  int one_in = 1;         // of so many problems it is given one
  int most_contacts = 0;  // 0: any
  std::function<Measure(const BenchProblem&)> run;

  bool exact() const { return arithmetic == "exact"; }
  std::string Title() const { return name + " " + (reading.empty() ? "" : "(" + reading + ") ") + arithmetic; }
};

// Places in the list of methods, for tables that name them. kAsComplete: under the policy that files and
// suspends as complete driving does.
enum MethodPlace { kComplete, kPaper, kSuspended, kAsComplete, kLemke, kLemkeUnits, kCompleteDouble, kIpopt };
inline constexpr std::array kPublished = {kPaper, kSuspended, kAsComplete};
// Starts Ipopt's process: InputError if it cannot be run.
std::vector<BenchMethod> BenchedMethods();

// Without friction: section 4, and beside it elimination of A f = -b, Lemke's method, the fast method, and the
// quadratic program by Ipopt over doubles and by CGAL exactly.
enum FrictionlessPlace { kGauss, kBaraffDouble, kLemkeDouble, kFastDouble, kQuadratic, kExactQuadratic };
std::vector<BenchMethod> FrictionlessMethods();

}  // namespace stiction

#endif  // STICTION_BENCH_METHOD_H_
