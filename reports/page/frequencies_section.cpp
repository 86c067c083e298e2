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

#include "corpus/counts.h"
#include "corpus/intervals.h"
#include "reports/page/page.h"
#include "reports/tables/friction_order.h"

namespace stiction {
namespace {

constexpr std::array kFailures = {Outcome::kSingular, Outcome::kRay};  // besides loops

HtmlCell CountWithInterval(std::int64_t count, std::string interval) {
  return {Text(Grouped(count)) + Tag("small")(interval), count == 0 ? "zero" : ""};
}

void AddFailures(Table& table, std::vector<HtmlCell> cells, const Counts& f, const char* style = "") {
  const int names = static_cast<int>(cells.size());
  cells.push_back({Text(Grouped(f.runs))});
  cells.push_back(CountWithInterval(f.Loops(), RateText(f.Loops(), f.runs)));
  for (const Outcome outcome : kFailures)
    cells.push_back(CountWithInterval(f.Of(outcome), RateText(f.Of(outcome), f.runs)));
  cells.push_back({Text(Grouped(f.audited))});
  cells.push_back(CountWithInterval(f.misjudged, ShareText(f.misjudged, f.audited)));
  table.AddRow(cells, names, style);
}

std::vector<Column> FrequencyColumns() {
  std::vector<Column> columns = {{"generator", "", false}, {"contacts"}, {"policy", "", false}, {"runs"}};
  const std::string hint = "in exact arithmetic; below: in a million runs, with the interval";
  columns.push_back({"loops", "a state stands again (cycle or stall) " + hint});
  for (const Outcome outcome : kFailures) columns.push_back({std::string(Name(outcome)), hint});
  columns.push_back({"audited", "run again exactly without a suspicion, as a sample"});
  columns.push_back({"misjudged", "audited with another exact outcome; below: their share, with the interval"});
  return columns;
}

Html FrequencyTable(const Record& total) {
  Table table("Failures confirmed exactly, with intervals, per generator, number of contacts and policy",
              FrequencyColumns());
  for (const auto& [key, counts] : CountBy(total, [](const TallyKey& key) { return key; }))
    AddFailures(table, {{Text(key.generator)}, {Text(Grouped(key.contacts))}, {Text(key.policy)}}, counts);
  return table.Done();
}

// Generators, contacts and policies down, what `column_of` makes of a stratum across: loops that exact
// arithmetic confirmed.
template <class Order, class ColumnOf>
Html StrataTable(const Record& total, const std::string& caption, ColumnOf column_of) {
  using Label = std::decay_t<decltype(column_of(StratumKey{}))>;
  std::map<std::tuple<std::string, int, std::string>, std::map<Label, Counts, Order>> rows;
  std::set<Label, Order> labels;
  const auto by = [&](const TallyKey& key, const StratumKey& stratum) {
    return std::tuple(key.generator, key.contacts, key.policy, column_of(stratum));
  };
  for (const auto& [key, counts] : CountStrataBy(total, by)) {
    const auto& [generator, contacts, policy, label] = key;
    rows[{generator, contacts, policy}][label] = counts;
    labels.insert(label);
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
            CountWithInterval(found->second.Loops(), RateText(found->second.Loops(), found->second.runs)));
      }
    }
    table.AddRow(cells, 3);
  }
  return table.Done();
}

// What the rates are worth.
Html RateBounds(const Record& total) {
  const Counts all = CountAll(total);
  if (all.runs == all.audited + all.suspicious)
    return Text(" Every run was repeated exactly: none is missing but those that were misjudged.");
  return Text(
      fmt::format(" These rates are lower bounds: loops that doubles take for solutions are not among them. Of "
                  "{} runs without a "
                  "suspicion {} were audited.",
                  Grouped(all.runs - all.suspicious), Grouped(all.audited)));
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
          Html("<h3>By friction</h3>\n<p>Loops confirmed exactly, where all contacts have the same "
               "coefficient, or different ones (mixed); below, in a million runs:</p>\n") +
          StrataTable<ByFriction>(total, "Loops by friction coefficient",
                                  [](const StratumKey& key) { return key.friction; }) +
          Html("<h3>By rank</h3>\n<p>The same by the rank that A has at most by construction: that of "
               "its factor J. By chance it is lower.</p>\n") +
          StrataTable<std::less<>>(total, "Loops by rank", [](const StratumKey& key) { return key.rank; }));
}

}  // namespace stiction
