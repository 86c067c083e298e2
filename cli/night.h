// SPDX-License-Identifier: Apache-2.0
// What a search says while it runs: a bar on a terminal, dated lines in a log, a command for every finding.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/shared.h"
#include "search/search.h"
#include "search/testimony.h"

namespace stiction {

// "2026-01-31 23:59:59", local.
std::string TimeOfDay();

// How far a store is read, which is named if it is one of several.
ShowFindings Reading(ProgressBar& bar, const std::string& file = {});

// Progress on standard error. A terminal has a line for each new group when it is found, and below them a bar.
// A log has a line every ten seconds at first, later more seldom, and one when there is a new group; each says
// what is new since the line before it, and which of that the corpus has too.
class NightLog {
 public:
  explicit NightLog(std::optional<double> minutes) : minutes_(minutes) {}

  void Show(const SearchProgress& progress);
  // The end: nothing that is new stays unsaid.
  void Finish(const SearchProgress& progress);

 private:
  double Fraction(const SearchProgress& progress) const;
  std::string Line(const SearchProgress& progress) const;
  void Print(const SearchProgress& progress);
  void PrintNews();

  std::optional<double> minutes_;
  ProgressBar bar_;
  double last_ = 0;                       // seconds, of the line before
  std::optional<std::int64_t> problems_;  // then
  std::vector<Finding> news_;             // since then
};

// Runs a shell command for a finding. It gets the finding as JSON on standard input, and STICTION_SIGNATURE,
// STICTION_KIND, STICTION_GRAVE (0 or 1), STICTION_KNOWN (the case of the corpus with this signature, or
// nothing), STICTION_CONTACTS, STICTION_UNIT, STICTION_INDEX and STICTION_STORE. One that fails, or is still
// running after a minute and is killed then, is reported on standard error and nothing else.
void RunOnFinding(const std::string& command, const std::string& store, const Finding& finding);

// What is stored of a finding, as JSON.
SharedJson ToJson(const Finding& finding);

}  // namespace stiction
