// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/polygons.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certify/exact/lemke_space.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/units.h"

namespace stiction {

OnPolygons RunSpace(const ExactProblem& problem, RationalPolygons polygons, const Limits& limits,
                    Trace<Rational>* trace) {
  CompleteDriving<Rational> driving({.limits = limits});
  OnPolygons run = {AnswerOf<Rational>(driving.Run(problem, polygons, trace)), driving.word(),
                    std::move(polygons)};
  run.answer.f = driving.f();
  run.answer.a = driving.a();
  if (run.answer.outcome == Outcome::kRay) run.answer.ray = driving.ray();
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
  ForEachContact(problem, [&](int i, int row, int) {
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
  });
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

void Accept(const ExactProblem& problem, const ExactVector& f, Answer<Rational>& answer) {
  answer.outcome = Outcome::kSolved;
  answer.reason.clear();
  answer.f = f;
  answer.a = Accelerations(problem, f);
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

// The modes of a word on polygons; contacts on an edge slip along a point of the circle between its corners.
std::vector<SpaceMode> ModesOf(const ExactProblem& problem, const OnPolygons& run) {
  std::vector<SpaceMode> modes;
  ForEachContact(problem, [&](int i, int row, int) {
    const LawCell& cell = run.word[i];
    SpaceMode mode = {cell.law, {Rational(0), Rational(0)}};
    if (cell.law == Law::kCorner) mode.direction = run.polygons[i].corner(cell.side);
    if (cell.law == Law::kEdge) {
      mode.law = Law::kCorner;
      const FrictionPolygon<Rational>& polygon = run.polygons[i];
      const Planar<Rational>&from = polygon.corner(cell.side), &to = polygon.corner(cell.side + 1);
      const Planar<Rational> force = TangentialOf(run.answer.f, row);
      mode.direction = Cross(from, force) <= 0 ? from
                       : Cross(force, to) <= 0 ? to
                                               : DirectionBetween(from, to, force);
    }
    modes.push_back(mode);
  });
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
bool TryWeak(const ExactProblem& problem, OnPolygons& run, Answer<Rational>& answer) {
  if (!FindViolation(problem, run.answer.f)) {
    Accept(problem, run.answer.f, answer);
    return true;
  }
  const std::vector<SpaceMode> modes = ModesOf(problem, run);
  const auto f = SolveModes(problem, modes, run.answer.f);
  if (f && !FindViolation(problem, *f)) {
    Accept(problem, *f, answer);
    return true;
  }
  answer.reason = "an edge of a polygon could not be replaced by a point of the circle";
  return !RefineTowards(modes, run.polygons);
}

}  // namespace

Answer<Rational> SolveOnPolygons(const ExactProblem& problem, const Request& request, SpaceEngine engine,
                                 const Toward& toward) {
  const auto run_engine = engine == SpaceEngine::kLemke ? &RunLemkeInSpace : &RunSpace;
  Trace<Rational> trace;
  RationalPolygons polygons = MakePolygons(problem, request.sides);
  Answer<Rational> answer;
  answer.law = request.law;
  int refinements = 0;
  for (;; ++refinements) {
    OnPolygons run = run_engine(problem, std::move(polygons), request.limits, request.trace ? &trace : nullptr);
    run.refinements = refinements;
    answer.counters += run.answer.counters;
    const bool ended = !run.answer.Solved();
    if (ended && answer.Solved()) break;  // a bound that was not improved
    answer.word = Name(run.word, 3);
    if (ended) {
      answer.outcome = run.answer.outcome;
      answer.reason = run.answer.reason;
      answer.ray = std::move(run.answer.ray);
      break;
    }
    if (toward(run, answer) || refinements == kMostRefinements) break;
    polygons = std::move(run.polygons);
  }
  answer.counters.Tell(Counter::kRefinements) = refinements;
  answer.pivots = std::move(trace.pivots);
  return answer;
}

Answer<Rational> SolveWeakly(const ExactProblem& problem, const Request& request, SpaceEngine engine) {
  const auto toward = [&problem](OnPolygons& run, Answer<Rational>& answer) {
    return TryWeak(problem, run, answer);
  };
  return SolveOnPolygons(problem, request, engine, toward);
}

}  // namespace stiction
