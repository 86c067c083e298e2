// SPDX-License-Identifier: Apache-2.0
// stiction policies: the readings of the published text.

#include <iostream>

#include "cli/command_line.h"
#include "cli/narration/listed.h"
#include "cli/shared.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

int ListPolicies(const bool& json) {
  if (json) {
    std::cout << JsonText(PoliciesToJson()) << "\n";
    return kExitDone;
  }
  for (const PolicySwitchRow& row : PolicySwitches()) {
    Tell("{}: {}{}\n    {}\n", row.name, row.question, row.planar ? "" : " (not in the planar grid)",
         row.reads);
    for (const PolicyValue& value : row.values) Tell("    {:14}  {}\n", value.name, value.meaning);
  }
  Tell("The first value of each switch is the reference policy, 'paper'. Planar grid: {} policies.\n",
       PlanarGrid().size());
  return kExitDone;
}

}  // namespace

const ListedVerb kPoliciesVerb("Show", 20, [](CommandLine& program) {
  auto [verb, json] = program.Add("policies", "The policies: readings of the published text", ListPolicies);
  verb.Prints(json, "the switches of the policies", R"([{
      switch: text, question: text, planar: truth,
      reads: text,  // the sentence of the paper
      values: [{value: text, meaning: text}+]}])");
});

}  // namespace stiction
