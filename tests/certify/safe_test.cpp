// SPDX-License-Identifier: Apache-2.0
// Safe problems: reduced determinants, certificates of them, the threshold of mu, and what safety is good for.

#include "certify/claims/safe.h"

#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "certify/claims/safety_threshold.h"
#include "certify/claims/witness.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/check.h"
#include "tests/methods.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using enum Mode;
using Catch::Contains;

ExactProblem WithMu(ExactProblem problem, const Rational& mu) {
  for (auto& contact : problem.contacts) {
    if (contact.HasFrictionRows()) contact.mu = mu;
  }
  return problem;
}

// A static contact with mu = 0, two with friction, a frictionless one; no symmetry.
ExactProblem MixedProblem() {
  return MakeProblem({0, Rational(1, 10), -1, Rational(1, 7)},
                     {{9, 1, 2, 0, 1, 0, 1},
                      {3, 0, 1, 1, 1, 1, 1},
                      {1, 0, 8, 1, 0, 1, 2},
                      {0, 5, 1, 7, 1, 2, 0},
                      {1, 1, 0, 1, 9, 1, 1},
                      {2, 0, 1, 1, 0, 8, 1},
                      {0, 1, 2, 1, 1, 1, 6}},
                     {-1, 2, -3, 1, -1, -2, 1});
}

// Positive definite.
ExactProblem RandomDefinite(int contacts, std::uint64_t index) {
  const auto id = index % 2 == 0 ? GeneratorId::kPsd : GeneratorId::kIntegers;
  ExactProblem problem = Random<Rational>(id, contacts, index);
  Choices choices(index);
  for (int i = 0; i < problem.rows(); ++i) {
    problem.A(i, i) += Rational(1, 1 + choices.Integer(0, 9));
    problem.b[i] =
        Rational(choices.Integer(-1000003, 600000)) / 7919 + Rational(choices.Integer(1, 9999)) / 1000003;
  }
  return problem;
}

// By expansion along the first row.
Rational Laplace(const ExactMatrix& M) {
  if (M.rows() == 0) return 1;
  Rational sum = 0;
  const int n = static_cast<int>(M.rows());
  for (int j = 0; j < n; ++j) {
    if (M(0, j) == 0) continue;
    ExactMatrix minor(n - 1, n - 1);
    for (int i = 1; i < n; ++i) {
      for (int k = 0; k < n - 1; ++k) minor(i - 1, k) = M(i, k < j ? k : k + 1);
    }
    sum += (j % 2 == 0 ? 1 : -1) * M(0, j) * Laplace(minor);
  }
  return sum;
}

// det R(W) as that of all rows, with a unit column for every row that the word leaves out
// (complete_driving.md, 4).
Rational UnfoldedDeterminant(const ExactProblem& problem, const ModeWord& word) {
  ExactMatrix M = ExactMatrix::Identity(problem.rows(), problem.rows());
  int row = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto& contact = problem.contacts[i];
    if (word[i] != kBreak) M.col(row) = problem.A.col(row);
    for (int k = 0; k < problem.rows(); ++k) {
      if (word[i] == kSlipPlus) M(k, row) -= contact.mu * problem.A(k, row + 1);
      if (word[i] == kSlipMinus) M(k, row) += contact.mu * problem.A(k, row + 1);
    }
    if (word[i] == kStick) M.col(row + 1) = problem.A.col(row + 1);
    row += contact.HasFrictionRows() ? 2 : 1;
  }
  return Laplace(M);
}

std::vector<ModeWord> WordsBehind(const ExactProblem& problem, std::size_t contact = 0) {
  if (contact == problem.contacts.size()) return {{}};
  std::vector<ModeWord> words;
  for (const Mode mode : ModesOf(problem.contacts[contact])) {
    for (ModeWord rest : WordsBehind(problem, contact + 1)) {
      rest.insert(rest.begin(), mode);
      words.push_back(rest);
    }
  }
  return words;
}

