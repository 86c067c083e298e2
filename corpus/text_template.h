// SPDX-License-Identifier: Apache-2.0
// Texts with places to fill in, which the build embeds:
//
//   @PLACE@               its text
//   @word?TEXT|OTHER@     TEXT where the word holds, otherwise OTHER
//   @if word !word        a line of its own: what follows stays where all hold (!: does not hold), up to
//   @else, @end           these; blocks may stand in blocks
//   @ ...                 a remark, which is left out
//
// Any other @ is itself.

#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

namespace stiction {

// What is filled in.
struct Blanks {
  std::map<std::string, std::string> places;
  std::set<std::string> words = {};  // that hold
};

// std::out_of_range for a place that has no text.
std::string Filled(std::span<const unsigned char> bytes, const Blanks& blanks);

}  // namespace stiction
