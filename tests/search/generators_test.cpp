// SPDX-License-Identifier: Apache-2.0
// Tests of search/generators/choices.h and search/generators/generators.h. What is exact is checked over
// rationals, with ==.

#include "search/generators/generators.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "certify/exact/exact.h"
#include "certify/exact/properties.h"
#include "corpus/rational.h"
#include "search/generators/exponential.h"
#include "tests/search/recorded.h"

namespace stiction {
namespace {

using DoubleProblem = ContactProblem<double>;
using ChoiceList = std::vector<std::int64_t>;
using RangedChoices = std::vector<Choice>;  // with ranges

constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();

// Problems per generator and size; the exact elimination of large ones takes milliseconds.
int SeedCount(int contacts) { return contacts <= 4 ? 300 : 200; }

// Not by kGeneratorCount: another generator must not move the problems of these tests.
std::uint64_t Seed(GeneratorId id, int contacts, int index) {
  return ProblemSeed(1994, 7 * contacts + static_cast<int>(id), index);
}

template <class Problem>
Problem Make(GeneratorId id, int contacts, Choices choices,
             std::span<const MuChoice> palette = kDefaultPalette) {
  Problem problem;
  Generate(id, contacts, palette, choices, problem);
  return problem;
}

template <class Problem>
Problem Make(GeneratorId id, int contacts, int index) {
  return Make<Problem>(id, contacts, Choices(Seed(id, contacts, index)));
}

// visit(id, contacts) for all generators and sizes.
template <class Visit>
void ForEachKind(Visit visit) {
  for (const GeneratorRow& row : Generators()) {
    for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
      CAPTURE(row.name, contacts);
      visit(row.id, contacts);
    }
  }
}

template <class P, class Q>
bool Equal(const P& p, const Q& q) {
  if (p.dimension != q.dimension || p.rows() != q.rows() || p.contacts.size() != q.contacts.size())
    return false;
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    if (p.contacts[i].kind != q.contacts[i].kind || p.contacts[i].mu != q.contacts[i].mu) return false;
    for (int k = 0; k < 2; ++k) {
      if (p.contacts[i].slip[k] != q.contacts[i].slip[k]) return false;
    }
  }
  for (int i = 0; i < p.rows(); ++i) {
    if (p.b[i] != q.b[i]) return false;
    for (int j = 0; j < p.rows(); ++j) {
      if (p.A(i, j) != q.A(i, j)) return false;
    }
  }
  return true;
}

struct Properties {
  bool semidefinite = true;
  bool in_range = true;
  int rank = 0;
};

// The problem times the common denominator of its numbers: [A b] in integers.
Eigen::Matrix<mpz_class, Eigen::Dynamic, Eigen::Dynamic> Integral(const ExactProblem& problem) {
  const int rows = problem.rows();
  mpz_class denominator = 1;
  for (int i = 0; i < rows; ++i) {
    denominator = lcm(denominator, problem.b[i].get_den());
    for (int j = 0; j < rows; ++j) denominator = lcm(denominator, problem.A(i, j).get_den());
  }
  const auto scaled = [&denominator](const Rational& x) {
    return mpz_class(x.get_num() * mpz_class(denominator / x.get_den()));
  };
  Eigen::Matrix<mpz_class, Eigen::Dynamic, Eigen::Dynamic> M(rows, rows + 1);
  for (int i = 0; i < rows; ++i) {
    M(i, rows) = scaled(problem.b[i]);
    for (int j = 0; j < rows; ++j) M(i, j) = scaled(problem.A(i, j));
  }
  return M;
}

// Elimination of [A b], A symmetric, without pivoting or fractions (Bareiss): pivots are principal minors,
// divisions are exact. A zero pivot needs a zero column, otherwise A is indefinite, and a zero right-hand
// side, otherwise b is not in range(A).
Properties Eliminate(const ExactProblem& problem) {
  const int rows = problem.rows();
  auto M = Integral(problem);
  Properties properties;
  mpz_class last_pivot = 1;
  for (int k = 0; k < rows; ++k) {
    const mpz_class pivot = M(k, k);
    if (pivot < 0) properties.semidefinite = false;
    if (pivot == 0) {
      for (int i = k + 1; i < rows; ++i) properties.semidefinite &= M(i, k) == 0;
      properties.in_range &= M(k, rows) == 0;
      continue;
    }
    ++properties.rank;
    for (int i = k + 1; i < rows; ++i) {
      for (int j = k + 1; j <= i; ++j) M(i, j) = (M(i, j) * pivot - M(i, k) * M(j, k)) / last_pivot;
      M(i, rows) = (M(i, rows) * pivot - M(i, k) * M(k, rows)) / last_pivot;
    }
    last_pivot = pivot;
  }
  return properties;
}

