// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/rational.h"
#include "reports/tables/tables_txt.h"
#include "solver/problem/check.h"
#include "solver/problem/solution.h"

namespace stiction {
namespace {

template <class Value>
const Value* As(const TableCell& cell) {
  return std::get_if<Value>(&cell.value);
}

std::string Spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string HeadOf(const Column& column) {
  return column.head.empty() ? Spaced(column.name.substr(0, column.name.find(",,"))) : column.head;
}

std::size_t IndexOf(const Table& table, const std::string& name) {
  const auto at = std::find_if(table.columns.begin(), table.columns.end(), [&name](const Column& column) {
    return column.name == name || HeadOf(column) == Spaced(name);
  });
  STICTION_CHECK(at != table.columns.end(), fmt::format("table {} has no column {}", table.name, name));
  return static_cast<std::size_t>(at - table.columns.begin());
}

// ---- Data ----

// Count, of, value, low and high; in six digits, or as many as tell the ends from the value.
std::array<TableCell, 5> PartsOf(const Ratio& ratio) {
  std::array<TableCell, 5> parts = {ratio.count, ratio.of};
  if (ratio.of == 0) return parts;
  const bool rate = ratio.kind == Ratio::kRate;
  const double scale = rate ? 1e6 / static_cast<double>(ratio.of) : 1;
  const double value = rate ? scale * static_cast<double>(ratio.count)
                            : static_cast<double>(ratio.count) / static_cast<double>(ratio.of);
  const Interval ends = rate ? CountInterval(ratio.count) : ShareInterval(ratio.count, ratio.of);
  const Interval interval = {scale * ends.low, scale * ends.high};
  const int digits = DigitsToTell(value, interval, 6);
  parts[2] = RoundedTo(digits, value);
  parts[3] = RoundedTo(digits, RoundedDown(interval.low, digits));
  parts[4] = RoundedTo(digits, RoundedUp(interval.high, digits));
  return parts;
}

// What data have of a cell: a ratio is several.
std::vector<TableCell> DataOf(const Column& column, const TableCell& cell) {
  const auto* const ratio = As<Ratio>(cell);
  if (ratio == nullptr) return column.name.empty() ? std::vector<TableCell>() : std::vector<TableCell>{cell};
  const std::vector<std::string> names = Split(column.name, ",");
  const std::array<TableCell, 5> parts = PartsOf(*ratio);
  std::vector<TableCell> data;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) data.push_back(parts[i]);
  }
  return data;
}

std::vector<std::string> DataNames(const Table& table) {
  std::vector<std::string> names;
  for (const Column& column : table.columns) {
    for (const std::string& name : Split(column.name, ",")) {
      if (!name.empty()) names.push_back(name);
    }
  }
  return names;
}

std::vector<TableCell> DataRow(const Table& table, const Table::Row& row) {
  std::vector<TableCell> data;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    for (TableCell& cell : DataOf(table.columns[i], row.cells[i])) data.push_back(std::move(cell));
  }
  return data;
}

std::string DataText(const TableCell& cell) {
  if (const auto* text = As<std::string>(cell)) return *text;
  if (const auto* n = As<std::int64_t>(cell)) return fmt::format("{}", *n);
  if (const auto* x = As<double>(cell)) return fmt::format("{}", *x);
  return "";
}

// As text and as a number alike.
Json DataJson(const TableCell& cell) {
  if (cell.value.index() == 0) return nullptr;
  return As<std::string>(cell) != nullptr ? Json(DataText(cell)) : Json::parse(DataText(cell));
}

// ---- A page ----

bool IsZero(const TableCell& cell) {
  const auto* const n = As<std::int64_t>(cell);
  const auto* const ratio = As<Ratio>(cell);
  return (n != nullptr && *n == 0) || (ratio != nullptr && ratio->kind != Ratio::kMean && ratio->count == 0);
}

Html PageContent(const TableCell& cell) {
  const auto* const ratio = As<Ratio>(cell);
  const bool counted = ratio != nullptr && ratio->kind != Ratio::kMean;
  Html content = Text(counted ? Grouped(ratio->count) : Shown(cell));
  if (counted && ratio->of > 0) content += Tag("small")(Shown(cell));
  if (!cell.below.empty()) content += Tag("small")(cell.below);
  return content;
}

