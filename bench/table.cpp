// SPDX-License-Identifier: Apache-2.0
#include "bench/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "corpus/json.h"

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
  std::vector<std::vector<std::string>> lines(1);
  for (const auto& [key, value] : table.rows.front().items()) lines[0].push_back(key);
  for (const Json& row : table.rows) {
    auto& line = lines.emplace_back();
    for (const Json& cell : row) line.push_back(CellText(cell));
  }
  for (const auto& line : lines) {
    for (std::size_t column = 0; column < line.size(); ++column) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, other[column].size());
      const bool words = table.rows.front().at(lines[0][column]).is_string();
      fmt::print("{}", words ? fmt::format("  {:<{}}", line[column], width)
                             : fmt::format("  {:>{}}", line[column], width));
    }
    fmt::print("\n");
  }
}

}  // namespace stiction
