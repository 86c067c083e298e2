// SPDX-License-Identifier: Apache-2.0
// A picture of its own: what DrawSvg shows, with numbers, cones, gravity and scales.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/pictures/draw_bodies.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

constexpr const char* kForceColour = "#d00000";
constexpr double kConeLength = 40, kBand = 44;  // pixels: of a side of a cone; of the band below the picture

Html Words(double x, double y, const std::string& text, const char* colour = "black") {
  return Tag("text", {{"x", Fixed(x)},
                      {"y", Fixed(y)},
                      {"font-family", "sans-serif"},
                      {"font-size", "14"},
                      {"fill", colour},
                      {"stroke", "white"},
                      {"stroke-width", "3"},
                      {"paint-order", "stroke"}})(text) +
         Html("\n");
}

// In pixels, y down.
Html PixelArrow(const Vector2<double>& from, const Vector2<double>& to, const char* colour) {
  const Vector2<double> along = (to - from).normalized(), across(-along[1], along[0]);
  const Vector2<double> back = to - 8 * along;
  const auto point = [](const Vector2<double>& p) { return fmt::format("{:.1f},{:.1f}", p[0], p[1]); };
  return Tag("path", {{"d", fmt::format("M{} L{} M{} L{} L{} z", point(from), point(back), point(to),
                                        point(back + 4 * across), point(back - 4 * across))},
                      {"stroke", colour},
                      {"fill", colour},
                      {"stroke-width", "1.5"}})("") +
         Html("\n");
}

// The forces that friction allows, of sides of one length: in the plane two of them, in space a rim of many.
template <class Kind>
Html Cone(const Screen& screen, const TouchPointIn<Kind, double>& touch, double side) {
  constexpr int kSides = 32;
  if (touch.mu == 0) return {};
  const auto tangents = TangentsOf<double>(touch.normal);
  const Vector2<double> tip(screen.X(Seen(touch.point)), screen.Y(Seen(touch.point)));
  const int count = Kind::kDimension == 2 ? 2 : kSides;
  std::string rim;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * k / count;
    typename Kind::template Vector<double> along = touch.normal + touch.mu * std::cos(angle) * tangents[0];
    if constexpr (Kind::kDimension == 3) along += touch.mu * std::sin(angle) * tangents[1];
    const Vector2<double> seen = side * kConeLength / along.norm() * Seen(along);
    const std::string end = fmt::format("{:.1f},{:.1f}", tip[0] + seen[0], tip[1] - seen[1]);
    // In the plane from the tip along both sides; in space every side, of which the outer ones are seen.
    rim += fmt::format("M{:.1f},{:.1f} L{} ", tip[0], tip[1], end);
  }
  return Tag("path", {{"d", rim},
                      {"stroke", "#2a7d2a"},
                      {"stroke-width", "1"},
                      {"stroke-opacity", Kind::kDimension == 2 ? "1" : "0.35"},
                      {"fill", "none"}})("") +
         Html("\n");
}

// The largest of 1, 2, 5 times a power of ten that is at most x > 0.
double RoundNumber(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= x) return digit * power;
  return power;
}

Html Pin(const Screen& screen, const Vector2<double>& at) {
  const std::string x = Fixed(screen.X(at)), y = Fixed(screen.Y(at));
  return Tag("circle",
             {{"cx", x}, {"cy", y}, {"r", "7"}, {"fill", "white"}, {"stroke", "black"}, {"stroke-width", "2"}})(
             "") +
         Tag("circle", {{"cx", x}, {"cy", y}, {"r", "2"}, {"fill", "black"}})("") + Html("\n");
}

// The way of gravity, about a point of the picture.
Html Gravity(const Vector2<double>& seen, double size, const Vector2<double>& at) {
  constexpr double kLong = 32;  // pixels
  if (seen.norm() == 0) return {};
  const Vector2<double> half = kLong / 2 * Vector2<double>(seen[0], -seen[1]).normalized();
  return PixelArrow(at - half, at + half, "#2060c0") + Words(at[0] + std::abs(half[0]) + 10, at[1] + 5,
                                                             fmt::format("gravity {:.3g} m/s\u00b2", size),
                                                             "#2060c0");
}

// Below the picture, on a band of its own: how long a metre and a newton are, and where gravity pulls.
Html Scales(const Screen& screen, double newton, bool has_forces, const Html& gravity) {
  constexpr double kLong = 120, kLeft = 20;  // pixels
  const double y = screen.height + kBand / 2, metres = RoundNumber(kLong / screen.scale),
               length = metres * screen.scale;
  Html html =
      Tag("rect",
          {{"y", Fixed(screen.height)}, {"width", "100%"}, {"height", Fixed(kBand)}, {"fill", "white"}})("") +
      Tag("path", {{"d", fmt::format("M{0},{1:.1f} v8 m0,-4 h{2:.1f} m0,-4 v8", kLeft, y - 4, length)},
                   {"stroke", "black"},
                   {"fill", "none"}})("") +
      Words(kLeft + length + 8, y + 5, fmt::format("{:g} m", metres));
  html += gravity;
  if (!has_forces) return html;
  const double force = RoundNumber(kLong / (newton * screen.scale)), from = screen.width / 2;
  const double to = from + force * newton * screen.scale;
  return html + PixelArrow({from, y}, {to, y}, kForceColour) +
         Words(to + 8, y + 5, fmt::format("{:g} N; dashed: longer than it is drawn", force));
}

}  // namespace

template <class Kind>
std::string DrawExplained(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<TouchPointIn<Kind, double>>& touches,
                          const std::vector<AppliedForceIn<Kind>>& forces, double newton) {
  Screen screen(view);
  Html over;
  for (const auto& touch : touches)
    over += Cone(screen, touch, ShownSide(scene, std::array{touch.a, touch.b}) == 0 ? 1 : -1);
  for (const auto& joint : scene.joints) over += Pin(screen, Seen(scene.bodies[joint.a].At(joint.at_a)));
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const Vector2<double> at = Seen(touches[i].point);
    over += Words(screen.X(at) + 6, screen.Y(at) + 16, std::to_string(i + 1));
  }
  MarksIn<Kind> marks;
  for (const auto& touch : touches) marks.contacts.push_back(touch.point);
  marks.forces = forces;
  const Html gravity =
      Gravity(Seen(scene.gravity), scene.gravity.norm(), {0.3 * screen.width, screen.height + kBand / 2});
  over += Tag("g", {{"class", "scales"}})(Scales(screen, newton, LargestForce(marks) > 0, gravity));
  return DrawSvg(scene, view, marks, newton, {std::move(over), kBand});
}

#define STICTION_INSTANTIATE(Kind)                                                   \
  template std::string DrawExplained(const SceneIn<Kind, double>&, const View&,      \
                                     const std::vector<TouchPointIn<Kind, double>>&, \
                                     const std::vector<AppliedForceIn<Kind>>&, double)

STICTION_INSTANTIATE(Plane);
STICTION_INSTANTIATE(Space);

#undef STICTION_INSTANTIATE

}  // namespace stiction