Json WitnessOf(const ExactProblem& problem) { return SafetyCertificate(problem)["witness"]; }
std::string ClaimOf(const ExactProblem& problem) { return SafetyCertificate(problem)["claim"]; }

// The verdict on a certificate, by its claim and problem.
bool Accepts(const Json& certificate) {
  try {
    const ExactProblem problem = ProblemFromJson(certificate["problem"], "c", "problem", true);
    const auto check = certificate["claim"] == "safe" ? CheckSafe : CheckUnsafe;
    return !FindFault(*check, problem, certificate["witness"]);
  } catch (const InputError&) {
    return false;
  }
}

// ---- Deciding --------------------------------------------------------------------------------

TEST_CASE("safe: one contact is safe if mu abs(A_NF) is less than A_NN") {
  const ExactProblem problem = WithMu(ThreeSolutions(), Rational(2, 5));
  const Safety safety = DecideSafety(problem);
  CHECK_FALSE(safety.unsafe_word);
  CHECK(safety.determinants == std::vector<Rational>{1, 1, Rational(1, 5), Rational(9, 5)});
  CHECK(WitnessOf(problem).dump() == R"({"determinants":["1","1","1/5","9/5"]})");
  CHECK(WitnessOf(WithMu(problem, 1)).dump() == R"({"word":["slip+"],"determinant":"-1"})");
  CHECK(ClaimOf(WithMu(problem, Rational(499, 1000))) == "safe");
  CHECK(ClaimOf(WithMu(problem, Rational(1, 2))) == "unsafe");
  CHECK(DecideSafety(WithMu(problem, Rational(1, 2))).determinants.back() == 0);
  CHECK(ClaimOf(WithMu(problem, 0)) == "safe");
}

TEST_CASE("safe: the reference problem is unsafe") {
  const Safety safety = DecideSafety(ReferenceProblem());
  REQUIRE(safety.unsafe_word);
  CHECK(UnfoldedDeterminant(ReferenceProblem(), *safety.unsafe_word) == safety.determinants.back());
  CHECK(safety.determinants.back() <= 0);
  CHECK(ClaimOf(WithMu(ReferenceProblem(), Rational(1, 100))) == "safe");
}

TEST_CASE("safe: no contacts at all are safe, and so is a frictionless positive definite problem") {
  CHECK(WitnessOf(NoContacts()).dump() == R"({"determinants":["1"]})");
  CHECK(DecideSafety(ExponentialFamily(6)).determinants.size() == 64);
  CHECK(ClaimOf(ExponentialFamily(6)) == "safe");
}

TEST_CASE("safe: a determinant of zero is unsafe") {
  CHECK(ClaimOf(MakeProblem({-1}, {{0}}, {1})) == "unsafe");
  CHECK(ClaimOf(MakeProblem({1}, {{1, -1}, {-1, 1}}, {-1, 0})) == "unsafe");
}

TEST_CASE("safe: determinants by elimination down the tree are those of the matrices themselves") {
  int safe = 0, unsafe = 0;
  for (int index = 0; index < 120; ++index) {
    CAPTURE(index);
    ExactProblem problem = index == 0 ? MixedProblem() : RandomDefinite(1 + index % 3, index);
    if (index % 4 == 1) problem.A(0, problem.rows() - 1) += 2;
    if (index % 5 == 2) problem.contacts[0].mu = 0;
    const Safety safety = DecideSafety(problem);
    const std::vector<ModeWord> words = WordsBehind(problem);
    std::size_t first = 0;
    while (first < words.size() && UnfoldedDeterminant(problem, words[first]) > 0) ++first;
    REQUIRE(safety.determinants.size() == std::min(first + 1, words.size()));
    CHECK(safety.unsafe_word.has_value() == (first < words.size()));
    if (safety.unsafe_word) CHECK(*safety.unsafe_word == words[first]);
    for (std::size_t k = 0; k < words.size(); ++k) {
      const Rational determinant = UnfoldedDeterminant(problem, words[k]);
      CHECK(ReducedDeterminant(problem, words[k]) == determinant);
      if (k < safety.determinants.size()) CHECK(safety.determinants[k] == determinant);
    }
    (safety.unsafe_word ? unsafe : safe) += 1;
  }
  CHECK(safe > 10);
  CHECK(unsafe > 10);
}

