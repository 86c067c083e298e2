// SPDX-License-Identifier: Apache-2.0
#include "cli/solve_space.h"

#include <fmt/format.h>

#include "certify/certificate.h"
#include "certify/space.h"
#include "cli/shared.h"
#include "corpus/input_error.h"
#include "corpus/rounded.h"
#include "solver/numeric/coulomb.h"

namespace stiction {
namespace {

Json Beginning(const SolveSpaceOptions& o, Outcome outcome, std::string_view reason) {
  Json json = {{"outcome", Name(outcome)}};
  if (!reason.empty()) json["reason"] = reason;
  json["method"] = o.method;
  json["arithmetic"] = o.arithmetic;
  json["law"] = o.law;
  return json;
}

SolvedInSpace SolveExactly(const ExactProblem& problem, const SolveSpaceOptions& o) {
  SpaceOptions options;
  options.law = o.law == "coulomb" ? FrictionLaw::kCoulomb : FrictionLaw::kBaraff;
  options.sides = o.sides;
  options.limits = o.limits;
  const SpaceSolution solution = SolveInSpace(problem, options);
  const bool solved = solution.outcome == Outcome::kSolved;
  Json json = Beginning(o, solution.outcome, solution.reason);
  json["word"] = Name(solution.word);
  if (solved) {
    json["f"] = VectorToJson(solution.f);
    json["a"] = VectorToJson(solution.a);
    if (options.law == FrictionLaw::kCoulomb) json["bound"] = ToString(solution.bound);
  }
  if (solution.ray.size() > 0) json["ray"] = VectorToJson(solution.ray);
  json["statistics"] = StatisticsToJson(solution.statistics);
  json["statistics"]["refinements"] = solution.refinements;
  return {solution.outcome, json};
}

// Coulomb's law, which implies the conditions (21), (22).
template <class Scalar>
SolvedInSpace SolveRounded(const ExactProblem& problem, const SolveSpaceOptions& o) {
  CoulombOptions options;
  options.tolerances = o.tolerances;
  options.limits = o.limits;
  options.sides = o.sides;
  options.start = o.method == "fast" ? CoulombStart::kSweeps : CoulombStart::kComplete;
  if constexpr (sizeof(Scalar) < sizeof(double)) options.residual = 1e-4;
  CoulombSolver<Scalar> solver(options);
  const CoulombVerdict verdict = solver.Run(Rounded<Scalar>(problem));
  Json json = Beginning(o, verdict.outcome, verdict.reason);
  json["f"] = NumbersToJson(solver.f());
  json["a"] = NumbersToJson(solver.a());
  json["residual"] = NumberToJson(verdict.residual);
  json["statistics"] = StatisticsToJson(verdict.statistics);
  return {verdict.outcome, json};
}

}  // namespace

SolvedInSpace SolveSpace(const ExactProblem& problem, const SolveSpaceOptions& o) {
  if (o.method != "complete" && o.method != "fast") {
    throw InputError(
        o.file, "dimension", "3",
        fmt::format("2: method {} is not built for space yet; baraff, complete and fast are", o.method));
  }
  if (o.sides < 4 || o.sides % 4 != 0)
    throw InputError(fmt::format("--sides {}: expected a multiple of 4, at least 4", o.sides));
  if (o.method == "fast" && o.arithmetic == "exact")
    throw InputError("--method fast: in space expected --arithmetic float, double or long-double");
  if (o.arithmetic == "float") return SolveRounded<float>(problem, o);
  if (o.arithmetic == "double") return SolveRounded<double>(problem, o);
  if (o.arithmetic == "long-double") return SolveRounded<long double>(problem, o);
  return SolveExactly(problem, o);
}

}  // namespace stiction
