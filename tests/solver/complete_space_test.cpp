// SPDX-License-Identifier: Apache-2.0
// Complete driving in space: what the proof promises of every path, and exact solutions of the polygonal law.

#include "solver/complete_space.ipp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "certify/properties.h"
#include "certify/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Driving = SpatialDriving<Rational>;
using Polygons = Driving::Polygons;

struct SpaceRun {
  CompleteVerdict verdict;
  Driving::Path path;
  ExactVector f, ray;
  SpaceWord word;
};

SpaceRun RunSpace(const ExactProblem& problem, const Polygons& polygons) {
  Driving driving;
  SpaceRun run;
  run.verdict = driving.Run(problem, polygons, &run.path);
  run.f = driving.f();
  run.ray = driving.ray();
  run.word = driving.word();
  return run;
}

Polygons AllWith(const ExactProblem& problem, int sides) {
  return Polygons(problem.contacts.size(), FrictionPolygon<Rational>(sides));
}

// A = J J' (+ I), b = J y or, where A is definite, anything. `size` bounds the entries: small ones tie.
ExactProblem RandomInSpace(const std::vector<Contact<Rational>>& contacts, int columns, int size, bool definite,
                           Choices& choices) {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = contacts;
  const int rows = RowCount(contacts, 3);
  ExactMatrix J(rows, columns);
  for (Rational& x : J.reshaped()) x = choices.Integer(-size, size);
  problem.A = J * J.transpose();
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) problem.b[i] = choices.Integer(-3 * size, size);
  if (definite) {
    for (int i = 0; i < rows; ++i) problem.A(i, i) += 1;
  } else {
    ExactVector y(columns);
    for (Rational& x : y) x = choices.Integer(-size, size);
    problem.b = J * y;
  }
  return problem;
}

std::vector<Contact<Rational>> StaticContacts(int count, Choices& choices) {
  static const std::vector<Rational> palette = {Rational(1, 5), Rational(1, 2), 1, 2, 5, 10};
  std::vector<Contact<Rational>> contacts;
  for (int i = 0; i < count; ++i)
    contacts.push_back({ContactKind::kStatic, palette[choices.Integer(0, 5)], {}});
  return contacts;
}

// ---- The law, from its definition alone --------------------------------------------------------

Planar<Rational> Tangential(const ExactVector& values, int row) { return {values[row + 1], values[row + 2]}; }

// fF is in mu fN times the polygon, and no corner has a smaller product with aF.
void CheckFriction(const FrictionPolygon<Rational>& polygon, const Rational& bound, const Planar<Rational>& f,
                   const Planar<Rational>& a) {
  for (int k = 0; k < polygon.sides(); ++k) {
    CHECK(Dot(polygon.normal(k), f) <= bound * polygon.reach(k));
    CHECK(Dot(f, a) <= bound * Dot(polygon.corner(k), a));
  }
}

void CheckLaw(const ExactProblem& problem, const Polygons& polygons, const ExactVector& f) {
  const ExactVector a = Accelerations(problem, f);
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) {
      CHECK(a[row] == 0);
    } else {
      CHECK(f[row] >= 0);
      CHECK(a[row] >= 0);
      CHECK(f[row] * a[row] == 0);
    }
    if (contact.kind == ContactKind::kStatic)
      CheckFriction(polygons[i], contact.mu * f[row], Tangential(f, row), Tangential(a, row));
    row += contact.HasFrictionRows() ? 3 : 1;
  }
}

// ---- The path --------------------------------------------------------------------------------

// Determinant of the reduced matrix of a word, from its definition.
int ReducedDeterminant(const ExactProblem& problem, const Polygons& polygons,
                       const SpacePiece<Rational>& piece) {
  std::vector<ExactVector> columns, rows;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const bool driven = static_cast<int>(i) == piece.driven && piece.stage == SpaceStage::kFriction;
    const auto unit = [&](Rational n, Planar<Rational> t = {0, 0}) {
      ExactVector v = ExactVector::Zero(problem.rows());
      v[row] = n;
      if (contact.HasFrictionRows()) {
        v[row + 1] = t[0];
        v[row + 2] = t[1];
      }
      return v;
    };
    const SpaceCell cell = piece.word[i];
    const Rational mu = driven ? Rational(0) : contact.mu;
    const auto corner = [&] {
      const Planar<Rational>& d = polygons[i].corner(cell.side);
      return unit(1, {mu * d[0], mu * d[1]});
    };
    switch (cell.law) {
      case Law::kNone:
      case Law::kBreak:
        break;
      case Law::kHold:
      case Law::kFree:
        columns.push_back(unit(1));
        rows.push_back(unit(1));
        break;
      case Law::kEdge:
        columns.push_back(unit(0, polygons[i].edge(cell.side)));
        rows.push_back(columns.back());
        [[fallthrough]];
      case Law::kCorner:
        columns.push_back(corner());
        rows.push_back(unit(1));
        break;
      case Law::kInside:
        for (const ExactVector& v : {unit(1), unit(0, {1, 0}), unit(0, {0, 1})}) {
          columns.push_back(v);
          rows.push_back(v);
        }
        break;
    }
    row += contact.HasFrictionRows() ? 3 : 1;
  }
  const int size = static_cast<int>(columns.size());
  ExactMatrix M(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) M(i, j) = rows[i].dot(ExactVector(problem.A * columns[j]));
  }
  int sign = 1;
  for (int k = 0; k < size; ++k) {
    int pivot = k;
    while (pivot < size && M(pivot, k) == 0) ++pivot;
    if (pivot == size) return 0;
    if (pivot != k) {
      M.row(k).swap(M.row(pivot));
      sign = -sign;
    }
    sign *= Sign(M(k, k));
    for (int i = k + 1; i < size; ++i) {
      const Rational factor = M(i, k) / M(k, k);
      for (int j = k; j < size; ++j) M(i, j) -= factor * M(k, j);
    }
  }
  return sign;
}

