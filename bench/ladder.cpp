// SPDX-License-Identifier: Apache-2.0
// bench --suite trade, extremes, silent: speed against accuracy, rung by rung; families with one dial each.

#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <map>

#include "bench/dials.h"
#include "bench/rungs.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "search/generators.ipp"

namespace stiction {
namespace {

// Where problems come from: a generator at a size, or a dial at a setting.
struct Source {
  std::string family;
  int setting = 0;
  bool has_solution = true;
  std::function<ExactProblem(std::uint64_t seed, std::int64_t index)> make;
};

Source GeneratorSource(const GeneratorRow& row, int contacts) {
  return {std::string(row.name), contacts, true, [id = row.id, contacts](std::uint64_t seed, std::int64_t index) {
            Choices choices(ProblemSeed(seed, 100 + contacts, index));
            ExactProblem problem;
            Generate<Rational, Eigen::Dynamic>(id, contacts, kDefaultPalette, choices, problem);
            return problem;
          }};
}

std::vector<Source> GeneratorSources(const std::vector<int>& sizes) {
  std::vector<Source> sources;
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;
    for (const int contacts : sizes) sources.push_back(GeneratorSource(row, contacts));
  }
  return sources;
}

std::vector<Source> DialSources(const std::vector<std::string>& families) {
  std::vector<Source> sources;
  for (const std::string& name : families) {
    if (FindDial(name) == nullptr) {
      std::string names;
      for (const Dial& dial : Dials()) names += (names.empty() ? "" : ", ") + dial.name;
      throw InputError(fmt::format("--families: found '{}', expected one of {}", name, names));
    }
  }
  for (const Dial& dial : Dials()) {
    const bool asked = families.empty() || std::find(families.begin(), families.end(), dial.name) != families.end();
    if (!asked) continue;
    for (const int setting : dial.settings)
      sources.push_back({dial.name, setting, dial.has_solution, [&dial, setting](std::uint64_t seed, std::int64_t index) {
                           return MakeDialProblem(dial, setting, seed, index);
                         }});
  }
  return sources;
}

// ---- One line a source and row -------------------------------------------------------------------

std::vector<RungTally> Measure(const Source& source, const std::vector<RungRow>& rows, std::int64_t problems,
                               std::uint64_t seed) {
  std::vector<RungTally> tallies(rows.size());
  for (std::int64_t index = 0; index < problems; ++index) {
    const RungProblem problem(source.make(seed, index));
    for (std::size_t i = 0; i < rows.size(); ++i)
      tallies[i].Count(rows[i], problem, rows[i].Run(problem), source.has_solution);
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
    fmt::print("{:16} {:>7} {:9} {:19} {:>8} {:>9} {:>6} {:>6} {:>7} {:>12} {:>10}\n", "family", "setting", "method",
               "arithmetic", "solved", "undecided", "wrong", "silent", "refused", "microseconds", "residual");
  std::int64_t silent = 0;
  for (const Source& source : sources) {
    const auto tallies = Measure(source, rows, problems, o.seed);
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
        fmt::print("{:16} {:>7} {:9} {:19} {:>8} {:>9} {:>6} {:>6} {:>7} {:>12} {:>10}\n", source.family, source.setting,
                   rows[i].method, rows[i].Name(), tally.solved, tally.undecided, tally.wrong, tally.silent,
                   tally.refused, time.is_null() ? "" : fmt::format("{:.1f}", time[1].get<double>()),
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

int BenchExtremes(const BenchOptions& o) { return RunLadder(o, DialSources(o.families), o.problems.value_or(25), true); }

int BenchSilent(const BenchOptions& o) {
  std::vector<Source> sources = DialSources(o.families);
  if (o.families.empty()) {
    for (Source& source : GeneratorSources({1, 2, 3, 4})) sources.push_back(std::move(source));
  }
  const std::int64_t problems = o.problems.value_or(20000);
  const std::vector<RungRow> rows = RungRows(false);
  std::map<std::string, RungTally> tallies;  // by method and rung
  std::vector<std::string> examples;
  for (std::int64_t index = 0; index < problems; ++index) {
    const Source& source = sources[static_cast<std::size_t>(index) % sources.size()];
    const RungProblem problem(source.make(o.seed, index));
    for (const RungRow& row : rows) {
      RungTally& tally = tallies[row.method + " " + row.Name()];
      if (tally.Count(row, problem, row.Run(problem), source.has_solution) && examples.size() < 20)
        examples.push_back(fmt::format("{} at {}, problem {}: {} over {}", source.family, source.setting, index, row.method, row.Name()));
      tally.seconds.clear();
      tally.residuals.clear();
    }
  }
  BenchTable table{"silent", fmt::format("{} problems, seed {}, of {} sources", problems, o.seed, sources.size()), Json::array()};
  std::int64_t silent = 0;
  for (const auto& [name, tally] : tallies) {
    silent += tally.silent;
    const std::int64_t asked = tally.problems - tally.refused;
    table.rows.push_back({{"row", name},
                          {"problems", asked},
                          {"solved", tally.solved},
                          {"undecided", tally.undecided},
                          {"other", tally.other},
                          {"silent", tally.silent},
                          {"at most in a million", CountInterval(tally.silent).high / static_cast<double>(std::max<std::int64_t>(asked, 1)) * 1e6}});
  }
  if (o.json) {
    std::cout << JsonText({{"rows", table.rows}, {"examples", examples}}) << "\n";
  } else {
    Print(table);
    for (const std::string& example : examples) fmt::print("{}\n", example);
    fmt::print("silently wrong: {}\n", silent);
  }
  return silent == 0 ? kExitDone : kExitNotSo;
}

}  // namespace stiction
