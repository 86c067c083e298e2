// SPDX-License-Identifier: Apache-2.0
// Enumeration of contact modes, and the certificates of no solution made from it.

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "certify/claims/existence.h"
#include "certify/claims/witness.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/farkas.h"
#include "certify/exact/verify_solution.h"
#include "corpus/json.h"
#include "solver/problem/check.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using enum Mode;

std::string Text(const ModeWord& word) {
  std::string text;
  for (const Mode mode : word) text += std::string(text.empty() ? "" : " ") + std::string(Name(mode));
  return text;
}

std::vector<std::string> Words(const Enumeration& enumeration) {
  std::vector<std::string> words;
  for (const WordSolution& solution : enumeration.solutions) words.push_back(Text(solution.word));
  return words;
}

ExactProblem Sliding(ExactProblem problem, int slip = 1) {
  for (auto& contact : problem.contacts) {
    contact.kind = ContactKind::kSliding;
    contact.slip[0] = slip;
  }
  return problem;
}

ExactProblem Rod(const Rational& b) {
  return MakeProblem({2}, {{Rational(8, 5), Rational(6, 5)}, {Rational(6, 5), Rational(17, 5)}}, {b, 0});
}

// Every kind by chance, b anywhere.
ExactProblem RandomOfAllKinds(int contacts, std::uint64_t index) {
  const ExactProblem rough = Random<Rational>(GeneratorId::kSmall, contacts, index);
  Choices choices(index);
  ExactProblem problem;
  std::vector<int> kept;
  for (int i = 0; i < contacts; ++i) {
    Contact<Rational> contact = rough.contacts[i];
    contact.kind = static_cast<ContactKind>(choices.Integer(0, 3));
    if (contact.kind == ContactKind::kSliding) contact.slip[0] = choices.Integer(0, 1) == 0 ? -1 : 1;
    if (!contact.HasFrictionRows() || choices.Integer(0, 5) == 0) contact.mu = 0;
    problem.contacts.push_back(contact);
    kept.push_back(2 * i);
    if (contact.HasFrictionRows()) kept.push_back(2 * i + 1);
  }
  const int rows = static_cast<int>(kept.size());
  problem.A.resize(rows, rows);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.b[i] = choices.Integer(-4, 4);
    for (int j = 0; j < rows; ++j) problem.A(i, j) = rough.A(kept[i], kept[j]);
  }
  return problem;
}

// What every complete enumeration must satisfy.
void CheckEnumeration(const ExactProblem& problem, const Enumeration& enumeration) {
  CHECK(enumeration.end == EnumerationEnd::kComplete);
  for (const WordSolution& solution : enumeration.solutions) {
    CHECK_FALSE(FindViolation(problem, solution.f));
    CHECK(MeetsModes(problem, solution.word, solution.f, Accelerations(problem, solution.f)));
  }
  for (const RefutedPrefix& refuted : enumeration.refuted) {
    CHECK_FALSE(FindRefutationGap(problem, refuted.modes, MakeFarkasVector(problem, refuted.y)));
  }
  Rational covered = 0;  // parts of all words
  const auto add = [&](const ModeWord& prefix) {
    Rational share = 1;
    for (std::size_t i = 0; i < prefix.size(); ++i)
      share /= static_cast<int>(ModesOf(problem.contacts[i]).size());
    covered += share;
  };
  for (const WordSolution& solution : enumeration.solutions) add(solution.word);
  for (const RefutedPrefix& refuted : enumeration.refuted) add(refuted.modes);
  CHECK(covered == 1);
  if (enumeration.ProvesNoSolution()) {
    const Json certificate = NoSolutionCertificate(problem, enumeration);
    CHECK_FALSE(FindFault(CheckNoSolution, problem, certificate["witness"]));
  }
}

// ---- Known examples --------------------------------------------------------------------------

TEST_CASE("modes: the scripted wedge has no solution for mu >= 1, and one for mu < 1") {
  ExactProblem wedge = NoSolution();
  for (const Rational& mu : {Rational(1), Rational(3, 2), Rational(100)}) {
    wedge.contacts[0].mu = mu;
    const Enumeration none = EnumerateModes(wedge);
    CHECK(none.ProvesNoSolution());
    CheckEnumeration(wedge, none);
  }
  wedge.contacts[0].mu = Rational(9, 10);
  const Enumeration one = EnumerateModes(wedge);
  CheckEnumeration(wedge, one);
  REQUIRE(Words(one) == std::vector<std::string>{"slip-"});
  CHECK(one.solutions[0].f == Vector({10, 9}));
  CHECK(one.solutions[0].unique);
}

