// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/reproducer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/solve.h"
#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "corpus/text_template.h"
#include "search/under_test/judge_forces.h"
#include "search/under_test/reproducer.c_in.h"
#include "search/under_test/reproducer.py_in.h"
#include "search/under_test/solver_process.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

// ---- Numbers in a source ---------------------------------------------------------------------

std::string NumberIn(bool python, double x) {
  if (std::isfinite(x)) return fmt::format("{}", x);
  return fmt::format("{}{}", x < 0 ? "-" : "", python ? "math.inf" : "INFINITY");
}

// "1. / 7" is the double next to 1/7 where both parts are doubles.
std::string NumberIn(bool python, const Rational& x) {
  const std::string text = ToString(x);
  if (python) return fmt::format("Fraction('{}')", text);
  const std::size_t slash = text.find('/');
  if (slash == text.npos) return text + ".";
  return text.substr(0, slash) + ". / " + text.substr(slash + 1) + ".";
}

template <class Values>
std::string NumbersIn(bool python, const Values& values) {
  std::string numbers;
  for (const auto& x : values) numbers += (numbers.empty() ? "" : ", ") + NumberIn(python, x);
  return numbers;
}

// A on at most three lines.
std::string MatrixIn(bool python, const ContactProblem<double>& problem) {
  constexpr int kMostLines = 3;
  const int rows = problem.rows(), by_line = (rows + kMostLines - 1) / kMostLines;
  std::string text;
  for (int i = 0; i < rows; ++i) {
    const std::string numbers = NumbersIn(python, problem.A.row(i));
    text += i == 0 ? "" : i % by_line > 0 ? ", " : ",\n    ";
    text += python ? "[" + numbers + "]" : numbers;
  }
  return text;
}

// ---- What a program says ---------------------------------------------------------------------

void Say(Blanks& blanks, std::initializer_list<std::pair<bool, std::string_view>> words) {
  for (const auto& [holds, word] : words)
    if (holds) blanks.words.emplace(word);
}

// The problem as posed, its right forces, and what is measured by them.
Blanks BlanksOf(const ContactProblem<double>& problem, SolverLaw law, bool python) {
  std::optional<ExactProblem::Vector> right = SolutionUnder(law, problem);
  const bool exact = right.has_value();
  if (!exact && law == SolverLaw::kCoulomb) right = NearSolution(problem);
  const ExactProblem::Vector f = right.value_or(ExactProblem::Vector::Zero(problem.rows()));
  LenientUnits<Rational> units;
  units.Take(Unrounded(problem), f);

  std::map<std::string, std::vector<double>> numbers;
  auto &low = numbers["LOW"], &high = numbers["HIGH"], &findex = numbers["FINDEX"], &limits = numbers["LIMIT"];
  if (law == SolverLaw::kFindex) {
    if (const auto all = LimitsOf(problem, law, f))
      for (const Rational& limit : *all) limits.push_back(ToDouble(limit));
  }
  const std::vector<double>& fixed = numbers["BOUNDS"] = FixedBounds(problem);
  const double infinity = std::numeric_limits<double>::infinity();
  const bool is_box = law == SolverLaw::kBox;
  std::string kind_names;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    numbers["MU"].push_back(contact.mu);
    numbers["KINDS"].push_back(static_cast<int>(contact.kind));
    kind_names += fmt::format("{}\"{}\"", i > 0 ? ", " : "", Name(contact.kind));
    const int normal = static_cast<int>(low.size());
    const int size = contact.HasFrictionRows() ? problem.dimension : 1;
    for (int row = normal; row < normal + size; ++row) {
      const bool tangent = row > normal;
      const double bound = is_box ? fixed[i] : contact.mu;
      low.push_back(tangent ? -bound : contact.kind == ContactKind::kBilateral ? -infinity : 0);
      high.push_back(tangent ? bound : infinity);
      findex.push_back(tangent && !is_box ? normal : -1);
      const double own = ToDouble(units.force(row)), of_normal = ToDouble(units.force(normal));
      // What nothing acts on has no unit: any error is large.
      constexpr double kNone = 1e-300;
      numbers["FORCE"].push_back(std::max({own, tangent ? contact.mu * of_normal : 0, kNone}));
      numbers["ACTS"].push_back(std::max(ToDouble(units.acceleration(row)), kNone));
    }
  }

  const bool friction = std::ranges::any_of(findex, [](double row) { return row >= 0; });
  Blanks blanks = {{{"ROWS", std::to_string(problem.rows())},
                    {"CONTACTS", std::to_string(problem.contacts.size())},
                    {"DIMENSION", std::to_string(problem.dimension)},
                    {"KIND_NAMES", kind_names},
                    {"A", MatrixIn(python, problem)},
                    {"B", NumbersIn(python, problem.b)},
                    {"RIGHT", right ? NumbersIn(python, *right) : ""},
                    {"HOW", !right  ? "not known"
                            : exact ? "exact, and verified"
                                    : "with errors below 1e-8"}}};
  for (const auto& [name, values] : numbers) blanks.places[name] = NumbersIn(python, values);
  Say(blanks, {{friction, "friction"},
               {friction && law == SolverLaw::kCoulomb && problem.dimension == 3, "round"},
               {problem.dimension == 2, "plane"},
               {!limits.empty(), "limits"},  // of friction, that are not mu times the normal force
               {right.has_value(), "right"}});
  return blanks;
}

