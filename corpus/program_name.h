// SPDX-License-Identifier: Apache-2.0
// How commands in texts call the program: as whoever reads them called it.

#pragma once

#include <cstdlib>
#include <string>

namespace stiction {

// `stiction`, which is what an installed program is called; a script that stands before the program says its
// own name in STICTION_PROGRAM, ready for a shell.
inline std::string ProgramName() {
  const char* name = std::getenv("STICTION_PROGRAM");
  return name == nullptr || *name == '\0' ? "stiction" : name;
}

}  // namespace stiction
