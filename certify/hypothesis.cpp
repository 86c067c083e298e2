// SPDX-License-Identifier: Apache-2.0
#include "certify/hypothesis.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/linear_system.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

std::optional<std::string> Broken(std::size_t contact, const char* condition, const Rational& found) {
  return fmt::format("contact {}: {} is broken, found {}", contact + 1, condition, ToString(found));
}

// Rows of the tangents: their sum of squares.
Rational SquareOfTangent(const ExactVector& x, int row, int dimension) {
  Rational square = 0;
  for (int k = 1; k < dimension; ++k) square += x[row + k] * x[row + k];
  return square;
}

// An extreme ray of the cone of a planar contact: (1, tangent) in its rows; or a line.
struct Edge {
  int row;
  Rational tangent;
  bool rough, free;
};

std::vector<Edge> EdgesOf(const ExactProblem& problem) {
  std::vector<Edge> edges;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const bool rough = contact.HasFrictionRows();
    edges.push_back({row, contact.mu, rough, contact.kind == ContactKind::kBilateral});
    if (contact.mu > 0) edges.push_back({row, -contact.mu, rough, false});
    row += rough ? 2 : 1;
  }
  return edges;
}

Rational Along(const Edge& edge, const Rational& normal, const Rational& tangential) {
  return edge.rough && edge.tangent != 0 ? Rational(normal + edge.tangent * tangential) : normal;
}

// `values`, the last of them the constant, as integers; `scale` is the factor > 0.
LinearSystem::Row IntegerRow(const std::vector<Rational>& values, mpz_class& scale) {
  scale = 1;
  for (const Rational& x : values) scale = lcm(scale, x.get_den());
  LinearSystem::Row row{{}, 0, Relation::kZero};
  for (const Rational& x : values) row.coefficients.push_back(mpz_class(x.get_num() * (scale / x.get_den())));
  row.constant = row.coefficients.back();
  row.coefficients.pop_back();
  return row;
}

HypothesisObstacle MakeObstacle(const ExactProblem& problem, const std::vector<Edge>& edges, const Point& x) {
  HypothesisObstacle obstacle{ExactVector::Constant(problem.rows(), Rational(0)), 0};
  for (std::size_t k = 0; k < edges.size(); ++k) {
    obstacle.v[edges[k].row] += x[k];
    if (edges[k].rough) obstacle.v[edges[k].row + 1] += edges[k].tangent * x[k];
  }
  bool in_kernel = true;
  for (int i = 0; i < problem.rows(); ++i) {
    Rational image = 0;
    for (int j = 0; j < problem.rows(); ++j) image += problem.A(i, j) * obstacle.v[j];
    in_kernel &= image == 0;
    obstacle.value += problem.b[i] * obstacle.v[i];
  }
  STICTION_CHECK(in_kernel && obstacle.value < 0 && !FindConeViolation(problem, obstacle.v),
                 "a linear program solved wrongly");
  return obstacle;
}

}  // namespace

bool HasSlidingContact(const ExactProblem& problem) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(),
                     [](const auto& contact) { return contact.kind == ContactKind::kSliding; });
}

std::optional<std::string> FindConeViolation(const ExactProblem& problem, const ExactVector& v) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (contact.kind != ContactKind::kBilateral && v[row] < 0) return Broken(i, "vN >= 0", v[row]);
    if (!contact.HasFrictionRows()) {
      ++row;
      continue;
    }
    const Rational bound = contact.mu * v[row];
    const Rational slack = bound * bound - SquareOfTangent(v, row, problem.dimension);
    if (slack < 0) return Broken(i, "(mu vN)^2 - vF^2 >= 0", slack);
    row += problem.dimension;
  }
  return std::nullopt;
}

std::optional<std::string> FindDualConeViolation(const ExactProblem& problem, const ExactVector& g) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral && g[row] != 0) return Broken(i, "gN = 0", g[row]);
    if (g[row] < 0) return Broken(i, "gN >= 0", g[row]);
    if (!contact.HasFrictionRows()) {
      ++row;
      continue;
    }
    const Rational square = contact.mu * contact.mu * SquareOfTangent(g, row, problem.dimension);
    const Rational slack = g[row] * g[row] - square;
    if (slack < 0) return Broken(i, "gN^2 - (mu gF)^2 >= 0", slack);
    row += problem.dimension;
  }
  return std::nullopt;
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

// Is there a v = edges x, x >= 0, with A v = 0 and b'v = -1? If not, a combination c of these equations has
// c'A E - (multiple of b)'E <= 0 in every edge, which is y after scaling.
std::variant<HypothesisProof, HypothesisObstacle> DecideHypothesis(const ExactProblem& problem) {
  if (problem.dimension != 2 || HasSlidingContact(problem)) {
    throw InputError(
        "claim h: decided for planar problems of bilateral, frictionless and static contacts only");
  }
  const std::vector<Edge> edges = EdgesOf(problem);
  const int rows = problem.rows();
  LinearSystem system;
  std::vector<mpz_class> scales(rows + 1);
  for (const Edge& edge : edges) system.free.push_back(edge.free);
  for (int i = 0; i <= rows; ++i) {
    std::vector<Rational> values;
    for (const Edge& edge : edges) {
      const int tangent = edge.rough ? edge.row + 1 : edge.row;
      values.push_back(i < rows ? Along(edge, problem.A(i, edge.row), problem.A(i, tangent))
                                : Along(edge, problem.b[edge.row], problem.b[tangent]));
    }
    values.push_back(i < rows ? 0 : 1);
    system.rows.push_back(IntegerRow(values, scales[i]));
  }
  const auto answer = Solve(system);
  if (const Point* x = std::get_if<Point>(&answer)) return MakeObstacle(problem, edges, *x);
  const Combination& combination = std::get<Combination>(answer);
  const Rational last = -Rational(combination.back() * scales.back());
  STICTION_CHECK(last > 0, "a combination that shows nothing");
  HypothesisProof proof{ExactVector(rows)};
  for (int i = 0; i < rows; ++i) proof.y[i] = Rational(combination[i] * scales[i]) / last;
  const auto violation = FindDualConeViolation(problem, DualRest(problem, proof.y));
  STICTION_CHECK(!violation, "a Farkas vector of a linear program is wrong: " + violation.value_or(""));
  return proof;
}

}  // namespace stiction