// Eigenvalues of A, largest first, to about 20 digits of the largest.
std::vector<long double> Eigenvalues(const ExactProblem& problem) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const auto rounded = [](const Rational& x) {
    const double high = x.get_d();
    const Rational rest = x - Rational(high);
    return static_cast<long double>(high) + rest.get_d();
  };
  Matrix A(problem.rows(), problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) A(i, j) = rounded(problem.A(i, j));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(A, Eigen::EigenvaluesOnly);
  std::vector<long double> values(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::reverse(values.begin(), values.end());
  return values;
}

// Whether contact `to` is contact `from`, its tangent reversed if sign = -1, as far as A and b tell.
bool IsCopy(const ExactProblem& problem, int from, int to, int sign) {
  for (int row = 0; row < 2; ++row) {
    const Rational factor = row == 0 ? 1 : sign;
    if (problem.b[2 * to + row] != factor * problem.b[2 * from + row]) return false;
    for (int j = 0; j < problem.rows(); ++j) {
      if (problem.A(2 * to + row, j) != factor * problem.A(2 * from + row, j)) return false;
    }
  }
  return true;
}

// ---- Choices ----------------------------------------------------------------------------------

TEST_CASE("choices: the words are those of splitmix64") {
  // The sequence that its reference implementation prints for this seed.
  Choices choices(1234567);
  for (const std::uint64_t word : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u}) {
    const auto value = choices.Integer(kLowest, kHighest);
    CHECK(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(kLowest) == word);
  }
}

TEST_CASE("choices: integers are uniform within their bounds, drawn singly or many from a word") {
  constexpr int kDraws = 110000;
  std::array<int, 11> single{}, shared{};
  Choices choices(5);
  for (int i = 0; i < kDraws; ++i) ++single.at(choices.Integer(-5, 5) + 5);
  choices.ForEach<-5, 5>(kDraws, [&shared](int, int value) { ++shared.at(value + 5); });
  for (int v = 0; v < 11; ++v) {
    CHECK(std::abs(single[v] - kDraws / 11) < 500);  // five standard deviations
    CHECK(std::abs(shared[v] - kDraws / 11) < 500);
  }
  CHECK(choices.Integer(7, 7) == 7);
}

TEST_CASE("choices: numbers that share a word are independent in pairs") {
  constexpr int kPairs = 121000;
  std::array<int, 121> counts{};
  int before = 0;
  Choices(6).ForEach<0, 10>(2 * kPairs, [&](int i, int value) {
    if (i % 2 == 1) ++counts.at(11 * before + value);
    before = value;
  });
  for (const int count : counts) CHECK(std::abs(count - 1000) < 160);
}

TEST_CASE("choices: a replay clamps into the range and goes on with the value nearest zero") {
  const ChoiceList sequence = {100, -100, 3, kLowest, kHighest};
  RangedChoices used;
  Choices choices = Choices::Replay(sequence, &used);
  CHECK(choices.Integer(-5, 5) == 5);
  CHECK(choices.Integer(-5, 5) == -5);
  choices.ForEach<-5, 5>(2, [](int i, int value) { CHECK(value == (i == 0 ? 3 : -5)); });
  CHECK(choices.Integer(kLowest, kHighest) == kHighest);
  CHECK(choices.Integer(-5, 5) == 0);
  CHECK(choices.Integer(2, 5) == 2);
  CHECK(choices.Integer(-5, -2) == -2);
  CHECK(ValuesOf(used) == ChoiceList{5, -5, 3, -5, kHighest, 0, 2, -2});
  CHECK(used[0] == Choice{5, -5, 5});
  CHECK(used[3] == Choice{-5, -5, 5});
  CHECK(used[4] == Choice{kHighest, kLowest, kHighest});
}

TEST_CASE("choices: seeds differ between the problems of a unit, between units and between campaigns") {
  std::set<std::uint64_t> seeds;
  for (int campaign = 0; campaign < 10; ++campaign) {
    for (int unit = 0; unit < 10; ++unit) {
      for (int index = 0; index < 100; ++index) seeds.insert(ProblemSeed(campaign, unit, index));
    }
  }
  CHECK(seeds.size() == 10000);
}

