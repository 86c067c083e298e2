// SPDX-License-Identifier: Apache-2.0
// stiction solve: one problem, one method, one arithmetic, one answer.

#include "certify/solve.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/answer_text.h"
#include "cli/stop_after.h"
#include "cli/verbs.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

struct SolveVerb {
  std::string file;
  std::string method{kAutomatic};
  std::string arithmetic;  // empty: the usual one
  std::string policy = "paper";
  std::string law = "baraff";
  SolveOptions options;
  double seconds = 0;
  bool json = false;
};

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

// What is asked for, checked against the table.
SolveRequest RequestOf(const SolveVerb& o, const ExactProblem& problem) {
  const int dimension = problem.dimension;
  SolveRequest request{.method = o.method, .options = o.options};
  request.options.policy = ParsePolicy(o.policy);
  request.options.law = o.law == "coulomb" ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
  if (dimension == 2 && o.law != "baraff")
    throw InputError(o.file, "dimension", "2", "3: --law chooses a law of friction in space");
  const bool polygon = o.method == "baraff" && request.options.policy == ParsePolicy("slip=polygon");
  if (dimension == 3 && polygon) request.method = "complete";  // which that reading is
  request.arithmetic =
      o.arithmetic.empty() ? UsualArithmetic(request.method, problem) : *FindArithmetic(o.arithmetic);
  const std::string refusal = Refusal(request.method, dimension, request.arithmetic);
  if (!refusal.empty()) throw InputError(o.file + ": " + refusal);
  return request;
}

Solution SolveFile(const SolveVerb& o, const ExactProblem& problem, SolveRequest& request) {
  const StopAfter stop(o.seconds);
  request.options.limits.stop = stop.flag();
  try {
    return SolveIn(problem, request);
  } catch (const RangeError& error) {
    throw InputError(o.file + ": " + error.what());
  }
}

int RunSolve(const SolveVerb& o) {
  const ProblemFile file = ReadProblem(o.file);
  SolveRequest request = RequestOf(o, file.problem);
  const Solution solution = SolveFile(o, file.problem, request);
  Json result = SolutionToJson(solution, file.problem.dimension);
  if (o.method == "baraff") result["policy"] = PolicyName(request.options.policy);
  result["assumptions"] = FailedAssumptions(file.problem);
  if (o.json) {
    std::cout << JsonText(result) << "\n";
  } else {
    PrintForPeople(result);
  }
  return ExitOf(solution.outcome());
}

std::string MethodHelp() {
  std::string help = "auto: one that ends, the answer names it";
  for (const MethodFacts& facts : AllMethods()) help += fmt::format("; {}: {}", facts.name, facts.title);
  return help;
}

std::vector<std::string> MethodNames() {
  std::vector<std::string> names = {std::string(kAutomatic)};
  for (const MethodFacts& facts : AllMethods()) names.emplace_back(facts.name);
  return names;
}

}  // namespace

void AddSolve(CLI::App& program, Action& action) {
  auto o = std::make_shared<SolveVerb>();
  CLI::App& verb = *program.add_subcommand("solve", "Solve one problem");
  verb.add_option("FILE", o->file, "stiction-problem file")->required();
  verb.add_option("--method", o->method, MethodHelp())
      ->capture_default_str()
      ->check(CLI::IsMember(MethodNames()));
  verb.add_option("--arithmetic", o->arithmetic,
                  "of the method: see 'stiction methods'; by default exact where it is built, double for "
                  "method fast and for large problems")
      ->check(CLI::IsMember(std::vector<std::string>(kArithmeticNames.begin(), kArithmeticNames.end())));
  AddPolicyOption(verb, o->policy, Grid::kRefused);
  verb.add_option(
          "--law", o->law,
          "friction in space. baraff: the paper's conditions (21), (22), which leave the direction of slip "
          "free; coulomb: friction opposite to the acceleration, over exact arithmetic up to a proved bound. "
          "Inexact answers but those of method baraff obey coulomb, which implies baraff")
      ->capture_default_str()
      ->check(CLI::IsMember({"baraff", "coulomb"}));
  verb.add_option("--sides", o->options.sides, "sides of the friction polygons in space, a multiple of 4")
      ->capture_default_str()
      ->check(CheckSides);
  verb.add_option("--residual", o->options.residual,
                  "largest relative residual of inexact forces that are called solved; 0: 1e-6 over float, "
                  "1e-8 over wider numbers")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  verb.add_option("--seconds", o->seconds, "after so long the best forces so far are told, undecided; 0: never")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e9));
  AddLimits(verb, o->options.limits);
  AddTolerances(verb, o->options.tolerances);
  verb.add_flag("--json", o->json, "machine output");
  verb.callback([o, &action] { action = [o] { return RunSolve(*o); }; });
}

}  // namespace stiction
