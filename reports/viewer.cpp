// SPDX-License-Identifier: Apache-2.0
#include "reports/viewer.h"

#include <iterator>

#include "reports/html/html.h"
#include "reports/viewer_template.h"

namespace stiction {

namespace {

Html OriginRows(const ViewerOrigin& origin) {
  return Html("<dt>made by</dt>") + Tag("dd")(Tag("code")(origin.command)) + Html("\n<dt>version</dt>") +
         Tag("dd")("stiction " + origin.version) + Html("\n<dt>problem</dt>") +
         Tag("dd")(Tag("code")(origin.digest));
}

Html WayBack(const ViewerOrigin& origin) {
  if (origin.report.empty()) return {};
  return Tag("a", {{"href", origin.report}})("A report of stiction") + Html(" · ");
}

}  // namespace

std::string ViewerPage(const std::string& title, const Json& data, const ViewerOrigin& origin) {
  const std::string page(std::begin(kViewerTemplate), std::end(kViewerTemplate));
  return FilledTemplate(page, {{"title", Text(title)},
                               {"back", WayBack(origin)},
                               {"data", ScriptData(JsonText(data))},
                               {"origin", OriginRows(origin)}});
}

}  // namespace stiction