// ---- All generators ---------------------------------------------------------------------------

TEST_CASE("generators: the table is in the order of the ids and found by name") {
  for (int i = 0; i < kGeneratorCount; ++i) {
    const GeneratorRow& row = Generators()[i];
    CHECK(static_cast<int>(row.id) == i);
    CHECK(FindGenerator(row.name) == row.id);
    CHECK(&Row(row.id) == &row);
    CHECK_FALSE(row.distribution.empty());
  }
  CHECK(FindGenerator("near-degenerate") == GeneratorId::kNearDegenerate);
  CHECK_FALSE(FindGenerator("nothing").has_value());
}

TEST_CASE("generators: A is symmetric and semidefinite, b in its range, and every rank occurs", "[slow]") {
  ForEachKind([](GeneratorId id, int contacts) {
    std::set<int> ranks, drawn_ranks;
    int as_drawn = 0;
    for (int index = 0; index < SeedCount(contacts); ++index) {
      CAPTURE(index);
      ExactProblem problem;
      Choices choices(Seed(id, contacts, index));
      const Drawn drawn = Generate(id, contacts, kDefaultPalette, choices, problem);
      REQUIRE(problem.rows() == RowCount(problem.contacts, Row(id).dimension));
      REQUIRE(IsSymmetric(problem));
      const Properties properties = Eliminate(problem);
      REQUIRE(properties.semidefinite);
      REQUIRE(properties.in_range);
      ranks.insert(properties.rank);
      drawn_ranks.insert(drawn.rank);
      REQUIRE(properties.rank <= drawn.rank);
      as_drawn += properties.rank == drawn.rank;
    }
    // Many zeros; geometry.
    const bool by_chance_lower = id == GeneratorId::kSmall || id == GeneratorId::kSteps || Row(id).has_gravity;
    if (!by_chance_lower) CHECK(as_drawn > SeedCount(contacts) * 4 / 5);
    if (Row(id).HasOtherKinds()) return;  // rows, and so ranks, differ
    if (Row(id).has_gravity) {            // of bodies: normal and friction of a contact are never dependent
      CHECK(*ranks.begin() >= 2);
      CHECK(*ranks.rbegin() == std::min(2 * contacts, id == GeneratorId::kOneBody ? 3 : 9));
      return;
    }
    const int rows = Row(id).dimension * contacts;
    const int largest = id == GeneratorId::kDuplicates && contacts > 1 ? rows - 2 : rows;
    CHECK(*ranks.rbegin() >= largest - 1);  // where A is singular for certain, it is as regular as it can be
    if (id == GeneratorId::kExponential) CHECK(*ranks.begin() == contacts);  // its normals are independent
    CHECK(*ranks.rbegin() == *drawn_ranks.rbegin());
    CHECK(std::includes(ranks.begin(), ranks.end(), drawn_ranks.begin(), drawn_ranks.end()));
  });
}

TEST_CASE("generators: the check of these tests sees an indefinite A and a b outside its range") {
  auto problem = Make<ExactProblem>(GeneratorId::kIntegers, 1, 0);
  problem.A << 1, 1, 1, 1;
  problem.b << 2, 2;
  CHECK(Eliminate(problem).in_range);
  problem.b << 2, 1;
  CHECK_FALSE(Eliminate(problem).in_range);
  problem.A << 1, 2, 2, 1;
  CHECK_FALSE(Eliminate(problem).semidefinite);
  problem.A << 0, 1, 1, 0;
  CHECK_FALSE(Eliminate(problem).semidefinite);
}

TEST_CASE("generators: where the table says so, the double problem is the rational one", "[slow]") {
  ForEachKind([](GeneratorId id, int contacts) {
    int different = 0;
    for (int index = 0; index < SeedCount(contacts); ++index) {
      const auto exact = Make<ExactProblem>(id, contacts, index);
      const auto rounded = Make<DoubleProblem>(id, contacts, index);
      different += Equal(exact, rounded) ? 0 : 1;
    }
    if (Row(id).exact_in_double) {
      CHECK(different == 0);
    } else {
      CHECK(different > 0);  // otherwise the table is too modest
    }
  });
}

