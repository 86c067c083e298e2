// SPDX-License-Identifier: Apache-2.0
// What pages say beside all that is counted: of findings, of an earlier report, of the campaign, of records and
// benchmarks.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "corpus/grouped.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "reports/page/page.h"
#include "reports/tables/campaign_tables.h"
#include "reports/told/facts.h"
#include "reports/told/report_txt.h"

namespace stiction {
namespace {

// ---- Findings ----

// A row for each kind, the gravest first, then loops; none without groups.
std::vector<Table> KindTable(const char* caption, const std::vector<Discovery>& discoveries, bool of_doubles) {
  using Counts = std::array<std::int64_t, 6>;
  std::map<std::string, Counts, LabelsByGravity> kinds;
  Counts all = {};
  for (const Discovery& d : discoveries) {
    if (IsOfDoubles(d.kind) != of_doubles) continue;
    const bool represented = d.representative != nullptr;
    const Counts counts = {1,
                           d.Finished(),
                           represented && !d.Finished(),
                           !represented,
                           d.EveryPolicyLoops(),
                           d.minimized && d.minimized->grid.AllLoop()};
    for (std::size_t i = 0; i < all.size(); ++i) {
      kinds[d.kind][i] += counts[i];
      all[i] += counts[i];
    }
  }
  if (kinds.empty()) return {};
  Table table = Described("kinds");
  table.caption = caption;
  for (const auto& [kind, c] : kinds) table.Add({kind, c[0], c[1], c[2], c[3], c[4], c[5]});
  table.Add({"all", all[0], all[1], all[2], all[3], all[4], all[5]});
  table.TotalIsLast();
  return {table};
}

// Of loops in the plane that are finished, how many loop under every policy.
void AddGrid(Facts& facts, const std::vector<Discovery>& discoveries) {
  auto& n = facts.numbers;
  for (const char* name : {"grid_loops", "grid_found", "grid_minimized", "grid_contacts"}) n[name] = 0;
  for (const Discovery& d : discoveries) {
    if (!d.IsLoop() || !d.Finished() || !d.SawPolicies()) continue;
    ++n["grid_loops"];
    n["grid_found"] += d.EveryPolicyLoops();
    n["grid_minimized"] += d.minimized && d.minimized->grid.AllLoop();
    const std::int64_t contacts = d.SmallestContacts(), least = n["grid_contacts"];
    n["grid_contacts"] = least == 0 ? contacts : std::min(least, contacts);
  }
  n["grid_whole"] = n["grid_found"] + n["grid_minimized"];
}

void AddIpopt(Facts& facts, const std::vector<Discovery>& discoveries) {
  auto& n = facts.numbers;
  for (const char* name : {"ipopt_asked", "ipopt_solved", "ipopt_starts", "ipopt_unavailable"}) n[name] = 0;
  for (const Discovery& discovery : discoveries) {
    if (!discovery.ipopt) continue;
    const auto& [outcome, starts] = *discovery.ipopt;
    ++n[outcome == "unavailable" ? "ipopt_unavailable" : "ipopt_asked"];
    if (outcome == "solved") ++n["ipopt_solved"], n["ipopt_starts"] += starts;
  }
}

void AddFindings(Facts& facts, const ReportContent& content) {
  const auto count = [&content](auto is) {
    return static_cast<std::int64_t>(std::ranges::count_if(content.discoveries, is));
  };
  const std::int64_t groups = std::ssize(content.discoveries);
  const std::int64_t represented = count([](const Discovery& d) { return d.representative != nullptr; });
  const Discovery* const simplest = SimplestLoop(content.discoveries);
  facts.numbers.insert({{"groups", groups},
                        {"grave_groups", count([](const Discovery& d) { return IsGrave(d.kind); })},
                        {"found_grid", count([](const Discovery& d) { return d.EveryPolicyLoops(); })},
                        {"represented", represented},
                        {"all_represented", represented == groups},
                        {"findings_shown", static_cast<std::int64_t>(kFindingsShown)},
                        {"many", represented > static_cast<std::int64_t>(kFindingsShown)},
                        {"plays", content.player ? 1 : 0}});
  facts.texts["simplest"] = simplest == nullptr ? "" : simplest->signature;
  facts.tables["kinds"] = [&content] {
    std::vector<Table> kinds = KindTable("Of the algorithm, in exact arithmetic", content.discoveries, false);
    for (Table& table :
         KindTable("Of doubles: where they differ from exact arithmetic", content.discoveries, true))
      kinds.push_back(std::move(table));
    return kinds;
  };
  facts.tables["methods"] = [&content] {
    return std::vector<Table>{MethodsTable(content.totals.record, content.discoveries)};
  };
  AddGrid(facts, content.discoveries);
  AddIpopt(facts, content.discoveries);
}

void AddSince(Facts& facts, const ReportContent& content) {
  facts.texts["since"] = content.since ? "yes" : "";
  if (!content.since) return;
  for (const char* change : {"new", "finished", "more", "gone"})
    facts.numbers[fmt::format("since_{}", change)] = 0;
  for (const Table::Row& row : SinceTable(*content.since, content.discoveries).rows)
    ++facts.numbers["since_" + Shown(row.cells[1])];
  facts.numbers["since_groups"] = std::ssize(content.since->earlier);
}

// ---- Campaign ----

void AddCampaign(Facts& facts, const ReportContent& content) {
  const CampaignIdentity& identity = content.identity;
  // An optimized search tallies no problems.
  const std::int64_t asked = content.Objective().empty() ? content.totals.problems : content.own.problems;
  Lines& list = facts.lists["campaign"] = {{"seed", std::to_string(identity.seed)}};
  for (const auto& [key, value] : PlainValues(ToldDefinition(identity), true)) {
    if (key == "format" || key == "version") continue;
    const auto label = content.labels.find(key);
    list.emplace_back(label == content.labels.end() ? key : label->second, value);
  }
  if (list.size() == 1) list.emplace_back("definition", PlainValue(ToldDefinition(identity), true));
  list.emplace_back("policies", PlainValue(JsonOrText(identity.policies), true, "; "));
  list.emplace_back("version of the algorithm", std::to_string(identity.algorithm));
  for (const std::string& build : content.totals.work.builds) list.emplace_back("searched by", build);
  list.insert(list.end(), {{"problems", Grouped(asked)},
                           {"units", Grouped(content.totals.units)},
                           {"complete blocks", fmt::format("{} of {} units each", Grouped(content.blocks),
                                                           Grouped(Store::kUnitsPerBlock))}});
  std::vector<std::string> bests;
  for (const OwnBest& best : content.own.bests)
    bests.push_back(fmt::format("{} ({}, {})", best.value, best.generator, Counted(best.contacts, "contact")));
  facts.texts["asked"] = std::to_string(asked);
  facts.texts["objective"] = content.Objective();
  facts.texts["best_values"] = fmt::format("{}", fmt::join(bests, "; "));
  facts.numbers["drawn"] = content.totals.units > 0 && content.Objective().empty();
}

}  // namespace

std::string ReportContent::Objective() const {
  for (const auto& [key, value] : PlainValues(JsonOrText(identity.definition)))
    if (key == "objective") return value;
  return "";
}

Told Tell(const ReportContent& content, const std::vector<std::string>& pages) {
  Facts facts = FactsOf(content.totals, content.identity);
  AddFindings(facts, content);
  AddSince(facts, content);
  AddCampaign(facts, content);
  AddFrontiers(facts, content.frontiers, content.own.bests);
  AddRungs(facts, content.rungs);
  for (const auto& file : content.benches) facts.texts["bench_files"] += " " + BenchName(file);
  std::vector<std::string> media;
  for (const std::string& page : pages) media.insert(media.end(), {page, page + "-lead", page + "-how"});
  return Tell(kReportTxt, facts, media);
}

std::vector<Table> Figures(const ReportContent& content) {
  std::vector<Table> all = CampaignFigures(content.totals.record, content.discoveries);
  all.push_back(FrontiersFigure(content.frontiers));
  all.push_back(RungsFigure(content.rungs));
  std::erase_if(all, [](const Table& figure) { return figure.rows.empty(); });
  return all;
}

}  // namespace stiction
