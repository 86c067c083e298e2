// SPDX-License-Identifier: Apache-2.0
// Numbers of files, exactly: what problem files and scene files accept.

#pragma once

#include "corpus/json_text.h"
#include "corpus/rational.h"

namespace stiction {

// Of a certificate, which comes from anywhere.
inline constexpr std::size_t kMostCharactersOfNumber = 40000;

// A string is exact, a JSON number is taken at its double value; anything else is refused, and a JSON number
// below the normal doubles, of which the double may have lost digits. Strict: strings only, of at most
// kMostCharactersOfNumber characters.
Rational ExactNumber(const JsonPlace& place, bool strict = false);

}  // namespace stiction