// Choices at the ends of their ranges make the largest numbers.
TEST_CASE("generators: the largest problems are exact in double too") {
  ForEachKind([](GeneratorId id, int contacts) {
    if (!Row(id).exact_in_double) return;
    const int most = std::min(64, Row(id).most_mu_part);
    const std::array<MuChoice, 4> extremes = {{{most, 1}, {1, most}, {most, most}, {most - 1, most}}};
    for (int index = 0; index < 60; ++index) {
      CAPTURE(index);
      Choices ends(index);
      ChoiceList sequence(2000, kHighest);
      for (std::int64_t& value : sequence) {
        if (index > 0 && ends.Integer(0, index % 10) == 0) value = kLowest;
      }
      const auto exact = Make<ExactProblem>(id, contacts, Choices::Replay(sequence), extremes);
      REQUIRE(Equal(exact, Make<DoubleProblem>(id, contacts, Choices::Replay(sequence), extremes)));
    }
  });
}

TEST_CASE("generators: the double problem is near the rational one where it is only a filter", "[slow]") {
  for (const GeneratorId id : {GeneratorId::kConditioned, GeneratorId::kBodies, GeneratorId::kScenes}) {
    const double rounding = id == GeneratorId::kScenes ? 1e-12 : 1e-14;
    for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
      for (int index = 0; index < SeedCount(contacts); ++index) {
        const auto exact = Make<ExactProblem>(id, contacts, index);
        const auto rounded = Make<DoubleProblem>(id, contacts, index);
        const double A = rounded.A.cwiseAbs().maxCoeff(), b = rounded.b.cwiseAbs().maxCoeff();
        for (int i = 0; i < exact.rows(); ++i) {
          REQUIRE(std::abs(exact.b[i].get_d() - rounded.b[i]) <= rounding * std::max(1.0, b));
          for (int j = 0; j < exact.rows(); ++j) {
            REQUIRE(std::abs(exact.A(i, j).get_d() - rounded.A(i, j)) <= rounding * A);
            REQUIRE(rounded.A(i, j) == rounded.A(j, i));
          }
        }
      }
    }
  }
}

template <int Rows>
void CheckFixedSize(GeneratorId id) {
  for (int index = 0; index < 200; ++index) {
    using Fixed = ContactProblem<double, Rows>;
    REQUIRE(Equal(Make<Fixed>(id, Rows / 2, index), Make<DoubleProblem>(id, Rows / 2, index)));
  }
}

TEST_CASE("generators: a seed makes the same problem on a fixed and on a dynamic number of rows") {
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;
    CAPTURE(row.name);
    [&]<int... kContacts>(std::integer_sequence<int, kContacts...>) {
      (CheckFixedSize<2 * (kContacts + 1)>(row.id), ...);
    }
    (std::make_integer_sequence<int, kMaxContacts>());
  }
}

TEST_CASE("generators: a problem depends on nothing that was in its memory before") {
  DoubleProblem reused;
  reused.dimension = 3;
  for (const GeneratorRow& row : Generators()) {
    for (const int contacts : {3, 8, 1, 8, 2}) {
      reused.A.setConstant(std::numeric_limits<double>::quiet_NaN());
      reused.b.setConstant(std::numeric_limits<double>::quiet_NaN());
      for (auto& contact : reused.contacts) contact = {ContactKind::kSliding, -1, {1, 1}};
      Choices choices(Seed(row.id, contacts, 9));
      Generate<double>(row.id, contacts, kDefaultPalette, choices, reused);
      CHECK(Equal(reused, Make<DoubleProblem>(row.id, contacts, 9)));
    }
  }
}

TEST_CASE("generators: recorded choices make the same problem again, over doubles and rationals", "[slow]") {
  ForEachKind([](GeneratorId id, int contacts) {
    for (int index = 0; index < 50; ++index) {
      RangedChoices record, again;
      const std::uint64_t seed = Seed(id, contacts, index);
      const auto problem = Make<DoubleProblem>(id, contacts, Choices(seed, &record));
      REQUIRE(Equal(problem, Make<DoubleProblem>(id, contacts, Choices(seed))));
      REQUIRE(Equal(problem, Make<DoubleProblem>(id, contacts, Choices::Replay(ValuesOf(record), &again))));
      REQUIRE(again == record);
      REQUIRE(Equal(Make<ExactProblem>(id, contacts, Choices(seed)),
                    Make<ExactProblem>(id, contacts, Choices::Replay(ValuesOf(record)))));
    }
  });
}

