// SPDX-License-Identifier: Apache-2.0
// The only unit that knows CLI11, which is expensive to compile.

#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstring>
#include <iostream>
#include <map>

#include "cli/help.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/named_rows.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using AddVerbTo = void (*)(CommandLine&);

// By group and place.
std::multimap<std::pair<std::string_view, int>, AddVerbTo>& ListedVerbs() {
  static std::multimap<std::pair<std::string_view, int>, AddVerbTo> verbs;
  return verbs;
}

void AddRow(CLI::App& app, const OptionRow& row) {
  if (row.kind == RowKind::kFlag) {
    bool* const field = std::get<bool*>(row.field);
    const bool turned = !*field;
    app.add_flag_function(row.name, [field, turned](std::int64_t count) { *field = turned == (count > 0); })
        ->disable_flag_override();
    return;
  }
  CLI::Option* option = app.add_option(row.name, [&row](const CLI::results_t& words) {
    const std::string error = Take(row, words);
    if (!error.empty()) throw CLI::ValidationError(row.Spellings().back(), error);
    return true;
  });
  option->required(row.required);
  if (!row.needs.empty()) option->needs(app.get_option(row.needs));
  if (row.IsRepeated()) option->expected(CLI::detail::expected_max_vector_size);
}

void AddVerb(CLI::App& app, const Verb& verb) {
  CLI::App& added = *app.add_subcommand(verb.name, verb.purpose);
  added.formatter_fn([&verb](const CLI::App*, std::string, CLI::AppFormatMode) { return HelpOf(verb); });
  if (verb.rest != nullptr) {
    added.set_help_flag();
    added.prefix_command();
    return;
  }
  added.allow_extras();
  for (const OptionRow& row : verb.rows) AddRow(added, row);
}

std::string Suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = Nearest(word, names);
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

std::vector<std::string> OptionNames(const Verb& verb) {
  std::vector<std::string> names = {"--help"};
  for (const OptionRow& row : verb.rows) {
    if (row.kind != RowKind::kPositional) names.push_back(row.Spellings().back());
  }
  return names;
}

void RefuseUnknownVerb(const CommandLine& program, const std::string& word) {
  if (RowNamed(program.verbs, word) != nullptr) return;
  std::vector<std::string> names = NamesOf(program.verbs);
  names.insert(names.end(), {"help", "--help", "--version"});
  const std::string suggestion = Suggestion(word, names);
  throw InputError(fmt::format("found '{}', expected a verb{}", word,
                               suggestion.empty() ? "; stiction help lists them" : suggestion));
}

void RefuseUnknownWord(const Verb& verb, const std::string& word) {
  if (!word.starts_with("-") || word == "-")
    throw InputError(fmt::format("{}: found '{}', expected nothing more", verb.name, word));
  const std::string name = word.substr(0, word.find('='));
  const std::string suggestion = Suggestion(name, OptionNames(verb));
  throw InputError(
      fmt::format("{}: found {}, which is none of its options{}", verb.name, name,
                  suggestion.empty() ? fmt::format("; stiction help {} lists them", verb.name) : suggestion));
}

// One line, in the words of all other errors.
InputError Refused(const CommandLine& program, const CLI::ParseError& error, const std::string& verb) {
  constexpr const char* kOverride = " was given a disallowed flag override";  // a flag with a value
  std::string text = error.what();
  if (const auto* missing = dynamic_cast<const CLI::RequiredError*>(&error); missing != nullptr) {
    text = fmt::format("found no {}, expected it; stiction help {} says what it is",
                       text.substr(0, text.find(' ')), verb);
  } else if (text.ends_with(kOverride)) {
    text = "--" + text.substr(0, text.size() - std::strlen(kOverride)) +
           ": found a value behind it, expected none";
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    text = text.substr(0, text.find(':')) + ": found nothing behind it, expected a value";
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::string words = text.substr(text.find(": ") + 2);
    text = fmt::format("found '{}', expected nothing more", words.substr(0, words.find(' ')));
  } else if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    text = fmt::format("{}: found without {}, expected it too", text.substr(0, text.find(' ')),
                       text.substr(text.rfind(' ') + 1));
  }
  return RowNamed(program.verbs, verb) == nullptr ? InputError(text) : InputError(verb + ": " + text);
}

}  // namespace

ListedVerb::ListedVerb(std::string_view group, int place, void (*add)(CommandLine&)) {
  ListedVerbs().insert({{group, place}, add});
}

void CommandLine::AddListed(std::initializer_list<std::string_view> groups) {
  for (const std::string_view each : groups) {
    group = each;
    for (const auto& [place, add] : ListedVerbs()) {
      STICTION_CHECK(ListedVerbs().count(place) == 1,
                     fmt::format("two verbs at place {} of the group {}", place.second, place.first));
      if (place.first == each) add(*this);
    }
  }
  STICTION_CHECK(verbs.size() == ListedVerbs().size(), "a verb is listed in a group that the help has not");
}

int CommandLine::Help(const std::string& verb) const {
  if (!verb.empty()) RefuseUnknownVerb(*this, verb);
  std::cout << (verb.empty() ? HelpOf(*this) : HelpOf(*RowNamed(verbs, verb)));
  return kExitDone;
}

int CommandLine::Run(int argc, char** argv) const {
  if (argc < 2 || std::string_view(argv[1]) == "help") return Help(argc < 3 ? "" : argv[2]);
  CLI::App app;
  app.formatter_fn([this](const CLI::App*, std::string, CLI::AppFormatMode) { return HelpOf(*this); });
  app.set_version_flag("--version", version);
  app.require_subcommand(1);
  for (const Verb& verb : verbs) AddVerb(app, verb);
  const std::string word = argv[1];
  if (word != "-h" && word != "--help" && word != "--version") RefuseUnknownVerb(*this, word);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw Refused(*this, error, word);
    return app.exit(error), kExitDone;
  }
  for (const Verb& verb : verbs) {
    const CLI::App& chosen = *app.get_subcommand(verb.name);
    if (!chosen.parsed()) continue;
    std::vector<std::string> words = chosen.remaining();
    if (verb.rest != nullptr) {
      *verb.rest = words;
    } else {
      std::erase(words, "--");  // behind which no word is an option
      if (!words.empty()) RefuseUnknownWord(verb, words.front());
    }
    return verb.run();
  }
  return kExitDone;
}

}  // namespace stiction
