// SPDX-License-Identifier: Apache-2.0
// The scene of a problem as a picture, in which a page draws the forces itself, step by step.

#pragma once

#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/rational.h"
#include "scene/assemble.h"

namespace stiction {

struct ProblemFile;  // corpus/record/problem_file.h

// {"svg": "<svg ...>", "contacts": [{"at": [x, y], "rows": [[x, y], ...]}, ...], "gravity": [x, y]}, of the
// contacts of an island in the order of its problem. `at` in pixels of the picture, y down; `rows`: which way a
// force of 1 N of each row points, as draw.h shows forces, in the picture's plane: in space shorter than 1.
template <class Kind>
Json PictureOfProblem(const SceneIn<Kind, double>& scene,
                      const std::vector<TouchPointIn<Kind, Rational>>& contacts,
                      const ModelIn<Kind, Rational>& model, const Island& island);

// The picture of the scene that a problem brings along, unless the problem has changed since, or the scene is
// none.
SharedJson PictureBeside(const ProblemFile& file, const std::string& source);

}  // namespace stiction
