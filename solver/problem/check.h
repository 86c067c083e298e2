// SPDX-License-Identifier: Apache-2.0
// Our own invariants: a broken one is a bug of stiction, never of its input.

#pragma once

#include <stdexcept>
#include <string>

namespace stiction {

class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace stiction

// What cannot be reached.
#define STICTION_FAIL(message) \
  throw ::stiction::InternalError(std::string(__FILE__) + ":" + std::to_string(__LINE__) + ": " + (message))

// Always on.
#define STICTION_CHECK(condition, message)    \
  do {                                        \
    if (!(condition)) STICTION_FAIL(message); \
  } while (false)

// For costly invariants: on in Debug builds and with STICTION_ASSERTS.
#if !defined(NDEBUG) || defined(STICTION_ASSERTS)
#define STICTION_ASSERT(condition, message) STICTION_CHECK(condition, message)
#else
#define STICTION_ASSERT(condition, message) \
  do {                                      \
  } while (false)
#endif
