// SPDX-License-Identifier: Apache-2.0
#include "reports/text/plain_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr std::size_t kIndent = 2, kGap = 2;  // of tables

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

}  // namespace

std::string Paragraph(std::string_view text, std::size_t indent) {
  std::string lines, line;
  const auto end_line = [&] {
    if (!line.empty()) lines += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  const std::string all = Harmless(text);
  for (std::size_t at = all.find_first_not_of(' '); at < all.size(); at = all.find_first_not_of(' ', at)) {
    const std::size_t end = EndOfWord(all, at);
    const std::string word = all.substr(at, end - at);
    if (indent + Columns(line) + 1 + Columns(word) > kTextWidth) end_line();
    line += (line.empty() ? "" : " ") + word;
    at = end;
  }
  end_line();
  return lines;
}

std::string Heading(std::string_view title) {
  const std::string shown = Harmless(title);
  return shown + "\n" + std::string(Columns(shown), '-') + "\n";
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
  std::string text;
  for (const auto& row : rows_) {
    std::string line(kIndent, ' ');
    for (std::size_t i = 0; i < row.size(); ++i)
      line += std::string(i == 0 ? 0 : kGap, ' ') + Padded(row[i], widths[i], i < names_);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string PlainValue(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  if (!json.is_array()) return JsonText(json);
  std::vector<std::string> parts;
  for (const Json& element : json) parts.push_back(PlainValue(element));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string PoliciesText(const Record& record) {
  constexpr std::size_t kMostNamed = 3;
  std::set<std::string> policies;
  for (const auto& [key, tally] : record.tallies) policies.insert(key.policy);
  if (policies.empty()) return "";
  if (policies.size() == 1) return "the policy " + *policies.begin();
  const std::string all = fmt::format("{} policies", policies.size());
  return policies.size() <= kMostNamed ? fmt::format("{} ({})", all, fmt::join(policies, ", ")) : all;
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
