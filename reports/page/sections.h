// SPDX-License-Identifier: Apache-2.0
// What is told (told/told.h), as HTML.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/html/html.h"
#include "reports/told/told.h"

namespace stiction {

// What a page alone shows, by the name of its place.
using Places = std::map<std::string, Html>;

// The sections that have parts for the medium; the numbers of figures are files of `folder`.
Html SectionsToHtml(const Told& told, const std::string& medium, const Places& places = {},
                    const std::string& folder = "figures/");
// Their parts alone: of a head, "index-lead", in which the first sentences are larger.
Html PartsToHtml(const Told& told, const std::string& medium);
// A link to each section, in `page`.
Html LinksTo(const Told& told, const std::string& medium, const std::string& page = "");

// {"NAME": {"columns": [...], "rows": [[...], ...]}, ...} of those that have a place in the medium.
SharedJson FiguresToJson(const std::vector<Table>& figures, const Told& told, const std::string& medium);

}  // namespace stiction
