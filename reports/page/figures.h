// SPDX-License-Identifier: Apache-2.0
// Figures of a report: the numbers that the page's script draws. Each is a table of its own, which stands in
// the page and, the same, in figures/NAME.csv.

#ifndef STICTION_REPORTS_PAGE_FIGURES_H_
#define STICTION_REPORTS_PAGE_FIGURES_H_

#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "reports/html/html.h"

namespace stiction {

struct ReportContent;

struct FigureTable {
  std::string name;
  std::vector<std::string> columns;
  Json rows =
      Json::array();  // of arrays of texts, integers, and doubles of six digits or as many as an interval takes
};

// Those that have something to draw, in the order of the page. Rates are in a million runs, shares of 1; `low`
// and `high` are the ends of their exact intervals at 95 % (corpus/intervals.h).
//
//   rates       failures confirmed exactly, `by` contacts, friction (mu), and rank
//   doubles     runs repeated exactly on suspicion: what doubles said, what is exact
//   trust       audited runs that were misjudged, and solutions that are none
//   steps       runs by their steps; `or_more` marks the last bin
//   loop-steps  loops by the steps of length zero in their period
//   pivoting    runs with a step of length zero, and with something given up
//   driving     paths of complete driving with folds, with descents, with ties
//   methods     what each method made of what it was asked
//   frontiers   the records, and what random problems reached
//   rungs       of a benchmark: time and lost answers
std::vector<FigureTable> Figures(const ReportContent& content);

std::string FigureCsv(const FigureTable& figure);
// {"NAME": {"columns": [...], "rows": [[...], ...]}, ...}
Json FiguresToJson(const std::vector<FigureTable>& figures);

// The place of a figure in the page, with what it shows and where its numbers are; `made_by`: the command, if
// it is not the report of this store.
Html FigurePlace(const std::string& name, const std::string& caption, const std::string& made_by = "");

}  // namespace stiction

#endif  // STICTION_REPORTS_PAGE_FIGURES_H_
