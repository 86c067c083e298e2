// SPDX-License-Identifier: Apache-2.0
// What is wrong with something that was stated, as a witness: where, what was found there, what was expected.

#pragma once

#include <string>

namespace stiction {

struct Rejected {
  std::string path, found, expected;
};

}  // namespace stiction
