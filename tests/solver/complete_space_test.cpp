// SPDX-License-Identifier: Apache-2.0
// Complete driving in space: what the proof promises of every path, and exact solutions of the polygonal law.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "solver/complete/complete.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Driving = CompleteDriving<Rational>;
using Polygons = Driving::Polygons;

// A piece of the path, its word taken apart.
struct SpacePiece {
  int driven = 0;  // contact
  bool friction = false;
  CellWord word;
  int drive = 0, determinant = 0;
  PathTurn turn = PathTurn::kNone;
  ExactVector df, da;
  Rational s;
  bool ends = false, descends = false;  // the stage
};

struct SpaceRun {
  RunEnd<> verdict;
  std::vector<SpacePiece> path;
  std::int64_t most_pieces = 0;
  ExactVector f, ray;
  CellWord word;
};

LawCell ParseCell(const std::string& name) {
  const std::string kLaws = "?HB0VEI";
  return {static_cast<Law>(kLaws.find(name[0])), name.size() > 1 ? std::stoi(name.substr(1)) : 0};
}

SpacePiece PieceOf(const ExactProblem& problem, const Pivot<Rational>& pivot) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts, 3);
  std::istringstream names(pivot.word);
  CellWord word;
  for (std::string name; names >> name;) word.push_back(ParseCell(name));
  return {layout.ContactOf(pivot.driven),
          !layout.IsNormal(pivot.driven),
          word,
          pivot.drive,
          pivot.determinant,
          pivot.turn,
          pivot.df,
          pivot.da,
          pivot.s,
          false,
          false};
}

