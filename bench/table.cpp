// SPDX-License-Identifier: Apache-2.0
#include "bench/table.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "corpus/json.h"
#include "corpus/plain_text.h"

namespace stiction {
namespace {

// Objects count by name; arrays are quartiles.
std::string CellText(const Json& cell) {
  if (cell.is_null()) return "";
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_number_integer()) return JsonText(cell);
  if (cell.is_number()) {
    const double x = cell.get<double>();
    return x < 1000 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x);
  }
  if (cell.is_object()) {
    std::string text;
    for (const auto& [key, value] : cell.items())
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, JsonText(value));
    return text;
  }
  return fmt::format("{} ({} - {})", CellText(cell[1]), CellText(cell[0]), CellText(cell[2]));
}

}  // namespace

void Print(const BenchTable& table) {
  fmt::print("\n{}\n", table.title);
  if (table.rows.empty()) return;
  std::vector<std::string> head;
  std::size_t names = 0;
  for (const auto& [key, value] : table.rows.front().items()) {
    names += value.is_string() && names == head.size();
    head.push_back(key);
  }
  TextTable text(head, names);
  for (const Json& row : table.rows) {
    std::vector<std::string> cells;
    for (const Json& cell : row) cells.push_back(CellText(cell));
    text.AddRow(std::move(cells));
  }
  fmt::print("{}", text.Done());
}

}  // namespace stiction
