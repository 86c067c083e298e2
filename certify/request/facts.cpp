// SPDX-License-Identifier: Apache-2.0
#include "certify/request/facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/answer_json.h"
#include "certify/exact/bounds.h"
#include "certify/exact/hypothesis.h"
#include "certify/exact/rest.h"
#include "certify/request/cascade.h"
#include "certify/request/request.h"
#include "corpus/record/asymmetry.h"
#include "corpus/stop.h"
#include "solver/problem/errors.h"

namespace stiction {
namespace {

using enum Arithmetic;

constexpr double kWrong = 1e-6;  // a larger error is no solution

// ---- Assumptions -----------------------------------------------------------------------------

struct Facts {
  Asymmetry asymmetry;                         // the largest
  std::optional<bool> semidefinite, in_range;  // empty: not decided
  bool regular = false;                        // that A is: so every b is in its range
  CurvatureBounds curvature;                   // none of factors
  std::optional<Obstacle> negative, outside;   // x'Ax < 0; y'A = 0 and y'b /= 0

  std::optional<bool> MeetAll() const {
    if (asymmetry.difference != 0 || semidefinite == false || in_range == false) return false;
    return semidefinite && in_range ? std::optional(true) : std::nullopt;
  }
};

// Of few rows the witness of rationals is the shorter one.
void DecideCurvature(const AnyProblem& problem, bool exactly, Facts& facts) {
  CurvatureBounds& bounds = facts.curvature = BoundCurvature(problem);
  facts.negative = bounds.negative;
  if (exactly && (!bounds.negative || problem.rows() <= kQuickRows)) {
    const auto decision = DecideSemidefinite(problem.dense().A);
    const auto* negative = std::get_if<Obstacle>(&decision);
    facts.semidefinite = negative == nullptr;
    if (negative == nullptr) return;
    facts.negative = *negative;
    if (!bounds.negative) bounds.most = ToDouble(Rational(negative->value / negative->x.dot(negative->x)));
  } else if (bounds.negative || (bounds.least && *bounds.least >= 0)) {
    facts.semidefinite = !bounds.negative;
  }
}

void FindRange(const AnyProblem& problem, bool exactly, bool besides, Facts& facts) {
  const bool by_factors = problem.factors() != nullptr && IsInRangeByFactors(*problem.factors());
  const bool forms_A = besides ? !by_factors && !StaysSparse(problem) : problem.rows() <= kMostDenseRows;
  facts.regular = facts.curvature.least.value_or(0) > 0 || (forms_A && IsRegularModuloPrime(problem));
  if (by_factors || facts.regular) {
    facts.in_range = true;
  } else if (exactly) {
    const auto decision = DecideRange(problem.dense().A, problem.b());
    if (const auto* outside = std::get_if<Obstacle>(&decision)) facts.outside = *outside;
    facts.in_range = !facts.outside;
  }
}

// Exactly: over rationals, where bounds do not decide. Besides: nothing that an answer should not wait for, as
// an A that factors do without. What is not found before somebody says stop (corpus/stop.h) is not decided.
Facts FactsOf(const AnyProblem& problem, bool exactly, bool besides) {
  Facts facts;
  facts.asymmetry = LargestAsymmetry(problem);
  try {
    if (problem.factors() != nullptr) {
      facts.semidefinite = true;
    } else {
      DecideCurvature(problem, exactly, facts);
    }
    FindRange(problem, exactly, besides, facts);
  } catch (const Stopped&) {
  }
  return facts;
}

Json OrNull(std::optional<bool> holds) { return holds ? Json(*holds) : Json(); }

Json AsymmetryToJson(const AnyProblem& problem, const Asymmetry& largest) {
  Rational scale = 0;
  ForEachEntry(problem.entries().A,
               [&scale](int, int, const Rational& value) { scale = std::max<Rational>(scale, abs(value)); });
  const Rational relative = scale == 0 ? scale : Rational(largest.difference / scale);
  return {{"difference", ToDouble(largest.difference)},
          {"relative", ToDouble(relative)},
          {"i", largest.i},
          {"j", largest.j}};
}

// Bounds are relative to the largest A_ii.
Json CurvatureToJson(const AnyProblem& problem, bool exactly, const Facts& facts) {
  if (problem.factors() != nullptr) return {{"psd", true}, {"how", "factors"}};
  const CurvatureBounds& bounds = facts.curvature;
  const double scale = bounds.scale > 0 ? bounds.scale : 1;
  Json json = {{"psd", OrNull(facts.semidefinite)}, {"how", exactly || facts.negative ? "exact" : "bound"}};
  if (bounds.least) json["least"] = *bounds.least / scale;
  if (facts.negative) json["most"] = bounds.most / scale;
  return json;
}

// ---- Runs ------------------------------------------------------------------------------------

// How a method ended, and after how long.
template <class Scalar>
Json RunToJson(const Answer<Scalar>& answer, const Stopwatch& watch) {
  Json run = {{"method", answer.method}, {"arithmetic", Name(answer.arithmetic)}};
  run["answered by"] = AnsweredBy(answer.method, answer.counters);
  run["outcome"] = Name(answer.outcome);
  run["seconds"] = watch.Seconds();
  run["statistics"] = CountersToJson(answer.counters);
  if (!answer.reason.empty()) run["reason"] = answer.reason;
  return run;
}

// A stays sparse.
Json RunSparse(const AnyProblem& problem, const Limits& limits) {
  const Stopwatch watch(CLOCK_MONOTONIC);
  Posed posed(problem);
  posed.KeepSparse();
  const Solution solution = SolveInTurn(posed, {.arithmetic = kDouble, .limits = limits});
  const InexactAnswer& answer = std::get<InexactAnswer>(solution.answer);
  Json run = RunToJson(answer, watch);
  if (answer.errors) run["residual"] = answer.residual();
  return run;
}

// What no checker would take, as numbers that are too long, leaves a run undecided.
void AddCertificate(const Json& certificate, Json& run) {
  const CheckReport report = CheckCertificate(certificate, "survey");
  if (report.accepted) {
    run["outcome"] = Name(report.claim == "no-solution" ? Outcome::kNoSolution : Outcome::kSolved);
    run["certificate"] = report.claim;
  } else {
    run["outcome"] = Name(Outcome::kUndecided);
    run["reason"] = "there is no certificate that a checker would take: " + report.reason;
  }
}

// Judged on the problem as it is given: its rounding is the method's, too. The residual is evaluated over
// rationals. Exact forces that obey Coulomb's law up to a bound are certified.
Json RunOf(const ExactProblem& problem, const Request& request) try {
  const Stopwatch watch(CLOCK_MONOTONIC);
  const Solution solution = SolveIn(problem, request);
  const auto tell = [&](const auto& answer) {
    Json run = RunToJson(answer, watch);
    const bool is_met = answer.Solved() || answer.arithmetic != kExact;  // of others f is where a run stands
    if (!is_met || answer.f.size() != problem.rows() || !answer.f.allFinite()) return run;
    const ExactVector f = answer.f.unaryExpr([](const auto& x) { return Rational(x); });
    const ExactVector a = problem.A * f + problem.b;
    run["residual"] = ToDouble(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a).Largest());
    return run;
  };
  Json run = std::visit(tell, solution.answer);
  if (solution.outcome() != Outcome::kSolved) return run;
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  if (exact == nullptr && !(run.value("residual", 0.0) <= kWrong)) run["outcome"] = "wrong";
  if (exact == nullptr || exact->bound.value_or(0) <= 0) return run;
  AddCertificate(CoulombCertificate(problem, exact->f, *exact->bound), run);
  run["bound"] = ToString(*exact->bound);
  run["cosine gap"] = ToDouble(Rational(1 - *exact->bound));
  return run;
} catch (const RangeError& error) {
  return {{"method", request.method}, {"outcome", "not tried"}, {"reason", error.what()}};
}

// One part after the other: a solution of the whole consists of theirs, and there is none if one has none.
Json RunParts(const ExactProblem& problem, const std::vector<UncoupledPart>& parts, const Limits& limits) {
  const Stopwatch watch(CLOCK_MONOTONIC);
  Request request = {.law = FrictionLaw::kBaraff, .limits = limits};
  request.limits.programs = kProgramsOfSurvey;
  ExactVector f(problem.rows());
  std::set<std::string_view> methods;
  Json certificate;
  for (const UncoupledPart& part : parts) {
    const ClaimAnswer existence = DecideExistence(part.problem, request);
    certificate = *existence.certificate;
    const bool is_solved = certificate.is_object() && certificate["claim"] == "solution-exists";
    if (!is_solved) methods.clear();
    methods.insert(existence.method);
    if (!is_solved) break;
    const Json& forces = certificate["witness"]["f"];
    for (std::size_t k = 0; k < part.rows.size(); ++k)
      f[part.rows[k]] = *ParseRational(forces[k].get<std::string>());
  }
  Json run = {{"method", fmt::format("{}", fmt::join(methods, "+"))}, {"arithmetic", "exact"}};
  run["outcome"] = Name(Outcome::kUndecided);
  run["seconds"] = watch.Seconds();
  if (parts.size() > 1) run["groups"] = parts.size();
  if (certificate.is_null()) return run;
  if (certificate["claim"] == "solution-exists") certificate = SolutionCertificate(problem, f);
  AddCertificate(certificate, run);
  if (run["outcome"] == "solved") run["residual"] = 0.0;
  return run;
}

bool Solves(const Json& run) { return run["outcome"] == "solved"; }
bool Decides(const Json& run) { return Solves(run) || run["outcome"] == "no-solution"; }

Json DenseRuns(const ExactProblem& problem, const Limits& limits, bool suspicions) {
  const auto by = [&](std::string_view method, Arithmetic arithmetic) {
    return RunOf(problem, {.method = method, .arithmetic = arithmetic, .limits = limits, .confirm = false});
  };
  const bool planar = problem.dimension == 2;
  Json runs = Json::array({by(planar ? "complete" : "fast", kDouble)});
  if (planar && !Solves(runs.back())) runs.push_back(by("lemke", kDouble));
  const bool has_solution = suspicions && Solves(runs.back());
  if (planar && suspicions) runs.push_back(by("baraff", kDouble));
  const bool is_found = suspicions && Solves(runs.back());
  const std::size_t contacts = problem.contacts.size();
  if (planar && !is_found && contacts <= kPublishedContacts) runs.push_back(by("baraff", kExact));
  if (!planar && contacts <= kExactContactsInSpace) runs.push_back(by("complete", kExact));
  if (planar && !has_solution) {
    const std::vector<UncoupledPart> parts = UncoupledParts(problem);
    const auto is_few = [](const auto& part) { return part.problem.contacts.size() <= kExactContacts; };
    if (std::ranges::all_of(parts, is_few)) runs.push_back(RunParts(problem, parts, limits));
  }
  if (std::ranges::any_of(runs, Decides)) return runs;
  const Arithmetic usual = UsualArithmetic(kAutomatic, problem).arithmetic;
  runs.push_back(RunOf(problem, {.arithmetic = usual, .limits = limits}));
  return runs;
}

Json RunsOf(const AnyProblem& problem, const Limits& limits, int dense_rows, bool suspicions) {
  Json runs = Json::array();
  const bool planar = problem.dimension() == 2, in_factors = problem.factors() != nullptr;
  const bool is_large = std::ssize(problem.contacts()) > (planar ? kExactContacts : kExactContactsInSpace);
  if (planar || in_factors ? is_large : problem.rows() > dense_rows) runs.push_back(RunSparse(problem, limits));
  const bool is_done = in_factors && is_large && Solves(runs.back());
  if (problem.rows() <= dense_rows && !is_done) {
    const Json dense = DenseRuns(problem, limits, suspicions);
    runs.insert(runs.end(), dense.begin(), dense.end());
  }
  if (runs.empty())
    runs.push_back({{"method", "none"}, {"outcome", "not tried"}, {"reason", "more rows than --rows"}});
  return runs;
}

}  // namespace

