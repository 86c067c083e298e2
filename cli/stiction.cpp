// SPDX-License-Identifier: GPL-3.0-or-later OR Apache-2.0
// The program `stiction`: one verb per task. As a whole it links GPL parts of CGAL and is under the GPLv3.

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "answers/version.h"
#include "cli/verbs.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/output_error.h"

namespace {

constexpr const char* kFooter =
    "Exit: 0 done; 1 not solved, rejected, or not as expected; 2 bad usage or input; 3 undecided or a limit; "
    "4 a search or merge holds a grave finding; 70 a bug; 74 the disk is full, or the output cannot be "
    "written.";

int Main(int argc, char** argv) {
  using namespace stiction;
  CommandLine program("stiction: does Baraff's algorithm for contact forces with static friction always end?",
                      "stiction " + BuildId(), kFooter);
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

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of write
  try {
    const int status = Main(argc, argv);
    std::cout.flush();
    if (!std::cout || std::ferror(stdout) != 0 || std::fflush(stdout) != 0) {
      throw stiction::OutputError("standard output cannot be written");
    }
    return status;
  } catch (const stiction::InputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return stiction::kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {  // of a path that was given, and cannot be looked at
    std::cerr << "stiction: " << error.path1().string() << ": " << error.code().message() << "\n";
    return stiction::kExitBadInput;
  } catch (const stiction::OutputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return stiction::kExitDisk;
  } catch (const std::bad_alloc&) {
    std::cerr << "stiction: limit: out of memory\n";
    return stiction::kExitUndecided;
  } catch (const std::exception& error) {
    std::cerr << "stiction: internal error: " << error.what() << "\n";
    return stiction::kExitInternal;
  }
}
