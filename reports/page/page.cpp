// SPDX-License-Identifier: Apache-2.0
#include "reports/page/page.h"

#include <fmt/format.h>

#include <iterator>
#include <set>

#include "corpus/grouped.h"
#include "corpus/json.h"
#include "reports/findings_template.h"
#include "reports/html/html.h"
#include "reports/html/packed.h"
#include "reports/page/sections.h"
#include "reports/report_template.h"

namespace stiction {
namespace {

// ---- What the first page alone shows ----

// Named by their signatures; the script of the page says what happens, and links what plays.
Html NamedFindings(const std::vector<Discovery>& discoveries) {
  Html list;
  std::size_t named = 0;
  for (const Discovery* discovery : ByInterest(discoveries)) {
    if (named++ == kFindingsNamed) break;
    list +=
        Tag("li")(Tag("span", {{"class", "name"}, {"data-signature", discovery->signature}})(
                      Tag("code")(discovery->signature)) +
                  Html(" ") +
                  Tag("small")(fmt::format("{}, met {}", discovery->kind, Counted(discovery->met, "time")))) +
        Html("\n");
  }
  return Tag("ol", {{"class", "named"}})(Html("\n") + list) + Html("\n");
}

Html Featured(const std::vector<Discovery>& discoveries) {
  const Discovery* simplest = SimplestLoop(discoveries);
  if (simplest == nullptr) return {};
  const Html title =
      Tag("h3", {{"class", "name"}, {"data-signature", simplest->signature}})(Tag("code")(simplest->signature));
  return Tag("div", {{"class", "featured"}})(
             title +
             Html("\n<div id=\"play\"></div>\n<details class=\"folded\"><summary>A, b, mu, commands and "
                  "files</summary>\n") +
             FindingDetails(*simplest) + Html("</details>\n")) +
         Html("\n");
}

// The values of each field that findings are filtered by.
Json ChoicesAmong(const Json& findings) {
  Json choices = Json::object();
  for (const char* field : {"kind", "smallest", "generator", "policy", "state", "change"}) {
    std::set<std::string> values;
    for (const Json& finding : findings) {
      if (const auto value = finding.find(field); value != finding.end())
        values.insert(value->is_string() ? value->get<std::string>() : JsonText(*value));
    }
    values.erase("");
    if (!values.empty()) choices[field] = values;
  }
  return choices;
}

// Title and heading.
const std::map<std::string, std::pair<const char*, const char*>> kHeadings = {
    {"index",
     {"stiction: does Baraff's contact force algorithm always end?",
      "Does Baraff’s contact force algorithm always end?"}},
    {"results", {"stiction: all results of a report", "All results"}},
    {"measured", {"stiction: speed against accuracy", "Speed against accuracy of friction solvers"}}};

}  // namespace

std::string Page(const std::string& name, const ReportContent& content, const Told& told,
                 const std::vector<Table>& figures) {
  const bool first = name == "index";
  const Html results = Tag("a", {{"href", "results.html"}})("All results");
  Html links = LinksTo(told, name), files;
  if (first) links += results + Html("\n");
  if (first && !content.discoveries.empty()) links += Html("<a href=\"findings.html\">Findings</a>\n");
  std::vector<std::string> beside;
  for (const auto& file : content.benches) beside.push_back(BenchName(file));
  for (const Table& figure : figures) beside.push_back("figures/" + figure.name + ".csv");
  if (!content.frontiers.empty()) beside.emplace_back("frontiers.csv");
  for (const std::string& file : beside)
    files += Tag("li")(Tag("a", {{"href", file}})(Tag("code")(file))) + Html("\n");
  Places places = {{"measured_files", Tag("ul")(Html("\n") + files) + Html("\n")}};
  if (first) {
    places["featured"] = Featured(content.discoveries);
    places["named"] = NamedFindings(content.discoveries);
    places["places"] =
        Tag("p", {{"class", "places"}})(results + Html(":\n") + LinksTo(told, "results", "results.html")) +
        Html("\n");
  }
  const Json data = {
      {"figures", FiguresToJson(figures, told, name)},
      {"findings", first ? FindingsToJson(content.discoveries, content.since, kFindingsNamed) : Json::array()},
      {"player", first ? *content.player : Json()}};
  const std::string page(std::begin(kReportTemplate), std::end(kReportTemplate));
  return FilledTemplate(page, {{"title", Text(kHeadings.at(name).first)},
                               {"heading", Text(kHeadings.at(name).second)},
                               {"lead", PartsToHtml(told, name + "-lead")},
                               {"how", PartsToHtml(told, name + "-how")},
                               {"navigation", links},
                               {"found", SectionsToHtml(told, name, places)},
                               {"data", ScriptData(JsonText(data))}});
}

std::string FindingsPage(const ReportContent& content, const Told& told) {
  const std::string page(std::begin(kFindingsTemplate), std::end(kFindingsTemplate));
  const Json findings = FindingsToJson(content.discoveries, content.since);
  const auto text = [](const Json& json) { return JsonText(json); };
  std::string lines;
  for (const Json& finding : findings) lines += text(finding) + "\n";
  const Json data = {{"choices", ChoicesAmong(findings)},
                     {"count", findings.size()},
                     {"findings", FindingsToJson(content.discoveries, content.since, kFindingsShown)},
                     {"plays", content.player ? content.player->at("problem").at("dimension") : Json(0)}};
  const Html gallery = Html("<div id=\"gallery\"></div>\n") + FindingsRows(content.discoveries, content.since);
  return FilledTemplate(page, {{"found", SectionsToHtml(told, "findings", {{"gallery", gallery}})},
                               {"data", ScriptData(text(data))},
                               {"lines", Text(Packed(lines))}});
}

}  // namespace stiction
