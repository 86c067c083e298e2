// SPDX-License-Identifier: Apache-2.0
// What drawings in the plane and in space have in common: the screen, and the page that plays frames.

#ifndef STICTION_REPORTS_DRAW_PAGE_H_
#define STICTION_REPORTS_DRAW_PAGE_H_

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "reports/draw.h"

namespace stiction {

inline constexpr double kWidth = 800;  // pixels

// From the world to pixels; y points up in the world.
struct Screen {
  double scale, left, top, width, height;

  explicit Screen(const View& view)
      : scale(kWidth / (view.right - view.left)),
        left(view.left),
        top(view.top),
        width(kWidth),
        height(std::ceil(scale * (view.top - view.bottom))) {}
  double X(double x) const { return scale * (x - left); }
  double Y(double y) const { return scale * (top - y); }
};

struct Arrow {
  double x1, y1, x2, y2;  // pixels
  bool cut;               // longer than it is drawn
};

// From a point of the world along a vector of the world.
inline Arrow ArrowOf(const Screen& screen, const Vector2<double>& from, Vector2<double> along) {
  const double longest = screen.height / 4 / screen.scale, length = along.norm();
  const bool cut = length > longest;
  if (cut) along *= longest / length;
  const Vector2<double> to = from + along;
  return {screen.X(from[0]), screen.Y(from[1]), screen.X(to[0]), screen.Y(to[1]), cut};
}

inline std::string Line(const Arrow& arrow) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#d00000\" stroke-width=\"1.5\"{} "
      "marker-end=\"url(#tip)\"/>\n",
      arrow.x1, arrow.y1, arrow.x2, arrow.y2, arrow.cut ? " stroke-dasharray=\"6 3\"" : "");
}

// The force as a picture shows it (draw.h); `force.force` acts on the first body.
template <class SceneType, class Force>
auto ShownForce(const SceneType& scene, const Force& force) {
  const auto [first, second] = force.bodies;
  const bool on_first = scene.bodies[first].fixed ? false : scene.bodies[second].fixed || first > second;
  return (on_first ? 1.0 : -1.0) * force.force;
}

inline std::string Head(const Screen& screen) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n"
      "<defs><marker id=\"tip\" markerWidth=\"6\" markerHeight=\"6\" refX=\"5\" refY=\"3\" orient=\"auto\">"
      "<path d=\"M0,0 L6,3 L0,6 z\" fill=\"#d00000\"/></marker></defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      screen.width, screen.height);
}

// Names come from files.
inline std::string Escaped(const std::string& name) {
  std::string text;
  for (const char c : name) {
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return text;
}

inline std::string PageHead(const std::string& name) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body{{font-family:sans-serif;margin:1em}} svg{{border:1px solid #ccc;max-width:100%}} "
      "input{{width:60%;vertical-align:middle}}</style></head><body><h1>{0}</h1>\n",
      Escaped(name));
}

// `data`: elements of `frames`; `show`: a function show(k) that draws number k.
inline std::string PageTail(const std::string& data, double rate, const char* show) {
  constexpr const char* kControls = R"js(
const slider = document.getElementById('frame'), play = document.getElementById('play');
const label = document.getElementById('time');
slider.max = frames.length - 1;
)js";
  constexpr const char* kPlayer = R"js(
let playing = true, began = null, first = 0;
// The last picture up to a time, which starts again after the last one.
function at(time) {
  const last = frames.length - 1, span = frames[last][0] - frames[0][0] + 1 / rate;
  const t = frames[0][0] + (time - frames[0][0]) % span;
  let k = 0;
  while (k < last && frames[k + 1][0] <= t + 1e-9) ++k;
  return k;
}
function tick(now) {
  if (playing) {
    if (began === null) { began = now; first = +slider.value; }
    show(at(frames[first][0] + (now - began) / 1000));
  }
  requestAnimationFrame(tick);
}
play.onclick = () => { playing = !playing; began = null; play.textContent = playing ? 'Pause' : 'Play'; };
slider.oninput = () => { playing = false; began = null; play.textContent = 'Play'; show(+slider.value); };
show(0);
requestAnimationFrame(tick);
)js";
  return "<p><button id=\"play\">Pause</button> <input id=\"frame\" type=\"range\" min=\"0\" value=\"0\"> "
         "<span id=\"time\"></span></p>\n" +
         fmt::format("<script>\nconst rate = {:.6g};\nconst frames = [\n", rate) + data + "];" + kControls +
         show + kPlayer + "</script></body></html>\n";
}

}  // namespace stiction

#endif  // STICTION_REPORTS_DRAW_PAGE_H_