TEST_CASE("safe: clamped contacts without friction have the mean of the determinants of words") {
  for (int index = 0; index < 20; ++index) {
    const ExactProblem problem = RandomDefinite(2, index);
    const auto mean = [&](const Mode other) {
      return Rational(
          (ReducedDeterminant(problem, {kSlipPlus, other}) + ReducedDeterminant(problem, {kSlipMinus, other})) /
          2);
    };
    for (const Mode other : {kBreak, kStick, kSlipPlus}) {
      CHECK(ReducedDeterminant(problem, {kTouch, other}) == mean(other));
    }
    CHECK(ReducedDeterminant(problem, {kTouch, kTouch}) == (mean(kSlipPlus) + mean(kSlipMinus)) / 2);
  }
}

TEST_CASE("safe: other kinds, space, and too many words are refused") {
  ExactProblem sliding = ThreeSolutions();
  sliding.contacts[0] = {ContactKind::kSliding, 1, {Rational(1), Rational(0)}};
  CHECK_THROWS_AS(SafetyCertificate(sliding), InputError);
  CHECK_THROWS_AS(FindSafetyThreshold(sliding), InputError);
  CHECK(FindFault(CheckSafe, sliding, {{"determinants", {"1"}}})->path == "problem");
  CHECK_THROWS_WITH(DecideSafety(ExponentialFamily(17)), Contains("more than 65536 words"));
  CHECK_THROWS_AS(FindSafetyThreshold(ExponentialFamily(17)), InputError);
}

// ---- What safety is good for -----------------------------------------------------------------

// Whether the determinants of words are positive in which, for any contacts, the friction is kept with fN = 0.
bool IsSafeWithKeptFriction(const ExactProblem& problem) {
  const auto layout = LayoutOf(problem);
  for (int kept = 0; kept < 1 << layout.ContactCount(); ++kept) {
    ExactProblem without = problem;  // the normals of kept contacts; their friction is like a normal
    std::vector<int> rows;
    for (int row = 0; row < problem.rows(); ++row) {
      const int contact = layout.ContactOf(row);
      const bool is_kept = kept >> contact & 1;
      if (is_kept) without.contacts[contact] = {ContactKind::kFrictionless, 0, {}};
      if (!is_kept || !layout.IsNormal(row)) rows.push_back(row);
    }
    without.A = problem.A(rows, rows);
    without.b = problem.b(rows);
    if (DecideSafety(without).unsafe_word) return false;
  }
  return true;
}

TEST_CASE("safe: the published algorithm gives nothing up in a safe problem, and solves it", "[slow]") {
  int safe = 0, safe_with_kept = 0, with_give_ups = 0;
  for (int index = 0; index < testing::Few(400); ++index) {
    CAPTURE(index);
    ExactProblem problem = RandomDefinite(1 + index % 4, index);
    for (const Rational& mu : {Rational(1, 10), Rational(1, 2), Rational(5)}) {
      problem = WithMu(problem, mu);
      const auto gives_up = [&](const char* policy) {
        const Verdict verdict = RunExact(problem, {.policy = ParsePolicy(policy)}).verdict;
        return verdict.statistics.give_ups > 0 || verdict.outcome != Outcome::kSolved;
      };
      const bool is_safe = !DecideSafety(problem).unsafe_word;
      for (const char* policy : {"apex=suspended", "scan=highest,admit=eager,file=yes,apex=suspended"}) {
        const bool gave_up = gives_up(policy);
        if (is_safe) CHECK_FALSE(gave_up);
        with_give_ups += gave_up;
      }
      safe += is_safe;
      if (is_safe && IsSafeWithKeptFriction(problem)) {
        CHECK_FALSE(gives_up("paper"));
        ++safe_with_kept;
      }
    }
  }
  CHECK(safe > testing::Few(300));
  CHECK(safe_with_kept > testing::Few(300));
  CHECK(with_give_ups > testing::Few(10));
}

