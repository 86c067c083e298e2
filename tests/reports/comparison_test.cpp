// SPDX-License-Identifier: Apache-2.0
// Two stores compared: exact tests that are exact, what is noise called noise, and what is not comparable
// refused.

#include "reports/comparison/comparison.h"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/rational.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;
using testing::Scratch;

// ---- Exact tests ----

Rational Binomial(std::int64_t n, std::int64_t k) {
  Rational product = 1;
  for (std::int64_t i = 1; i <= k; ++i) {
    product *= Rational(static_cast<long>(n - k + i));
    product /= Rational(static_cast<long>(i));
  }
  return product;
}

// By the definition, over rationals.
Rational FisherByDefinition(const Ratio& a, const Ratio& b) {
  const std::int64_t events = a.count + b.count, all = a.of + b.of;
  const auto weight = [&](std::int64_t x) -> Rational {
    return x > events || x > a.of || events - x > b.of
               ? Rational(0)
               : Rational(Binomial(a.of, x) * Binomial(b.of, events - x));
  };
  const Rational seen = weight(a.count);
  Rational p = 0;
  for (std::int64_t x = 0; x <= events; ++x) {
    const Rational w = weight(x);
    if (w <= seen) p += w;
  }
  return p / Binomial(all, events);
}

TEST_CASE("comparison: Fisher's test is what its definition gives over rationals, for all small tables") {
  for (std::int64_t of_a = 0; of_a <= 9; ++of_a) {
    for (std::int64_t of_b = 0; of_b <= 12; of_b += 3) {
      for (std::int64_t count_a = 0; count_a <= of_a; ++count_a) {
        for (std::int64_t count_b = 0; count_b <= of_b; ++count_b) {
          const Ratio a{count_a, of_a}, b{count_b, of_b};
          INFO(count_a << "/" << of_a << " " << count_b << "/" << of_b);
          CHECK(FisherTest(a, b) == Approx(FisherByDefinition(a, b).get_d()).epsilon(1e-12));
          CHECK(FisherTest(a, b) == Approx(FisherTest(b, a)).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("comparison: Fisher's test is right far out and for unequal sides") {
  for (const auto& [a, b] : std::vector<std::pair<Ratio, Ratio>>{
           {{60, 100}, {1, 100}}, {{0, 400}, {12, 300}}, {{5, 1000}, {40, 700}}, {{199, 200}, {3, 9}}}) {
    CHECK(FisherTest(a, b) == Approx(FisherByDefinition(a, b).get_d()).epsilon(1e-10));
  }
}

TEST_CASE("comparison: Fisher's test takes counts beyond 32 bits") {
  const std::int64_t many = std::int64_t{1} << 40;
  CHECK(FisherTest({7, many}, {7, many}) == Approx(1));
  // As a coin thrown 20 times, all heads, and as one with 15 of 20.
  CHECK(FisherTest({20, many}, {0, many}) == Approx(2 * std::pow(0.5, 20)).epsilon(1e-6));
  CHECK(FisherTest({15, many}, {5, many}) == Approx(2 * 21700 / 1048576.0).epsilon(1e-6));
  CHECK(FisherTest({1000000, 2000000}, {0, 2000000}) == 0);
}

TEST_CASE("comparison: where the sums leave no choice there is no test") {
  for (const auto& [a, b] : std::vector<std::pair<Ratio, Ratio>>{
           {{0, 10}, {0, 20}}, {{10, 10}, {20, 20}}, {{0, 0}, {3, 20}}, {{1, 10}, {0, 0}}}) {
    CHECK_FALSE(CanDiffer(a, b));
    CHECK(FisherTest(a, b) == 1);
  }
  CHECK(CanDiffer({0, 1}, {1, 1}));
}

TEST_CASE("comparison: Holm's correction, by hand") {
  const std::vector<double> adjusted = Holm({0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(adjusted[i] == Approx(expected[i]));
  CHECK(Holm({0.9, 0.8}) == std::vector<double>{1, 1});
  CHECK(Holm({}).empty());
}

// ---- Stores ----

constexpr int kEndsInCycle = static_cast<int>(Outcome::kCycle), kEndsInRay = static_cast<int>(Outcome::kRay),
              kEndsSolved = static_cast<int>(Outcome::kSolved);

CampaignIdentity IdentityWith(std::uint64_t seed, const std::string& mu = "1", int algorithm = 1) {
  return {R"({"format":"stiction-campaign","version":1,"mu":[")" + mu + R"("]})", seed, R"(["paper"])",
          algorithm};
}

// Loops of so many problems, half of them of 4 steps, the others of `steps`.
Record RecordOf(std::int64_t problems, std::int64_t loops, int steps, const std::string& generator = "psd") {
  Record record;
  Tally& tally = record.tallies[{generator, 2, "paper"}];
  tally.problems = problems;
  tally.verdicts[kEndsInRay][kEndsInCycle] = loops;
  tally.verdicts[kEndsInRay][kEndsSolved] = 5;
  tally.with_zero_steps = 300;
  tally.with_give_ups = 20;
  tally.audited = 50;
  tally.misjudged = 1;
  tally.steps[4] = problems / 2;
  tally.steps[steps] += problems - problems / 2;
  tally.sums.steps = 4 * (problems / 2) + steps * (problems - problems / 2);
  for (const int rank : {3, 4}) {  // of one friction
    Stratum& stratum = tally.strata[{"1/2", rank}];
    stratum.problems = problems / 2;
    stratum.exact[kEndsInCycle] = rank == 3 ? loops : 0;
  }
  return record;
}

Store CampaignStore(const std::filesystem::path& file, const CampaignIdentity& identity, const Record& record) {
  Store store(file, identity);
  store.AddUnit({}, 0, record, {});
  return store;
}

Comparison Compared(const Scratch& scratch, const Record& a, const Record& b) {
  return Compare(CampaignStore(scratch / "a", IdentityWith(1), a), "a.store",
                 CampaignStore(scratch / "b", IdentityWith(2), b), "b.store");
}

const ComparedRate& RateNamed(const Comparison& comparison, const std::string& measure,
                              const std::string& friction = "") {
  for (const ComparedRate& rate : comparison.rates) {
    if (rate.measure == measure && rate.friction == friction) return rate;
  }
  throw std::runtime_error("no rate " + measure);
}

std::string Joined(const std::string& text) {
  std::istringstream stream(text);
  std::string joined;
  for (std::string word; stream >> word;) joined += word + " ";
  return joined;
}

TEST_CASE("comparison: every rate is of the counts of both stores") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), RecordOf(2000, 40, 6));
  CHECK(RateNamed(c, "loops").a == Ratio{3, 1000});
  CHECK(RateNamed(c, "loops").b == Ratio{40, 2000});
  CHECK(RateNamed(c, "loops", "1/2").a == Ratio{3, 1000});
  CHECK(RateNamed(c, "loops", "1/2").b == Ratio{40, 2000});
  CHECK(RateNamed(c, "rays").a == Ratio{0, 1000});
  CHECK(RateNamed(c, "zero-steps").b == Ratio{300, 2000});
  CHECK(RateNamed(c, "give-ups").a == Ratio{20, 1000});
  CHECK(RateNamed(c, "misjudged").a == Ratio{1, 50});
  CHECK(RateNamed(c, "wrong").b == Ratio{0, 2000});
  CHECK(RateNamed(c, "steps-above-4").a == Ratio{500, 1000});
  CHECK(RateNamed(c, "steps-above-4").b == Ratio{1000, 2000});
  REQUIRE(c.steps.size() == 1);
  CHECK(c.steps[0].sum_a == 5000);
}

TEST_CASE("comparison: p are Fisher's, corrected for all tests that there were") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), RecordOf(2000, 40, 6));
  std::vector<double> p;
  for (const ComparedRate& rate : c.rates) {
    CHECK(rate.p.has_value() == CanDiffer(rate.a, rate.b));
    if (rate.p) p.push_back(*rate.p);
  }
  CHECK(c.tests == static_cast<std::int64_t>(p.size()));
  const std::vector<double> adjusted = Holm(p);
  std::size_t next = 0;
  for (const ComparedRate& rate : c.rates) {
    if (!rate.p) continue;
    CHECK(*rate.p == FisherTest(rate.a, rate.b));
    CHECK(*rate.adjusted == adjusted[next++]);
  }
}

TEST_CASE("comparison: a difference that is more than noise has a sentence, one that is not has none") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), RecordOf(2000, 40, 6));
  CHECK(c.MoreThanNoise());
  CHECK(RateNamed(c, "loops").MoreThanNoise());
  CHECK_FALSE(RateNamed(c, "misjudged").MoreThanNoise());
  const std::string text = Joined(ComparisonText(c, "a.store", "b.store"));
  CHECK_THAT(text, Contains("psd, 2 contacts: runs that loop, confirmed exactly: more in B: A 3 of 1,000, " +
                            ShareText(3, 1000) + "; B 40 of 2,000, " + ShareText(40, 2000) + "; p = "));
  CHECK_THAT(text, Contains("runs with a step of length zero: more in A"));
  CHECK_THAT(text, !Contains("ended otherwise in exact arithmetic: more"));
  const Scratch other;
  const Comparison same = Compared(other, RecordOf(1000, 3, 6), RecordOf(1000, 4, 6));
  CHECK_FALSE(same.MoreThanNoise());
  CHECK_THAT(ComparisonText(same, "a.store", "b.store"),
             Contains("None of " + std::to_string(same.tests) + " tests finds a difference"));
}

