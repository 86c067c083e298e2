// SPDX-License-Identifier: Apache-2.0
// stiction solve: one problem, one method, one arithmetic, one answer.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "certify/exact/answer_json.h"
#include "certify/request/facts.h"
#include "certify/request/request.h"
#include "cli/command_line.h"
#include "cli/narration/followed.h"
#include "cli/narration/narrate_text.h"
#include "cli/program.h"
#include "cli/shared.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/rounded.h"
#include "corpus/stop.h"

namespace stiction {
namespace {

struct SolveVerb : Wanted {
  std::vector<std::string> files;
  std::string file;  // of them the one that is solved
  double seconds = 0;
  bool fractions = false;  // for people, in full
  bool json = false;
};

// Sets the flag, which must outlive it, when the time is up; zero: never.
std::jthread StopAfter(double seconds, std::atomic<bool>& stopped) {
  if (seconds <= 0) return {};
  return std::jthread([seconds, &stopped](const std::stop_token& end) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    const bool ended = std::condition_variable_any().wait_for(lock, end, std::chrono::duration<double>(seconds),
                                                              [&end] { return end.stop_requested(); });
    if (!ended) stopped = true;
  });
}

int ExitOf(Outcome outcome) {
  if (outcome == Outcome::kSolved) return kExitDone;
  return outcome == Outcome::kLimit || outcome == Outcome::kUndecided ? kExitUndecided : kExitNotSo;
}

// ---- Text for people ---------------------------------------------------------------------------

// The law that the forces of an answer obey, in words.
std::string LawOf(const Json& result) {
  if (!result.contains("law")) return "(15) and (16)";
  return result["law"] == "coulomb" ? "Coulomb's law" : "(21) and (22), which leave the direction of slip free";
}

// An exact solution of Coulomb's law, whose directions of slip are rational: 1 - bound.
std::string WithinText(const Json& result) {
  const Rational gap = 1 - *ParseRational(result["bound"].get<std::string>());
  if (gap == 0) return "solved: these forces meet Coulomb's law and every other condition, exactly";
  return fmt::format(
      "solved, Coulomb's law within {:.0e}: where a contact slips, -fF.aF is at least `bound` times mu fN "
      "|aF|; "
      "every other condition is met without error",
      ToDouble(gap));
}

std::string SolvedSentence(const Json& result, const Solution& solution) {
  if (result["f"].empty()) return "solved: there are no contacts, and no forces are asked for";
  const std::string law = LawOf(result);
  if (result.contains("bound")) return WithinText(result);
  if (std::holds_alternative<ExactAnswer>(solution.answer))
    return fmt::format("solved: these forces meet every condition, {}, exactly", law);
  if (!std::get<InexactAnswer>(solution.answer).f_enclosed.empty())
    return fmt::format("solved: forces within these bounds meet every condition, {}, proved", law);
  const Errors<double>& errors = *std::get<InexactAnswer>(solution.answer).errors;
  return fmt::format(
      "solved: these forces meet every condition, {}, but for errors of at most {:.2g} in accelerations and "
      "{:.2g} in forces: they are exact where b and mu differ by so much, and A by eight roundings",
      law, errors.acceleration, errors.force);
}

// The most important: how it ended, and what that means.
std::string OutcomeSentence(const Json& result, const Solution& solution) {
  const std::string outcome = result["outcome"];
  const bool proved = std::holds_alternative<ExactAnswer>(solution.answer) ||
                      !std::get<InexactAnswer>(solution.answer).f_enclosed.empty();
  const std::string reason = result.contains("reason") ? ": " + result["reason"].get<std::string>() : "";
  if (outcome == "solved") return SolvedSentence(result, solution);
  if (outcome == "no-solution") return "no-solution: no forces meet all conditions, proved" + reason;
  if (result.contains("period")) {
    const auto describe = [proved](const auto& answer) { return EndText(answer, proved); };
    return std::visit(describe, solution.answer);
  }
  if (outcome == "ray") return "ray: a step has no end, the forces could grow for ever along `ray`" + reason;
  if (outcome == "singular")
    return "singular: no direction keeps what the method keeps, it cannot go on" + reason;
  return outcome + reason;
}

// "1/3", "0.5", "[0.49, 0.51]".
std::string NumberText(const Json& x, FractionText fractions) {
  if (x.is_array()) return fmt::format("[{}, {}]", NumberText(x[0], fractions), NumberText(x[1], fractions));
  if (!x.is_string()) return JsonText(x);
  const auto exact = ParseRational(x.get<std::string>());
  return exact ? Text(*exact, fractions) : x.get<std::string>();
}

// Force and acceleration of every variable, and the impulsive direction where there is one.
std::string VariablesTable(const AnyProblem& problem, const Json& result, FractionText fractions) {
  std::vector<std::string> columns;
  for (const char* name : {"f", "a", "ray"}) {
    if (result.contains(name) && result[name].is_array() && !result[name].empty()) columns.emplace_back(name);
  }
  if (columns.empty()) return "";
  const VariableTexts names(problem.contacts(), problem.dimension());
  std::vector<std::string> head = {""};
  head.insert(head.end(), columns.begin(), columns.end());
  TextTable table(std::move(head), 1);
  for (int i = 0; i < problem.rows(); ++i) {
    std::vector<std::string> row = {names.Component(i)};
    for (const std::string& column : columns) row.push_back(NumberText(result[column][i], fractions));
    table.AddRow(std::move(row));
  }
  return table.Done();
}

std::string WithBlanks(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// "pieces 5, folds 1".
std::string FieldsText(const Json& object) {
  std::string text;
  for (const auto& [key, value] : object.items())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", WithBlanks(key),
                        value.is_string() ? value.get<std::string>() : JsonText(value));
  return text;
}

// Names of the assumptions that fail; their witnesses are what `certify` writes.
std::string AssumptionsText(const Json& assumptions, const std::string& file, int rows) {
  std::vector<std::string> names;
  for (const Json& failed : assumptions) names.push_back(failed["assumption"]);
  if (names.empty()) return "none of the paper's was found to fail (A symmetric, semidefinite, b in its range)";
  if (rows > kMostDenseRows)
    return fmt::format("of the paper's these fail, or are undecided: {}; the bounds: stiction survey {}",
                       fmt::join(names, ", "), file);
  return fmt::format("of the paper's these fail: {}; the proof: stiction certify {} --claim {} -o -",
                     fmt::join(names, ", "), file, names[0]);
}

void PrintForPeople(const SolveVerb& o, const AnyProblem& problem, const Solution& solution,
                    const Json& result) {
  const FractionText fractions = o.fractions ? FractionText::kFull : FractionText::kShort;
  Tell("{}\n", OutcomeSentence(result, solution));
  std::cout << VariablesTable(problem, result, fractions);
  if (result.contains("unique_accelerations"))
    Tell("another solution with other accelerations is known; this one moves less, or rests\n");
  for (const auto& [key, value] : result.items()) {
    const bool told = key == "outcome" || key == "start" || key == "period" || key == "f" || key == "a" ||
                      key == "ray" || key == "reason" || key == "unique_accelerations";
    if (told) continue;
    const std::string text = key == "assumptions" ? AssumptionsText(value, o.file, problem.rows())
                             : value.is_object()  ? FieldsText(value)
                             : value.is_string()  ? value.get<std::string>()
                                                  : JsonText(value);
    Tell("{:18}  {}\n", WithBlanks(key), AsTyped(text));
  }
}

using Answered = std::pair<Json, int>;  // what was asked of one file, and the exit code

Answered SolveRead(const SolveVerb& o, const std::atomic<bool>& stopped) {
  const AnyProblem problem = InFactors(ReadProblem(o.file, kAnyRows));
  Request request = RequestOf(o, problem, o.file);
  request.limits.stop = &stopped;
  const Solution solution = SolveAsked(problem, request, o.file);
  Json result = SolutionToJson(solution, problem.dimension());
  if (o.arithmetic.empty()) result["why"] = UsualArithmetic(request.method, problem).why;
  if (o.method == "baraff") result["policy"] = PolicyName(request.policy);
  result["assumptions"] = FailedAssumptions(problem);
  if (!o.json) PrintForPeople(o, problem, solution, result);
  return {result, ExitOf(solution.outcome())};
}

// Within --seconds, reading included.
Answered SolveOne(const SolveVerb& o) {
  std::atomic<bool> stopped = false;
  const std::jthread timer = StopAfter(o.seconds, stopped);
  const Stop stop(&stopped);
  try {
    return SolveRead(o, stopped);
  } catch (const Stopped&) {
    InexactAnswer none;
    none.method = o.method;
    none.reason = "stopped while the file was read";
    const Solution solution{none};
    Json result = SolutionToJson(solution, 2);
    result["assumptions"] = Json::array();
    if (!o.json) PrintForPeople(o, {}, solution, result);
    return {result, kExitUndecided};
  }
}

// Each answer of many files has the name of its file, and one that is refused, or that ends in an error of
// ours, does not keep the others from being solved. Exit: 70 if there was such an error, else 2 if one was
// refused, else 1 if one is not solved, else 3 if one is undecided.
int SolveMany(SolveVerb o) {
  constexpr std::array kWorst = {kExitInternal, kExitBadInput, kExitNotSo, kExitUndecided, kExitDone};
  const auto severity = [&](int exit) { return std::find(kWorst.begin(), kWorst.end(), exit); };
  Json results = Json::array();
  int exit = kExitDone;
  const auto end_with = [&](int ended) {
    if (severity(ended) < severity(exit)) exit = ended;
  };
  const auto fail = [&](const std::string& file, const std::string& error, int ended) {
    std::cerr << "stiction: " << error << "\n";
    results.push_back({{"file", file}, {"error", error}});
    end_with(ended);
  };
  for (const std::string& file : o.files) {
    o.file = file;
    if (!o.json) Tell("{}{}:\n", results.empty() ? "" : "\n", file);
    try {
      auto [answer, ended] = SolveOne(o);
      results.push_back({{"file", file}, {"answer", std::move(answer)}});
      end_with(ended);
    } catch (const InputError& error) {
      fail(file, error.what(), kExitBadInput);
    } catch (const std::bad_alloc&) {
      fail(file, file + ": limit: out of memory", kExitUndecided);
    } catch (const std::exception& error) {
      fail(file, fmt::format("{}: internal error: {}", file, error.what()), kExitInternal);
    }
  }
  if (o.json) std::cout << JsonText(results) << "\n";
  return exit;
}

int RunSolve(const SolveVerb& asked) {
  SolveVerb o = asked;
  if (o.files.size() > 1) return SolveMany(std::move(o));
  o.file = o.files.front();
  const auto [answer, exit] = SolveOne(o);
  if (o.json) std::cout << JsonText(answer) << "\n";
  return exit;
}

std::vector<AllowedValue> MethodChoices() {
  std::vector<AllowedValue> choices = {{std::string(kAutomatic), "one that ends; the answer names it"}};
  for (const MethodFacts& facts : AllMethods())
    choices.push_back({std::string(facts.name), std::string(facts.title)});
  return choices;
}

}  // namespace

