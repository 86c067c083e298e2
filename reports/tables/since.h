// SPDX-License-Identifier: Apache-2.0
// What is new since an earlier report, of which findings.csv is read.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "reports/tables/discovery.h"
#include "reports/tables/table.h"

namespace stiction {

struct Since {
  struct Line {
    std::string state;  // finished, pending, counted
    std::int64_t met = 0;
  };
  std::map<std::string, Line> earlier;  // by signature

  // "new", "finished" (and was not), "more" (met more often), or nothing.
  std::string_view ChangeOf(const Discovery& discovery) const;
};

// A report's folder, or its findings.csv. InputError that names file, line and column of what is not as a
// report writes it.
Since ReadSince(const std::filesystem::path& report);

// "finished", "pending", "counted"
std::string_view StateOf(const Discovery& discovery);

// A row for each signature that changed, or is gone: before and now.
Table SinceTable(const Since& since, const std::vector<Discovery>& discoveries);

}  // namespace stiction
