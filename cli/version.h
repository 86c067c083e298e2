// SPDX-License-Identifier: Apache-2.0
// What this build was made of.

#ifndef STICTION_CLI_VERSION_H_
#define STICTION_CLI_VERSION_H_

#include <string>

namespace stiction {

// "VERSION COMMIT, COMPILER BUILD_TYPE, FLAGS"
std::string BuildId();
std::string Version();

}  // namespace stiction

#endif  // STICTION_CLI_VERSION_H_
