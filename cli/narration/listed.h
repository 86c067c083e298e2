// SPDX-License-Identifier: Apache-2.0
// The methods and the policies as data.

#pragma once

#include "corpus/json_text.h"

namespace stiction {

// What `methods --json` and `policies --json` print.
SharedJson MethodsToJson();
SharedJson PoliciesToJson();

}  // namespace stiction
