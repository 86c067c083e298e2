// SPDX-License-Identifier: Apache-2.0
// The words of answers and replays, in one table, words.json: what `stiction words`, the man page and the end
// of a replay say.

#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stiction {

// Each word and its meaning, with the source in brackets: a section of the paper, or a page of stiction.
const std::vector<std::pair<std::string, std::string>>& AllWords();

// The meanings of the words that stand in a text, a line or more each, in the order of the table.
std::string GlossaryOf(std::string_view text);

}  // namespace stiction
