// SPDX-License-Identifier: Apache-2.0
// Claims of certificates, decided anew.

#pragma once

#include <string>

#include "corpus/json_text.h"

namespace stiction::fuzz {

// What is false of the claim of a certificate, as those decide it that make certificates: none of them reads a
// witness. Empty if the claim is true, if it is not one of those that are decided here, or if the problem is
// too large for that. Requires a certificate of the right form.
std::string FaultOfClaim(const Json& certificate);

}  // namespace stiction::fuzz
