// SPDX-License-Identifier: Apache-2.0
// The scene of a finding, where it was found with one.

#pragma once

#include <string>

#include "corpus/store/store.h"
#include "reports/html/html.h"

namespace stiction {

// A figure of the scene as found, with its contacts; empty where there is none that can be drawn.
Html PictureOfFinding(const Finding& finding);
// The same as a file of its own.
std::string SvgOfFinding(const Finding& finding);

}  // namespace stiction
