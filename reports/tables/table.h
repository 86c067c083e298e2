// SPDX-License-Identifier: Apache-2.0
// Table: named columns over cells that have types. Who makes a table knows no medium; a renderer knows a medium
// and no table.
//
//   ToCsv, ToJson   data: integers as they are, a ratio as its counts, its value and its interval
//   ToText, ToHtml, ToLatex   for people: thousands apart, a ratio in few digits with its interval

#ifndef STICTION_REPORTS_TABLES_TABLE_H_
#define STICTION_REPORTS_TABLES_TABLE_H_

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
  std::variant<std::monostate, std::string, std::int64_t, double, Ratio, Html> value;
  std::string below = {}, style = {};  // on a page: what stands small below it; classes

  TableCell() = default;
  TableCell(std::string_view text, std::string small = "", std::string classes = "")
      : value(std::string(text)), below(std::move(small)), style(std::move(classes)) {}
  TableCell(const std::string& text, std::string small = "", std::string classes = "")
      : TableCell(std::string_view(text), std::move(small), std::move(classes)) {}
  TableCell(const char* text, std::string small = "", std::string classes = "")
      : TableCell(std::string_view(text), std::move(small), std::move(classes)) {}
  template <std::integral Integer>
  TableCell(Integer n, std::string small = "", std::string classes = "")
      : value(static_cast<std::int64_t>(n)), below(std::move(small)), style(std::move(classes)) {}
  TableCell(bool yes) : TableCell(yes ? "yes" : "no") {}
  TableCell(double x) : value(x) {}
  TableCell(const Ratio& ratio, std::string small = "", std::string classes = "")
      : value(ratio), below(std::move(small)), style(std::move(classes)) {}
  TableCell(Html html, std::string classes = "") : value(std::move(html)), style(std::move(classes)) {}
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
};

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
  void TotalIsLast();  // the last row becomes the total
};

// Of a text of names, "signature* starts": texts have a star. "found_@" stands for a column per outcome,
// "sum_#" for one per counter of a run.
std::vector<Column> Columns(const std::string& names);

// ---- Tables of tables ----

double RoundedTo(int digits, double x);
// Numbers by value, before words.
bool NaturalLess(const std::string& left, const std::string& right);

struct Chosen {
  std::string name;  // "#loops": the count of the ratio `loops`
  std::string head = {};
};
// In the order of `columns`; a caption that is empty stays that of the table.
Table Select(const Table& table, const std::vector<Chosen>& columns, const std::string& caption = "");
// A table per text of a column, without that column.
std::map<std::string, Table> SplitBy(const Table& table, const std::string& column);
// The keys but `across` down, the values of `across` across; of a pair that has no row `missing`.
Table Pivoted(const Table& table, const std::string& across, const std::string& value,
              const TableCell& missing);
// A row per row and ratio: the keys, `what` (the head of its column), and the ratio as columns of `parts`.
// Nothing of nothing is left out.
Table Melted(const Table& table, const std::string& parts);

// ---- Media ----

// As people read it; of a rate or share the value with its interval.
std::string Shown(const TableCell& cell);

// RFC 4180: a line of names, CRLF.
std::string ToCsv(const Table& table);
// {"columns": [...], "rows": [[...], ...]}
Json ToJson(const Table& table);
// For a terminal; empty without rows.
std::string ToText(const Table& table);
// A part for each policy, below a title with its name.
std::string TextByPolicy(const Table& table, const char* title);
Html ToHtml(const Table& table);
// A text in which nothing is a command of LaTeX.
std::string LatexText(std::string_view text);
// A table of booktabs that may go over pages.
std::string ToLatex(const Table& table);

// The rows of a CSV text, the line of names first. InputError that names the row of an open quotation, and of a
// number of cells other than that of the names.
std::vector<std::vector<std::string>> ReadCsv(std::string_view text, const std::string& source);

}  // namespace stiction

#endif  // STICTION_REPORTS_TABLES_TABLE_H_
