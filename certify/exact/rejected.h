// SPDX-License-Identifier: Apache-2.0
// What is wrong with something that was stated, as a witness: where, what was found there, what was expected.

#ifndef STICTION_CERTIFY_EXACT_REJECTED_H_
#define STICTION_CERTIFY_EXACT_REJECTED_H_

#include <string>

namespace stiction {

struct Rejected {
  std::string path, found, expected;
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_REJECTED_H_
