// SPDX-License-Identifier: Apache-2.0
// A text with places: what is filled in, what stays, what is left out.

#include "corpus/text_template.h"

#include <catch2/catch.hpp>
#include <stdexcept>

namespace stiction {
namespace {

std::string FilledText(const std::string& text, const Blanks& blanks) {
  return Filled({reinterpret_cast<const unsigned char*>(text.data()), text.size()}, blanks);
}

TEST_CASE("text template: places have their texts, in which nothing is a place, and any other @ is itself") {
  const Blanks blanks = {{{"A", "1"}, {"LONG_NAME", "@A@"}}};
  CHECK(FilledText("x@A@y @LONG_NAME@\n", blanks) == "x1y @A@\n");
  CHECK(FilledText("@misc{a, b@c.org}\n\n  @ A@\n", blanks) == "@misc{a, b@c.org}\n\n  @ A@\n");
  CHECK_THROWS_AS(FilledText("@B@\n", blanks), std::out_of_range);
}

TEST_CASE("text template: words choose between two texts in a line") {
  const Blanks blanks = {{}, {"on", "is-so"}};
  CHECK(FilledText("a@on?b|c@d@off?e|f@\n", blanks) == "abdf\n");
  CHECK(FilledText("@is-so?, \"x\": y|@)@off?z|@\n", blanks) == ", \"x\": y)\n");
}

TEST_CASE("text template: blocks stay where all their words hold, in blocks that stay") {
  const std::string text =
      "@ left out\n@if a\nA\n@if !b\nno b\n@else\nb\n@end\n@else\nno A\n@if b\nB alone\n@end\n@end\n@if a "
      "b\nboth\n@end\n";
  CHECK(FilledText(text, {{}, {"a", "b"}}) == "A\nb\nboth\n");
  CHECK(FilledText(text, {{}, {"a"}}) == "A\nno b\n");
  CHECK(FilledText(text, {{}, {"b"}}) == "no A\nB alone\n");
  CHECK(FilledText(text, {}) == "no A\n");
}

}  // namespace
}  // namespace stiction
