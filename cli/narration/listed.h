// SPDX-License-Identifier: Apache-2.0
// The methods and the policies as data.

#ifndef STICTION_CLI_NARRATION_LISTED_H_
#define STICTION_CLI_NARRATION_LISTED_H_

#include <array>

#include "corpus/json_text.h"
#include "solver/problem/options.h"

namespace stiction {

inline constexpr std::array kShownArithmetics = {
    Arithmetic::kFloat,    Arithmetic::kDouble,   Arithmetic::kLongDouble, Arithmetic::kQuad,
    Arithmetic::kInterval, Arithmetic::kFiltered, Arithmetic::kExact};

// What `methods --json` and `policies --json` print.
Json MethodsToJson();
Json PoliciesToJson();

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_LISTED_H_
