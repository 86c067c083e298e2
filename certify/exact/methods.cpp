// SPDX-License-Identifier: Apache-2.0
// The table of methods over rationals. A new exact method is a row here and its run.

#include <algorithm>

#include "certify/exact/bodies.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/feasibility_nlp.h"
#include "certify/exact/nearby_words.h"
#include "certify/exact/qp.h"
#include "certify/exact/solve.h"
#include "certify/exact/space.h"
#include "corpus/rounded.h"
#include "solver/in_turn.h"
#include "solver/numeric/proximal.h"
#include "solver/problem/reduction.h"
#include "solver/solve.ipp"

namespace stiction {
namespace {

using ExactMethod = Method<Rational>;

constexpr std::int64_t kAutomaticPrograms = 10000;  // linear programs, before `auto` leaves a problem open
constexpr std::int64_t kAutomaticProgramsInSpace = 2000;

// ---- Runs ------------------------------------------------------------------------------------

template <SpaceEngine kEngine>
Answer<Rational> RunOnPolygons(const ExactProblem& problem, const Request& request) {
  return SolveInSpace(problem, request, kEngine);
}

// The request, with a budget of linear programs.
Request OfPrograms(Request request, std::int64_t programs) {
  request.limits.programs = std::min({request.limits.programs, request.limits.pivots, programs});
  return request;
}

Counters CountersOf(const Enumeration& modes) {
  return {{Counter::kPrefixes, modes.prefixes}, {Counter::kPrograms, modes.programs}};
}

// Of one that found no solution.
Answer<Rational> AnswerOf(const Enumeration& modes) {
  Answer<Rational> answer;
  answer.counters = CountersOf(modes);
  answer.reason = kStopped;
  if (modes.ProvesNoSolution()) {
    answer.outcome = Outcome::kNoSolution;
    answer.reason = "no mode of the contacts has a solution; certify writes the proof";
  } else if (modes.end == EnumerationEnd::kLimit) {
    answer.outcome = Outcome::kLimit;
    answer.reason = "programs";
  } else if (modes.end == EnumerationEnd::kOpen) {
    answer.reason = "a word of touching and separated contacts is left that nothing refutes";
  }
  return answer;
}

// The first solution in the order of the mode words, or that there is none.
Answer<Rational> RunEnumeration(const ExactProblem& problem, const Request& request) {
  Answer<Rational> answer;
  if (request.limits.Stopped()) {  // while `auto` ran another method; the first program alone can take minutes
    answer.reason = kStopped;
    return answer;
  }
  const Enumeration modes = EnumerateModes(problem, OfPrograms(request, kAutomaticPrograms), UntilSolved);
  if (modes.solutions.empty()) return AnswerOf(modes);
  answer.outcome = Outcome::kSolved;
  answer.f = modes.solutions.front().f;
  answer.counters = CountersOf(modes);
  return answer;
}

// That there is no solution, or nothing.
Answer<Rational> RunRefutation(const ExactProblem& problem, const Request& request) {
  Answer<Rational> answer;
  answer.reason = kStopped;
  if (!request.limits.Stopped())
    answer = AnswerOf(RefuteInSpace(problem, OfPrograms(request, kAutomaticProgramsInSpace)));
  answer.law = request.law;
  return answer;
}

// Ipopt proposes, exact arithmetic decides.
Answer<Rational> RunIpopt(const ExactProblem& problem, const Request&) {
  return IpoptProposer().ProposeSolution(problem);
}

// A solution in the cells of forces over doubles: those of the fast method, whose limits are reached by many,
// or of proximal points, whose limits are reached by few. None where doubles do not hold the problem.
Answer<Rational> SolveNearDoubles(const ExactProblem& problem, const Limits& limits) try {
  constexpr int kWords = 16;
  std::set<ModeWord> tried;
  Counters counters;
  const ContactProblem<double> rounded = Rounded<double>(problem);
  const ScaledProblem scaled = MakeScaled(problem, rounded);
  const auto near = [&](const Eigen::VectorXd& f) {
    std::vector<double> point;
    for (const double x : f) point.push_back(x / ToDouble(scaled.force));
    Answer<Rational> found = SolveNear(problem, scaled, point, kWords, tried);
    found.counters += counters;
    counters = found.counters;
    return found;
  };
  const auto near_fast = [&] { return near(Solve(rounded, {.method = "fast", .limits = limits}).f); };
  const auto near_proximal = [&] {
    ProximalNewton<double> proximal({.limits = limits}, 1e-13);
    proximal.Run({rounded.dimension, rounded.contacts, rounded.A.sparseView(), rounded.b});
    return near(proximal.f());
  };
  Answer<Rational> answer = InTurn<Answer<Rational>>({near_fast, near_proximal});
  answer.counters = counters;
  return answer;
} catch (const InputError&) {
  return {};
}

// The published algorithm within a budget of steps: a solution, or nothing. It passes many ties sooner than
// complete driving.
Answer<Rational> RunPublishedBriefly(const ExactProblem& problem, Request request) {
  constexpr int kStepsOfRow = 4;
  request.method = "baraff";
  request.limits.pivots = std::min<std::int64_t>(request.limits.pivots, kStepsOfRow * (problem.rows() + 1));
  Answer<Rational> answer = Solve(problem, request);
  return answer.Solved() ? answer : Answer<Rational>();
}

// Where the cells of doubles are none, the published algorithm and complete driving.
Answer<Rational> RunFastExactly(const ExactProblem& problem, const Request& request) {
  Counters counters;
  const auto run_cells = [&] {
    Answer<Rational> near = SolveNearDoubles(problem, request.limits);
    counters = {
        {Counter::kWords, near.counters[Counter::kWords]}, {Counter::kPublished, 0}, {Counter::kFallbacks, 0}};
    return near;
  };
  const auto run_published = [&] {
    ++counters[Counter::kPublished];
    return RunPublishedBriefly(problem, request);
  };
  const auto run_complete = [&] {
    ++counters[Counter::kFallbacks];
    Request complete = request;
    complete.method = "complete";
    return Solve(problem, complete);
  };
  Answer<Rational> answer = InTurn<Answer<Rational>>({run_cells, run_published, run_complete});
  answer.counters = counters;
  return answer;
}

// In space the modes of its point, solved exactly.
Answer<Rational> RunFastInSpace(const ExactProblem& problem, const Request& request) {
  return SolveNearFast(problem, request);
}

Answer<Rational> RunQp(const ExactProblem& problem, const Request&) { return SolveQp(problem); }

Answer<double> RunQpByIpopt(const ContactProblem<double>& problem, const Request&) {
  ExactProblem normals = Unrounded(problem);
  normals.dimension = 2;  // without friction space is the plane
  return IpoptProposer().ProposePoint(normals);
}

// ---- The table ---------------------------------------------------------------------------------

constexpr std::string_view kExactEnd = "a solution, verified; nothing where it finds none";

ExactMethod EnumerateRow() {
  return {.name = "enumerate",
          .title = "all words of contact modes, an exact linear program each",
          .source = "certify/exact/enumerate.h",
          .ends = "a solution, or that there is none; in space that there is none, or nothing",
          .automatic = true,
          .plane = {&RunEnumeration, true},
          .space = {&RunRefutation, true}};
}

ExactMethod IpoptRow() {
  return {.name = "ipopt",
          .title = "feasibility problem (17), (18) by Ipopt, its modes solved exactly",
          .source = "[Baraff94] 5.1; certify/exact/feasibility_nlp.h",
          .ends = kExactEnd,
          .automatic = false,
          .plane = {&RunIpopt, true},
          .space = {}};
}

ExactMethod FastRow() {
  return {.name = "fast",
          .title =
              "what the method finds over doubles, its cells solved exactly; behind them the published "
              "algorithm and complete driving",
          .source = "solver/numeric/fast.h",
          .ends = kExactEnd,
          .automatic = true,
          .plane = {&RunFastExactly, true, true, kCellsFirst},
          .space = {&RunFastInSpace, true, false, kCellsFirst}};
}

constexpr std::string_view kQpTitle = "the quadratic program f'Af / 2 + b'f over f >= 0, frictionless";
constexpr std::string_view kQpSource = "[Baraff94] 5.1, equation (5); certify/exact/qp.h";

ExactMethod QpRow() {
  return {.name = "qp",
          .title = kQpTitle,
          .source = kQpSource,
          .ends = "a solution, or a direction that proves that there is none (CGAL)",
          .automatic = false,
          .plane = {&RunQp, true},
          .space = {&RunQp, true}};
}

Method<double> QpByIpoptRow() {
  return {.name = "qp",
          .title = kQpTitle,
          .source = kQpSource,
          .ends = "nothing (Ipopt); what is called solved has the residual that is asked for",
          .automatic = false,
          .plane = {&RunQpByIpopt, true},
          .space = {&RunQpByIpopt, true}};
}

}  // namespace

template <>
std::span<const ExactMethod> Methods<Rational>() {
  static const std::array rows = {
      CompleteRow<Rational>({&RunOnPolygons<SpaceEngine::kComplete>, true}),
      LemkeRow<Rational>({&RunOnPolygons<SpaceEngine::kLemke>, true}),
      FastRow(),
      EnumerateRow(),
      QpRow(),
      IpoptRow(),
      BaraffRow<Rational>({}),
  };
  return rows;
}

template Answer<Rational> Solve(const ExactProblem&, const Request&);
template const ExactMethod* FindMethod(std::string_view);

std::span<const Method<double>> MethodsOverDoubles() {
  static const std::array rows = {NewtonBodiesRow(), InteriorPointRow(), QpByIpoptRow()};
  return rows;
}

}  // namespace stiction