TEST_CASE("comparison: other steps are noticed, their mean and quantiles shown") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 2), RecordOf(1000, 3, 9));
  const ComparedRate& steps = RateNamed(c, "steps-above-4");
  CHECK(steps.a == Ratio{0, 1000});
  CHECK(steps.b == Ratio{500, 1000});
  CHECK(steps.MoreThanNoise());
  CHECK_THAT(Joined(ComparisonText(c, "a", "b")), Contains("psd, 2 3.00 2/2/4/4 6.50 4/4/9/9 "));
}

TEST_CASE("comparison: what only one store has is named and not compared") {
  const Scratch scratch;
  Record b = RecordOf(1000, 3, 6);
  b.tallies[{"scenes", 5, "paper"}].problems = 77;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), b);
  CHECK(c.only_a.empty());
  REQUIRE(c.only_b.size() == 1);
  CHECK_THAT(ComparisonText(c, "a", "b"), Contains("Only in B, and not compared: scenes (5 contacts)."));
  for (const ComparedRate& rate : c.rates) CHECK(rate.key.generator == "psd");
}

TEST_CASE("comparison: stores of one campaign, and stores with nothing in common, are refused") {
  const Scratch scratch;
  const Store a = CampaignStore(scratch / "a", IdentityWith(1), RecordOf(100, 3, 6));
  const Store shard = CampaignStore(scratch / "b", IdentityWith(1), RecordOf(100, 4, 6));
  const Store foreign = CampaignStore(scratch / "c", IdentityWith(2), RecordOf(100, 3, 6, "scenes"));
  CHECK_THROWS_WITH(Compare(a, "a.store", shard, "b.store"),
                    Contains("two stores of one campaign") && Contains("'merge'"));
  CHECK_THROWS_WITH(Compare(a, "a.store", foreign, "c.store"),
                    Contains("a.store and c.store: found no generator"));
}

