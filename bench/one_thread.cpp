// SPDX-License-Identifier: Apache-2.0
#include "bench/one_thread.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "corpus/input_error.h"

namespace stiction {

void RequireOneThread(char** argv) {
  const auto is_one = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::string_view(value) == "1";
  };
  if (std::all_of(kThreadVariables.begin(), kThreadVariables.end(), is_one)) return;
  for (const char* variable : kThreadVariables) setenv(variable, "1", 1);
  execv("/proc/self/exe", argv);
  throw InputError(fmt::format("{}: cannot be started anew: {}", argv[0], std::strerror(errno)));
}

}  // namespace stiction