Html PageRow(const Table& table, const std::vector<TableCell>& cells, const std::string& style) {
  Html row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool header = static_cast<int>(i) < table.keys;
    const std::string own = cells[i].style.empty() && IsZero(cells[i]) ? "zero" : cells[i].style;
    const std::string aligned = table.columns[i].text ? "" : "n";
    const std::string classes = aligned + (aligned.empty() || own.empty() ? "" : " ") + own;
    row +=
        Tag(header ? "th" : "td", {{"scope", header ? "row" : ""}, {"class", classes}})(PageContent(cells[i]));
  }
  return Tag("tr", {{"class", style}})(row) + Html("\n");
}

// The colour of so many in a million: one class per factor of ten.
std::string Heat(const Ratio& ratio) {
  const double rate = 1e6 * static_cast<double>(ratio.count) / static_cast<double>(ratio.of);
  int level = 1;
  for (double limit = 10; level < 5 && rate >= limit; limit *= 10) ++level;
  return fmt::format("h{}", level);
}

// ---- Descriptions ----

void AddDescribed(Table& table, const std::vector<std::string>& line) {
  const std::size_t equals = std::min(line[0].find(" = "), line[0].size());
  for (Column& column : Columns(line[0].substr(0, equals))) {
    column.from = equals < line[0].size() ? line[0].substr(equals + 3) : column.name;
    if (column.name == "-") column.name.clear();
    if (line.size() > 1 && line[1] != "-") column.hint = line[1];
    if (line.size() > 2) column.head = line[2];
    table.columns.push_back(std::move(column));
  }
}

std::map<std::string, Table> ReadDescriptions() {
  std::map<std::string, Table> tables;
  Table* last = nullptr;
  for (const std::string& line : LogicalLines({std::begin(kTablesTxt), std::end(kTablesTxt)})) {
    const std::vector<std::string> parts = Split(line, " | ");
    if (!line.starts_with("# ")) {
      AddDescribed(*last, parts);
      continue;
    }
    const std::vector<std::string> names = Split(parts[0].substr(2), " ");
    last = &tables[names[0]];
    last->name = names[0];
    last->caption = parts.size() > 1 ? parts[1] : "";
    if (names.size() > 1) last->keys = std::stoi(names[1]);
  }
  return tables;
}

}  // namespace

std::vector<std::string> Split(std::string text, const std::string& at) {
  std::vector<std::string> parts;
  for (std::size_t found = text.find(at); found != text.npos; found = text.find(at)) {
    parts.push_back(text.substr(0, found));
    text.erase(0, found + at.size());
  }
  parts.push_back(text);
  return parts;
}

std::vector<std::string> LogicalLines(const std::string& text) {
  std::vector<std::string> lines;
  for (const std::string& line : Split(text, "\n")) {
    if (line.starts_with("  ")) {
      const bool closes = std::string_view(",;.:").find(line[2]) != std::string_view::npos;
      lines.back() += line.substr(closes ? 2 : 1);
    } else if (!line.empty() && !line.starts_with("@ ") && line != "@") {
      lines.push_back(line);
    }
  }
  return lines;
}

Table Described(const std::string& name) {
  static const std::map<std::string, Table> tables = ReadDescriptions();
  STICTION_CHECK(tables.contains(name), "expected a table of tables.txt, found " + name);
  return tables.at(name);
}

TableCell CellOf(const std::string& expression, const Numbers& numbers) {
  const bool exception = expression.back() == '!', coloured = expression.back() == '^';
  const std::string plain = expression.substr(0, expression.size() - (exception || coloured));
  const std::size_t at = std::min(plain.find_first_of("-/%~"), plain.size());
  const auto number = [&numbers](const std::string& name) {
    const auto found = numbers.find(name);
    STICTION_CHECK(found != numbers.end(), "expected a number " + name);
    return found->second;
  };
  const std::int64_t left = number(plain.substr(0, at)),
                     right = at < plain.size() ? number(plain.substr(at + 1)) : 0;
  const char sign = at < plain.size() ? plain[at] : ' ';
  if (sign == ' ' || sign == '-') return {left - right, "", exception && left != right ? "h5" : ""};
  const Ratio ratio = sign == '/'   ? RateOf(left, right)
                      : sign == '%' ? ShareOf(left, right)
                                    : MeanOf(left, right);
  if (coloured && left == 0) return 0;
  return {ratio, "", coloured ? Heat(ratio) : ""};
}

