// SPDX-License-Identifier: Apache-2.0
// The replay viewer: one page that needs nothing else, in which a reader steps through runs on a problem.
//
// The build joins the page (web/) and embeds it into the program; here it gets its title and its data.

#pragma once

#include <string>

#include "corpus/json_text.h"

namespace stiction {

// What makes the page again where it lies alone. Not the commit: a page that is kept beside the sources could
// not name its own.
struct ViewerOrigin {
  std::string command;      // as a shell reads it
  std::string version;      // of the program
  std::string digest;       // of the problem (corpus/record/digest.h)
  std::string report = {};  // the page of the report that it belongs to; empty: it stands alone
};

// What a page plays.
struct Playable {
  SharedJson data;
  ViewerOrigin origin;
};

// `data`: web/data.md has its keys.
std::string ViewerPage(const std::string& title, const Json& data, const ViewerOrigin& origin);

}  // namespace stiction
