// SPDX-License-Identifier: Apache-2.0
#include "reports/page/figures.h"

#include "corpus/json.h"
#include "reports/page/page.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {

std::vector<Table> Figures(const ReportContent& content) {
  const Record& total = content.total;
  std::vector<Table> all = {OftenFigure(total),
                            CostFigure(total),
                            RatesFigure(total),
                            VerdictsTable(total, "doubles", {"policy"}, "in_doubles* exact* runs"),
                            TrustFigure(total),
                            StepsTable(total, "steps", {"policy", "contacts"}, "runs"),
                            ZeroStepsTable(total, "loop-steps"),
                            PivotingFigure(total),
                            DrivingFigure(total),
                            MethodsTable(total, content.discoveries),
                            FrontiersFigure(content.frontiers),
                            RungsFigure(content.rungs)};
  std::erase_if(all, [](const Table& figure) { return figure.rows.empty(); });
  return all;
}

Json FiguresToJson(const std::vector<Table>& figures, const Html& page) {
  Json json = Json::object();
  for (const Table& figure : figures) {
    const std::string place = "data-figure=\"" + figure.name;
    if (page.markup().find(place + "\"") != std::string::npos ||
        page.markup().find(place + ".") != std::string::npos)
      json[figure.name] = ToJson(figure);
  }
  return json;
}

Html FigurePlace(const std::string& name, const std::string& caption, const std::string& made_by,
                 const std::string& folder) {
  const std::string file = folder + name.substr(0, name.find('.')) + ".csv";
  const Html command =
      made_by.empty()
          ? Html("<code>stiction report STORE -o DIR</code> of <a href=\"index.html#again\">this store</a>")
          : Tag("code")(made_by);
  const Html source =
      Html("Data: ") + Tag("a", {{"href", file}})(Tag("code")(file)) + Html(", made by ") + command;
  return Tag("figure", {{"class", "plot"}, {"data-figure", name}})(
             Html("\n") + Tag("figcaption")(caption) + Html("\n<div class=\"drawing\"></div>\n") +
             Tag("p", {{"class", "source"}})(source) + Html("\n")) +
         Html("\n");
}

}  // namespace stiction
