// SPDX-License-Identifier: Apache-2.0
// Text for people: paragraphs and tables that fit the terminal.

#pragma once

#include <unistd.h>

#include <string>
#include <string_view>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

inline constexpr std::size_t kUsualTextWidth = 80;  // of pipes and files

// Columns of what the descriptor leads to: the variable COLUMNS; without it those of the terminal;
// kUsualTextWidth where there is none. From 40 to 200.
std::size_t TextWidth(int descriptor = STDOUT_FILENO);

// As long as it lives TextWidth() is this in its thread: for files, which are as wide everywhere.
class FixedTextWidth {
 public:
  explicit FixedTextWidth(std::size_t width);
  ~FixedTextWidth();
  FixedTextWidth(const FixedTextWidth&) = delete;
  FixedTextWidth& operator=(const FixedTextWidth&) = delete;

 private:
  std::size_t before_;
};

// Words on lines of at most TextWidth(), or 100, columns; a longer word stands on a line of its own, and
// what stands in brackets is one word. Each line begins with `indent` spaces and ends with a line feed.
// Characters that would steer a terminal become '?'.
std::string Paragraph(std::string_view text, std::size_t indent = 2);

// Lines as they are, but for those that are wider than `width`: these go on below, where their last column
// begins (behind two blanks) if that is in their left two thirds.
std::string Folded(std::string_view lines, std::size_t width = TextWidth());

// A title and the line below it.
std::string Heading(std::string_view title);

// A table: the first `names` columns to the left, the others to the right. What does not fit beside the names
// stands below, in another table with the same names.
class TextTable {
 public:
  TextTable(std::vector<std::string> header, std::size_t names);
  void AddRow(std::vector<std::string> cells);  // as many as the header has
  // No rows: nothing.
  std::string Done() const;

 private:
  std::string Part(std::size_t first, std::size_t last, const std::vector<std::size_t>& widths) const;

  std::size_t names_;
  std::vector<std::vector<std::string>> rows_;  // the header first
};

// A word as a shell reads it back.
std::string ShellWord(const std::string& word);

}  // namespace stiction
