// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction`: one verb per task. As a whole it links GPL parts of CGAL and is under the GPLv3.

#include <cstdio>
#include <exception>
#include <iostream>

#include "cli/verbs.h"
#include "solver/problem/check.h"

namespace {

constexpr const char* kFooter =
    "Exit: 0 done; 1 not solved, rejected, or not as expected; 2 bad usage or input; 3 undecided or a limit; "
    "70 a bug.";

int Main(int argc, char** argv) {
  CLI::App program{"stiction: does Baraff's algorithm for contact forces with static friction always end?"};
  program.require_subcommand(1);
  program.footer(kFooter);
  stiction::Action action;
  using namespace stiction;
  AddSearch(program, action);
  AddReplay(program, action);
  AddReport(program, action);
  AddSolve(program, action);
  AddCertify(program, action);
  AddCheck(program, action);
  AddMinimize(program, action);
  AddStatus(program, action);
  AddMerge(program, action);
  AddProblem(program, action);
  AddImport(program, action);
  AddExport(program, action);
  AddSurvey(program, action);
  AddAssemble(program, action);
  AddSimulate(program, action);
  AddDraw(program, action);
  AddPolicies(program, action);
  AddMethods(program, action);
  AddBench(program, action);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kExitDone : kExitBadInput;
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int status = Main(argc, argv);
    std::cout.flush();
    if (!std::cout || std::ferror(stdout) != 0 || std::fflush(stdout) != 0) {
      throw stiction::InputError("standard output cannot be written");
    }
    return status;
  } catch (const stiction::InputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return stiction::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "stiction: internal error: " << error.what() << "\n";
    return stiction::kExitInternal;
  }
}