SpaceRun RunSpace(const ExactProblem& problem, const Polygons& polygons) {
  Driving driving;
  SpaceRun run;
  Trace<Rational> trace;
  run.verdict = driving.Run(problem, polygons, &trace);
  for (const auto& pivot : trace.pivots) {
    run.path.push_back(PieceOf(problem, pivot));
    if (run.path.size() == 1 || run.path.end()[-2].drive == pivot.drive) continue;
    run.path.end()[-2].descends = pivot.turn == PathTurn::kDescent;
    run.path.end()[-2].ends = pivot.turn != PathTurn::kDescent;
  }
  if (!run.path.empty()) run.path.back().ends = run.verdict.outcome == Outcome::kSolved;
  run.most_pieces = driving.most_pieces();
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

int RankOf(const ExactProblem& problem, const std::vector<int>& rows) {
  Elimination<Rational> elimination;
  elimination.Assign(ExactMatrix(problem.A(rows, rows)));
  const int size = static_cast<int>(rows.size());
  elimination.Run(size, size, size);
  return elimination.rank();
}

// Whether a bilateral contact depends on those before it.
bool IsDependent(const ExactProblem& problem, int contact) {
  std::vector<int> rows;
  int row = 0;
  for (int i = 0; i <= contact; ++i) {
    if (problem.contacts[i].kind == ContactKind::kBilateral) rows.push_back(row);
    row += problem.contacts[i].HasFrictionRows() ? 3 : 1;
  }
  const std::vector<int> before(rows.begin(), rows.end() - 1);
  return RankOf(problem, rows) == RankOf(problem, before);
}

// Determinant of the reduced matrix of a word, from its definition.
int ReducedDeterminant(const ExactProblem& problem, const Polygons& polygons, const SpacePiece& piece) {
  std::vector<ExactVector> columns, rows;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const bool driven = static_cast<int>(i) == piece.driven && piece.friction;
    const auto unit = [&](Rational n, Planar<Rational> t = {0, 0}) {
      ExactVector v = ExactVector::Zero(problem.rows());
      v[row] = n;
      if (contact.HasFrictionRows()) {
        v[row + 1] = t[0];
        v[row + 2] = t[1];
      }
      return v;
    };
    const LawCell cell = piece.word[i];
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
        if (IsDependent(problem, static_cast<int>(i))) break;
        [[fallthrough]];
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
  std::set<std::tuple<int, bool, CellWord>> visited;
  for (const auto& piece : run.path) {
    const int determinant = ReducedDeterminant(problem, polygons, piece);
    CHECK(piece.determinant == determinant);
    CHECK(piece.da == ExactVector(problem.A * piece.df));
    CHECK(visited.emplace(piece.driven, piece.friction, piece.word).second);
    CHECK(piece.s >= 0);
    counts.flat += determinant == 0;
  }
  counts.folds += run.verdict.statistics[Counter::kFolds] > 0;
  counts.descents += run.verdict.statistics[Counter::kDescents] > 0;
  counts.ties += run.verdict.statistics[Counter::kTies] > 0;
}

// Nodes are left upward at index +1 and downward at index -1.
void CheckNodes(const ExactProblem& problem, const Polygons& polygons, const SpaceRun& run) {
  for (std::size_t k = 0; k < run.path.size(); ++k) {
    const auto& piece = run.path[k];
    if (piece.descends) CHECK(piece.determinant <= 0);
    if (!piece.ends && !piece.descends) continue;
    // The word of the node: the next piece of another stage holds all contacts before it in the same cells.
    SpacePiece node = piece;
    node.friction = false;
    if (piece.descends) {
      node.word[piece.driven] = {};
      if (piece.friction) node.word[piece.driven] = {Law::kFree, 0};
    } else if (!piece.friction) {
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
  std::int64_t words = 1, cells_of_stages = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) continue;
    const bool rough = contact.kind == ContactKind::kStatic && contact.mu > 0;
    cells_of_stages += words * (rough ? 1 + 2 * polygons[i].sides() + 1 : 1);
    words *= rough ? 2 * polygons[i].sides() + 2 : 2;
  }
  CHECK(run.verdict.statistics[Counter::kPieces] <= cells_of_stages);
  CHECK(run.most_pieces == cells_of_stages);
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
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    Choices choices(5000 + index);
    const int n = 1 + index % 3;
    const auto contacts = StaticContacts(n, choices);
    const ExactProblem problem = RandomInSpace(contacts, 1 + index % 6, 1 + index % 3, false, choices);
    CheckSolved(problem, AllWith(problem, index % 2 == 0 ? 8 : 4), counts);
  }
  CHECK(counts.ties > 100);
}

TEST_CASE("space: where the reduced determinant is zero, the path goes on") {
  PathCounts counts;
  for (int index = 0; index < 400; ++index) {
    CAPTURE(index);
    Choices choices(15000 + index);
    auto contacts = StaticContacts(2, choices);
    for (auto& contact : contacts) contact.mu = choices.Integer(1, 3);
    const ExactProblem problem = RandomInSpace(contacts, 6, 1, true, choices);
    CheckSolved(problem, AllWith(problem, 4), counts);
  }
  CHECK(counts.flat > 0);
}

TEST_CASE("space: four contacts, more corners, corners of one's own") {
  PathCounts counts;
  for (int index = 0; index < 12; ++index) {
    CAPTURE(index);
    Choices choices(9000 + index);
    const auto contacts = StaticContacts(4, choices);
    const ExactProblem problem = RandomInSpace(contacts, index % 2 == 0 ? 13 : 6, 5, index % 2 == 0, choices);
    Polygons polygons = AllWith(problem, 4 + 4 * (index % 3));
    CHECK(polygons[1].Insert(OnCircle(Rational(1, 7))));
    CHECK(polygons[2].Insert(OnCircle(Rational(-9, 4))));
    CheckSolved(problem, polygons, counts);
  }
}

// The kinds of all four, and smooth static contacts.
std::vector<Contact<Rational>> MixedContacts(int count, Choices& choices) {
  std::vector<Contact<Rational>> contacts = StaticContacts(count, choices);
  for (auto& contact : contacts) {
    const auto pick = choices.Integer(0, 4);
    if (pick == 0) contact = {ContactKind::kBilateral, 0, {}};
    if (pick == 1) contact = {ContactKind::kFrictionless, 0, {}};
    if (pick == 2) contact.mu = 0;
  }
  return contacts;
}

