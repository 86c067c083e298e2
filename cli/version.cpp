// SPDX-License-Identifier: Apache-2.0
// A unit of its own, since every commit compiles it again.
#include "cli/version.h"

#include <fmt/format.h>

#include "build_id.h"

namespace stiction {

std::string Version() { return std::string(build_id::kVersion); }

std::string BuildId() {
  using namespace build_id;
  return fmt::format("{} {}, {} {}, {}", kVersion, kCommit, kCompiler, kBuildType, kFlags);
}

}  // namespace stiction
