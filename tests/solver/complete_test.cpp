// SPDX-License-Identifier: Apache-2.0
// Complete driving: known paths, what the proof promises of every path, and no wrong answers.

#include "solver/complete/complete.ipp"

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

#include "certify/exact/verify_solution.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Complete = CompleteDriving<Rational>;

struct CompleteRun {
  RunEnd<> verdict;
  std::vector<Pivot<Rational>> path;
  ExactVector f;
  std::string word;
  ExactVector ray;
};

CompleteRun RunComplete(const ExactProblem& problem) {
  Complete algorithm;
  CompleteRun run;
  Trace<Rational> trace;
  run.verdict = algorithm.Run(problem, &trace);
  run.path = trace.pivots;
  run.f = algorithm.f();
  run.word = algorithm.Word();
  run.ray = algorithm.ray();
  return run;
}

// A problem of static contacts, positive definite; numbers so large that ties are improbable.
ExactProblem RandomDefinite(int contacts, std::uint64_t seed) {
  static const std::vector<Rational> palette = {Rational(1, 5), Rational(1, 2), 1, 2, 5, 10};
  Choices choices(seed);
  ExactProblem problem = RandomFrictionless(2 * contacts, seed);
  problem.contacts.clear();
  const auto pick = [&] { return palette[choices.Integer(0, 5)]; };
  const bool single = choices.Integer(0, 1) == 0;
  const Rational mu = pick();
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, single ? mu : pick(), {}});
  for (int i = 0; i < contacts; ++i) problem.b[2 * i + 1] += 350000;  // frictions on either side
  return problem;
}

// ---- The reduced determinant, apart from the solver's elimination ----------------------------

int DeterminantSign(std::vector<ExactVector> columns) {
  int sign = 1;
  const std::size_t size = columns.size();
  for (std::size_t k = 0; k < size; ++k) {
    std::size_t pivot = k;
    while (pivot < size && columns[pivot][k] == 0) ++pivot;
    if (pivot == size) return 0;
    if (pivot != k) {
      std::swap(columns[pivot], columns[k]);
      sign = -sign;
    }
    sign *= Sign(columns[k][k]);
    for (std::size_t j = k + 1; j < size; ++j) {
      const Rational factor = columns[j][k] / columns[k][k];
      for (std::size_t i = k; i < size; ++i) columns[j][i] -= factor * columns[k][i];
    }
  }
  return sign;
}

// The reduced matrix by columns, and what its unknowns must balance.
struct Reduced {
  std::vector<int> unknowns;
  std::vector<ExactVector> columns;
  ExactVector right;
};

Reduced ReducedSystem(const ExactProblem& problem, const std::vector<IndexSet>& sets) {
  const auto layout = LayoutOf(problem);
  Reduced reduced;
  for (int row = 0; row < problem.rows(); ++row) {
    if (IsUnknown(sets[row])) reduced.unknowns.push_back(row);
  }
  const ExactVector load = -problem.b;
  reduced.right = load(reduced.unknowns);
  for (const int column : reduced.unknowns) {
    ExactVector entries = problem.A(reduced.unknowns, column);
    if (layout.IsNormal(column) && layout.HasFriction(column)) {
      const Rational along = LimitSign(sets[column + 1]) * problem.contacts[layout.ContactOf(column)].mu;
      for (int i = 0; i < entries.size(); ++i) entries[i] += along * problem.A(reduced.unknowns[i], column + 1);
    }
    reduced.columns.push_back(entries);
  }
  return reduced;
}

int ReducedDeterminant(const ExactProblem& problem, const std::vector<IndexSet>& sets) {
  return DeterminantSign(ReducedSystem(problem, sets).columns);
}

template <class Scalar>
bool EndsStage(const Pivot<Scalar>& piece) {
  return piece.limiting == piece.driven;
}

// Of the driven variable: -1 in the cell - of a friction stage.
int SideOf(const ExactProblem& problem, const Pivot<Rational>& piece) {
  const int contact = LayoutOf(problem).ContactOf(piece.driven);
  return piece.word[2 * contact] == '-' ? -1 : 1;
}

