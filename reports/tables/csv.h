// SPDX-License-Identifier: Apache-2.0
// The tables of a report as CSV (RFC 4180): a header line, CRLF, exact integers.

#ifndef STICTION_REPORTS_TABLES_CSV_H_
#define STICTION_REPORTS_TABLES_CSV_H_

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/statistics.h"
#include "corpus/work.h"
#include "reports/tables/discovery.h"

namespace stiction {

class Csv {
 public:
  Csv& Add(std::string_view text);  // quoted where it must be
  Csv& Add(std::int64_t value);
  void EndRow();
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool row_started_ = false;
};

// The rows of a CSV text, the line of names first. InputError that names the row of an open quotation, and of a
// number of cells other than that of the names.
std::vector<std::vector<std::string>> ReadCsv(std::string_view text, const std::string& source);

// One row per tally: problems, outcomes, audits, sums and maxima of every counter.
std::string StatisticsCsv(const Record& record);
// One row per tally, double outcome and exact outcome that occurred, of the runs repeated exactly on suspicion.
std::string VerdictsCsv(const Record& record);
// One row per tally, friction and rank: problems, steps, audits, and the outcomes of doubles and of exact runs
// apart.
std::string StrataCsv(const Record& record);
// One row per tally and number of steps that occurred; the last bin holds everything above, too.
std::string StepsCsv(const Record& record);
// One row per number of contacts in the period of a loop: sums over the loops of exact arithmetic.
std::string LoopsCsv(const Record& record);
// The same by how many zero steps the period has.
std::string ZeroStepsCsv(const Record& record);
// One row per number of contacts: existence decided by complete driving, methods compared, safe problems.
std::string AgreementCsv(const Record& record);
// One row per number of contacts and count that occurred: problems with so many mode words that have solutions
// (`counted` = words), or regular problems with so many solutions (solutions).
std::string SolutionsCsv(const Record& record);
// What another run of the same campaign need not repeat: machines, and processor seconds by what they went into.
std::string WorkCsv(const Work& work);
// One row per signature, in the order of signature.
std::string FindingsCsv(const std::vector<Discovery>& discoveries);
// A row per finding that Ipopt was asked about. Apart, since its answers depend on the machine's libraries.
std::string IpoptCsv(const std::vector<Discovery>& discoveries);

}  // namespace stiction

#endif  // STICTION_REPORTS_TABLES_CSV_H_
