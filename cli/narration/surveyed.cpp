// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/surveyed.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/answer_json.h"
#include "certify/exact/bounds.h"
#include "certify/exact/exact.h"
#include "certify/exact/space.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "corpus/record/asymmetry.h"
#include "corpus/record/factors.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"
#include "solver/problem/errors.h"

namespace stiction {
namespace {

constexpr int kExactContacts = 50;  // up to here, if A couples them, everything is decided over rationals
constexpr int kExactSpatialContacts = 10;
constexpr int kPublishedContacts = 32;           // up to here the published algorithm runs over rationals
constexpr double kWrong = 1e-6;                  // a larger error is no solution
constexpr std::int64_t kSurveyPrograms = 10000;  // linear programs of an enumeration

// ---- Assumptions -----------------------------------------------------------------------------

Json AsymmetryToJson(const AnyProblem& problem) {
  const Asymmetry largest = LargestAsymmetry(problem);
  Rational scale = 0;
  ForEachEntry(problem.entries().A,
               [&scale](int, int, const Rational& value) { scale = std::max<Rational>(scale, abs(value)); });
  const Rational relative = scale == 0 ? scale : Rational(largest.difference / scale);
  return {{"difference", ToDouble(largest.difference)},
          {"relative", ToDouble(relative)},
          {"i", largest.i},
          {"j", largest.j}};
}

// x'Ax / x'x.
Rational RayleighQuotient(const Obstacle& negative) {
  Rational square = 0;
  for (const Rational& x : negative.x) square += x * x;
  return negative.value / square;
}

// `psd`: true, false, or null for undecided. Bounds are relative to the largest A_ii.
Json CurvatureToJson(const AnyProblem& problem, bool exactly) {
  if (problem.factors() != nullptr) return {{"psd", true}, {"how", "factors"}};
  const CurvatureBounds bounds = BoundCurvature(problem);
  const double scale = bounds.scale > 0 ? bounds.scale : 1;
  Json json = {{"psd", nullptr}, {"how", "bound"}};
  if (bounds.least) json["least"] = *bounds.least / scale;
  if (bounds.negative) json["most"] = bounds.most / scale;
  if (bounds.least && *bounds.least >= 0) json["psd"] = true;
  if (bounds.negative) {
    json["psd"] = false;
    json["how"] = "exact";
  } else if (exactly) {
    const auto decision = DecideSemidefinite(problem.dense().A);
    const auto* negative = std::get_if<Obstacle>(&decision);
    json["psd"] = negative == nullptr;
    json["how"] = "exact";
    if (negative != nullptr) json["most"] = ToDouble(RayleighQuotient(*negative)) / scale;
  }
  return json;
}

// `in-range`: true, false, or null for undecided. `distance` is an upper bound, `rough distance` none
// (bounds.h).
Json RangeToJson(const AnyProblem& problem, bool exactly) {
  const RangeDistance bound = BoundRangeDistance(problem);
  Json json = {{"in-range", nullptr}, {"distance", bound.distance}, {"rough distance", bound.rough}};
  const bool regular = problem.rows() <= kMostDenseRows && IsRegularModuloPrime(problem);
  const bool by_factors = problem.factors() != nullptr && IsInRangeByFactors(*problem.factors());
  if (regular || by_factors || json["distance"] == 0) {
    json["in-range"] = true;
  } else if (exactly) {
    json["in-range"] = std::holds_alternative<ExactVector>(DecideRange(problem.dense().A, problem.b()));
  }
  json["regular"] = regular;
  return json;
}

// All three hold: true; one fails: false; otherwise null.
Json MeetsAll(const Json& entry) {
  const Json answers[] = {entry["asymmetry"]["difference"] == 0, entry["curvature"]["psd"],
                          entry["range"]["in-range"]};
  if (std::any_of(std::begin(answers), std::end(answers), [](const Json& answer) { return answer == false; })) {
    return false;
  }
  return std::all_of(std::begin(answers), std::end(answers), [](const Json& answer) { return answer == true; })
             ? Json(true)
             : Json(nullptr);
}

// ---- Runs ------------------------------------------------------------------------------------

// The largest error of f, a double vector, on the exact problem: evaluated over rationals.
template <class Problem>
double VerifiedResidual(const Problem& problem, const ExactVector& f) {
  const ExactVector a = problem.A * f + problem.b;
  return ToDouble(MeasureErrors(problem, FrictionLaw::kCoulomb, f, a).Largest());
}
template <class Problem>
double VerifiedResidual(const Problem& problem, const Eigen::VectorXd& f) {
  const ExactVector exact = f.unaryExpr([](double x) { return Rational(x); });
  return VerifiedResidual(problem, exact);
}

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

// Of a problem that doubles do not hold.
Json NotTried(const std::string& method, const RangeError& error) {
  return {{"method", method}, {"outcome", "not tried"}, {"reason", error.what()}};
}

// What solves over doubles, judged on the problem as it is given: its rounding is the method's, too.
Json RunInDoubles(const ExactProblem& problem, const std::string& method, const Limits& limits) try {
  const Request request{
      .method = method, .arithmetic = Arithmetic::kDouble, .limits = limits, .confirm = false};
  const Stopwatch watch(CLOCK_MONOTONIC);
  const InexactAnswer answer = std::get<InexactAnswer>(SolveIn(problem, request).answer);
  Json run = RunToJson(answer, watch);
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) return run;
  run["residual"] = VerifiedResidual(problem, answer.f);
  if (answer.Solved() && !(run["residual"] <= kWrong)) run["outcome"] = "wrong";
  return run;
} catch (const RangeError& error) {
  return NotTried(method, error);
}

// What `solve` does by default.
Json RunByDefault(const ExactProblem& problem, const Limits& limits) try {
  Request request{.limits = limits};
  request.arithmetic = UsualArithmetic(request.method, problem).arithmetic;
  const Stopwatch watch(CLOCK_MONOTONIC);
  const Solution solution = SolveIn(problem, request);
  return std::visit(
      [&](const auto& answer) {
        Json run = RunToJson(answer, watch);
        if (answer.f.size() == problem.rows()) run["residual"] = VerifiedResidual(problem, answer.f);
        return run;
      },
      solution.answer);
} catch (const RangeError& error) {
  return NotTried("auto", error);
}

bool IsDecided(const Json& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const Json& run) {
    return run["outcome"] == "solved" || run["outcome"] == "no-solution";
  });
}

