// SPDX-License-Identifier: Apache-2.0
#include "corpus/text_template.h"

#include <regex>
#include <sstream>
#include <vector>

namespace stiction {
namespace {

std::string FilledLine(const std::string& line, const Blanks& blanks) {
  static const std::regex place(R"(@(?:([A-Z_]+)|([a-z_-]+)\?([^|@]*)\|([^@]*))@)");
  std::string filled;
  auto rest = line.begin();
  for (std::sregex_iterator at(line.begin(), line.end(), place); at != std::sregex_iterator(); ++at) {
    const std::smatch& match = *at;
    filled.append(rest, match[0].first);
    filled += match[1].matched                  ? blanks.places.at(match[1])
              : blanks.words.contains(match[2]) ? match[3].str()
                                                : match[4].str();
    rest = match[0].second;
  }
  return filled.append(rest, line.end()) + "\n";
}

}  // namespace

std::string Filled(std::span<const unsigned char> bytes, const Blanks& blanks) {
  std::string filled;
  std::vector<bool> stays = {true};  // what stands in each block that is open
  std::istringstream lines(std::string(bytes.begin(), bytes.end()));
  for (std::string line, word; std::getline(lines, line);) {
    if (line.starts_with("@if ")) {
      bool holds = stays.back();
      for (std::istringstream words(line.substr(4)); words >> word;)
        holds = holds && blanks.words.contains(word.substr(word[0] == '!')) == (word[0] != '!');
      stays.push_back(holds);
    } else if (line == "@else") {
      stays.back() = !stays.back() && stays[stays.size() - 2];
    } else if (line == "@end") {
      stays.pop_back();
    } else if (stays.back() && !line.starts_with("@ ")) {
      filled += FilledLine(line, blanks);
    }
  }
  return filled;
}

}  // namespace stiction
