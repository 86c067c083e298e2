// SPDX-License-Identifier: Apache-2.0
// What is known, told once, as data: sections of sentences, notes, tables and figures. A text file beside this
// one says them, with places for numbers (report.txt, comparison.txt, solvers.txt); media render them and count
// nothing.
//
//   # ID | TITLE       a section; `#-`: without a heading in text
//   % MEDIUM ...       the media of what follows, in this section
//   . TEXT             a sentence; `^`: in text to the left; `! LEAD | TEXT`: with a few words before it, not
//   in text > TEXT             a note
//   ## TEXT            a heading
//   = NAME             tables of this name
//   ~ NAME | CAPTION | MADE BY   a figure, and the command that makes it; without one the report of this store
//   * NAME | TITLE     a list of this name; with a title it opens on demand in a page
//   - TEXT             an item; `$ TEXT`: a command
//   : NAME             what a page alone shows here
//     TEXT             behind two blanks: more of the same line
//
// In a text `CODE`, [TITLE](ADDRESS) and [FILE]; @a@ is a text or a number as people read it, @a/b@, @a%b@,
// @a~b@ and
// @a-b@ as in tables/tables.txt; @a:noun@ is so many of them, @a=one|more@ by number. Blocks and
// @name?text|other@ as in corpus/text_template.h: a name holds that is not 0, and not empty. Lines and marks
// are those of the file: what fills a place is text.

#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/tables/table.h"

namespace stiction {

using Lines = std::vector<std::pair<std::string, std::string>>;  // what, and more of it

// What the places of a text stand for, by name.
struct Facts {
  Numbers numbers = {};
  std::map<std::string, std::string> texts = {};
  std::map<std::string, Lines> lists = {};
  std::map<std::string, std::function<std::vector<Table>()>> tables = {};  // made where a medium shows them
};

// A paragraph, table, figure, list or block of commands.
struct Part {
  std::string what;  // as in report.json: "sentence", "note", ...
  std::string lead,
      text;               // marked (Plain); of a table, figure, list or place its name and its caption or title
  std::string more = {};  // of a figure: what makes it
  std::vector<std::string> media = {};
  Lines lines = {};
  std::vector<Table> tables = {};

  bool In(const std::string& medium) const;
};

struct Section {
  std::string id, title;
  bool goes_on = false;  // in text without a heading
  std::vector<Part> parts = {};

  bool In(const std::string& medium) const;
};
using Told = std::vector<Section>;

// The parts for any of these media. Requires every name that it says.
Told Tell(std::span<const unsigned char> text, const Facts& facts, const std::vector<std::string>& media);

// A text without its marks.
std::string Plain(const std::string& marked);

// report.json (reports/files.md).
SharedJson ToJson(const Told& told);
// For a terminal. In a `summary` no section has a heading.
std::string ToText(const Told& told, const std::string& medium);

}  // namespace stiction