template <class Scalar>
bool Descends(const Pivot<Scalar>& piece) {
  return EndsStage(piece) && piece.to == IndexSet::kNone;
}

// The sets during a piece of the plane's path, from its word; `driven`: the row of the variable that is in
// none.
std::vector<IndexSet> SetsDuring(std::string_view word, const std::vector<Contact<Rational>>& contacts,
                                 int driven) {
  constexpr std::string_view kNames = "B+-S0H";
  constexpr std::array<LawCell, 6> kCells = {{{Law::kBreak, 0},
                                              {Law::kCorner, 0},
                                              {Law::kCorner, 1},
                                              {Law::kInside, 0},
                                              {Law::kFree, 0},
                                              {Law::kHold, 0}}};
  std::vector<IndexSet> sets;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::size_t name = kNames.find(word[2 * i]);
    const auto of_contact = SetsOf(name == std::string_view::npos ? LawCell() : kCells[name]);
    sets.push_back(of_contact[0]);
    if (contacts[i].HasFrictionRows()) sets.push_back(of_contact[1]);
  }
  sets[driven] = IndexSet::kNone;
  return sets;
}

// What complete_driving.md proves of a path.
void CheckPath(const ExactProblem& problem, const CompleteRun& run) {
  std::set<std::pair<int, std::string>> visited;
  std::int64_t descents = 0, folds = 0;
  int before = 0, drive = 0;  // the determinant before that was not zero, and its stage
  for (const Pivot<Rational>& piece : run.path) {
    // Orientation: side f_v moves with the sign of the determinant.
    const int determinant = ReducedDeterminant(problem, SetsDuring(piece.word, problem.contacts, piece.driven));
    CHECK(piece.determinant == determinant);
    CHECK(Sign(piece.df[piece.driven]) == SideOf(problem, piece) * determinant);
    ExactProblem unloaded = problem;
    for (Rational& x : unloaded.b) x = 0;
    CHECK(piece.da == Accelerations(unloaded, piece.df));
    CHECK(visited.emplace(piece.driven, piece.word).second);
    const bool enters = piece.drive != drive;
    CHECK((piece.turn == PathTurn::kFold) == (!enters && determinant * before < 0));
    if (enters || determinant != 0) before = determinant;
    drive = piece.drive;
    folds += piece.turn == PathTurn::kFold;
    if (EndsStage(piece)) CHECK(ReducedDeterminant(problem, piece.sets) == (Descends(piece) ? -1 : 1));
    descents += Descends(piece);
    CHECK(piece.s >= 0);
  }
  CHECK(run.verdict.statistics[Counter::kPieces] == static_cast<std::int64_t>(run.path.size()));
  CHECK(run.verdict.statistics[Counter::kDescents] == descents);
  CHECK(run.verdict.statistics[Counter::kFolds] == folds);
}

void CheckSolved(const ExactProblem& problem, const CompleteRun& run) {
  REQUIRE(run.verdict.outcome == Outcome::kSolved);
  CHECK(FindViolation(problem, run.f).value_or("") == "");
  CHECK(run.word.size() == problem.contacts.size());
  CHECK(run.word.find('?') == std::string::npos);
}

// ---- Known paths -----------------------------------------------------------------------------

ExactProblem DescentProblem() {
  return MakeProblem({3, 3}, {{4, -1, -1, 1}, {-1, 5, -4, 0}, {-1, -4, 5, 0}, {1, 0, 0, 1}}, {1, 1, -4, 3});
}

