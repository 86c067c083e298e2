// SPDX-License-Identifier: Apache-2.0
// HTML and SVG, escaped by construction: whatever does not come from our own source text becomes Html only
// through Text(), an attribute's value or ScriptData(), and all of them escape.

#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "corpus/grouped.h"

namespace stiction {

class Html {
 public:
  Html() = default;
  // Markup of our own; a literal only, so that nobody passes what a store says.
  template <std::size_t Size>
  explicit Html(const char (&markup)[Size]) : markup_(markup, Size - 1) {}

  Html& operator+=(const Html& more);
  friend Html operator+(Html left, const Html& right) { return left += right; }

  const std::string& markup() const { return markup_; }
  bool empty() const { return markup_.empty(); }

 private:
  friend Html Text(std::string_view text);
  friend Html ScriptData(std::string_view json);
  friend struct Tag;
  std::string markup_;
};

// Control characters that HTML does not allow become U+FFFD.
Html Text(std::string_view text);

// JSON text as a script may hold it, still JSON: "<" stands in it as \u003c, so no end of a script does.
Html ScriptData(std::string_view json);

// One that is empty is left out.
struct Attribute {
  std::string_view name;
  std::string value;
};

// Tag("a", {{"href", url}})(content): an element. Void elements take no content: Tag("br").Void().
struct Tag {
  Tag(std::string_view name, std::initializer_list<Attribute> attributes = {});
  Html operator()(const Html& content) const;
  Html operator()(std::string_view text) const { return (*this)(Text(text)); }
  Html Void() const;

 private:
  std::string name_;
  std::string open_;  // "<name attributes", not closed yet
};

// ---- Numbers for pictures ----

std::string Fixed(double x, int decimals = 1);
std::string Significant(double x, int digits = 5);

// ---- Numbers for people ----

// Sum per count, in two or three digits; "" of nothing.
std::string Mean(std::int64_t sum, std::int64_t count);

// ---- Pages that the build has joined (web/join.py), and that the program fills ----

// The page with each mark, {{NAME}}, replaced. InternalError if one does not stand there exactly once.
std::string FilledTemplate(std::string_view page, const std::map<std::string, Html>& marks);

}  // namespace stiction
