// SPDX-License-Identifier: Apache-2.0
// The words of answers and replays, in one table, words.json: what `stiction words`, the man page and the end
// of a replay say.

#pragma once

#include <string>
#include <string_view>

#include "corpus/json_text.h"

namespace stiction {

// Rows {"word", "meaning", "source"}: a section of the paper, a page of stiction, or empty.
const Json& AllWords();

// The meaning of a row, with its source in brackets.
std::string MeaningOf(const Json& word);

// The meanings of the words that stand in a text, a line or more each, in the order of the table.
std::string GlossaryOf(std::string_view text);

}  // namespace stiction
