// SPDX-License-Identifier: Apache-2.0
#include "reports/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "corpus/json_text.h"
#include "corpus/kinds.h"
#include "reports/report_template.h"
#include "reports/template.h"

namespace stiction {
namespace {

// ---- What was found ----

// Discoveries of one kind, counted.
struct KindCounts {
  std::int64_t met = 0, groups = 0, finished = 0, pending = 0, counted = 0, found_grid = 0, minimized_grid = 0;

  void Add(const Discovery& discovery) {
    met += discovery.met;
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

KindCounts CountAll(const std::vector<Discovery>& discoveries) {
  KindCounts all;
  for (const Discovery& discovery : discoveries) all.Add(discovery);
  return all;
}

std::vector<HtmlCell> KindRow(const std::string& kind, const KindCounts& c) {
  std::vector<HtmlCell> cells = {{Text(kind)}};
  for (const std::int64_t count :
       {c.met, c.groups, c.finished, c.pending, c.counted, c.found_grid, c.minimized_grid}) {
    cells.push_back({Text(Grouped(count)), count == 0 ? "zero" : ""});
  }
  return cells;
}

Html KindTable(const std::vector<Discovery>& discoveries) {
  Table table(
      "Findings by kind",
      {{"kind", "", false},
       {"runs", "runs in which it was met"},
       {"groups", "signatures: findings up to permuting contacts, reversing tangents and scaling"},
       {"finished", "representatives certified and minimized"},
       {"pending", "representatives that are not finished yet"},
       {"only counted", "groups without a representative"},
       {"whole grid, as found", "finished representatives that loop under every policy of the planar grid"},
       {"whole grid, minimized", "minimized problems that loop under every policy of the planar grid"}});
  for (const auto& [kind, counts] : CountByKind(discoveries)) table.AddRow(KindRow(kind, counts));
  table.AddRow(KindRow("all", CountAll(discoveries)), 1, "total");
  return table.Done();
}

Html KindNote() {
  return Html(
      "<p class=\"note\">A group is a signature: findings that are the same up to permuting contacts, "
      "reversing tangents and units; what is found under another policy than <code>paper</code> is a group "
      "of its own. The representative of a group is the first problem that shows it; finished means "
      "certified and minimized. Groups beyond the few new ones kept per unit are only counted, and "
      "represented when another unit meets them. Whole grid: a loop under every policy of the planar grid, all "
      "readings of the published text that stiction distinguishes there.</p>\n");
}

Html Tile(std::int64_t value, const std::string& meaning, const char* style = "") {
  const Html content = Tag("strong")(Grouped(value)) + Html(" ") + Tag("span")(meaning);
  return Tag("li", {{"class", style}})(content) + Html("\n");
}

Html Tiles(const ReportContent& content) {
  const KindCounts all = CountAll(content.discoveries);
  const std::int64_t problems = ProblemsOf(content.total);
  const std::int64_t runs = RunsOf(content.total);
  Html tiles = Tile(problems, "problems run");
  if (runs != problems) tiles += Tile(runs, "runs, each problem under every policy");
  tiles += Tile(all.met, "runs with a finding");
  tiles += Tile(all.groups, "groups of findings (signatures)", "loop");
  const auto grave = std::count_if(content.discoveries.begin(), content.discoveries.end(),
                                   [](const Discovery& discovery) { return IsGrave(discovery.kind); });
  tiles +=
      Tile(grave, "of these grave: cycles of safe problems, disagreements of methods", grave > 0 ? "loop" : "");
  tiles += Tile(all.finished, "representatives finished");
  tiles += Tile(all.pending, "representatives pending");
  tiles += Tile(all.found_grid, "of the finished loop under every policy, as found", "loop");
  return Tag("ul", {{"class", "tiles"}})(tiles) + Html("\n");
}

Html Featured(const std::vector<Discovery>& discoveries) {
  const Discovery* simplest = SimplestLoop(discoveries);
  if (simplest == nullptr) return {};
  const Html title = Tag("h3")(Html("The simplest loop: ") + Tag("code")(simplest->signature));
  return Tag("div", {{"class", "featured"}})(title + FindingDetails(*simplest)) + Html("\n");
}

// ---- Campaign ----

std::string PlainText(const Json& json, const char* separator = ", ") {
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number_integer()) return Grouped(json.get<std::int64_t>());
  if (!json.is_array()) return JsonText(json);
  std::vector<std::string> parts;
  for (const Json& element : json) parts.push_back(PlainText(element));
  return fmt::format("{}", fmt::join(parts, separator));
}

std::string CampaignLabel(const std::string& key) {
  static const std::map<std::string, std::string> labels = {
      {"contacts", "numbers of contacts"},
      {"mu", "friction palette"},
      {"unit_problems", "problems of a unit"},
      {"audit_every", "audited: one problem in"},
      {"lemke_every", "by Lemke’s method too, of the suspicions: one in"},
      {"enumerate_every", "all modes tried, of exact runs of few contacts: one in"},
      {"representatives_per_unit", "new representatives per unit, at most"},
      {"max_drives", "budget, drives"},
      {"max_pivots", "budget, pivots"},
      {"max_bits", "budget, bits of a number"}};
  const auto label = labels.find(key);
  return label == labels.end() ? key : label->second;
}

// A text that is JSON by intention; as it is if it is not.
Json Lenient(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json(text) : json;
}

class Definitions {
 public:
  void Add(const std::string& term, const std::string& text) {
    rows_ += Tag("dt")(term) + Tag("dd")(text) + Html("\n");
  }
  Html Done() const { return Tag("dl")(rows_); }