TEST_CASE("complete: the example with a descent goes down and up again as the notes say") {
  const CompleteRun run = RunComplete(DescentProblem());
  CheckSolved(DescentProblem(), run);
  CheckPath(DescentProblem(), run);
  CHECK(run.verdict.statistics == Counters{{Counter::kPieces, 6},
                                           {Counter::kFolds, 1},
                                           {Counter::kDescents, 1},
                                           {Counter::kTies, 0},
                                           {Counter::kStages, 4}});
  CHECK(run.word == "SS");
  REQUIRE(run.path.size() == 6);
  CHECK(run.path[0].f == Vector({0, 0, Rational(4, 5), 0}));
  CHECK(run.path[1].f[3] == Rational(-1, 5));  // contact 1 enters, into +
  CHECK(run.path[1].sets[1] == IndexSet::kAtUpper);
  CHECK(run.path[2].f == Vector({Rational(1, 8), Rational(3, 8), Rational(9, 8), 0}));
  CHECK(Descends(run.path[2]));
  CHECK(run.path[3].driven == 2);
  CHECK(run.path[3].sets[1] == IndexSet::kSticking);
  CHECK(run.path[4].f == Vector({1, Rational(20, 9), Rational(25, 9), 0}));
  CHECK(run.path[5].f == Vector({5, Rational(56, 9), Rational(61, 9), -8}));
  std::vector<int> determinants;
  for (const auto& piece : run.path) determinants.push_back(piece.determinant);
  CHECK(determinants == std::vector<int>{1, 1, -1, 1, 1, 1});
}

TEMPLATE_TEST_CASE("complete: every arithmetic takes the path with the descent", "", float, double) {
  CompleteDriving<TestType> algorithm;
  Trace<TestType> trace;
  const RunEnd<> verdict = algorithm.Run(As<TestType>(DescentProblem()), &trace);
  const auto& path = trace.pivots;
  CHECK(verdict.outcome == Outcome::kSolved);
  const CompleteRun exact = RunComplete(DescentProblem());
  CHECK(verdict.statistics == exact.verdict.statistics);
  REQUIRE(path.size() == exact.path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    CHECK(path[k].sets == exact.path[k].sets);
    for (int row = 0; row < 4; ++row) {
      CHECK(static_cast<double>(path[k].f[row]) == Approx(ToDouble(exact.path[k].f[row])).margin(1e-5));
    }
  }
}

// A body with two contacts at rest: rows n, t of each contact over x, y, angle.
ExactProblem BodyProblem() {
  const std::vector<std::vector<Rational>> J = {{Rational(3, 5), Rational(4, 5), Rational(3, 5)},
                                                {Rational(-4, 5), Rational(3, 5), Rational(-4, 5)},
                                                {Rational(-7, 25), Rational(24, 25), Rational(1, 5)},
                                                {Rational(-24, 25), Rational(-7, 25), Rational(-11, 10)}};
  const std::vector<Rational> W = {Rational(1, 3), Rational(1, 3), Rational(4, 3)}, F = {1, -15, 18};
  std::vector<std::vector<Rational>> A(4, std::vector<Rational>(4));
  std::vector<Rational> b(4);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      b[i] += J[i][k] * W[k] * F[k];
      for (int j = 0; j < 4; ++j) A[i][j] += J[i][k] * W[k] * J[j][k];
    }
  }
  return MakeProblem({2, 10}, A, b);
}

TEST_CASE("complete: the reference problem folds twice and reaches its one solution") {
  const CompleteRun run = RunComplete(ReferenceProblem());
  CheckSolved(ReferenceProblem(), run);
  CheckPath(ReferenceProblem(), run);
  CHECK(run.verdict.statistics == Counters{{Counter::kPieces, 4},
                                           {Counter::kFolds, 2},
                                           {Counter::kDescents, 0},
                                           {Counter::kTies, 0},
                                           {Counter::kStages, 2}});
  CHECK(run.word == "S-");
  CHECK(run.f == Vector({1, Rational(-6, 7), Rational(25, 14), Rational(-25, 14)}));
}

