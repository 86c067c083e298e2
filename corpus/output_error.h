// SPDX-License-Identifier: Apache-2.0
// OutputError: what is to be written cannot be. The disk is full, or the place does not let us write.

#pragma once

#include <stdexcept>
#include <string>
#include <system_error>

namespace stiction {

// what() reads "FILE: cannot be written (REASON)".
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& message) : std::runtime_error(message) {}
  OutputError(const std::string& file, const std::string& reason)
      : std::runtime_error(file + ": cannot be written (" + reason + ")") {}
  // `error`: of errno.
  OutputError(const std::string& file, int error) : OutputError(file, std::generic_category().message(error)) {}
};

}  // namespace stiction
