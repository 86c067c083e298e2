// SPDX-License-Identifier: Apache-2.0
#include "reports/html/html.h"

#include <fmt/format.h>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

void AppendEscaped(std::string& out, char c) {
  switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    case '\'':
      out += "&#39;";
      break;
    default: {
      const auto byte = static_cast<unsigned char>(c);
      const bool allowed = (byte >= 0x20 && byte != 0x7f) || c == '\t' || c == '\n';
      if (allowed) {
        out += c;
      } else {
        out += kReplacement;
      }
    }
  }
}

std::string Escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) AppendEscaped(out, c);
  return out;
}

}  // namespace

Html& Html::operator+=(const Html& more) {
  markup_ += more.markup_;
  return *this;
}

Html Text(std::string_view text) {
  Html html;
  html.markup_ = Escaped(text);
  return html;
}

Html ScriptData(std::string_view json) {
  Html html;
  for (const char c : json) {
    if (c == '<') {
      html.markup_ += "\\u003c";
    } else {
      html.markup_ += c;
    }
  }
  return html;
}

Tag::Tag(std::string_view name, std::initializer_list<Attribute> attributes) : name_(name), open_("<" + name_) {
  for (const Attribute& attribute : attributes) {
    if (attribute.value.empty()) continue;
    open_ += fmt::format(" {}=\"{}\"", attribute.name, Escaped(attribute.value));
  }
}

Html Tag::operator()(const Html& content) const {
  Html html;
  html.markup_ = fmt::format("{}>{}</{}>", open_, content.markup(), name_);
  return html;
}

Html Tag::Void() const {
  Html html;
  html.markup_ = open_ + ">";
  return html;
}

std::string Fixed(double x, int decimals) { return fmt::format("{:.{}f}", x, decimals); }

std::string Significant(double x, int digits) { return fmt::format("{:.{}g}", x, digits); }

std::string Mean(std::int64_t sum, std::int64_t count) {
  if (count == 0) return "";
  const double value = static_cast<double>(sum) / static_cast<double>(count);
  if (value == 0) return "0";
  if (value < 1) return fmt::format("{:#.2g}", value);
  if (value < 10) return fmt::format("{:.2f}", value);
  if (value < 100) return fmt::format("{:.1f}", value);
  return Grouped(static_cast<std::int64_t>(value + 0.5));
}

std::string FilledTemplate(std::string_view page, const std::map<std::string, Html>& marks) {
  std::map<std::size_t, std::string> places;  // of marks, in their order in the page
  for (const auto& [name, content] : marks) {
    const std::string mark = "{{" + name + "}}";
    const std::size_t at = page.find(mark);
    STICTION_CHECK(at != page.npos && page.find(mark, at + 1) == page.npos,
                   "expected the mark " + mark + " once in a page of web/src");
    places[at] = name;
  }
  std::string filled;
  std::size_t from = 0;
  for (const auto& [at, name] : places) {
    filled += page.substr(from, at - from);
    filled += marks.at(name).markup();
    from = at + name.size() + 4;
  }
  return filled += page.substr(from);
}

}  // namespace stiction
