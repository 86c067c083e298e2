// SPDX-License-Identifier: Apache-2.0
// What the model tester holds: answers against each other, against the truth and against what they say of
// themselves; solutions of one problem against those of another; a problem against its copies in other forms.
// And shrinking: what is false is made small, and told with a file and a command.
//
// A fault's kind is its first word; it is shrunk only to others of the same kind.

#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/request/entries.h"
#include "certify/request/request.h"
#include "corpus/formats/formats.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "search/units/minimize.h"
#include "solver/problem/gate.h"
#include "tests/judge.h"
#include "tests/model/walk.h"
#include "tests/scratch.h"

namespace stiction::testing {

struct Fault {
  std::string what = {};     // empty: none
  std::string command = {};  // of the file, that shows it

  explicit operator bool() const { return !what.empty(); }
  std::string Kind() const { return what.substr(0, what.find(':')); }
};

// ---- Answers -----------------------------------------------------------------------------------------

struct Asked {
  Request request;
  bool in_factors = false;

  std::string Name() const {
    const bool weak = request.law == FrictionLaw::kBaraff && request.method != "baraff";
    return fmt::format("{} over {}{}{}", request.method, stiction::Name(request.arithmetic),
                       weak ? " by (21), (22)" : "", in_factors ? " in factors" : "");
  }
  std::string Command() const {
    return fmt::format("stiction solve FILE --method {} --arithmetic {}{}", request.method,
                       stiction::Name(request.arithmetic),
                       request.law == FrictionLaw::kBaraff ? " --law baraff" : "");
  }
};

// Of problems that have a solution, how many a method solves in an arithmetic, by both their names.
struct Share {
  int solved = 0, of = 0;
};
using Shares = std::map<std::string, Share>;

// Right answers are not enough: each method solves most problems that can be solved. Not those whose signs stay
// open over intervals, nor enumeration in space, which refutes.
inline std::string FaultOfShares(const Shares& shares) {
  constexpr int kFew = 20;
  constexpr double kLeast = 0.5;
  for (const auto& [name, share] : shares) {
    const bool may_be_open = name.find("interval") != name.npos || name.starts_with("enumerate over exact");
    if (share.of >= kFew && !may_be_open && share.solved < kLeast * share.of)
      return fmt::format("share: {} solves {} of {}", name, share.solved, share.of);
  }
  return "";
}

inline bool HasFriction(const ExactProblem& problem) {
  return std::ranges::any_of(problem.contacts, [](const auto& contact) { return contact.mu > 0; });
}
inline bool Slides(const ExactProblem& problem) {
  return std::ranges::any_of(problem.contacts, [](const auto& contact) {
    return contact.kind == ContactKind::kSliding && contact.mu > 0;
  });
}

// What is to be decided is decided: where a theorem says so, or since all that there is was tried.
inline bool MustDecide(const ExactProblem& problem, const Truth& truth, const Request& request) {
  const bool exactly = request.arithmetic == Arithmetic::kExact || request.arithmetic == Arithmetic::kFiltered;
  if (!exactly) return false;
  const bool is_few = problem.dimension == 2 && problem.contacts.size() <= kMostContactsTried;
  if (is_few && (request.method == "enumerate" || request.method == kAutomatic)) return truth.is_known;
  const bool drives = request.method == "complete" || request.method == "lemke" || request.method == kAutomatic;
  const bool is_smooth = (request.method == "baraff" || request.method == "qp") && !HasFriction(problem);
  return (drives || is_smooth) && !Slides(problem) && MeetsAssumptions(problem);
}

// A ray of complete driving, of Lemke's method or of (5) proves that b is not in range(A): forces that the
// contacts allow and A does not see, along which b falls. Of A that is symmetric and positive semidefinite.
inline std::string FaultOfRay(const ExactProblem& problem, const ExactAnswer& answer) {
  const ExactVector& ray = answer.ray;
  if (ray.size() != problem.rows()) return "it has other rows";
  if (!ExactVector(problem.A * ray).isZero(0)) return "A sees it";
  if (problem.b.dot(ray) >= 0) return "b does not fall along it";
  std::string fault;
  ForEachContact(problem, [&](int k, int row, int count) {
    const auto& contact = problem.contacts[k];
    if (contact.kind == ContactKind::kBilateral) return;
    Rational friction = 0;
    for (int i = 1; i < count; ++i) friction += ray[row + i] * ray[row + i];
    const Rational limit = contact.mu * ray[row];
    if (ray[row] < 0 || friction > limit * limit) fault = fmt::format("contact {} does not allow it", k + 1);
  });
  return fault;
}

inline bool IsRayOfPath(const ExactProblem& problem, const Request& request, const ExactAnswer& answer) {
  return answer.outcome == Outcome::kRay && answer.ray.size() > 0 && request.method != "baraff" &&
         !Slides(problem) && IsSymmetric(problem) && IsPositiveSemidefinite(problem);
}

// What one answer says that is false; empty if nothing.
inline std::string FaultOfAnswer(const ExactProblem& problem, const Truth& truth, const Asked& asked,
                                 const Solution& solution) {
  const Request& request = asked.request;
  const Outcome outcome = solution.outcome();
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  if (outcome == Outcome::kNoSolution) {
    if (exact == nullptr) return "rounded: no-solution is said of a rounded problem";
    if (truth.is_known && truth.solvable && truth.bound == 1)
      return "falsehood: no-solution of a problem that has one";
  }
  if (exact != nullptr && exact->f.size() == problem.rows() && exact->Solved()) {
    const std::string fault = FaultOf(problem, *exact);  // exact answers are of the file
    if (!fault.empty()) return "inexact: an exact answer is none: " + fault;
    const bool is_loose = exact->bound && *exact->bound < 1 - Rational(1, 1 << 20);
    if (is_loose && MustDecide(problem, truth, request))
      return "loose: friction is far from opposite to the slip";
    const bool is_coulomb =
        problem.dimension == 2 || (exact->law == FrictionLaw::kCoulomb && exact->bound == 1);
    if (is_coulomb && truth.is_known && !truth.solvable)
      return "falsehood: a solution of a problem that has none";
  } else if (exact == nullptr && outcome == Outcome::kSolved) {
    std::string fault = FaultOf(problem, request, solution);
    if (!fault.empty() && asked.in_factors)  // by factors, errors are those of the problem itself
      fault = FaultOf(problem, std::get<InexactAnswer>(solution.answer), GateOf<double>(0));
    if (!fault.empty()) return "gate: " + fault;
  }
  if (exact != nullptr && IsRayOfPath(problem, request, *exact)) {
    const std::string fault = FaultOfRay(problem, *exact);
    if (!fault.empty()) return "ray: " + fault;
  }
  const std::string_view by = std::visit([](const auto& answer) { return answer.method; }, solution.answer);
  if (FindMethodFacts(by) == nullptr) return "name: the method that answers has none";
  if (exact == nullptr) {
    const Arithmetic told = std::get<InexactAnswer>(solution.answer).arithmetic;
    const bool escalates = request.method == kAutomatic;  // doubles go on over quad
    if (told != request.arithmetic && !escalates)
      return fmt::format("name: {} answers over {}", Name(request.arithmetic), Name(told));
  }
  const bool decided = outcome == Outcome::kSolved || outcome == Outcome::kNoSolution;
  const bool is_path = request.arithmetic == Arithmetic::kExact && request.method == "complete";
  if (problem.dimension == 2 && is_path && !decided && outcome != Outcome::kRay &&
      outcome != Outcome::kSingular)
    return fmt::format("open: complete driving ends in {}", Name(outcome));
  if (!decided && MustDecide(problem, truth, request))
    return fmt::format("undecided: what is sure to be decided ends in {}", Name(outcome));
  return "";
}

// fault(asked, solution) of an answer that is right by itself: what else is wrong with it.
using OfAnswer = std::function<std::string(const Asked&, const Solution&)>;

inline std::vector<Asked> AllAsked(const Case& drawn) {
  std::vector<std::string_view> methods = {kAutomatic};
  for (const MethodFacts& facts : AllMethods()) methods.push_back(facts.name);
  std::vector<Asked> all;
  const int dimension = drawn.problem.dimension;
  for (const std::string_view method : methods) {
    if (method == "ipopt") continue;  // a process of its own that proposes, as is qp over doubles
    if (method == "enumerate" && drawn.problem.contacts.size() > kMostContactsTried) continue;
    const bool weak = dimension == 3 && method == "baraff";
    const bool by_factors = drawn.factors && (method == kAutomatic || method == "newton-bodies");
    for (const Arithmetic arithmetic : kArithmetics) {
      const bool is_process = method == "qp" && arithmetic == Arithmetic::kDouble;
      if (is_process || !Refusal(method, dimension, arithmetic).empty()) continue;
      const bool exact = arithmetic == Arithmetic::kExact;
      all.push_back({RequestFor(method, arithmetic, weak ? FrictionLaw::kBaraff : FrictionLaw::kCoulomb)});
      if (dimension == 3 && exact)  // by (21), (22) forces may be askew to the slip
        all.push_back({RequestFor(method, arithmetic, FrictionLaw::kBaraff)});
      if (by_factors && (exact || arithmetic == Arithmetic::kDouble))
        all.push_back({RequestFor(method, arithmetic), true});
    }
  }
  return all;
}

inline ProblemFile FileOf(const ExactProblem& problem) {
  ProblemFile file;
  file.name = "drawn";
  file.problem = problem;
  return file;
}

// The first thing that is false of a problem, over all methods and arithmetics.
inline Fault FaultIn(const Case& drawn, const Truth& truth, const OfAnswer& also = {}) {
  for (const Asked& asked : AllAsked(drawn)) {
    std::string fault;
    try {
      const AnyProblem problem = asked.in_factors ? AnyProblem(*drawn.factors) : AnyProblem(drawn.problem);
      const Solution solution = SolveIn(problem, asked.request);
      fault = FaultOfAnswer(drawn.problem, truth, asked, solution);
      if (fault.empty() && also) fault = also(asked, solution);
    } catch (const InputError&) {  // a number that the arithmetic does not hold, or what is not built
    } catch (const std::exception& error) {
      fault = fmt::format("throws: {}", error.what());
    }
    if (!fault.empty()) return {fmt::format("{} ({})", fault, asked.Name()), asked.Command()};
  }
  return {};
}

// The same of methods that keep A sparse, or in factors. also(name, answer) sees each answer that is right.
inline Fault FaultOfSparse(const Case& drawn,
                           const std::function<void(const std::string&, const InexactAnswer&)>& also = {}) {
  for (const bool in_factors : {false, true}) {
    if (in_factors && !drawn.factors) continue;
    const AnyProblem problem = in_factors ? AnyProblem(*drawn.factors) : AnyProblem(EntriesOf(drawn.problem));
    for (const std::string_view method : MethodsOfEntries(problem)) {
      const Request request = RequestFor(method, Arithmetic::kDouble);
      std::string fault;
      try {
        const InexactAnswer answer = SolveEntries(problem, request);
        if (answer.Solved()) fault = FaultOf(drawn.problem, answer, GateOf<double>(0));
        if (also) also(fmt::format("sparse {}{}", method, in_factors ? " in factors" : ""), answer);
      } catch (const std::exception& error) {
        fault = error.what();
      }
      if (!fault.empty())
        return {fmt::format("sparse: {} ({}{})", fault, method, in_factors ? " in factors" : ""),
                fmt::format("stiction solve FILE --method {} --arithmetic double", method)};
    }
  }
  return {};
}

// ---- Claims ------------------------------------------------------------------------------------------

// Certificates of the problem are accepted, and that of existence says what is true.
inline Fault FaultOfClaims(const ExactProblem& problem, const Truth& truth) {
  const char* const command = "stiction certify FILE --claim existence";
  try {
    const ClaimAnswer existence =
        DecideExistence(problem, {.limits = {.drives = 1000, .pivots = 1000, .programs = 10000}});
    std::vector<Json> certificates = {SymmetryCertificate(problem), RangeCertificate(problem)};
    if (IsSymmetric(problem)) certificates.push_back(SemidefiniteCertificate(problem));
    if (existence.certificate) certificates.push_back(existence.certificate);
    for (const Json& certificate : certificates) {
      const CheckReport report = CheckCertificate(certificate, "drawn");
      const bool is_dear =
          report.reason.find("no more than the limit") != std::string::npos;  // and is not handed out
      if (!report.accepted && !is_dear)
        return {"claim: " + report.claim + " is refused: " + report.reason, command};
    }
    if (!existence.certificate || !truth.is_known || truth.bound != 1) return {};
    const std::string claim = existence.certificate->at("claim");
    if (claim == (truth.solvable ? "no-solution" : "solution-exists"))
      return {"claim: falsely " + claim, command};
  } catch (const std::exception& error) {
    return {fmt::format("throws: {}", error.what()), command};
  }
  return {};
}

// ---- Forms -------------------------------------------------------------------------------------------

inline std::string FaultOfCopy(const char* form, const ExactProblem& problem, const ExactProblem& copy) {
  bool same = copy.dimension == problem.dimension && copy.contacts.size() == problem.contacts.size() &&
              copy.A == problem.A && copy.b == problem.b;
  for (std::size_t i = 0; same && i < problem.contacts.size(); ++i) {
    const auto &mine = problem.contacts[i], &other = copy.contacts[i];
    same = mine.kind == other.kind && mine.mu == other.mu && mine.slip == other.slip;
  }
  return same ? "" : fmt::format("copy: {} has another problem", form);
}

inline std::string FaultOfText(const Case& drawn) {
  const ExactProblem& problem = drawn.problem;
  ProblemFile file = FileOf(problem);
  std::string fault = FaultOfCopy("a file", problem, ParseProblem(Print(file), "drawn").problem);
  if (!fault.empty()) return fault;
  file.problem = EntriesOf(problem);
  fault = FaultOfCopy("a file of entries", problem, ParseProblem(Print(file), "drawn").problem);
  if (!fault.empty() || !drawn.factors) return fault;
  file.problem = *drawn.factors;
  const AnyProblem read = ParseProblem(Print(file), "drawn").problem;
  fault = FaultOfCopy("a file of factors", problem, read);
  return fault.empty() ? FaultOfCopy("the entries of factors", problem, DenseOf(read.entries())) : fault;
}

// What a format can hold: its kinds of contacts; and in fclib, [W V; V' R], entries between static and
// bilateral contacts are those of their mirror image.
inline bool Holds(const std::string& format, const ExactProblem& problem) {
  bool bilateral = false;
  int before = 0;  // rows of static contacts
  for (const auto& contact : problem.contacts) {
    const bool is_static = contact.kind == ContactKind::kStatic;
    if (format == "siconos-lcp" && contact.kind != ContactKind::kFrictionless) return false;
    if (format == "siconos-fc" && !is_static) return false;
    if (format == "fclib" && (bilateral || !is_static) && contact.kind != ContactKind::kBilateral) return false;
    bilateral = bilateral || contact.kind == ContactKind::kBilateral;
    before += is_static ? problem.dimension : 0;
  }
  const int behind = problem.rows() - before;
  return format != "fclib" ||
         problem.A.topRightCorner(before, behind) == problem.A.bottomLeftCorner(behind, before).transpose();
}

// Numbers that are no doubles are rounded where that is allowed; those that are need not be.
inline std::string FaultOfFormats(const Case& drawn) {
  static const Scratch scratch;
  ExactProblem rounded = AsRun(drawn.problem, Arithmetic::kDouble);
  for (const PublishedFormat& format : PublishedFormats()) {
    rounded.dimension = format.name == "siconos-lcp" ? 2 : drawn.problem.dimension;  // it tells none
    const bool holds = Holds(format.name, drawn.problem);
    for (const std::string& storage : format.storages) {
      const auto file = scratch / format.name;
      const bool rounds = storage == format.storages.front();
      try {
        WritePublished(FileOf(rounds ? drawn.problem : rounded), file, format.name, storage,
                       rounds ? Rounding::kAllowed : Rounding::kRefused);
      } catch (const InputError& error) {
        if (holds) return fmt::format("export: {} refuses: {}", format.name, error.what());
        break;
      }
      if (!holds) return fmt::format("export: {} holds what it cannot", format.name);
      const auto copy = FaultOfCopy(format.name.c_str(), rounded, ReadPublished(file).problem);
      if (!copy.empty()) return fmt::format("{}, stored as {}", copy, storage);
    }
  }
  return "";
}

// Forces of a scene's smallest problems are forces of the whole, `problem`.
inline std::string FaultOfIslands(const ExactProblem& problem, const SceneModel<Rational>& full,
                                  const SceneModel<Rational>& minimal, const std::vector<ExactVector>& forces) {
  const auto violation = FindViolation(problem, ExtendForces(minimal, forces, full));
  return violation ? "scene: forces of its smallest problems are none of the whole: " + *violation : "";
}

// The scene's own model is the problem, also when it is read from its file.
inline std::string FaultOfScene(const Case& drawn) {
  if (!drawn.scene) return "";
  const Scene<Rational> scene = ParseScene(Print(*drawn.scene), "drawn").scene;
  const SceneModel<Rational> full = FullModel(scene), minimal = Assemble(scene, FindContacts(scene));
  const std::string fault = FaultOfCopy("a scene", drawn.problem, full.Problem(0));
  if (!fault.empty()) return fault;
  std::vector<ExactVector> forces;
  for (std::size_t island = 0; island < minimal.islands.size(); ++island) {
    forces.push_back(TruthOf(minimal.Problem(island)).f);
    if (forces.back().size() == 0) return "scene: bodies at rest have no solution";
  }
  return FaultOfIslands(drawn.problem, full, minimal, forces);
}

inline Fault FaultOfForms(const Case& drawn) {
  for (const auto fault_of : {FaultOfText, FaultOfFormats, FaultOfScene}) {
    try {
      const std::string fault = fault_of(drawn);
      if (!fault.empty()) return {fault, "stiction problem FILE"};
    } catch (const RangeError&) {  // doubles do not hold it
    } catch (const std::exception& error) {
      return {fmt::format("throws: {}", error.what()), "stiction problem FILE"};
    }
  }
  return {};
}

// ---- Forces ------------------------------------------------------------------------------------------

inline Rational ErrorsOf(const ExactProblem& problem, const ExactVector& f) {
  ErrorMeter<Rational> meter;
  return MeasureErrors(problem, FrictionLaw::kCoulomb, f, Accelerations(problem, f), meter, Rational(1, 1024))
      .Largest();
}

// Forces over fractions, and over doubles or floats: a solution passes, rounded too; what passes has a
// neighbour that it solves.
template <class Scalar>
std::string FaultOfGate(const ExactProblem& problem, const ExactVector& f, bool is_solution) {
  const Gate gate = GateOf<Scalar>(0);
  ContactProblem<Scalar> rounded;
  Eigen::Matrix<Scalar, Eigen::Dynamic, 1> forces(f.size());
  try {
    rounded = Rounded<Scalar>(problem);
  } catch (const RangeError&) {
    return "";
  }
  for (int i = 0; i < f.size(); ++i) {
    forces[i] = static_cast<Scalar>(ToDouble(f[i]));
    const bool lost = !std::isfinite(forces[i]) || (f[i] != 0 && std::abs(forces[i]) < 1e-30);
    if (lost) return "";
  }
  const auto wide = Converted<double>(rounded, [](Scalar x) { return static_cast<double>(x); });
  const Eigen::VectorXd wide_f = forces.template cast<double>();
  const double error = BoundErrors(wide, FrictionLaw::kCoulomb, wide_f, gate).Largest();
  if (is_solution && !(error <= gate.eps))
    return fmt::format("refusal: a solution, rounded, has errors of {:.3g}, more than {:.3g}", error, gate.eps);
  if (!(error < 0.1)) return "";
  const double most = error + 4 * kTold<double>;  // a limit of friction rounds
  const ExactVector exactly = wide_f.unaryExpr([](double x) { return Rational(x); });
  const auto miss =
      FindMiss(Unrounded(rounded), exactly, FrictionLaw::kCoulomb, Gate{most, most * gate.theta()});
  return miss ? fmt::format("gate: forces with errors of {:.3g} have no such neighbour: {}", error, *miss) : "";
}

inline std::string FaultOfForces(const ExactProblem& problem, const ExactVector& f, bool is_solution) {
  if (is_solution) {
    const auto miss = FindMiss(problem, f, FrictionLaw::kCoulomb, Gate{});
    if (miss) return "refusal: a solution is not its own neighbour: " + *miss;
  }
  if (problem.dimension == 2 && (ErrorsOf(problem, f) == 0) == FindViolation(problem, f).has_value())
    return "errors: they are zero of what is no solution, or are not of one";
  const std::string fault = FaultOfGate<double>(problem, f, is_solution);
  return fault.empty() ? FaultOfGate<float>(problem, f, is_solution) : fault;
}

// ---- Steps -------------------------------------------------------------------------------------------

// What a step does to `truth`, which becomes that of its problem, and to other forces than solutions.
inline std::string FaultOfStep(const ExactProblem& from, const Step& step, const ExactVector& forces,
                               Truth& truth) {
  const ExactProblem& to = step.to.problem;
  if (step.to.factors) {
    const std::string fault = FaultOfCopy("factors", to, DenseOf(*step.to.factors));
    if (!fault.empty()) return fault;
  }
  if (step.keeps_errors && from.dimension == 2 && ErrorsOf(from, forces) != ErrorsOf(to, step.forward(forces)))
    return "errors: they are others after " + step.name;
  if (truth.is_known && truth.solvable && truth.f.size() > 0 && step.solvable) {
    truth.f = step.forward(truth.f);
    if (to.dimension == 3 && from.dimension == 2) truth.bound = 1;
    if (const auto violation = Violation(to, truth.f, truth.bound))
      return fmt::format("walk: a solution is none after {}: {}", step.name, *violation);
  }
  truth.solvable = truth.solvable && step.solvable;
  truth.is_known = truth.is_known || !step.solvable;
  if (!truth.solvable) truth.f.resize(0);
  return "";
}

// A solution of the end as one of the start; empty if it need not be.
inline std::string FaultOfWayBack(const Walk& walk, const Solution& solution) {
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  if (exact == nullptr || !exact->Solved() || exact->f.size() != walk.end().problem.rows()) return "";
  const bool in_space = walk.end().problem.dimension == 3;
  if (in_space && exact->law != FrictionLaw::kCoulomb) return "";
  const Rational bound = exact->bound.value_or(1);
  ExactVector f = exact->f;
  for (int k = static_cast<int>(walk.steps.size()) - 1; k >= 0; --k) {
    const Step& step = walk.steps[k];
    const ExactProblem& from = (k == 0 ? walk.start : walk.steps[k - 1].to).problem;
    if (!step.backward) return "";
    f = step.backward(f);
    if (const auto violation = Violation(from, f, bound))
      return fmt::format("back: a solution is none before {}: {}", step.name, *violation);
  }
  return "";
}

// A force changed a little or much.
inline ExactVector Changed(const ExactVector& f, Choices& choices) {
  ExactVector changed = f;
  const auto row = choices.Integer(0, f.size() - 1);
  Rational size = changed[row] == 0 ? Rational(1) : changed[row];
  for (auto k = choices.Integer(0, 60); k > 0; --k) size /= 2;
  changed[row] += choices.Integer(0, 1) == 0 ? size : Rational(-size);
  return changed;
}

// All of it: the walk, forces on the way, and what is said of its end.
inline Fault FaultOfWalk(const Walk& walk, Choices& choices, Shares* shares = nullptr) {
  if (Fault fault = FaultOfForms(walk.start)) return fault;
  Truth truth = TruthOf(walk.start.problem);
  ExactVector forces = truth.f;
  if (forces.size() == 0) {
    forces.resize(walk.start.problem.rows());
    for (Rational& x : forces) x = choices.Integer(-3, 3);
  }
  forces = Changed(forces, choices);
  const ExactProblem* from = &walk.start.problem;
  for (const Step& step : walk.steps) {
    const std::string fault = FaultOfStep(*from, step, forces, truth);
    if (!fault.empty()) return {fault, ""};
    forces = step.forward(forces);
    from = &step.to.problem;
  }
  const Case& end = walk.end();
  if (!walk.steps.empty())
    if (Fault fault = FaultOfForms(end)) return fault;
  std::string fault = FaultOfForces(end.problem, forces, false);
  if (fault.empty() && truth.f.size() > 0 && truth.bound == 1)
    fault = FaultOfForces(end.problem, truth.f, true);
  if (!fault.empty()) return {fault, "stiction solve FILE --arithmetic double"};
  const auto count = [&](const std::string& name, Outcome outcome) {
    if (shares == nullptr || !truth.is_known || !truth.solvable) return;
    Share& share = (*shares)[fmt::format("{} in {}", name, end.problem.dimension)];
    ++share.of;
    share.solved += outcome == Outcome::kSolved;
  };
  if (Fault sparse = FaultOfSparse(end, [&](auto& name, auto& answer) { count(name, answer.outcome); }))
    return sparse;
  if (Fault claim = FaultOfClaims(end.problem, truth)) return claim;
  const bool has_one_motion = !HasFriction(end.problem) && MeetsAssumptions(end.problem);
  std::optional<ExactVector> motion;  // without friction there is one (theorem 5)
  return FaultIn(end, truth, [&](const Asked& asked, const Solution& solution) -> std::string {
    count(asked.Name(), solution.outcome());
    const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
    if (has_one_motion && exact != nullptr && exact->Solved()) {
      if (motion && *motion != exact->a) return "motion: without friction two answers accelerate differently";
      motion = exact->a;
    }
    return FaultOfWayBack(walk, solution);
  });
}

// ---- Shrink ------------------------------------------------------------------------------------------

// Draws a walk and looks for a fault in it: `walk` becomes what was drawn.
inline Fault FaultOfDraw(Choices& choices, Walk& walk, Shares* shares = nullptr) {
  try {
    walk = DrawWalk(choices);
    return FaultOfWalk(walk, choices, shares);
  } catch (const std::exception& error) {
    return {fmt::format("throws: {}", error.what())};
  }
}

using Values = std::vector<std::int64_t>;

// Choices made fewer and smaller, one by one, as long as that keeps the fault. Steps that are none are in
// reach.
inline Values Shrunk(Values choices, const std::function<bool(const Values&)>& keeps) {
  const auto take = [&](const Values& candidate) {
    if (candidate == choices || !keeps(candidate)) return false;
    choices = candidate;
    return true;
  };
  for (bool again = true; again;) {
    again = false;
    for (std::size_t half = choices.size() / 2; half > 0 && choices.size() > half; half /= 2)
      again |= take({choices.begin(), choices.end() - static_cast<std::ptrdiff_t>(half)});
    for (std::size_t k = 0; k < choices.size(); ++k) {
      for (const std::int64_t smaller :
           {std::int64_t{0}, choices[k] / 2, choices[k] - (choices[k] > 0 ? 1 : -1)}) {
        Values candidate = choices;
        candidate[k] = smaller;
        if (choices[k] != 0 && take(candidate)) {
          again = true;
          break;
        }
      }
    }
  }
  return choices;
}

// The walk of these choices and its fault, shrunk: the fault, the steps, the problem as a file, and the command
// that shows it there. Where the end of the walk is wrong by itself the steps are gone.
inline std::string Told(const Values& choices) {
  const auto look = [](const Values& values, Walk& walk) {
    Choices replayed = Choices::Replay(values);
    return FaultOfDraw(replayed, walk);
  };
  Walk walk;
  Fault fault = look(choices, walk);
  const Values few = Shrunk(choices, [&, kind = fault.Kind()](const Values& values) {
    Walk shorter;
    return look(values, shorter).Kind() == kind;
  });
  fault = look(few, walk);
  ProblemFile file = FileOf(walk.end().problem);
  const auto look_alone = [](const ExactProblem& problem) {
    const Case alone{problem};
    if (Fault found = FaultOfForms(alone)) return found;
    if (Fault found = FaultOfSparse(alone)) return found;
    if (Fault found = FaultOfClaims(problem, TruthOf(problem))) return found;
    return FaultIn(alone, TruthOf(problem));
  };
  if (look_alone(file.problem).Kind() == fault.Kind()) {
    MinimizeOptions options;
    options.keeps = [&](const ExactProblem& candidate) { return look_alone(candidate).Kind() == fault.Kind(); };
    file.problem = Minimize(file.problem, options).problem;
    fault = look_alone(file.problem);
    walk.steps.clear();
  } else if (walk.end().factors) {
    file.problem = *walk.end().factors;
  }
  return fmt::format("{}\nwalk:{}\nFILE:\n{}\n{}", fault.what, walk.Names(), Print(file), fault.command);
}

}  // namespace stiction::testing
