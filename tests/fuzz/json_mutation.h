// SPDX-License-Identifier: Apache-2.0
// JSON that stays JSON when it is changed: what random bytes hardly ever make.

#pragma once

#include <string>
#include <string_view>

#include "search/generators/choices.h"

namespace stiction::fuzz {

// The document with one to three places of it changed: a value in the place of another, a number near the one
// that stood there, a copy, a copy of another place, a member gone. A string that is JSON itself may be changed
// inside. Text that is no JSON comes back as it is.
std::string MutatedJson(std::string_view text, Choices& choices);

}  // namespace stiction::fuzz
