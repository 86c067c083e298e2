// SPDX-License-Identifier: Apache-2.0
// One problem given to a solver under test: how it fails, if it does.

#ifndef STICTION_SEARCH_UNDER_TEST_EXAMINE_H_
#define STICTION_SEARCH_UNDER_TEST_EXAMINE_H_

#include <string>
#include <string_view>

#include "search/under_test/judge_forces.h"
#include "search/under_test/solver_process.h"

namespace stiction {

struct Examined {
  std::string_view
      kind;  // of a failure (corpus/record/kinds.h); "passed"; "refused", "unjudged": none that is shown
  std::string what;  // in which way: signal, condition that is missed; may be empty
  double error = 0;  // of what is called solved
  bool misses_coulomb = false;
  bool says_solved = false;

  // "silent-wrong-pulls-2c": what findings are grouped by. Requires a failure.
  std::string Signature(std::size_t contacts) const;
  bool Fails() const;
};

// The problem as posed. What takes longer than so many seconds of processor time hangs.
Examined Examine(SolverProcess& process, const ContactProblem<double>& posed, double seconds = kSolverSeconds);

// Bytes that the solver keeps of every call with this problem, alone in a new process; 0 if its memory does not
// grow all the time.
std::int64_t LeakOf(SolverProcess& process, const ContactProblem<double>& posed);

}  // namespace stiction

#endif  // STICTION_SEARCH_UNDER_TEST_EXAMINE_H_
