// SPDX-License-Identifier: Apache-2.0
// A picture that moves: forces of a scene, one still after another, again and again.

#pragma once

#include <string>
#include <vector>

#include "corpus/json_text.h"

namespace stiction {

struct Still {
  std::vector<double> forces;  // f, a number for each row
  std::string caption;
};

// An SVG of its own, without a script. `picture`: of problem_picture.h. Each still is seen for `seconds`;
// those that do not move pictures show the first. The largest force is a quarter of the picture's height.
std::string MovingPicture(const Json& picture, const std::string& title, const std::vector<Still>& stills,
                          double seconds);

}  // namespace stiction
