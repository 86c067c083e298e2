// SPDX-License-Identifier: Apache-2.0
// Pages that the build has joined (web/join.py), and that the program fills.

#ifndef STICTION_REPORTS_HTML_TEMPLATE_H_
#define STICTION_REPORTS_HTML_TEMPLATE_H_

#include <map>
#include <string>
#include <string_view>

#include "reports/html/html.h"

namespace stiction {

// The page with each mark, {{NAME}}, replaced. InternalError if one does not stand there exactly once.
std::string FilledTemplate(std::string_view page, const std::map<std::string, Html>& marks);

}  // namespace stiction

#endif  // STICTION_REPORTS_HTML_TEMPLATE_H_