TEST_CASE("safe: at an apex that is kept the published algorithm gives up in a safe problem") {
  const ExactProblem problem =
      MakeProblem({Rational(2, 3), Rational(3, 4)},
                  {{6, 7, 4, 8}, {7, 13, 12, 4}, {4, 12, 29, 4}, {8, 4, 4, 25}}, {-2, -6, -20, 16});
  CHECK(ClaimOf(problem) == "safe");
  CHECK(IsPositiveSemidefinite(problem));
  CHECK_FALSE(IsSafeWithKeptFriction(problem));
  CHECK(RunExact(problem, {}).verdict.statistics.give_ups == 1);
  CHECK(RunExact(problem, {.policy = ParsePolicy("apex=suspended")}).verdict.statistics.give_ups == 0);
}

TEST_CASE("safe: a safe problem has one solution") {
  for (int index = 0; index < 40; ++index) {
    CAPTURE(index);
    const ExactProblem problem = WithMu(RandomDefinite(1 + index % 3, index), Rational(1, 4));
    if (DecideSafety(problem).unsafe_word) continue;
    CHECK(EnumerateModes(problem).distinct_witnesses == 1);
  }
}

TEST_CASE("safe: a safe problem has one solution for every b, definite or not, symmetric or not") {
  int safe = 0;
  for (int index = 0; index < 4000; ++index) {
    CAPTURE(index);
    Choices choices(index);
    ExactProblem problem = RandomDefinite(1 + index % 2, index);
    for (Rational& entry : problem.A.reshaped()) entry = choices.Integer(-5, 9);
    if (DecideSafety(WithMu(problem, Rational(1, 2))).unsafe_word) continue;
    ++safe;
    CHECK(EnumerateModes(WithMu(problem, Rational(1, 2))).distinct_witnesses == 1);
  }
  CHECK(safe > 200);
}

// ---- The threshold ---------------------------------------------------------------------------

TEST_CASE("safe: the threshold of one contact is A_NN over abs(A_NF)") {
  const auto threshold = FindSafetyThreshold(ThreeSolutions());
  REQUIRE(threshold);
  CHECK(threshold->word == ModeWord{kSlipPlus});
  CHECK(threshold->polynomial == std::vector<Rational>{1, -2});
  CHECK(threshold->low == Rational(1, 2));
  CHECK(threshold->high == Rational(1, 2));
}

TEST_CASE("safe: there is no threshold without coupling, and without friction") {
  CHECK_FALSE(FindSafetyThreshold(MakeProblem({1}, {{2, 0}, {0, 1}}, {0, 0})));
  CHECK_FALSE(FindSafetyThreshold(ExponentialFamily(4)));
  CHECK_FALSE(FindSafetyThreshold(NoContacts()));
}

TEST_CASE("safe: the threshold is zero where friction does not matter") {
  const auto singular = FindSafetyThreshold(NoSolution());
  REQUIRE(singular);
  CHECK(singular->word == ModeWord{kStick});
  CHECK(singular->polynomial == std::vector<Rational>{0});
  CHECK(singular->high == 0);
  // det slip- = -mu.
  const auto zero = FindSafetyThreshold(MakeProblem({1}, {{0, -1}, {1, 1}}, {0, 0}));
  REQUIRE(zero);
  CHECK(zero->word == ModeWord{kSlipMinus});
  CHECK(zero->polynomial == std::vector<Rational>{0, -1});
  CHECK(zero->low == 0);
  CHECK(zero->high == 0);
}

