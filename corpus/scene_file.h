// SPDX-License-Identifier: Apache-2.0
// Scene files: `stiction-scene`, version 1, read and written exactly. README.md of scenes/ has the keys.
//
// Numbers are those of problem files. A wrong file is an InputError with file, JSON path, what was found and
// what was expected.

#ifndef STICTION_CORPUS_SCENE_FILE_H_
#define STICTION_CORPUS_SCENE_FILE_H_

#include <filesystem>
#include <string>
#include <string_view>

#include "corpus/json_text.h"
#include "solver/scene/scene.h"

namespace stiction {

struct SceneFile {
  Scene<Rational> scene;
  Rational step = Rational(1, 60);  // s, of a simulation
  Rational seconds = Rational(2);   // how long it runs by default
  std::string note;
};

SceneFile ParseScene(std::string_view text, const std::string& source);
// A stiction-scene file, or the key "scene" of a stiction-problem file.
SceneFile ReadScene(const std::filesystem::path& file);

// What the reader reads back to the same scene: anchors of joints and contacts in the bodies' coordinates.
Json ToJson(const SceneFile& file);
std::string Print(const SceneFile& file);

}  // namespace stiction

#endif  // STICTION_CORPUS_SCENE_FILE_H_
