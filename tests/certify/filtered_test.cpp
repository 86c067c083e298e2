// SPDX-License-Identifier: Apache-2.0
// The planar methods over balls: the pivots of rationals, and forces within their ends. Rung after rung they
// end as runs over rationals do.

#include "certify/exact/filtered.h"

#include <catch2/catch.hpp>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/claims/witness.h"
#include "certify/exact/dependent_rows.h"
#include "certify/exact/exact.h"
#include "certify/exact/nearby_words.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "corpus/json.h"
#include "corpus/rounded.h"
#include "tests/methods.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// Positive definite, numbers that are no doubles and tie by no accident.
ExactProblem Generic(int contacts, std::uint64_t seed) {
  Choices choices(seed);
  static const std::vector<Rational> palette = {Rational(1, 5), Rational(1, 3), 1, 2, 5};
  ExactProblem problem;
  const int rows = 2 * contacts;
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, palette[choices.Integer(0, 4)], {}});
  ExactMatrix J(rows, rows);
  for (Rational& x : J.reshaped()) x = Rational(choices.Integer(-1000, 1000)) / 7;
  problem.A = J * J.transpose();
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.A(i, i) += 1;
    problem.b[i] = Rational(choices.Integer(-1000, i % 2 == 0 ? 300 : 1000)) / 3;
  }
  return problem;
}

// The first contact slides.
ExactProblem WithSlip(ExactProblem problem) {
  problem.contacts[0].kind = ContactKind::kSliding;
  problem.contacts[0].slip = {1, 0};
  return problem;
}

// What the pivots did, in words.
template <class Scalar>
std::vector<std::string> Steps(const std::vector<Pivot<Scalar>>& pivots) {
  std::vector<std::string> steps;
  for (const auto& pivot : pivots) {
    steps.push_back(std::to_string(pivot.driven) + " " + std::to_string(pivot.limiting) + " " + Name(pivot.to) +
                    " " + pivot.entering + " " + pivot.leaving);
  }
  return steps;
}

void CheckEnclosed(const std::vector<Enclosure>& ends, const ExactVector& values) {
  REQUIRE(ends.size() == static_cast<std::size_t>(values.size()));
  for (std::size_t i = 0; i < ends.size(); ++i) {
    CHECK(Rational(ends[i].low) <= values[i]);
    CHECK(values[i] <= Rational(ends[i].high));
  }
}

// Whether the run was decided. What it says is what the exact run says, pivot by pivot.
bool Agrees(const InexactAnswer& run, const ExactAnswer& exact) {
  const auto steps = Steps(run.pivots), all = Steps(exact.pivots);
  REQUIRE(steps.size() <= all.size());
  CHECK(std::equal(steps.begin(), steps.end(), all.begin()));
  if (run.outcome == Outcome::kUndecided) {
    CHECK(run.reason == kUnsureSign);
    return false;
  }
  CHECK(run.outcome == exact.outcome);
  CHECK(run.start == exact.start);
  CHECK(run.period == exact.period);
  CHECK(run.counters == exact.counters);
  CHECK(run.word == exact.word);
  CHECK(steps.size() == all.size());
  if (exact.Solved()) {
    CheckEnclosed(run.f_enclosed, exact.f);
    CheckEnclosed(run.a_enclosed, exact.a);
  }
  return true;
}

// On both rungs; whether each decided.
struct Decided {
  bool narrow = false, wide = false;
};
Decided AgreeOnRungs(std::string_view method, const ExactProblem& problem, const Policy& policy = {}) {
  const Request request{.method = method, .policy = policy, .trace = true};
  const ExactAnswer exact = std::get<ExactAnswer>(SolveIn(problem, request).answer);
  const auto agrees = [&](Rung rung) { return Agrees(RunEnclosed(method, problem, request, rung), exact); };
  return {agrees(Rung::kDouble), agrees(Rung::kDoubleDouble)};
}

std::vector<std::string_view> MethodsWithRungs() {
  std::vector<std::string_view> names;
  for (const auto& method : Methods<Ball<double>>()) names.push_back(method.name);
  return names;
}