TEST_CASE("modes: a zero matrix is refuted by one vector for the empty prefix") {
  const ExactProblem problem = MakeProblem({1}, {{0, 0}, {0, 0}}, {-1, 0});
  const Enumeration none = EnumerateModes(problem);
  CHECK(none.ProvesNoSolution());
  REQUIRE(none.refuted.size() == 1);
  CHECK(none.refuted[0].modes.empty());
  CHECK(none.refuted[0].y == Vector({1, 0}));
  CHECK(none.programs == 1);
  CheckEnumeration(problem, none);
}

TEST_CASE("modes: one sliding contact by the sign of p = A_NN - mu A_NF and of bN") {
  const auto enumerate = [](const Rational& p, const Rational& b) {
    const ExactProblem problem = Sliding(MakeProblem({1}, {{2 + p, 2}, {2, 100}}, {b, 0}));
    const Enumeration enumeration = EnumerateModes(problem);
    CheckEnumeration(problem, enumeration);
    return enumeration;
  };
  CHECK(enumerate(-1, -1).ProvesNoSolution());
  CHECK(enumerate(0, -1).ProvesNoSolution());
  const Enumeration two = enumerate(-1, 3);
  CHECK(Words(two) == std::vector<std::string>{"break", "touch"});
  CHECK(two.solutions[0].f == Vector({0, 0}));
  CHECK(two.solutions[1].f == Vector({3, -3}));
  CHECK(two.distinct_witnesses == 2);
  CHECK(Words(enumerate(2, -1)) == std::vector<std::string>{"touch"});
  CHECK(Words(enumerate(2, 1)) == std::vector<std::string>{"break"});
  const Enumeration unbounded = enumerate(0, 0);  // f = t (1, -1)
  CHECK(Words(unbounded) == std::vector<std::string>{"break", "touch"});
  CHECK_FALSE(unbounded.solutions[1].unique);
}

TEST_CASE("modes: the sign of the slip matters") {
  const ExactProblem problem = MakeProblem({1}, {{1, 2}, {2, 5}}, {-1, 0});
  CHECK(EnumerateModes(Sliding(problem, 1)).ProvesNoSolution());
  const Enumeration other = EnumerateModes(Sliding(problem, -1));
  REQUIRE(Words(other) == std::vector<std::string>{"touch"});
  CHECK(other.solutions[0].f == Vector({Rational(1, 3), Rational(1, 3)}));
}

TEST_CASE("modes: the rod with mu = 2 is inconsistent while it slides, and sticks at rest") {
  CHECK(EnumerateModes(Sliding(Rod(-10))).ProvesNoSolution());
  const Enumeration two = EnumerateModes(Sliding(Rod(10)));
  REQUIRE(two.solutions.size() == 2);
  CHECK(two.solutions[1].f == Vector({Rational(25, 2), -25}));
  const Enumeration still = EnumerateModes(Rod(-10));
  CheckEnumeration(Rod(-10), still);
  REQUIRE(Words(still) == std::vector<std::string>{"stick"});
  CHECK(still.solutions[0].f == Vector({Rational(17, 2), -3}));
}

TEST_CASE("modes: three isolated solutions of one contact, nine of two") {
  const ExactProblem one = ThreeSolutions(), two = Decoupled(one, one);
  const Enumeration three = EnumerateModes(one);
  CheckEnumeration(one, three);
  CHECK(Words(three) == std::vector<std::string>{"break", "stick", "slip+"});
  CHECK(three.solutions[0].f == Vector({0, 0}));
  CHECK(three.solutions[1].f == Vector({3, -2}));
  CHECK(three.solutions[2].f == Vector({1, -1}));
  const Enumeration nine = EnumerateModes(two);
  CheckEnumeration(two, nine);
  CHECK(nine.solutions.size() == 9);
  CHECK(nine.distinct_witnesses == 9);
  for (const WordSolution& solution : nine.solutions) CHECK(solution.unique);
}

