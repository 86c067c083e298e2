// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/output_error.h"

namespace stiction {

int RunProgram(int argc, char** argv, int (*run)(int argc, char** argv)) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of write
  try {
    const int status = run(argc, argv);
    std::cout.flush();
    if (!std::cout || std::ferror(stdout) != 0 || std::fflush(stdout) != 0) {
      throw OutputError("standard output cannot be written");
    }
    return status;
  } catch (const InputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return kExitBadInput;
  } catch (
      const std::filesystem::filesystem_error& error) {  // of a path that was given, and cannot be looked at
    std::cerr << "stiction: " << error.path1().string() << ": " << error.code().message() << "\n";
    return kExitBadInput;
  } catch (const OutputError& error) {
    std::cerr << "stiction: " << error.what() << "\n";
    return kExitDisk;
  } catch (const std::bad_alloc&) {
    std::cerr << "stiction: limit: out of memory\n";
    return kExitUndecided;
  } catch (const std::exception& error) {
    std::cerr << "stiction: internal error: " << error.what() << "\n";
    return kExitInternal;
  }
}

}  // namespace stiction
