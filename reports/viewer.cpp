// SPDX-License-Identifier: Apache-2.0
#include "reports/viewer.h"

#include <iterator>

#include "reports/template.h"
#include "reports/viewer_template.h"

namespace stiction {

std::string ViewerPage(const std::string& title, const Json& data) {
  const std::string page(std::begin(kViewerTemplate), std::end(kViewerTemplate));
  return FilledTemplate(page, {{"title", Text(title)}, {"data", ScriptData(JsonText(data))}});
}

}  // namespace stiction
