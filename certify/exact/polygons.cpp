// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/polygons.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certify/exact/lemke_space.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"

namespace stiction {

SpaceRun RunSpace(const ExactProblem& problem, const RationalPolygons& polygons, const Limits& limits,
                  Trace<Rational>* trace) {
  CompleteOptions options;
  options.limits = limits;
  CompleteDriving<Rational> driving(options);
  SpaceRun run;
  run.verdict = driving.Run(problem, polygons, trace);
  run.f = driving.f();
  run.a = driving.a();
  if (run.verdict.outcome == Outcome::kRay) run.ray = driving.ray();
  run.word = driving.word();
  return run;
}

// ---- Words as linear equations ---------------------------------------------------------------

namespace {

struct ModeSystem {
  std::vector<ExactVector> columns;  // force per unit of an unknown
  std::vector<ExactVector> rows;     // accelerations along these vanish
  ExactVector guess;                 // of the unknowns
};

ModeSystem MakeSystem(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                      const ExactVector& guess) {
  ModeSystem system;
  std::vector<Rational> unknowns;
  int row = 0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    const auto unit = [&](int k) {
      ExactVector v = ExactVector::Zero(problem.rows());
      v[row + k] = 1;
      return v;
    };
    const int held = modes[i].law == Law::kBreak ? 0 : modes[i].law == Law::kInside ? 3 : 1;
    for (int k = 0; k < held; ++k) {
      system.rows.push_back(unit(k));
      system.columns.push_back(unit(k));
      unknowns.push_back(guess[row + k]);
    }
    if (held == 1 && contact.HasFrictionRows()) {
      const bool slips = modes[i].law == Law::kCorner;
      const Planar<Rational>& direction = slips ? modes[i].direction : contact.slip;
      const Rational factor = slips ? contact.mu : Rational(-contact.mu);
      for (int k = 0; k < 2; ++k) system.columns.back()[row + 1 + k] = factor * direction[k];
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  system.guess = ExactVector(static_cast<int>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) system.guess[static_cast<int>(j)] = unknowns[j];
  return system;
}

}  // namespace

std::optional<ExactVector> SolveModes(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                                      const ExactVector& guess) {
  const ModeSystem system = MakeSystem(problem, modes, guess);
  const int size = static_cast<int>(system.columns.size());
  ExactMatrix M(size, size);
  ExactVector right(size);
  for (int j = 0; j < size; ++j) {
    const ExactVector image = Accelerations(problem, system.columns[j]) - problem.b;
    for (int i = 0; i < size; ++i) M(i, j) = system.rows[i].dot(image);
    right[j] = -system.rows[j].dot(problem.b);
  }
  const auto x = SolveEquations(M, right, system.guess);
  if (!x) return std::nullopt;
  ExactVector f = ExactVector::Zero(problem.rows());
  for (int j = 0; j < size; ++j) f += (*x)[j] * system.columns[j];
  return f;
}

// ---- Directions ------------------------------------------------------------------------------

Planar<Rational> NearDirection(const Planar<Rational>& x, int bits) {
  const double length = std::hypot(ToDouble(x[0]), ToDouble(x[1]));
  const double c = ToDouble(x[0]) / length, s = ToDouble(x[1]) / length;
  if (!(length > 0) || !std::isfinite(c) || !std::isfinite(s)) return {Rational(1), Rational(0)};
  const double sign = c < 0 ? -1 : 1;
  const double t = std::nearbyint(std::ldexp(sign * s / (1 + sign * c), bits));
  Planar<Rational> point = OnCircle(Rational(Rational(t) / Rational(std::ldexp(1.0, bits))));
  if (c < 0) point = {Rational(-point[0]), Rational(-point[1])};
  return point;
}

void Accept(const ExactProblem& problem, const ExactVector& f, SpaceSolution& solution) {
  solution.outcome = Outcome::kSolved;
  solution.reason = {};
  solution.f = f;
  solution.a = Accelerations(problem, f);
}

namespace {

// A point of the circle strictly between two corners, near x / abs(x), of few digits. Requires that x is
// strictly between them too.
Planar<Rational> DirectionBetween(const Planar<Rational>& from, const Planar<Rational>& to,
                                  const Planar<Rational>& x) {
  for (int bits = 2; bits < 50; bits += 2) {
    const Planar<Rational> u = NearDirection(x, bits);
    if (Cross(from, u) > 0 && Cross(u, to) > 0) return u;
  }
  return from;
}

RationalPolygons MakePolygons(const ExactProblem& problem, int sides) {
  return RationalPolygons(problem.contacts.size(), FrictionPolygon<Rational>(sides));
}

void Add(CompleteStatistics& sum, const CompleteStatistics& part) {
  sum.pieces += part.pieces;
  sum.folds += part.folds;
  sum.descents += part.descents;
  sum.ties += part.ties;
  sum.stages += part.stages;
}

// The modes of a word on polygons; contacts on an edge slip along a point of the circle between its corners.
std::vector<SpaceMode> ModesOf(const ExactProblem& problem, const RationalPolygons& polygons,
                               const SpaceRun& run) {
  std::vector<SpaceMode> modes;
  int row = 0;
  for (std::size_t i = 0; i < run.word.size(); ++i) {
    const LawCell& cell = run.word[i];
    SpaceMode mode = {cell.law, {Rational(0), Rational(0)}};
    if (cell.law == Law::kCorner) mode.direction = polygons[i].corner(cell.side);
    if (cell.law == Law::kEdge) {
      mode.law = Law::kCorner;
      const Planar<Rational>&from = polygons[i].corner(cell.side), &to = polygons[i].corner(cell.side + 1);
      const Planar<Rational> force = TangentialOf(run.f, row);
      mode.direction = Cross(from, force) <= 0 ? from
                       : Cross(force, to) <= 0 ? to
                                               : DirectionBetween(from, to, force);
    }
    modes.push_back(mode);
    row += problem.contacts[i].HasFrictionRows() ? 3 : 1;
  }
  return modes;
}

// Adds corners; false if there was none to add.
bool RefineTowards(const std::vector<SpaceMode>& modes, RationalPolygons& polygons) {
  bool added = false;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i].law == Law::kCorner) added = polygons[i].Insert(modes[i].direction) || added;
  }
  return added;
}

