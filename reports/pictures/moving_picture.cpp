// SPDX-License-Identifier: Apache-2.0
#include "reports/pictures/moving_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "corpus/json.h"
#include "reports/html/html.h"
#include "reports/pictures/draw_bodies.h"

namespace stiction {
namespace {

using Pixels2 = std::array<double, 2>;  // y down

constexpr double kLine = 34;  // height of a line of text
constexpr const char* kRed = "#d00000";

std::string Pixels(double x) { return fmt::format("{:.1f}", x); }

// N of each contact: its rows' ways times their forces.
std::vector<Pixels2> ArrowsOf(const Json& picture, const std::vector<double>& forces) {
  std::vector<Pixels2> arrows;
  std::size_t row = 0;
  for (const Json& contact : picture["contacts"]) {
    Pixels2 arrow = {};
    for (const Json& way : contact["rows"]) {
      for (int i = 0; i < 2; ++i) arrow[i] += forces[row] * way[i].get<double>();
      ++row;
    }
    arrows.push_back(arrow);
  }
  return arrows;
}

double Length(const Pixels2& arrow) { return std::hypot(arrow[0], arrow[1]); }

Html TextAt(double x, double y, const std::string& text, const char* anchor = "start") {
  return Tag("text", {{"x", Pixels(x)},
                      {"y", Pixels(y)},
                      {"text-anchor", anchor},
                      {"stroke", "white"},
                      {"stroke-width", "4"},
                      {"paint-order", "stroke"}})(text);
}

Html ArrowAt(const Json& at, const Pixels2& arrow, double newton) {
  const double x = at[0], y = at[1];
  return Tag("line", {{"x1", Pixels(x)},
                      {"y1", Pixels(y)},
                      {"x2", Pixels(x + newton * arrow[0])},
                      {"y2", Pixels(y + newton * arrow[1])},
                      {"stroke", kRed},
                      {"stroke-width", "4"},
                      {"marker-end", "url(#head)"}})("");
}

// When, of all the time, still k of so many is seen.
Html SeenAt(std::size_t k, std::size_t count, double seconds) {
  const auto share = [count](std::size_t i) {
    return fmt::format("{:.5f}", static_cast<double>(i) / static_cast<double>(count));
  };
  std::string values = "visible", times = "0";
  if (k > 0) values = "hidden;visible", times = "0;" + share(k);
  if (k + 1 < count) values += ";hidden", times += ";" + share(k + 1);
  return Tag("animate", {{"attributeName", "visibility"},
                         {"calcMode", "discrete"},
                         {"values", values},
                         {"keyTimes", times},
                         {"dur", fmt::format("{:.2f}s", seconds * static_cast<double>(count))},
                         {"repeatCount", "indefinite"}})("");
}

// Dots on a circle, a still each: the loop itself.
Pixels2 OnCircle(std::size_t k, std::size_t count) {
  constexpr double kRadius = 44, kRight = 60, kDown = 60;
  const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
  return {kPageWidth - kRight + kRadius * std::sin(angle), kDown - kRadius * std::cos(angle)};
}

Html CircleAt(const Pixels2& at, const char* fill, const char* radius) {
  return Tag("circle", {{"cx", Pixels(at[0])}, {"cy", Pixels(at[1])}, {"r", radius}, {"fill", fill}})("");
}

}  // namespace

std::string MovingPicture(const Json& picture, const std::string& title, const std::vector<Still>& stills,
                          double seconds) {
  const std::string scene = picture["svg"];
  const auto height = [&scene] {  // of <svg ... height="786"
    const std::size_t at = scene.find("height=\"") + 8;
    return std::stod(scene.substr(at));
  }();
  double largest = 0;
  for (const Still& still : stills) {
    for (const Pixels2& arrow : ArrowsOf(picture, still.forces)) largest = std::max(largest, Length(arrow));
  }
  const double newton = largest > 0 ? height / 4 / largest : 0;
  Html body;
  body += Tag("marker", {{"id", "head"},
                         {"markerWidth", "5"},
                         {"markerHeight", "5"},
                         {"refX", "3"},
                         {"refY", "2.5"},
                         {"orient", "auto"}})(Tag("path", {{"d", "M0,0 L5,2.5 L0,5 z"}, {"fill", kRed}})(""));
  int number = 0;
  for (const Json& contact : picture["contacts"]) {
    const Pixels2 at = {contact["at"][0], contact["at"][1]};
    body += CircleAt(at, "#30c030", "6") + TextAt(at[0] - 12, at[1] + 30, std::to_string(++number), "end");
  }
  for (std::size_t k = 0; k < stills.size(); ++k) body += CircleAt(OnCircle(k, stills.size()), "#c8c8c8", "5");
  body += TextAt(12, height + kLine - 8, title);
  for (std::size_t k = 0; k < stills.size(); ++k) {
    Html shown = SeenAt(k, stills.size(), seconds);
    const std::vector<Pixels2> arrows = ArrowsOf(picture, stills[k].forces);
    for (std::size_t i = 0; i < arrows.size(); ++i) {
      if (Length(arrows[i]) > 0) shown += ArrowAt(picture["contacts"][i]["at"], arrows[i], newton);
    }
    shown += CircleAt(OnCircle(k, stills.size()), kRed, "8");
    shown += TextAt(12, height + 2 * kLine - 8, stills[k].caption);
    body += Tag("g", {{"visibility", k == 0 ? "visible" : "hidden"}})(shown) + Html("\n");
  }
  const double whole = height + 2 * kLine;
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" viewBox="0 0 {0:.0f} {1:.0f}" )"
      R"(font-family="sans-serif" font-size="18"><rect width="100%" height="100%" fill="white"/>)"
      "\n{2}{3}</svg>\n",
      kPageWidth, whole, scene, body.markup());
}

}  // namespace stiction
