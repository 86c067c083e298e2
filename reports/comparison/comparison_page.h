// SPDX-License-Identifier: Apache-2.0
// Campaigns, or solvers under test, side by side, as one page that needs nothing else: what is told for a
// `page`.

#pragma once

#include <string>
#include <vector>

#include "reports/told/told.h"

namespace stiction {

// `figures`: what it draws.
std::string ComparisonPage(const char* title, const char* question, const Told& told,
                           const std::vector<Table>& figures = {});

}  // namespace stiction
