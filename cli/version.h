// SPDX-License-Identifier: Apache-2.0
// What this build was made of.

#pragma once

#include <string>

namespace stiction {

// "VERSION COMMIT, COMPILER BUILD_TYPE, FLAGS"
std::string BuildId();
std::string Version();

}  // namespace stiction
