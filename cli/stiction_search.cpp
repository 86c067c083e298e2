// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction-search`: searches and their stores, which is all that `./run search` has to build.
// `stiction` has these verbs, too. As a whole it links GPL parts of CGAL and is under the GPLv3.

#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/program.h"
#include "cli/version.h"
#include "search/under_test/host.h"

namespace {

int Main(int argc, char** argv) {
  using namespace stiction;
  if (const auto exit = RunAsSolverHost(argc, argv)) return *exit;
  CommandLine program("stiction-search: the verbs of stiction that search, and tell what a search found",
                      "stiction " + BuildId(), kExitCodes);
  program.AddListed({"Find"});
  return program.Run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) { return stiction::RunProgram(argc, argv, Main); }
