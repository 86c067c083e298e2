// SPDX-License-Identifier: Apache-2.0
// The methods and the policies as data.

#ifndef STICTION_CLI_NARRATION_LISTED_H_
#define STICTION_CLI_NARRATION_LISTED_H_

#include "corpus/json_text.h"

namespace stiction {

// What `methods --json` and `policies --json` print.
SharedJson MethodsToJson();
SharedJson PoliciesToJson();

}  // namespace stiction

#endif  // STICTION_CLI_NARRATION_LISTED_H_