TEST_CASE("filtered: of 300 generic problems all but a few are decided on the first rung", "[slow]") {
  for (const std::string_view method : MethodsWithRungs()) {
    int decided = 0, bounces = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      CAPTURE(method, seed);
      const ExactProblem problem = Generic(1 + static_cast<int>(seed % 5), seed);
      decided += AgreeOnRungs(method, problem).narrow;
      bounces += RunExact(problem, {}).verdict.statistics.zero_steps > 0;
    }
    CHECK(decided >= 299);
    CHECK(bounces > 0);  // zero steps are known from the sets
  }
}

TEST_CASE("filtered: a problem beyond the doubles is undecided on a rung, and decided on the last") {
  const Rational huge = Number("1e309");
  for (int entry = 0; entry < 4; ++entry) {
    ExactProblem problem = MakeProblem({1}, {{2, 0}, {0, 3}}, {-1, 1});
    if (entry == 0) problem.A(0, 0) = huge;
    if (entry == 1) problem.A(1, 1) = huge;
    if (entry == 2) problem.b[0] = -huge;
    if (entry == 3) problem.contacts[0].mu = huge;
    for (const std::string_view method : MethodsWithRungs()) {
      CAPTURE(entry, method);
      for (const Rung rung : {Rung::kDouble, Rung::kDoubleDouble}) {
        const InexactAnswer run = RunEnclosed(method, problem, {}, rung);
        CHECK((run.Solved() || run.outcome == Outcome::kUndecided));
      }
      const Solution filtered = SolveIn(problem, {.method = method, .arithmetic = Arithmetic::kFiltered});
      CHECK(filtered.outcome() == Outcome::kSolved);
    }
  }
}

TEST_CASE("filtered: with ties, cycles and rays no verdict is wrong") {
  int narrow = 0, wide = 0, all = 0;
  const auto count = [&](const Decided& decided) {
    narrow += decided.narrow;
    wide += decided.wide;
    ++all;
  };
  for (const GeneratorRow& generator : Generators()) {
    if (!generator.IsPlain()) continue;
    for (int index = 0; index < Few(20); ++index) {
      const ExactProblem problem = Random<Rational>(generator.id, 1 + index % 4, index);
      CAPTURE(generator.name, index);
      for (const char* policy : {"paper", "admit=eager,file=yes,apex=suspended"})
        count(AgreeOnRungs("baraff", problem, ParsePolicy(policy)));
      count(AgreeOnRungs("complete", problem));
      count(AgreeOnRungs("lemke", problem));
    }
  }
  CHECK(narrow > 0);
  CHECK(narrow < wide);
  CHECK(wide < all);
  AgreeOnRungs("baraff", GiveUpProblem());
  for (const std::string_view method : MethodsWithRungs()) {
    AgreeOnRungs(method, NoSolution());
    CHECK(AgreeOnRungs(method, NoContacts()).narrow);
  }
}

TEST_CASE("filtered: loops are proved without rationals where the sets decide the forces") {
  int proved = 0;
  for (const CyclingSeed& seed : CyclingSeeds()) {
    CAPTURE(seed.contacts, seed.index);
    const Decided decided = AgreeOnRungs("baraff", Cycling(seed));
    proved += decided.narrow && decided.wide;
  }
  AgreeOnRungs("baraff", ReferenceProblem());
  CHECK(proved == static_cast<int>(CyclingSeeds().size()));
}

TEST_CASE("filtered: loops are proved without rationals where a force that was given up is left alike") {
  for (const ExactProblem& problem : {MakeProblem({5, 5, 5},
                                                  {{5, 1, -2, 0, 0, 4},
                                                   {1, 2, 3, 0, -2, 2},
                                                   {-2, 3, 9, 0, -2, 2},
                                                   {0, 0, 0, 0, 0, 0},
                                                   {0, -2, -2, 0, 5, 2},
                                                   {4, 2, 2, 0, 2, 13}},
                                                  {4, 4, 4, 0, -2, 13}),
                                      MakeProblem({5, 5, 5},
                                                  {{5, 0, 0, 1, 1, 4},
                                                   {0, 8, 2, -2, -4, -4},
                                                   {0, 2, 2, 1, 0, -3},
                                                   {1, -2, 1, 3, 3, -1},
                                                   {1, -4, 0, 3, 5, 2},
                                                   {4, -4, -3, -1, 2, 10}},
                                                  {1, -6, -1, 1, 1, 3})}) {
    const ExactRun exact = RunExact(problem, {});
    const auto is_left = [&](int row) { return exact.sets[row] == IndexSet::kNone && exact.f[row] != 0; };
    CHECK((is_left(1) || is_left(3) || is_left(5)));
    const auto [verdict, rung, by_balls, pivots] =
        RunPublishedFiltered(problem, {}, {Rung::kDoubleDouble, Rung::kDoubleDouble});
    CHECK(by_balls);
    CHECK(verdict.outcome == Outcome::kCycle);
    CHECK(verdict.start == exact.verdict.start);
    CHECK(verdict.period == exact.verdict.period);
    CHECK(verdict.statistics == exact.verdict.statistics);
  }
}