TEST_CASE("complete: the examples of the theory on which the published algorithm bounces or cycles fold once") {
  const std::vector<ExactProblem> problems = {
      GiveUpProblem(),
      MakeProblem({10, 3}, {{6, 2, 5, 5}, {2, 6, 7, 3}, {5, 7, 10, 7}, {5, 3, 7, 10}}, {-7, 9, 1, 9}),
      MakeProblem({10, 5}, {{19, -3, 20, 21}, {-3, 18, -10, 5}, {20, -10, 38, 9}, {21, 5, 9, 34}},
                  {302, 379, -123, 726}),
      MakeProblem({3, Rational(4, 3)}, {{6, -7, 12, 4}, {-7, 26, -29, 11}, {12, -29, 37, -3}, {4, 11, -3, 30}},
                  {-65, -248, 95, -621}),
      BodyProblem()};
  for (std::size_t i = 0; i < problems.size(); ++i) {
    CAPTURE(i);
    const CompleteRun run = RunComplete(problems[i]);
    CheckSolved(problems[i], run);
    CheckPath(problems[i], run);
    CHECK(run.verdict.statistics[Counter::kFolds] == 1);
    CHECK(run.verdict.statistics[Counter::kDescents] == 0);
    CHECK(run.verdict.statistics[Counter::kPieces] >= 3);
    CHECK(run.verdict.statistics[Counter::kPieces] <= 6);
  }
  CHECK(RunComplete(problems[1]).f ==
        Vector({Rational(169, 212), Rational(-845, 106), Rational(5383, 636), Rational(-3073, 636)}));
}

TEST_CASE("complete: random problems on which the published algorithm cycles are solved") {
  for (const CyclingSeed& seed : CyclingSeeds()) {
    const CompleteRun run = RunComplete(Cycling(seed));
    CheckSolved(Cycling(seed), run);
    CheckPath(Cycling(seed), run);
    CHECK(run.verdict.statistics[Counter::kFolds] >= 1);
  }
}

TEST_CASE("complete: the exponential family takes one piece less than its words, without a fold") {
  for (int n = 2; n <= 10; ++n) {
    const CompleteRun run = RunComplete(ExponentialFamily(n));
    CheckSolved(ExponentialFamily(n), run);
    CHECK(run.verdict.statistics[Counter::kPieces] == (1 << n) - 1);
    CHECK(run.verdict.statistics[Counter::kFolds] == 0);
    // Static contacts without friction are the same.
    ExactProblem rough = ExponentialFamily(n);
    ExactProblem with_rows;
    with_rows.contacts.assign(n, {ContactKind::kStatic, 0, {}});
    with_rows.A.setZero(2 * n, 2 * n);
    with_rows.b.resize(2 * n);
    for (int i = 0; i < n; ++i) {
      with_rows.b[2 * i] = rough.b[i];
      with_rows.b[2 * i + 1] = 1;
      with_rows.A(2 * i + 1, 2 * i + 1) = 1;
      for (int j = 0; j < n; ++j) with_rows.A(2 * i, 2 * j) = rough.A(i, j);
    }
    if (n <= 6) CHECK(RunComplete(with_rows).verdict.statistics == run.verdict.statistics);
  }
}

TEST_CASE("complete: trivial problems") {
  CHECK(RunComplete(NoContacts()).verdict.outcome == Outcome::kSolved);
  const ExactProblem resting = MakeProblem({1, -1}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0});
  const CompleteRun run = RunComplete(resting);
  CheckSolved(resting, run);
  CHECK(run.word == "BB");
  CHECK(run.verdict.statistics[Counter::kTies] == 2);
}

// ---- Positive definite, nondegenerate --------------------------------------------------------

TEST_CASE("complete: on definite problems every path is as the proof says, and never a ray") {
  int folded = 0, descended = 0;
  for (int index = 0; index < 1500; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomDefinite(1 + index % 5, index);
    const CompleteRun run = RunComplete(problem);
    CheckSolved(problem, run);
    CheckPath(problem, run);
    CHECK(run.verdict.statistics[Counter::kTies] == 0);
    folded += run.verdict.statistics[Counter::kFolds] > 0;
    descended += run.verdict.statistics[Counter::kDescents] > 0;
  }
  CHECK(folded > 60);
  CHECK(descended > 5);
}

