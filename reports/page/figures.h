// SPDX-License-Identifier: Apache-2.0
// Figures of a report: tables that the page's script draws. Each stands in the page and, the same, in
// figures/NAME.csv.

#ifndef STICTION_REPORTS_PAGE_FIGURES_H_
#define STICTION_REPORTS_PAGE_FIGURES_H_

#include <string>
#include <vector>

#include "reports/html/html.h"
#include "reports/tables/table.h"

namespace stiction {

struct ReportContent;

// Those that have something to draw, in the order of the pages: often, cost, rates, doubles, trust, steps,
// loop-steps, pivoting, driving, methods (reports/tables/campaign_tables.h), frontiers, rungs. Rates are in a
// million runs, shares of 1; `low` and `high` are the ends of their exact intervals at 95 %
// (corpus/intervals.h).
std::vector<Table> Figures(const ReportContent& content);

// {"NAME": {"columns": [...], "rows": [[...], ...]}, ...} of those that have a place in a page.
Json FiguresToJson(const std::vector<Table>& figures, const Html& page);

// The place of a figure in the page, with what it shows, the file of its numbers, and the command that makes
// it: `made_by`, or the report of this store.
Html FigurePlace(const std::string& name, const std::string& caption, const std::string& made_by = "",
                 const std::string& folder = "figures/");

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_FIGURES_H_
