// SPDX-License-Identifier: Apache-2.0
// The independent checkers of this folder, as texts: so that a data package can carry them along.

#pragma once

#include <map>
#include <string>

namespace stiction {

// Name -> text, of check_certificate.py and what it imports.
std::map<std::string, std::string> CheckerFiles();

}  // namespace stiction
