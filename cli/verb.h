// SPDX-License-Identifier: Apache-2.0
// A verb of the program as data: one row for every word that it takes. The command line is read, and --help is
// written, from the rows alone.
//
//   struct ExportOptions { std::string file, output, format; bool round = false; };
//   int Export(const ExportOptions& o);
//
//   const ListedVerb kExportVerb("Solve", 90, [](CommandLine& program) {
//     auto [verb, o] = program.Add("export", "Write a problem in the format of another program", Export);
//     verb.Positional("FILE", o.file, "stiction-problem file").Required();
//     verb.Option("-o,--output", o.output, "file to write").Required();
//     verb.Option("--format", o.format, "the format to write").Required().OneOf(FormatNames());
//     verb.Flag("--round", o.round, "write the nearest double for a number that is none");
//   });
//
// A row is bound to a field of the options, which holds the default. A field that is empty or zero has none
// that could be shown: the verb chooses, and the help says how. The type of the field says what is read:
// numbers are whole words in decimal, an optional stays empty where nothing is given, a vector takes one word
// or more. A flag turns its bool over, so that "--no-svg" is bound to a field that is true.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace stiction {

using Field = std::variant<bool*, int*, std::int64_t*, double*, std::string*, std::optional<int>*,
                           std::optional<std::int64_t>*, std::optional<std::uint64_t>*, std::optional<double>*,
                           std::vector<int>*, std::vector<std::string>*>;

// A value that is allowed, and, where it needs one, an explanation.
struct AllowedValue {
  std::string name;
  std::string meaning;
};

enum class RowKind { kPositional, kOption, kFlag };

// The largest integer that a JSON number holds.
inline constexpr double kMostInteger = 9007199254740992;

struct OptionRow {
  RowKind kind = RowKind::kOption;
  std::string name;  // "FILE", "--json", "-o,--output"
  Field field;
  std::string help;           // one line
  std::string details;        // what more is to be said
  std::string default_value;  // as text; empty: none
  std::string unit;
  std::string group;  // heading in the help; empty: Options
  std::string needs;  // the option, in a row before, without which this one says nothing
  std::vector<AllowedValue> choices;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool required = false;
  std::function<std::string(const std::string&)> check;  // what is wrong with a value; empty: nothing

  // How the row is filled.
  OptionRow& Required() { return required = true, *this; }
  OptionRow& Details(std::string text) { return details = std::move(text), *this; }
  OptionRow& Unit(std::string_view text) { return unit = text, *this; }
  OptionRow& Group(std::string_view text) { return group = text, *this; }
  OptionRow& Needs(std::string_view option) { return needs = option, *this; }
  OptionRow& Range(double least, double most) { return min = least, max = most, *this; }
  OptionRow& AtLeast(double least) { return Range(least, kMostInteger); }
  OptionRow& Choices(std::vector<AllowedValue> all) { return choices = std::move(all), *this; }
  OptionRow& OneOf(const std::vector<std::string>& names);
  OptionRow& Check(std::function<std::string(const std::string&)> of) { return check = std::move(of), *this; }

  bool IsRepeated() const;
  // "--json", of "-j,--json" both: the long one last.
  std::vector<std::string> Spellings() const;
  // "TEXT", "INTEGER", "NUMBER"; empty for a flag.
  std::string_view TypeName() const;
};

// Puts the words into the field of a row that is no flag. Empty, or what is wrong with them.
std::string Take(const OptionRow& row, const std::vector<std::string>& words);

class Verb {
 public:
  Verb(std::string name, std::string purpose) : name(std::move(name)), purpose(std::move(purpose)) {}

  template <class T>
  OptionRow& Positional(std::string_view name, T& field, std::string_view help) {
    return Add(RowKind::kPositional, name, &field, help);
  }
  template <class T>
  OptionRow& Option(std::string_view name, T& field, std::string_view help) {
    return Add(RowKind::kOption, name, &field, help);
  }
  OptionRow& Flag(std::string_view name, bool& field, std::string_view help) {
    return Add(RowKind::kFlag, name, &field, help);
  }
  // The flag --json, and what it prints: in words, and as a shape (cli/schema.h).
  OptionRow& Prints(bool& json, std::string_view what, std::string_view shape) {
    answer = what, answer_shape = shape;
    return Flag("-j,--json", json, "machine output");
  }

  std::string name;
  std::string purpose;                       // one line
  std::string group;                         // in the list of verbs: the job
  std::string answer, answer_shape;          // of --json
  std::string footer;                        // behind the rows of the help
  std::vector<std::string>* rest = nullptr;  // takes all words as they are, --help too
  std::deque<OptionRow> rows;                // a reference to a row stays good
  std::function<int()> run;                  // returns the exit code

 private:
  OptionRow& Add(RowKind kind, std::string_view name, Field field, std::string_view help);
};

}  // namespace stiction