// A stays sparse.
Json RunSparse(const AnyProblem& problem, const Limits& limits) {
  const Stopwatch watch(CLOCK_MONOTONIC);
  const InexactAnswer answer = SolveWithoutA(problem, {.arithmetic = Arithmetic::kDouble, .limits = limits});
  Json run = RunToJson(answer, watch);
  if (answer.errors) run["residual"] = answer.residual();
  return run;
}

// Rows of contacts that A couples, directly or through others. Each group is a problem of its own.
std::vector<std::vector<int>> UncoupledContacts(const ExactProblem& problem) {
  const int count = static_cast<int>(problem.contacts.size());
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  std::vector<int> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) {
      if (problem.A(i, j) != 0) parent[root(layout.ContactOf(i))] = root(layout.ContactOf(j));
    }
  }
  std::map<int, std::vector<int>> groups;
  for (int i = 0; i < count; ++i) groups[root(i)].push_back(i);
  std::vector<std::vector<int>> result;
  for (auto& [unused, group] : groups) result.push_back(std::move(group));
  return result;
}

std::vector<int> RowsOf(const ExactProblem& problem, const std::vector<int>& contacts) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  std::vector<int> rows;
  for (const int contact : contacts) {
    const int normal = layout.NormalRowOf(contact);
    rows.push_back(normal);
    if (layout.HasFriction(normal)) rows.push_back(normal + 1);
  }
  return rows;
}

// One group after the other: a solution of the whole consists of theirs, and there is none if one has none.
// The certificate of the whole, null if undecided; and the methods that made it.
std::pair<Json, std::string> DecideByGroups(const ExactProblem& problem,
                                            const std::vector<std::vector<int>>& groups, const Limits& limits) {
  Request request = {.law = FrictionLaw::kBaraff, .limits = limits};
  request.limits.programs = kSurveyPrograms;
  if (groups.size() <= 1) {
    ClaimAnswer existence = DecideExistence(problem, request);
    return {std::move(existence.certificate), std::string(existence.method)};
  }
  ExactVector f(problem.rows());
  std::set<std::string> methods;
  for (const std::vector<int>& group : groups) {
    const std::vector<int> rows = RowsOf(problem, group);
    ExactProblem part;
    for (const int contact : group) part.contacts.push_back(problem.contacts[contact]);
    part.A = problem.A(rows, rows);
    part.b = problem.b(rows);
    const ClaimAnswer existence = DecideExistence(part, request);
    methods.emplace(existence.method);
    if (existence.certificate.is_null()) return {nullptr, std::string(existence.method)};
    if (existence.certificate["claim"] != "solution-exists") {
      return {existence.certificate, std::string(existence.method)};
    }
    const Json& forces = existence.certificate["witness"]["f"];
    for (std::size_t k = 0; k < rows.size(); ++k) f[rows[k]] = *ParseRational(forces[k].get<std::string>());
  }
  return {SolutionCertificate(problem, f), fmt::format("{}", fmt::join(methods, "+"))};
}

