// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/record.h"

#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {

bool FuzzRecord(std::string_view bytes) {
  const auto record = Unrefused([bytes] { return ParseRecord(bytes, "input"); });
  if (!record) return false;
  if (record->problem.problem.rows() > kMostRowsPrinted) return true;
  const std::string text = Print(*record);
  const FrontierRecord again = ParseRecord(text, "what was written");
  STICTION_CHECK(IsSame(again.problem.problem, record->problem.problem), "a record of another problem");
  STICTION_CHECK(again.value == record->value && again.bounds == record->bounds &&
                     again.random_value == record->random_value && again.certificate == record->certificate,
                 "a record that is read back to another");
  STICTION_CHECK(Print(again) == text, "a text that is written differently once it is read");
  return true;
}

}  // namespace stiction::fuzz
