// SPDX-License-Identifier: Apache-2.0
// bench --suite search: problems a second of the search's hot path.

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "bench/measure.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/json_text.h"
#include "corpus/stopwatch.h"
#include "search/unit.h"

namespace stiction {
namespace {

// Problems a second of one thread: generation, solving over doubles, classification, exact runs of suspicions.
Spread SearchRate(GeneratorId generator, int contacts, const BenchOptions& o) {
  Campaign campaign;
  campaign.seed = o.seed;
  campaign.generators = {generator};
  campaign.contacts = {contacts};
  const std::int64_t problems =
      std::max<std::int64_t>(50, o.problems.value_or(200000) >> (2 * std::max(0, contacts - 2)));
  campaign.unit_problems = problems << std::max(0, contacts - 2);  // UnitProblems takes it back
  UnitRunner runner(campaign);
  std::vector<double> rates;
  for (int run = 0; run <= o.repeat; ++run) {
    const Stopwatch watch;
    runner.Run(run);
    const double seconds = watch.Seconds();
    if (run > 0) rates.push_back(static_cast<double>(problems) / seconds);  // the first run warms up
  }
  return SpreadOf(rates);
}

}  // namespace

int BenchSearch(const BenchOptions& o) {
  const std::vector<int> sizes = o.contacts.empty() ? std::vector<int>{2, 3, 4, 8} : o.contacts;
  Json rows = Json::array();
  if (!o.json)
    fmt::print("{:16} {:>8} {:>14} {:>14} {:>14}   problems a second, one thread\n", "generator", "contacts",
               "least", "median", "most");
  for (const GeneratorRow& row : Generators()) {
    if (o.generator && row.id != *o.generator) continue;
    for (const int contacts : sizes) {
      const Spread rate = SearchRate(row.id, contacts, o);
      rows.push_back({{"generator", row.name},
                      {"contacts", contacts},
                      {"least", rate.least},
                      {"median", rate.median},
                      {"most", rate.most}});
      if (!o.json)
        fmt::print("{:16} {:>8} {:>14.0f} {:>14.0f} {:>14.0f}\n", row.name, contacts, rate.least, rate.median,
                   rate.most);
      std::fflush(stdout);
    }
  }
  if (o.json) std::cout << JsonText(rows) << "\n";
  return kExitDone;
}

}  // namespace stiction
