// SPDX-License-Identifier: Apache-2.0
// Bytes as text that a page can carry.

#pragma once

#include <string>

namespace stiction {

// Bytes deflated (RFC 1950), as base64: what is long. web/src/packed.js unpacks it.
std::string Packed(const std::string& plain);

}  // namespace stiction
