// SPDX-License-Identifier: Apache-2.0
#include "bench/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <optional>

#include "corpus/grouped.h"
#include "corpus/progress_bar.h"

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
