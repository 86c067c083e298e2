// SPDX-License-Identifier: Apache-2.0
// What a search asks of exact arithmetic, in space of intervals; and of Ipopt. Tests put wrong answers in the
// place of these, to see that every alarm of a search rings.

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "corpus/exact_problem.h"
#include "solver/problem/answer.h"
#include "solver/problem/options.h"

namespace stiction {

struct Enumeration;  // certify/exact/enumerate.h
struct ExactRun;     // certify/exact/exact.h
struct OnRung;       // certify/exact/filtered.h
struct Request;
struct Rungs;  // certify/exact/filtered.h

// What Ipopt makes of a problem. It proposes, and rationals judge, so that a solution is one; its iterations
// depend on the machine's libraries.
struct Feasibility {
  std::string outcome;      // solved; undecided: no start led to a solution; unavailable: it cannot be asked
  std::int64_t starts = 0;  // until it was solved, or all
  double seconds = 0;       // of Ipopt's process
};

using ExactMethod = std::function<Answer<Rational>(const ExactProblem&, const Limits&)>;

struct ExactMethods {
  ExactMethods();  // those of certify

  std::function<ExactRun(const ExactProblem&, const Request&)> published;
  std::function<OnRung(const ExactProblem&, const Request&, const Rungs&)> filtered;
  ExactMethod complete, complete_filtered, lemke;
  std::function<Enumeration(const ExactProblem&)> modes;
  std::function<std::optional<bool>(const ExactProblem&)> is_safe;
  std::function<Feasibility(const ExactProblem&)> ipopt;
  // In space: the published algorithm over intervals, complete driving on polygons until (21), (22) hold.
  std::function<Answer<double>(const ExactProblem&, const Request&)> published_in_space;
  ExactMethod complete_in_space;
};

}  // namespace stiction
