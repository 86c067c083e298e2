// SPDX-License-Identifier: Apache-2.0
#include "reports/page/rungs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corpus/input_error.h"
#include "corpus/input_file.h"
#include "corpus/order_statistics.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

// ---- One row of a family: a method over an arithmetic, over all settings -----------------------

struct RungSum {
  std::string method, arithmetic;
  std::int64_t asked = 0, solved = 0, undecided = 0, other = 0, wrong = 0, silent = 0;
  std::vector<double> microseconds = {};
  double worst = 0;

  void Add(const RungLine& line) {
    asked += line.problems - line.refused;
    solved += line.solved;
    undecided += line.undecided;
    other += line.other;
    wrong += line.wrong;
    silent += line.silent;
    if (line.microseconds) microseconds.push_back(*line.microseconds);
    worst = std::max(worst, line.worst_residual.value_or(0));
  }
  // What is no right answer.
  double LostShare() const { return static_cast<double>(wrong + undecided) / static_cast<double>(asked); }
};

std::vector<RungSum> SumsOf(const std::vector<const RungLine*>& lines) {
  std::vector<RungSum> sums;
  for (const RungLine* line : lines) {
    auto sum = std::find_if(sums.begin(), sums.end(), [line](const RungSum& s) {
      return s.method == line->method && s.arithmetic == line->arithmetic;
    });
    if (sum == sums.end())
      sum = sums.insert(sums.end(), RungSum{.method = line->method, .arithmetic = line->arithmetic});
    sum->Add(*line);
  }
  return sums;
}

// ---- Tables --------------------------------------------------------------------------------------

Html FamilyTable(const std::string& family, const std::vector<RungSum>& sums) {
  Table table{
      "rungs",
      "Rungs on " + family,
      {{"method", "", kText},
       {"arithmetic", "", kText},
       {"microseconds", "median of the settings' medians"},
       {"problems", "that its numbers hold"},
       {"solved"},
       {"undecided"},
       {"other", "other ends: a loop, a ray, no direction"},
       {"wrong",
        "silently wrong, or, of the published algorithm, another end than over rationals; below: the share, "
        "with its interval at 95 %"},
       {"silent",
        "called solved within errors that it does not keep, or without a solution where there is one"},
       {"worst residual", "of what is called solved, over rationals"}},
      {},
      {},
      2};
  for (const RungSum& sum : sums) {
    table.Add({sum.method, sum.arithmetic,
               sum.microseconds.empty() ? TableCell() : QuartilesOf(sum.microseconds).median, sum.asked,
               sum.solved, sum.undecided, sum.other, ShareOf(sum.wrong, sum.asked), sum.silent,
               fmt::format("{:.0e}", sum.worst)});
  }
  return ToHtml(table);
}

// In the order of the file.
std::vector<std::pair<std::string, std::vector<RungSum>>> Families(const std::vector<RungLine>& lines) {
  std::vector<std::string> families;
  std::map<std::string, std::vector<const RungLine*>> by_family;
  for (const RungLine& line : lines) {
    if (by_family[line.family].empty()) families.push_back(line.family);
    by_family[line.family].push_back(&line);
  }
  std::vector<std::pair<std::string, std::vector<RungSum>>> sums;
  for (const std::string& family : families) sums.emplace_back(family, SumsOf(by_family[family]));
  return sums;
}

Html NotMeasured() {
  return Html(
      "<p>Not measured for this report: how fast each method is over each arithmetic, and how often it errs, "
      "on ordinary and on extreme problems. In the folder of the sources:</p>\n<pre><code>./run bench "
      "--suite trade --csv trade.csv\n./run bench --suite extremes --csv extremes.csv\n./run report "
      "STORE --bench trade.csv extremes.csv -o DIR</code></pre>\n");
}

}  // namespace

std::vector<RungLine> ReadRungs(const std::filesystem::path& file) {
  const CsvReader rows(ReadText(file), file.string(), "a file of bench --csv");
  std::vector<RungLine> lines;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto count = [&](const char* name) { return rows.Count(i, name); };
    RungLine line{rows.Text(i, "family"),
                  rows.Text(i, "method"),
                  rows.Text(i, "arithmetic"),
                  count("problems"),
                  count("solved"),
                  count("undecided"),
                  count("other"),
                  count("refused"),
                  count("wrong"),
                  count("silent"),
                  rows.Measure(i, "microseconds_median"),
                  rows.Measure(i, "worst_residual")};
    if (line.solved + line.undecided + line.other + line.refused != line.problems ||
        line.wrong > line.problems || line.silent > line.wrong || line.silent > line.solved + line.other)
      rows.Refuse(i, fmt::format("found counts that do not add up to {} problems", line.problems));
    lines.push_back(std::move(line));
  }
  if (lines.empty())
    throw InputError(fmt::format("{}: found no line, expected a file of bench --csv", file.string()));
  return lines;
}

Table RungsFigure(const std::vector<RungLine>& lines) {
  Table table{"rungs", "",
              Columns("family* method* arithmetic* microseconds lost asked solved wrong undecided")};
  for (const auto& [family, sums] : Families(lines)) {
    for (const RungSum& sum : sums) {
      if (sum.microseconds.empty() || sum.asked == 0) continue;
      table.Add({family, sum.method, sum.arithmetic, QuartilesOf(sum.microseconds).median, sum.LostShare(),
                 sum.asked, sum.solved, sum.wrong, sum.undecided});
    }
  }
  return table;
}

Html RungsSection(const std::vector<RungLine>& lines) {
  constexpr const char* kTitle = "Speed against accuracy";
  if (lines.empty()) return Section("rungs", kTitle, NotMeasured());
  Html tables;
  for (const auto& [family, sums] : Families(lines))
    tables += Tag("h3")(family) + Html("\n") + FamilyTable(family, sums);
  const Html figure = FigurePlace(
      "rungs",
      "Across: microseconds a problem, on a logarithmic scale. Up: the share that ends wrongly or undecided. "
      "A dot is a method over an arithmetic; filtered and exact ones are filled.",
      "stiction report --bench FILE -o DIR");
  return Section("rungs", kTitle, (RungsFigure(lines).rows.empty() ? Html() : figure) + tables);
}

}  // namespace stiction
