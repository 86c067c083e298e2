// SPDX-License-Identifier: Apache-2.0
// The verbs of the program: each adds itself to the command line, and says how it ended by an exit code.

#ifndef STICTION_CLI_VERBS_H_
#define STICTION_CLI_VERBS_H_

#include "cli/command_line.h"

namespace stiction {

void AddSolve(CommandLine& program);
void AddReplay(CommandLine& program);
void AddCertify(CommandLine& program);
void AddCheck(CommandLine& program);
void AddMinimize(CommandLine& program);
void AddSearch(CommandLine& program);
void AddStatus(CommandLine& program);
void AddMerge(CommandLine& program);
void AddProblem(CommandLine& program);
void AddReport(CommandLine& program);
void AddSlurm(CommandLine& program);
void AddBench(CommandLine& program);
void AddImport(CommandLine& program);
void AddExport(CommandLine& program);
void AddSurvey(CommandLine& program);
void AddAssemble(CommandLine& program);
void AddSimulate(CommandLine& program);
void AddDraw(CommandLine& program);
void AddPolicies(CommandLine& program);
void AddMethods(CommandLine& program);
void AddRecords(CommandLine& program);
void AddWords(CommandLine& program);
void AddManual(CommandLine& program);

}  // namespace stiction

#endif  // STICTION_CLI_VERBS_H_
