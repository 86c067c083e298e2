// SPDX-License-Identifier: Apache-2.0
#include "reports/viewer.h"

#include <iterator>
#include <string_view>

#include "reports/html.h"
#include "reports/viewer_template.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// Where a mark stands, once, in the template.
std::size_t PlaceOf(std::string_view mark, std::string_view page) {
  const std::size_t at = page.find(mark);
  STICTION_CHECK(at != page.npos && page.find(mark, at + 1) == page.npos,
                 "expected each mark once in web/dist/viewer.html");
  return at;
}

}  // namespace

std::string ViewerPage(const std::string& title, const Json& data) {
  constexpr std::string_view kTitle = "{{title}}", kData = "{{data}}";
  const std::string page(std::begin(kViewerTemplate), std::end(kViewerTemplate));
  const std::size_t title_at = PlaceOf(kTitle, page), data_at = PlaceOf(kData, page);
  STICTION_CHECK(title_at < data_at, "expected the title before the data in web/dist/viewer.html");
  const std::size_t between = title_at + kTitle.size();
  return page.substr(0, title_at) + Text(title).markup() + page.substr(between, data_at - between) +
         ScriptData(JsonText(data)).markup() + page.substr(data_at + kData.size());
}

}  // namespace stiction
