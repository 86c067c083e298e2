// SPDX-License-Identifier: Apache-2.0
#include "bench/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/progress_bar.h"

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
  for (const auto& [key, value] : table.rows.front()->items()) {
    names += value.is_string() && names == head.size();
    head.push_back(key);
  }
  TextTable text(head, names);
  for (const SharedJson& row : table.rows) {
    std::vector<std::string> cells;
    for (const Json& cell : *row) cells.push_back(CellText(cell));
    text.AddRow(std::move(cells));
  }
  fmt::print("{}", text.Done());
}

}  // namespace stiction

namespace stiction::progress {
namespace {

struct State {
  std::mutex mutex;
  std::size_t parts = 1, part = 0;  // which is at hand, from one
  std::string name;
  std::int64_t steps = 1, done = 0;
  std::optional<ProgressBar> bar;
};

State& TheState() {
  static State state;
  return state;
}

}  // namespace

void Expect(std::size_t parts, std::FILE* out) {
  State& now = TheState();
  now.parts = std::max<std::size_t>(1, parts);
  now.bar.emplace(out);
}

void Begin(const std::string& part, std::int64_t steps) {
  State& now = TheState();
  const std::lock_guard lock(now.mutex);
  now.part = std::min(now.part + 1, now.parts);
  now.name = part;
  now.steps = std::max<std::int64_t>(1, steps);
  now.done = 0;
}

void Done(std::int64_t steps) {
  State& now = TheState();
  const std::lock_guard lock(now.mutex);
  now.done = std::min(now.done + steps, now.steps);
  if (!now.bar || now.part == 0) return;
  const auto parts = static_cast<std::int64_t>(now.parts), before = static_cast<std::int64_t>(now.part) - 1;
  now.bar->ShowSome(before * now.steps + now.done, parts * now.steps, [&now] {
    return fmt::format("{} of {}, {}: {} of {}", now.part, now.parts, now.name, Grouped(now.done),
                       Grouped(now.steps));
  });
}

void Clear() {
  State& now = TheState();
  const std::lock_guard lock(now.mutex);
  if (now.bar) now.bar->Clear();
}

}  // namespace stiction::progress
