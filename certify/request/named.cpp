// SPDX-License-Identifier: Apache-2.0
// A method by its name, in any arithmetic.

#include <algorithm>

#include "certify/exact/bodies.h"
#include "certify/exact/filtered.h"
#include "certify/exact/inexact.h"
#include "certify/exact/interval.h"
#include "certify/exact/published_space.h"
#include "certify/request/cascade.h"
#include "certify/request/entries.h"
#include "certify/request/quad.h"
#include "certify/request/solve_in.h"
#include "corpus/rounded.h"

namespace stiction {
namespace {

// ---- Floating point ------------------------------------------------------------------------------

// The published algorithm in space again: over quad, loop_grain 1e-12, tolerances of at most 1e-14.
InexactAnswer RunFinely(const ContactProblem<double>& problem, Request request) {
  Tolerances& t = request.tolerances;
  for (double* tolerance : {&t.acceleration, &t.force, &t.pivot}) *tolerance = std::min(*tolerance, 1e-14);
  t.loop_grain = std::min(t.loop_grain, 1e-12);
  request.trace = false;
  const auto wide = Converted<Quad>(problem, [](double x) { return Quad(x); });
  return InDoubles(Solve(wide, request), wide, ResidualOf<double>(request));
}

// The suspicion of a run of the published algorithm in space: the same problem, more finely.
void RunAgainInSpace(const ContactProblem<double>& ran, const Request& request, Solution& solution) {
  InexactAnswer& first = std::get<InexactAnswer>(solution.answer);
  InexactAnswer again = RunFinely(ran, request);
  again.arithmetic = first.arithmetic;
  again.pivots = std::move(first.pivots);
  solution.suspected = std::exchange(first, std::move(again));
}

// An exact answer, told in these numbers: its forces are rounded, and judged.
template <class Scalar>
InexactAnswer Told(const ExactAnswer& exact, const ContactProblem<Scalar>& numbers, const Request& request) {
  const auto convert = [](const Rational& x) { return static_cast<double>(static_cast<Scalar>(ToDouble(x))); };
  const double bound = ResidualOf<Scalar>(request);
  InexactAnswer told;
  told.outcome = exact.outcome;
  told.reason = exact.reason;
  told.start = exact.start;
  told.period = exact.period;
  told.method = exact.method;
  told.arithmetic = request.arithmetic;
  told.law = exact.law;
  told.word = exact.word;
  told.counters = exact.counters;
  told.f = exact.f.unaryExpr(convert);
  told.a = exact.a.unaryExpr(convert);
  told.ray = exact.ray.unaryExpr(convert);
  told.first_f = exact.first_f.unaryExpr(convert);
  for (const auto& pivot : exact.pivots) told.pivots.push_back(Converted<double>(pivot, convert));
  if (exact.f.size() != numbers.rows()) return told;
  if constexpr (std::is_same_v<Scalar, float>) {  // held to what float tells
    Answer<float> narrow;
    narrow.outcome = told.outcome;
    narrow.law = told.law;
    narrow.f = told.f.template cast<float>();
    JudgeAnswer(numbers, bound, narrow);
    told.outcome = narrow.outcome;
    if (!narrow.reason.empty()) told.reason = narrow.reason;
    told.f = narrow.f.template cast<double>();
    told.a = narrow.a.template cast<double>();
    told.errors = narrow.errors;
  } else {
    JudgeAnswer(Converted<double>(numbers, [](const Scalar& x) { return static_cast<double>(x); }), bound,
                told);
  }
  return told;
}

// An exact method, run on rounded numbers, which are another problem than the file's: it answers with an
// InexactAnswer, which is never called exact or proved.
template <class Scalar>
InexactAnswer RunExactly(const ContactProblem<Scalar>& numbers, bool is_file, const Request& request) {
  const ExactAnswer exact = SolveExactly(Unrounded(numbers), request);
  InexactAnswer told = Told(exact, numbers, request);
  if (exact.outcome != Outcome::kNoSolution || is_file) return told;
  told.outcome = Outcome::kUndecided;
  told.reason = "the problem, rounded to " + std::string(Name(request.arithmetic)) +
                ", has no solution, which proves nothing of the file; --arithmetic exact decides it";
  return told;
}

// An answer that is only a suspicion: the same problem is run again where that decides more.
template <class Scalar>
void Confirm(Posed& posed, const ContactProblem<Scalar>& ran, const Request& request, Solution& solution) {
  const auto& first = std::get<InexactAnswer>(solution.answer);
  const MethodFacts* facts = FindMethodFacts(request.method);
  const bool is_path = facts != nullptr && facts->HasPath();
  if (first.Solved() || !is_path || !request.confirm || request.limits.Stopped()) return;
  if (ran.dimension == 3 && request.method == "baraff") {
    RunAgainInSpace(Converted<double>(ran, [](const Scalar& x) { return static_cast<double>(x); }), request,
                    solution);
    return;
  }
  if (ran.dimension != 2 || !facts->IsBuilt(ran.dimension, Arithmetic::kExact)) return;
  solution.suspected = first;
  if (IsRoundedExactly<Scalar>(posed.file(), ran)) {
    solution.answer = SolveExactly(posed.file(), request);
  } else {
    solution.answer = RunExactly(ran, false, request);
  }
}

// What decides exactly decides the problem of the file, in whatever numbers its forces are asked for: these are
// rounded, and judged on the problem that is rounded as they are.
template <class Scalar>
Solution SolveAndRound(Posed& posed, const ContactProblem<Scalar>& rounded, const Request& request) {
  ExactAnswer exact = SolveExactly(posed.file(), request);
  if (exact.outcome == Outcome::kNoSolution) return {.answer = std::move(exact)};
  return {.answer = Told(exact, rounded, request)};
}

// The row that is built over doubles alone; null if there is none.
template <class Scalar>
const Method<Scalar>* FindOverDoubles(std::string_view name) {
  if constexpr (std::is_same_v<Scalar, double>) {
    const auto rows = MethodsOverDoubles();
    const auto row = std::find_if(rows.begin(), rows.end(), [name](auto& m) { return m.name == name; });
    if (row != rows.end()) return &*row;
  }
  return nullptr;
}

template <class Scalar>
Solution SolveRounded(Posed& posed, const ContactProblem<Scalar>& rounded, const Request& request) {
  const Method<Scalar>* row = FindOverDoubles<Scalar>(request.method);
  const bool is_of_table = request.method == kAutomatic || FindMethod<Scalar>(request.method) != nullptr;
  if (row == nullptr && !is_of_table) return SolveAndRound(posed, rounded, request);
  const Answer<Scalar> answer = row != nullptr ? SolveBy(*row, rounded, request) : Solve(rounded, request);
  Solution solution = {.answer = InDoubles(answer, rounded, ResidualOf<Scalar>(request))};
  Confirm(posed, rounded, request, solution);
  return solution;
}

// ---- Enclosures ----------------------------------------------------------------------------------

// What enclosures prove is said of the algorithm in exact arithmetic. The midpoints are judged besides.
void JudgeMiddles(const ExactProblem& problem, const Request& request, InexactAnswer& answer) {
  if (!answer.Solved()) return;
  const Eigen::VectorXd a = answer.a;
  JudgeAnswer(Rounded<double>(problem), ResidualOf<double>(request), answer);
  answer.a = a;
}

Solution SolveOverIntervals(const ExactProblem& problem, const Request& request) {
  InexactAnswer answer = problem.dimension == 2 ? RunEnclosed(FindMethodFacts(request.method)->name, problem,
                                                              request, Rung::kDouble)
                                                : RunIntervalsInSpace(problem, request);
  answer.arithmetic = Arithmetic::kInterval;
  JudgeMiddles(problem, request, answer);
  return {.answer = std::move(answer)};
}

// Empty where the rung leaves a sign open, or knows forces too badly to call them a solution.
std::optional<InexactAnswer> SolveOnRung(const ExactProblem& problem, const Request& request, Rung rung) {
  InexactAnswer answer = RunEnclosed(FindMethodFacts(request.method)->name, problem, request, rung);
  try {
    JudgeMiddles(problem, request, answer);
  } catch (const RangeError&) {
    return std::nullopt;
  }
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = rung;
  const bool open = answer.outcome == Outcome::kUndecided && !request.limits.Stopped();
  return open ? std::nullopt : std::optional(std::move(answer));
}

// A certified end, or rung by rung.
Solution SolveFiltered(const AnyProblem& problem, const Request& request) {
  // The published algorithm, and whatever is told step by step, is run with certified signs from the start.
  if (request.method != "baraff" && !request.trace) {
    CertifiedAnswer certified = CertifyDoubles(request.method, problem, request);
    if (auto* answer = std::get_if<InexactAnswer>(&certified)) return {.answer = std::move(*answer)};
    if (auto* answer = std::get_if<ExactAnswer>(&certified)) return {.answer = std::move(*answer)};
  }
  const bool has_rungs = FindMethodFacts(request.method)->IsBuilt(problem.dimension(), Arithmetic::kInterval);
  for (const Rung rung : {Rung::kDouble, Rung::kDoubleDouble}) {
    if (!has_rungs) break;
    if (auto answer = SolveOnRung(problem, request, rung)) return {.answer = *std::move(answer)};
  }
  ExactAnswer answer = SolveExactly(problem, request);
  answer.arithmetic = Arithmetic::kFiltered;
  answer.rung = Rung::kExact;
  return {.answer = std::move(answer)};
}

// Whether A stays as it is: nothing that is asked for needs all of it.
bool TakesEntries(Posed& posed, const Request& request) {
  if (!posed.StaysSparse() || request.arithmetic != Arithmetic::kDouble) return false;
  const auto methods = MethodsOfEntries(posed.file());
  return std::find(methods.begin(), methods.end(), request.method) != methods.end();
}

}  // namespace

Solution SolveNamed(Posed& posed, const Request& request) {
  if (TakesEntries(posed, request)) return {.answer = SolveEntries(posed.file(), request)};
  switch (request.arithmetic) {
    case Arithmetic::kFloat:
      return SolveRounded(posed, posed.RoundedTo<float>(), request);
    case Arithmetic::kDouble:
      if (IsOfBodies(request.method) && posed.factors() != nullptr)
        return {.answer = SolveByBodies(*posed.factors(), request)};
      return SolveRounded(posed, posed.doubles(), request);
    case Arithmetic::kQuad:
      return SolveRounded(posed, posed.RoundedTo<Quad>(), request);
    case Arithmetic::kInterval:
      return SolveOverIntervals(posed.file(), request);
    case Arithmetic::kFiltered:
      return SolveFiltered(posed.file(), request);
    default:
      return {.answer = SolveExactly(posed.file(), request)};
  }
}

}  // namespace stiction
