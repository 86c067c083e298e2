// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction`: one verb per task. As a whole it links GPL parts of CGAL and is under the GPLv3.

#include "cli/help.h"
#include "cli/program.h"
#include "cli/verbs.h"
#include "cli/version.h"

namespace {

int Main(int argc, char** argv) {
  using namespace stiction;
  CommandLine program("stiction: does Baraff's algorithm for contact forces with static friction always end?",
                      "stiction " + BuildId(), kExitCodes);
  program.group = "Search";
  AddSearch(program);
  AddStatus(program);
  AddReport(program);
  AddMerge(program);
  AddSlurm(program);
  AddProblem(program);
  AddRecords(program);
  program.group = "One problem";
  AddSolve(program);
  AddReplay(program);
  AddCertify(program);
  AddCheck(program);
  AddMinimize(program);
  AddSurvey(program);
  program.group = "Scenes and other programs' files";
  AddAssemble(program);
  AddSimulate(program);
  AddDraw(program);
  AddImport(program);
  AddExport(program);
  program.group = "About stiction";
  AddMethods(program);
  AddPolicies(program);
  AddWords(program);
  AddBench(program);
  AddManual(program);
  return program.Run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) { return stiction::RunProgram(argc, argv, Main); }
