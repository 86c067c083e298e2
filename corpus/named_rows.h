// SPDX-License-Identifier: Apache-2.0
// Tables whose rows have a name.

#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace stiction {

// Null if none has this name.
template <class Rows>
auto* RowNamed(const Rows& rows, std::string_view name) {
  const auto row = std::ranges::find_if(rows, [name](const auto& each) { return each.name == name; });
  return row == std::ranges::end(rows) ? nullptr : &*row;
}

template <class Rows>
std::vector<std::string> NamesOf(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

}  // namespace stiction