void Table::AddCounted(std::vector<TableCell> keys, const Numbers& numbers) {
  for (std::size_t i = keys.size(); i < columns.size(); ++i) keys.push_back(CellOf(columns[i].from, numbers));
  Add(std::move(keys));
}

void Table::Add(std::vector<TableCell> cells, Html across) {
  STICTION_CHECK(cells.size() == columns.size(),
                 fmt::format("table {}: {} cells for {} columns", name, cells.size(), columns.size()));
  rows.push_back({std::move(cells), "", std::move(across)});
}

double RoundedTo(int digits, double x) {
  const std::string text = fmt::format("{:.{}g}", x, digits);
  double rounded = 0;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

void Table::TotalIsLast() {
  total = std::move(rows.back().cells);
  rows.pop_back();
}

std::vector<Column> Columns(const std::string& names) {
  std::vector<Column> columns;
  for (std::string name : Split(names, " ")) {
    const char last = name.back();
    if (last == '*' || last == '@' || last == '#') name.pop_back();
    const Statistics none;
    if (last == '@') {
      for (const std::string_view outcome : kOutcomeNames) columns.push_back({name + std::string(outcome)});
    } else if (last == '#') {
      ForEachField(
          none, [&](const char* counter, const char*, std::int64_t) { columns.push_back({name + counter}); });
    } else {
      columns.push_back({name, "", last == '*'});
    }
  }
  return columns;
}

bool NaturalLess(const std::string& left, const std::string& right) {
  const auto is_number = [](const std::string& text) {
    return !text.empty() && text[0] >= '0' && text[0] <= '9';
  };
  if (is_number(left) && is_number(right)) {
    const auto x = ParseRational(left), y = ParseRational(right);
    if (x && y && *x != *y) return *x < *y;
  }
  return left < right;
}

std::map<std::string, Table> SplitBy(const Table& table, const std::string& column) {
  const auto at = static_cast<std::ptrdiff_t>(IndexOf(table, column));
  Table empty = table;
  empty.rows.clear();
  empty.columns.erase(empty.columns.begin() + at);
  empty.keys -= at < table.keys;
  std::map<std::string, Table> parts;
  for (Table::Row row : table.rows) {
    const std::string value = Shown(row.cells[static_cast<std::size_t>(at)]);
    row.cells.erase(row.cells.begin() + at);
    parts.try_emplace(value, empty).first->second.rows.push_back(std::move(row));
  }
  return parts;
}

std::vector<Table> SplitByPolicy(const Table& table, const char* caption) {
  std::vector<Table> parts;
  for (auto& [policy, part] : SplitBy(table, "policy")) {
    parts.push_back(part);
    parts.back().caption = fmt::format(fmt::runtime(caption), policy);
  }
  return parts;
}

Table Pivoted(const Table& table, const std::string& across, const std::string& value,
              const TableCell& missing) {
  const std::size_t at = IndexOf(table, across), from = IndexOf(table, value);
  const auto less = [](const std::string& left, const std::string& right) { return NaturalLess(left, right); };
  std::map<std::string, std::string, decltype(less)> values(less);  // as people read them
  for (const Table::Row& row : table.rows) values[DataText(row.cells[at])] = Shown(row.cells[at]);
  Table pivoted{table.name, table.caption, {}, {}, {}, table.keys - 1};
  for (std::size_t i = 0; static_cast<int>(i) < table.keys; ++i) {
    if (i != at) pivoted.columns.push_back(table.columns[i]);
  }
  for (const auto& [each, head] : values) pivoted.columns.push_back({each, "", false, head});
  std::map<std::string, std::size_t> rows;  // by the text of their keys
  for (const Table::Row& row : table.rows) {
    std::vector<TableCell> cells;
    std::string key;
    for (std::size_t i = 0; static_cast<int>(i) < table.keys; ++i) {
      if (i == at) continue;
      cells.push_back(row.cells[i]);
      key += DataText(row.cells[i]) + '\n';
    }
    const std::size_t keys = cells.size();
    const auto [found, is_new] = rows.emplace(key, pivoted.rows.size());
    cells.resize(keys + values.size(), missing);
    if (is_new) pivoted.Add(std::move(cells));
    const auto place = std::distance(values.begin(), values.find(DataText(row.cells[at])));
    pivoted.rows[found->second].cells[keys + static_cast<std::size_t>(place)] = row.cells[from];
  }
  return pivoted;
}

Table Melted(const Table& table, const std::string& parts) {
  const std::vector<Column> keys(table.columns.begin(), table.columns.begin() + table.keys);
  Table melted{table.name, table.caption, keys, {}, {}, table.keys + 1};
  melted.columns.insert(melted.columns.end(), {{"what", "", kText}, {parts}});
  for (const Table::Row& row : table.rows) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const auto* const ratio = As<Ratio>(row.cells[i]);
      if (ratio == nullptr || ratio->of == 0) continue;
      std::vector<TableCell> cells(row.cells.begin(), row.cells.begin() + table.keys);
      cells.insert(cells.end(), {HeadOf(table.columns[i]), *ratio});
      melted.Add(std::move(cells));
    }
  }
  return melted;
}

