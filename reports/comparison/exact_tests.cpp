// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/exact_tests.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr double kSame = 1 + 1e-7;  // as probable, but for rounding

// Tables with the margins of one: `x`, the events of a, is what is left to chance.
struct Hypergeometric {
  double a, b, events;  // trials of a and of b; events in all

  double Least() const { return std::max(0.0, events - b); }
  double Most() const { return std::min(a, events); }
  double Middle() const {
    return std::clamp(std::floor((a + 1) * (events + 1) / (a + b + 2)), Least(), Most());
  }
  // P(x + 1) / P(x).
  double Up(double x) const { return (events - x) * (a - x) / ((x + 1) * (b - events + x + 1)); }

  // visit(x, P(x) / P(middle)), from the middle to both ends, or until that is 0.
  template <class Visit>
  void ForEach(Visit visit) const {
    const double middle = Middle();
    double weight = 1;
    for (double x = middle; weight > 0; ++x) {
      visit(x, weight);
      if (x >= Most()) break;
      weight *= Up(x);
    }
    weight = 1;
    for (double x = middle; x > Least(); --x) {
      weight /= Up(x - 1);
      if (weight == 0) break;
      visit(x - 1, weight);
    }
  }
};

}  // namespace

bool CanDiffer(const Ratio& a, const Ratio& b) {
  const std::int64_t events = a.count + b.count;
  return a.of > 0 && b.of > 0 && events > 0 && events < a.of + b.of;
}

double FisherTest(const Ratio& a, const Ratio& b) {
  for (const Ratio& trials : {a, b})
    STICTION_CHECK(trials.count >= 0 && trials.count <= trials.of, "no more events than trials");
  if (!CanDiffer(a, b)) return 1;
  const auto of = [](std::int64_t n) { return static_cast<double>(n); };  // exact up to 2^53
  const Hypergeometric tables{of(a.of), of(b.of), of(a.count + b.count)};
  double seen = 0;
  tables.ForEach([&](double x, double weight) { seen = x == of(a.count) ? weight : seen; });
  double all = 0, no_more_probable = 0;
  tables.ForEach([&](double, double weight) {
    all += weight;
    no_more_probable += weight <= seen * kSame ? weight : 0;
  });
  return std::min(1.0, no_more_probable / all);
}

std::vector<double> Holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&p](std::size_t i, std::size_t j) { return p[i] < p[j]; });
  std::vector<double> adjusted(p.size());
  double largest = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(order.size() - k) * p[order[k]]));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

}  // namespace stiction
