// SPDX-License-Identifier: Apache-2.0
// stiction manual: the man pages and the completion of bash, from the rows of the verbs (cli/verb.h) and the
// table of words.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/completion.bash_in.h"
#include "cli/help.h"
#include "cli/manual.1_in.h"
#include "cli/schema.h"
#include "cli/words.h"
#include "corpus/atomic_file.h"
#include "corpus/exit_code.h"
#include "corpus/json_text.h"
#include "corpus/named_rows.h"
#include "corpus/text_template.h"
#include "search/campaign.h"

namespace stiction {
namespace {

// ---- man(7) ----

// Text that man reads as it stands: a backslash, a hyphen that is a minus, a line that would be a request.
std::string Escaped(std::string_view text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    at_start = c == '\n';
  }
  return out;
}

// A term, and what it means, indented.
std::string Paragraph(std::string_view term, std::string_view meaning) {
  return fmt::format(".TP\n.B {}\n{}\n", Escaped(term), Escaped(meaning));
}

// Every line a paragraph; those that are indented hang together.
std::string LinesInMan(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    if (indent == line.size()) continue;
    out += (indent > 0 ? ".IP \"\" 4\n" : ".PP\n") + Escaped(line.substr(indent)) + "\n";
  }
  return out;
}

std::string RowInMan(const OptionRow& row) {
  std::string text = Paragraph(TermOf(row), MeaningOf(row));
  if (!AreExplained(row.choices)) return text;
  text += ".RS\n";
  for (const AllowedValue& choice : row.choices) text += Paragraph(choice.name, choice.meaning);
  return text + ".RE\n";
}

std::string VerbInMan(const Verb& verb) {
  std::string text = fmt::format(".SS {}\n{}\n.PP\n", Escaped(UsageLine(verb)), Escaped(verb.purpose));
  for (const OptionRow& row : verb.rows) text += RowInMan(row);
  return text + LinesInMan(verb.footer);
}

// ---- bash ----

std::string Quoted(const std::string& words) { return "'" + words + "'"; }