// Solutions of A x = right for square matrices of columns; empty if singular.
std::optional<ExactVector> SolveSquare(std::vector<ExactVector> columns, ExactVector right) {
  const auto size = static_cast<int>(columns.size());
  for (int k = 0; k < size; ++k) {
    int pivot = k;
    while (pivot < size && columns[k][pivot] == 0) ++pivot;
    if (pivot == size) return std::nullopt;
    for (ExactVector& column : columns) std::swap(column[k], column[pivot]);
    std::swap(right[k], right[pivot]);
    for (int i = 0; i < size; ++i) {
      if (i == k || columns[k][i] == 0) continue;
      const Rational factor = columns[k][i] / columns[k][k];
      for (ExactVector& column : columns) column[i] -= factor * column[k];
      right[i] -= factor * right[k];
    }
  }
  for (int k = 0; k < size; ++k) right[k] /= columns[k][k];
  return right;
}

// The sets of the word with number `code`, in base 4, of static contacts.
std::vector<IndexSet> SetsOfWord(int contacts, int code) {
  using enum IndexSet;
  std::vector<IndexSet> sets;
  for (int i = 0; i < contacts; ++i, code /= 4) {
    sets.push_back(code % 4 == 0 ? kSeparating : kClamped);
    sets.push_back(std::array{kSuspended, kSticking, kAtUpper, kAtLower}[code % 4]);
  }
  return sets;
}

TEST_CASE("complete: the signs of the determinants of all solutions sum to one") {
  std::map<int, int> counts;
  for (int index = 0; index < 240; ++index) {
    CAPTURE(index);
    const int contacts = 1 + index % 3;
    const ExactProblem problem = RandomDefinite(contacts, 20000 + index);
    int solutions = 0, sum = 0;
    for (int code = 0; code < 1 << (2 * contacts); ++code) {
      const auto sets = SetsOfWord(contacts, code);
      const Reduced reduced = ReducedSystem(problem, sets);
      const auto x = SolveSquare(reduced.columns, reduced.right);
      if (!x) continue;
      ExactVector f = ExactVector::Zero(problem.rows());
      for (std::size_t k = 0; k < reduced.unknowns.size(); ++k) f[reduced.unknowns[k]] = (*x)[k];
      for (int row = 1; row < problem.rows(); row += 2) {
        if (LimitSign(sets[row]) != 0)
          f[row] = LimitSign(sets[row]) * problem.contacts[row / 2].mu * f[row - 1];
      }
      if (FindViolation(problem, f)) continue;
      ++solutions;
      sum += DeterminantSign(reduced.columns);
    }
    CHECK(sum == 1);
    ++counts[solutions];
  }
  CHECK(counts.size() > 1);
}

// ---- Against the published algorithm ---------------------------------------------------------

enum class Parting { kNever, kFold, kOtherSets, kUnexplained };

// Where the published algorithm and complete driving first take different steps. Up to there both are at the
// same point; they part at the first fold, where the published algorithm bounces, or where they maintain
// different sets: complete driving leaves the contacts after the driven one alone.
Parting FirstDifference(const ExactProblem& problem, const std::vector<Pivot<Rational>>& path,
                        const std::vector<Pivot<Rational>>& pivots) {
  std::vector<IndexSet> before(problem.rows(), IndexSet::kNone);  // of the published algorithm
  for (std::size_t k = 0; k < std::max(path.size(), pivots.size()); ++k) {
    if (k == path.size() || k == pivots.size())
      return Parting::kOtherSets;  // a later contact rests in one only
    const Pivot<Rational>& piece = path[k];
    const Pivot<Rational>& pivot = pivots[k];
    if (piece.driven != pivot.driven) return Parting::kOtherSets;
    const auto sets = SetsDuring(piece.word, problem.contacts, piece.driven);
    if (!std::equal(before.begin(), before.begin() + piece.driven, sets.begin())) return Parting::kOtherSets;
    const bool folds = piece.determinant < 0;
    const bool bounces = pivot.s == 0 && pivot.gave_up;
    if (folds && bounces) return Parting::kFold;
    if (pivot.limiting > pivot.driven) return Parting::kOtherSets;
    if (folds || bounces || piece.limiting != pivot.limiting || piece.s != pivot.s)
      return Parting::kUnexplained;
    before = pivot.sets;
  }
  return Parting::kNever;
}