// What no checker would take, as numbers that are too long, leaves a run undecided.
bool IsTaken(const CheckReport& report, Json& run) {
  if (report.accepted) return true;
  run["outcome"] = Name(Outcome::kUndecided);
  run["reason"] = "there is no certificate that a checker would take: " + report.reason;
  return false;
}

Json RunExactly(const ExactProblem& problem, const std::vector<std::vector<int>>& groups,
                const Limits& limits) {
  const Stopwatch watch(CLOCK_MONOTONIC);
  const auto [certificate, method] = DecideByGroups(problem, groups, limits);
  Json run = {{"method", method}, {"arithmetic", "exact"}, {"outcome", "undecided"}};
  run["seconds"] = watch.Seconds();
  if (groups.size() > 1) run["groups"] = groups.size();
  if (certificate.is_null()) return run;
  const CheckReport report = CheckCertificate(certificate, "survey");
  if (!IsTaken(report, run)) return run;
  run["outcome"] = report.claim == "solution-exists" ? "solved" : report.claim;
  run["certificate"] = report.claim;
  if (run["outcome"] == "solved") run["residual"] = 0.0;
  return run;
}

// The published algorithm as it stands, under the policy `paper`: does it loop?
Json RunPublished(const ExactProblem& problem, const Limits& limits) {
  const Stopwatch watch(CLOCK_MONOTONIC);
  const ExactRun published = RunExact(problem, {.limits = limits});
  Json run = {{"method", "baraff"}, {"arithmetic", "exact"}, {"outcome", Name(published.verdict.outcome)}};
  run["seconds"] = watch.Seconds();
  run["pivots"] = published.verdict.statistics.pivots;
  if (!published.verdict.reason.empty()) run["reason"] = published.verdict.reason;
  if (published.verdict.outcome == Outcome::kSolved) run["residual"] = VerifiedResidual(problem, published.f);
  return run;
}

Json PlanarRuns(const ExactProblem& problem, const SurveyScope& o) {
  const Limits& limits = o.limits;
  Json runs = Json::array();
  for (const char* method : {"complete", "lemke"}) {
    runs.push_back(RunInDoubles(problem, method, limits));
    if (runs.back()["outcome"] == "solved") break;
  }
  bool has_solution = false, is_found = false;  // over doubles: by any method, by the published algorithm
  if (o.suspicions) {
    has_solution = runs.back()["outcome"] == "solved";
    runs.push_back(RunInDoubles(problem, "baraff", limits));
    is_found = runs.back()["outcome"] == "solved";
  }
  const std::vector<std::vector<int>> groups = UncoupledContacts(problem);
  const bool small = std::all_of(groups.begin(), groups.end(),
                                 [](const auto& group) { return group.size() <= kExactContacts; });
  if (!is_found && problem.contacts.size() <= kPublishedContacts) runs.push_back(RunPublished(problem, limits));
  if (!has_solution && small) runs.push_back(RunExactly(problem, groups, limits));
  if (!IsDecided(runs)) runs.push_back(RunByDefault(problem, limits));
  return runs;
}

// A certificate of Coulomb's law up to a bound.
Json CertifyCoulomb(const ExactProblem& problem, const Limits& limits) try {
  const Stopwatch watch(CLOCK_MONOTONIC);
  const Answer<Rational> solution = SolveInSpace(problem, {.limits = limits});
  Json run = {{"method", "complete"}, {"arithmetic", "exact"}, {"outcome", Name(solution.outcome)}};
  run["seconds"] = watch.Seconds();
  if (!solution.reason.empty()) run["reason"] = solution.reason;
  if (solution.outcome != Outcome::kSolved) return run;
  if (*solution.bound <= 0) {
    run["outcome"] = Name(Outcome::kUndecided);
    return run;
  }
  const Json certificate = CoulombCertificate(problem, solution.f, *solution.bound);
  const CheckReport report = CheckCertificate(certificate, "survey");
  if (!IsTaken(report, run)) return run;
  run["certificate"] = report.claim;
  run["bound"] = ToString(*solution.bound);
  run["cosine gap"] = ToDouble(Rational(1 - *solution.bound));
  run["residual"] = VerifiedResidual(problem, solution.f);
  return run;
} catch (const RangeError& error) {
  return NotTried("complete", error);
}