TEST_CASE("safe: the threshold of the reference problem is 1/3") {
  const auto threshold = FindSafetyThreshold(ReferenceProblem());
  REQUIRE(threshold);
  CHECK(threshold->word == ModeWord{kSlipMinus, kSlipPlus});
  CHECK(threshold->polynomial == std::vector<Rational>{13, -41, 6});  // (1 - 3 mu) (13 - 2 mu)
  CHECK(threshold->low == Rational(1, 3));
  CHECK(threshold->high == Rational(1, 3));
}

TEST_CASE("safe: a threshold that is irrational is isolated") {
  // Two slip- in a row: det [[1, 2 mu], [mu, 1]] = 1 - 2 mu^2.
  const ExactProblem problem =
      MakeProblem({1, 1}, {{1, 0, 0, 2}, {0, 9, 0, 0}, {0, 1, 1, 0}, {0, 0, 0, 9}}, {0, 0, 0, 0});
  const auto threshold = FindSafetyThreshold(problem);
  REQUIRE(threshold);
  CHECK(threshold->word == ModeWord{kSlipPlus, kSlipPlus});
  CHECK(threshold->polynomial == std::vector<Rational>{1, 0, -2});
  CHECK(2 * threshold->low * threshold->low < 1);
  CHECK(2 * threshold->high * threshold->high > 1);
  CHECK(threshold->high - threshold->low <= Rational(1, 1 << 20));
}

TEST_CASE("safe: below the threshold a problem is safe, at and just above it is not") {
  int found = 0;
  for (int index = 0; index < 60; ++index) {
    CAPTURE(index);
    const ExactProblem problem = RandomDefinite(1 + index % 3, index);
    const auto threshold = FindSafetyThreshold(problem);
    if (!threshold) {
      CHECK_FALSE(DecideSafety(WithMu(problem, 1000000)).unsafe_word);
      continue;
    }
    ++found;
    const auto value = [&](const Rational& mu) {
      Rational sum = 0, power = 1;
      for (const Rational& coefficient : threshold->polynomial) {
        sum += coefficient * power;
        power *= mu;
      }
      return sum;
    };
    for (const Rational& mu : {Rational(0), Rational(1, 3), Rational(7)}) {
      CHECK(value(mu) == ReducedDeterminant(WithMu(problem, mu), threshold->word));
    }
    for (int k = 1; k <= 8; ++k) {
      CHECK_FALSE(DecideSafety(WithMu(problem, threshold->low * Rational(8 * k - 1, 64))).unsafe_word);
    }
    const bool exact = threshold->low == threshold->high;
    CHECK(DecideSafety(WithMu(problem, threshold->low)).unsafe_word.has_value() == exact);
    CHECK((exact ? value(threshold->low) == 0 : value(threshold->low) * value(threshold->high) < 0));
    CHECK(DecideSafety(WithMu(problem, threshold->high)).unsafe_word);
  }
  CHECK(found > 40);
}

// ---- Singular A --------------------------------------------------------------------------------

// J J' of a J with fewer columns than rows, with a uniform mu: positive semidefinite, and b = J c in range.
ExactProblem Singular(std::uint64_t seed, int contacts, const Rational& mu) {
  std::mt19937_64 draw(seed);
  const auto number = [&draw] { return Rational(static_cast<int>(draw() % 7) - 3); };
  ExactMatrix J(2 * contacts, 2 * contacts - 1);
  for (auto& x : J.reshaped()) x = number();
  ExactVector c(J.cols());
  for (auto& x : c) x = number();
  ExactProblem problem;
  problem.contacts.assign(contacts, {ContactKind::kStatic, mu});
  problem.A = J * J.transpose();
  problem.b = J * c;
  return problem;
}

