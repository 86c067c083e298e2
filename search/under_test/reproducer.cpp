// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/reproducer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/under_test/judge_forces.h"
#include "search/under_test/reproducer_texts.h"
#include "search/under_test/solver_process.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

using Forces = ExactProblem::Vector;

// ---- Right forces ----------------------------------------------------------------------------

struct RightForces {
  std::optional<Forces> f;
  const char* how = "exact, and verified";
};

RightForces RightUnder(SolverLaw law, const ContactProblem<double>& posed) {
  if (auto f = SolutionUnder(law, posed)) return {f};
  if (law != SolverLaw::kCoulomb) return {};
  return {NearSolution(posed), "with errors below 1e-8"};
}

// ---- What a program says ---------------------------------------------------------------------

// Of a problem as posed.
struct ProblemShown {
  ContactProblem<double> problem;
  SolverLaw law;
  std::vector<double> low, high, limits;  // by row; `limits` where they are not mu times the normal force
  std::vector<int> findex;
  RightForces right;
  std::vector<double> force_units, acceleration_units;

  int rows() const { return problem.rows(); }
  bool HasFriction() const {
    return std::ranges::any_of(findex, [](int row) { return row >= 0; });
  }
};

ProblemShown ShownOf(const Finding& finding, SolverLaw law) {
  const std::string& text = finding.minimized.empty() ? finding.problem : finding.minimized;
  ProblemShown posed;
  posed.law = law;
  posed.problem = Rounded<double>(ParseProblem(text, finding.signature).problem);
  posed.right = RightUnder(law, posed.problem);
  const Forces f = posed.right.f.value_or(Forces::Zero(posed.rows()));
  const ExactProblem exact = ExactOf(posed.problem);
  LenientUnits<Rational> units;
  units.Take(exact, f);
  if (law == SolverLaw::kFindex) {
    if (const auto limits = LimitsOf(posed.problem, law, f))
      for (const Rational& limit : *limits) posed.limits.push_back(ToDouble(limit));
  }
  const std::vector<double> fixed = FixedBounds(posed.problem);
  const double infinity = std::numeric_limits<double>::infinity();
  const bool is_box = law == SolverLaw::kBox;
  for (std::size_t i = 0; i < posed.problem.contacts.size(); ++i) {
    const auto& contact = posed.problem.contacts[i];
    const int normal = static_cast<int>(posed.low.size());
    const int size = contact.HasFrictionRows() ? posed.problem.dimension : 1;
    for (int row = normal; row < normal + size; ++row) {
      const bool tangent = row > normal;
      const double bound = is_box ? fixed[i] : contact.mu;
      posed.low.push_back(tangent ? -bound : contact.kind == ContactKind::kBilateral ? -infinity : 0);
      posed.high.push_back(tangent ? bound : infinity);
      posed.findex.push_back(tangent && !is_box ? normal : -1);
      const double own = ToDouble(units.force(row)), of_normal = ToDouble(units.force(normal));
      // What nothing acts on has no unit: any error is large.
      constexpr double kNone = 1e-300;
      posed.force_units.push_back(std::max({own, tangent ? contact.mu * of_normal : 0, kNone}));
      posed.acceleration_units.push_back(std::max(ToDouble(units.acceleration(row)), kNone));
    }
  }
  return posed;
}

// What is done, of a kind and what its signature says besides.
std::string Deed(const std::string& kind, const std::string& what) {
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
  if (kind == "hang") return "gives no answer";
  if (kind == "leak") return "keeps memory of every call";
  if (kind == "not-finite") return "calls forces solved of which one is not finite";
  if (kind == "refused-solvable") return "gives up a problem that has a solution";
  for (const auto& [name, words] : kMisses)
    if (name == what) return fmt::format("calls forces solved with which {}", words);
  return "calls wrong forces solved";
}

// ---- Numbers in a source ---------------------------------------------------------------------

enum class Language { kC, kPython };

std::string NumberIn(Language language, double x) {
  if (std::isfinite(x)) return fmt::format("{}", x);
  return fmt::format("{}{}", x < 0 ? "-" : "", language == Language::kC ? "INFINITY" : "math.inf");
}

