// SPDX-License-Identifier: Apache-2.0
// Shapes: what a JSON text may look like, in a notation for people; and the JSON schema of a shape.
//
//   integer, number, text, truth, object, any, null    of that type; object: with any members
//   integer 1..9, integer 0..                          in a range
//   "a" | "b" | null                                   one of several
//   [text], [text+], [number, number]                  a list, one that is not empty, a pair
//   {a: text, b?: integer}                             an object with these members; b may be left out
//   {a: text, ...}                                     with others besides
//   {...size, c: text}                                 with those of the shape `size` too
//   {*: integer}                                       with keys of any name
//   `^[0-9]+$`                                         a text that matches
//   exact                                              a shape by its name: one of NamedShapes()
//
// What follows // on a line describes the member that stands before it.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

struct NamedShape {
  std::string name, shape, description;
};
// That several verbs print. Names of methods, arithmetics, outcomes, ... are those of their tables.
const std::vector<NamedShape>& NamedShapes();

// The whole schema (draft 2020-12) of a shape, with those that it names.
SharedJson SchemaOf(std::string_view title, std::string_view description, std::string_view shape);

}  // namespace stiction
