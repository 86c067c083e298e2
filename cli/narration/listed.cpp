// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/listed.h"

#include "certify/request/solve_in.h"
#include "corpus/json_text.h"
#include "solver/problem/options.h"

namespace stiction {

SharedJson MethodsToJson() {
  std::vector<SharedJson> rows;
  for (const MethodFacts& facts : AllMethods()) {
    std::vector<std::string> plane, space;
    for (const Arithmetic arithmetic : kArithmetics) {
      if (facts.IsBuilt(2, arithmetic)) plane.emplace_back(Name(arithmetic));
      if (facts.IsBuilt(3, arithmetic)) space.emplace_back(Name(arithmetic));
    }
    rows.push_back({{"name", facts.name},
                    {"title", facts.title},
                    {"source", facts.source},
                    {"ends", facts.ends},
                    {"path", facts.HasPath()},
                    {"plane", plane},
                    {"space", space}});
  }
  return SharedJson(rows);
}

SharedJson PoliciesToJson() {
  std::vector<SharedJson> rows;
  for (const PolicySwitchRow& row : PolicySwitches()) {
    std::vector<SharedJson> values;
    for (const PolicyValue& value : row.values)
      values.push_back({{"value", value.name}, {"meaning", value.meaning}});
    rows.push_back({{"switch", row.name},
                    {"question", row.question},
                    {"reads", row.reads},
                    {"planar", row.planar},
                    {"values", values}});
  }
  return SharedJson(rows);
}

}  // namespace stiction