// What is done, of a kind and what its signature says besides.
std::string Deed(const std::string& kind, const std::string& what) {
  static constexpr std::pair<std::string_view, std::string_view> kDeeds[] = {
      {"hang", "gives no answer"},
      {"leak", "keeps memory of every call"},
      {"not-finite", "calls forces solved of which one is not finite"},
      {"refused-solvable", "gives up a problem that has a solution"}};
  static constexpr std::pair<std::string_view, std::string_view> kMisses[] = {
      {"pulls", "a contact pulls"},
      {"moves-inward", "a contact moves inward"},
      {"presses-and-separates", "a contact presses and separates"},
      {"moves", "a bilateral contact moves"},
      {"friction-beyond-limit", "friction is beyond its limit"},
      {"friction-drives-slip", "friction drives the slip"},
      {"slips-below-limit", "a contact slips below its limit of friction"},
      {"friction-askew", "friction is not against the slip"}};
  if (kind == "crash") return fmt::format("ends its process ({})", what);
  for (const auto& [name, words] : kDeeds)
    if (name == kind) return std::string(words);
  for (const auto& [name, words] : kMisses)
    if (name == what) return fmt::format("calls forces solved with which {}", words);
  return "calls wrong forces solved";
}

// What a package has the law of a solver for; c and python have all.
void RequireLawOf(std::string_view name, const Finding& finding, const SolverUnderTest& solver) {
  if (name == "c" || name == "python") return;
  const SolverLaw other = name == "siconos" ? SolverLaw::kCoulomb : SolverLaw::kFindex;
  if (solver.law == SolverLaw::kFrictionless || solver.law == other) return;
  const auto name_of = [](SolverLaw law) { return kSolverLawNames[static_cast<std::size_t>(law)]; };
  throw InputError(
      fmt::format("{}: found law {}, expected frictionless or {}, which {} has; c and python have all",
                  finding.signature, name_of(solver.law), name_of(other), name));
}

}  // namespace

std::string ReproducerOf(const Finding& finding, const SolverUnderTest& solver, std::string_view name,
                         const std::string& file) {
  if (solver.name.empty() || !IsOfSolver(finding.kind))
    throw InputError(
        fmt::format("{}: found no failure of a solver under test, expected a finding of search --solver",
                    finding.signature));
  RequireLawOf(name, finding, solver);
  const JsonPlace facts(finding.facts, finding.signature);
  const auto library = facts.Optional("library"), small = facts.Optional("minimized");
  const bool is_library = !library || library->Truth();
  if (name == "c" && !is_library)
    throw InputError(finding.signature + ": found a finding of a program, expected python for its reproducer");
  const std::string& shown = finding.minimized.empty() ? finding.problem : finding.minimized;
  Blanks blanks =
      BlanksOf(Rounded<double>(ParseProblem(shown, finding.signature).problem), solver.law, name == "python");
  const std::string& kind = finding.kind;
  const auto is_of = [&solver](const char* method) { return solver.name.find(method) != solver.name.npos; };
  Say(blanks, {{true, name},
               {true, kind},
               {true, kSolverLawNames[static_cast<std::size_t>(solver.law)]},
               {is_library, "library"},
               {kind == "crash" || kind == "hang", "ends"},
               {name == "c" || (name == "siconos" && solver.law == SolverLaw::kCoulomb), "contacts"},
               {is_of("lemke"), "lemke"},
               {is_of("nsn-ac"), "newton"}});
  const JsonPlace seen = small ? *small : facts.Required("found", "what was found");
  const std::size_t dot = file.find_last_of('.');
  blanks.places["SAYS"] = fmt::format("{}: {} {} {}.", finding.signature, solver.name, solver.version,
                                      Deed(kind, seen.Required("what", "a text").Text("a text")));
  blanks.places["ACCURACY"] = solver.accuracy;
  blanks.places["FILE"] = file;
  blanks.places["NAME"] = dot == 0 || dot == file.npos ? file + "-program" : file.substr(0, dot);
  return name == "python" ? Filled(kReproducerPy, blanks) : Filled(kReproducerC, blanks);
}

}  // namespace stiction