TEST_CASE("filtered: where a direction has a singular system, rationals tell it") {
  int singular = 0;
  for (int index = 0; index < 1500; ++index) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kSmall, 4, index);
    const Verdict exact = RunExact(problem, {}).verdict;
    if (exact.statistics.singular_directions == 0) continue;
    CAPTURE(index);
    const auto [verdict, rung, by_balls, pivots] =
        RunPublishedFiltered(problem, {}, {Rung::kDoubleDouble, Rung::kDoubleDouble});
    singular += by_balls;
    if (by_balls) {
      CHECK(verdict.outcome == exact.outcome);
      CHECK(verdict.statistics == exact.statistics);
    }
    Agrees(RunEnclosed("baraff", problem, {.trace = true}, Rung::kDoubleDouble),
           std::get<ExactAnswer>(SolveIn(problem, {.method = "baraff", .trace = true}).answer));
  }
  CHECK(singular > 0);
}

TEST_CASE("filtered: bilateral and sliding contacts leave exactly, and runs are told in their terms") {
  for (const std::string_view method : MethodsWithRungs()) {
    int decided = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      CAPTURE(method, seed);
      decided += AgreeOnRungs(method, Bordered(Generic(2, seed))).narrow;
    }
    CHECK(decided >= 55);
  }
}

TEST_CASE("filtered: of problem after problem the verdict is that of rationals, whichever rung it begins on") {
  std::array<int, 3> decided = {};
  for (const char* name : {"paper", "admit=eager,file=yes,apex=suspended", "scan=most-violated"}) {
    const Request request{.policy = ParsePolicy(name)};
    for (const GeneratorRow& generator : Generators()) {
      if (generator.InSpace()) continue;
      for (int index = 0; index < Few(40); ++index) {
        const ExactProblem problem = Random<Rational>(generator.id, 1 + index % 5, index);
        const Verdict exact = RunExact(problem, request).verdict;
        for (const Rung first : {Rung::kDouble, Rung::kDoubleDouble, Rung::kExact}) {
          CAPTURE(name, generator.name, index, Name(first));
          const auto [verdict, rung, by_balls, pivots] =
              RunPublishedFiltered(problem, request, {.first = first});
          CHECK(verdict.outcome == exact.outcome);
          CHECK(verdict.statistics == exact.statistics);
          CHECK(verdict.start == exact.start);
          CHECK(verdict.period == exact.period);
          CHECK(rung >= first);
          if (by_balls && rung != Rung::kDouble && !generator.HasOtherKinds())
            CHECK(std::ssize(pivots) == (exact.outcome == Outcome::kSolved ? 0 : exact.statistics.steps));
          decided[static_cast<int>(rung)] += first == Rung::kDouble;
        }
      }
    }
  }
  CHECK(decided[0] > 0);
  CHECK(decided[1] > 0);
  CHECK(decided[2] > 0);
}