// One step toward (21), (22): whether it is the last.
bool TryWeak(const ExactProblem& problem, const SpaceRun& run, RationalPolygons& polygons,
             SpaceSolution& solution) {
  if (!FindWeakViolation(problem, run.f)) {
    Accept(problem, run.f, solution);
    return true;
  }
  const std::vector<SpaceMode> modes = ModesOf(problem, polygons, run);
  const auto f = SolveModes(problem, modes, run.f);
  if (f && !FindWeakViolation(problem, *f)) {
    Accept(problem, *f, solution);
    return true;
  }
  solution.reason = "an edge of a polygon could not be replaced by a point of the circle";
  return !RefineTowards(modes, polygons);
}

}  // namespace

SpaceSolution SolveOnPolygons(const ExactProblem& problem, const SpaceOptions& options, const Toward& toward,
                              Trace<Rational>* trace) {
  RationalPolygons polygons = MakePolygons(problem, options.sides);
  SpaceSolution solution;
  for (;; ++solution.refinements) {
    SpaceRun run = options.engine == SpaceEngine::kLemke
                       ? RunLemkeInSpace(problem, polygons, options.limits, trace)
                       : RunSpace(problem, polygons, options.limits, trace);
    Add(solution.statistics, run.verdict.statistics);
    if (run.verdict.outcome != Outcome::kSolved) {
      if (solution.outcome == Outcome::kSolved) break;  // a bound that was not improved
      solution.outcome = run.verdict.outcome;
      solution.reason = run.verdict.reason;
      solution.ray = std::move(run.ray);
      solution.word = std::move(run.word);
      break;
    }
    solution.word = run.word;
    if (toward(run, polygons, solution) || solution.refinements == options.refinements) break;
  }
  return solution;
}

SpaceSolution SolveWeakly(const ExactProblem& problem, const SpaceOptions& options, Trace<Rational>* trace) {
  const auto toward = [&problem](const SpaceRun& run, RationalPolygons& polygons, SpaceSolution& solution) {
    return TryWeak(problem, run, polygons, solution);
  };
  return SolveOnPolygons(problem, options, toward, trace);
}

SpaceOptions SpaceOptionsOf(const SolveOptions& options, SpaceEngine engine) {
  SpaceOptions space;
  space.engine = engine;
  space.law = options.law;
  space.sides = options.sides;
  space.limits = options.limits;
  return space;
}

Answer<Rational> AnswerOf(SpaceSolution solution, FrictionLaw law) {
  Answer<Rational> answer;
  answer.outcome = solution.outcome;
  answer.reason = solution.reason;
  answer.law = law;
  if (answer.Solved()) answer.f = std::move(solution.f);
  if (answer.Solved() && law == FrictionLaw::kCoulomb) answer.bound = ToString(solution.bound);
  answer.ray = std::move(solution.ray);
  answer.word = Name(solution.word, 3);
  answer.counters = CountersOf(solution.statistics);
  answer.counters.push_back({"refinements", solution.refinements});
  return answer;
}

}  // namespace stiction