 private:
  Html rows_;
};

void AddDefinition(Definitions& list, const std::string& definition) {
  const Json json = Lenient(definition);
  if (!json.is_object()) return list.Add("definition", PlainText(json));
  for (const auto& [key, value] : json.items()) {
    if (key == "format" || key == "version") continue;
    list.Add(CampaignLabel(key), PlainText(value));
  }
}

// ---- The document ----

constexpr const char* kTitle = "stiction: does Baraff's contact force algorithm always end?";

Html Navigation(const ReportContent& content) {
  std::vector<std::pair<const char*, const char*>> sections = {{"#found", "Found"},
                                                               {"#method", "Method and definitions"}};
  if (content.units > 0) {
    sections.insert(sections.end(), {{"#frequencies", "How often it fails"},
                                     {"#outcomes", "Outcomes"},
                                     {"#doubles", "How often doubles lie"},
                                     {"#steps", "Steps"},
                                     {"#methods", "Methods side by side"},
                                     {"#existence", "Existence and agreement"},
                                     {"#findings", "Findings"}});
  }
  if (!content.frontiers.empty()) sections.emplace_back("#frontiers", "Frontiers");
  sections.insert(sections.end(),
                  {{"#rungs", "Speed against accuracy"}, {"#again", "Reproducing it"}, {"#files", "Files"}});
  Html links;
  for (const auto& [id, title] : sections) links += Tag("a", {{"href", id}})(title) + Html("\n");
  return links;
}

Html FilesSection() {
  Html list;
  for (const auto& [file, meaning] : std::initializer_list<std::pair<const char*, const char*>>{
           {"statistics.csv", "all counters, sums and maxima per generator, contacts and policy"},
           {"verdicts.csv", "runs repeated exactly on suspicion: what doubles said, what is exact"},
           {"strata.csv", "outcomes of doubles and of exact runs by friction coefficient and rank"},
           {"steps.csv", "histograms of steps per problem"},
           {"loops.csv", "loops by number of contacts: drives, steps and zero steps of their periods"},
           {"zero_steps.csv", "histograms of zero steps per period"},
           {"agreement.csv", "existence, agreement of methods and safe problems per number of contacts"},
           {"solutions.csv", "histograms of solutions per number of contacts"},
           {"findings.csv", "every signature, with its counts, facts and files"},
           {"figures/", "the numbers that each figure draws"},
           {"campaign.json", "what was searched, as stiction search reads it"},
           {"SHA256SUMS", "the SHA-256 of every file of this folder, for sha256sum --check"}}) {
    const Html name = Tag("code")(file);
    const Html linked = std::string_view(file).ends_with("/") ? name : Tag("a", {{"href", file}})(name);
    list += Tag("li")(linked + Html(": ") + Text(meaning)) + Html("\n");
  }
  list +=
      Tag("li")(Html(
          "<code>findings/</code>: of every representative the minimized problem (or, until there "
          "is one, the problem as found), the problem as found (<code>.original.json</code>), "
          "its certificate (<code>.certificate.json</code>), its scene if it has one (<code>.svg</code>), and "
          "the certificates that both have a solution "
          "(<code>.existence.certificate.json</code>, <code>.original.existence.certificate.json</code>)")) +
      Html("\n");
  return Section("files", "Files beside this page", Tag("ul")(list));
}

// All but what was found.
Html Results(const ReportContent& content) {
  const Html end = FrontiersSection(content.frontiers) + RungsSection(content.rungs) + AgainSection(content) +
                   FilesSection();
  if (content.units == 0) return end;
  return FrequenciesSection(content.total) + OutcomesSection(content.total) + DoublesSection(content.total) +
         StepsSection(content.total) + MethodsSection(content) + ExistenceSection(content.total) +
         FindingsSection(content.discoveries, content.since) + end;
}

Json PageData(const ReportContent& content, const std::vector<FigureTable>& figures) {
  return {{"figures", FiguresToJson(figures)},
          {"findings", FindingsToJson(content.discoveries, content.since)}};
}

}  // namespace

// Every policy runs the same problems.
std::int64_t ProblemsOf(const Record& total) {
  std::map<std::pair<std::string, int>, std::int64_t> problems;
  for (const auto& [key, tally] : total.tallies) {
    std::int64_t& most = problems[{key.generator, key.contacts}];
    most = std::max(most, tally.problems);
  }
  std::int64_t sum = 0;
  for (const auto& [key, count] : problems) sum += count;
  return sum;
}

std::int64_t RunsOf(const Record& total) {
  std::int64_t runs = 0;
  for (const auto& [key, tally] : total.tallies) runs += tally.problems;
  return runs;
}

Html Section(const std::string& id, const std::string& title, const Html& content) {
  return Tag("section", {{"id", id}})(Html("\n") + Tag("h2")(title) + Html("\n") + content) + Html("\n");
}

Html FoundSection(const ReportContent& content) {
  if (content.units == 0) {
    return Section("found", "What was found",
                   Html("<p>The store holds no units: nothing has been searched yet.</p>\n"));
  }
  Html found = FoundSentences(content) + Tiles(content);
  if (content.since) found += SinceText(*content.since, content.discoveries);
  if (content.discoveries.empty()) {
    found +=
        Html("<p>No findings: every run ended in a solution, or exact arithmetic said that it does.</p>\n");
  } else {
    found += Featured(content.discoveries) + Html("<h3>By kind</h3>\n") + KindTable(content.discoveries) +
             KindNote();
  }
  return Section("found", "What was found", found);
}

// Of another run of the same campaign all of this may be different.
Html TimeTable(const ProcessorTime& time) {
  if (time.Total() == 0) return {};
  Table table("Processor time", {{"spent on", "", false}, {"seconds", ""}, {"share", ""}});
  ForEachPart(time, [&](const char* name, const char* meaning, std::int64_t value) {
    const double share = 100 * static_cast<double>(value) / static_cast<double>(time.Total());
    table.AddRow({{Text(fmt::format("{}: {}", name, meaning))},
                  {Text(fmt::format("{:.1f}", static_cast<double>(value) * 1e-6))},
                  {Text(fmt::format("{:.1f} %", share))}});
  });
  return table.Done();
}

// From the folder of the report.
Html AgainCommands(const ReportContent& content) {
  const std::string search =
      fmt::format("stiction search campaign.json --seed {} --problems {} --store again.store",
                  content.identity.seed, ProblemsOf(content.total));
  return Tag("pre")(Tag("code")(search + "\nstiction report again.store -o again"));
}

Html AgainSection(const ReportContent& content) {
  Definitions list;
  list.Add("seed", std::to_string(content.identity.seed));
  AddDefinition(list, content.identity.definition);
  list.Add("policies", PlainText(Lenient(content.identity.policies), "; "));
  list.Add("version of the algorithm", std::to_string(content.identity.algorithm));
  for (const std::string& build : content.work.builds) list.Add("searched by", build);
  for (const std::string& machine : content.work.machines) list.Add("on", machine);
  if (content.units > 0 && content.work.machines.empty())
    list.Add("on", "machines that the store does not name");
  list.Add("problems", Grouped(ProblemsOf(content.total)));
  list.Add("units", Grouped(content.units));
  list.Add("complete blocks",
           fmt::format("{} of {} units each", Grouped(content.blocks), Grouped(Store::kUnitsPerBlock)));
  const Html commands =
      content.units > 0
          ? Html(
                "<p>The same campaign, with the same build, gives the same problems, outcomes and findings "
                "on any machine and any number of threads:</p>\n") +
                AgainCommands(content)
          : Html();
  return Section("again", "Reproducing it",
                 commands + list.Done() +
                     Html("<p class=\"note\">Nothing here depends on the machines but the processor time, "
                          "which other runs of the same campaign need not repeat.</p>\n") +
                     TimeTable(content.work.time));
}

std::string Page(const ReportContent& content, const std::vector<FigureTable>& figures) {
  const std::string page(std::begin(kReportTemplate), std::end(kReportTemplate));
  return FilledTemplate(
      page,
      {{"title", Text(kTitle)},
       {"navigation", Navigation(content)},
       {"found", FoundSection(content)},
       {"results", Results(content)},
       {"data", ScriptData(PageData(content, figures).dump(-1, ' ', false, Json::error_handler_t::replace))}});
}

}  // namespace stiction
