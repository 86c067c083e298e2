// SPDX-License-Identifier: Apache-2.0
// What drawing bodies in the plane and in space have in common, and what each brings.

#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "reports/html/html.h"
#include "reports/pictures/draw.h"

namespace stiction {

inline constexpr double kPageWidth = 800;  // pixels

// From the picture's plane to pixels; y points up in the world.
struct Screen {
  double scale, left, top, width, height;

  explicit Screen(const View& view)
      : scale(kPageWidth / (view.right - view.left)),
        left(view.left),
        top(view.top),
        width(kPageWidth),
        height(std::ceil(scale * (view.top - view.bottom))) {}
  double X(const Vector2<double>& p) const { return scale * (p[0] - left); }
  double Y(const Vector2<double>& p) const { return scale * (top - p[1]); }
};

// The place of a point of the world, or of a vector, in the picture's plane.
inline Vector2<double> Seen(const Vector2<double>& p) { return p; }
Vector2<double> Seen(const Vector3<double>& p);

// Which of two bodies a force between them is shown on: the one that moves, or the later one (draw.h).
template <class Kind>
int ShownSide(const SceneIn<Kind, double>& scene, const std::array<int, 2>& bodies) {
  const auto [first, second] = bodies;
  const bool on_first = scene.bodies[first].fixed ? false : scene.bodies[second].fixed || first > second;
  return on_first ? 0 : 1;
}

// The colour of a level, of those that a kind has.
template <class Colours>
const auto& ColourOfLevel(const Colours& colours, int level) {
  const int count = static_cast<int>(colours.size());
  return colours[static_cast<std::size_t>(((level % count) + count) % count)];
}

inline Html Dot(const Screen& screen, const Vector2<double>& at, const char* fill, int radius) {
  return Tag("circle", {{"cx", Significant(screen.X(at))},
                        {"cy", Significant(screen.Y(at))},
                        {"r", std::to_string(radius)},
                        {"fill", fill},
                        {"stroke", "black"}})("") +
         Html("\n");
}

// A place of a picture as data: two decimals.
inline std::array<double, 2> InPicture(double x, double y) {
  const auto rounded = [](double z) { return std::round(100 * z) / 100 + 0.0; };
  return {rounded(x), rounded(y)};
}

// ---- What a kind brings ----------------------------------------------------------------------

// Bodies in their own coordinates, each of which a transform (SVG) brings to where it is, and these. In space
// there are none: what hides what changes with every picture.
std::vector<Html> BodyPictures(const Scene<double>& scene, const Screen& screen);
std::vector<Html> BodyPictures(const SceneInSpace<double>& scene, const Screen& screen);
std::vector<std::string> Transforms(const Scene<double>& scene, const Screen& screen);
std::vector<std::string> Transforms(const SceneInSpace<double>& scene, const Screen& screen);

// What is drawn where it is: joints, and in space bodies.
Html Placed(const Scene<double>& scene, const Screen& screen);
Html Placed(const SceneInSpace<double>& scene, const Screen& screen);

}  // namespace stiction