TEST_CASE("safe: the determinant of R + eps I is that of its coefficients") {
  for (int seed = 0; seed < 40; ++seed) {
    const ExactProblem problem = Singular(seed, 1 + seed % 3, Rational(1, 1 + seed % 4));
    for (const ModeWord& word : AllWords(problem)) {
      const ExactMatrix R = ReducedMatrix(problem, word);
      const auto coefficients = ShiftedDeterminant(R);
      REQUIRE(coefficients.size() == static_cast<std::size_t>(R.rows()) + 1);
      CHECK(coefficients.front() == ReducedDeterminant(problem, word));
      const Rational eps(3, 7);
      Rational value = 0, power = 1;
      for (const Rational& coefficient : coefficients) {
        value += coefficient * power;
        power *= eps;
      }
      const ExactMatrix shifted = R + eps * ExactMatrix::Identity(R.rows(), R.cols());
      CHECK(value == Laplace(shifted));
    }
  }
}

// A + eps I itself.
ExactProblem Softened(ExactProblem problem, const Rational& eps) {
  for (int i = 0; i < problem.rows(); ++i) problem.A(i, i) += eps;
  return problem;
}

TEST_CASE("safe: in the limit is what A + eps I is for small eps, and below the threshold of the limit") {
  int safe = 0, unsafe = 0, at_threshold = 0;
  const Rational eps(1, 1000000000000);
  for (int seed = 0; seed < 120; ++seed) {
    const ExactProblem problem = Singular(seed, 1 + seed % 3, Rational(1, 1 + seed % 6));
    const WeakSafety weak = DecideWeakSafety(problem);
    CHECK(weak.vanishing > 0);
    CHECK(weak.limit_word.has_value() == DecideSafety(Softened(problem, eps)).unsafe_word.has_value());
    if (!weak.limit_word) CHECK_FALSE(weak.negative_word);
    weak.limit_word ? ++unsafe : ++safe;
    const auto threshold = FindLimitThreshold(problem);
    if (!threshold || threshold->low == 0) continue;
    ++at_threshold;
    CHECK_FALSE(DecideWeakSafety(WithMu(problem, threshold->low * Rational(99, 100))).limit_word);
    CHECK(FindSafetyThreshold(problem)->high == 0);
  }
  CAPTURE(safe, unsafe, at_threshold);
  CHECK((safe > 10 && unsafe > 10 && at_threshold > 10));
}

TEST_CASE("safe: where no determinant is negative complete driving neither folds nor descends") {
  int weakly = 0, turned = 0;
  for (int seed = 0; seed < 300; ++seed) {
    const ExactProblem problem = Singular(seed, 1 + seed % 3, Rational(6, 1 + seed % 17));
    const ExactAnswer run = RunComplete(problem, {});
    REQUIRE(run.Solved());
    const auto folds = run.counters[Counter::kFolds], descents = run.counters[Counter::kDescents];
    const bool is_weakly_safe = !DecideWeakSafety(problem).negative_word;
    weakly += is_weakly_safe;
    turned += folds + descents > 0;
    if (is_weakly_safe) CHECK((folds == 0 && descents == 0));
  }
  CAPTURE(weakly, turned);
  CHECK((weakly > 30 && turned > 2));
}

TEST_CASE("safe: a block that cannot tip, at the mu where its slip is singular, is weakly safe") {
  const ExactProblem problem = MakeProblem({1}, {{1, 1}, {1, 1}}, {0, 0});
  const WeakSafety weak = DecideWeakSafety(problem);
  CHECK_FALSE(weak.negative_word);
  CHECK(weak.vanishing == 2);  // stick; slip+: 1 - 1
  CHECK_FALSE(weak.limit_word);
  const auto threshold = FindLimitThreshold(problem);
  REQUIRE(threshold);
  CHECK((threshold->low == 1 && threshold->high == 1));
}

// ---- Certificates ----------------------------------------------------------------------------