// `psd` and `in-range`: true, false, or null for undecided. `distance` is an upper bound, `rough distance` none
// (bounds.h).
Json Surveyed(const AnyProblem& problem, const Limits& limits, int dense_rows, bool suspicions) {
  const bool exactly = !suspicions && problem.contacts().size() <= kExactContacts;
  const auto add_facts = [&](const AnyProblem& judged, Json& entry) {
    Facts facts = FactsOf(judged, exactly, false);
    const RangeDistance bound = BoundRangeDistance(judged);
    if (bound.distance == 0) facts.in_range = true;
    if (!entry.contains("asymmetry")) entry["asymmetry"] = AsymmetryToJson(judged, facts.asymmetry);
    entry["curvature"] = CurvatureToJson(judged, exactly, facts);
    entry["range"] = {{"in-range", OrNull(facts.in_range)},
                      {"distance", bound.distance},
                      {"rough distance", bound.rough},
                      {"regular", facts.regular}};
    entry["meets assumptions"] = OrNull(facts.MeetAll());
    entry["runs"] = RunsOf(judged, limits, dense_rows, suspicions);
  };
  Json entry = {
      {"contacts", problem.contacts().size()}, {"dimension", problem.dimension()}, {"rows", problem.rows()}};
  add_facts(problem, entry);
  const double relative = entry["asymmetry"]["relative"];
  const bool far = problem.dimension() == 2 && relative > kMostRounding;
  if (relative == 0 || far) return entry;
  Json symmetrized = {{"asymmetry", {{"difference", 0.0}}}};
  add_facts(Symmetrized(problem), symmetrized);
  entry["symmetrized"] = symmetrized;
  return entry;
}