TEST_CASE("filtered: floats of 254 bits decide what double-doubles leave open, as rationals do") {
  const Rungs narrow = {Rung::kDouble, Rung::kDoubleDouble};
  const Rungs wide = {Rung::kDoubleDouble, Rung::kExact, /*with_rationals=*/false};
  int decided = 0, told = 0;
  for (int index = 0; index < 150; ++index) {
    const ExactProblem problem = Random<Rational>(GeneratorId::kConditioned, 8, index);
    CAPTURE(index);
    if (RunPublishedFiltered(problem, {}, narrow).by_balls) continue;
    const auto [verdict, rung, by_balls, pivots] = RunPublishedFiltered(problem, {}, wide);
    CHECK(by_balls == (verdict.outcome != Outcome::kUndecided));
    if (!by_balls) continue;
    ++decided;
    CHECK(rung == Rung::kExact);
    const Verdict exact = RunExact(problem, {}).verdict;
    CHECK(verdict.outcome == exact.outcome);
    CHECK(verdict.statistics == exact.statistics);
    CHECK(verdict.start == exact.start);
    CHECK(verdict.period == exact.period);
    const InexactAnswer path = RunEnclosed("baraff", problem, {.trace = true}, rung);
    CHECK(path.outcome == exact.outcome);
    CHECK(static_cast<std::int64_t>(path.pivots.size()) == exact.statistics.steps);
    REQUIRE(pivots.size() == (exact.outcome == Outcome::kSolved ? 0 : path.pivots.size()));
    for (std::size_t k = 0; k < pivots.size(); ++k) {
      CHECK(pivots[k].limiting == path.pivots[k].limiting);
      CHECK(pivots[k].f == path.pivots[k].f);
    }
    told += !pivots.empty();
  }
  CHECK(decided > 2);
  CHECK(told > 0);
}

TEST_CASE("filtered: complete driving counts as over rationals, and its forces solve the problem") {
  std::array<int, 3> decided = {};
  for (const GeneratorRow& generator : Generators()) {
    if (generator.InSpace()) continue;
    for (int index = 0; index < Few(60); ++index) {
      const ExactProblem problem = Random<Rational>(generator.id, 1 + index % 5, index);
      CAPTURE(generator.name, index);
      const ExactAnswer exact = RunComplete(problem, {});
      const ExactAnswer run = RunCompleteFiltered(problem, {});
      ++decided[static_cast<int>(*run.rung)];
      CHECK(run.outcome == exact.outcome);
      CHECK(run.counters == exact.counters);
      CHECK(run.word == exact.word);
      if (!run.Solved()) continue;
      CHECK_FALSE(FindViolation(problem, run.f));
      CHECK(run.a == ExactVector(problem.A * run.f + problem.b));
    }
  }
  CAPTURE(decided[0], decided[1], decided[2]);
  CHECK(decided[0] > 0);
  CHECK(decided[1] > 0);
  CHECK(decided[2] < decided[0]);
  CHECK(RunCompleteFiltered(NoSolution(), {}).outcome == Outcome::kRay);
  CHECK(RunCompleteFiltered(GiveUpProblem(), {}).rung != Rung::kExact);
}

TEST_CASE(
    "filtered: existence is decided by the end of a run, few rows or many, and its certificate is accepted") {
  for (const auto& [contacts, method] : {std::pair{3, "complete"}, std::pair{14, "fast"}}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      CAPTURE(contacts, seed);
      const ClaimAnswer existence = DecideExistence(Generic(contacts, seed), {});
      CHECK(existence.method == method);
      CHECK(CheckCertificate(existence.certificate, "test").accepted);
    }
  }
  // Where doubles hold none of it, rationals do.
  ExactProblem beyond = Generic(13, 1);
  for (auto& contact : beyond.contacts) contact.mu *= Number("1e400");
  const ClaimAnswer existence = DecideExistence(beyond, {});
  CHECK(CheckCertificate(existence.certificate, "test").accepted);
  CHECK(DecideExistence(NoSolution(), {}).certificate->at("claim") == "no-solution");
}

// Of A = J J' with fewer columns than rows: most accelerations follow from a few.
TEST_CASE("filtered: accelerations that follow from others are known to be zero, and to reach zero together") {
  int wide = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Choices choices(seed);
    ExactProblem problem = Generic(3, seed);
    ExactMatrix J(6, 3);
    ExactVector y(3);
    for (Rational& x : J.reshaped()) x = Rational(choices.Integer(-1000, 1000)) / 7;
    for (Rational& x : y) x = choices.Integer(-1000, 1000);
    problem.A = J * J.transpose();
    problem.b = J * y;
    CAPTURE(seed);
    const Verdict exact = RunExact(problem, {}).verdict;
    const auto [verdict, rung, by_balls, pivots] = RunPublishedFiltered(problem, {});
    CHECK(verdict.outcome == exact.outcome);
    CHECK(verdict.statistics == exact.statistics);
    wide += rung == Rung::kDoubleDouble;
    all += rung != Rung::kDouble;
  }
  CAPTURE(wide, all);
  CHECK(all > 50);
  CHECK(wide > all / 2);
}

