// SPDX-License-Identifier: Apache-2.0
#include "reports/html/template.h"

#include "solver/problem/check.h"

namespace stiction {

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
