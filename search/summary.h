// SPDX-License-Identifier: Apache-2.0
// A store in a few lines, for the end of a search.

#ifndef STICTION_SEARCH_SUMMARY_H_
#define STICTION_SEARCH_SUMMARY_H_

#include <string>

#include "corpus/store.h"

namespace stiction {

Json SummaryToJson(const Store& store);
// `file` is named in the commands that it proposes.
std::string SummaryText(const Store& store, const std::string& file);

}  // namespace stiction

#endif  // STICTION_SEARCH_SUMMARY_H_