TEST_CASE("complete: it is the published algorithm until the first fold, where that one bounces") {
  PublishedAlgorithm<Rational> published({.policy = ParsePolicy("admit=eager,file=yes,apex=suspended")});
  Trace<Rational> trace;
  std::map<Parting, int> counts;
  for (int index = 0; index < 2000; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomDefinite(2 + index % 4, 5000 + index);
    published.Run(problem, &trace);
    const Parting parting = FirstDifference(problem, RunComplete(problem).path, trace.pivots);
    CHECK(parting != Parting::kUnexplained);
    ++counts[parting];
  }
  CHECK(counts[Parting::kNever] > 1000);
  CHECK(counts[Parting::kFold] > 50);
}

// ---- Other kinds of contacts -----------------------------------------------------------------

// Some contacts lose their friction coefficient, some their friction row; b stays in range(A).
ExactProblem WithMixedKinds(const ExactProblem& problem, Choices& choices) {
  ExactProblem mixed = problem;
  std::vector<int> rows;
  for (std::size_t i = 0; i < mixed.contacts.size(); ++i) {
    const auto kind = choices.Integer(0, 2);
    if (kind > 0) mixed.contacts[i].mu = 0;
    if (kind == 2) mixed.contacts[i].kind = ContactKind::kFrictionless;
    rows.push_back(2 * static_cast<int>(i));
    if (kind < 2) rows.push_back(2 * static_cast<int>(i) + 1);
  }
  mixed.A = ExactMatrix(problem.A(rows, rows));
  mixed.b = ExactVector(problem.b(rows));
  return mixed;
}

TEST_CASE("complete: frictionless, static and smooth contacts mix, degenerate or not") {
  for (int index = 0; index < 1400; ++index) {
    CAPTURE(index);
    Choices choices(index);
    const auto id = static_cast<GeneratorId>(index % kOrdinaryGeneratorCount);
    const ExactProblem problem = WithMixedKinds(Random<Rational>(id, 2 + index % 4, 2000 + index), choices);
    const CompleteRun run = RunComplete(problem);
    CheckSolved(problem, run);
    CheckPath(problem, run);
    std::int64_t words = 1;
    for (const auto& contact : problem.contacts) words *= contact.mu > 0 ? 4 : 2;
    CHECK(run.verdict.statistics[Counter::kPieces] <= words - 1);
  }
}

// ---- Singular and degenerate problems --------------------------------------------------------

TEST_CASE("complete: every problem of every generator is solved exactly, within the bound", "[slow]") {
  std::int64_t tied = 0, degenerate_directions = 0;
  for (int g = 0; g < kOrdinaryGeneratorCount; ++g) {
    for (int n = 1; n <= 5; ++n) {
      for (int index = 0; index < 150; ++index) {
        CAPTURE(g, n, index);
        const ExactProblem problem = Random<Rational>(static_cast<GeneratorId>(g), n, index);
        const CompleteRun run = RunComplete(problem);
        CheckSolved(problem, run);
        CheckPath(problem, run);
        CHECK(run.verdict.statistics[Counter::kPieces] <= (std::int64_t{1} << (2 * n)) - 1);
        tied += run.verdict.statistics[Counter::kTies] > 0;
        for (const auto& piece : run.path) degenerate_directions += piece.determinant == 0;
      }
    }
  }
  CHECK(tied > 2000);
  CHECK(degenerate_directions > 10);
}