TEST_CASE("modes: solution sets that are no point are said to be none") {
  // All f with fN - fF = 1, fN in [2/3, 2], stick.
  const ExactProblem bounded = MakeProblem({Rational(1, 2)}, {{1, -1}, {-1, 1}}, {-1, 1});
  const Enumeration segment = EnumerateModes(bounded);
  CheckEnumeration(bounded, segment);
  REQUIRE(Words(segment) == std::vector<std::string>{"stick", "slip+", "slip-"});
  CHECK_FALSE(segment.solutions[0].unique);
  CHECK(segment.solutions[1].unique);
  CHECK(segment.solutions[2].unique);
  // Jammed: f = t (1, 1) for every t >= 0.
  const ExactProblem jammed = MakeProblem({2}, {{1, -1}, {-1, 1}}, {0, 0});
  const Enumeration cone = EnumerateModes(jammed);
  CheckEnumeration(jammed, cone);
  CHECK_FALSE(cone.solutions[1].unique);
  // A vertex of its word, though fewer equations than unknowns are needed to say so: rank and signs.
  const ExactProblem apex = MakeProblem({1}, {{0, 0}, {0, 0}}, {0, 0});
  for (const WordSolution& solution : EnumerateModes(apex).solutions) {
    CHECK(solution.unique == (solution.word[0] == kBreak));
  }
}

TEST_CASE("modes: what is far from its limit does not make a solution the only one, nor do equations alone") {
  // f1 + f2 = 1; the third contact breaks at a distance that depends on f1 - f2.
  const ExactProblem shared = MakeProblem({-1, -1, -1}, {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}}, {-1, -1, 10});
  int found = 0;
  for (const WordSolution& solution : EnumerateModes(shared).solutions) {
    if (Text(solution.word) != "touch touch break") continue;
    ++found;
    CHECK_FALSE(solution.unique);
  }
  CHECK(found == 1);
  // Two bilateral contacts that share a load may pull against each other as they like.
  ExactProblem twins = MakeProblem({-1, -1}, {{1, 1}, {1, 1}}, {-1, -1});
  for (auto& contact : twins.contacts) contact.kind = ContactKind::kBilateral;
  const Enumeration held = EnumerateModes(twins);
  REQUIRE(held.solutions.size() == 1);
  CHECK_FALSE(held.solutions[0].unique);
}

TEST_CASE("modes: with tangents turned round slips change places, and solutions are the only ones as before") {
  const auto turned = [](ModeWord word) {
    for (Mode& mode : word) mode = mode == kSlipPlus ? kSlipMinus : mode == kSlipMinus ? kSlipPlus : mode;
    return word;
  };
  int words = 0, continua = 0;
  for (std::uint64_t index = 0; index < 150; ++index) {  // of low rank and small integers: many ties
    Choices choices(index);
    ExactMatrix J(4, 2);
    for (Rational& x : J.reshaped()) x = choices.Integer(-1, 1);
    ExactProblem problem = MakeProblem({1, 1}, {}, {0, 0, 0, 0});
    problem.A = J * J.transpose();
    problem.b = J * Vector({choices.Integer(-1, 1), choices.Integer(-1, 1)});
    std::map<ModeWord, bool> unique;
    for (const WordSolution& solution : EnumerateModes(problem).solutions)
      unique[solution.word] = solution.unique;
    const Enumeration other = EnumerateModes(InUnits(problem, {1, -1, 1, -1}));
    CAPTURE(index);
    REQUIRE(other.solutions.size() == unique.size());
    for (const WordSolution& solution : other.solutions) {
      const auto same = unique.find(turned(solution.word));
      REQUIRE(same != unique.end());
      CHECK(same->second == solution.unique);
      ++words;
      continua += !solution.unique;
    }
  }
  CHECK(words > 200);
  CHECK(continua > 50);
}

// ---- Kinds -----------------------------------------------------------------------------------

TEST_CASE("modes: of each kind") {
  const auto modes = [](ContactKind kind, const Rational& mu) {
    const auto list = ModesOf({kind, mu, {}});
    return Text(ModeWord(list.begin(), list.end()));
  };
  CHECK(modes(ContactKind::kBilateral, 0) == "hold");
  CHECK(modes(ContactKind::kFrictionless, 0) == "break touch");
  CHECK(modes(ContactKind::kSliding, 2) == "break touch");
  CHECK(modes(ContactKind::kSliding, 0) == "break touch");
  CHECK(modes(ContactKind::kStatic, 0) == "break touch");
  CHECK(modes(ContactKind::kStatic, 2) == "break stick slip+ slip-");
}

