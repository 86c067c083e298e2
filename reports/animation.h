// SPDX-License-Identifier: Apache-2.0
// The page of a run of a scene: one file that needs nothing else, which plays it, and shows the forces of each
// frame with their numbers. Joined by the build (web/), like viewer.h.

#pragma once

#include <string>
#include <vector>

#include "reports/pictures/draw.h"
#include "scene/creep.h"

namespace stiction {

// `scene` gives shapes, colours and names, frames the poses. `newton` as in draw.h, `rate`: frames a second
// when played; `motions`: what bodies do at the end of the run.
template <class Kind>
std::string AnimationPage(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<FrameIn<Kind>>& frames, double newton, double rate,
                          const std::vector<BodyMotion>& motions = {});

}  // namespace stiction
