// SPDX-License-Identifier: Apache-2.0
// The section of the page on how often the published algorithm fails in exact arithmetic.

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "corpus/intervals.h"
#include "reports/page.h"

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
  return Section("frequencies", "How often it fails exactly",
                 Tag("p")(explained + RateBounds(total)) + FrequencyTable(total));
}

}  // namespace stiction
