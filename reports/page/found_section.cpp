// SPDX-License-Identifier: Apache-2.0
// What was found, counted by kinds.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

// Discoveries of one kind, counted.
struct KindCounts {
  std::int64_t groups = 0, finished = 0, pending = 0, counted = 0, found_grid = 0, minimized_grid = 0;

  void Add(const Discovery& discovery) {
    ++groups;
    finished += discovery.Finished();
    pending += discovery.representative != nullptr && !discovery.Finished();
    counted += discovery.representative == nullptr;
    found_grid += discovery.EveryPolicyLoops();
    minimized_grid += discovery.minimized && discovery.minimized->grid.AllLoop();
  }
};

// By kind: the gravest, then loops first.
std::vector<std::pair<std::string, KindCounts>> CountByKind(const std::vector<Discovery>& discoveries) {
  std::map<std::string, KindCounts> counts;
  for (const Discovery& discovery : discoveries) counts[discovery.kind].Add(discovery);
  std::vector<std::pair<std::string, KindCounts>> sorted(counts.begin(), counts.end());
  const auto rank = [](const auto& row) { return std::pair(Gravity(row.first), !IsLoopKind(row.first)); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&rank](const auto& left, const auto& right) { return rank(left) < rank(right); });
  return sorted;
}

KindCounts CountGroups(const std::vector<Discovery>& discoveries) {
  KindCounts all;
  for (const Discovery& discovery : discoveries) all.Add(discovery);
  return all;
}

Html KindTable(const char* caption, const std::vector<Discovery>& discoveries) {
  if (discoveries.empty()) return {};
  Table table{
      "kinds",
      caption,
      {{"kind", "", kText},
       {"groups", "signatures: findings up to permuting contacts, reversing tangents and scaling"},
       {"finished", "representatives certified and minimized"},
       {"pending", "representatives that are not finished yet"},
       {"only counted", "groups without a representative"},
       {"whole grid, as found", "finished representatives that loop under every policy of the planar grid"},
       {"whole grid, minimized", "minimized problems that loop under every policy of the planar grid"}}};
  auto kinds = CountByKind(discoveries);
  kinds.emplace_back("all", CountGroups(discoveries));
  for (const auto& [kind, c] : kinds)
    table.Add({kind, c.groups, c.finished, c.pending, c.counted, c.found_grid, c.minimized_grid});
  table.TotalIsLast();
  return ToHtml(table);
}

Html KindNote() {
  return Html(
      "<p class=\"note\">A group is a signature: findings that are the same up to permuting contacts, "
      "reversing tangents and units; what is found under another policy than <code>paper</code> is a group "
      "of its own. The representative of a group is the first problem that shows it; finished means "
      "certified and minimized. Groups beyond the few new ones kept per unit are only counted, and "
      "represented when another unit meets them. Whole grid: a loop under every policy of the planar grid, "
      "all readings of the published text that stiction distinguishes there.</p>\n");
}

Html Tile(std::int64_t value, const std::string& meaning, const char* style = "") {
  const Html content = Tag("strong")(Grouped(value)) + Html(" ") + Tag("span")(meaning);
  return Tag("li", {{"class", style}})(content) + Html("\n");
}

Html Tiles(const ReportContent& content) {
  const KindCounts all = CountGroups(content.discoveries);
  const std::int64_t problems = ProblemsOf(content.total);
  const Counts counts = CountAll(content.total);
  const bool random = content.Objective().empty();
  Html tiles = random ? Tile(problems, "problems run") : Html();
  if (random && counts.runs != problems) tiles += Tile(counts.runs, "runs, each problem under every policy");
  if (random) tiles += Tile(counts.Loops(), "runs that loop, exactly", "loop");
  if (random) tiles += Tile(counts.doubles_differ, "runs in which doubles differ from exact arithmetic");
  tiles += Tile(all.groups, "groups of findings (signatures)");
  const auto grave = std::count_if(content.discoveries.begin(), content.discoveries.end(),
                                   [](const Discovery& discovery) { return IsGrave(discovery.kind); });
  tiles +=
      Tile(grave, "of these grave: cycles of safe problems, disagreements of methods", grave > 0 ? "loop" : "");
  tiles += Tile(all.finished, "representatives finished");
  tiles += Tile(all.pending, "representatives pending");
  tiles += Tile(all.found_grid, "of the finished loop under every policy, as found", "loop");
  return Tag("ul", {{"class", "tiles"}})(tiles) + Html("\n");
}

}  // namespace

Html BestSentence(const ReportContent& content) {
  if (content.Objective().empty()) return {};
  std::vector<std::string> bests;
  for (const OwnBest& best : content.own.bests)
    bests.push_back(fmt::format("{} ({}, {})", best.value, best.generator, Counted(best.contacts, "contact")));
  return Tag("p")(Html("What was sought: ") + Tag("code")(content.Objective()) +
                  Text(bests.empty() ? "." : fmt::format(". The best: {}.", fmt::join(bests, "; ")))) +
         Html("\n");
}

Html CountedSection(const ReportContent& content) {
  Html found = Tiles(content);
  if (content.discoveries.empty()) return Section("found", "What was found", found);
  std::vector<Discovery> algorithm = content.discoveries, doubles = content.discoveries;
  std::erase_if(algorithm, [](const Discovery& discovery) { return IsOfDoubles(discovery.kind); });
  std::erase_if(doubles, [](const Discovery& discovery) { return !IsOfDoubles(discovery.kind); });
  found += Html("<h3>Groups of findings</h3>\n") +
           KindTable("Of the algorithm, in exact arithmetic", algorithm) +
           KindTable("Of doubles: where they differ from exact arithmetic", doubles) + KindNote();
  return Section("found", "What was found", found);
}

}  // namespace stiction