TEST_CASE("space: bilateral, frictionless, smooth and static contacts mix, degenerate or not") {
  PathCounts counts;
  int held = 0;
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    Choices choices(20000 + index);
    const auto contacts = MixedContacts(2 + index % 3, choices);
    for (const auto& contact : contacts) held += contact.kind == ContactKind::kBilateral;
    const ExactProblem problem =
        RandomInSpace(contacts, 2 + index % 5, index % 2 == 0 ? 1 : 50, index % 3 == 0, choices);
    CheckSolved(problem, AllWith(problem, 4), counts);
  }
  CHECK(held > 100);
  CHECK(counts.ties > 30);
}

// b + e e_N + (e^2, e^3, ...) for a number e that is small enough here.
ExactProblem PerturbedInSpace(ExactProblem problem) {
  Rational e = 1;
  mpz_mul_2exp(e.get_den_mpz_t(), e.get_den_mpz_t(), 300);
  Rational power = e;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    problem.b[row] += e;
    for (const int end = row + (contact.HasFrictionRows() ? 3 : 1); row < end; ++row) {
      power *= e;
      problem.b[row] += power;
    }
  }
  return problem;
}

TEST_CASE("space: ties are told as a small perturbation of b tells them") {
  int tied = 0;
  for (int index = 0; index < 120; ++index) {
    CAPTURE(index);
    Choices choices(60000 + index);
    const int n = 1 + index % 3;
    const ExactProblem problem = RandomInSpace(StaticContacts(n, choices), 1 + index % 6, 1, false, choices);
    const Polygons polygons = AllWith(problem, index % 2 == 0 ? 8 : 4);
    const SpaceRun symbolic = RunSpace(problem, polygons), real = RunSpace(PerturbedInSpace(problem), polygons);
    tied += symbolic.verdict.statistics[Counter::kTies] > 0;
    CHECK(real.verdict.statistics[Counter::kTies] == 0);
    REQUIRE(symbolic.path.size() == real.path.size());
    for (std::size_t k = 0; k < real.path.size(); ++k) {
      CHECK(symbolic.path[k].word == real.path[k].word);
      CHECK(symbolic.path[k].df == real.path[k].df);
    }
    CHECK(symbolic.word == real.word);
  }
  CHECK(tied > 50);
}

TEST_CASE("space: bilateral contacts that contradict each other are a ray") {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts.assign(2, {ContactKind::kBilateral, 0, {}});
  problem.A = Matrix({{2, 2}, {2, 2}});
  problem.b = Vector({1, 1});
  const Polygons polygons = AllWith(problem, 4);
  const SpaceRun agreed = RunSpace(problem, polygons);
  CHECK(agreed.verdict.outcome == Outcome::kSolved);
  CHECK(agreed.f == Vector({Rational(-1, 2), 0}));
  problem.b = Vector({1, 2});
  const SpaceRun torn = RunSpace(problem, polygons);
  CHECK(torn.verdict.outcome == Outcome::kRay);
  CHECK(torn.ray == Vector({1, -1}));
}

// A stage of n has a cell for its normal and 2K + 1 for its friction with every word of the contacts before.
TEST_CASE("space: the bound of the pieces is the number of the cells of all stages") {
  Choices choices(3);
  const std::array<std::int64_t, 3> of_square = {10, 110, 1110};
  for (int n = 1; n <= 3; ++n) {
    const ExactProblem problem = RandomInSpace(StaticContacts(n, choices), 3 * n + 1, 1000, true, choices);
    Driving driving;
    driving.Run(problem, AllWith(problem, 4));
    CHECK(driving.most_pieces() == of_square[n - 1]);
  }
}

