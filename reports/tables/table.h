// SPDX-License-Identifier: Apache-2.0
// Table: named columns over cells that have types. Who makes a table knows no medium; a renderer knows a medium
// and no table.
//
//   ToCsv, ToJson   data: integers as they are, a ratio as its counts, its value and its interval
//   ToText, ToHtml, ToLatex   for people: thousands apart, a ratio in few digits with its interval

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/json_text.h"
#include "reports/html/html.h"

namespace stiction {

// So many of so many, both counted by one count. A rate is in a million, with Garwood's interval; a share has
// that of Clopper and Pearson; a mean has none.
struct Ratio {
  enum Kind { kShare, kRate, kMean };

  std::int64_t count = 0, of = 0;
  Kind kind = kShare;

  bool operator==(const Ratio&) const = default;
};
inline Ratio RateOf(std::int64_t count, std::int64_t of) { return {count, of, Ratio::kRate}; }
inline Ratio ShareOf(std::int64_t count, std::int64_t of) { return {count, of, Ratio::kShare}; }
inline Ratio MeanOf(std::int64_t sum, std::int64_t count) { return {sum, count, Ratio::kMean}; }

struct TableCell {
  std::variant<std::monostate, std::string, std::int64_t, double, Ratio> value;
  std::string below = {}, style = {};  // on a page: what stands small below it; classes

  TableCell() = default;
  template <class Value>
  TableCell(const Value& x, std::string small = "", std::string classes = "")
      : below(std::move(small)), style(std::move(classes)) {
    if constexpr (std::is_same_v<Value, bool>) {
      value = std::string(x ? "yes" : "no");
    } else if constexpr (std::is_integral_v<Value>) {
      value = static_cast<std::int64_t>(x);
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      value = std::string(std::string_view(x));
    } else {
      value = x;
    }
  }
  template <class Value>
  TableCell(const std::optional<Value>& x) : TableCell(x ? TableCell(*x) : TableCell()) {}
};

inline constexpr bool kText = true;  // of a column

struct Column {
  // In data; empty: not there. The parts of a ratio are named "count,of,value,low,high": those behind the last
  // name, and those whose name is empty, are left out.
  std::string name;
  std::string hint = {};  // on a page, where one points at it
  bool text = false;      // to the left; numbers stand to the right
  std::string head = {};  // for people; empty: the first name, with blanks
  std::string from = {};  // of which numbers (CellOf)
};

using Numbers = std::map<std::string, std::int64_t>;  // by the names of groups.h

struct Table {
  struct Row {
    std::vector<TableCell> cells;
    std::string style = {};
    Html across = {};  // on a page: in a row of its own, below
  };

  std::string name, caption;
  std::vector<Column> columns;
  std::vector<Row> rows = {};
  std::vector<TableCell> total = {};  // a last row, which people see and data leave out
  int keys = 1;                       // columns that name a row
  bool stays_open = false;            // on a page, where a long table opens on demand

  // As many cells as columns (InternalError otherwise).
  void Add(std::vector<TableCell> cells, Html across = {});
  void AddCounted(std::vector<TableCell> keys, const Numbers& numbers);  // what its columns show of them
  void TotalIsLast();                                                    // the last row becomes the total
};

// Columns by a text of their names, "signature* starts": those of texts have a star. "found_@" stands for a
// column per outcome, "sum_#" for one per counter of a run.
std::vector<Column> Columns(const std::string& names);

std::vector<std::string> Split(std::string text, const std::string& at);
// Lines of a text without empty ones and remarks (corpus/text_template.h); those behind two blanks go on above.
std::vector<std::string> LogicalLines(const std::string& text);

// A table that tables.txt describes, without rows.
Table Described(const std::string& name);
// "a", "a-b", "a/b", "a%b", "a~b" as tables.txt says. Requires the numbers.
TableCell CellOf(const std::string& expression, const Numbers& numbers);

// ---- Tables of tables ----

double RoundedTo(int digits, double x);
// Numbers by value, before words.
bool NaturalLess(const std::string& left, const std::string& right);

// A table per text of a column, without that column.
std::map<std::string, Table> SplitBy(const Table& table, const std::string& column);
// A table per policy, which `caption` names: "Policy {}:".
std::vector<Table> SplitByPolicy(const Table& table, const char* caption = "Policy {}:");
// The keys but `across` down, the values of `across` across; of a pair that has no row `missing`.
Table Pivoted(const Table& table, const std::string& across, const std::string& value,
              const TableCell& missing);
// A row per row and ratio: the keys, `what` (the head of its column), and the ratio as columns of `parts`.
// Nothing of nothing is left out.
Table Melted(const Table& table, const std::string& parts);

// ---- Media ----

// As people read it; of a rate or share the value with its interval.
std::string Shown(const TableCell& cell);

// A text as a cell of CSV.
std::string QuotedForCsv(const std::string& text);
// RFC 4180: a line of names, CRLF.
std::string ToCsv(const Table& table);
// {"columns": [...], "rows": [[...], ...]}
SharedJson ToJson(const Table& table);
// For a terminal; empty without rows.
std::string ToText(const Table& table);
Html ToHtml(const Table& table);
// A text in which nothing is a command of LaTeX.
std::string LatexText(std::string_view text);
// A table of booktabs that may go over pages.
std::string ToLatex(const Table& table);

// A CSV text with a line of names. InputError names the row of what is not as expected.
class CsvReader {
 public:
  // `written_by`: what writes such a file.
  CsvReader(std::string_view text, std::string source, std::string written_by);

  std::size_t size() const { return rows_.size(); }
  std::size_t IndexOf(const std::string& column) const;
  const std::string& Text(std::size_t row, const std::string& column) const;
  std::int64_t Count(std::size_t row, const std::string& column) const;
  std::optional<double> Measure(std::size_t row, const std::string& column) const;  // nothing, or not negative
  [[noreturn]] void Refuse(std::size_t row, const std::string& what) const;

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
  std::string source_, written_by_;
};

}  // namespace stiction
