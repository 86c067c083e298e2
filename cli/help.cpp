// SPDX-License-Identifier: Apache-2.0
#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "corpus/named_rows.h"
#include "corpus/plain_text.h"

namespace stiction {
namespace {

constexpr std::size_t kMostWidth = 80;  // of a line
constexpr std::size_t kColumn = 28;     // where explanations begin

// Words of the text in lines that fit the terminal, the first of which begins at column `at`, the others at
// `indent`.
std::string Wrapped(const std::string& text, std::size_t at, std::size_t indent) {
  const std::size_t width = std::min(kMostWidth, TextWidth());
  std::string lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool first = lines.empty();
    if (!first && at + 1 + word.size() > width) {
      lines += "\n" + std::string(indent, ' ');
      at = indent;
    } else if (!first) {
      lines += " ";
      ++at;
    }
    lines += word;
    at += word.size();
  }
  return lines + "\n";
}

// Every line of the text wrapped for itself, its leading spaces kept.
std::string Paragraphs(const std::string& text) {
  std::string lines;
  std::istringstream paragraphs(text);
  for (std::string line; std::getline(paragraphs, line);) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    lines += std::string(indent, ' ') + Wrapped(line, indent, indent + (indent > 0 ? 2 : 0));
  }
  return lines;
}

std::string RangeText(const OptionRow& row) {
  if (row.min == -std::numeric_limits<double>::infinity()) return "";
  if (row.max == kMostInteger) return fmt::format("{:g} or more", row.min);
  return fmt::format("{:g} to {:g}", row.min, row.max);
}

// "(drives; 1 to 1e+12; default 10000)"
std::string Notes(const OptionRow& row) {
  std::vector<std::string> notes;
  const auto note = [&notes](const char* before, const std::string& text) {
    if (!text.empty()) notes.push_back(before + text);
  };
  if (row.required && row.kind == RowKind::kOption) notes.emplace_back("required");
  note("", row.unit);
  note("", RangeText(row));
  note("default ", row.default_value);
  note("with ", row.needs);
  return notes.empty() ? "" : fmt::format(" ({})", fmt::join(notes, "; "));
}

std::string EntryOf(const OptionRow& row) {
  std::string entry = HelpEntry(TermOf(row), MeaningOf(row));
  if (!AreExplained(row.choices)) return entry;
  for (const AllowedValue& choice : row.choices) {
    const std::string meaning = choice.meaning.empty() ? "" : ": " + choice.meaning;
    entry += std::string(kColumn, ' ') + Wrapped(choice.name + meaning, kColumn, kColumn + 2);
  }
  return entry;
}

// The groups in the order in which they appear; positional words have none.
std::vector<std::string> GroupsOf(const Verb& verb) {
  std::vector<std::string> groups = {""};
  for (const OptionRow& row : verb.rows) {
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end()) groups.push_back(row.group);
  }
  return groups;
}

// Letters to add, remove, replace or swap with their neighbour to make one word the other.
std::size_t Distance(std::string_view left, std::string_view right) {
  std::vector<std::vector<std::size_t>> d(left.size() + 1, std::vector<std::size_t>(right.size() + 1));
  for (std::size_t i = 0; i <= left.size(); ++i) {
    for (std::size_t j = 0; j <= right.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const bool same = left[i - 1] == right[j - 1];
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && left[i - 1] == right[j - 2] && left[i - 2] == right[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[left.size()][right.size()];
}

}  // namespace

std::string TermOf(const OptionRow& row) {
  if (row.kind == RowKind::kPositional) return row.name + (row.IsRepeated() ? " ..." : "");
  std::string term = fmt::format("{}", fmt::join(row.Spellings(), ", "));
  if (row.kind == RowKind::kOption) term += fmt::format(" {}", row.TypeName());
  return term + (row.IsRepeated() ? " ..." : "");
}

std::string MeaningOf(const OptionRow& row) {
  std::string text = row.help;
  if (!row.choices.empty() && !AreExplained(row.choices))
    text += fmt::format(": {}", fmt::join(NamesOf(row.choices), ", "));
  return text + Notes(row) + (row.details.empty() ? "" : ". " + row.details);
}

bool AreExplained(const std::vector<AllowedValue>& choices) {
  return std::any_of(choices.begin(), choices.end(),
                     [](const AllowedValue& choice) { return !choice.meaning.empty(); });
}

std::string UsageLine(const Verb& verb) {
  std::string usage = fmt::format("stiction {} [OPTIONS]", verb.name);
  for (const OptionRow& row : verb.rows) {
    if (row.kind == RowKind::kPositional)
      usage += row.required ? " " + TermOf(row) : fmt::format(" [{}]", TermOf(row));
  }
  return usage;
}

std::string HelpEntry(const std::string& term, const std::string& meaning) {
  const bool fits = 2 + term.size() + 2 <= kColumn;
  const std::string left = fits ? fmt::format("  {:{}}", term, kColumn - 2)
                                : fmt::format("  {}\n{}", term, std::string(kColumn, ' '));
  return left + Wrapped(meaning, kColumn, kColumn);
}

std::string HelpOf(const CommandLine& program) {
  std::string text = Paragraphs(program.purpose) + "\nUsage: stiction VERB [OPTIONS] ...\n", group;
  for (const Verb& verb : program.verbs) {
    if (verb.group != group) text += "\n" + verb.group + ":\n";
    group = verb.group;
    text += HelpEntry(verb.name, verb.purpose);
  }
  text += "\nOptions:\n" +
          HelpEntry("-h, --help", "this text; `stiction help VERB`, or behind a verb: its options");
  text += HelpEntry("--version", "version, commit, compiler and flags");
  return text + "\n" + Paragraphs(program.footer);
}

std::string HelpOf(const Verb& verb) {
  std::string text = Paragraphs(verb.purpose) + "\n" + "Usage: " + UsageLine(verb) + "\n\n";
  for (const OptionRow& row : verb.rows) {
    if (row.kind == RowKind::kPositional) text += EntryOf(row);
  }
  for (const std::string& group : GroupsOf(verb)) {
    text += "\n" + (group.empty() ? "Options" : group) + ":\n";
    if (group.empty()) text += HelpEntry("-h, --help", "this text");
    for (const OptionRow& row : verb.rows) {
      if (row.kind != RowKind::kPositional && row.group == group) text += EntryOf(row);
    }
  }
  return verb.footer.empty() ? text : text + "\n" + Paragraphs(verb.footer);
}

std::string Nearest(std::string_view word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = word.size() / 3 + 2;  // from here on it is another word
  for (const std::string& name : names) {
    const std::size_t distance = Distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace stiction