Json SpatialRuns(const ExactProblem& problem, const Limits& limits) {
  Json runs = Json::array({RunInDoubles(problem, "fast", limits)});
  if (problem.contacts.size() <= kExactSpatialContacts) runs.push_back(CertifyCoulomb(problem, limits));
  if (!IsDecided(runs)) runs.push_back(RunByDefault(problem, limits));
  return runs;
}

Json Runs(const AnyProblem& problem, const SurveyScope& o) {
  const bool planar = problem.dimension() == 2;
  Json runs = Json::array();
  if (planar ? problem.contacts().size() > kExactContacts : problem.rows() > o.rows)
    runs.push_back(RunSparse(problem, o.limits));
  if (problem.rows() <= o.rows) {
    for (Json& run : planar ? PlanarRuns(problem, o) : SpatialRuns(problem, o.limits))
      runs.push_back(std::move(run));
  }
  if (runs.empty())
    runs.push_back({{"method", "none"}, {"outcome", "not tried"}, {"reason", "more rows than --rows"}});
  return runs;
}

void AddFacts(const AnyProblem& problem, const SurveyScope& o, Json& entry) {
  const bool exactly = !o.suspicions && problem.contacts().size() <= kExactContacts;
  entry["curvature"] = CurvatureToJson(problem, exactly);
  entry["range"] = RangeToJson(problem, exactly);
  entry["meets assumptions"] = MeetsAll(entry);
  entry["runs"] = Runs(problem, o);
}

}  // namespace

std::string ShortText(double x) { return x == 0 ? "0" : fmt::format("{:.0e}", x); }

Json Surveyed(const AnyProblem& problem, const SurveyScope& o) {
  Json entry = {
      {"contacts", problem.contacts().size()}, {"dimension", problem.dimension()}, {"rows", problem.rows()}};
  entry["asymmetry"] = AsymmetryToJson(problem);
  AddFacts(problem, o, entry);
  const double relative = entry["asymmetry"]["relative"].get<double>();
  const bool far = problem.dimension() == 2 && relative > kMostRounding;
  if (relative == 0 || far) return entry;
  Json symmetrized = {{"asymmetry", {{"difference", 0.0}}}};
  AddFacts(Symmetrized(problem), o, symmetrized);
  entry["symmetrized"] = symmetrized;
  return entry;
}

std::string AssumptionsMetText(const Json& facts) {
  if (facts["meets assumptions"] == true)
    return "meets the paper's assumptions: A is symmetric and semidefinite, b in its range";
  if (facts["meets assumptions"].is_null())
    return "may meet the paper's assumptions: nothing fails, but bounds do not decide them all";
  std::vector<std::string> failing;
  if (facts["asymmetry"]["difference"] != 0) failing.emplace_back("A is not symmetric");
  if (facts["curvature"]["psd"] == false) failing.emplace_back("A is not semidefinite");
  if (facts["range"]["in-range"] == false) failing.emplace_back("b is not in the range of A");
  return fmt::format("does not meet the paper's assumptions: {}", fmt::join(failing, ", "));
}

std::string RunsText(const Json& facts) {
  std::string existence = "No method that was tried solved it", published;
  bool found = false;
  for (const Json& run : facts["runs"]) {
    const std::string method = run["method"].get<std::string>(), outcome = run["outcome"].get<std::string>();
    const bool exact = run.value("arithmetic", "") == "exact";
    if (method == "baraff") {
      published = fmt::format("; the published algorithm {} {}",
                              outcome == "cycle"    ? "loops for ever"
                              : outcome == "solved" ? "solves it"
                              : outcome == "wrong"  ? "returns forces that are wrong"
                                                    : "ends in " + outcome,
                              exact ? "(policy paper, exactly)" : "(policy paper, over doubles)");
    }
    if (found || (outcome != "solved" && outcome != "no-solution")) continue;
    found = true;
    existence = outcome == "no-solution"
                    ? "It has no solution, as a certificate says"
                    : fmt::format("Method {} solves it {}, with an error of {}", method,
                                  exact ? "exactly" : "over doubles", ShortText(run["residual"].get<double>()));
  }
  return existence + published + ".";
}

}  // namespace stiction