TEST_CASE("space: a budget ends the run") {
  Choices choices(1);
  const ExactProblem problem = RandomInSpace(StaticContacts(3, choices), 10, 1000, true, choices);
  Driving driving;
  driving.request().limits.pivots = 2;
  const RunEnd<> verdict = driving.Run(problem, AllWith(problem, 8));
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.statistics[Counter::kPieces] == 2);
}

TEST_CASE("space: doubles take the exact path, or are undecided") {
  int same = 0, undecided = 0;
  for (int index = 0; index < 200; ++index) {
    CAPTURE(index);
    Choices choices(70000 + index);
    const int n = 1 + index % 4;
    const ExactProblem problem = RandomInSpace(StaticContacts(n, choices), 3 * n + 1, index % 2 == 0 ? 1000 : 2,
                                               index % 2 == 0, choices);
    const Polygons polygons = AllWith(problem, 8);
    CompleteDriving<double>::Polygons rounded;
    for (const auto& polygon : polygons)
      rounded.emplace_back(polygon, [](const Rational& x) { return ToDouble(x); });
    CompleteDriving<double> driving;
    const RunEnd<> verdict = driving.Run(As<double>(problem), rounded);
    undecided += verdict.outcome == Outcome::kUndecided;
    if (verdict.outcome != Outcome::kSolved) continue;
    same += driving.word() == RunSpace(problem, polygons).word;
  }
  CHECK(undecided < 20);
  CHECK(same > 150);
}

// ---- Polygons --------------------------------------------------------------------------------

TEST_CASE("polygon: corners are points of the circle, in order, symmetric to quarter turns") {
  for (const int sides : {4, 8, 12, 32}) {
    const FrictionPolygon<Rational> polygon(sides);
    REQUIRE(polygon.sides() == sides);
    for (int k = 0; k < sides; ++k) {
      CHECK(Dot(polygon.corner(k), polygon.corner(k)) == 1);
      CHECK(Cross(polygon.corner(k), polygon.corner(k + 1)) > 0);
      CHECK(polygon.corner(k + sides / 4) == Planar<Rational>{-polygon.corner(k)[1], polygon.corner(k)[0]});
      CHECK(Dot(polygon.normal(k), polygon.corner(k)) == polygon.reach(k));
      CHECK(Dot(polygon.normal(k), polygon.corner(k + 1)) == polygon.reach(k));
    }
  }
  CHECK(InnerRadiusSquared(FrictionPolygon<Rational>(4)) == Rational(1, 2));
  CHECK(InnerRadiusSquared(FrictionPolygon<Rational>(8)) == Rational(4, 5));
  CHECK(InnerRadiusSquared(FrictionPolygon<Rational>(16)) == Rational(16, 17));
  CHECK_THROWS_AS(FrictionPolygon<Rational>(6), InternalError);
}

TEST_CASE("polygon: a corner is added once, in its place") {
  FrictionPolygon<Rational> polygon(4);
  const Planar<Rational> corner = OnCircle(Rational(-3));  // in the third quadrant
  CHECK(polygon.Insert(corner));
  CHECK(!polygon.Insert(corner));
  CHECK(!polygon.Insert({Rational(0), Rational(1)}));
  REQUIRE(polygon.sides() == 5);
  CHECK(polygon.corner(3) == corner);
  CHECK(polygon.reach(4) == Cross(polygon.corner(4), polygon.corner(0)));
}

TEST_CASE("polygon: a contact that pulls has no friction to spend") {
  ExactProblem problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, 1, {}}};
  problem.A = ExactMatrix::Identity(3, 3);
  problem.b = Vector({1, -2, -2});
  const ExactVector f = Vector({-1, 2, 2});
  const ExactVector a = Accelerations(problem, f);
  REQUIRE(a == Vector({0, 0, 0}));
  CHECK(PolygonErrorOf(problem, Polygons{FrictionPolygon<Rational>(8)}, f, a) == 1);  // all that is asked
}

