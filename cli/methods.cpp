// SPDX-License-Identifier: Apache-2.0
// stiction methods, policies: the table of methods, as the program reads it, and the readings of the published
// text.

#include <fmt/format.h>

#include <iostream>

#include "certify/request/solve_in.h"
#include "cli/command_line.h"
#include "cli/narration/listed.h"
#include "cli/shared.h"
#include "corpus/plain_text.h"

namespace stiction {
namespace {

// "plane space", "plane", "space" or "-".
std::string WhereBuilt(const MethodFacts& facts, Arithmetic arithmetic) {
  const bool plane = facts.IsBuilt(2, arithmetic), space = facts.IsBuilt(3, arithmetic);
  if (plane && space) return "plane, space";
  return plane ? "plane" : space ? "space" : "-";
}

std::string MethodTable() {
  std::vector<std::string> head = {"method"};
  for (const Arithmetic arithmetic : kArithmetics) head.emplace_back(Name(arithmetic));
  TextTable table(std::move(head), 1);
  std::size_t refused = 0;
  for (const MethodFacts& facts : AllMethods()) {
    std::vector<std::string> cells = {std::string(facts.name)};
    for (const Arithmetic arithmetic : kArithmetics) {
      cells.push_back(WhereBuilt(facts, arithmetic));
      for (const int dimension : {2, 3}) refused += !facts.IsBuilt(dimension, arithmetic);
    }
    table.AddRow(std::move(cells));
  }
  const std::size_t all = 2 * kArithmetics.size() * AllMethods().size();
  return table.Done() + fmt::format("\n{} of {} combinations are refused.\n", refused, all);
}

std::string MethodsInWords() {
  std::string text;
  for (const MethodFacts& facts : AllMethods())
    text += fmt::format("\n{}\n  {}\n  source: {}\n  what its end proves: {}\n", facts.name, facts.title,
                        facts.source, facts.ends);
  return text;
}

int ListMethods(const bool& json) {
  std::cout << (json ? JsonText(MethodsToJson()) + "\n" : MethodTable() + Folded(MethodsInWords()));
  return kExitDone;
}

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

const ListedVerb kMethodsVerb("Solve", 40, [](CommandLine& program) {
  auto [verb, json] =
      program.Add("methods", "The methods, what their ends prove, and where they are built", ListMethods);
  verb.Prints(json, "the methods, and in which arithmetics they are built", R"([{
      name: method, title: text, source: text,
      ends: text,  // what its end proves
      path: truth,  // whether it can be replayed
      plane: [arithmetic], space: [arithmetic]}])");
});

const ListedVerb kPoliciesVerb("Show", 20, [](CommandLine& program) {
  auto [verb, json] = program.Add("policies", "The policies: readings of the published text", ListPolicies);
  verb.Prints(json, "the switches of the policies", R"([{
      switch: text, question: text, planar: truth,
      reads: text,  // the sentence of the paper
      values: [{value: text, meaning: text}+]}])");
});

}  // namespace stiction