std::string Words(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// Case arms "VERB OPTION) values": of options whose values are a list.
std::string ValueArms(const Verb& verb) {
  std::string arms;
  for (const OptionRow& row : verb.rows) {
    if (row.kind != RowKind::kOption || row.choices.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : row.Spellings()) patterns.push_back(fmt::format("'{} {}'", verb.name, name));
    arms +=
        fmt::format("    {}) values={} ;;\n", fmt::join(patterns, " | "), Quoted(Words(NamesOf(row.choices))));
  }
  return arms;
}

std::string OptionArm(const Verb& verb) {
  std::vector<std::string> options = {"--help"};
  for (const OptionRow& row : verb.rows) {
    if (row.kind == RowKind::kPositional) continue;
    for (const std::string& name : row.Spellings()) options.push_back(name);
  }
  return fmt::format("    {}) options={} ;;\n", verb.name, Quoted(Words(options)));
}

// ---- JSON ----

std::string_view NameOf(RowKind kind) {
  return kind == RowKind::kPositional ? "positional" : kind == RowKind::kOption ? "option" : "flag";
}

SharedJson RowInJson(const OptionRow& row) {
  std::vector<SharedJson> choices;
  for (const AllowedValue& choice : row.choices)
    choices.push_back({{"name", choice.name}, {"meaning", choice.meaning}});
  return {{"kind", NameOf(row.kind)},     {"names", row.Spellings()},
          {"type", row.TypeName()},       {"help", row.help},
          {"required", row.required},     {"repeated", row.IsRepeated()},
          {"default", row.default_value}, {"choices", choices}};
}

// "stiction VERSION" of "stiction VERSION COMMIT, ..."
std::string NameAndNumber(const std::string& version) {
  return version.substr(0, version.find(' ', version.find(' ') + 1));
}

// ---- Whole texts ----

// In the language of man(7), section 1: of all verbs, or of the program stiction-bench, which reads the words
// of the verb bench.
std::string ManPage(const CommandLine& program, bool of_bench) {
  std::string rows, words, group;
  for (const Verb& verb : program.verbs) {
    if (of_bench) {
      if (verb.name != "bench") continue;
      for (const OptionRow& row : verb.rows) rows += RowInMan(row);
    } else {
      if (verb.group != group) rows += fmt::format(".SH VERBS: {}\n", verb.group);
      group = verb.group;
      rows += VerbInMan(verb);
    }
  }
  for (const auto& [word, meaning] : AllWords()) words += Paragraph(word, meaning);
  const std::string purpose = of_bench ? RowNamed(program.verbs, "bench")->purpose
                                       : program.purpose.substr(program.purpose.find(' ') + 1);
  Blanks blanks = {{{"VERSION", Escaped(NameAndNumber(program.version))},
                    {"PURPOSE", Escaped(purpose)},
                    {"ROWS", rows},
                    {"EXITS", LinesInMan(program.footer)},
                    {"WORDS", words}}};
  if (of_bench) blanks.words = {"bench"};
  return Filled(kManual1, blanks);
}

// A script for bash: verbs, their options, and the values of those that have a list; files elsewhere.
std::string BashCompletion(const CommandLine& program) {
  std::string options, values;
  for (const Verb& verb : program.verbs) {
    options += OptionArm(verb);
    values += ValueArms(verb);
  }
  return Filled(kCompletionBash, {{{"VERBS", Quoted(Words(NamesOf(program.verbs)) + " help --help --version")},
                                   {"VALUES", values},
                                   {"OPTIONS", options}}});
}

// Verbs with their rows, as a program reads them.
SharedJson TablesInJson(const CommandLine& program) {
  std::vector<SharedJson> verbs;
  for (const Verb& verb : program.verbs) {
    std::vector<SharedJson> rows;
    for (const OptionRow& row : verb.rows) rows.push_back(RowInJson(row));
    verbs.push_back(
        {{"verb", verb.name}, {"group", verb.group}, {"purpose", verb.purpose}, {"words", std::move(rows)}});
  }
  return SharedJson(verbs);
}

// ---- The verb ----

struct ManualOptions {
  const CommandLine* program = nullptr;
  std::string format = "man";
  std::string schemas;  // folder
  bool json = false;
};

std::string TextIn(const std::string& format, const CommandLine& program) {
  if (format == "bash") return BashCompletion(program);
  return ManPage(program, format == "man-bench");
}

// A file VERB.schema.json for each verb, and one for campaign files.
void WriteSchemas(const std::string& folder, const CommandLine& program) {
  const auto write = [&folder](const std::string& name, const SharedJson& schema) {
    WriteText(fmt::format("{}/{}.schema.json", folder, name), JsonText(schema, 1) + "\n");
  };
  std::filesystem::create_directories(folder);
  for (const Verb& verb : program.verbs)
    write(verb.name, SchemaOf(fmt::format("stiction {} --json", verb.name), verb.answer, verb.answer_shape));
  write("campaign", SchemaOf("stiction-campaign", "what a search tries", ShapeOfCampaign()));
}

int Write(const ManualOptions& o) {
  if (!o.schemas.empty()) {
    WriteSchemas(o.schemas, *o.program);
    return kExitDone;
  }
  std::cout << (o.json ? JsonText(TablesInJson(*o.program)) + "\n" : TextIn(o.format, *o.program));
  return kExitDone;
}

}  // namespace

const ListedVerb kManualVerb("Show", 60, [](CommandLine& program) {
  auto [verb, o] = program.Add("manual", "The manual page, and the completion of a shell", Write);
  o.program = &program;
  verb.Option("--format", o.format, "what to write")
      .Choices({{"man", "a page for man, with all verbs and words"},
                {"man-bench", "a page for man, of the program stiction-bench"},
                {"bash", "completion for bash"}});
  verb.Option("--schemas", o.schemas,
              "instead: a folder to write JSON schemas into: of what --json of each verb prints, and of "
              "campaign files");
  verb.Prints(o.json, "the command line", R"([{
      verb: text, group: text, purpose: text,
      words: [{kind: "positional" | "option" | "flag", names: [text+], type: "" | "TEXT" | "INTEGER" | "NUMBER",
               help: text, required: truth, repeated: truth, default: text,
               choices: [{name: text, meaning: text}]}]}])")
      .help = "all verbs with their options, as a program reads them";
});

}  // namespace stiction
