// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "certify/exact/lemke_space.h"
#include "certify/exact/linear_equations.h"
#include "certify/exact/verify_solution.h"
#include "solver/problem/units.h"
#ifndef STICTION_BOOST_RATIONALS
#include "certify/exact/wide_ball.h"
#include "corpus/lifting.h"
#include "corpus/rounded.h"
#include "solver/complete/complete.ipp"
#endif

namespace stiction {

// ---- Words as linear equations ---------------------------------------------------------------

namespace {

// Numbers of the rows of a contact, from its first on.
using AtContact = std::pair<int, std::array<Rational, 3>>;

// M x = right
struct ModeSystem {
  std::vector<AtContact> columns;  // force per unit of an unknown
  ExactVector guess;               // of the unknowns
  ExactMatrix M;
  ExactVector right;

  ExactVector Forces(const ExactProblem& problem, const ExactVector& x) const {
    ExactVector f = ExactVector::Zero(problem.rows());
    for (int j = 0; j < x.size(); ++j) {
      const auto& [row, force] = columns[j];
      for (int k = 0; k < 3; ++k) {
        if (force[k] != 0) f[row + k] += x[j] * force[k];
      }
    }
    return f;
  }
};

// `edges`: along which friction and its acceleration are free beside their direction; zero where along none.
ModeSystem MakeSystem(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                      const ExactVector& guess, const std::vector<Planar<Rational>>& edges = {}) {
  ModeSystem system;
  std::vector<AtContact> rows;  // accelerations along these vanish
  std::vector<Rational> unknowns;
  ForEachContact(problem, [&](int i, int row, int) {
    const Contact<Rational>& contact = problem.contacts[i];
    const int held = modes[i].law == Law::kBreak ? 0 : modes[i].law == Law::kInside ? 3 : 1;
    for (int k = 0; k < held; ++k) {
      rows.push_back({row, {}});
      rows.back().second[k] = 1;
      system.columns.push_back(rows.back());
      unknowns.push_back(guess[row + k]);
    }
    if (held == 1 && contact.HasFrictionRows()) {
      const bool slips = modes[i].law == Law::kCorner;
      const Planar<Rational>& direction = slips ? modes[i].direction : contact.slip;
      const Rational factor = slips ? contact.mu : Rational(-contact.mu);
      for (int k = 0; k < 2; ++k) system.columns.back().second[1 + k] = factor * direction[k];
    }
    if (!edges.empty() && edges[i] != Planar<Rational>()) {
      rows.push_back({row, {Rational(0), edges[i][0], edges[i][1]}});
      system.columns.push_back(rows.back());
      unknowns.push_back(0);
    }
  });
  const int size = static_cast<int>(unknowns.size());
  system.guess.resize(size);
  system.M = ExactMatrix::Zero(size, size);
  system.right = ExactVector::Zero(size);
  for (int i = 0; i < size; ++i) {
    const auto& [row, along] = rows[i];
    system.guess[i] = unknowns[i];
    for (int r = 0; r < 3; ++r) {
      if (along[r] == 0) continue;
      system.right[i] -= along[r] * problem.b[row + r];
      for (int j = 0; j < size; ++j) {
        const auto& [column, force] = system.columns[j];
        for (int k = 0; k < 3; ++k) {
          if (force[k] != 0) system.M(i, j) += along[r] * force[k] * problem.A(row + r, column + k);
        }
      }
    }
  }
  return system;
}

#ifndef STICTION_BOOST_RATIONALS

// Of cells of polygons, where their equations have one solution.
std::optional<ExactVector> SolveCells(const ExactProblem& problem, const CellWord& word,
                                      const RationalPolygons& polygons) {
  std::vector<SpaceMode> modes;
  std::vector<Planar<Rational>> edges(word.size());
  for (std::size_t i = 0; i < word.size(); ++i) {
    modes.push_back({word[i].law, {Rational(0), Rational(0)}});
    if (word[i].law != Law::kCorner && word[i].law != Law::kEdge) continue;
    if (word[i].law == Law::kEdge) edges[i] = polygons[i].edge(word[i].side);
    modes[i] = {Law::kCorner, polygons[i].corner(word[i].side)};
  }
  const ModeSystem system = MakeSystem(problem, modes, ExactVector::Zero(problem.rows()), edges);
  if (system.columns.empty()) return ExactVector(ExactVector::Zero(problem.rows()));
  IntegerVector scale;
  const IntegerRows rows = InIntegers(system.M, scale);
  std::vector<Rational> right;
  for (std::size_t i = 0; i < rows.size(); ++i)
    right.emplace_back(system.right[static_cast<int>(i)] * scale[i]);
  const auto lifted = SolveLifted(rows, {right}, LiftingPrime(0));
  if (!lifted) return std::nullopt;
  const CommonFractions& fractions = lifted->front();
  ExactVector x(system.right.size());
  for (int j = 0; j < x.size(); ++j)
    x[j] = Fractions<Rational>::Quotient(fractions.numerators[j], fractions.denominator);
  return system.Forces(problem, x);
}

// Complete driving over balls: where they tell all signs the path is that over rationals. Its end is exact.
std::optional<OnPolygons> RunOverBalls(const ExactProblem& problem, const RationalPolygons& polygons,
                                       const Limits& limits) {
  thread_local CompleteDriving<WideBall> driving;
  driving.request().limits = limits;
  std::vector<FrictionPolygon<WideBall>> enclosed;
  for (const auto& polygon : polygons) enclosed.emplace_back(polygon, &BallAround<dd_real>);
  OnPolygons run;
  try {
    run.answer = AnswerOf<Rational>(driving.Run(Converted<WideBall>(problem, &BallAround<dd_real>), enclosed));
  } catch (const UnsureSign&) {
    return std::nullopt;
  }
  auto f = run.answer.Solved() ? SolveCells(problem, driving.word(), polygons) : std::nullopt;
  if (!f) return std::nullopt;
  run.word = driving.word();
  run.answer.a = Accelerations(problem, *f);
  run.answer.f = *std::move(f);
  return run;
}

#endif

}  // namespace

std::optional<ExactVector> SolveModes(const ExactProblem& problem, const std::vector<SpaceMode>& modes,
                                      const ExactVector& guess) {
  const ModeSystem system = MakeSystem(problem, modes, guess);
  const auto x = SolveEquations(system.M, system.right, system.guess);
  return x ? std::optional(system.Forces(problem, *x)) : std::nullopt;
}

OnPolygons RunSpace(const ExactProblem& problem, RationalPolygons polygons, const Limits& limits,
                    Trace<Rational>* trace) {
#ifndef STICTION_BOOST_RATIONALS
  if (auto run = trace == nullptr ? RunOverBalls(problem, polygons, limits) : std::nullopt) {
    run->polygons = std::move(polygons);
    return *std::move(run);
  }
#endif
  CompleteDriving<Rational> driving({.limits = limits});
  OnPolygons run = {AnswerOf<Rational>(driving.Run(problem, polygons, trace)), driving.word(),
                    std::move(polygons)};
  run.answer.f = driving.f();
  run.answer.a = driving.a();
  if (run.answer.outcome == Outcome::kRay) run.answer.ray = driving.ray();
  return run;
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