TEST_CASE("polygon: the projection is the nearest point") {
  Choices choices(11);
  for (int index = 0; index < 300; ++index) {
    const FrictionPolygon<Rational> polygon(4 + 4 * (index % 3));
    const Rational radius = choices.Integer(0, 3);
    const Planar<Rational> x = {choices.Integer(-5, 5), choices.Integer(-5, 5)}, p = polygon.Project(x, radius);
    const Planar<Rational> gap = {x[0] - p[0], x[1] - p[1]};
    for (int k = 0; k < polygon.sides(); ++k) {
      CHECK(Dot(polygon.normal(k), p) <= radius * polygon.reach(k));
      CHECK(radius * Dot(gap, polygon.corner(k)) <= Dot(gap, p));  // no corner is nearer to x
    }
  }
}

// ---- Null vectors ----------------------------------------------------------------------------

// The oriented null vector by way of a direction: M's rows are those of A, its last column that of the driven
// one.
std::optional<ExactVector> NullVector(const ExactMatrix& M) {
  const int k = static_cast<int>(M.rows());
  ExactProblem problem;
  problem.contacts.assign(k + 1, {ContactKind::kFrictionless, 0, {}});
  problem.A = ExactMatrix::Zero(k + 1, k + 1);
  problem.A.topRows(k) = M;
  problem.b = ExactVector::Zero(k + 1);
  ListedUnknowns<Rational, Eigen::Dynamic> unknowns;
  unknowns.Start(problem);
  const auto unit = [](int row) { return RowCombination<Rational>::Unit(row); };
  for (int row = 0; row < k; ++row) unknowns.forces[row] = unknowns.rests[row] = unit(row);
  unknowns.driven = unit(k);
  DirectionSystem<Rational, Eigen::Dynamic> system;
  system.Start(problem);
  const auto determinant = system.SolveOriented(problem, unknowns, Scale<Rational>());
  if (!determinant) return std::nullopt;
  CHECK(*determinant == Sign(system.df()[k]));
  return system.df();
}

TEST_CASE("null vector: components are the minors, up to one positive factor") {
  Choices choices(7);
  int singular = 0, dependent = 0;
  for (int index = 0; index < 400; ++index) {
    const int k = 1 + index % 4;
    Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic> M(k, k + 1);
    for (Rational& x : M.reshaped()) x = choices.Integer(-1, 1);
    const auto minor = [&M, k](int without) {
      ExactMatrix square(k, k);
      for (int j = 0, to = 0; j <= k; ++j) {
        if (j != without) square.col(to++) = M.col(j);
      }
      std::vector<int> order(k);
      Rational sum = 0;  // over all permutations
      for (int i = 0; i < k; ++i) order[i] = i;
      do {
        Rational product = 1;
        for (int i = 0; i < k; ++i) {
          product *= square(i, order[i]);
          for (int j = 0; j < i; ++j) {
            if (order[j] > order[i]) product = -product;
          }
        }
        sum += product;
      } while (std::next_permutation(order.begin(), order.end()));
      return sum;
    };
    std::vector<Rational> wanted;
    for (int j = 0; j <= k; ++j) wanted.push_back(((k - j) % 2 == 0 ? 1 : -1) * minor(j));
    const auto z = NullVector(M);
    const bool zero = std::all_of(wanted.begin(), wanted.end(), [](const Rational& x) { return x == 0; });
    CHECK(z.has_value() == !zero);
    dependent += zero;
    if (!z) continue;
    singular += wanted[k] == 0;
    for (int i = 0; i <= k; ++i) {
      CHECK(Sign((*z)[i]) == Sign(wanted[i]));
      for (int j = 0; j < i; ++j) CHECK((*z)[i] * wanted[j] == (*z)[j] * wanted[i]);
    }
  }
  CHECK(singular > 20);
  CHECK(dependent > 20);
}

}  // namespace
}  // namespace stiction
