// SPDX-License-Identifier: Apache-2.0
// The worst problems that are known, beside what random problems reached: what the page says of them, and
// frontiers.csv.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/told/told.h"

namespace stiction {

// A record, as `stiction records` tells it. Values are p/q.
struct FrontierLine {
  std::string name, what, objective;
  bool high = true;  // the worse the higher
  std::string value, status, command;
  std::string random;  // best of random problems; empty: none reached anything
  std::int64_t evaluations = 0;
  std::string random_command;
};

// The best that an optimized search has of a generator and number of contacts.
struct OwnBest {
  std::string objective, generator, mu, value;  // as they are told
  int contacts = 0;
};

// What only an optimized search has.
struct OwnSearch {
  std::vector<OwnBest> bests;
  std::int64_t problems = 0;  // that its units ask for
};

// frontiers.csv: what is exact, and what drew the random problems.
Table FrontiersTable(const std::vector<FrontierLine>& lines);
// Each record, and what random problems reached, null if nothing, as numbers.
Table FrontiersFigure(const std::vector<FrontierLine>& lines);
// Tables `records`, and `own` beside them.
void AddFrontiers(Facts& facts, const std::vector<FrontierLine>& lines, const std::vector<OwnBest>& own);

}  // namespace stiction
