// SPDX-License-Identifier: Apache-2.0
#include "certify/request/cascade.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "certify/exact/bodies.h"
#include "certify/exact/inexact.h"
#include "certify/request/entries.h"
#include "certify/request/quad.h"
#include "certify/request/rest.h"
#include "corpus/stop.h"
#include "solver/numeric/coulomb.h"
#include "solver/problem/row_scale.h"

namespace stiction {
namespace {

using enum Arithmetic;
using Best = std::optional<Solution>;  // of the rows before

Request By(const Request& request, std::string_view method, Arithmetic arithmetic) {
  Request named = request;
  named.method = method;
  named.arithmetic = arithmetic;
  return named;
}

// ---- When --------------------------------------------------------------------------------------------

bool Always(const Posed&, const Best&) { return true; }
bool HasFactors(const Posed& posed, const Best&) { return posed.factors() != nullptr; }
bool HasManyInFactors(const Posed& posed, const Best&) {
  return posed.factors() != nullptr && posed.rows() > MostExactRows(posed.dimension());
}
bool StaysSparse(const Posed& posed, const Best&) { return posed.StaysSparse(); }
bool HasFewRows(const Posed& posed, const Best&) { return posed.rows() < kCellsFirst; }
bool HasManyRows(const Posed& posed, const Best&) { return posed.rows() >= kCellsFirst; }
bool IsSingular(const Posed&, const Best& best) { return best && best->outcome() == Outcome::kSingular; }

// Forces to go on from, or to be told as the best.
bool HasForces(const Posed& posed, const Best& best) {
  const auto* answer = best ? std::get_if<InexactAnswer>(&best->answer) : nullptr;
  return answer != nullptr && answer->f.size() == posed.rows() && answer->f.allFinite();
}

// Steps over quad that the budget holds.
std::int64_t QuadSteps(std::int64_t rows) {
  return kQuadOperations / std::max<std::int64_t>(1, rows * rows * rows / 3);
}
bool IsAffordable(const Posed& posed, const Best& best) {
  return HasForces(posed, best) && QuadSteps(posed.rows()) > 0;
}

// ---- How ---------------------------------------------------------------------------------------------

// What it does not solve is left to the rows behind it, where there are some.
Best RunBodies(Posed& posed, const Request& request, const Best&) {
  InexactAnswer answer = SolveByBodies(*posed.factors(), request);
  if (!answer.Solved() && !request.limits.Stopped() && !posed.StaysSparse()) return std::nullopt;
  return Solution{.answer = std::move(answer)};
}

Best RunBodiesExactly(Posed& posed, const Request& request, const Best&) {
  if (posed.dimension() == 3 && request.law == FrictionLaw::kBaraff) return std::nullopt;
  ExactAnswer answer = SolveByBodiesExactly(*posed.factors(), request);
  return answer.Solved() ? Best(Solution{.answer = std::move(answer)}) : std::nullopt;
}

// Rounded: what methods over doubles miss by a little.
Best RunRoundedModes(Posed& posed, const Request& request, const Best&) {
  const ExactAnswer exact = SolveByBodiesExactly(*posed.factors(), request);
  InexactAnswer answer;
  answer.method = exact.method;
  answer.law = exact.law;
  answer.outcome = Outcome::kSolved;  // if it passes
  answer.f = exact.f.unaryExpr(&ToDouble);
  answer = Judged(*posed.factors(), request, std::move(answer));
  return answer.Solved() ? Best(Solution{.answer = std::move(answer)}) : std::nullopt;
}

Best RunEntries(Posed& posed, const Request& request, const Best&) {
  return Solution{.answer = SolveEntries(posed.file(), request)};
}

Best RunWithoutPolygons(Posed& posed, const Request& request, const Best&) {
  Request quick = request;
  quick.sides = 0;
  return SolveNamed(posed, quick);
}

ContactProblem<Quad> InQuad(const ContactProblem<double>& problem) {
  return Converted<Quad>(problem, [](double x) { return Quad(x); });
}

// Newton's method from forces that doubles found.
Best RunNewtonOverQuad(Posed& posed, const Request& request, const Best& best) {
  const ContactProblem<double>& problem = posed.doubles();
  const RowScale scale = FindScale(problem);
  CoulombSolver<Quad> solver(
      {.limits = request.limits, .residual = ResidualOf<double>(request) / 2, .sides = 0});
  solver.most_newton_steps = QuadSteps(problem.rows());
  ContactProblem<Quad>::Vector start = std::get<InexactAnswer>(best->answer).f.cast<Quad>();
  for (int i = 0; i < start.size(); ++i) start[i] = ldexp(start[i], -scale.f[i]);
  auto answer = AnswerOf<double>(solver.Run(InQuad(Scaled(problem, scale)), &start));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f().unaryExpr([](const Quad& x) { return static_cast<double>(x); });
  ScaleBy(answer.f, scale.f);
  answer.method = "fast";
  answer.arithmetic = kQuad;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  JudgeAnswer(problem, ResidualOf<double>(request), answer);
  return Solution{.answer = std::move(answer)};
}

Best RunFastOverQuad(Posed& posed, const Request& request, const Best&) {
  Request few = request;
  few.limits.pivots = std::min(request.limits.pivots, QuadSteps(posed.rows()));
  const ContactProblem<Quad> fine = InQuad(posed.doubles());
  Answer<double> answer = InDoubles(Solve(fine, few), fine, ResidualOf<double>(request));
  answer.arithmetic = kQuad;
  return Solution{.answer = std::move(answer)};
}

// Nothing but a solution.
Best RunIfSolved(Posed& posed, const Request& request, const Best&) {
  Solution solution = SolveNamed(posed, request);
  return solution.outcome() == Outcome::kSolved ? Best(std::move(solution)) : std::nullopt;
}

Best RunExactly(Posed& posed, const Request& request, const Best&) {
  Solution solution = SolveNamed(posed, request);
  std::get<ExactAnswer>(solution.answer).rung = Rung::kExact;
  return solution;
}

// ---- The table ---------------------------------------------------------------------------------------

struct Turn {
  Arithmetic over;  // that is asked for
  int dimension;    // 0: any
  bool (*when)(const Posed&, const Best&);
  std::string_view method;
  Arithmetic in;
  Best (*run)(Posed&, const Request&, const Best&) = nullptr;  // null: the method by its name
  bool is_last = false;                                        // where its turn comes
};

constexpr Turn kCascade[] = {
    {kDouble, 3, &HasFactors, kInteriorPoint, kDouble, &RunBodies},
    {kDouble, 0, &HasFactors, kNewtonBodies, kDouble, &RunBodies},
    {kDouble, 2, &HasFactors, kInteriorPoint, kDouble, &RunBodies},
    {kDouble, 0, &HasManyInFactors, kInteriorPoint, kDouble, &RunRoundedModes},
    {kDouble, 0, &StaysSparse, "entries", kDouble, &RunEntries, true},  // no method: the one that takes entries
    {kDouble, 3, &Always, "fast", kDouble, &RunWithoutPolygons},
    {kDouble, 2, &Always, kAutomatic, kDouble},
    {kDouble, 2, &IsSingular, "proximal", kDouble},
    {kDouble, 2, &IsAffordable, "fast", kQuad, &RunFastOverQuad},
    {kDouble, 3, &IsAffordable, "fast", kQuad, &RunNewtonOverQuad},
    {kDouble, 3, &HasForces, kAutomatic, kDouble},
    {kFiltered, 2, &HasFewRows, "complete", kFiltered, &RunIfSolved},
    {kFiltered, 2, &HasManyRows, "fast", kFiltered, &RunIfSolved},
    {kFiltered, 2, &Always, kAutomatic, kExact, &RunExactly},
    {kFloat, 0, &Always, kAutomatic, kFloat},
    {kQuad, 0, &Always, kAutomatic, kQuad},
    {kExact, 0, &HasManyInFactors, kInteriorPoint, kExact, &RunBodiesExactly},
    {kExact, 0, &Always, kAutomatic, kExact},
};

bool IsDecided(const Solution& solution) {
  return solution.outcome() == Outcome::kSolved || solution.outcome() == Outcome::kNoSolution;
}

bool IsBetter(const Solution& told, const Best& best) {
  const auto* one = std::get_if<InexactAnswer>(&told.answer);
  const auto* other = best ? std::get_if<InexactAnswer>(&best->answer) : nullptr;
  if (one == nullptr || other == nullptr) return true;
  if (one->Solved() != other->Solved()) return one->Solved();
  if (one->outcome == Outcome::kUndecided && other->outcome != Outcome::kUndecided) return false;
  return one->errors && (!other->errors || one->errors->Largest() < other->errors->Largest());
}

// Null where doubles do not hold the problem.
const ContactProblem<double>* DoublesOf(Posed& posed) try {
  return &posed.doubles();
} catch (const InputError&) {
  return nullptr;
}

void PreferRestIn(Posed& posed, const Request& request, Solution& solution) {
  if (auto* exact = std::get_if<ExactAnswer>(&solution.answer)) {
    const auto* rounded = request.arithmetic == kFiltered ? DoublesOf(posed) : nullptr;
    return PreferRest(posed.file(), rounded, request, *exact);
  }
  auto& answer = std::get<InexactAnswer>(solution.answer);
  const bool in_factors = request.arithmetic == kDouble && posed.factors() != nullptr;
  if (in_factors && !MayRest(InDoubles(*posed.factors()), answer)) return;
  const auto file = [&posed]() -> const AnyProblem& { return posed.file(); };
  if (request.arithmetic != kFloat) return PreferRest(posed.doubles(), file, request, answer);
  const auto ran = Converted<double>(posed.RoundedTo<float>(), [](float x) { return double{x}; });
  PreferRest(ran, file, request, answer);
}

}  // namespace

Solution SolveInTurn(Posed& posed, const Request& request) {
  Best best;
  for (const Turn& turn : kCascade) {
    const bool concerns =
        turn.over == request.arithmetic && (turn.dimension == 0 || turn.dimension == posed.dimension());
    if (!concerns || !turn.when(posed, best)) continue;
    const Request named = By(request, turn.method, turn.in);
    Best told;
    try {
      told = turn.run != nullptr ? turn.run(posed, named, best) : Best(SolveNamed(posed, named));
    } catch (const Stopped&) {
      if (!best) throw;
    }
    if (told && IsBetter(*told, best)) {
      if (turn.in == kQuad && best) told->suspected = std::get<InexactAnswer>(std::move(best->answer));
      best = std::move(told);
    }
    if (best && (turn.is_last || IsDecided(*best) || request.limits.Stopped())) break;
  }
  try {
    if (request.arithmetic != kDouble || !posed.StaysSparse()) PreferRestIn(posed, request, *best);
  } catch (const Stopped&) {  // what is found remains
  }
  return *std::move(best);
}

}  // namespace stiction
