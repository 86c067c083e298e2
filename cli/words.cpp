// SPDX-License-Identifier: Apache-2.0
#include "cli/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <vector>

#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/words_json.h"
#include "corpus/exit_code.h"
#include "corpus/json_text.h"

namespace stiction {

namespace {

const JsonPlace& WordTable() {
  static const std::string source = "words";
  static const JsonPlace table({reinterpret_cast<const char*>(kWordsJson), sizeof kWordsJson}, source);
  return table;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& AllWords() {
  static const auto words = [] {
    std::vector<std::pair<std::string, std::string>> all;
    for (std::size_t i = 0; i < WordTable().Size("a list"); ++i) {
      const JsonPlace row = WordTable()[i];
      const auto text = [&row](const char* key) { return row.Required(key, "text").Text("text"); };
      const std::string source = text("source");
      all.emplace_back(text("word"), text("meaning") + (source.empty() ? "" : fmt::format(" ({})", source)));
    }
    return all;
  }();
  return words;
}

namespace {

// "start, period" -> both.
std::vector<std::string_view> NamesIn(std::string_view rest) {
  std::vector<std::string_view> names;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(", "), rest.size());
    names.push_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 2, rest.size()));
  }
  return names;
}

// Whether a word stands in a text by itself: NC does not in "NC+" nor in "_NC".
bool StandsIn(std::string_view text, std::string_view word) {
  const auto belongs = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-';
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !belongs(text[at - 1])) && (end == text.size() || !belongs(text[end]))) return true;
  }
  return false;
}

int List(const bool& in_json) {
  if (in_json) {
    std::cout << JsonText(WordTable().json()) << "\n";
    return kExitDone;
  }
  for (const auto& [word, meaning] : AllWords()) std::cout << HelpEntry(word, meaning);
  std::cout << "\nNumbers in brackets are sections of the paper.\n";
  return kExitDone;
}

}  // namespace

std::string GlossaryOf(std::string_view text) {
  std::string glossary;
  for (const auto& [word, meaning] : AllWords()) {
    const auto stands = [text](std::string_view name) { return StandsIn(text, name); };
    if (std::ranges::any_of(NamesIn(word), stands)) glossary += HelpEntry(word, meaning);
  }
  return glossary;
}

const ListedVerb kWordsVerb("Show", 30, [](CommandLine& program) {
  auto [verb, in_json] = program.Add("words", "What the words of answers and replays mean", List);
  verb.Prints(in_json, "what words mean", R"([{
      word: text, meaning: text,
      source: text  // a section of the paper, or a page here
    }])");
});

}  // namespace stiction
