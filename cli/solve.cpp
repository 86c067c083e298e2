// SPDX-License-Identifier: Apache-2.0
// stiction solve: one problem, one method, one arithmetic, one answer.

#include "certify/solve.h"

#include <fmt/format.h>

#include <iostream>

#include "cli/answer_text.h"
#include "cli/shared.h"
#include "cli/stop_after.h"
#include "cli/verbs.h"
#include "corpus/json_text.h"
#include "corpus/rounded.h"

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
  if (o.method != "baraff" && request.options.policy != Policy{})
    throw InputError(fmt::format("--policy {}: expected --method baraff, of which it is a reading", o.policy));
  const bool polygon = o.method == "baraff" && request.options.policy == ParsePolicy("slip=polygon");
  if (dimension == 3 && polygon) request.method = "complete";  // which that reading is
  request.arithmetic = o.arithmetic.empty() ? UsualArithmetic(request.method, problem).arithmetic
                                            : *FindArithmetic(o.arithmetic);
  const std::string refusal = Refusal(request.method, dimension, request.arithmetic);
  if (!refusal.empty()) throw InputError(o.file + ": " + refusal);
  return request;
}

Solution SolveFile(const SolveVerb& o, const ExactProblem& problem, SolveRequest& request) {
  const StopAfter stop(o.seconds);
  request.options.limits.stop = stop.flag();
  try {
    return SolveIn(problem, request);
  } catch (const InputError& error) {
    throw InputError(o.file + ": " + error.what());
  }
}

// A backward error in words: of the scene, where the problem has one.
std::string Meaning(const BackwardError& error, const ProblemFile& file) {
  const bool has_scene =
      file.scene || (file.origin && file.origin->is_object() && file.origin->contains("scene"));
  if (!has_scene)
    return fmt::format(
        "the forces are exact for a problem nearby: every entry of A and b moved by at most {:.2g} of itself, "
        "every "
        "mu by at most {:.2g}",
        error.of_data, error.of_mu);
  double most = 0;
  for (const Rational& b : file.problem.b.reshaped()) most = std::max(most, std::abs(ToDouble(b)));
  return fmt::format(
      "the forces are exact for a scene nearby: the same masses and positions, loads that accelerate no "
      "contact by "
      "more than {:.2g} m/s^2 besides, and coefficients of friction moved by at most {:.2g} of themselves",
      error.of_b * most, error.of_mu);
}

int RunSolve(const SolveVerb& o) {
  const ProblemFile file = ReadProblem(o.file);
  SolveRequest request = RequestOf(o, file.problem);
  const Solution solution = SolveFile(o, file.problem, request);
  Json result = SolutionToJson(solution, file.problem.dimension);
  const auto* inexact = std::get_if<InexactAnswer>(&solution.answer);
  if (inexact != nullptr && inexact->backward)
    result["backward_error"]["meaning"] = Meaning(*inexact->backward, file);
  if (o.arithmetic.empty()) result["why"] = UsualArithmetic(request.method, file.problem).why;
  if (o.method == "baraff") result["policy"] = PolicyName(request.options.policy);
  result["assumptions"] = FailedAssumptions(file.problem);
  if (o.json) {
    std::cout << JsonText(result) << "\n";
  } else {
    PrintForPeople(result);
  }
  return ExitOf(solution.outcome());
}

std::vector<AllowedValue> MethodChoices() {
  std::vector<AllowedValue> choices = {{std::string(kAutomatic), "one that ends; the answer names it"}};
  for (const MethodFacts& facts : AllMethods())
    choices.push_back({std::string(facts.name), std::string(facts.title)});
  return choices;
}

}  // namespace

void AddSolve(CommandLine& program) {
  auto [verb, o] = program.Add("solve", "Solve one problem", RunSolve);
  verb.footer =
      "Outcomes: solved (exit 0); no-solution, cycle, ray, singular (exit 1); limit, undecided (exit 3). "
      "no-solution is proved, and `certify` writes the proof; the others say how the method ended.";
  verb.Positional("FILE", o.file, "stiction-problem file").Required();
  verb.Option("--method", o.method, "what solves it").Choices(MethodChoices());
  verb.Option("--arithmetic", o.arithmetic, "what it computes with")
      .OneOf({kArithmeticNames.begin(), kArithmeticNames.end()})
      .Details(
          "By default exact where the method is built so, double for method fast and for large problems. "
          "'stiction methods' has the table of what is built.");
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Option("--law", o.law, "friction in space; inexact answers but those of baraff obey coulomb")
      .Choices({{"baraff", "the paper's conditions (21), (22), which leave the direction of slip free; exact"},
                {"coulomb",
                 "friction opposite to the acceleration; exact arithmetic gives a proved bound on the angle"}});
  verb.Option("--sides", o.options.sides, "sides of the friction polygons in space, a multiple of 4")
      .Check(CheckSides);
  verb.Option("--residual", o.options.residual, "largest relative residual of inexact forces called solved")
      .Range(0, 1)
      .Details("0, the default: 1e-6 over float, 1e-8 over wider numbers.");
  verb.Option("--seconds", o.seconds, "after so long the best forces so far are told, undecided; 0: never")
      .Range(0, 1e9);
  verb.Flag("--json", o.json, "machine output");
  AddLimits(verb, o.options.limits);
  AddTolerances(verb, o.options.tolerances);
}

}  // namespace stiction
