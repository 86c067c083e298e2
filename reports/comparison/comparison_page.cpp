// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/comparison_page.h"

#include <iterator>

#include "corpus/json_text.h"
#include "reports/comparison_template.h"
#include "reports/html/html.h"
#include "reports/page/sections.h"

namespace stiction {

std::string ComparisonPage(const char* title, const char* question, const Told& told,
                           const std::vector<Table>& figures) {
  const SharedJson data = {{"figures", FiguresToJson(figures, told, "page")}};
  const std::string page(std::begin(kComparisonTemplate), std::end(kComparisonTemplate));
  return FilledTemplate(page, {{"title", Text(title)},
                               {"heading", Text(question)},
                               {"lead", PartsToHtml(told, "page-lead")},
                               {"navigation", LinksTo(told, "page")},
                               {"found", SectionsToHtml(told, "page", {}, "")},
                               {"data", ScriptData(JsonText(data))}});
}

}  // namespace stiction
