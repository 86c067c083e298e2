// SPDX-License-Identifier: Apache-2.0
// Exact tests: whether two counts differ by more than noise.

#pragma once

#include <vector>

#include "reports/tables/table.h"

namespace stiction {

// Whether the margins leave a choice: trials on both sides, and an event seen in some of them all, not in all.
// If they leave none, no test can say anything.
bool CanDiffer(const Ratio& a, const Ratio& b);

// Fisher's exact test, two-sided: were the chances equal, the probability of tables that are no more probable
// than this one, given the sums of their rows and columns (R. A. Fisher, Journal of the Royal Statistical
// Society 98, 1935). 1 where CanDiffer is false; 0 below 1e-300.
//
// Sums the hypergeometric weights outward from their middle, each from the one before. Boost.Math's
// distribution takes counts of 32 bits, which a night leaves behind; a test holds small tables against rational
// numbers.
double FisherTest(const Ratio& a, const Ratio& b);

// Holm's correction for many tests (S. Holm, Scandinavian Journal of Statistics 6, 1979), whether they depend
// on each other or not: what is at most 5 % here is, in all, false with a probability of at most 5 %.
std::vector<double> Holm(const std::vector<double>& p);

}  // namespace stiction
