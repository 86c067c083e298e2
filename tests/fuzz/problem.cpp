// SPDX-License-Identifier: Apache-2.0
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr std::size_t kMostTextReadAgain = 1 << 20;  // "1e10000" is short, and written in full

void RequireReadBack(const ProblemFile& file) {
  const std::string text = Print(file);
  if (text.size() > kMostTextReadAgain) return;
  const ProblemFile again = ParseProblem(text, "what was written");
  STICTION_CHECK(IsSame(again.problem, file.problem), "a problem that is read back to another");
  STICTION_CHECK(again.name == file.name && *again.scene == *file.scene && *again.origin == *file.origin &&
                     again.expect == file.expect,
                 "what stands beside a problem is read back to something else");
  STICTION_CHECK(Print(again) == text, "a text that is written differently once it is read");
}

template <class Scalar>
void RequireRoundedOnce(const ExactProblem& problem) {
  const auto rounded = Unrefused([&problem] { return Rounded<Scalar>(problem); });
  if (!rounded) return;
  const ExactProblem exact = Unrounded(*rounded);
  STICTION_CHECK(IsSame(Unrounded(Rounded<Scalar>(exact)), exact), "rounded numbers that are rounded again");
}

}  // namespace

bool FuzzProblem(std::string_view bytes) {
  const auto file = Unrefused([bytes] { return ParseProblem(bytes, "input"); });
  if (!file) return false;
  if (file->problem.rows() > kMostRowsPrinted) return true;
  RequireReadBack(*file);
  STICTION_CHECK(IsSame(DenseOf(file->problem.entries()), file->problem), "a sparse problem that is another");
  RequireRoundedOnce<float>(file->problem);
  RequireRoundedOnce<double>(file->problem);
  return true;
}

}  // namespace stiction::fuzz