TEST_CASE("modes: a bilateral contact may pull, and can make a problem inconsistent") {
  ExactProblem problem = MakeProblem({-1, -1}, {{1, 0}, {0, 1}}, {2, 2});
  problem.contacts[0].kind = ContactKind::kBilateral;
  const Enumeration pulled = EnumerateModes(problem);
  CheckEnumeration(problem, pulled);
  REQUIRE(Words(pulled) == std::vector<std::string>{"hold break"});
  CHECK(pulled.solutions[0].f == Vector({-2, 0}));
  CHECK(pulled.solutions[0].unique);
  problem.A(0, 0) = 0;
  const Enumeration none = EnumerateModes(problem);
  CHECK(none.ProvesNoSolution());
  CheckEnumeration(problem, none);
}

TEST_CASE("modes: no contacts have the empty word, space is refused") {
  const Enumeration empty = EnumerateModes(NoContacts());
  REQUIRE(empty.solutions.size() == 1);
  CHECK(empty.solutions[0].word.empty());
  CHECK(empty.solutions[0].unique);
  ExactProblem space = NoContacts();
  space.dimension = 3;
  CHECK_THROWS_AS(EnumerateModes(space), InputError);
}

TEST_CASE("modes: f is a solution where it meets the conditions of some word, and only there") {
  for (std::uint64_t index = 0; index < 2000; ++index) {
    ExactProblem problem = Random<Rational>(GeneratorId::kSmall, 2, index);
    Choices choices(index);
    ExactVector f(problem.rows()), a(problem.rows());
    for (int i = 0; i < f.size(); ++i) {
      f[i] = choices.Integer(-1, 2);
      a[i] = choices.Integer(-1, 1);
    }
    problem.b += a - Accelerations(problem, f);
    const std::vector<ModeWord> words = AllWords(problem);
    const bool in_some_word = std::any_of(
        words.begin(), words.end(), [&](const ModeWord& word) { return MeetsModes(problem, word, f, a); });
    CHECK(in_some_word == !FindViolation(problem, f));
    if (index % 10 != 0) continue;
    for (const WordSolution& solution : EnumerateModes(problem).solutions) {
      CHECK_FALSE(FindViolation(problem, solution.f));
    }
  }
}

// ---- Random problems ---------------------------------------------------------------------------

TEST_CASE("modes: problems of all kinds, any b: solutions, refutations and their cover") {
  int without = 0;
  for (int contacts = 1; contacts <= 4; ++contacts) {
    for (std::uint64_t index = 0; index < 60; ++index) {
      const ExactProblem problem = RandomOfAllKinds(contacts, index);
      INFO(contacts << " " << index);
      const Enumeration enumeration = EnumerateModes(problem);
      CheckEnumeration(problem, enumeration);
      without += enumeration.ProvesNoSolution();
    }
  }
  CHECK(without > 40);
}

TEST_CASE("modes: the answer of the published algorithm lies in a word found, on in-range problems") {
  for (const GeneratorId id : {GeneratorId::kIntegers, GeneratorId::kDuplicates, GeneratorId::kBodies}) {
    for (std::uint64_t index = 0; index < 40; ++index) {
      const ExactProblem problem = Random<Rational>(id, 2, index);
      const Enumeration enumeration = EnumerateModes(problem);
      CheckEnumeration(problem, enumeration);
      CHECK_FALSE(enumeration.solutions.empty());
      const ExactRun run = RunExact(problem, {});
      if (run.verdict.outcome != Outcome::kSolved) continue;
      int words = 0;
      for (const WordSolution& solution : enumeration.solutions) {
        const bool within = MeetsModes(problem, solution.word, run.f, run.a);
        words += within;
        if (within && solution.unique) CHECK(solution.f == run.f);
      }
      CHECK(words > 0);
    }
  }
}

// ---- Options -----------------------------------------------------------------------------------