// "1. / 7" is the double next to 1/7 where both parts are doubles.
std::string NumberIn(Language language, const Rational& x) {
  const std::string text = ToString(x);
  if (language == Language::kPython) return fmt::format("Fraction('{}')", text);
  const std::size_t slash = text.find('/');
  if (slash == text.npos) return text + ".";
  return text.substr(0, slash) + ". / " + text.substr(slash + 1) + ".";
}
std::string NumberIn(Language, int x) { return std::to_string(x); }

template <class Values>
std::vector<std::string> NumbersIn(Language language, const Values& values) {
  std::vector<std::string> numbers;
  for (const auto& x : values) numbers.push_back(NumberIn(language, x));
  return numbers;
}

// A on at most three lines.
std::string MatrixIn(Language language, const ProblemShown& posed) {
  constexpr int kMostLines = 3;
  const int rows = posed.rows(), by_line = (rows + kMostLines - 1) / kMostLines;
  std::string text;
  for (int i = 0; i < rows; ++i) {
    const std::vector<double> row(posed.problem.A.row(i).begin(), posed.problem.A.row(i).end());
    const std::string numbers = fmt::format("{}", fmt::join(NumbersIn(language, row), ", "));
    const char* const before = i % by_line > 0            ? " "
                               : i > 0                    ? "\n    "
                               : language == Language::kC ? "\n    "
                                                          : "";
    text += before + (language == Language::kC ? numbers : "[" + numbers + "]") + (i + 1 < rows ? "," : "");
  }
  return text;
}

template <class Values>
std::string NamedInC(const char* name, const Values& values) {
  return fmt::format("{}[] = {{{}}}", name, fmt::join(NumbersIn(Language::kC, values), ", "));
}
template <class Values>
std::string ArrayInC(const char* type, const char* name, const Values& values) {
  return fmt::format("static const {} {};\n", type, NamedInC(name, values));
}
template <class Values>
std::string TwoArraysInC(const char* name, const Values& values, const char* other, const Values& others) {
  return fmt::format("static const double {}, {};", NamedInC(name, values), NamedInC(other, others));
}
template <class Values>
std::string ListInPython(const char* name, const Values& values) {
  return fmt::format("{} = [{}]\n", name, fmt::join(NumbersIn(Language::kPython, values), ", "));
}

std::vector<double> CoefficientsOf(const ProblemShown& posed) {
  std::vector<double> mu;
  for (const auto& contact : posed.problem.contacts) mu.push_back(contact.mu);
  return mu;
}

// ---- Programs --------------------------------------------------------------------------------

bool IsJudged(const std::string& kind) { return kind == "silent-wrong"; }
bool Ends(const std::string& kind) { return kind == "crash" || kind == "hang"; }
bool IsRound(const ProblemShown& posed) {
  return posed.law == SolverLaw::kCoulomb && posed.problem.dimension == 3 && posed.HasFriction();
}

std::string DataInC(const ProblemShown& posed, const Finding& finding, bool takes_contacts) {
  std::string text = fmt::format("enum {{ ROWS = {}, CONTACTS = {}, DIMENSION = {} }};\n", posed.rows(),
                                 posed.problem.contacts.size(), posed.problem.dimension);
  text += fmt::format("static const double A[] = {{{}}};\n", MatrixIn(Language::kC, posed));
  text += ArrayInC("double", "b", posed.problem.b);
  std::string doubles = TwoArraysInC("low", posed.low, "high", posed.high);
  if (takes_contacts) {
    std::vector<int> kinds;
    for (const auto& contact : posed.problem.contacts) kinds.push_back(static_cast<int>(contact.kind));
    doubles.back() = ',';
    doubles += " " + NamedInC("mu", CoefficientsOf(posed)) + ";";
    text +=
        fmt::format("static const int {}, {};\n", NamedInC("kinds", kinds), NamedInC("findex", posed.findex));
  } else if (posed.HasFriction()) {
    text += ArrayInC("int", "findex", posed.findex);
  }
  text += doubles + "\n";
  text += posed.right.f
              ? fmt::format("/* {} */ ", posed.right.how) + ArrayInC("double", "right", *posed.right.f)
              : "";
  if (!IsJudged(finding.kind)) return text;
  if (!posed.limits.empty()) text += ArrayInC("double", "limit", posed.limits);
  return text + TwoArraysInC("force", posed.force_units, "acts", posed.acceleration_units) +
         " /* that act at each row: a force, an acceleration */\n";
}

