// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/record.h"

#include "corpus/json.h"
#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr int kMostRowsChecked = 4;
constexpr Limits kLimits = {50, 500, 4096};

}  // namespace

bool FuzzRecord(std::string_view bytes) {
  const auto record = Unrefused([bytes] { return ParseFrontierRecord(bytes, "input"); });
  if (!record) return false;
  if (record->problem.problem.rows() > kMostRowsPrinted) return true;
  const Json json = Json::parse(bytes);
  STICTION_CHECK(json["frontier"] == record->frontier && json["what"] == record->what &&
                     json["command"] == record->command && json["random"]["command"] == record->random_command,
                 "a text that is not read");
  const std::string text = Print(*record);
  const FrontierRecord again = ParseFrontierRecord(text, "what was written");
  STICTION_CHECK(IsSame(again.problem.problem, record->problem.problem), "a record of another problem");
  STICTION_CHECK(again.value == record->value && again.bounds == record->bounds &&
                     again.random_value == record->random_value && *again.certificate == *record->certificate,
                 "a record that is read back to another");
  STICTION_CHECK(Print(again) == text, "a text that is written differently once it is read");
  // What needs another process, or a run of every policy, takes too long here.
  const bool quick = record->objective->name != "ipopt" && record->objective->name != "policies";
  if (quick && record->problem.problem.rows() <= kMostRowsChecked) (void)FaultOf(*record, kLimits);
  return true;
}

}  // namespace stiction::fuzz