// ---- Beside an answer ----------------------------------------------------------------------------

Json FailedAssumptions(const AnyProblem& problem) {
  constexpr std::size_t kWitnessContacts = 50;  // up to here an answer has the vectors that show what fails
  const Facts facts = FactsOf(problem, problem.rows() <= kQuickRows, true);
  Json failed = Json::array();
  const auto add = [&failed](std::string_view assumption, const Json& shown) {
    Json row = {{"assumption", assumption}};
    row.update(shown);
    failed.push_back(std::move(row));
  };
  const auto by = [](const char* name, const Obstacle& shown) -> Json {
    return {{name, ListJson(shown.x)}, {"value", ToString(shown.value)}};
  };
  if (facts.asymmetry.difference != 0) add("symmetric", {{"i", facts.asymmetry.i}, {"j", facts.asymmetry.j}});
  if (facts.negative && problem.contacts().size() <= kWitnessContacts) {
    add("psd", by("x", *facts.negative));
  } else if (facts.negative) {
    add("psd", {{"quotient", facts.curvature.most}, {"witness", "certify --claim psd"}});
  } else if (!facts.semidefinite) {
    add("psd", {{"undecided", Stop::IsAsked() ? kStopped : "zero is within the bounds of an eigenvalue"}});
  }
  if (!facts.in_range) add("in-range", {{"undecided", Stop::IsAsked() ? kStopped : "A may be singular"}});
  if (!facts.outside) return failed;
  add("in-range", by("y", *facts.outside));
  // (H), which b in range(A) implies for a symmetric A, decided in the plane.
  if (problem.dimension() == 3 || HasSlidingContact(problem)) return failed;
  try {
    const auto hypothesis = DecideHypothesis(problem);
    if (const auto* shown = std::get_if<Obstacle>(&hypothesis)) add("h", by("v", *shown));
  } catch (const Stopped&) {
    add("h", {{"undecided", kStopped}});
  }
  return failed;
}

}  // namespace stiction
