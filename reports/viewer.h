// SPDX-License-Identifier: Apache-2.0
// The replay viewer: one page that needs nothing else, in which a reader steps through runs on a problem.
//
// The page is bundled ahead of time (web/), and embedded into the program; here it gets its title and its data.

#ifndef STICTION_REPORTS_VIEWER_H_
#define STICTION_REPORTS_VIEWER_H_

#include <string>

#include "corpus/json_text.h"

namespace stiction {

// `data`: web/README.md has its keys.
std::string ViewerPage(const std::string& title, const Json& data);

}  // namespace stiction

#endif  // STICTION_REPORTS_VIEWER_H_