// The verdicts of check_certificate.py.
std::vector<bool> PythonAccepts(const std::vector<Json>& certificates) {
  const std::filesystem::path sources = STICTION_SOURCES;
  std::string folder = (std::filesystem::temp_directory_path() / "stiction-safe-XXXXXX").string();
  REQUIRE(mkdtemp(folder.data()) != nullptr);
  std::string command = "python3 '" + (sources / "certify/check_certificate.py").string() + "'";
  for (std::size_t k = 0; k < certificates.size(); ++k) {
    const std::string file = folder + "/" + std::to_string(k);
    std::ofstream(file) << certificates[k].dump();
    command += " " + file;
  }
  std::vector<bool> accepted;
  FILE* output = popen(command.c_str(), "r");
  REQUIRE(output != nullptr);
  std::string line;
  for (int c; (c = fgetc(output)) != EOF;) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    const bool yes = line.find(": accepted: ") != std::string::npos;
    CHECK(yes != (line.find(": REJECTED: ") != std::string::npos));
    accepted.push_back(yes);
    line.clear();
  }
  pclose(output);
  std::filesystem::remove_all(folder);
  REQUIRE(accepted.size() == certificates.size());
  return accepted;
}

// Of safe and unsafe problems of all kinds.
std::vector<Json> Certificates() {
  std::vector<Json> certificates;
  for (const ExactProblem& problem :
       {WithMu(ThreeSolutions(), Rational(2, 5)), ThreeSolutions(), ReferenceProblem(), NoContacts(),
        NoSolution(), MakeProblem({1}, {{0, 1}, {1, 1}}, {0, 0}), ExponentialFamily(3),
        MakeProblem({0, -1}, {{2, 5, 1}, {1, 0, 1}, {1, 7, 3}}, {1, 1, 1}), MixedProblem(),
        WithMu(ReferenceProblem(), Rational(1, 9)), WithMu(MixedProblem(), 9)}) {
    certificates.push_back(SafetyCertificate(problem));
  }
  return certificates;
}

TEST_CASE("safe: certificates of both claims are accepted, in C++ and in Python") {
  std::vector<Json> certificates = Certificates();
  for (int index = 0; index < 30; ++index) {
    certificates.push_back(SafetyCertificate(RandomDefinite(1 + index % 3, index)));
  }
  int safe = 0;
  for (const Json& certificate : certificates) {
    CHECK(Accepts(certificate));
    safe += certificate["claim"] == "safe";
  }
  CHECK(safe > 5);
  CHECK(safe < 35);
  CHECK(PythonAccepts(certificates) == std::vector<bool>(certificates.size(), true));
  CHECK(CheckSafe(NoContacts(), WitnessOf(NoContacts())) == Json({{"words", 1}, {"smallest", "1"}}));
}

// Every value below a place of a document, altered in several ways or taken away.
void Alter(const Json& whole, const Json::json_pointer& at, std::vector<Json>& altered) {
  const auto put = [&](const Json& value) {
    if (value == whole.at(at)) return;
    altered.push_back(whole);
    altered.back()[at] = value;
  };
  const Json& here = whole.at(at);
  for (const Json& value : {Json(nullptr), Json(1), Json("1"), Json("0"), Json("-1/3"), Json("slip+"),
                            Json("break"), Json("touch"), Json::array(), Json::object()}) {
    put(value);
  }
  if (here.is_object() || here.is_array()) {
    for (const auto& [key, value] : here.items()) {
      Json less = here;
      here.is_object() ? (void)less.erase(key) : less.erase(std::stoul(key));
      put(less);
      Alter(whole, at / Json::json_pointer("/" + key), altered);
    }
    Json more = here;
    here.is_object() ? (void)(more["other"] = "1") : more.push_back(here.empty() ? Json("1") : here.back());
    put(more);
  } else if (const auto value = here.is_string() ? ParseRational(here.get<std::string>()) : std::nullopt) {
    for (const Rational& other : {Rational(*value + 1), Rational(-*value), Rational(*value / 2)})
      put(ToString(other));
  }
}