const ListedVerb kSolveVerb("Solve", 10, [](CommandLine& program) {
  auto [verb, o] = program.Add("solve", "Solve problems", RunSolve);
  verb.footer =
      "Outcomes: solved (exit 0); no-solution, cycle, ray, singular (exit 1); limit, undecided (exit 3). "
      "no-solution is proved, and `certify` writes the proof; the others say how the method ended.";
  verb.Positional("FILE", o.files, kFileHelp).Required().Details(kFileDetails);
  verb.Option("-m,--method", o.method, "what solves it").Choices(MethodChoices());
  verb.Option("-a,--arithmetic", o.arithmetic, "what it computes with")
      .OneOf({kArithmeticNames.begin(), kArithmeticNames.end()})
      .Details(
          "By default exact where the method is built so, double for method fast and for large problems. "
          "'stiction methods' has the table of what is built.");
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Option("--law", o.law, "friction in space; by default coulomb, of method baraff its own")
      .Choices({{"baraff", "the paper's conditions (21), (22), which leave the direction of slip free; exact"},
                {"coulomb",
                 "friction opposite to the acceleration; exact arithmetic gives a proved bound on the angle"}});
  verb.Option("--sides", o.request.sides, "sides of the friction polygons in space, a multiple of 4")
      .Check(CheckSides);
  verb.Option("--residual", o.request.residual,
              "by how much b and mu may differ where inexact forces are called solved")
      .Range(0, 1)
      .Details(
          "Relative, entry by entry, and A by eight roundings: the forces are exact for such b, mu and A. 0, "
          "the "
          "default: 1e-5 over float, 1e-8 over wider numbers.");
  verb.Option("--seconds", o.seconds, "after so long the best forces so far are told, undecided; 0: never")
      .Range(0, 1e9);
  verb.Flag("--fractions", o.fractions,
            "long fractions in full, which are rounded otherwise, in text for people");
  verb.Prints(o.json, "forces of one problem, or why there are none; of many files a row for each",
              "answer | [{file: text, answer: answer} | {file: text, error: text}]");
  AddLimits(verb, o.request.limits);
  AddTolerances(verb, o.request.tolerances);
});

}  // namespace stiction
