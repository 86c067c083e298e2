// SPDX-License-Identifier: Apache-2.0
// stiction methods: the table of methods, as the program reads it.

#include <fmt/format.h>

#include <iostream>

#include "certify/request/solve_in.h"
#include "cli/command_line.h"
#include "cli/narration/listed.h"
#include "corpus/exit_code.h"
#include "corpus/plain_text.h"

namespace stiction {
namespace {

// "plane space", "plane", "space" or "-".
std::string WhereBuilt(const MethodFacts& facts, Arithmetic arithmetic) {
  const bool plane = facts.IsBuilt(2, arithmetic), space = facts.IsBuilt(3, arithmetic);
  if (plane && space) return "plane, space";
  return plane ? "plane" : space ? "space" : "-";
}

std::string Table() {
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

std::string Facts() {
  std::string text;
  for (const MethodFacts& facts : AllMethods())
    text += fmt::format("\n{}\n  {}\n  source: {}\n  what its end proves: {}\n", facts.name, facts.title,
                        facts.source, facts.ends);
  return text;
}

int List(const bool& json) {
  std::cout << (json ? JsonText(MethodsToJson()) + "\n" : Table() + Folded(Facts()));
  return kExitDone;
}

}  // namespace

const ListedVerb kMethodsVerb("Solve", 40, [](CommandLine& program) {
  auto [verb, json] =
      program.Add("methods", "The methods, what their ends prove, and where they are built", List);
  verb.Prints(json, "the methods, and in which arithmetics they are built", R"([{
      name: method, title: text, source: text,
      ends: text,  // what its end proves
      path: truth,  // whether it can be replayed
      plane: [arithmetic], space: [arithmetic]}])");
});

}  // namespace stiction
