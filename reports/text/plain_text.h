// SPDX-License-Identifier: Apache-2.0
// Text for a terminal: paragraphs and tables of at most 100 columns.

#ifndef STICTION_REPORTS_TEXT_PLAIN_TEXT_H_
#define STICTION_REPORTS_TEXT_PLAIN_TEXT_H_

#include <string>
#include <string_view>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/statistics.h"

namespace stiction {

inline constexpr std::size_t kTextWidth = 100;

// Words on lines of at most kTextWidth columns; a longer word stands on a line of its own, and
// what stands in brackets is one word. Each line begins with `indent` spaces and ends with a line feed.
// Characters that would steer a terminal become '?'.
std::string Paragraph(std::string_view text, std::size_t indent = 2);

// A title and the line below it.
std::string Heading(std::string_view title);

// A table: the first `names` columns to the left, the others to the right.
class TextTable {
 public:
  TextTable(std::vector<std::string> header, std::size_t names);
  void AddRow(std::vector<std::string> cells);  // as many as the header has
  // No rows: nothing.
  std::string Done() const;

 private:
  std::size_t names_;
  std::vector<std::vector<std::string>> rows_;  // the header first
};

// A value of a definition: texts without quotes, elements of arrays behind ", ".
std::string PlainValue(const Json& json);

// The policies of the runs: "the policy paper", "2 policies (paper, ties=contacts)", "1536 policies"; empty:
// no runs.
std::string PoliciesText(const Record& record);

// A word as a shell reads it back.
std::string ShellWord(const std::string& word);

}  // namespace stiction

#endif  // STICTION_REPORTS_TEXT_PLAIN_TEXT_H_
