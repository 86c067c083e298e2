// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/exact/cones.h"
#include "certify/exact/verify_solution.h"
#include "corpus/input_error.h"
#include "solver/problem/check.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

// Of v in K with A v = 0.
Obstacle MakeObstacle(const ExactProblem& problem, const ExactVector& v) {
  const Rational value = problem.b.dot(v);
  STICTION_CHECK((problem.A * v).isZero() && value < 0 && !FindConeViolation(problem, v),
                 "a linear program solved wrongly");
  return {v, value};
}

}  // namespace

bool HasSlidingContact(const ExactProblem& problem) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(),
                     [](const auto& contact) { return contact.kind == ContactKind::kSliding; });
}

std::optional<std::string> FindConeViolation(const ExactProblem& problem, const ExactVector& v) {
  return FindViolationApart(problem, v, ExactVector::Zero(v.size()));
}

std::optional<std::string> FindDualConeViolation(const ExactProblem& problem, const ExactVector& g) {
  std::optional<std::string> broken;
  ForEachContact(problem, [&](int i, int row, int rows) {
    const auto require = [&](bool holds, const char* condition, const Rational& found) {
      if (!holds && !broken)
        broken = fmt::format("contact {}: {} is broken, found {}", i + 1, condition, ToString(found));
    };
    const auto& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) require(g[row] == 0, "gN = 0", g[row]);
    require(g[row] >= 0, "gN >= 0", g[row]);
    Rational slack = g[row] * g[row];
    for (int k = 1; k < rows; ++k) slack -= contact.mu * contact.mu * g[row + k] * g[row + k];
    require(slack >= 0, "gN^2 - (mu gF)^2 >= 0", slack);
  });
  return broken;
}

ExactVector DualRest(const ExactProblem& problem, const ExactVector& y) {
  ExactVector rest = problem.b;
  for (int i = 0; i < problem.rows(); ++i) {
    if (y[i] == 0) continue;
    for (int j = 0; j < problem.rows(); ++j) {
      if (problem.A(i, j) != 0) rest[j] -= y[i] * problem.A(i, j);
    }
  }
  return rest;
}

namespace {

using Decision = std::variant<std::monostate, ExactVector, Obstacle>;

// Is there a v = edges x, x >= 0, with A v = 0 and b'v = -1? If not, a combination c of these equations has
// c'A E - (multiple of b)'E <= 0 in every edge, which is y after scaling.
Decision SeekObstacle(const ExactProblem& problem, RationalPolygons& polygons) {
  const std::vector<ConeEdge> edges = MakeEdges(problem, polygons, EdgesOf::kWithinCone);
  const int rows = problem.rows();
  std::vector<bool> free;
  std::vector<RationalRow> system(rows + 1);
  system.back().constant = 1;
  for (const ConeEdge& edge : edges) {
    free.push_back(edge.free);
    for (int i = 0; i < rows; ++i) system[i].coefficients.push_back(Along(edge, problem.A, i));
    system.back().coefficients.push_back(Along(edge, problem.b));
  }
  const auto answer = Solve(free, system);
  if (const Point* x = std::get_if<Point>(&answer)) return MakeObstacle(problem, Combined(edges, *x, rows));
  const std::vector<Rational>& combination = std::get<Multipliers>(answer).values;
  STICTION_CHECK(combination.back() < 0, "a combination that shows nothing");
  ExactVector y(rows);
  for (int i = 0; i < rows; ++i) y[i] = -combination[i] / combination.back();
  const ExactVector rest = DualRest(problem, y);
  const auto violation = FindDualConeViolation(problem, rest);
  if (!violation) return y;
  STICTION_CHECK(problem.dimension == 3, "a Farkas vector of a linear program is wrong: " + *violation);
  AddCorners(problem, EdgesOf::kWithinCone, rest, polygons);
  return {};
}

// Are there y and g = edges x, x >= 0, with A'y + g = b? If not, a combination -v of these equations has A v =
// 0, b'v < 0, and v.e >= 0 in every edge e.
Decision SeekProof(const ExactProblem& problem, RationalPolygons& polygons) {
  const std::vector<ConeEdge> edges = MakeEdges(problem, polygons, EdgesOf::kWithinDualCone);
  const int rows = problem.rows();
  std::vector<bool> free(rows, true);
  std::vector<RationalRow> system(rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) system[i].coefficients.push_back(problem.A(j, i));
    system[i].coefficients.resize(rows + edges.size(), 0);
    system[i].constant = -problem.b[i];
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    free.push_back(edges[k].free);
    for (std::size_t j = 0; j < edges[k].values.size(); ++j)
      system[edges[k].row + j].coefficients[rows + k] = edges[k].values[j];
  }
  const auto answer = Solve(free, system);
  ExactVector found(rows);
  if (const Point* x = std::get_if<Point>(&answer)) {
    for (int i = 0; i < rows; ++i) found[i] = (*x)[i];
    STICTION_CHECK(!FindDualConeViolation(problem, DualRest(problem, found)),
                   "a linear program solved wrongly");
    return found;
  }
  for (int i = 0; i < rows; ++i) found[i] = -std::get<Multipliers>(answer).values[i];
  if (!FindConeViolation(problem, found)) return MakeObstacle(problem, found);
  AddCorners(problem, EdgesOf::kWithinDualCone, found, polygons);
  return {};
}

}  // namespace

Decision DecideHypothesis(const ExactProblem& problem) {
  constexpr int kRounds = 10;
  if (HasSlidingContact(problem))
    throw InputError("claim h: decided for bilateral, frictionless and static contacts only");
  RationalPolygons polygons = FirstPolygons(problem);
  for (int round = 0; round < kRounds; ++round) {
    for (const auto seek : {SeekObstacle, SeekProof}) {
      Decision decision = seek(problem, polygons);
      if (!std::holds_alternative<std::monostate>(decision)) return decision;
    }
  }
  return {};
}

}  // namespace stiction