// What a minimizer does: any edited, shortened or meaningless sequence is a problem of the same family.
TEST_CASE("generators: any sequence of choices makes a problem that meets the assumptions") {
  ForEachKind([](GeneratorId id, int contacts) {
    Choices edits(Seed(id, contacts, 77));
    for (int index = 0; index < 20; ++index) {
      RangedChoices record;
      Make<DoubleProblem>(id, contacts, Choices(Seed(id, contacts, index), &record));
      ChoiceList sequence = ValuesOf(record);
      sequence.resize(edits.Integer(0, static_cast<std::int64_t>(sequence.size())));
      for (std::int64_t& value : sequence) {
        if (edits.Integer(0, 4) == 0) value = edits.Integer(-1000, 1000);
      }
      const auto problem = Make<ExactProblem>(id, contacts, Choices::Replay(sequence));
      const Properties properties = Eliminate(problem);
      REQUIRE(properties.semidefinite);
      REQUIRE(properties.in_range);
    }
  });
}

TEST_CASE("generators: friction coefficients come from the palette, in half of the problems one for all") {
  constexpr std::array<MuChoice, 3> kPalette = {{{1, 3}, {3, 10}, {7, 1}}};
  std::set<Rational> seen;
  int uniform = 0;
  constexpr int kProblems = 1000;
  for (int index = 0; index < kProblems; ++index) {
    const auto problem = Make<ExactProblem>(GeneratorId::kSmall, 8, Choices(index), kPalette);
    std::set<Rational> own;
    for (const auto& contact : problem.contacts) {
      REQUIRE(contact.kind == ContactKind::kStatic);
      own.insert(contact.mu);
    }
    seen.insert(own.begin(), own.end());
    uniform += own.size() == 1;
  }
  CHECK(seen == std::set<Rational>{Rational(1, 3), Rational(3, 10), Rational(7)});
  CHECK(std::abs(uniform - kProblems / 2) < 80);
}

TEST_CASE("generators: of other kinds is one contact at least, and static ones occur beside it") {
  for (const GeneratorId id : {GeneratorId::kBilateral, GeneratorId::kSliding}) {
    std::set<int> others;
    std::set<Rational> slips;
    for (int index = 0; index < 300; ++index) {
      const auto problem = Make<ExactProblem>(id, 3, index);
      int other = 0;
      for (const auto& contact : problem.contacts) {
        REQUIRE((contact.kind == ContactKind::kStatic || contact.kind == Row(id).other_kind));
        if (contact.kind == ContactKind::kStatic) continue;
        ++other;
        slips.insert(contact.slip[0]);
        CHECK((contact.mu == 0) == (id == GeneratorId::kBilateral));
      }
      others.insert(other);
    }
    CHECK(others == std::set<int>{1, 2, 3});
    if (id == GeneratorId::kSliding) CHECK(slips == std::set<Rational>{-1, 1});
  }
  ContactProblem<double, 4> fixed;
  Choices choices(1);
  CHECK_THROWS(Generate<double>(GeneratorId::kSliding, 2, kDefaultPalette, choices, fixed));
  CHECK_THROWS(Generate<double>(GeneratorId::kSpace, 2, kDefaultPalette, choices, fixed));
}

TEST_CASE("generators: outside 1 to 8 contacts, or without a palette, is an internal error") {
  DoubleProblem problem;
  Choices choices(1);
  CHECK_THROWS(Generate<double>(GeneratorId::kPsd, 0, kDefaultPalette, choices, problem));
  CHECK_THROWS(Generate<double>(GeneratorId::kPsd, 9, kDefaultPalette, choices, problem));
  CHECK_THROWS(Generate<double>(GeneratorId::kPsd, 2, std::span<const MuChoice>(), choices, problem));
  ContactProblem<double, 4> fixed;
  CHECK_THROWS(Generate<double>(GeneratorId::kPsd, 3, kDefaultPalette, choices, fixed));
}

// Campaigns are compared between machines and compilers: these words may change only together with the
// generators themselves.
TEST_CASE("generators: the bits of the double problems are the same on every machine") {
  for (const GeneratorRow& row : Generators()) {
    std::uint64_t hash = 0;
    const auto add = [&hash](double x) { hash = Mix(hash + std::bit_cast<std::uint64_t>(x) + 1); };
    for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
      for (int index = 0; index < 100; ++index) {
        const auto problem = Make<DoubleProblem>(row.id, contacts, index);
        for (const auto& contact : problem.contacts) add(contact.mu);
        for (const double x : problem.b) add(x);
        for (const double x : problem.A.reshaped()) add(x);
      }
    }
    CAPTURE(row.name);
    INFO(hash);
    CHECK(hash == RecordedOf(row.name).bits);
  }
}