// Whether a witness that is right in form is true, from its numbers alone.
bool IsTrue(const Json& certificate) {
  const ExactProblem problem = ProblemFromJson(certificate["problem"], "c", "problem", true);
  const Json& witness = certificate["witness"];
  const auto words = WordsBehind(problem);
  const auto states = [&](const Json& value, const ModeWord& word) {
    return Number(value.get<std::string>()) == UnfoldedDeterminant(problem, word);
  };
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (certificate["claim"] == "unsafe") {
      if (WordToJson(words[k]) != witness["word"]) continue;
      return states(witness["determinant"], words[k]) && Number(witness["determinant"].get<std::string>()) <= 0;
    }
    const Json& value = witness["determinants"][k];
    if (!states(value, words[k]) || Number(value.get<std::string>()) <= 0) return false;
  }
  return certificate["claim"] == "safe" && witness["determinants"].size() == words.size();
}

TEST_CASE("safe: an altered certificate is refused unless it is true, and Python says the same", "[slow]") {
  std::vector<Json> altered;
  for (const Json& certificate : Certificates()) {
    if (certificate["problem"]["b"].size() > 4) continue;
    Alter(certificate, Json::json_pointer("/witness"), altered);
    Alter(certificate, Json::json_pointer("/problem/contacts"), altered);
    Alter(certificate, Json::json_pointer("/problem/A"), altered);
    altered.push_back(certificate);
    altered.back()["claim"] = certificate["claim"] == "safe" ? "unsafe" : "safe";
  }
  altered.push_back(Certificates().front());
  altered.back()["problem"]["contacts"][0] = {{"kind", "sliding"}, {"mu", "2/5"}, {"slip", "1"}};
  CHECK_FALSE(Accepts(altered.back()));
  altered.push_back(Certificates().front());  // true numbers, one of them zero
  altered.back()["problem"]["contacts"][0]["mu"] = "1/2";
  altered.back()["witness"]["determinants"] = {"1", "1", "0", "2"};
  CHECK_FALSE(Accepts(altered.back()));
  altered.push_back(Certificates().front());  // a true number that is positive
  altered.back()["claim"] = "unsafe";
  altered.back()["witness"] = {{"word", {"slip+"}}, {"determinant", "1/5"}};
  CHECK_FALSE(Accepts(altered.back()));
  std::vector<bool> accepted;
  int true_all_the_same = 0;
  for (const Json& certificate : altered) {
    accepted.push_back(Accepts(certificate));
    if (!accepted.back()) continue;
    ++true_all_the_same;
    CAPTURE(certificate.dump());
    CHECK(IsTrue(certificate));
  }
  CHECK(altered.size() > 500);
  CHECK(true_all_the_same < static_cast<int>(altered.size()) / 5);
  CHECK(PythonAccepts(altered) == accepted);
}

TEST_CASE("safe: a rejected witness is told by path, what was found and what was expected") {
  const ExactProblem safe = WithMu(ThreeSolutions(), Rational(2, 5));
  Json witness = WitnessOf(safe);
  witness["determinants"][2] = "1/6";
  const auto wrong = FindFault(CheckSafe, safe, witness);
  REQUIRE(wrong);
  CHECK(wrong->path == "witness.determinants[2]");
  CHECK(wrong->found == "\"1/6\"");
  CHECK_THAT(wrong->expected, Contains("1/5") && Contains("slip+"));
  const Json positive = {{"word", {"slip+"}}, {"determinant", "1/5"}};
  CHECK(FindFault(CheckUnsafe, safe, positive)->expected == "a number <= 0");
  const Json negative = {{"determinants", {"1", "1", "-1", "3"}}};
  CHECK(FindFault(CheckSafe, ThreeSolutions(), negative)->expected == "a number > 0");
}

}  // namespace
}  // namespace stiction
