// SPDX-License-Identifier: Apache-2.0
// Bytes as text that a page can carry.

#ifndef STICTION_REPORTS_HTML_PACKED_H_
#define STICTION_REPORTS_HTML_PACKED_H_

#include <cstdint>
#include <string>
#include <vector>

namespace stiction {

std::string Base64(const std::vector<std::uint8_t>& bytes);

// The text deflated (RFC 1950), as base64: what is long and asked for later. web/src/packed.js unpacks it.
std::string Packed(const std::string& text);

}  // namespace stiction

#endif  // STICTION_REPORTS_HTML_PACKED_H_