// ---- One by one -------------------------------------------------------------------------------

TEST_CASE("integers, small: entries are integers within their bounds") {
  for (int index = 0; index < 300; ++index) {
    const auto integers = Make<DoubleProblem>(GeneratorId::kIntegers, 2, index);
    CHECK(integers.A.cwiseAbs().maxCoeff() <= 100);
    CHECK(integers.A == integers.A.array().round().matrix());
    const auto small = Make<DoubleProblem>(GeneratorId::kSmall, 2, index);
    CHECK(small.A.cwiseAbs().maxCoeff() <= 16);
    CHECK(small.A == small.A.array().round().matrix());
    CHECK(small.b.cwiseAbs().maxCoeff() <= 16);
  }
}

TEST_CASE("duplicates: a contact is a copy of another, with its tangent kept or reversed") {
  for (int contacts = 2; contacts <= kMaxContacts; ++contacts) {
    std::set<int> signs;
    for (int index = 0; index < 100; ++index) {
      CAPTURE(contacts, index);
      const auto problem = Make<ExactProblem>(GeneratorId::kDuplicates, contacts, index);
      bool copied = false;
      for (int to = 1; to < contacts; ++to) {
        for (int from = 0; from < to; ++from) {
          for (const int sign : {-1, 1}) {
            if (!IsCopy(problem, from, to, sign)) continue;
            copied = true;
            signs.insert(sign);
          }
        }
      }
      REQUIRE(copied);
    }
    CHECK(signs.size() == 2);
  }
}

TEST_CASE("near-degenerate: rows are nearly dependent") {
  int close = 0;
  for (int index = 0; index < 200; ++index) {
    const auto problem = Make<ExactProblem>(GeneratorId::kNearDegenerate, 3, index);
    const int rank = Eliminate(problem).rank;
    const auto values = Eigenvalues(problem);
    close += values[rank - 1] < 1e-4L * values[0];
  }
  CHECK(close > 60);
}

// One contact, one column, mu = 1/2: J = 2^2 (1, 2) + (1, -1) = (5, 7), f0 = 2 (2, 1), so that J' f0 = 34.
TEST_CASE("near-degenerate: forces at a friction limit balance b up to the noise") {
  constexpr std::array<MuChoice, 1> kHalf = {{{1, 2}}};
  const ChoiceList exactly = {0, 0, 1, 1, 2, 1, 2, 1, -1, 2, 2, 0};
  auto problem = Make<ExactProblem>(GeneratorId::kNearDegenerate, 1, Choices::Replay(exactly), kHalf);
  CHECK((problem.A(0, 0) == 25 && problem.A(1, 0) == 35 && problem.A(0, 1) == 35 && problem.A(1, 1) == 49));
  CHECK((problem.b[0] == -34 * 5 && problem.b[1] == -34 * 7));
  const ChoiceList nearly = {0, 0, 1, 1, 2, 1, 2, 1, -1, 3, 2, 1, 1};  // f0 = 2 (2, -1): J' f0 = 6; e = 1
  problem = Make<ExactProblem>(GeneratorId::kNearDegenerate, 1, Choices::Replay(nearly), kHalf);
  CHECK((problem.b[0] == -5 * 5 && problem.b[1] == -5 * 7));
}

TEST_CASE("conditioned: eigenvalues fall geometrically from 1 to 100^-k, k = 0..8, the others are zero") {
  std::set<int> exponents;
  for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
    for (int index = 0; index < 60; ++index) {
      CAPTURE(contacts, index);
      const auto problem = Make<ExactProblem>(GeneratorId::kConditioned, contacts, index);
      const int rank = Eliminate(problem).rank;
      const auto values = Eigenvalues(problem);
      REQUIRE(std::abs(values[0] - 1) < 1e-14L);
      if (rank == 1) continue;
      const long double decades = -std::log10(values[rank - 1]) / 2;
      const int exponent = static_cast<int>(std::lround(decades));
      REQUIRE(std::abs(decades - exponent) < 0.01L);
      exponents.insert(exponent);
      for (int i = 0; i < rank; ++i) {
        const long double expected = -2.0L * exponent * i / (rank - 1);
        REQUIRE(std::abs(std::log10(values[i]) - expected) < 0.01L);
      }
    }
  }
  CHECK(exponents == std::set<int>{0, 1, 2, 3, 4, 5, 6, 7, 8});
}

