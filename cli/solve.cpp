// SPDX-License-Identifier: Apache-2.0
// stiction solve: one problem, one method, one arithmetic.

#include <fmt/format.h>

#include <iostream>

#include "certify/certificate.h"
#include "certify/existence.h"
#include "certify/feasibility_nlp.h"
#include "certify/verify_solution.h"
#include "cli/shared.h"
#include "cli/solve_published_space.h"
#include "cli/solve_space.h"
#include "cli/verbs.h"
#include "corpus/json_text.h"
#include "corpus/rounded.h"
#include "solver/numeric/fast.h"
#include "solver/problem/reduction.ipp"
#include "solver/problem/residual.h"

namespace stiction {
namespace {

struct SolveOptions {
  std::string file;
  std::string method = "baraff";
  std::string arithmetic;  // empty: exact; double for method fast; interval for method baraff in space
  std::string policy = "paper";
  std::string law = "baraff";
  int sides = 8;
  Limits limits;
  Tolerances tolerances;
  bool json = false;
};

// What came out, in the terms of JSON.
struct Solved {
  Verdict verdict;
  Json f, a, ray;
  Json residual;
  Json statistics;
  Json word;
};

// What a method says of a problem.
template <class Scalar>
struct Answer {
  using Vector = typename ContactProblem<Scalar>::Vector;

