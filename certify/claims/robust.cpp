// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/robust.h"

#include <algorithm>

#include "certify/exact/interval.h"
#include "certify/exact/same_run.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using IntervalProblem = ContactProblem<Interval>;

constexpr int kLargestExponent = 40;

template <class Entries>
Rational LargestOf(const Entries& entries) {
  Rational largest = 0;
  for (const Rational& x : entries.reshaped()) largest = std::max<Rational>(largest, abs(x));
  return largest;
}

// Everything within `by` of x.
Interval Within(const Rational& x, const Rational& by) { return {Around(x - by).inf(), Around(x + by).sup()}; }

IntervalProblem BoxAbout(const ExactProblem& problem, const Rational& radius) {
  IntervalProblem box;
  box.dimension = problem.dimension;
  for (const auto& contact : problem.contacts) {
    Contact<Interval> wide;
    wide.kind = contact.kind;
    wide.mu = Within(contact.mu, radius * contact.mu);
    wide.slip = {Interval(0), Interval(0)};
    box.contacts.push_back(wide);
  }
  const Rational of_A = radius * LargestOf(problem.A), of_b = radius * LargestOf(problem.b);
  box.A = problem.A.unaryExpr([&](const Rational& x) { return Within(x, of_A); });
  box.b = problem.b.unaryExpr([&](const Rational& x) { return Within(x, of_b); });
  return box;
}

}  // namespace

bool LoopsWithin(const ExactProblem& problem, const ExactRun& run, const Request& request,
                 const Rational& radius) {
  STICTION_CHECK(PublishedHandles(problem), "static and frictionless contacts of the plane");
  if (run.verdict.outcome != Outcome::kCycle) return false;
  return SameRun(BoxAbout(problem, radius), run, request);
}

std::optional<Rational> LargestRadius(const std::function<bool(const Rational&)>& holds) {
  if (!holds(0)) return std::nullopt;
  // Boxes grow with the radius, and with them all that is uncertain.
  Rational unit(1, 2);
  for (int k = 1; k <= kLargestExponent; ++k, unit /= 2) {
    if (!holds(unit)) continue;
    int parts = 8;  // eighths of `unit`
    while (parts < 15 && holds(unit * (parts + 1) / 8)) ++parts;
    return Rational(unit * parts / 8);
  }
  return Rational(0);
}

std::optional<Rational> RadiusOfLoop(const ExactProblem& problem, const Request& request) {
  const ExactRun run = RunExact(problem, request);
  return LargestRadius([&](const Rational& radius) { return LoopsWithin(problem, run, request, radius); });
}

}  // namespace stiction