// One rigid body at rest on two contacts: W = diag(1/3, 1/3, 4/3), F = (1, -15, 18).
TEST_CASE("bodies: one body on two contacts gives A = J W J', b = J W F computed by hand") {
  constexpr std::array<MuChoice, 2> kPalette = {{{2, 1}, {10, 1}}};
  const ChoiceList choices = {1, 0,   1,              // mu = (2, 10)
                              1, 1,                   // one body, applied force only
                              0, 0,   3,  1,  3, 4,   // centre, mass 3, inertia 3/4
                              1, -15, 18,             // F
                              0, -10, 3,  1,  0,      // at (0, -1), normal (3/5, 4/5), with the world
                              5, -10, 7,  -1, 0, 0};  // at (1/2, -1), normal (-7/25, 24/25), the same
  RangedChoices used;
  const auto problem = Make<ExactProblem>(GeneratorId::kBodies, 2, Choices::Replay(choices, &used), kPalette);
  CHECK(ValuesOf(used) == choices);
  CHECK((problem.contacts[0].mu == 2 && problem.contacts[1].mu == 10));
  const auto q = [](int numerator, int denominator) {
    Rational x(numerator, denominator);
    x.canonicalize();
    return x;
  };
  const std::array<std::array<Rational, 3>, 4> J = {{{q(3, 5), q(4, 5), q(3, 5)},
                                                     {q(-4, 5), q(3, 5), q(-4, 5)},
                                                     {q(-7, 25), q(24, 25), q(1, 5)},
                                                     {q(-24, 25), q(-7, 25), q(-11, 10)}}};
  const std::array<Rational, 3> W = {q(1, 3), q(1, 3), q(4, 3)}, F = {1, -15, 18};
  for (int i = 0; i < 4; ++i) {
    Rational b = 0;
    for (int k = 0; k < 3; ++k) b += J[i][k] * W[k] * F[k];
    CHECK(problem.b[i] == b);
    for (int j = 0; j < 4; ++j) {
      Rational A = 0;
      for (int k = 0; k < 3; ++k) A += J[i][k] * W[k] * J[j][k];
      CHECK(problem.A(i, j) == A);
    }
  }
}

// Two equal bodies of mass 1 and inertia 1, contact 0 between them, contact 1 between the second and the
// world: the shared point pushes the bodies apart, so that body 2 feels contact 0 with the opposite sign.
TEST_CASE("bodies: a contact between two bodies moves them in opposite directions") {
  const ChoiceList choices = {0, 0,                // one mu
                              2, 0,                // two bodies, gravity only
                              0, 10,  1, 1, 1, 1,  // first: centre (0, 1)
                              0, -10, 1, 1, 1, 1,  // second: centre (0, -1)
                              0, 0,   1, 0, 1,     // at (0, 0), normal (0, 1), with the other body
                              0, -20, 1, 0, 0};    // at (0, -2), normal (0, 1), with the world
  const auto problem = Make<ExactProblem>(GeneratorId::kBodies, 2, Choices::Replay(choices));
  // Rows: J = [0 1 0 | 0 -1 0], [-1 0 -1 | 1 0 -1], [0 0 0 | 0 1 0], [0 0 0 | -1 0 -1].
  const std::array<std::array<int, 4>, 4> A = {{{2, 0, -1, 0}, {0, 4, 0, 0}, {-1, 0, 1, 0}, {0, 0, 0, 2}}};
  const std::array<int, 4> b = {0, 0, -10, 0};
  for (int i = 0; i < 4; ++i) {
    CHECK(problem.b[i] == b[i]);
    for (int j = 0; j < 4; ++j) CHECK(problem.A(i, j) == A[i][j]);
  }
}

