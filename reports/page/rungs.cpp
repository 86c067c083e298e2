// SPDX-License-Identifier: Apache-2.0
#include "reports/page/rungs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "corpus/input_error.h"
#include "corpus/order_statistics.h"
#include "reports/tables/discovery.h"

namespace stiction {
namespace {

// A method over an arithmetic on a family, over all settings; in the order of the file, families together.
std::vector<RungLine> SumsOf(const std::vector<RungLine>& lines) {
  std::vector<RungLine> sums;
  std::map<std::string, int> families;
  for (const RungLine& line : lines) {
    families.try_emplace(line.family, static_cast<int>(families.size()));
    const auto sum = std::ranges::find_if(sums, [&line](const RungLine& s) {
      return s.family == line.family && s.method == line.method && s.arithmetic == line.arithmetic;
    });
    if (sum == sums.end()) {
      sums.push_back(line);
      continue;
    }
    for (const auto& [name, count] : line.counts) sum->counts[name] += count;
    sum->microseconds.insert(sum->microseconds.end(), line.microseconds.begin(), line.microseconds.end());
    sum->worst_residual = std::max(sum->worst_residual, line.worst_residual);
  }
  std::ranges::stable_sort(sums, {}, [&families](const RungLine& sum) { return families[sum.family]; });
  return sums;
}

Table RungsTable(const std::vector<RungLine>& lines) {
  Table table = Described("rungs");
  for (const RungLine& sum : SumsOf(lines)) {
    const TableCell median = sum.microseconds.empty() ? TableCell() : QuartilesOf(sum.microseconds).median;
    table.AddCounted(
        {sum.family, sum.method, sum.arithmetic, median, fmt::format("{:.0e}", sum.worst_residual)},
        sum.counts);
  }
  return table;
}

}  // namespace

std::vector<RungLine> ReadRungs(const std::filesystem::path& file) {
  const CsvReader rows(ReadText(file), file.string(), "a file of bench --csv");
  std::vector<RungLine> lines;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RungLine line{rows.Text(i, "family"), rows.Text(i, "method"), rows.Text(i, "arithmetic"), {}, {}};
    Numbers& n = line.counts;
    for (const char* name : {"problems", "solved", "undecided", "other", "refused", "wrong", "silent"})
      n[name] = rows.Count(i, name);
    n["asked"] = n["problems"] - n["refused"];
    if (const auto median = rows.Measure(i, "microseconds_median")) line.microseconds = {*median};
    line.worst_residual = rows.Measure(i, "worst_residual").value_or(0);
    if (n["solved"] + n["undecided"] + n["other"] != n["asked"] || n["wrong"] > n["problems"] ||
        n["silent"] > n["wrong"] || n["silent"] > n["solved"] + n["other"])
      rows.Refuse(i, fmt::format("found counts that do not add up to {} problems", n["problems"]));
    lines.push_back(std::move(line));
  }
  if (lines.empty())
    throw InputError(fmt::format("{}: found no line, expected a file of bench --csv", file.string()));
  return lines;
}

Table RungsFigure(const std::vector<RungLine>& lines) {
  Table table{"rungs", "",
              Columns("family* method* arithmetic* microseconds lost asked solved wrong undecided")};
  for (const RungLine& sum : SumsOf(lines)) {
    const auto count = [&sum](const char* name) { return sum.counts.at(name); };
    const std::int64_t asked = count("asked");
    if (sum.microseconds.empty() || asked == 0) continue;
    const double lost = static_cast<double>(count("wrong") + count("undecided")) / static_cast<double>(asked);
    table.Add({sum.family, sum.method, sum.arithmetic, QuartilesOf(sum.microseconds).median, lost, asked,
               count("solved"), count("wrong"), count("undecided")});
  }
  return table;
}

void AddRungs(Facts& facts, const std::vector<RungLine>& lines) {
  std::set<std::string> families, methods, arithmetics;
  Numbers& n = facts.numbers;
  for (const char* what : {"asked", "wrong", "silent"}) {
    for (const std::string of : {"rounded_", "exact_"}) n[of + what] = 0;
    for (const RungLine& line : lines) {
      const bool exact = line.arithmetic == "exact" || line.arithmetic == "filtered";
      n[(exact ? "exact_" : "rounded_") + std::string(what)] += line.counts.at(what);
    }
  }
  for (const RungLine& line : lines) {
    families.insert(line.family);
    methods.insert(line.method);
    arithmetics.insert(line.arithmetic.substr(0, line.arithmetic.find(' ')));  // "double scaled": with a remedy
  }
  n["rung_families"] = std::ssize(families);
  n["rung_methods"] = std::ssize(methods);
  n["rung_arithmetics"] = std::ssize(arithmetics);
  n["rungs_timed"] = !RungsFigure(lines).rows.empty();
  facts.tables["rungs"] = [&lines] { return std::vector<Table>{RungsTable(lines)}; };
}

std::string BenchName(const std::filesystem::path& file) {
  return "bench/" + FileName(file.stem().string()) + ".csv";
}

}  // namespace stiction
