// SPDX-License-Identifier: Apache-2.0
#include "reports/page/figures.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "corpus/counts.h"
#include "corpus/intervals.h"
#include "reports/page/page.h"
#include "reports/tables/csv.h"
#include "reports/tables/friction_order.h"

namespace stiction {
namespace {

// As text and as a number alike.
double RoundedTo(int digits, double x) {
  const std::string text = fmt::format("{:.{}g}", x, digits);
  double rounded = 0;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

std::string CellText(const Json& cell) {
  if (cell.is_null()) return "";
  return cell.is_string() ? cell.get<std::string>() : JsonText(cell);
}

// In six digits, or as many as tell the ends from the value.
void AddWithInterval(Json& row, double value, Interval interval) {
  const int digits = DigitsToTell(value, interval, 6);
  row.push_back(RoundedTo(digits, value));
  row.push_back(RoundedTo(digits, RoundedDown(interval.low, digits)));
  row.push_back(RoundedTo(digits, RoundedUp(interval.high, digits)));
}

void AddRate(Json& row, std::int64_t count, std::int64_t runs) {
  const Interval interval = CountInterval(count);
  const double scale = 1e6 / static_cast<double>(runs);
  AddWithInterval(row, scale * static_cast<double>(count), {scale * interval.low, scale * interval.high});
}

void AddShare(Json& row, std::int64_t count, std::int64_t of) {
  AddWithInterval(row, static_cast<double>(count) / static_cast<double>(of), ShareInterval(count, of));
}

// ---- Exact rates ----

using RateKey = std::tuple<std::string, std::string, int>;  // generator, policy, contacts
using RateCounts = std::map<RateKey, std::map<std::string, Counts, ByFriction>>;

void AddRates(FigureTable& figure, const char* by, const RateCounts& counts) {
  for (const auto& [key, values] : counts) {
    const auto& [generator, policy, contacts] = key;
    for (const auto& [value, count] : values) {
      if (count.runs == 0) continue;
      for (const auto& [name, failures] : {std::pair("loop", count.Loops()),
                                           {"singular", count.Of(Outcome::kSingular)},
                                           {"ray", count.Of(Outcome::kRay)}}) {
        Json row = {by, generator, policy, contacts, value, name, count.runs, failures};
        AddRate(row, failures, count.runs);
        figure.rows.push_back(std::move(row));
      }
    }
  }
}

RateKey RateKeyOf(const TallyKey& key) { return {key.generator, key.policy, key.contacts}; }

FigureTable RatesFigure(const Record& total) {
  FigureTable figure{
      "rates",
      {"by", "generator", "policy", "contacts", "value", "outcome", "runs", "count", "rate", "low", "high"}};
  RateCounts by_contacts, by_friction, by_rank;
  for (const auto& [key, counts] : CountBy(total, &RateKeyOf))
    by_contacts[key][std::to_string(std::get<int>(key))] = counts;
  const auto friction = [](const TallyKey& key, const StratumKey& stratum) {
    return std::pair(RateKeyOf(key), stratum.friction);
  };
  for (const auto& [key, counts] : CountStrataBy(total, friction)) by_friction[key.first][key.second] = counts;
  const auto rank = [](const TallyKey& key, const StratumKey& stratum) {
    return std::pair(RateKeyOf(key), stratum.rank);
  };
  for (const auto& [key, counts] : CountStrataBy(total, rank))
    by_rank[key.first][std::to_string(key.second)] = counts;
  AddRates(figure, "contacts", by_contacts);
  AddRates(figure, "friction", by_friction);
  AddRates(figure, "rank", by_rank);
  return figure;
}

// ---- Doubles ----

FigureTable DoublesFigure(const Record& total) {
  FigureTable figure{"doubles", {"policy", "in_doubles", "exact", "runs"}};
  for (const auto& [policy, tally] : MergeBy(total, [](const TallyKey& key) { return key.policy; })) {
    for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
      for (int exact = 0; exact < kOutcomeCount; ++exact) {
        const std::int64_t runs = tally.verdicts[inexact][exact];
        if (runs > 0) figure.rows.push_back({policy, kOutcomeNames[inexact], kOutcomeNames[exact], runs});
      }
    }
  }
  return figure;
}

// Appends `row` with a count, of how many, and its share; nothing where there were none.
void AddShareRow(FigureTable& figure, Json row, std::int64_t count, std::int64_t of) {
  if (of == 0) return;
  row.push_back(count);
  row.push_back(of);
  AddShare(row, count, of);
  figure.rows.push_back(std::move(row));
}

FigureTable TrustFigure(const Record& total) {
  FigureTable figure{"trust", {"generator", "what", "count", "of", "share", "low", "high"}};
  for (const auto& [generator, counts] : CountBy(total, [](const TallyKey& key) { return key.generator; })) {
    AddShareRow(figure, {generator, "audited runs, misjudged"}, counts.misjudged, counts.audited);
    AddShareRow(figure, {generator, "runs with a wrong answer"}, counts.wrong, counts.runs);
  }
  return figure;
}

// ---- Steps ----

FigureTable StepsFigure(const Record& total) {
  const auto by = [](const TallyKey& key) { return std::pair(key.policy, key.contacts); };
  FigureTable figure{"steps", {"policy", "contacts", "steps", "or_more", "runs"}};
  for (const auto& [key, tally] : MergeBy(total, by)) {
    for (int steps = 0; steps < Tally::kBins; ++steps) {
      if (tally.steps[steps] == 0) continue;
      figure.rows.push_back(
          {key.first, key.second, steps, steps == Tally::kBins - 1 ? "yes" : "no", tally.steps[steps]});
    }
  }
  return figure;
}

FigureTable LoopStepsFigure(const Record& total) {
  FigureTable figure{"loop-steps", {"contacts", "zero_steps", "loops"}};
  for (const auto& [contacts, tally] : total.loops) {
    for (const auto& [zero_steps, loops] : tally.by_zero_steps)
      figure.rows.push_back({contacts, zero_steps, loops});
  }
  return figure;
}

FigureTable PivotingFigure(const Record& total) {
  FigureTable figure{"pivoting",
                     {"generator", "policy", "contacts", "what", "count", "of", "share", "low", "high"}};
  for (const auto& [key, tally] : MergeBy(total, &RateKeyOf)) {
    const auto& [generator, policy, contacts] = key;
    AddShareRow(figure, {generator, policy, contacts, "a step of length zero"}, tally.with_zero_steps,
                tally.problems);
    AddShareRow(figure, {generator, policy, contacts, "a variable given up"}, tally.with_give_ups,
                tally.problems);
  }
  return figure;
}

FigureTable DrivingFigure(const Record& total) {
  FigureTable figure{"driving", {"contacts", "what", "count", "of", "share", "low", "high"}};
  for (const auto& [contacts, tally] : total.existence) {
    AddShareRow(figure, {contacts, "folds"}, tally.with_folds, tally.problems);
    AddShareRow(figure, {contacts, "descents"}, tally.with_descents, tally.problems);
    AddShareRow(figure, {contacts, "ties"}, tally.with_ties, tally.problems);
  }
  return figure;
}

// ---- Methods ----

FigureTable MethodsFigure(const ReportContent& content) {
  FigureTable figure{"methods",
                     {"method", "asked_about", "contacts", "asked", "solved", "share", "low", "high"}};
  for (const MethodLine& line : MethodLines(content)) {
    Json row = {line.method, line.asked_about, line.contacts, line.asked, line.solved};
    AddShare(row, line.solved, line.asked);
    figure.rows.push_back(std::move(row));
  }
  return figure;
}

}  // namespace

std::vector<FigureTable> Figures(const ReportContent& content) {
  const Record& total = content.total;
  std::vector<FigureTable> all = {
      RatesFigure(total),        DoublesFigure(total),   TrustFigure(total),
      StepsFigure(total),        LoopStepsFigure(total), PivotingFigure(total),
      DrivingFigure(total),      MethodsFigure(content), FrontiersFigure(content.frontiers),
      RungsFigure(content.rungs)};
  std::erase_if(all, [](const FigureTable& figure) { return figure.rows.empty(); });
  return all;
}

std::string FigureCsv(const FigureTable& figure) {
  Csv csv;
  for (const std::string& column : figure.columns) csv.Add(column);
  csv.EndRow();
  for (const Json& row : figure.rows) {
    for (const Json& cell : row) csv.Add(CellText(cell));
    csv.EndRow();
  }
  return csv.text();
}

Json FiguresToJson(const std::vector<FigureTable>& figures) {
  Json json = Json::object();
  for (const FigureTable& figure : figures)
    json[figure.name] = {{"columns", figure.columns}, {"rows", figure.rows}};
  return json;
}

Html FigurePlace(const std::string& name, const std::string& caption, const std::string& made_by) {
  const std::string table = name.substr(0, name.find('.')), file = "figures/" + table + ".csv";
  const Html command =
      made_by.empty() ? Html("<code>stiction report STORE -o DIR</code> of <a href=\"#again\">this store</a>")
                      : Tag("code")(made_by);
  const Html source =
      Html("Data: ") + Tag("a", {{"href", file}})(Tag("code")(file)) + Html(", made by ") + command;
  return Tag("figure", {{"class", "plot"}, {"data-figure", name}})(
             Html("\n") + Tag("figcaption")(caption) + Html("\n<div class=\"drawing\"></div>\n") +
             Tag("p", {{"class", "source"}})(source) + Html("\n")) +
         Html("\n");
}

}  // namespace stiction