TEST_CASE("bodies: the rank is at most three per body, and normals point into all quadrants") {
  std::set<int> ranks;
  for (int index = 0; index < 300; ++index) {
    ranks.insert(Eliminate(Make<ExactProblem>(GeneratorId::kBodies, 8, index)).rank);
  }
  for (const int rank : {3, 6, 9}) CHECK(ranks.contains(rank));
  CHECK(*ranks.rbegin() == 9);
  // A single contact of a body of mass 1 and inertia 1 at the centre, under gravity: b = -10 (ny, nx).
  std::set<std::pair<int, int>> quadrants;
  for (int p = -7; p <= 7; ++p) {
    for (int q = -7; q <= 7; ++q) {
      const ChoiceList choices = {0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0, 0, p, q};
      const auto problem = Make<ExactProblem>(GeneratorId::kBodies, 1, Choices::Replay(choices));
      const Rational ny = problem.b[0] / -10, nx = problem.b[1] / -10;
      REQUIRE(nx * nx + ny * ny == 1);
      quadrants.insert({sgn(nx), sgn(ny)});
    }
  }
  CHECK(quadrants.size() == 8);
}

// ---- exponential ------------------------------------------------------------------------------

// The normals of the problem, contact i of which is contact order[i].
ExactProblem Normals(const ExactProblem& problem, const std::vector<int>& order) {
  const int n = static_cast<int>(order.size());
  ExactProblem normals;
  normals.contacts.assign(n, {ContactKind::kFrictionless, 0, {}});
  normals.A.resize(n, n);
  normals.b.resize(n);
  for (int i = 0; i < n; ++i) {
    normals.b[i] = problem.b[2 * order[i]];
    for (int j = 0; j < n; ++j) normals.A(i, j) = problem.A(2 * order[i], 2 * order[j]);
  }
  return normals;
}

// Choices: the friction of one contact or of all (2), then scaled, order, moves, coupling, missing columns.
TEST_CASE("exponential: the simplest choices make the family itself, with friction apart from the normals") {
  for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
    CAPTURE(contacts);
    std::vector<int> order(contacts);
    for (int i = 0; i < contacts; ++i) order[i] = i;
    const auto plain = Make<ExactProblem>(GeneratorId::kExponential, contacts, Choices::Replay(ChoiceList{}));
    CHECK(Equal(Normals(plain, order), ExponentialFamily(contacts)));
    for (int i = 0; i < 2 * contacts; ++i) {
      for (int j = 0; j < contacts; ++j) CHECK(plain.A(i, 2 * j + 1) == (i == 2 * j + 1 ? 1 : 0));
    }
    const auto scaled =
        Make<ExactProblem>(GeneratorId::kExponential, contacts, Choices::Replay(ChoiceList{0, 0, 1}));
    CHECK(Equal(Normals(scaled, order), ExponentialFamily(contacts, true)));
    CHECK(scaled.A(1, 1) == scaled.A(0, 0) / plain.A(0, 0));
  }
}

TEST_CASE("exponential: contacts change places, entries of J move, friction is coupled, columns are missing") {
  constexpr GeneratorId kId = GeneratorId::kExponential;
  // Three contacts, each changed for the one after it: 0 1 2 -> 1 2 0.
  const auto moved = Make<ExactProblem>(kId, 3, Choices::Replay(ChoiceList{0, 0, 0, 1, 1, 1}));
  CHECK(Equal(Normals(moved, {1, 2, 0}), ExponentialFamily(3)));
  // One contact: entries 1 + 2^-8 and -1 of J, its friction without a column; y = (-7/8, -1).
  const auto coupled =
      Make<ExactProblem>(kId, 1, Choices::Replay(ChoiceList{0, 0, 0, 0, 1, 8, 1, 0, 1, 1, 1, -1, -4}));
  const Rational entry(257, 256);
  CHECK((coupled.A(0, 0) == entry * entry && coupled.A(0, 1) == -entry && coupled.A(1, 1) == 1));
  CHECK((coupled.b[0] == entry * Rational(-7, 8) && coupled.b[1] == Rational(7, 8)));
  const auto apart = Make<ExactProblem>(kId, 1, Choices::Replay(ChoiceList{0, 0, 0, 0, 0, 0, 0, -4}));
  CHECK((apart.A(0, 1) == 0 && apart.A(1, 1) == 1 && apart.b[1] == -1));
}

TEST_CASE("exponential: the published algorithm meets its worst case, and problems near it") {
  int worst = 0, near = 0;
  for (int index = 0; index < 200; ++index) {
    const auto problem = Make<ExactProblem>(GeneratorId::kExponential, 6, index);
    const std::int64_t pivots = RunExact(problem, {}).verdict.statistics.pivots;
    worst += pivots >= 63;
    near += pivots >= 20 && pivots < 63;
  }
  CHECK(worst > 20);
  CHECK(near > 20);
}

}  // namespace
}  // namespace stiction
