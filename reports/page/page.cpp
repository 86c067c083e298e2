// SPDX-License-Identifier: Apache-2.0
#include "reports/page/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "corpus/json_text.h"
#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
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

// ---- The document ----

constexpr char kLead[] =
    "<p>A search of random friction problems for inputs on which the pivoting algorithm of D. Baraff,\n"
    "<cite>Fast Contact Force Computation for Nonpenetrating Rigid Bodies</cite> (SIGGRAPH 1994), run as "
    "published, repeats a\nstate and so never ends. Every finding was run again in exact rational arithmetic, "
    "in space over intervals, which prove\nwhat they decide; a finished loop comes with a problem made as "
    "small as it gets and, in the plane, with a certificate that\nan independent checker verifies.</p>";

constexpr char kOptimizedLead[] =
    "<p>An optimized search: problems are not drawn, but made worse step by step, as an objective counts what "
    "is worse for the pivoting algorithm of D. Baraff, <cite>Fast Contact Force Computation for Nonpenetrating "
    "Rigid Bodies</cite> (SIGGRAPH 1994). Of such problems there are no frequencies. A value counts that exact "
    "rational arithmetic confirms.</p>";

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

bool HasFrontiers(const ReportContent& content) {
  return !content.frontiers.empty() || !content.own.bests.empty();
}

Html Navigation(const ReportContent& content) {
  std::vector<std::pair<const char*, const char*>> sections = {{"#found", "Found"},
                                                               {"#method", "Method and definitions"}};
  if (content.units > 0 && !content.Objective().empty()) {
    sections.emplace_back("#findings", "Findings");
  } else if (content.units > 0) {
    sections.insert(sections.end(), {{"#frequencies", "How often it fails"},
                                     {"#outcomes", "Outcomes"},
                                     {"#doubles", "How often doubles lie"},
                                     {"#steps", "Steps"},
                                     {"#methods", "Methods side by side"},
                                     {"#existence", "Existence and agreement"},
                                     {"#findings", "Findings"}});
  }
  if (HasFrontiers(content)) sections.emplace_back("#frontiers", "Frontiers");
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
  const Html end = FrontiersSection(content.frontiers, content.own.bests) + RungsSection(content.rungs) +
                   AgainSection(content) + FilesSection();
  if (content.units == 0) return end;
  if (!content.Objective().empty()) return FindingsSection(content.discoveries, content.since) + end;
  return FrequenciesSection(content.total) + OutcomesSection(content.total) + DoublesSection(content.total) +
         StepsSection(content.total) + MethodsSection(content) + ExistenceSection(content.total) +
         FindingsSection(content.discoveries, content.since) + end;
}

Json PageData(const ReportContent& content, const std::vector<Table>& figures) {
  return {{"figures", FiguresToJson(figures)},
          {"findings", FindingsToJson(content.discoveries, content.since)}};
}

}  // namespace

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
  return Tag("pre")(Tag("code")(search + "\nstiction report again.store -o again"));
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
  const Html commands =
      content.units > 0
          ? Html(
                "<p>The same campaign, with the same build, gives the same problems, outcomes and findings "
                "on any machine and any number of threads:</p>\n") +
                AgainCommands(content)
          : Html();
  return Section("again", "Reproducing it",
                 commands + list.Done() +
                     Html("<p class=\"note\">Machines and processor times, which another run of the same "
                          "campaign need not repeat, stand in <a href=\"work.csv\"><code>work.csv</code></a> "
                          "alone.</p>\n"));
}

std::string Page(const ReportContent& content, const std::vector<Table>& figures) {
  const std::string page(std::begin(kReportTemplate), std::end(kReportTemplate));
  const bool random = content.Objective().empty();
  return FilledTemplate(
      page,
      {{"title", Text("stiction: does Baraff's contact force algorithm always end?")},
       {"heading", Text("Does Baraff’s contact force algorithm always end?")},
       {"lead", random ? Html(kLead) : Html(kOptimizedLead)},
       {"how", random ? Html(kHow) : Html(kHowOptimized)},
       {"navigation", Navigation(content)},
       {"found", FoundSection(content)},
       {"results", Results(content)},
       {"data", ScriptData(PageData(content, figures).dump(-1, ' ', false, Json::error_handler_t::replace))}});
}

}  // namespace stiction
