// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/comparison_page.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <vector>

#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "reports/comparison_template.h"
#include "reports/html/template.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

// Sentences before the table, which has all differences.
constexpr std::size_t kSentences = 12;

Html ListOf(const std::vector<std::string>& lines, const char* style) {
  Html items;
  for (const std::string& line : lines) items += Tag("li")(line) + Html("\n");
  return Tag("ul", {{"class", style}})(Html("\n") + items) + Html("\n");
}

Html Stores(const std::string& file_a, const std::string& file_b) {
  return Tag("dl")(Html("<dt>A</dt>") + Tag("dd")(file_a) + Html("\n<dt>B</dt>") + Tag("dd")(file_b)) +
         Html("\n");
}

// The beginning of a page: where to skip to, what is asked, the stores, and links to its sections (id, name).
Html Header(const char* kicker, const char* question, const Html& stores,
            const std::vector<std::pair<const char*, const char*>>& sections) {
  Html links;
  for (const auto& [id, name] : sections)
    links += Tag("a", {{"href", fmt::format("#{}", id)}})(name) + Html("\n");
  const auto& [first, name_of_first] = sections.at(1);
  return Tag("a",
             {{"class", "skip"}, {"href", fmt::format("#{}", first)}})(fmt::format("To: {}", name_of_first)) +
         Html("\n<header>\n") + Tag("p", {{"class", "kicker"}})(kicker) + Html("\n") + Tag("h1")(question) +
         Html("\n") + stores + Tag("nav", {{"aria-label", "Sections"}})(links) + Html("\n</header>\n");
}

// ---- What is more than noise ----

TableCell CountCell(const Ratio& ratio) {
  return {fmt::format("{} of {}", Grouped(ratio.count), Grouped(ratio.of)), Shown(ratio),
          ratio.count == 0 ? "zero" : ""};
}

Html NoiseTable(const std::vector<const ComparedRate*>& beyond) {
  Table table{"noise",
              "Differences that are more than noise",
              {{"generator, contacts", "", kText},
               {"friction", "of all contacts, where runs of one friction are compared", kText},
               {"what", "", kText},
               {"more in", "", kText},
               {"A", "runs, of how many, share and its exact interval at 95 %"},
               {"B", "likewise"},
               {"p", "of Fisher's exact test, two-sided"},
               {"p corrected", "for all tests of this comparison, by Holm"}}};
  for (const ComparedRate* rate : beyond) {
    table.Add({NameOf(rate->key), rate->friction.empty() ? "any" : rate->friction, rate->meaning,
               MoreInA(*rate) ? "A" : "B", CountCell(rate->a), CountCell(rate->b), PText(*rate->p),
               PText(*rate->adjusted)});
  }
  return ToHtml(table);
}

Html NoiseSection(const Comparison& comparison) {
  const std::vector<const ComparedRate*> beyond = BeyondNoise(comparison);
  Html content = Tag("p", {{"class", "asked"}})(NoiseSentence(comparison)) + Html("\n");
  if (!beyond.empty()) {
    std::vector<std::string> sentences;
    for (const ComparedRate* rate : beyond) sentences.push_back(SentenceOf(*rate));
    if (sentences.size() > kSentences) {
      sentences.resize(kSentences);
      sentences.push_back(fmt::format("and {} more, in the table.", beyond.size() - kSentences));
    }
    content += ListOf(sentences, "answers") + NoiseTable(beyond);
  }
  for (const std::string& text : {AboutTests(), OnlyIn(comparison.only_a, "A"), OnlyIn(comparison.only_b, "B")})
    if (!text.empty()) content += Tag("p", {{"class", "note"}})(text) + Html("\n");
  return Section("noise", "What is more than noise", content);
}

// ---- Figures ----

constexpr const char* kMadeBy = "stiction report A B -o DIR";

// The cells of a table as they stand in its file: as text.
Json FileCells(const Table& table) {
  Json json = ToJson(table);
  for (Json& row : json["rows"]) {
    for (Json& cell : row)
      cell = cell.is_null() ? "" : cell.is_string() ? cell.get<std::string>() : JsonText(cell);
  }
  return json;
}