std::string Shown(const TableCell& cell) {
  if (const auto* text = As<std::string>(cell)) return *text;
  if (const auto* n = As<std::int64_t>(cell)) return Grouped(*n);
  if (const auto* x = As<double>(cell)) return fmt::format("{:.3g}", *x);
  const auto* const ratio = As<Ratio>(cell);
  if (ratio == nullptr) return "";
  if (ratio->kind == Ratio::kMean) return Mean(ratio->count, ratio->of);
  return ratio->kind == Ratio::kRate ? RateText(ratio->count, ratio->of) : ShareText(ratio->count, ratio->of);
}

std::string QuotedForCsv(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string ToCsv(const Table& table) {
  std::string csv;
  const auto add_line = [&csv](const auto& cells, auto text_of) {
    for (std::size_t i = 0; i < cells.size(); ++i) csv += (i > 0 ? "," : "") + QuotedForCsv(text_of(cells[i]));
    csv += "\r\n";
  };
  add_line(DataNames(table), [](const std::string& name) { return name; });
  for (const Table::Row& row : table.rows) add_line(DataRow(table, row), &DataText);
  return csv;
}

SharedJson ToJson(const Table& table) {
  Json rows = Json::array();
  for (const Table::Row& row : table.rows) {
    Json cells = Json::array();
    for (const TableCell& cell : DataRow(table, row)) cells.push_back(DataJson(cell));
    rows.push_back(std::move(cells));
  }
  return Json{{"columns", DataNames(table)}, {"rows", std::move(rows)}};
}

std::string ToText(const Table& table) {
  std::vector<std::string> heads;
  std::size_t names = 0;
  for (const Column& column : table.columns) {
    if (heads.size() == names && static_cast<int>(names) < table.keys && column.text) ++names;
    heads.push_back(HeadOf(column));
  }
  TextTable text(std::move(heads), names);
  for (const Table::Row& row : table.rows) {
    std::vector<std::string> cells;
    for (const TableCell& cell : row.cells) cells.push_back(Shown(cell));
    text.AddRow(std::move(cells));
  }
  return text.Done();
}

Html ToHtml(const Table& table) {
  constexpr std::size_t kLong = 30;  // rows
  Html head, rows;
  for (const Column& column : table.columns) {
    head += Tag("th",
                {{"scope", "col"}, {"class", column.text ? "" : "n"}, {"title", column.hint}})(HeadOf(column));
  }
  const Table::Row* before = nullptr;
  for (const Table::Row& row : table.rows) {
    const bool starts_group =
        before != nullptr && table.keys > 1 && Shown(row.cells[0]) != Shown(before->cells[0]);
    rows += PageRow(table, row.cells, row.style.empty() && starts_group ? "group" : row.style);
    if (!row.across.empty()) {
      const Tag cell("td", {{"colspan", std::to_string(table.columns.size())}});
      rows += Tag("tr", {{"class", "more"}})(cell(row.across)) + Html("\n");
    }
    before = &row;
  }
  if (!table.total.empty()) rows += PageRow(table, table.total, "total");
  const Html whole = Tag("table")(Tag("caption")(table.caption) + Tag("thead")(Tag("tr")(head)) + Html("\n") +
                                  Tag("tbody")(Html("\n") + rows));
  const Tag frame("div",
                  {{"class", "scroll"}, {"role", "region"}, {"aria-label", table.caption}, {"tabindex", "0"}});
  const std::size_t count = table.rows.size() + !table.total.empty();
  if (count <= kLong || table.stays_open) return frame(whole) + Html("\n");
  const Html title = Tag("summary")(
      fmt::format("{}: a table of {}", table.caption, Counted(static_cast<std::int64_t>(count), "row")));
  return Tag("details", {{"class", "folded"}})(title + Html("\n") + frame(whole)) + Html("\n");
}

std::string LatexText(std::string_view text) {
  static const std::map<char, std::string> special = {{'\\', "\\textbackslash{}"},
                                                      {'~', "\\textasciitilde{}"},
                                                      {'^', "\\textasciicircum{}"},
                                                      {'<', "\\textless{}"},
                                                      {'>', "\\textgreater{}"},
                                                      {'"', "{''}"},
                                                      {'[', "{[}"},
                                                      {']', "{]}"}};  // behind \\ it would be a length
  std::string escaped;
  for (const char c : text) {
    if (const auto found = special.find(c); found != special.end()) {
      escaped += found->second;
    } else if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) {
      escaped += std::string("\\") + c;
    } else {
      escaped += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
  }
  return escaped;
}

std::string ToLatex(const Table& table) {
  std::string columns, head, rows;
  for (const Column& column : table.columns) {
    columns += column.text ? 'l' : 'r';
    head += (head.empty() ? "" : " & ") + LatexText(HeadOf(column));
  }
  for (const Table::Row& row : table.rows) {
    std::vector<std::string> cells;
    for (const TableCell& cell : row.cells) cells.push_back(LatexText(Shown(cell)));
    rows += fmt::format("{} \\\\\n", fmt::join(cells, " & "));
  }
  return fmt::format(
      "% Written by stiction; needs booktabs and longtable.\n\\begin{{longtable}}{{{0}}}\n"
      "\\caption{{{1}}}\\label{{tab:stiction-{2}}}\\\\\n\\toprule\n{3} \\\\\n\\midrule\n\\endfirsthead\n"
      "\\toprule\n{3} \\\\\n\\midrule\n\\endhead\n{4}\\bottomrule\n\\end{{longtable}}\n",
      columns, LatexText(table.caption), table.name, head, rows);
}

CsvReader::CsvReader(std::string_view text, std::string source, std::string written_by)
    : source_(std::move(source)), written_by_(std::move(written_by)) {
  std::vector<std::vector<std::string>>& rows = rows_;
  std::vector<std::string> row(1);
  bool quoted = false;
  const auto end_row = [&] {
    if (!rows.empty() && row.size() != rows.front().size())
      Refuse(rows.size() - 1, fmt::format("found {} cells, expected {}", row.size(), rows.front().size()));
    rows.push_back(std::exchange(row, std::vector<std::string>(1)));
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      row.back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\n') {
      end_row();
    } else if (quoted || c != '\r') {
      row.back() += c;
    }
  }
  if (quoted) Refuse(rows.size() - 1, "found a quotation that does not end");
  if (row.size() > 1 || !row.back().empty()) end_row();
  if (rows.empty()) return;
  names_ = std::move(rows.front());
  rows.erase(rows.begin());
}

void CsvReader::Refuse(std::size_t row, const std::string& what) const {
  throw InputError(fmt::format("{}: row {}: {}", source_, row + 2, what));
}

std::size_t CsvReader::IndexOf(const std::string& column) const {
  const auto at = std::find(names_.begin(), names_.end(), column);
  if (at == names_.end())
    throw InputError(fmt::format("{}:1: found no column {}, expected {}", source_, column, written_by_));
  return static_cast<std::size_t>(at - names_.begin());
}

const std::string& CsvReader::Text(std::size_t row, const std::string& column) const {
  return rows_[row][IndexOf(column)];
}

std::optional<double> CsvReader::Measure(std::size_t row, const std::string& column) const {
  const std::string& text = Text(row, column);
  if (text.empty()) return std::nullopt;
  double x = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x) || x < 0)
    Refuse(row, fmt::format("{}: found '{}', expected a number, or nothing", column, text));
  return x;
}

std::int64_t CsvReader::Count(std::size_t row, const std::string& column) const {
  const std::string& text = Text(row, column);
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0)
    Refuse(row, fmt::format("{}: found '{}', expected a count", column, text));
  return count;
}

}  // namespace stiction
