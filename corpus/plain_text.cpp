// SPDX-License-Identifier: Apache-2.0
#include "corpus/plain_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr std::size_t kIndent = 2, kGap = 2;  // of tables
constexpr std::size_t kWidestParagraph = 100;

std::string Harmless(std::string_view text) {
  std::string harmless(text);
  std::replace_if(
      harmless.begin(), harmless.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return harmless;
}

// Of UTF-8.
std::size_t Columns(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

std::string Padded(const std::string& cell, std::size_t width, bool left) {
  const std::string space(width - Columns(cell), ' ');
  return left ? cell + space : space + cell;
}

// Of the word that begins at `at`: an interval, "[0.6, 17.9]", is not torn.
std::size_t EndOfWord(std::string_view text, std::size_t at) {
  const std::size_t end = std::min(text.find(' ', at), text.size());
  const std::size_t open = text.substr(at, end - at).find_last_of("[]");
  if (open == text.npos || text[at + open] == ']') return end;
  const std::size_t close = text.find(']', end);
  return close == text.npos ? end : std::min(text.find(' ', close), text.size());
}

thread_local std::size_t fixed_width = 0;  // 0: the terminal's

// Where a line that is folded goes on.
std::size_t HangingIndent(std::string_view line, std::size_t width) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  for (std::size_t at = std::min(2 * width / 3, line.size() - 1); at > begin + 2; --at) {
    if (line[at] != ' ' && line[at - 1] == ' ' && line[at - 2] == ' ') return at;
  }
  return begin + 2;
}

std::string FoldedLine(std::string_view line, std::size_t width) {
  const std::size_t indent = HangingIndent(line, width);
  std::string lines, part;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = EndOfWord(line, word);
    const std::string_view more = line.substr(at, end - at);  // with the blanks before it
    if (Columns(part) + Columns(more) > width && part.find_first_not_of(' ') != part.npos) {
      lines += part + "\n";
      part = std::string(indent, ' ') + std::string(line.substr(word, end - word));
    } else {
      part += more;
    }
    at = end;
  }
  return lines + part;
}

}  // namespace

FixedTextWidth::FixedTextWidth(std::size_t width) : before_(std::exchange(fixed_width, width)) {}
FixedTextWidth::~FixedTextWidth() { fixed_width = before_; }

std::size_t TextWidth(int descriptor) {
  if (fixed_width != 0) return fixed_width;
  constexpr std::size_t kLeast = 40, kMost = 200;
  std::size_t columns = 0;
  if (const char* const given = std::getenv("COLUMNS"); given != nullptr)
    std::from_chars(given, given + std::strlen(given), columns);
  if (winsize size{}; columns == 0 && ioctl(descriptor, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
  return columns == 0 ? kUsualTextWidth : std::clamp(columns, kLeast, kMost);
}

std::string Paragraph(std::string_view text, std::size_t indent) {
  const std::size_t width = std::min(TextWidth(), kWidestParagraph);
  std::string lines, line;
  const auto end_line = [&] {
    if (!line.empty()) lines += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  const std::string all = Harmless(text);
  for (std::size_t at = all.find_first_not_of(' '); at < all.size(); at = all.find_first_not_of(' ', at)) {
    const std::size_t end = EndOfWord(all, at);
    const std::string word = all.substr(at, end - at);
    if (indent + Columns(line) + 1 + Columns(word) > width) end_line();
    line += (line.empty() ? "" : " ") + word;
    at = end;
  }
  end_line();
  return lines;
}

std::string Folded(std::string_view lines, std::size_t width) {
  std::string folded;
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string_view line = lines.substr(0, end);
    folded += Columns(line) <= width ? std::string(line) : FoldedLine(line, width);
    if (end < lines.size()) folded += "\n";
    lines.remove_prefix(std::min(end + 1, lines.size()));
  }
  return folded;
}

std::string Heading(std::string_view title) {
  const std::string shown = Harmless(title);
  return Folded(shown) + "\n" + std::string(std::min(Columns(shown), TextWidth()), '-') + "\n";
}

TextTable::TextTable(std::vector<std::string> header, std::size_t names)
    : names_(names), rows_{std::move(header)} {}

void TextTable::AddRow(std::vector<std::string> cells) {
  STICTION_CHECK(cells.size() == rows_.front().size(), "a row has as many cells as its header");
  for (std::string& cell : cells) cell = Harmless(cell);
  rows_.push_back(std::move(cells));
}

std::string TextTable::Done() const {
  if (rows_.size() == 1) return "";
  std::vector<std::size_t> widths(rows_.front().size());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Columns(row[i]));
  }
  const std::size_t width = TextWidth();
  std::size_t names = kIndent;
  for (std::size_t i = 0; i < names_; ++i) names += widths[i] + kGap;
  std::string text;
  for (std::size_t first = names_; first < widths.size() || text.empty();) {
    std::size_t last = first, columns = names;
    while (last < widths.size() && (last == first || columns + widths[last] <= width))
      columns += widths[last++] + kGap;
    text += (text.empty() ? "" : "\n") + Part(first, last, widths);
    first = last;
  }
  return text;
}

// The names, and the columns from `first` to before `last`.
std::string TextTable::Part(std::size_t first, std::size_t last, const std::vector<std::size_t>& widths) const {
  std::string text;
  for (const auto& row : rows_) {
    std::string line(kIndent, ' ');
    for (std::size_t i = 0; i < last; ++i) {
      if (names_ <= i && i < first) continue;
      line += std::string(line.size() == kIndent ? 0 : kGap, ' ') + Padded(row[i], widths[i], i < names_);
    }
    text += Folded(line.substr(0, line.find_last_not_of(' ') + 1)) + "\n";
  }
  return text;
}

std::string ShellWord(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_=,@./").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace stiction
