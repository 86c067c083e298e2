// SPDX-License-Identifier: Apache-2.0
// What a store says, as plain text of at most 100 columns: what matters most first, in words that need no
// glossary. The end of a search and `report --text` say it with the same sentences.

#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "corpus/store/store.h"

namespace stiction {

// The case of the corpus that shows a loop of this signature; empty if there is none.
using KnownCase = std::function<std::string_view(std::string_view signature)>;

// Both require a store of problems that were drawn at random: a search with an objective has no rates. `file`
// is named in the commands that they propose.

// A screen: loops, other failures, existence, doubles, what the numbers are worth, the simplest loops.
std::string SummaryText(const Store& store, const std::string& file);
// How much of it a page says.
enum class Extent { kTwoScreens, kAll };

// A page: the same, with rates, the loops that are new, the simplest loop in numbers, what was searched, and
// commands that replay it. Two screens, at most 100 lines of 80 columns: rates are by generator, under the
// policy paper or the first, and of the campaign stands what makes its problems. All: rates are by contacts and
// friction, too, under every policy, and the campaign is told in full.
std::string TextReport(const Store& store, const std::string& file, const KnownCase& known_as,
                       Extent extent = Extent::kAll);

}  // namespace stiction