struct PathCounts {
  int folds = 0, descents = 0, ties = 0, flat = 0;
};

void CheckPath(const ExactProblem& problem, const Polygons& polygons, const SpaceRun& run, PathCounts& counts) {
  std::set<std::tuple<int, SpaceStage, SpaceWord>> visited;
  for (const auto& piece : run.path) {
    const int determinant = ReducedDeterminant(problem, polygons, piece);
    CHECK(piece.determinant == determinant);
    CHECK(Sign(piece.driven_rate) == determinant);
    CHECK(piece.da == ExactVector(problem.A * piece.df));
    CHECK(visited.emplace(piece.driven, piece.stage, piece.word).second);
    CHECK(piece.s >= 0);
    counts.flat += determinant == 0;
  }
  counts.folds += run.verdict.statistics.folds > 0;
  counts.descents += run.verdict.statistics.descents > 0;
  counts.ties += run.verdict.statistics.ties > 0;
}

// Nodes are left upward at index +1 and downward at index -1.
void CheckNodes(const ExactProblem& problem, const Polygons& polygons, const SpaceRun& run) {
  for (std::size_t k = 0; k < run.path.size(); ++k) {
    const auto& piece = run.path[k];
    if (piece.descends) CHECK(piece.determinant <= 0);
    if (!piece.ends && !piece.descends) continue;
    // The word of the node: the next piece of another stage holds all contacts before it in the same cells.
    SpacePiece<Rational> node = piece;
    node.stage = SpaceStage::kNone;
    if (piece.descends) {
      node.word[piece.driven] = {};
      if (piece.stage == SpaceStage::kFriction) node.word[piece.driven] = {Law::kFree, 0};
    } else if (piece.stage == SpaceStage::kNormal) {
      node.word[piece.driven] = {Law::kFree, 0};
    }
    CHECK(ReducedDeterminant(problem, polygons, node) == (piece.descends ? -1 : 1));
  }
}

void CheckSolved(const ExactProblem& problem, const Polygons& polygons, PathCounts& counts) {
  const SpaceRun run = RunSpace(problem, polygons);
  REQUIRE(run.verdict.outcome == Outcome::kSolved);
  CheckLaw(problem, polygons, run.f);
  CheckPath(problem, polygons, run, counts);
  CheckNodes(problem, polygons, run);
  std::int64_t words = 1;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) continue;
    words *= contact.kind == ContactKind::kStatic && contact.mu > 0 ? 2 * polygons[i].sides() + 2 : 2;
  }
  CHECK(run.verdict.statistics.pieces <= words - 1);
}

TEST_CASE("space: definite problems are solved, and every path is as the proof says") {
  PathCounts counts;
  for (int index = 0; index < 160; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const int n = 1 + index % 3;
    const auto contacts = StaticContacts(n, choices);
    const ExactProblem problem = RandomInSpace(contacts, 3 * n + 1, 1000, true, choices);
    CheckSolved(problem, AllWith(problem, index % 2 == 0 ? 8 : 4), counts);
  }
  CHECK(counts.ties == 0);
  CHECK(counts.folds > 3);
  CHECK(counts.descents > 0);
}

TEST_CASE("space: singular and degenerate problems are solved") {
  PathCounts counts;
  for (int index = 0; index < 240; ++index) {
    CAPTURE(index);
    Choices choices(5000 + index);
    const int n = 1 + index % 3;
    const auto contacts = StaticContacts(n, choices);
    const ExactProblem problem = RandomInSpace(contacts, 1 + index % 6, 1 + index % 3, false, choices);
    CheckSolved(problem, AllWith(problem, index % 2 == 0 ? 8 : 4), counts);
  }
  CHECK(counts.ties > 100);
  CHECK(counts.flat > 0);
}

}  // namespace
}  // namespace stiction
