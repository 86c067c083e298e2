// SPDX-License-Identifier: Apache-2.0
// The report: what a store holds, as a page for people, tables for programs, and files to replay and check.
//
//   index.html                    one page that needs nothing else
//   statistics.csv verdicts.csv   what was counted (csv.h)
//   steps.csv findings.csv agreement.csv solutions.csv
//   citation.bib                  how to cite it (latex.h)
//   SHA256SUMS                    of every file but itself
//   findings/NAME.json            the minimized problem; as found while there is none
//   findings/NAME.original.json   the problem as found
//   findings/NAME.certificate.json  of the minimized problem, otherwise of the problem as found
//   findings/NAME.existence.certificate.json            that NAME.json has a solution
//   findings/NAME.original.existence.certificate.json   likewise, of NAME.original.json if that is another
//   problem

#ifndef STICTION_REPORTS_REPORT_H_
#define STICTION_REPORTS_REPORT_H_

#include <filesystem>
#include <vector>

#include "corpus/store.h"
#include "corpus/whole_folder.h"

namespace stiction {

// `benches`: files of bench --csv, which the page draws. `latex`: with tables and figures for papers (latex.h).
// Writes the directory as a whole (corpus/whole_folder.h), so that nothing of an older report stays. The same
// content of a store gives the same bytes. Returns where a directory with files of others was moved to, if so.
std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory,
                                  Occupied occupied = Occupied::kRefused,
                                  const std::vector<std::filesystem::path>& benches = {}, bool latex = false);

}  // namespace stiction

#endif  // STICTION_REPORTS_REPORT_H_
