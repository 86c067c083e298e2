// SPDX-License-Identifier: Apache-2.0
#include "corpus/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "corpus/grouped.h"

namespace stiction {
namespace {

constexpr double kTail = 0.025;

// Three digits.
std::string Rounded(double value) {
  if (value < 999.5) return fmt::format("{:.3g}", value);
  std::int64_t unit = 1;
  while (value / static_cast<double>(unit) >= 999.5) unit *= 10;
  return Grouped(std::llround(value / static_cast<double>(unit)) * unit);
}

std::string WithInterval(double value, Interval interval, double scale, const char* unit) {
  return fmt::format("{}{} [{}, {}]", Rounded(scale * value), unit, Rounded(scale * interval.low),
                     Rounded(scale * interval.high));
}

}  // namespace

Interval CountInterval(std::int64_t count) {
  const auto n = static_cast<double>(std::max<std::int64_t>(count, 0));
  return {n == 0 ? 0 : boost::math::gamma_p_inv(n, kTail), boost::math::gamma_q_inv(n + 1, kTail)};
}

Interval ShareInterval(std::int64_t count, std::int64_t of) {
  if (of <= 0 || count < 0 || count > of) return {0, 1};
  const auto seen = static_cast<double>(count), rest = static_cast<double>(of - count);
  return {count == 0 ? 0 : boost::math::ibeta_inv(seen, rest + 1, kTail),
          count == of ? 1 : boost::math::ibetac_inv(seen + 1, rest, kTail)};
}

std::string RateText(std::int64_t count, std::int64_t total) {
  if (total == 0) return "";
  return WithInterval(static_cast<double>(count), CountInterval(count), 1e6 / static_cast<double>(total), "");
}

std::string ShareText(std::int64_t count, std::int64_t total) {
  if (total == 0) return "";
  return WithInterval(static_cast<double>(count) / static_cast<double>(total), ShareInterval(count, total), 100,
                      " %");
}

}  // namespace stiction
