// SPDX-License-Identifier: Apache-2.0
// Scene files: `stiction-scene`, version 1, read and written exactly. formats/scenes.md has the keys.
//
// Numbers are those of problem files. A wrong file is an InputError with file, JSON path, what was found and
// what was expected.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "corpus/json_text.h"
#include "corpus/rational.h"
#include "scene/scene.h"

namespace stiction {

template <class Kind>
struct SceneFileIn {
  SceneIn<Kind, Rational> scene;
  Rational step = Rational(1, 60);  // s, of a simulation
  Rational seconds = Rational(2);   // how long it runs by default
  std::string note;
};

using SceneFile = SceneFileIn<Plane>;
using SceneFileInSpace = SceneFileIn<Space>;

// Scenes of dimension 2, or of dimension 3; whichever it is, also from the key "scene" of a stiction-problem
// file.
template <class Kind = Plane>
SceneFileIn<Kind> ParseScene(std::string_view text, const std::string& source);
SceneFile ReadScene(const std::filesystem::path& file);
std::variant<SceneFile, SceneFileInSpace> ParseAnyScene(std::string_view text, const std::string& source);
std::variant<SceneFile, SceneFileInSpace> ReadAnyScene(const std::filesystem::path& file);

// What the reader reads back to the same scene: anchors of joints and contacts in the bodies' coordinates.
template <class Kind>
SharedJson ToJson(const SceneFileIn<Kind>& file);
template <class Kind>
std::string Print(const SceneFileIn<Kind>& file);

}  // namespace stiction