TEST_CASE("comparison: what the campaigns differ in stands first, versions and common seeds with a warning") {
  const Scratch scratch;
  const Store a = CampaignStore(scratch / "a", IdentityWith(1), RecordOf(100, 3, 6));
  const Store b = CampaignStore(scratch / "b", IdentityWith(1, "5", 2), RecordOf(100, 3, 6));
  const std::string text = Joined(ComparisonText(Compare(a, "a", b, "b"), "a", "b"));
  CHECK_THAT(text, Contains("version of the algorithm: 1 in A, 2 in B"));
  CHECK_THAT(text, Contains("mu: A: 1; B: 5"));
  CHECK_THAT(text, Contains("seed: 1 in both. The tests take problems for independent draws"));
}

TEST_CASE("comparison: no line is longer than 100 columns") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(100000000, 999999, 6, "near-degenerate"),
                                RecordOf(200000000, 2, 9, "near-degenerate"));
  std::istringstream lines(ComparisonText(c, "a", "b"));
  for (std::string line; std::getline(lines, line);) {
    INFO(line);
    CHECK(line.size() <= kUsualTextWidth);
  }
}

TEST_CASE("comparison: the tables have a row for every rate and every number of steps") {
  const Scratch scratch;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), RecordOf(2000, 40, 9));
  const std::string csv = ToCsv(ComparisonTable(c));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(c.rates.size() + 1));
  CHECK_THAT(csv, Contains("\r\npsd,2,paper,baraff,double,,loops,3,1000,0.003,"));
  CHECK_THAT(csv, Contains(",40,2000,0.02,"));
  CHECK_THAT(csv, Contains(",0.017,") && Contains(",yes\r\n"));
  CHECK_THAT(csv, Contains("\r\npsd,2,paper,baraff,double,,wrong,0,1000,0,"));
  const std::string steps = ToCsv(ComparisonStepsTable(c));
  CHECK(steps ==
        "generator,contacts,policy,method,arithmetic,steps,or_more,a_problems,b_problems\r\n"
        "psd,2,paper,baraff,double,4,no,500,1000\r\n"
        "psd,2,paper,baraff,double,6,no,500,0\r\n"
        "psd,2,paper,baraff,double,9,no,0,1000\r\n");
}

TEST_CASE("comparison: as JSON it has every rate that the table has, and what one store alone has") {
  const Scratch scratch;
  Record b = RecordOf(2000, 40, 9);
  b.tallies[{"scenes", 5, "paper"}].problems = 77;
  const Comparison c = Compared(scratch, RecordOf(1000, 3, 6), b);
  const Json json = *ComparisonToJson(c);
  REQUIRE(json["rates"].size() == c.rates.size());
  for (std::size_t i = 0; i < c.rates.size(); ++i) {
    const Json& row = json["rates"][i];
    CHECK(row["measure"] == c.rates[i].measure);
    CHECK(row["a"] == Json{{"count", c.rates[i].a.count}, {"of", c.rates[i].a.of}});
    CHECK(row["b"] == Json{{"count", c.rates[i].b.count}, {"of", c.rates[i].b.of}});
    CHECK(row["p"].is_null() == !c.rates[i].p.has_value());
    if (c.rates[i].p) CHECK(row["p_corrected"] == *c.rates[i].adjusted);
    CHECK(row["more_than_noise"] == c.rates[i].MoreThanNoise());
  }
  CHECK(json["tests"] == c.tests);
  CHECK(json["only_a"].empty());
  REQUIRE(json["only_b"].size() == 1);
  CHECK(json["only_b"][0]["generator"] == "scenes");
}

}  // namespace
}  // namespace stiction
