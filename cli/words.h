// SPDX-License-Identifier: Apache-2.0
// The words of answers and replays, in one table: what `stiction words`, the man page and the end of a replay
// say.

#ifndef STICTION_CLI_WORDS_H_
#define STICTION_CLI_WORDS_H_

#include <span>
#include <string>
#include <string_view>

namespace stiction {

struct Word {
  std::string_view name;
  std::string_view meaning;
  std::string_view source;  // a section of the paper, or a page of stiction; empty: neither
};

std::span<const Word> AllWords();

// The meanings of the words that stand in a text, a line or more each, in the order of the table.
std::string GlossaryOf(std::string_view text);

}  // namespace stiction

#endif  // STICTION_CLI_WORDS_H_
