// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/problem_text.h"

#include <fmt/format.h>

#include <vector>

#include "cli/narration/narrate_text.h"
#include "corpus/plain_text.h"

namespace stiction {

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
  std::vector<std::string> head = {"a = A f + b"};
  for (int j = 0; j < rows; ++j) head.push_back("f_" + names.Component(j));
  head.emplace_back("b");
  TextTable table(std::move(head), 1);
  for (int i = 0; i < rows; ++i) {
    std::vector<std::string> row = {"  a_" + names.Component(i)};
    for (int j = 0; j < rows; ++j) row.push_back(Text(problem.A(i, j), fractions));
    row.push_back(Text(problem.b[i], fractions));
    table.AddRow(std::move(row));
  }
  return "The problem:\n" + table.Done() + FrictionText(problem, fractions) + "\n";
}

}  // namespace stiction
