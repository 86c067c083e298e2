// SPDX-License-Identifier: Apache-2.0
// Numbers of files, exactly: what problem files and scene files accept.

#ifndef STICTION_CORPUS_EXACT_NUMBER_H_
#define STICTION_CORPUS_EXACT_NUMBER_H_

#include "corpus/json_text.h"

namespace stiction {

// A string is exact, a JSON number is taken at its double value; anything else is refused. Strict: strings
// only.
Rational ExactNumber(const JsonPlace& place, bool strict = false);

}  // namespace stiction

#endif  // STICTION_CORPUS_EXACT_NUMBER_H_