std::string DataInPython(const ProblemShown& posed, const Finding& finding, bool is_library) {
  std::string kinds;
  for (const auto& contact : posed.problem.contacts)
    kinds += fmt::format("{}\"{}\"", kinds.empty() ? "" : ", ", Name(contact.kind));
  std::string text = fmt::format("DIMENSION, MU, KINDS = {}, [{}], [{}]\n", posed.problem.dimension,
                                 fmt::join(NumbersIn(Language::kPython, CoefficientsOf(posed)), ", "), kinds);
  text += fmt::format("A = [{}]\n", MatrixIn(Language::kPython, posed)) + ListInPython("B", posed.problem.b);
  text +=
      ListInPython("LOW", posed.low) + ListInPython("HIGH", posed.high) + ListInPython("FINDEX", posed.findex);
  text += posed.right.f
              ? fmt::format("RIGHT = [{}]  # {}\n",
                            fmt::join(NumbersIn(Language::kPython, *posed.right.f), ", "), posed.right.how)
              : "RIGHT = []  # not known\n";
  if (!is_library && posed.law == SolverLaw::kBox) text += ListInPython("BOUNDS", FixedBounds(posed.problem));
  if (!IsJudged(finding.kind)) return text;
  if (!posed.limits.empty()) text += ListInPython("LIMIT", posed.limits);
  return text + "# What acts at each row: a force, an acceleration.\n" +
         ListInPython("FORCE", posed.force_units) + ListInPython("ACTS", posed.acceleration_units);
}

// Each word in braces by its text.
std::string With(std::string text, std::initializer_list<std::pair<std::string_view, std::string>> words) {
  for (const auto& [word, by] : words)
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + by.size()))
      text.replace(at, word.size(), by);
  return text;
}

struct Package {
  std::string command;  // "g++ @FILE@ -lode -o @NAME@"
  const char* includes;
  std::string solve;
  bool takes_contacts = false;
};

Package PackageOfSiconos(const SolverUnderTest& solver, const ProblemShown& posed) {
  const std::string command =
      "g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse @FILE@ \\\n"
      " *         -lsiconos_numerics -o @NAME@ && ./@NAME@";
  if (solver.law == SolverLaw::kFrictionless) return {command, kIncludesOfSiconosLemke, kSolveWithSiconosLemke};
  const bool plane = posed.problem.dimension == 2;
  const bool newton = solver.name.find("nsn-ac") != solver.name.npos;
  return {command, kIncludesOfSiconosFriction,
          With(kSolveWithSiconosFriction,
               {{"@SICONOS_METHOD@", plane    ? "SICONOS_FRICTION_2D_NSGS"
                                     : newton ? "SICONOS_FRICTION_3D_NSN_AC"
                                              : "SICONOS_FRICTION_3D_NSGS"},
                {"@SICONOS_LIMIT@", newton ? "" : " options->iparam[SICONOS_IPARAM_MAX_ITER] = 100000;"},
                {"@SICONOS_DIMENSION@", plane ? "2" : "3"}}),
          true};
}

