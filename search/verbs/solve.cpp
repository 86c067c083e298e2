// SPDX-License-Identifier: Apache-2.0
// stiction solve: one problem, one method, one arithmetic.

#include <fmt/format.h>

#include <iostream>

#include "certify/certificate.h"
#include "certify/verify_solution.h"
#include "corpus/json_text.h"
#include "search/verbs/verbs.h"
#include "solver/residual.h"

namespace stiction {
namespace {

struct SolveOptions {
  std::string file;
  std::string method = "baraff";
  std::string arithmetic = "exact";
  std::string policy = "paper";
  Limits limits;
  Tolerances tolerances;
  bool json = false;
};

// What came out, in the terms of JSON; `exact` says whether it is a claim or only what rounded numbers showed.
struct Solved {
  Verdict verdict;
  Json f, a, ray;
  Json residual;
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

Solved SolveExactly(const ExactProblem& problem, const PublishedOptions& options) {
  const ExactRun run = RunExact(problem, options);
  Solved solved{run.verdict, VectorToJson(run.state.f), VectorToJson(run.a), nullptr, nullptr};
  if (run.ray.size() > 0) solved.ray = VectorToJson(run.ray);
  return solved;
}

// The problem in rounded numbers; `rounded` receives the same problem exactly.
template <class Scalar>
ContactProblem<Scalar> Round(const ExactProblem& problem, ExactProblem& rounded) {
  const auto round = [](Rational& x) {
    const Scalar value = static_cast<Scalar>(ToDouble(x));
    x = Rational(static_cast<double>(value));
    return value;
  };
  rounded = problem;
  ContactProblem<Scalar> result;
  result.dimension = problem.dimension;
  for (Contact<Rational>& contact : rounded.contacts)
    result.contacts.push_back({contact.kind, round(contact.mu), {}});
  result.A.resize(problem.rows(), problem.rows());
  result.b.resize(problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    result.b[i] = round(rounded.b[i]);
    for (int j = 0; j < problem.rows(); ++j) result.A(i, j) = round(rounded.A(i, j));
  }
  return result;
}

template <class Vector>
Json NumbersToJson(const Vector& values) {
  Json json = Json::array();
  for (const auto& value : values) {
    const double number = static_cast<double>(value);
    json.push_back(std::isfinite(number) ? Json(number) : Json(fmt::format("{}", number)));
  }
  return json;
}

template <class Scalar>
Solved SolveRounded(const ExactProblem& problem, const PublishedOptions& options, ExactProblem& rounded) {
  const ContactProblem<Scalar> inexact = Round<Scalar>(problem, rounded);
  PublishedAlgorithm<Scalar> algorithm(options);
  Solved solved;
  solved.verdict = algorithm.Run(inexact);
  const auto& f = algorithm.state().f;
  solved.f = NumbersToJson(f);
  solved.a = NumbersToJson(algorithm.state().a);
  if (solved.verdict.outcome == Outcome::kSolved) {
    const typename ContactProblem<Scalar>::Vector a = inexact.A * f + inexact.b;
    solved.residual = static_cast<double>(NaturalResidual(inexact, f, a));
  }
  return solved;
}

Solved SolveIn(const std::string& arithmetic, const ExactProblem& problem, const PublishedOptions& options,
               ExactProblem& rounded) {
  if (arithmetic == "float") return SolveRounded<float>(problem, options, rounded);
  if (arithmetic == "double") return SolveRounded<double>(problem, options, rounded);
  if (arithmetic == "long-double") return SolveRounded<long double>(problem, options, rounded);
  return SolveExactly(problem, options);
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

int Solve(const SolveOptions& o) {
  const ProblemFile file = ReadHandledProblem(o.file);
  const PublishedOptions options{ParsePolicy(o.policy), o.tolerances, o.limits};
  ExactProblem rounded;
  const Solved solved = SolveIn(o.arithmetic, file.problem, options, rounded);
  Json result = RunToJson(solved.verdict);
  Outcome outcome = solved.verdict.outcome;
  // What rounded numbers suspect is run again exactly, on the problem that they solved, before it is claimed.
  if (o.arithmetic != "exact" && outcome != Outcome::kSolved) {
    const Json suspected = result;
    const Solved exact = SolveExactly(rounded, options);
    outcome = exact.verdict.outcome;
    result = RunToJson(exact.verdict);
    result["suspected"] = suspected;
  }
  result["method"] = o.method;
  result["arithmetic"] = o.arithmetic;
  result["policy"] = PolicyName(options.policy);
  result["f"] = solved.f;
  result["a"] = solved.a;
  if (!solved.ray.is_null()) result["ray"] = solved.ray;
  if (!solved.residual.is_null()) result["residual"] = solved.residual;
  result["assumptions"] = FailedAssumptions(file.problem);
  result["statistics"] = StatisticsToJson(solved.verdict.statistics);
  if (o.json) {
    std::cout << JsonText(result) << "\n";
  } else {
    PrintForPeople(result);
  }
  return ExitOf(outcome);
}

// Refuses what the specification names and this build does not have.
std::string OnlyBuilt(const std::string& text, const std::vector<std::string>& built, const char* what) {
  if (std::find(built.begin(), built.end(), text) != built.end()) return "";
  return fmt::format("{} '{}' is not built; expected one of {}", what, text, fmt::join(built, ", "));
}

}  // namespace

void AddSolve(CLI::App& program, Action& action) {
  auto o = std::make_shared<SolveOptions>();
  CLI::App& verb = *program.add_subcommand("solve", "Solve one problem");
  verb.add_option("FILE", o->file, "stiction-problem file")->required();
  verb.add_option("--method", o->method, "baraff: the published algorithm")
      ->capture_default_str()
      ->check([](const std::string& text) { return OnlyBuilt(text, {"baraff"}, "method"); });
  verb.add_option("--arithmetic", o->arithmetic, "float, double, long-double or exact (rational)")
      ->capture_default_str()
      ->check([](const std::string& text) {
        return OnlyBuilt(text, {"float", "double", "long-double", "exact"}, "arithmetic");
      });
  AddPolicyOption(verb, o->policy, Grid::kRefused);
  AddLimits(verb, o->limits);
  AddTolerances(verb, o->tolerances);
  verb.add_flag("--json", o->json, "machine output");
  verb.callback([o, &action] { action = [o] { return Solve(*o); }; });
}

}  // namespace stiction
