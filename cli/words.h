// SPDX-License-Identifier: Apache-2.0
// The words of answers and replays, in one table: what `stiction words`, the man page and the end of a replay
// say.

#ifndef STICTION_CLI_WORDS_H_
#define STICTION_CLI_WORDS_H_

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stiction {

struct Word {
  std::string_view name;
  std::string_view meaning;
  std::string_view source;  // a section of the paper, or a page of stiction; empty: neither
};

std::span<const Word> AllWords();

// The meanings of some words, a line or more each, in the order of the table; std::logic_error for a name that
// it lacks.
std::string Glossary(const std::vector<std::string_view>& names);

}  // namespace stiction

#endif  // STICTION_CLI_WORDS_H_
