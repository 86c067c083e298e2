// SPDX-License-Identifier: Apache-2.0
// Exact intervals against published tables, and against the probabilities that define them.

#include "corpus/intervals.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace stiction {
namespace {

struct TabledInterval {
  std::int64_t count, of;
  double low, high;
};

// P(N <= count), N Poisson.
double PoissonUpTo(std::int64_t count, double mean) {
  double sum = 0;
  for (std::int64_t k = 0; k <= count; ++k) {
    const auto n = static_cast<double>(k);
    sum += std::exp(n * std::log(mean) - mean - std::lgamma(n + 1));
  }
  return sum;
}

// P(N <= count), N binomial.
double BinomialUpTo(std::int64_t count, std::int64_t of, double chance) {
  double sum = 0;
  for (std::int64_t k = 0; k <= count; ++k) {
    const auto n = static_cast<double>(k), rest = static_cast<double>(of - k);
    sum += std::exp(std::lgamma(n + rest + 1) - std::lgamma(n + 1) - std::lgamma(rest + 1) +
                    n * std::log(chance) + rest * std::log1p(-chance));
  }
  return sum;
}

}  // namespace

TEST_CASE("intervals: Garwood's of counts, as tables of the Poisson mean have them") {
  const std::vector<TabledInterval> table = {
      {0, 0, 0, 3.689},       {1, 0, 0.0253, 5.572},   {2, 0, 0.242, 7.225},    {5, 0, 1.623, 11.668},
      {10, 0, 4.795, 18.390}, {20, 0, 12.217, 30.888}, {50, 0, 37.111, 65.919}, {100, 0, 81.364, 121.627}};
  for (const TabledInterval& row : table) {
    const Interval interval = CountInterval(row.count);
    CHECK(interval.low == Approx(row.low).margin(0.0006));
    CHECK(interval.high == Approx(row.high).margin(0.0006));
  }
}

TEST_CASE("intervals: Clopper's and Pearson's of shares, as tables have them") {
  const std::vector<TabledInterval> table = {
      {0, 10, 0, 0.3085},      {1, 10, 0.0025, 0.4450}, {5, 10, 0.1871, 0.8129}, {10, 10, 0.6915, 1},
      {4, 20, 0.0573, 0.4366}, {2, 13, 0.0192, 0.4545}, {1, 100, 0.0003, 0.0545}};
  for (const TabledInterval& row : table) {
    const Interval interval = ShareInterval(row.count, row.of);
    CHECK(interval.low == Approx(row.low).margin(0.00006));
    CHECK(interval.high == Approx(row.high).margin(0.00006));
  }
  for (const auto& [count, of] : {std::pair(0, 0), {3, 2}, {-1, 2}}) {  // a damaged store can say anything
    CHECK(ShareInterval(count, of).low == 0);
    CHECK(ShareInterval(count, of).high == 1);
  }
}

TEST_CASE("intervals: each end leaves 2.5 % beyond it") {
  for (const std::int64_t count : {1, 3, 17, 200}) {
    const Interval mean = CountInterval(count);
    CHECK(1 - PoissonUpTo(count - 1, mean.low) == Approx(0.025));
    CHECK(PoissonUpTo(count, mean.high) == Approx(0.025));
    const Interval chance = ShareInterval(count, 1000);
    CHECK(1 - BinomialUpTo(count - 1, 1000, chance.low) == Approx(0.025));
    CHECK(BinomialUpTo(count, 1000, chance.high) == Approx(0.025));
  }
}

TEST_CASE(
    "intervals: of many events, on both sides of where they are expanded, and of more than a century has") {
  const Interval below = CountInterval(1000000000), above = CountInterval(1000000001);
  CHECK(above.low - below.low == Approx(1).margin(1e-3));
  CHECK(above.high - below.high == Approx(1).margin(1e-3));
  const Interval many = CountInterval(std::int64_t{1} << 60);
  const double deviation = 1.959963985 * std::pow(2.0, 30);
  CHECK(many.low == Approx(std::pow(2.0, 60) - deviation).epsilon(1e-15));
  CHECK(many.high == Approx(std::pow(2.0, 60) + deviation).epsilon(1e-15));
}

TEST_CASE("intervals: texts") {
  CHECK(RateText(0, 1000000) == "0 [0, 3.69]");
  CHECK(RateText(4, 5000000) == "0.8 [0.217, 2.05]");
  CHECK(RateText(3, 2000) == "1,500 [309, 4,390]");
  CHECK(RateText(1, 0).empty());
  CHECK(ShareText(2, 13) == "15.4 % [1.92, 45.5]");
  CHECK(ShareText(0, 0).empty());
}

TEST_CASE("intervals: texts have as many digits as tell the ends from the value") {
  CHECK(RateText(1242522, 10000000000) == "124.3 [124, 124.5]");
  CHECK(RateText(378629, 10000000000) == "37.9 [37.7, 38]");  // three do
  CHECK(RateText(12000000, 30000000) == "400,000 [399,800, 400,200]");
  CHECK(RateText(25000001, 10000000000) == "2,500 [2,499, 2,501]");
  CHECK(ShareText(10000000, 10000000) == "100 % [99.99996, 100]");
  CHECK(ShareText(0, 10000000) == "0 % [0, 3.69e-05]");
  for (const std::int64_t count :
       {std::int64_t{1}, std::int64_t{999}, std::int64_t{1000000}, std::int64_t{1} << 40}) {
    for (const std::string& text : {RateText(count, count * 3), ShareText(count, count * 3)}) {
      const auto open = text.find('['), comma = text.find(", ", open);
      const std::string value = text.substr(0, text.find(' '));
      CHECK(text.substr(open + 1, comma - open - 1) != value);
      CHECK(text.substr(comma + 2, text.size() - comma - 3) != value);
    }
  }
  CHECK(DigitsToTell(124.254, {124.036, 124.473}, 3) == 4);
  CHECK(DigitsToTell(0, {0, 3.7}, 3) == 3);
}

TEST_CASE("intervals: a rate is never beyond a million in a million, and few events are counted as events") {
  for (const std::int64_t of : {1, 100, 10000, 123456789}) {
    CHECK(RateInterval(of, of).high == 1);
    CHECK(RateInterval(of, of).low == ShareInterval(of, of).low);
    CHECK(RateInterval(0, of).low == 0);
    for (const std::int64_t count : {of / 2, of - of / 7}) {
      CHECK(RateInterval(count, of).high <= 1);
      CHECK(RateInterval(count, of).low <= static_cast<double>(count) / static_cast<double>(of));
      CHECK(RateInterval(count, of).high >= static_cast<double>(count) / static_cast<double>(of));
    }
  }
  CHECK(RateText(10000, 10000) == "1,000,000 [999,600, 1,000,000]");
  CHECK(RateInterval(3, 4000).high == CountInterval(3).high / 4000);
  CHECK(RateInterval(20000000000, 20000000000).high == 1);
}

}  // namespace stiction
