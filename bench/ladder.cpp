// SPDX-License-Identifier: Apache-2.0
// bench --suite trade, extremes: speed against accuracy, rung by rung; families with one dial each.

#include <fmt/format.h>

#include <fstream>
#include <iostream>

#include "bench/progress.h"
#include "bench/rungs.h"
#include "bench/sources.h"
#include "bench/suite.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

// ---- One line a source and row -------------------------------------------------------------------

constexpr int kTimedRuns = 3;

std::vector<RungTally> Measure(const Source& source, const std::vector<RungRow>& rows, std::int64_t problems,
                               std::uint64_t seed) {
  std::vector<RungTally> tallies(rows.size());
  for (std::int64_t index = 0; index < problems; ++index) {
    const RungProblem problem(source.make(seed, index));
    for (std::size_t i = 0; i < rows.size(); ++i)
      tallies[i].Count(rows[i], problem, rows[i].Run(problem, kTimedRuns), source.has_solution);
    progress::Done();
  }
  return tallies;
}

std::string CsvText(const Json& cell) {
  if (cell.is_null()) return "";
  return cell.is_string() ? cell.get<std::string>() : cell.dump();
}

// Arrays become columns: name_low, name_median, name_high of three, name_low, name_high of two.
void WriteCsv(const std::string& file, const Json& lines) {
  if (file.empty()) return;
  std::ofstream out(file);
  bool first = true;
  for (const Json& line : lines) {
    std::string head, text;
    const auto add = [&](const std::string& name, const Json& value) {
      head += (head.empty() ? "" : ",") + name;
      text += (text.empty() ? "" : ",") + CsvText(value);
    };
    for (const auto& [key, value] : line.items()) {
      const bool of_quartiles = key == "microseconds" || key == "residual", of_share = key.ends_with("_share");
      if (of_quartiles) {
        for (int k = 0; k < 3; ++k)
          add(key + std::array{"_low", "_median", "_high"}[k], value.is_null() ? Json(nullptr) : value[k]);
      } else if (of_share) {
        for (int k = 0; k < 2; ++k) add(key + std::array{"_low", "_high"}[k], value[k]);
      } else if (key == "decided_on") {
        for (int k = 0; k < kRungCount; ++k) add("decided_on_" + std::string(kRungNames[k]), value[k]);
      } else {
        add(key, value);
      }
    }
    if (std::exchange(first, false)) out << head << "\n";
    out << text << "\n";
  }
  if (!out.flush()) throw InputError(fmt::format("--csv: cannot write {}", file));
}

int RunLadder(const BenchOptions& o, const std::vector<Source>& sources, std::int64_t problems, bool remedies) {
  const std::vector<RungRow> rows = RungRows(remedies);
  Json lines = Json::array();
  if (!o.json)
    fmt::print("{:16} {:>7} {:9} {:19} {:>8} {:>9} {:>6} {:>6} {:>7} {:>12} {:>10}\n", "family", "setting",
               "method", "arithmetic", "solved", "undecided", "wrong", "silent", "refused", "microseconds",
               "residual");
  std::int64_t silent = 0;
  progress::Expect(sources.size());
  for (const Source& source : sources) {
    progress::Begin(fmt::format("{} at {}", source.family, source.setting), problems);
    const auto tallies = Measure(source, rows, problems, o.seed);
    progress::Clear();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const RungTally& tally = tallies[i];
      silent += tally.silent;
      Json line = {{"family", source.family},
                   {"setting", source.setting},
                   {"method", rows[i].method},
                   {"arithmetic", rows[i].Name()}};
      line.update(tally.ToJson());
      if (!o.json) {
        const Json& time = line["microseconds"];
        fmt::print("{:16} {:>7} {:9} {:19} {:>8} {:>9} {:>6} {:>6} {:>7} {:>12} {:>10}\n", source.family,
                   source.setting, rows[i].method, rows[i].Name(), tally.solved, tally.undecided, tally.wrong,
                   tally.silent, tally.refused,
                   time.is_null() ? "" : fmt::format("{:.1f}", time[1].get<double>()),
                   tally.residuals.empty() ? "" : fmt::format("{:.1e}", line["worst_residual"].get<double>()));
      }
      lines.push_back(std::move(line));
    }
    std::fflush(stdout);
  }
  WriteCsv(o.csv, lines);
  if (o.json) std::cout << JsonText(lines) << "\n";
  if (!o.json) fmt::print("silently wrong: {}\n", silent);
  return silent == 0 ? kExitDone : kExitNotSo;
}

}  // namespace

int BenchTrade(const BenchOptions& o) {
  const std::vector<int> sizes = o.contacts.empty() ? std::vector<int>{2, 4, 8} : o.contacts;
  return RunLadder(o, GeneratorSources(sizes), o.problems.value_or(60), true);
}

int BenchExtremes(const BenchOptions& o) {
  return RunLadder(o, DialSources(o.families), o.problems.value_or(25), true);
}

}  // namespace stiction
