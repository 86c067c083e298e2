// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/listed.h"

#include "certify/request/solve_in.h"
#include "corpus/json.h"
#include "solver/problem/options.h"

namespace stiction {

SharedJson MethodsToJson() {
  Json json = Json::array();
  for (const MethodFacts& facts : AllMethods()) {
    Json row = {{"name", facts.name},    {"title", facts.title},    {"source", facts.source},
                {"ends", facts.ends},    {"path", facts.HasPath()}, {"plane", Json::array()},
                {"space", Json::array()}};
    for (const Arithmetic arithmetic : kArithmetics) {
      if (facts.IsBuilt(2, arithmetic)) row["plane"].push_back(Name(arithmetic));
      if (facts.IsBuilt(3, arithmetic)) row["space"].push_back(Name(arithmetic));
    }
    json.push_back(std::move(row));
  }
  return json;
}

SharedJson PoliciesToJson() {
  Json rows = Json::array();
  for (const PolicySwitchRow& row : PolicySwitches()) {
    Json values = Json::array();
    for (const PolicyValue& value : row.values)
      values.push_back({{"value", value.name}, {"meaning", value.meaning}});
    rows.push_back({{"switch", row.name},
                    {"question", row.question},
                    {"reads", row.reads},
                    {"planar", row.planar},
                    {"values", values}});
  }
  return rows;
}

}  // namespace stiction