  Verdict verdict;
  Vector f, ray;  // empty where there is none
  Json statistics;
  Json word;  // cells, one letter per contact
};

Json RunToJson(const Verdict& verdict) {
  Json json = {{"outcome", Name(verdict.outcome)}};
  if (!verdict.reason.empty()) json["reason"] = verdict.reason;
  if (verdict.outcome == Outcome::kCycle || verdict.outcome == Outcome::kStall) {
    json["start"] = verdict.start;
    json["period"] = verdict.period;
  }
  return json;
}

template <class Scalar>
Answer<Scalar> AnswerOf(Outcome outcome, std::string_view reason) {
  Answer<Scalar> answer;
  answer.verdict.outcome = outcome;
  answer.verdict.reason = reason;
  return answer;
}

// ---- Exact arithmetic ------------------------------------------------------------------------

Answer<Rational> RunPublished(const ExactProblem& problem, const PublishedOptions& options) {
  const ExactRun run = RunExact(problem, options);
  return {run.verdict, run.state.f, run.ray, StatisticsToJson(run.verdict.statistics), {}};
}

Answer<Rational> RunComplete(const ExactProblem& problem, const PublishedOptions& options) {
  const CompleteRun run = RunComplete(problem, options.limits);
  auto answer = AnswerOf<Rational>(run.verdict.outcome, run.verdict.reason);
  answer.f = run.f;
  answer.ray = run.ray;
  answer.statistics = StatisticsToJson(run.verdict.statistics);
  answer.word = run.word;
  return answer;
}

Answer<Rational> RunLemke(const ExactProblem& problem, const PublishedOptions& options) {
  const LemkeRun run = RunLemke(problem, options.limits);
  return {run.verdict, run.f, run.ray, {{"pivots", run.verdict.statistics.pivots}}, {}};
}

// The first solution in the order of the mode words. That there is none is a claim of `certify`.
Answer<Rational> RunModes(const ExactProblem& problem) {
  EnumerationOptions options;
  options.first_solution_only = true;
  const Enumeration modes = EnumerateModes(problem, options);
  auto answer = AnswerOf<Rational>(modes.solutions.empty() ? Outcome::kUndecided : Outcome::kSolved, "");
  if (modes.ProvesNoSolution()) answer.verdict.reason = "no mode has a solution; see certify";
  if (!modes.solutions.empty()) answer.f = modes.solutions.front().f;
  answer.statistics = {{"prefixes", modes.prefixes}, {"programs", modes.programs}};
  return answer;
}

// Ipopt proposes, exact arithmetic decides.
Answer<Rational> RunIpopt(const ExactProblem& problem) {
  IpoptProposer proposer;
  ProposalStatistics statistics;
  const auto f = proposer.ProposeSolution(problem, ProposalOptions{}, statistics);
  auto answer = AnswerOf<Rational>(f ? Outcome::kSolved : Outcome::kUndecided,
                                   f ? "" : "no point that Ipopt proposed led to a solution");
  if (f) answer.f = *f;
  answer.statistics = {
      {"starts", statistics.starts}, {"iterations", statistics.iterations}, {"words", statistics.words}};
  return answer;
}

Answer<Rational> RunMethod(const std::string& method, const ExactProblem& problem,
                           const PublishedOptions& options) {
  if (method == "complete") return RunComplete(problem, options);
  if (method == "lemke") return RunLemke(problem, options);
  if (method == "enumerate") return RunModes(problem);
  if (method == "ipopt") return RunIpopt(problem);
  return RunPublished(problem, options);
}

// ---- Inexact arithmetics ---------------------------------------------------------------------

template <class Scalar>
Answer<Scalar> RunMethod(const std::string& method, const ContactProblem<Scalar>& problem,
                         const PublishedOptions& options) {
  Answer<Scalar> answer;
  if (method == "complete") {
    CompleteOptions complete;
    complete.tolerances = options.tolerances;
    complete.limits = options.limits;
    CompleteDriving<Scalar> driving(complete);
    const CompleteVerdict verdict = driving.Run(problem);
    answer = AnswerOf<Scalar>(verdict.outcome, verdict.reason);
    answer.statistics = StatisticsToJson(verdict.statistics);
    answer.word = driving.Word();
    answer.f = driving.state().f;
  } else if (method == "lemke") {
    LemkeOptions lemke;
    lemke.cover = Cover::kUnits;
    lemke.tolerances = options.tolerances;
    lemke.limits = options.limits;
    LemkeAlgorithm<Scalar> algorithm(lemke);
    answer.verdict = algorithm.Run(problem);
    answer.statistics = {{"pivots", answer.verdict.statistics.pivots}};
    if (answer.verdict.outcome == Outcome::kSolved) answer.f = algorithm.f();
  } else if (method == "fast") {
    FastOptions fast;
    fast.tolerances = options.tolerances;
    fast.limits = options.limits;
    FastSolver<Scalar> solver(fast);
    const FastVerdict verdict = solver.Run(problem);
    answer = AnswerOf<Scalar>(verdict.outcome, verdict.reason);
    answer.statistics = StatisticsToJson(verdict.statistics);
    if (verdict.outcome == Outcome::kSolved) answer.word = solver.Word();
    answer.f = solver.f();
  } else {
    PublishedAlgorithm<Scalar> algorithm(options);
    answer.verdict = algorithm.Run(problem);
    answer.statistics = StatisticsToJson(answer.verdict.statistics);
    answer.f = algorithm.state().f;
  }
  return answer;
}

// ---- Bilateral constraints and sliding contacts (4.5, 6) ---------------------------------------

// The letters of all contacts; a bilateral one is always held.
template <class Scalar>
std::string FullWord(const ContactProblem<Scalar>& problem, const std::string& word) {
  std::string full;
  std::size_t next = 0;
  for (const auto& contact : problem.contacts)
    full += contact.kind == ContactKind::kBilateral ? '=' : word.at(next++);
  return full;
}

// Runs a method for frictionless and static contacts on what remains of any planar problem.
template <class Scalar>
Answer<Scalar> RunReduced(const std::string& method, const ContactProblem<Scalar>& problem,
                          const PublishedOptions& options) {
  if (!Reduction<Scalar>::Concerns(problem)) return RunMethod(method, problem, options);
  const Reduction<Scalar> reduction(problem, options.tolerances);
  if (reduction.end() != ReductionEnd::kReduced)
    return AnswerOf<Scalar>(Outcome::kSingular, Reason(reduction.end()));
  Answer<Scalar> answer = RunMethod(method, reduction.problem(), options);
  const auto rows = reduction.problem().rows();
  if (answer.f.size() == rows) answer.f = reduction.Forces(answer.f);
  if (rows > 0 && answer.ray.size() == rows) answer.ray = reduction.Direction(answer.ray);
  if (answer.word.is_string()) answer.word = FullWord(problem, answer.word.template get<std::string>());
  return answer;
}

Solved SolveExactly(const std::string& method, const ExactProblem& problem, const PublishedOptions& options) {
  const bool any_kind = method == "enumerate" || method == "ipopt";
  const Answer<Rational> answer =
      any_kind ? RunMethod(method, problem, options) : RunReduced<Rational>(method, problem, options);
  Solved solved;
  solved.verdict = answer.verdict;
  if (answer.f.size() == problem.rows()) {
    solved.f = VectorToJson(answer.f);
    solved.a = VectorToJson(Accelerations(problem, answer.f));
  }
  if (answer.ray.size() > 0) solved.ray = VectorToJson(answer.ray);
  solved.statistics = answer.statistics;
  solved.word = answer.word;
  return solved;
}

// `rounded`: the problem that was solved, exactly.
template <class Scalar>
Solved SolveRounded(const std::string& method, const ExactProblem& problem, const PublishedOptions& options,
                    ExactProblem& rounded) {
  const ContactProblem<Scalar> inexact = Rounded<Scalar>(problem);
  rounded = Converted<Rational>(inexact, [](Scalar x) { return Rational(static_cast<double>(x)); });
  const Answer<Scalar> answer = RunReduced<Scalar>(method, inexact, options);
  Solved solved;
  solved.verdict = answer.verdict;
  solved.statistics = answer.statistics;
  solved.word = answer.word;
  if (answer.f.size() != inexact.rows()) return solved;
  const typename ContactProblem<Scalar>::Vector a = inexact.A * answer.f + inexact.b;
  solved.f = NumbersToJson(answer.f);
  solved.a = NumbersToJson(a);
  if (answer.verdict.outcome == Outcome::kSolved)
    solved.residual = static_cast<double>(NaturalResidual(inexact, answer.f, a));
  return solved;
}

Solved SolveIn(const std::string& method, const std::string& arithmetic, const ExactProblem& problem,
               const PublishedOptions& options, ExactProblem& rounded) {
  if (arithmetic == "float") return SolveRounded<float>(method, problem, options, rounded);
  if (arithmetic == "double") return SolveRounded<double>(method, problem, options, rounded);
  if (arithmetic == "long-double") return SolveRounded<long double>(method, problem, options, rounded);
  return SolveExactly(method, problem, options);
}

int ExitOf(Outcome outcome) {
  if (outcome == Outcome::kSolved) return kExitDone;
  return outcome == Outcome::kLimit || outcome == Outcome::kUndecided ? kExitUndecided : kExitNotSo;
}

void PrintForPeople(const Json& result) {
  fmt::print("{}", result["outcome"].get<std::string>());
  if (result.contains("period"))
    fmt::print(", start {}, period {}", result["start"].dump(), result["period"].dump());
  fmt::print("\n");
  for (const auto& [key, value] : result.items()) {
    if (key == "outcome" || key == "start" || key == "period") continue;
    fmt::print("{:12} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

int Show(const Json& result, bool json, Outcome outcome) {
  if (json) {
    std::cout << JsonText(result) << "\n";
  } else {
    PrintForPeople(result);
  }
  return ExitOf(outcome);
}

int SolveByPublishedInSpace(const SolveOptions& o, const ExactProblem& problem) {
  PublishedSpaceAnswer answer =
      SolvePublishedInSpace(problem, o.arithmetic, {ParsePolicy(o.policy), o.tolerances, o.limits});
  answer.result["assumptions"] = FailedAssumptions(problem);
  return Show(answer.result, o.json, answer.outcome);
}

// `polygon`: asked for as a reading of the published algorithm.
int SolveIn3D(const SolveOptions& o, bool polygon, const ExactProblem& problem) {
  SolvedInSpace solved =
      SolveSpace(problem, {o.file, o.method, o.arithmetic, o.law, o.sides, o.limits, o.tolerances});
  if (polygon) solved.result["policy"] = "slip=polygon";
  solved.result["assumptions"] = FailedAssumptions(problem);
  return Show(solved.result, o.json, solved.outcome);
}

int Solve(const SolveOptions& given) {
  SolveOptions o = given;
  const bool in_space = ReadProblem(o.file).problem.dimension == 3;
  const bool polygon = in_space && o.method == "baraff" && ParsePolicy(o.policy) == ParsePolicy("slip=polygon");
  if (polygon) o.method = "complete";  // which that reading is
  if (in_space && o.method == "baraff") {
    return SolveByPublishedInSpace(o, ReadProblem(o.file).problem);
  }
  const bool fast = o.method == "fast";
  if (o.arithmetic.empty()) o.arithmetic = fast ? "double" : "exact";
  if (o.arithmetic == "interval") {
    throw InputError(
        "arithmetic 'interval' is not built but for the published algorithm in space; expected one "
        "of float, double, long-double, exact");
  }
  if (in_space) return SolveIn3D(o, polygon, ReadProblem(o.file).problem);
  const bool any_kind = o.method == "enumerate" || o.method == "ipopt";
  if (any_kind && o.arithmetic != "exact") {
    throw InputError(fmt::format("--method {}: expected --arithmetic exact", o.method));
  }
  if (fast && o.arithmetic == "exact") {
    throw InputError("--method fast: expected --arithmetic float, double or long-double");
  }
  const ProblemFile file = ReadPlanarProblem(o.file);
  const PublishedOptions options{ParsePolicy(o.policy), o.tolerances, o.limits};
  ExactProblem rounded;
  const Solved solved = SolveIn(o.method, o.arithmetic, file.problem, options, rounded);
  Json result = RunToJson(solved.verdict);
  Outcome outcome = solved.verdict.outcome;
  // What rounded numbers suspect is run again exactly, on the problem that they solved, before it is claimed.
  if (o.arithmetic != "exact" && outcome != Outcome::kSolved && !fast) {
    const Json suspected = result;
    const Solved exact = SolveExactly(o.method, rounded, options);
    outcome = exact.verdict.outcome;
    result = RunToJson(exact.verdict);
    result["suspected"] = suspected;
  }
  result["method"] = o.method;
  result["arithmetic"] = o.arithmetic;
  if (o.method == "baraff") result["policy"] = PolicyName(options.policy);
  if (!solved.word.is_null()) result["word"] = solved.word;
  result["f"] = solved.f;
  result["a"] = solved.a;
  if (!solved.ray.is_null()) result["ray"] = solved.ray;
  if (!solved.residual.is_null()) result["residual"] = solved.residual;
  result["assumptions"] = FailedAssumptions(file.problem);
  result["statistics"] = solved.statistics;
  return Show(result, o.json, outcome);
}

// Refuses what the specification names and this build does not have.
}  // namespace

void AddSolve(CommandLine& program) {
  auto [verb, o] = program.Add("solve", "Solve one problem", Solve);
  verb.Positional("FILE", o.file, "stiction-problem file").Required();
  verb.Option("--method", o.method, "what solves it")
      .Choices({{"baraff", "the published algorithm"},
                {"complete", "complete driving, which always ends"},
                {"lemke", "Lemke's method, lexicographic"},
                {"fast",
                 "cells guessed and verified, in space Newton's method, complete driving behind it (inexact "
                 "arithmetics)"},
                {"enumerate", "all contact modes"},
                {"ipopt", "proposed by Ipopt, decided exactly"}});
  verb.Option("--arithmetic", o.arithmetic, "what it computes with")
      .Choices({{"float", ""},
                {"double", "the default of method fast"},
                {"long-double", ""},
                {"exact", "rational; the default"},
                {"interval", "the published algorithm in space only, and its default"}});
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Option("--law", o.law, "friction in space; inexact arithmetics solve coulomb, which implies baraff")
      .Choices({{"baraff", "the paper's conditions (21), (22), which leave the direction of slip free; exact"},
                {"coulomb",
                 "friction opposite to the acceleration; exact arithmetic gives a proved bound on the angle"}});
  verb.Option("--sides", o.sides, "sides of the friction polygons in space, a multiple of 4");
  verb.Flag("--json", o.json, "machine output");
  AddLimits(verb, o.limits);
  AddTolerances(verb, o.tolerances);
}

}  // namespace stiction
