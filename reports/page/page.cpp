// SPDX-License-Identifier: Apache-2.0
#include "reports/page/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "corpus/json.h"
#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "reports/findings_template.h"
#include "reports/html/packed.h"
#include "reports/html/template.h"
#include "reports/report_template.h"

namespace stiction {
namespace {

// ---- Campaign ----

std::string PlainText(const Json& json, const char* separator = ", ") {
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number_integer()) return Grouped(json.get<std::int64_t>());
  if (!json.is_array()) return JsonText(json);
  std::vector<std::string> parts;
  for (const Json& element : json) parts.push_back(PlainText(element));
  return fmt::format("{}", fmt::join(parts, separator));
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

void AddDefinition(Definitions& list, const ReportContent& content) {
  const Json json = ToldDefinition(content.identity);
  if (!json.is_object()) return list.Add("definition", PlainText(json));
  for (const auto& [key, value] : json.items()) {
    if (key == "format" || key == "version") continue;
    const auto label = content.labels.find(key);
    list.Add(label == content.labels.end() ? key : label->second, PlainText(value));
  }
}

// ---- The documents ----

constexpr char kHowOptimized[] =
    "<p><strong>Method.</strong> Candidates come from a seed and from the best of earlier units, are judged in "
    "doubles, and those that would be the best again in exact arithmetic. Loops that are met on the way are "
    "certified and made smaller.</p>";

constexpr char kHow[] =
    "<p><strong>Method.</strong> Problems are drawn from a seed. Each is run in doubles; what does not end in "
    "a solution, or in\none that is none, is <em>suspicious</em>, and is decided again in exact arithmetic, as "
    "is a sample of the others, the\n<em>audited</em> ones. Only what exact arithmetic says counts as a "
    "failure of the algorithm. What it fails on is given to\ncomplete driving, and on a share to Lemke’s "
    "method; solutions are verified exactly. The first problem of a kind is certified\nand made smaller, and "
    "says the same at every step of that.</p>";

}  // namespace

Html FilesSection() {
  Html list;
  for (const auto& [file, meaning] : std::initializer_list<std::pair<const char*, const char*>>{
           {"index.html", "what was found"},
           {"results.html", "all tables and figures"},
           {"findings.html", "all findings, each in numbers"},
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
  list += Html("<li><code>replay.html</code>: the simplest loop, step by step, where there is one</li>\n");
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

std::string ReportContent::Objective() const {
  const Json definition = JsonOrText(identity.definition);
  return definition.is_object() ? definition.value("objective", "") : "";
}

Html Section(const std::string& id, const std::string& title, const Html& content) {
  return Tag("section", {{"id", id}})(Html("\n") + Tag("h2")(title) + Html("\n") + content) + Html("\n");
}

// An optimized search tallies none.
std::int64_t AskedProblems(const ReportContent& content) {
  return content.Objective().empty() ? ProblemsOf(content.total) : content.own.problems;
}

// From the folder of the report.
Html AgainCommands(const ReportContent& content) {
  const std::string search =
      fmt::format("stiction search campaign.json --seed {} --problems {} --store again.store",
                  content.identity.seed, AskedProblems(content));
  return Tag("pre")(Tag("code")("stiction() { /path/to/stiction/run \"$@\"; }\n" + search +
                                "\nstiction report again.store -o again"));
}

Html AgainSection(const ReportContent& content) {
  Definitions list;
  list.Add("seed", std::to_string(content.identity.seed));
  AddDefinition(list, content);
  list.Add("policies", PlainText(JsonOrText(content.identity.policies), "; "));
  list.Add("version of the algorithm", std::to_string(content.identity.algorithm));
  for (const std::string& build : content.work.builds) list.Add("searched by", build);
  list.Add("problems", Grouped(AskedProblems(content)));
  list.Add("units", Grouped(content.units));
  list.Add("complete blocks",
           fmt::format("{} of {} units each", Grouped(content.blocks), Grouped(Store::kUnitsPerBlock)));
  const Html commands = content.units > 0
                            ? Html(
                                  "<p>In the folder of this page. The same campaign, with the same build, "
                                  "gives the same problems, "
                                  "outcomes and findings on any machine and any number of threads.</p>\n") +
                                  AgainCommands(content)
                            : Html();
  return Section("again", "Reproducing it",
                 commands + Html("<details class=\"folded\"><summary>The campaign in full</summary>\n") +
                     list.Done() +
                     Html("<p class=\"note\">Machines and processor times, which another run of the same "
                          "campaign need not repeat, stand in <a href=\"work.csv\"><code>work.csv</code></a> "
                          "alone.</p></details>\n"));
}

Html MethodText(const ReportContent& content) {
  return content.Objective().empty() ? Html(kHow) : Html(kHowOptimized);
}

bool HasFrontiers(const ReportContent& content) {
  return !content.frontiers.empty() || !content.own.bests.empty();
}

std::vector<std::pair<std::string, std::string>> PlacesOfResults(const ReportContent& content) {
  std::vector<std::pair<std::string, std::string>> places = {{"#found", "What was found"}};
  if (content.units > 0 && content.Objective().empty()) {
    places.insert(places.end(), {{"#frequencies", "How often it fails"},
                                 {"#outcomes", "Outcomes"},
                                 {"#doubles", "How often doubles lie"},
                                 {"#steps", "Steps"},
                                 {"#methods", "Methods side by side"},
                                 {"#existence", "Existence and agreement"}});
  }
  if (HasFrontiers(content)) places.emplace_back("#frontiers", "Frontiers");
  places.insert(places.end(), {{"#rungs", "Speed against accuracy"}, {"#files", "Files"}});
  return places;
}

Html LinksTo(const std::vector<std::pair<std::string, std::string>>& places) {
  Html links;
  for (const auto& [place, title] : places) links += Tag("a", {{"href", place}})(title) + Html("\n");
  return links;
}

std::string FilledPage(const std::vector<Table>& figures, const PageParts& parts) {
  const std::string page(std::begin(kReportTemplate), std::end(kReportTemplate));
  const Json data = {{"figures", FiguresToJson(figures, parts.found + parts.more)},
                     {"findings", parts.findings},
                     {"player", parts.player}};
  return FilledTemplate(page, {{"title", Text(parts.title)},
                               {"heading", Text(parts.heading)},
                               {"lead", parts.lead},
                               {"how", parts.how},
                               {"navigation", parts.navigation},
                               {"found", parts.found},
                               {"more", parts.more},
                               {"data", ScriptData(JsonText(data))}});
}

std::string ResultsPage(const ReportContent& content, const std::vector<Table>& figures) {
  Html results = CountedSection(content);
  if (content.units > 0 && content.Objective().empty()) {
    results += FrequenciesSection(content.total) + OutcomesSection(content.total) +
               DoublesSection(content.total) + StepsSection(content.total) + MethodsSection(content) +
               ExistenceSection(content.total);
  }
  results +=
      FrontiersSection(content.frontiers, content.own.bests) + RungsSection(content.rungs) + FilesSection();
  return FilledPage(figures, {.title = "stiction: all results of a report",
                              .heading = "All results",
                              .lead = Html("<p class=\"asked\">Every table and figure of <a "
                                           "href=\"index.html\">the report</a>. Findings one by one "
                                           "have <a href=\"findings.html\">a page of their own</a>.</p>"),
                              .navigation = LinksTo(PlacesOfResults(content)),
                              .found = results,
                              .how = MethodText(content)});
}

// The values of each field that findings are filtered by.
Json ChoicesAmong(const Json& findings) {
  Json choices = Json::object();
  for (const char* field : {"kind", "smallest", "generator", "policy", "state", "change"}) {
    std::set<std::string> values;
    for (const Json& finding : findings) {
      if (const auto value = finding.find(field); value != finding.end()) values.insert(PlainText(*value));
    }
    values.erase("");
    if (!values.empty()) choices[field] = values;
  }
  return choices;
}

std::string FindingsPage(const ReportContent& content) {
  const std::string page(std::begin(kFindingsTemplate), std::end(kFindingsTemplate));
  const Json findings = FindingsToJson(content.discoveries, content.since);
  const auto text = [](const Json& json) { return JsonText(json); };
  std::string lines;
  for (const Json& finding : findings) lines += text(finding) + "\n";
  const Json data = {{"choices", ChoicesAmong(findings)},
                     {"count", findings.size()},
                     {"findings", FindingsToJson(content.discoveries, content.since, kFindingsShown)},
                     {"plays", content.player.is_null() ? Json(0) : content.player["problem"]["dimension"]}};
  return FilledTemplate(page, {{"found", FindingsSection(content.discoveries, content.since)},
                               {"data", ScriptData(text(data))},
                               {"lines", Text(Packed(lines))}});
}

}  // namespace stiction