Package PackageOf(std::string_view name, const SolverUnderTest& solver, const ProblemShown& posed) {
  if (name == "ode") return {"g++ -x c++ @FILE@ -lode -o @NAME@ && ./@NAME@", kIncludesOfOde, kSolveWithOde};
  if (name == "dart")
    return {"g++ -x c++ @FILE@ -ldart-external-odelcpsolver -o @NAME@ && ./@NAME@", kIncludesOfDart,
            kSolveWithDart};
  if (name == "siconos") return PackageOfSiconos(solver, posed);
  const bool lemke = solver.name.find("lemke") != solver.name.npos;
  return {
      "g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet @FILE@ -lBulletDynamics-float64 "
      "-lBulletCollision-float64 \\\n *         -lLinearMath-float64 -o @NAME@ && ./@NAME@",
      lemke ? kIncludesOfBulletLemke : kIncludesOfBulletDantzig,
      lemke ? kSolveWithBulletLemke : kSolveWithBulletDantzig};
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

std::string ProgramInC(const ProblemShown& posed, const Finding& finding, const Package& package) {
  const std::string& kind = finding.kind;
  std::string text = std::string("/* @SAYS@\n *     ") + package.command + " */\n" + package.includes;
  text += kIncludesInC;
  if (Ends(kind)) text += kIncludesOfEnds;
  text += DataInC(posed, finding, package.takes_contacts) + package.solve;
  if (IsJudged(kind)) {
    const bool findex = !posed.limits.empty();
    text += With(kJudgeInC, {{"@ROUND@", IsRound(posed) ? kRoundInC : ""},
                             {"@BOUNDS@", !posed.HasFriction() ? kGivenBoundsInC
                                          : findex             ? kLimitBoundsInC
                                                               : kOwnBoundsInC}});
  }
  text += Ends(kind) ? kMainOfEndsInC : kMainInC;
  const std::string verdict = IsJudged(kind)         ? kVerdictOfJudgeInC
                              : kind == "not-finite" ? kVerdictNotFiniteInC
                              : kind == "leak"       ? kVerdictOfLeakInC
                                                     : kVerdictRefusedInC;
  return With(text,
              {{"@VERDICT@", verdict},
               {"@INDEX@", posed.HasFriction() ? "index.data()" : "nullptr"},
               {"@COPY@", posed.HasFriction() ? "std::vector<int> index(findex, findex + ROWS);\n  " : ""},
               {"@RIGHT@", posed.right.f ? "right[i]" : "NAN"},
               {"@KNOWN@", posed.right.f ? "right f" : "right f: not known"}});
}

std::string ProgramInPython(const ProblemShown& posed, const Finding& finding, bool is_library) {
  const std::string& kind = finding.kind;
  std::string text = kHeadOfPython + DataInPython(posed, finding, is_library);
  text += is_library ? kSolveByLibraryInPython : kSolveByProgramInPython;
  if (IsJudged(kind))
    text += With(kJudgeInPython, {{"@ROUND@", IsRound(posed) ? kRoundInPython : ""},
                                  {"@BOUNDS@", !posed.HasFriction()   ? "LOW[i], HIGH[i]"
                                               : posed.limits.empty() ? kOwnBoundsInPython
                                                                      : kLimitBoundsInPython}});
  if (Ends(kind))
    text += std::string(is_library ? kMainOfEndsByLibraryInPython : kMainOfEndsByProgramInPython) +
            kVerdictOfEndsInPython;
  else
    text += kMainInPython;
  const std::string verdict = IsJudged(kind)         ? kVerdictOfJudgeInPython
                              : kind == "not-finite" ? kVerdictNotFiniteInPython
                              : kind == "leak"       ? kVerdictOfLeakInPython
                                                     : kVerdictRefusedInPython;
  return With(text, {{"@VERDICT@", verdict},
                     {"@SOLVER@", is_library ? "./SOLVER.so" : "./SOLVER"},
                     {"@SECONDS@", Ends(kind) ? "2, 3" : "60, 61"},
                     {"@BOUNDS@", posed.law == SolverLaw::kBox ? ", \"bounds\": BOUNDS" : ""}});
}

}  // namespace

std::string ReproducerOf(const Finding& finding, const SolverUnderTest& solver, std::string_view name,
                         const std::string& file) {
  if (solver.name.empty() || !IsOfSolver(finding.kind))
    throw InputError(
        fmt::format("{}: found no failure of a solver under test, expected a finding of search --solver",
                    finding.signature));
  RequireLawOf(name, finding, solver);
  const ProblemShown posed = ShownOf(finding, solver.law);
  const Json facts = ParseJson(finding.facts, finding.signature);
  const bool is_library = facts.value("library", true);
  if (name == "c" && !is_library)
    throw InputError(finding.signature + ": found a finding of a program, expected python for its reproducer");
  const Json& seen = facts.contains("minimized") ? facts["minimized"] : facts["found"];
  const std::string says = fmt::format("{}: {} {} {}.", finding.signature, solver.name, solver.version,
                                       Deed(finding.kind, seen["what"].get<std::string>()));
  std::string text;
  if (name == "python")
    text = ProgramInPython(posed, finding, is_library);
  else if (name == "c")
    text = ProgramInC(posed, finding, {kCommandInC, kIncludesOfLibrary, kSolveByLibrary, true});
  else
    text = ProgramInC(posed, finding, PackageOf(name, solver, posed));
  const std::size_t dot = file.find_last_of('.');
  return With(text, {{"@SAYS@", says},
                     {"@LAW@", std::string(kSolverLawNames[static_cast<std::size_t>(solver.law)])},
                     {"@ACCURACY@", solver.accuracy},
                     {"@NAME@", dot == 0 || dot == file.npos ? file + "-program" : file.substr(0, dot)},
                     {"@FILE@", file}});
}

}  // namespace stiction
