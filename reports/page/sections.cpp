// SPDX-License-Identifier: Apache-2.0
#include "reports/page/sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "corpus/json_text.h"

namespace stiction {
namespace {

Html Marked(std::string_view text) {
  const std::size_t at = std::min(text.find_first_of("\x01\x03"), text.size());
  if (at == text.size()) return Text(text);
  const bool link = text[at] == '\x03';
  const std::size_t end = text.find(link ? '\x05' : '\x02', at), middle = text.find('\x04', at);
  const Html before = Text(text.substr(0, at)), behind = Marked(text.substr(end + 1));
  if (!link) return before + Tag("code")(text.substr(at + 1, end - at - 1)) + behind;
  return before +
         Tag("a", {{"href", std::string(text.substr(at + 1, middle - at - 1))}})(
             Marked(text.substr(middle + 1, end - middle - 1))) +
         behind;
}

Html Paragraph(const Part& part, const char* style) {
  const Html lead = part.lead.empty() ? Html() : Tag("strong")(Marked(part.lead)) + Html(" ");
  return Tag("p", {{"class", style}})(lead + Marked(part.text)) + Html("\n");
}

// Terms and what they are, or items.
Html List(const Part& part) {
  Html list;
  bool terms = false;
  for (const auto& [line, more] : part.lines) {
    terms = terms || !more.empty();
    list += (more.empty() ? Tag("li")(Marked(line)) : Tag("dt")(Marked(line)) + Tag("dd")(more)) + Html("\n");
  }
  list = Tag(terms ? "dl" : "ul")(Html("\n") + list) + Html("\n");
  if (part.text.empty()) return list;
  return Tag("details", {{"class", "folded"}})(Tag("summary")(Marked(part.text)) + Html("\n") + list) +
         Html("\n");
}

// With what it shows, the file of its numbers, and the command that makes it.
Html Figure(const Part& part, const std::string& folder) {
  const std::string& name = part.lead;
  const std::string file = folder + name.substr(0, name.find('.')) + ".csv";
  const Html command =
      part.more.empty()
          ? Html("<code>stiction report STORE -o DIR</code> of <a href=\"index.html#again\">this store</a>")
          : Tag("code")(part.more);
  const Html source =
      Html("Data: ") + Tag("a", {{"href", file}})(Tag("code")(file)) + Html(", made by ") + command;
  return Tag("figure", {{"class", "plot"}, {"data-figure", name}})(
             Html("\n") + Tag("figcaption")(Marked(part.text)) + Html("\n<div class=\"drawing\"></div>\n") +
             Tag("p", {{"class", "source"}})(source) + Html("\n")) +
         Html("\n");
}

Html Tables(const Part& part) {
  Html html;
  for (const Table& table : part.tables) html += ToHtml(table);
  return html.empty() ? Html("<p class=\"note\">None.</p>\n") : html;
}

Html PartToHtml(const Part& part, const std::string& medium, const Places& places, const std::string& folder) {
  const bool of_head = medium.ends_with("-lead");
  if (part.what == "sentence" || part.what == "flush")
    return Paragraph(part, !of_head ? "" : part.lead.empty() ? "asked" : "claim");
  if (part.what == "note") return Paragraph(part, of_head ? "" : "note");
  if (part.what == "heading") return Tag("h3")(Marked(part.text)) + Html("\n");
  if (part.what == "table") return Tables(part);
  if (part.what == "figure") return Figure(part, folder);
  if (part.what == "list") return List(part);
  if (part.what == "place") return places.at(Plain(part.text));
  std::vector<std::string> commands;
  for (const auto& [line, more] : part.lines) commands.push_back(Plain(line));
  return Tag("pre", {{"class", medium == "findings" ? "setup" : ""}})(
             Tag("code")(fmt::format("{}", fmt::join(commands, "\n")))) +
         Html("\n");
}

// On the first page words stand beside a figure.
Html Beside(const Html& words, const Html& figure) {
  return Tag("div", {{"class", "beside"}})(Tag("div", {{"class", "words"}})(words) + Html("\n") + figure) +
         Html("\n");
}

}  // namespace

Html SectionsToHtml(const Told& told, const std::string& medium, const Places& places,
                    const std::string& folder) {
  Html html;
  for (const Section& section : told) {
    if (!section.In(medium)) continue;
    Html content;
    for (const Part& part : section.parts) {
      if (!part.In(medium)) continue;
      const Html one = PartToHtml(part, medium, places, folder);
      content = medium == "index" && part.what == "figure" ? Beside(content, one) : content + one;
    }
    html += Tag("section", {{"id", section.id}})(Html("\n") + Tag("h2")(section.title) + Html("\n") + content) +
            Html("\n");
  }
  return html;
}

Html PartsToHtml(const Told& told, const std::string& medium) {
  Html html;
  for (const Section& section : told)
    for (const Part& part : section.parts)
      if (part.In(medium)) html += PartToHtml(part, medium, {}, "");
  return html;
}

Html LinksTo(const Told& told, const std::string& medium, const std::string& page) {
  Html links;
  for (const Section& section : told)
    if (section.In(medium)) links += Tag("a", {{"href", page + "#" + section.id}})(section.title) + Html("\n");
  return links;
}

SharedJson FiguresToJson(const std::vector<Table>& figures, const Told& told, const std::string& medium) {
  SharedJson json = SharedJson::Object();
  for (const Section& section : told) {
    for (const Part& part : section.parts) {
      const auto figure = std::ranges::find(figures, part.lead.substr(0, part.lead.find('.')), &Table::name);
      if (part.what == "figure" && part.In(medium) && figure != figures.end())
        json.Add({{figure->name, ToJson(*figure)}});
    }
  }
  return json;
}

}  // namespace stiction