TEST_CASE("filtered: of all words those are enclosed that rationals solve, and around what they find") {
  int enclosed = 0, solved = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const ExactProblem generic = Generic(1 + static_cast<int>(seed % 3), seed);
    for (const ExactProblem& problem : {generic, WithSlip(generic)}) {
      const ContactProblem<double> rounded = Rounded<double>(problem);
      for (const ModeWord& word : AllWords(problem)) {
        CAPTURE(seed, WordToJson(word).dump());
        const auto ends = EncloseWord(rounded, word);
        const auto exact = SolveWord(problem, word, std::vector<Rational>(problem.rows(), 0));
        solved += exact.Solved();
        if (!ends.Solved()) continue;
        ++enclosed;
        REQUIRE(exact.Solved());
        CHECK(exact.a == ExactVector(problem.A * exact.f + problem.b));
        for (int i = 0; i < problem.rows(); ++i) {
          CHECK(abs(Rational(ends.f[i].middle()) - exact.f[i]) <= Rational(ends.f[i].radius()));
          CHECK(abs(Rational(ends.a[i].middle()) - exact.a[i]) <= Rational(ends.a[i].radius()));
        }
      }
    }
  }
  CHECK(enclosed > 100);
  CHECK(solved - enclosed <= 3);  // nothing ties
  // Bilateral contacts that depend on each other leave forces free: that is for rationals.
  const ExactProblem bordered = Bordered(Generic(1, 1));
  for (const ModeWord& word : AllWords(bordered))
    CHECK_FALSE(EncloseWord(Rounded<double>(bordered), word).Solved());
}

TEST_CASE("filtered: what doubles end in is certified: between ends around a solution, or exactly") {
  int enclosed = 0, exact = 0, same = 0;
  for (const GeneratorRow& generator : Generators()) {
    if (generator.InSpace()) continue;
    for (int index = 0; index < Few(40); ++index) {
      const ExactProblem problem = Random<Rational>(generator.id, 1 + index % 6, index);
      for (const char* method : {"complete", "lemke", "fast"}) {
        CAPTURE(generator.name, index, method);
        const CertifiedAnswer answer = CertifyDoubles(method, problem, {});
        if (const auto* whole = std::get_if<ExactAnswer>(&answer)) {
          ++exact;
          CHECK(whole->rung == Rung::kExact);
          CHECK(whole->method == method);
          CHECK_FALSE(FindViolation(problem, whole->f));
          CHECK(whole->a == ExactVector(problem.A * whole->f + problem.b));
        }
        const auto* ends = std::get_if<InexactAnswer>(&answer);
        if (ends == nullptr) continue;
        ++enclosed;
        CHECK(ends->rung == Rung::kDouble);
        CHECK(ends->residual() <= kSolvedResidual<double>);
        const ExactAnswer path = RunComplete(problem, {});
        if (ends->word != path.word) continue;  // another solution, or none that cells name
        ++same;
        CheckEnclosed(ends->f_enclosed, path.f);
        CheckEnclosed(ends->a_enclosed, path.a);
      }
    }
  }
  CAPTURE(enclosed, exact, same);
  CHECK(enclosed > 100);
  CHECK(exact > 100);
  CHECK(same > 50);
  CHECK(std::holds_alternative<std::monostate>(CertifyDoubles("complete", NoSolution(), {})));
}

TEST_CASE("filtered: a row follows from others where its entries of A and of b both do") {
  ExactProblem problem =
      MakeProblem({1, 1}, {{1, 2, 3, 0}, {2, 4, 6, 0}, {3, 6, 9, 0}, {0, 0, 0, 1}}, {1, 2, 4, 0});
  ExactDependentRows rows(problem);
  CHECK(rows.Follows({true, false, false, false}, 1));
  CHECK_FALSE(rows.Follows({true, false, false, false}, 2));  // b is 4, not 3
  CHECK_FALSE(rows.Follows({true, true, false, false}, 2));
  CHECK_FALSE(rows.Follows({true, true, true, false}, 3));
  CHECK_FALSE(rows.Follows({false, false, false, true}, 0));
  CHECK_FALSE(rows.Follows({false, false, false, false}, 0));
  CHECK(rows.Follows({true, false, true, false}, 1));
}

}  // namespace
}  // namespace stiction
