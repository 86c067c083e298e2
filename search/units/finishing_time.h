// SPDX-License-Identifier: Apache-2.0
// How long a thread may work on findings, beside its units.
//
// A share of its processor time, and after the last unit half a minute at least, so that a short search brings
// its findings home. A try takes two seconds at first and four times as much at each further one of the same
// finding. While there are units a try may go that far beyond the share, which the units after it make up for;
// after the last one it may not.

#ifndef STICTION_SEARCH_UNITS_FINISHING_TIME_H_
#define STICTION_SEARCH_UNITS_FINISHING_TIME_H_

#include <algorithm>
#include <cmath>
#include <limits>

namespace stiction {

struct FinishingTime {
  static constexpr double kFirstTry = 2;        // seconds
  static constexpr double kAfterLastUnit = 30;  // at least, of one thread
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();

  double share = 0;                     // 0 to 1; 0: none, 1: no bound
  double searching = 0, finishing = 0;  // processor seconds that the thread has spent

  // Seconds for a finding that was tried so often in vain. Not positive: none now.
  double ForTry(int tries, bool units_left) const {
    if (share <= 0) return 0;
    if (share >= 1) return kNoBound;
    const double left = share / (1 - share) * searching - finishing;
    const double one_try = kFirstTry * std::pow(4, tries);
    if (units_left) return left >= 0 ? left + one_try : 0;
    return std::min(one_try, std::max(left, kAfterLastUnit - finishing));
  }
};

}  // namespace stiction

#endif  // STICTION_SEARCH_UNITS_FINISHING_TIME_H_
