// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction`: one verb per task. As a whole it links GPL parts of CGAL and is under the GPLv3.

#include "answers/version.h"
#include "cli/help.h"
#include "cli/program.h"
#include "cli/verbs.h"

namespace {

int Main(int argc, char** argv) {
  using namespace stiction;
  CommandLine program("stiction: does Baraff's algorithm for contact forces with static friction always end?",
                      "stiction " + BuildId(), kExitCodes);
  AddSearch(program);
  AddReplay(program);
  AddReport(program);
  AddSolve(program);
  AddCertify(program);
  AddCheck(program);
  AddMinimize(program);
  AddStatus(program);
  AddMerge(program);
  AddSlurm(program);
  AddProblem(program);
  AddRecords(program);
  AddImport(program);
  AddExport(program);
  AddSurvey(program);
  AddAssemble(program);
  AddSimulate(program);
  AddDraw(program);
  AddPolicies(program);
  AddMethods(program);
  AddBench(program);
  AddWords(program);
  AddManual(program);
  return program.Run(argc, argv);
}

}  // namespace

int main(int argc, char** argv) { return stiction::RunProgram(argc, argv, Main); }
