// SPDX-License-Identifier: Apache-2.0
#include "reports/told/told.h"

#include <algorithm>
#include <regex>

#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/text_template.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// ---- One text ----

// Marks become control characters, which no value has: code is 1...2, a link 3 address 4 title 5.
std::string Marked(const std::string& text) {
  static const std::regex code("`([^`]*)`"), link(R"(\[([^\]]+)\]\(([^)]+)\))"), file(R"(\[([^\]]+)\])");
  const std::string marked = std::regex_replace(text, code, "\x01$1\x02");
  return std::regex_replace(std::regex_replace(marked, link, "\x03$2\x04$1\x05"), file,
                            "\x03$1\x04\x01$1\x02\x05");
}

std::string Clean(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return text;
}

std::string ValueOf(const Facts& facts, const std::string& name) {
  const auto found = facts.texts.find(name);
  return found != facts.texts.end() ? Clean(found->second) : Shown(CellOf(name, facts.numbers));
}

std::string FilledText(const std::string& text, const Facts& facts) {
  static const std::regex place(R"(@([a-z_]+(?:[-/%~][a-z_]+)?)(?::([a-z ]+)|=([^|@]*)\|([^@]*))?@)");
  const std::string marked = Marked(text);
  std::string filled;
  auto rest = marked.begin();
  for (std::sregex_iterator at(marked.begin(), marked.end(), place); at != std::sregex_iterator(); ++at) {
    const std::smatch& match = *at;
    filled.append(rest, match[0].first);
    rest = match[0].second;
    const auto number = [&] { return std::get<std::int64_t>(CellOf(match[1], facts.numbers).value); };
    filled += match[2].matched   ? Counted(number(), match[2].str())
              : match[3].matched ? match[number() == 1 ? 3 : 4].str()
                                 : ValueOf(facts, match[1]);
  }
  return filled.append(rest, marked.end());
}

// ---- A file of them ----

// Blocks that do not hold are gone.
std::vector<std::string> LinesThatHold(std::span<const unsigned char> text, const Facts& facts) {
  Blanks blanks;
  for (const auto& [name, number] : facts.numbers)
    if (number != 0) blanks.words.insert(name);
  for (const auto& [name, said] : facts.texts)
    if (!said.empty()) blanks.words.insert(name);
  for (const auto& [name, list] : facts.lists)
    if (!list.empty()) blanks.words.insert(name);
  return LogicalLines(Filled(text, blanks));
}

Part PartOf(const std::string& mark, const std::vector<std::string>& said, const Facts& facts) {
  static const std::map<std::string, std::string> kinds = {
      {".", "sentence"}, {"^", "flush"},    {"!", "sentence"}, {">", "note"},
      {"##", "heading"}, {"=", "table"},    {"~", "figure"},   {"*", "list"},
      {"-", "list"},     {"$", "commands"}, {":", "place"}};
  STICTION_CHECK(kinds.contains(mark), "expected a mark of told.h, found " + mark);
  const auto filled = [&](std::size_t i) { return i < said.size() ? FilledText(said[i], facts) : ""; };
  Part part{kinds.at(mark), "", filled(0)};
  if (mark == "!") {
    part.lead = filled(0);
    part.text = filled(1);
  } else if (mark == "-" || mark == "$") {
    part.text = "";
    part.lines = {{filled(0), ""}};
  } else if (mark == "=") {
    STICTION_CHECK(facts.tables.contains(said[0]), "expected tables " + said[0]);
    part.tables = facts.tables.at(said[0])();
  } else if (mark == "*" || mark == "~") {
    part.lead = said[0];
    part.text = filled(1);
    part.more = filled(2);
    if (mark == "*") {
      STICTION_CHECK(facts.lists.contains(said[0]), "expected a list " + said[0]);
      for (const auto& [what, more] : facts.lists.at(said[0]))
        part.lines.emplace_back(Clean(what), Clean(more));
    }
  }
  return part;
}

bool Meet(const std::vector<std::string>& some, const std::vector<std::string>& others) {
  return std::ranges::any_of(some, [&](const std::string& one) { return std::ranges::count(others, one) > 0; });
}

}  // namespace

bool Part::In(const std::string& medium) const { return Meet({medium}, media); }

bool Section::In(const std::string& medium) const {
  return std::ranges::any_of(parts, [&](const Part& part) { return part.In(medium); });
}

