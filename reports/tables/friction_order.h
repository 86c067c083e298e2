// SPDX-License-Identifier: Apache-2.0
// The order of friction coefficients in tables.

#ifndef STICTION_REPORTS_TABLES_FRICTION_ORDER_H_
#define STICTION_REPORTS_TABLES_FRICTION_ORDER_H_

#include <string>

#include "corpus/rational.h"
#include "corpus/statistics.h"

namespace stiction {

// "1/10" < "1/2" < "mixed".
struct ByFriction {
  bool operator()(const std::string& left, const std::string& right) const {
    const bool left_mixed = left == kMixedFriction, right_mixed = right == kMixedFriction;
    if (left_mixed || right_mixed) return !left_mixed && right_mixed;
    return ParseRational(left) < ParseRational(right);
  }
};

}  // namespace stiction

#endif  // STICTION_REPORTS_TABLES_FRICTION_ORDER_H_
