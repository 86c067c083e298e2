// SPDX-License-Identifier: Apache-2.0
#include "answers/problem_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "answers/narrate_text.h"

namespace stiction {

std::string AlignedTable(const Cells& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t j = 0; j < row.size(); ++j) widths[j] = std::max(widths[j], row[j].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("  {:{}}", row[0], widths[0]);
    for (std::size_t j = 1; j < row.size(); ++j) text += fmt::format("  {:>{}}", row[j], widths[j]);
    text += "\n";
  }
  return text;
}

namespace {

constexpr int kMostRows = 24;

std::string FrictionText(const ExactProblem& problem, FractionText fractions) {
  std::string text;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    const bool rubs = contact.kind == ContactKind::kStatic || contact.kind == ContactKind::kSliding;
    text += fmt::format("{}contact {} {}", i == 0 ? "  " : ", ", i + 1,
                        rubs ? "mu = " + Text(contact.mu, fractions) : std::string(Name(contact.kind)));
  }
  return text + "\n";
}

}  // namespace

std::string ProblemText(const ExactProblem& problem, FractionText fractions) {
  const int rows = static_cast<int>(problem.rows());
  if (rows == 0) return "The problem has no contact.\n";
  if (rows > kMostRows) return fmt::format("The problem a = A f + b has {} rows: see its file.\n", rows);
  const VariableTexts names(problem);
  Cells cells = {{"a = A f + b"}};
  for (int j = 0; j < rows; ++j) cells[0].push_back("f_" + names.Component(j));
  cells[0].emplace_back("b");
  for (int i = 0; i < rows; ++i) {
    auto& row = cells.emplace_back(std::vector<std::string>{"  a_" + names.Component(i)});
    for (int j = 0; j < rows; ++j) row.push_back(Text(problem.A(i, j), fractions));
    row.push_back(Text(problem.b[i], fractions));
  }
  return "The problem:\n" + AlignedTable(cells) + FrictionText(problem, fractions) + "\n";
}

}  // namespace stiction
