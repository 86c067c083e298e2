// SPDX-License-Identifier: Apache-2.0
#include "reports/page/figures.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "corpus/intervals.h"
#include "corpus/rational.h"
#include "reports/page/page.h"
#include "reports/tables/csv.h"

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
  for (const double x : {value, interval.low, interval.high}) row.push_back(RoundedTo(digits, x));
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

constexpr std::array kDrawnFailures = {Outcome::kCycle, Outcome::kSingular, Outcome::kRay};

// In the order of numbers, what is none last: "1/10", "1/2", "mixed".
struct ByValue {
  bool operator()(const std::string& left, const std::string& right) const {
    const auto a = ParseRational(left), b = ParseRational(right);
    if (!a || !b) return a && !b ? true : !a && b ? false : left < right;
    return *a < *b;
  }
};

struct RateCount {
  std::int64_t runs = 0;
  std::array<std::int64_t, kDrawnFailures.size()> failures = {};

  void Add(std::int64_t more_runs, const Tally::Outcomes& exact) {
    runs += more_runs;
    for (std::size_t i = 0; i < failures.size(); ++i) failures[i] += exact[static_cast<int>(kDrawnFailures[i])];
  }
};

Tally::Outcomes ExactOutcomes(const Tally& tally) {
  Tally::Outcomes sum = {};
  for (const Tally::Outcomes& exact : tally.verdicts) {
    for (int i = 0; i < kOutcomeCount; ++i) sum[i] += exact[i];
  }
  return sum;
}

using RateKey = std::tuple<std::string, std::string, int>;  // generator, policy, contacts
using RateCounts = std::map<RateKey, std::map<std::string, RateCount, ByValue>>;

void AddRates(FigureTable& figure, const char* by, const RateCounts& counts) {
  for (const auto& [key, values] : counts) {
    for (const auto& [value, count] : values) {
      for (std::size_t i = 0; i < kDrawnFailures.size(); ++i) {
        if (count.runs == 0) continue;
        const auto& [generator, policy, contacts] = key;
        Json row = {by,         generator,        policy, contacts, value, Name(kDrawnFailures[i]),
                    count.runs, count.failures[i]};
        AddRate(row, count.failures[i], count.runs);
        figure.rows.push_back(std::move(row));
      }
    }
  }
}

FigureTable RatesFigure(const Record& total) {
  FigureTable figure{
      "rates",
      {"by", "generator", "policy", "contacts", "value", "outcome", "runs", "count", "rate", "low", "high"}};
  RateCounts by_contacts, by_friction, by_rank;
  for (const auto& [key, tally] : total.tallies) {
    const RateKey row{key.generator, key.policy, key.contacts};
    by_contacts[row][std::to_string(key.contacts)].Add(tally.problems, ExactOutcomes(tally));
    for (const auto& [stratum_key, stratum] : tally.strata) {
      by_friction[row][stratum_key.friction].Add(stratum.problems, stratum.exact);
      by_rank[row][std::to_string(stratum_key.rank)].Add(stratum.problems, stratum.exact);
    }
  }
  AddRates(figure, "contacts", by_contacts);
  AddRates(figure, "friction", by_friction);
  AddRates(figure, "rank", by_rank);
  return figure;
}

// ---- Doubles ----

FigureTable DoublesFigure(const Record& total) {
  std::map<std::tuple<std::string, int, int>, std::int64_t> counts;
  for (const auto& [key, tally] : total.tallies) {
    for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
      for (int exact = 0; exact < kOutcomeCount; ++exact)
        counts[{key.policy, inexact, exact}] += tally.verdicts[inexact][exact];
    }
  }
  FigureTable figure{"doubles", {"policy", "in_doubles", "exact", "runs"}};
  for (const auto& [key, runs] : counts) {
    const auto& [policy, inexact, exact] = key;
    if (runs > 0) figure.rows.push_back({policy, kOutcomeNames[inexact], kOutcomeNames[exact], runs});
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
  std::map<std::string, Tally> by_generator;
  for (const auto& [key, tally] : total.tallies) by_generator[key.generator].Merge(tally);
  FigureTable figure{"trust", {"generator", "what", "count", "of", "share", "low", "high"}};
  for (const auto& [generator, tally] : by_generator) {
    AddShareRow(figure, {generator, "audited runs, misjudged"}, tally.misjudged, tally.audited);
    AddShareRow(figure, {generator, "runs with a wrong answer"}, tally.wrong, tally.problems);
  }
  return figure;
}

// ---- Steps ----

FigureTable StepsFigure(const Record& total) {
  std::map<std::pair<std::string, int>, Tally> merged;
  for (const auto& [key, tally] : total.tallies) merged[{key.policy, key.contacts}].Merge(tally);
  FigureTable figure{"steps", {"policy", "contacts", "steps", "or_more", "runs"}};
  for (const auto& [key, tally] : merged) {
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
  std::map<std::tuple<std::string, std::string, int>, Tally> merged;
  for (const auto& [key, tally] : total.tallies) merged[{key.generator, key.policy, key.contacts}].Merge(tally);
  FigureTable figure{"pivoting",
                     {"generator", "policy", "contacts", "what", "count", "of", "share", "low", "high"}};
  for (const auto& [key, tally] : merged) {
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