// b + e e_N + e^2 e_1 + e^3 e_2 + ... for a number e that is small enough here.
ExactProblem Perturbed(ExactProblem problem) {
  Rational e = 1;
  mpz_mul_2exp(e.get_den_mpz_t(), e.get_den_mpz_t(), 300);
  const auto layout = LayoutOf(problem);
  Rational power = e;
  for (int row = 0; row < problem.rows(); ++row) {
    if (layout.IsNormal(row)) problem.b[row] += e;
    power *= e;
    problem.b[row] += power;
  }
  return problem;
}

TEST_CASE("complete: ties are told as a small perturbation of b tells them") {
  for (int g = 0; g < kOrdinaryGeneratorCount; ++g) {
    for (int index = 0; index < 40; ++index) {
      CAPTURE(g, index);
      const ExactProblem problem = Random<Rational>(static_cast<GeneratorId>(g), 1 + index % 4, 1000 + index);
      const CompleteRun symbolic = RunComplete(problem), real = RunComplete(Perturbed(problem));
      CHECK(real.verdict.statistics[Counter::kTies] == 0);
      REQUIRE(symbolic.path.size() == real.path.size());
      for (std::size_t k = 0; k < real.path.size(); ++k) {
        CHECK(symbolic.path[k].driven == real.path[k].driven);
        CHECK(symbolic.path[k].word == real.path[k].word);
        CHECK(symbolic.path[k].sets == real.path[k].sets);
        CHECK(symbolic.path[k].df == real.path[k].df);
      }
      CHECK(symbolic.word == real.word);
    }
  }
}

TEST_CASE("complete: whatever the matrix, a run ends in a solution or a ray") {
  std::map<Outcome, int> counts;
  for (int index = 0; index < 1000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    ExactProblem problem = Random<Rational>(GeneratorId::kSmall, 1 + index % 4, index);
    for (Rational& x : problem.A.reshaped()) x = choices.Integer(-2, 2);
    for (Rational& x : problem.b) x = choices.Integer(-2, 2);
    const CompleteRun run = RunComplete(problem);
    CheckPath(problem, run);
    if (run.verdict.outcome == Outcome::kSolved) CheckSolved(problem, run);
    ++counts[run.verdict.outcome];
  }
  CHECK(counts[Outcome::kSolved] + counts[Outcome::kRay] == 1000);
}

TEST_CASE("complete: a problem without a solution ends in a ray") {
  const CompleteRun run = RunComplete(NoSolution());
  CHECK(run.verdict.outcome == Outcome::kRay);
  REQUIRE(run.path.size() == 2);
  CHECK(run.path.back().limiting == -1);
  CHECK(run.ray == Vector({1, 1}));
}

TEST_CASE("complete: a budget ends the run") {
  Complete algorithm;
  algorithm.request().limits.pivots = 5;
  const RunEnd<> verdict = algorithm.Run(DescentProblem());
  CHECK(verdict.outcome == Outcome::kLimit);
  CHECK(verdict.reason == "pieces");
  CHECK(verdict.statistics[Counter::kPieces] == 5);
}

TEST_CASE("complete: the bound of the pieces is the number of the cells of all stages") {
  Complete algorithm;
  std::int64_t words = 1;
  for (int n = 1; n <= 5; ++n) {
    algorithm.Run(RandomDefinite(n, 1));
    CHECK(algorithm.most_pieces() == (words *= 4) - 1);
  }
  algorithm.Run(ExponentialFamily(6));
  CHECK(algorithm.most_pieces() == 63);
}

// ---- Paths as they were ----------------------------------------------------------------------

std::string Digits(const Rational& x) { return ToString(x); }
std::string Digits(double x) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%a", x + 0.0);  // zeros have no sign
  return text.data();
}

