// SPDX-License-Identifier: Apache-2.0
// Exact intervals at 95 % of what was counted.
//
// Each end leaves at most 2.5 % beyond it: the low end is the least mean (chance) under which so many events or
// more have that probability, the high end the largest under which so few or fewer have it.

#pragma once

#include <cstdint>
#include <string>

namespace stiction {

struct Interval {
  double low = 0;
  double high = 0;
};

// Of the expected number of events where `count` were seen: F. Garwood, Biometrika 28, 1936.
Interval CountInterval(std::int64_t count);
// Of the chance of an event that was seen `count` times in `of` trials: C. J. Clopper and E. S. Pearson,
// Biometrika 26, 1934. 0 to 1 where there was no trial, or the numbers are not those of trials.
Interval ShareInterval(std::int64_t count, std::int64_t of);

// Of a rate, events in so many trials: as of a share; where that is below a hundredth as of the count of
// events, which is as good and a little wider.
Interval RateInterval(std::int64_t count, std::int64_t of);

// How many digits, three or six or more (`at_least`), keep the ends of an interval apart from its value: of
// 124.254 [124.036, 124.473] four.
int DigitsToTell(double value, Interval interval, int at_least);

// x in so many digits, toward 0 or away from it: ends of an interval outward. Requires x >= 0; a number that
// has no more digits stays.
double RoundedDown(double x, int digits);
double RoundedUp(double x, int digits);

// "0.8 [0.218, 2.05]": so many in a million, and the interval, outward, in three digits or as many as tell
// its ends from the value; "" where total is 0.
std::string RateText(std::int64_t count, std::int64_t total);
// "1.52 % [0.187, 5.38]", "100 % [99.99996, 100]"; "" where total is 0.
std::string ShareText(std::int64_t count, std::int64_t total);

}  // namespace stiction
