// SPDX-License-Identifier: Apache-2.0
// stiction-peers: stiction beside the solvers of other packages, on the same problems in the same run. A
// program of its own, so that stiction is not linked with these packages.

#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/peers_suite.h"

namespace stiction {
namespace {

int RunPeers(const PeersOptions& o) {
  Json results = Json::array();
  for (const std::string& name : o.tables) {
    if (name != "growth") {
      results.push_back(MeasureTable(name, o));
      continue;
    }
    for (const bool friction : {false, true}) results.push_back(MeasureGrowth(friction, o));
  }
  if (o.json) std::cout << JsonText({{"seed", o.seed}, {"tables", results}}) << "\n";
  return 0;
}

}  // namespace
}  // namespace stiction

int main(int argc, char** argv) {
  stiction::PeersOptions o;
  CLI::App program("stiction beside the solvers of other packages", "stiction-peers");
  std::vector<std::string> tables = stiction::PeerTableNames();
  tables.push_back("growth");
  o.tables = tables;
  program.add_option("--table", o.tables, "tables to measure")
      ->capture_default_str()
      ->check(CLI::IsMember(tables));
  program.add_option("--contacts", o.contacts, "numbers of contacts, instead of each table's own")
      ->check(CLI::Range(1, 2000));
  program.add_option("--problems", o.problems, "of a size; half and an eighth of it above 10 and 30 contacts")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  program.add_option("--seconds", o.seconds, "time for each row and size")->capture_default_str();
  program.add_option("--cap", o.cap, "a row that needs more seconds for one problem shows '-'")
      ->capture_default_str();
  program.add_option("--seed", o.seed, "of the problems")->capture_default_str();
  program.add_flag("--json", o.json, "machine output");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  return stiction::RunPeers(o);
}