// FNV-1a of the pieces of the paths of the first problems of every generator.
template <class Scalar>
std::uint64_t HashOfPaths(int problems) {
  CompleteDriving<Scalar> algorithm;
  std::uint64_t hash = 14695981039346656037u;
  for (int n = 1; n <= 6; ++n) {
    for (int g = 0; g < kOrdinaryGeneratorCount; ++g) {
      for (int index = 0; index < problems; ++index) {
        Trace<Scalar> trace;
        algorithm.Run(Random<Scalar>(static_cast<GeneratorId>(g), n, index), &trace);
        std::string text;
        for (const auto& piece : trace.pivots)
          text += std::to_string(piece.driven) + " [" + piece.word + "] " + std::to_string(piece.determinant) +
                  " " + Digits(piece.s) + "\n";
        for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
      }
    }
  }
  return hash;
}

// Recorded when plane and space were two programs, from that of the plane.
TEST_CASE("complete: paths in the plane are the recorded ones, piece by piece") {
  CHECK(HashOfPaths<Rational>(8) == 8322339580969750204u);
  CHECK(HashOfPaths<double>(8) == 7199014673233552254u);
}

// ---- Inexact arithmetic ----------------------------------------------------------------------

TEST_CASE(
    "complete: over doubles every step ends on its facet, and its cells' equations hold, to the last bit") {
  CompleteDriving<double> algorithm;
  std::int64_t steps = 0;
  for (int index = 0; index < 300; ++index) {
    CAPTURE(index);
    const auto problem = As<double>(RandomDefinite(2 + index % 4, index));
    Trace<double> trace;
    algorithm.Run(problem, &trace);
    for (const auto& pivot : trace.pivots) {
      ++steps;
      for (int row = 0; row < problem.rows(); ++row) {
        const IndexSet set = pivot.sets[row];
        if (IsUnknown(set)) CHECK(pivot.a[row] == 0);
        if (set == IndexSet::kSeparating) CHECK(pivot.f[row] == 0);
        if (LimitSign(set) == 0) continue;
        CHECK(pivot.f[row] == LimitSign(set) * problem.contacts[row / 2].mu * pivot.f[row - 1]);
      }
      if (pivot.limiting >= 0 && Descends(pivot)) CHECK(pivot.f[pivot.driven] == 0);
    }
  }
  CHECK(steps > 1500);
}

TEST_CASE("complete: where no sign stands out of the tolerance no stage is entered") {
  CompleteDriving<double> algorithm;
  algorithm.request().tolerances.pivot = 2;
  const auto problem = As<double>(MakeProblem({1}, {{1, 0}, {0, 1}}, {0, 0}));
  const RunEnd<> verdict = algorithm.Run(problem);
  CHECK(verdict.outcome == Outcome::kUndecided);
  CHECK(verdict.reason == "a sign");
  CHECK(verdict.statistics[Counter::kTies] == 1);
  CHECK(verdict.statistics[Counter::kStages] == 0);
  CHECK(algorithm.Word() == "?");
}

TEST_CASE("complete: numbers that are not finite are undecided") {
  auto problem = As<double>(DescentProblem());
  problem.b[2] = -std::numeric_limits<double>::infinity();
  CHECK(CompleteDriving<double>().Run(problem).outcome == Outcome::kUndecided);
  problem.b[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(CompleteDriving<double>().Run(problem).outcome == Outcome::kUndecided);
  problem = As<double>(DescentProblem());
  problem.A *= 1e300;
  CHECK(CompleteDriving<double>().Run(problem).outcome != Outcome::kLimit);
}

TEST_CASE("complete: fixed and dynamic sizes take the same path") {
  for (int index = 0; index < 200; ++index) {
    const ExactProblem exact = RandomDefinite(3, index);
    CompleteDriving<double> dynamic;
    CompleteDriving<double, 6> fixed;
    const RunEnd<> a = dynamic.Run(As<double>(exact)), b = fixed.Run(As<double, 6>(exact));
    CHECK(a.outcome == b.outcome);
    CHECK(a.statistics == b.statistics);
    CHECK(dynamic.Word() == fixed.Word());
    for (int i = 0; i < 6; ++i) CHECK(dynamic.f()[i] == fixed.f()[i]);
  }
}

}  // namespace
}  // namespace stiction