Html FilesBeside() {
  return Section("files", "Files beside this page",
                 Html("<ul>\n<li><a href=\"comparison.csv\"><code>comparison.csv</code></a>: a row per rate, "
                      "also those that are noise</li>\n<li><a "
                      "href=\"comparison_steps.csv\"><code>comparison_steps.csv</code></a>: runs of A and of B "
                      "by their steps</li>\n<li><a href=\"comparison.txt\"><code>comparison.txt</code></a>: "
                      "what the program prints</li>\n<li><a href=\"SHA256SUMS\"><code>SHA256SUMS</code></a>: "
                      "the SHA-256 of every file of this folder, for sha256sum --check</li>\n</ul>\n"));
}

// The command that makes the page again, where the stores lie as they did.
Html CommandSection(const std::string& file_a, const std::string& file_b) {
  return Section("again", "Making it again",
                 Tag("pre")(Tag("code")(
                     fmt::format("stiction report {} {} -o DIR", ShellWord(file_a), ShellWord(file_b)))) +
                     Html("\n"));
}

}  // namespace

std::string ComparisonPage(const Comparison& comparison, const std::string& file_a, const std::string& file_b) {
  const Html rates =
      FigurePlace(
          "comparison",
          "How often, in a million runs, with exact intervals at 95 %, on a logarithmic scale. Zero has no "
          "place on it: where none was seen, a dotted line reaches up to the end of the interval, below "
          "which the rate lies.",
          kMadeBy, "") +
      Html("<h3>Loops</h3>\n") + ToHtml(ComparedLoopsTable(comparison));
  const Html steps =
      FigurePlace("comparison_steps",
                  "Runs by their steps, as shares of all runs of each campaign, on a logarithmic scale; "
                  "the last number stands for itself and all above where the table says so.",
                  kMadeBy, "");
  const Json data = {{"figures",
                      {{"comparison", FileCells(ComparisonTable(comparison))},
                       {"comparison_steps", FileCells(ComparisonStepsTable(comparison))}}}};
  const std::string page(std::begin(kComparisonTemplate), std::end(kComparisonTemplate));
  return FilledTemplate(
      page,
      {{"title", Text("stiction: two campaigns side by side")},
       {"header", Header("Two campaigns of stiction, side by side", "What differs, and is it more than noise?",
                         Stores(file_a, file_b),
                         {{"design", "How they differ"},
                          {"noise", "More than noise"},
                          {"rates", "Rates"},
                          {"steps", "Steps"},
                          {"again", "Making it again"},
                          {"files", "Files"}})},
       {"design", Section("design", "How the two campaigns differ", ListOf(comparison.differences, "plain"))},
       {"results", NoiseSection(comparison) + Section("rates", "Rates", rates) +
                       Section("steps", "Steps of a run", steps) + CommandSection(file_a, file_b) +
                       FilesBeside()},
       {"data", ScriptData(JsonText(data))}});
}

std::string SolversPage(const SolversCompared& compared, const std::string& about) {
  std::string command = "stiction report";
  for (const std::string& file : compared.files) command += " " + ShellWord(file);
  const Html smallest =
      compared.smallest.rows.empty() ? Tag("p")("No failure was found.") : ToHtml(compared.smallest);
  const Html note = Tag("p", {{"class", "note"}})(about) + Html("\n");
  Html files;
  for (const char* name : {"solvers.csv", "failures.csv", "smallest.csv", "solvers.txt", "SHA256SUMS"})
    files += Tag("li")(Tag("a", {{"href", name}})(name)) + Html("\n");
  const std::string page(std::begin(kComparisonTemplate), std::end(kComparisonTemplate));
  return FilledTemplate(
      page,
      {{"title", Text("stiction: solvers side by side")},
       {"header", Header("Solvers under test, side by side", "Which solver fails, how, and how often?", Html(),
                         {{"design", "Solvers"},
                          {"failures", "Failures"},
                          {"smallest", "Smallest problems"},
                          {"again", "Making it again"},
                          {"files", "Files"}})},
       {"design",
        Section("design", "Solvers", ToHtml(compared.solvers)) +
            Section("differences", "How their searches differ besides", ListOf(compared.differences, "plain"))},
       {"results",
        Section("failures", compared.failures.caption, note + ToHtml(compared.failures)) +
            Section("smallest", compared.smallest.caption, smallest) +
            Section("again", "Making it again", Tag("pre")(Tag("code")(command + " -o DIR")) + Html("\n")) +
            Section("files", "Files beside this page", Tag("ul")(files) + Html("\n"))},
       {"data", ScriptData(R"({"figures": {}})")}});
}

}  // namespace stiction