Told Tell(std::span<const unsigned char> text, const Facts& facts, const std::vector<std::string>& media) {
  Told told;
  std::vector<std::string> current;  // media
  bool joins = false;                // the part before stands in the line above
  for (const std::string& line : LinesThatHold(text, facts)) {
    const std::size_t blank = std::min(line.find(' '), line.size());
    const std::string mark = line.substr(0, blank), rest = line.substr(std::min(blank + 1, line.size()));
    if (mark == "#" || mark == "#-") {
      const std::vector<std::string> parts = Split(rest, " | ");
      told.push_back({parts[0], parts.size() > 1 ? parts[1] : "", mark == "#-"});
    } else if (mark == "%") {
      current = Split(rest, " ");
    }
    const bool is_part = mark[0] != '%' && mark != "#" && mark != "#-" && Meet(current, media);
    if (!is_part) {
      joins = false;
      continue;
    }
    Part part = PartOf(mark, Split(rest, " | "), facts);
    part.media = current;
    const bool more = mark == "-" || mark == "$";
    std::vector<Part>& parts = told.back().parts;
    if (more && joins && parts.back().what == part.what)
      parts.back().lines.push_back(part.lines.front());
    else
      parts.push_back(std::move(part));
    joins = more;
  }
  std::erase_if(told, [](const Section& section) { return section.parts.empty(); });
  for (Section& section : told) section.title = Plain(FilledText(section.title, facts));
  return told;
}

std::string Plain(const std::string& marked) {
  std::string plain;
  bool address = false;
  for (const char c : marked) {
    address = c == 3 || (address && c != 4);
    if (!address && (c < 1 || c > 5)) plain += c;
  }
  return plain;
}

SharedJson ToJson(const Told& told) {
  Json sections = Json::array();
  for (const Section& section : told) {
    Json parts = Json::array();
    for (const Part& part : section.parts) {
      if (part.what == "place") continue;
      Json json = {{"what", part.what == "flush" ? "sentence" : part.what}, {"in", part.media}};
      for (const auto& [key, text] :
           {std::pair(part.what == "figure" ? "name" : "lead", &part.lead), {"text", &part.text}})
        if (!text->empty() && part.what != "table") json[key] = Plain(*text);
      for (const auto& [line, more] : part.lines)
        json["lines"].push_back(more.empty() ? Json(Plain(line)) : Json({Plain(line), more}));
      if (part.what == "table") json["tables"] = Json::array();
      for (const Table& table : part.tables) {
        Json columns = Json::array();
        for (const Column& column : table.columns)
          for (const std::string& name : Split(column.name, ","))
            if (!name.empty()) columns.push_back({{"name", name}, {"type", column.text ? "text" : "number"}});
        json["tables"].push_back({{"name", table.name},
                                  {"caption", table.caption},
                                  {"columns", std::move(columns)},
                                  {"rows", ToJson(table)->at("rows")}});
      }
      parts.push_back(std::move(json));
    }
    sections.push_back({{"id", section.id}, {"title", section.title}, {"parts", std::move(parts)}});
  }
  return Json{{"format", "stiction-report"},
              {"version", 1},
              {"title", "A report of stiction"},
              {"sections", std::move(sections)}};
}

std::string ToText(const Told& told, const std::string& medium) {
  std::string text;
  const auto add = [&text](const Part& part) {
    if (part.what == "heading") text += "\n" + Heading(Plain(part.text));
    if (part.what == "sentence" || part.what == "note") text += Paragraph(Plain(part.text));
    if (part.what == "flush") text += Paragraph(Plain(part.text), 0);
    for (const auto& [line, more] : part.lines) {
      text += part.what == "commands" ? "    " + Plain(line) + "\n" : Paragraph(Plain(line));
      if (!more.empty()) text += Paragraph(more, 6);
    }
    for (const Table& table : part.tables)
      text += (table.caption.ends_with(":") ? Paragraph(table.caption) : "") + ToText(table);
  };
  for (const Section& section : told) {
    if (!section.In(medium)) continue;
    if (medium != "summary" && !section.goes_on && !section.title.empty())
      text += (text.empty() ? "" : "\n") + Heading(section.title);
    for (const Part& part : section.parts)
      if (part.In(medium)) add(part);
  }
  return text;
}

}  // namespace stiction
