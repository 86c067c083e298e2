// SPDX-License-Identifier: Apache-2.0
// InputError: what came from outside is wrong, and only its author can mend it.

#pragma once

#include <stdexcept>
#include <string>

namespace stiction {

// what() reads "FILE: JSON PATH: found ..., expected ...".
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::string& file, const std::string& path, const std::string& found,
             const std::string& expected)
      : std::runtime_error(file + ": " + path + ": found " + found + ", expected " + expected) {}
};

}  // namespace stiction