TEST_CASE("modes: the first solution only, a spent budget, a cancelled search") {
  const ExactProblem problem = Decoupled(ThreeSolutions(), ThreeSolutions());
  const Enumeration first = EnumerateModes(problem, {}, UntilSolved);
  CHECK(first.end == EnumerationEnd::kStopped);
  CHECK(first.solutions.size() == 1);
  const std::int64_t all = EnumerateModes(problem).programs;
  for (const std::int64_t budget : {std::int64_t{2}, all - 1, all}) {
    const Enumeration within = EnumerateModes(problem, {.limits = {.programs = budget}});
    CHECK(within.end == (budget < all ? EnumerationEnd::kLimit : EnumerationEnd::kComplete));
    CHECK(within.programs == budget);
  }
  double decided = 0;
  const auto watch = [&](const Enumeration& so_far) {
    CHECK(so_far.decided > decided);
    decided = so_far.decided;
    return true;
  };
  CHECK(EnumerateModes(problem, {}, watch).end == EnumerationEnd::kComplete);
  CHECK(decided == Approx(1));
  const std::atomic<bool> stop = true;
  const Enumeration stopped = EnumerateModes(problem, {.limits = {.stop = &stop}});
  CHECK(stopped.end == EnumerationEnd::kStopped);
  CHECK(stopped.prefixes < EnumerateModes(problem).prefixes);
  const Enumeration cancelled =
      EnumerateModes(problem, {}, [](const Enumeration& so_far) { return so_far.solutions.size() < 2; });
  CHECK(cancelled.end == EnumerationEnd::kStopped);
  CHECK(cancelled.solutions.size() == 2);
  CHECK_FALSE(cancelled.ProvesNoSolution());
  CHECK_THROWS_AS(NoSolutionCertificate(problem, cancelled), InternalError);
}

// ---- Certificates ------------------------------------------------------------------------------

// A problem of two static contacts without a solution whose proof has several prefixes.
std::pair<ExactProblem, Json> ProofInParts() {
  const ExactProblem problem = Decoupled(ThreeSolutions(), NoSolution());
  return {problem, NoSolutionCertificate(problem, EnumerateModes(problem))->at("witness")};
}

TEST_CASE("no-solution: a certificate that is tampered with is refused") {
  const auto [problem, witness] = ProofInParts();
  REQUIRE(witness["prefixes"].size() > 4);
  REQUIRE_FALSE(FindFault(CheckNoSolution, problem, witness));
  const auto refused = [&problem = problem](const Json& changed, const std::string& path) {
    const auto fault = FindFault(CheckNoSolution, problem, changed);
    REQUIRE(fault);
    CHECK(fault->path.starts_with(path));
  };
  for (std::size_t k = 0; k < witness["prefixes"].size(); ++k) {
    const std::string path = "witness.prefixes[" + std::to_string(k) + "]";
    Json changed = witness;
    changed["prefixes"].erase(k);
    refused(changed, "witness.prefixes");
    changed = witness;
    changed["prefixes"].push_back(witness["prefixes"][k]);
    refused(changed, "witness.prefixes");
    changed = witness;
    for (Json& entry : changed["prefixes"][k]["y"]) entry = ToString(-Number(entry.get<std::string>()));
    refused(changed, path + ".y");
    changed = witness;
    for (Json& entry : changed["prefixes"][k]["y"]) entry = "0";
    refused(changed, path + ".y");
    changed = witness;
    changed["prefixes"][k]["y"].push_back("0");
    refused(changed, path + ".y");
    changed = witness;
    changed["prefixes"][k]["y"][0] = 1;
    refused(changed, path + ".y[0]");
    changed = witness;
    changed["prefixes"][k]["modes"][0] = "touch";
    refused(changed, path + ".modes[0]");
    changed = witness;
    changed["prefixes"][k]["modes"].push_back("stick");
    refused(changed, "witness.prefixes");
    changed = witness;
    changed["prefixes"][k]["note"] = "";
    refused(changed, path);
  }
  refused({{"prefixes", Json::array()}}, "witness.prefixes");
  refused({{"prefixes", 1}}, "witness.prefixes");
  refused(Json::array(), "witness");
}

TEST_CASE("no-solution: a prefix and its extension are refused, and so is any cover of a solvable problem") {
  const auto [problem, witness] = ProofInParts();
  Json changed = witness;
  Json longer = changed["prefixes"][0];
  while (longer["modes"].size() < 2) longer["modes"].push_back("stick");
  if (longer["modes"] != changed["prefixes"][0]["modes"]) changed["prefixes"].push_back(longer);
  if (changed != witness) CHECK(FindFault(CheckNoSolution, problem, changed));
  ExactProblem solvable = problem;
  solvable.contacts[1].mu = Rational(1, 2);
  CHECK(FindFault(CheckNoSolution, solvable, witness));
}

TEST_CASE("no-solution: the proof of another problem is refused") {
  const auto [problem, witness] = ProofInParts();
  for (int i = 0; i < problem.rows(); ++i) {
    ExactProblem other = problem;
    other.b[i] += 10;
    if (!EnumerateModes(other).solutions.empty()) CHECK(FindFault(CheckNoSolution, other, witness));
  }
}

}  // namespace
}  // namespace stiction
