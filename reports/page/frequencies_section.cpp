// SPDX-License-Identifier: Apache-2.0
// The section of the page on how often the published algorithm fails in exact arithmetic.

#include <fmt/format.h>

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "corpus/intervals.h"
#include "reports/page/page.h"
#include "reports/tables/friction_order.h"

namespace stiction {
namespace {

constexpr std::array kFailures = {Outcome::kCycle, Outcome::kSingular, Outcome::kRay};

// Runs of one generator, size and policy whose failures exact arithmetic confirmed.
struct ExactFailures {
  std::int64_t runs = 0, suspicions = 0, audited = 0, misjudged = 0;
  std::array<std::int64_t, kFailures.size()> failures = {};

  void Add(const Tally& tally) {
    runs += tally.problems;
    audited += tally.audited;
    misjudged += tally.misjudged;
    for (const Tally::Outcomes& exact : tally.verdicts) {
      for (const std::int64_t count : exact) suspicions += count;
      for (std::size_t i = 0; i < failures.size(); ++i) failures[i] += exact[static_cast<int>(kFailures[i])];
    }
  }
};

HtmlCell CountWithInterval(std::int64_t count, std::string interval) {
  return {Text(Grouped(count)) + Tag("small")(interval), count == 0 ? "zero" : ""};
}

void AddFailures(Table& table, std::vector<HtmlCell> cells, const ExactFailures& f, const char* style = "") {
  const int names = static_cast<int>(cells.size());
  cells.push_back({Text(Grouped(f.runs))});
  for (const std::int64_t count : f.failures)
    cells.push_back(CountWithInterval(count, RateText(count, f.runs)));
  cells.push_back({Text(Grouped(f.audited))});
  cells.push_back(CountWithInterval(f.misjudged, ShareText(f.misjudged, f.audited)));
  table.AddRow(cells, names, style);
}

std::vector<Column> FrequencyColumns() {
  std::vector<Column> columns = {{"generator", "", false}, {"contacts"}, {"policy", "", false}, {"runs"}};
  for (const Outcome outcome : kFailures)
    columns.push_back(
        {std::string(Name(outcome)), "in exact arithmetic; below: in a million runs, with the interval"});
  columns.push_back({"audited", "run again exactly without a suspicion, as a sample"});
  columns.push_back({"misjudged", "audited with another exact outcome; below: their share, with the interval"});
  return columns;
}

Html FrequencyTable(const Record& total) {
  Table table("Failures confirmed exactly, with intervals, per generator, number of contacts and policy",
              FrequencyColumns());
  for (const auto& [key, tally] : total.tallies) {
    ExactFailures failures;
    failures.Add(tally);
    AddFailures(table, {{Text(key.generator)}, {Text(Grouped(key.contacts))}, {Text(key.policy)}}, failures);
  }
  return table.Done();
}

struct LoopCount {
  std::int64_t runs = 0, loops = 0;
};

// Generators, contacts and policies down, what `column_of` makes of a stratum across: loops that exact
// arithmetic confirmed.
template <class Order, class ColumnOf>
Html StrataTable(const Record& total, const std::string& caption, ColumnOf column_of) {
  using Label = std::decay_t<decltype(column_of(StratumKey{}))>;
  std::map<std::tuple<std::string, int, std::string>, std::map<Label, LoopCount, Order>> rows;
  std::set<Label, Order> labels;
  for (const auto& [key, tally] : total.tallies) {
    for (const auto& [stratum_key, stratum] : tally.strata) {
      LoopCount& count = rows[{key.generator, key.contacts, key.policy}][column_of(stratum_key)];
      count.runs += stratum.problems;
      count.loops += stratum.exact[static_cast<int>(Outcome::kCycle)];
      labels.insert(column_of(stratum_key));
    }
  }
  std::vector<Column> columns = {{"generator", "", false}, {"contacts"}, {"policy", "", false}};
  for (const Label& label : labels) columns.push_back({fmt::format("{}", label)});
  Table table(caption, columns);
  for (const auto& [key, counts] : rows) {
    const auto& [generator, contacts, policy] = key;
    std::vector<HtmlCell> cells = {{Text(generator)}, {Text(Grouped(contacts))}, {Text(policy)}};
    for (const Label& label : labels) {
      const auto found = counts.find(label);
      if (found == counts.end()) {
        cells.push_back({Text("–")});
      } else {
        cells.push_back(
            CountWithInterval(found->second.loops, RateText(found->second.loops, found->second.runs)));
      }
    }
    table.AddRow(cells, 3);
  }
  return table.Done();
}

// What the rates are worth.
Html RateBounds(const Record& total) {
  ExactFailures all;
  for (const auto& [key, tally] : total.tallies) all.Add(tally);
  if (all.runs == all.audited + all.suspicions)
    return Text(" Every run was repeated exactly: none is missing but those that were misjudged.");
  return Text(
      fmt::format(" These rates are lower bounds: loops that doubles take for solutions are not among them. Of "
                  "{} runs without a "
                  "suspicion {} were audited.",
                  Grouped(all.runs - all.suspicions), Grouped(all.audited)));
}

}  // namespace

Html FrequenciesSection(const Record& total) {
  const Html explained = Html(
      "Suspicious runs whose failure exact arithmetic confirmed, and below each count its rate in a million "
      "runs "
      "with its exact interval at 95 % (Garwood; of shares, Clopper and Pearson).");
  return Section(
      "frequencies", "How often it fails exactly",
      Tag("p")(explained + RateBounds(total)) +
          FigurePlace("rates.contacts",
                      "Failures confirmed exactly in a million runs, by generator and number of "
                      "contacts, on a logarithmic scale; lines: exact intervals at 95 %. An open "
                      "triangle: none was seen, and the rate is below its tip.") +
          FigurePlace("rates.friction",
                      "Failures confirmed exactly in a million runs, by generator and friction coefficient of "
                      "all contacts (mixed: they differ); colours: numbers of contacts. Only where some "
                      "were seen.") +
          FigurePlace("rates.rank",
                      "Failures confirmed exactly in a million runs, by generator and the rank that A has at "
                      "most; colours: numbers of contacts. Only where some were seen.") +
          FrequencyTable(total) +
          Html("<h3>By friction</h3>\n<p>Cycles confirmed exactly, where all contacts have the same "
               "coefficient, or different ones (mixed); below, in a million runs:</p>\n") +
          StrataTable<ByFriction>(total, "Cycles by friction coefficient",
                                  [](const StratumKey& key) { return key.friction; }) +
          Html("<h3>By rank</h3>\n<p>The same by the rank that A has at most by construction: that of "
               "its factor J. By chance it is lower.</p>\n") +
          StrataTable<std::less<>>(total, "Cycles by rank", [](const StratumKey& key) { return key.rank; }));
}

}  // namespace stiction
