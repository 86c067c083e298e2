// SPDX-License-Identifier: Apache-2.0
#include "corpus/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "corpus/grouped.h"

namespace stiction {
namespace {

constexpr double kTail = 0.025;
constexpr int kFewDigits = 3;

// So many digits, grouped from a thousand on. Whole numbers are exact: 0, 100.
std::string Rounded(double value, int digits) {
  if (value == std::round(value) && value < 1000) return fmt::format("{:.0f}", value);
  if (value < 1000 - 500 * std::pow(10, -digits)) {
    return digits == kFewDigits ? fmt::format("{:.3g}", value) : fmt::format("{:#.{}g}", value, digits);
  }
  std::int64_t unit = 1;
  while (value / static_cast<double>(unit) >= std::pow(10, digits) - 0.5) unit *= 10;
  const std::int64_t whole = std::llround(value / static_cast<double>(unit)) * unit;
  const int decimals = digits - static_cast<int>(std::to_string(std::llround(value)).size());
  if (decimals <= 0) return Grouped(whole);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const std::size_t point = text.find('.');
  return Grouped(std::stoll(text.substr(0, point))) + text.substr(point);
}

// Units of the last digit are powers of ten, by which small ones are multiplied: those are exact.
template <class Round>
double RoundedTo(double x, int digits, Round round) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  const int last = static_cast<int>(std::floor(std::log10(x))) + 1 - digits;
  const double unit = std::pow(10.0, std::abs(last));
  const double units = last >= 0 ? x / unit : x * unit;
  const double nearest = std::round(units);
  const double whole = std::abs(units - nearest) <= 1e-12 * units ? nearest : round(units);
  return last >= 0 ? whole * unit : whole / unit;
}

std::string WithInterval(double value, Interval interval, double scale, const char* unit) {
  const double shown = scale * value;
  const Interval ends = {scale * interval.low, scale * interval.high};
  const int digits = DigitsToTell(shown, ends, kFewDigits);
  return fmt::format("{}{} [{}, {}]", Rounded(shown, digits), unit,
                     Rounded(RoundedDown(ends.low, digits), digits),
                     Rounded(RoundedUp(ends.high, digits), digits));
}

// Quantiles of the gamma distribution by the expansion of E. A. Cornish and R. A. Fisher (1937): its next term
// is below 1e-4 from 1e9 events on, where the series of the library take too long and, from some 5e10 on,
// throw.
Interval OfManyEvents(double n) {
  const double z = boost::math::constants::root_two<double>() * boost::math::erfc_inv(2 * kTail);
  const double skew = (z * z - 1) / 3;
  return {n - z * std::sqrt(n) + skew, n + 1 + z * std::sqrt(n + 1) + skew};
}

}  // namespace

Interval CountInterval(std::int64_t count) {
  const auto n = static_cast<double>(std::max<std::int64_t>(count, 0));
  if (n > 1e9) return OfManyEvents(n);
  return {n == 0 ? 0 : boost::math::gamma_p_inv(n, kTail), boost::math::gamma_q_inv(n + 1, kTail)};
}

Interval ShareInterval(std::int64_t count, std::int64_t of) {
  if (of <= 0 || count < 0 || count > of) return {0, 1};
  const auto seen = static_cast<double>(count), rest = static_cast<double>(of - count);
  return {count == 0 ? 0 : boost::math::ibeta_inv(seen, rest + 1, kTail),
          count == of ? 1 : boost::math::ibetac_inv(seen + 1, rest, kTail)};
}

Interval RateInterval(std::int64_t count, std::int64_t of) {
  constexpr std::int64_t kRare = 100;
  // Beyond, the series of the library take too long.
  constexpr std::int64_t kMostTrials = 1'000'000'000;
  if (of <= 0) return {0, 1};
  if (count <= of && count >= of / kRare && of <= kMostTrials) return ShareInterval(count, of);
  const Interval events = CountInterval(count);
  const auto trials = static_cast<double>(of);
  const double most = count <= of ? 1 : events.high / trials;
  return {events.low / trials, std::min(events.high / trials, most)};
}

int DigitsToTell(double value, Interval interval, int at_least) {
  constexpr int kMost = 15;
  const auto alike = [&](double end, int digits) {
    return end != value && fmt::format("{:.{}g}", end, digits) == fmt::format("{:.{}g}", value, digits);
  };
  int digits = at_least;
  while (digits < kMost && (alike(interval.low, digits) || alike(interval.high, digits))) ++digits;
  return digits;
}

double RoundedDown(double x, int digits) {
  return RoundedTo(x, digits, [](double y) { return std::floor(y); });
}
double RoundedUp(double x, int digits) {
  return RoundedTo(x, digits, [](double y) { return std::ceil(y); });
}

std::string RateText(std::int64_t count, std::int64_t total) {
  if (total == 0) return "";
  return WithInterval(static_cast<double>(count) / static_cast<double>(total), RateInterval(count, total), 1e6,
                      "");
}

std::string ShareText(std::int64_t count, std::int64_t total) {
  if (total == 0) return "";
  return WithInterval(static_cast<double>(count) / static_cast<double>(total), ShareInterval(count, total), 100,
                      " %");
}

}  // namespace stiction
