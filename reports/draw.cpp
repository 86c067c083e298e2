// SPDX-License-Identifier: Apache-2.0
#include "reports/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "corpus/json_text.h"
#include "reports/draw_bodies.h"
#include "scene/simulate.h"

namespace stiction {

// ---- The view --------------------------------------------------------------------------------

template <class Kind>
void View::Include(const SceneIn<Kind, double>& scene) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!(right > left)) left = bottom = kInfinite, right = top = -kInfinite;
  const auto include = [this](const typename Kind::template Vector<double>& point, double r) {
    const Vector2<double> p = Seen(point);
    left = std::min(left, p[0] - r);
    right = std::max(right, p[0] + r);
    bottom = std::min(bottom, p[1] - r);
    top = std::max(top, p[1] + r);
  };
  for (const bool fixed : {false, true}) {
    // Fixed bodies may be as large as a ground: they count where no moving body has set the view. Cranks and
    // wheels that are driven move.
    if (fixed && right > left) break;
    for (const auto& body : scene.bodies) {
      const bool turns = body.spin != Zero<typename BodyIn<Kind, double>::Spin>();
      const bool driven = turns || !body.velocity.isZero(0) || !body.acceleration.isZero(0);
      if ((body.fixed && !driven) != fixed) continue;
      include(body.position, 0.01);
      for (const auto& shape : body.shapes) {
        if (shape.IsRound()) include(body.At(shape.center), shape.radius);
        for (const auto& corner : shape.corners) include(body.At(corner), 0);
      }
    }
  }
  for (const auto& joint : scene.joints) include(scene.bodies[joint.a].At(joint.at_a), 0);
}

void View::AddMargin() {
  if (!(right > left)) left = bottom = -1, right = top = 1;  // nothing to see
  const double margin = 0.15 * std::max({right - left, top - bottom, 1e-3});
  left -= margin;
  right += margin;
  bottom -= margin;
  top += margin;
  // Not flatter nor taller than a screen.
  const double width = right - left, height = top - bottom;
  const double more_width = std::max(0.0, height - width) / 2,
               more_height = std::max(0.0, width / 2 - height) / 2;
  left -= more_width, right += more_width, bottom -= more_height, top += more_height;
}

// ---- States ----------------------------------------------------------------------------------

template <class Kind>
MarksIn<Kind> MarksOf(const SimulationIn<Kind>& simulation) {
  MarksIn<Kind> marks;
  for (const auto& contact : simulation.contacts()) marks.contacts.push_back(contact.point);
  marks.forces = simulation.forces();
  return marks;
}

template <class Kind>
FrameIn<Kind> RecordFrame(const SceneIn<Kind, double>& scene, double time, MarksIn<Kind> marks) {
  FrameIn<Kind> frame;
  frame.time = time;
  for (const auto& body : scene.bodies) frame.bodies.push_back({body.position, body.rotation});
  frame.marks = std::move(marks);
  return frame;
}

template <class Kind>
void SetPoses(SceneIn<Kind, double>& scene, const FrameIn<Kind>& frame) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    scene.bodies[i].position = frame.bodies[i].position;
    scene.bodies[i].rotation = frame.bodies[i].rotation;
  }
}

double ForceScale(const View& view, std::vector<double> largest) {
  largest.erase(std::remove(largest.begin(), largest.end(), 0.0), largest.end());
  if (largest.empty()) return 1;
  const auto median = largest.begin() + static_cast<std::ptrdiff_t>(largest.size() / 2);
  std::nth_element(largest.begin(), median, largest.end());
  return 0.15 * (view.top - view.bottom) / *median;
}

// ---- Pictures --------------------------------------------------------------------------------

namespace {

// From a point of the picture's plane along a vector of it.
Html Arrow(const Screen& screen, const Vector2<double>& from, Vector2<double> along) {
  const double longest = screen.height / 4 / screen.scale, length = along.norm();
  const bool cut = length > longest;
  if (cut) along *= longest / length;
  const Vector2<double> to = from + along;
  return Tag("line", {{"x1", Fixed(screen.X(from))},
                      {"y1", Fixed(screen.Y(from))},
                      {"x2", Fixed(screen.X(to))},
                      {"y2", Fixed(screen.Y(to))},
                      {"stroke", "#d00000"},
                      {"stroke-width", "1.5"},
                      {"stroke-dasharray", cut ? "6 3" : ""},
                      {"marker-end", "url(#tip)"}})("") +
         Html("\n");
}

// The force as a picture shows it (draw.h); `force.force` acts on the first body.
template <class Kind>
Vector2<double> ShownForce(const SceneIn<Kind, double>& scene, const AppliedForceIn<Kind>& force) {
  return (ShownSide(scene, force.bodies) == 0 ? 1.0 : -1.0) * Seen(force.force);
}

template <class Kind>
Html Marks(const SceneIn<Kind, double>& scene, const Screen& screen, const MarksIn<Kind>& marks,
           double newton) {
  Html html = Placed(scene, screen);
  for (const auto& point : marks.contacts) html += Dot(screen, Seen(point), "#30c030", 3);
  for (const auto& force : marks.forces) {
    if (force.from_joint || force.force.norm() == 0) continue;
    html += Arrow(screen, Seen(force.point), newton * ShownForce(scene, force));
  }
  return html;
}

// Each where it is.
template <class Kind>
Html Bodies(const SceneIn<Kind, double>& scene, const Screen& screen) {
  const std::vector<Html> pictures = BodyPictures(scene, screen);
  const std::vector<std::string> transforms = Transforms(scene, screen);
  Html bodies;
  for (std::size_t i = 0; i < pictures.size(); ++i)
    bodies += Tag("g", {{"transform", transforms[i]}})(pictures[i]) + Html("\n");
  return bodies;
}

Html Svg(const Screen& screen, const Html& content) {
  const std::string width = Fixed(screen.width, 0), height = Fixed(screen.height, 0);
  const Html head(
      "\n<defs><marker id=\"tip\" markerWidth=\"6\" markerHeight=\"6\" refX=\"5\" refY=\"3\" orient=\"auto\">"
      "<path d=\"M0,0 L6,3 L0,6 z\" fill=\"#d00000\"/></marker></defs>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n");
  return Tag("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                     {"width", width},
                     {"height", height},
                     {"viewBox", "0 0 " + width + " " + height}})(head + content) +
         Html("\n");
}

// Number k of `frames`: time, transforms of the bodies, and what is drawn where it is.
template <class Kind>
Json FrameJson(const SceneIn<Kind, double>& moved, const Screen& screen, const FrameIn<Kind>& frame,
               double newton) {
  return {frame.time, Transforms(moved, screen), Marks(moved, screen, frame.marks, newton).markup()};
}

const Html& PlayerStyle() {
  static const Html style(
      "<style>body{font-family:sans-serif;margin:1em} svg{border:1px solid #ccc;max-width:100%} "
      "input{width:60%;vertical-align:middle}</style>\n");
  return style;
}

const Html& PlayerControls() {
  static const Html controls(
      "<p><button id=\"play\">Pause</button> <input id=\"frame\" type=\"range\" min=\"0\" value=\"0\"> "
      "<span id=\"time\"></span></p>\n");
  return controls;
}

// Plays `frames` at `rate` frames a second.
const Html& Player() {
  static const Html player(R"js(
const slider = document.getElementById('frame'), play = document.getElementById('play');
const label = document.getElementById('time'), marks = document.getElementById('marks');
const bodies = [...document.querySelectorAll('#bodies > g')];
slider.max = frames.length - 1;
function show(k) {
  const [time, transforms, drawn] = frames[k];
  transforms.forEach((transform, i) => bodies[i].setAttribute('transform', transform));
  marks.innerHTML = drawn;
  slider.value = k;
  label.textContent = `t = ${time.toFixed(3)} s`;
}
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
)js");
  return player;
}

}  // namespace

template <class Kind>
std::string DrawSvg(const SceneIn<Kind, double>& scene, const View& view, const MarksIn<Kind>& marks,
                    double newton) {
  const Screen screen(view);
  return Svg(screen, Bodies(scene, screen) + Marks(scene, screen, marks, newton)).markup();
}

template <class Kind>
Html DrawInline(const SceneIn<Kind, double>& scene, const View& view, const MarksIn<Kind>& marks,
                const std::string& label) {
  const Screen screen(view);
  MarksIn<Kind> contacts;
  contacts.contacts = marks.contacts;
  return Tag("svg", {{"viewBox", fmt::format("0 0 {} {}", Fixed(screen.width, 0), Fixed(screen.height, 0))},
                     {"role", "img"},
                     {"aria-label", label}})(Bodies(scene, screen) + Marks(scene, screen, contacts, 1)) +
         Html("\n");
}

template <class Kind>
std::string DrawAnimation(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<FrameIn<Kind>>& frames, double newton, double rate) {
  const Screen screen(view);
  Html bodies("\n");
  for (const Html& picture : BodyPictures(scene, screen)) bodies += Tag("g")(picture) + Html("\n");
  Json data = Json::array();
  SceneIn<Kind, double> moved = scene;
  for (const auto& frame : frames) {
    SetPoses(moved, frame);
    data.push_back(FrameJson(moved, screen, frame, newton));
  }
  const Html picture = Tag("g", {{"id", "bodies"}})(bodies) + Html("\n") + Tag("g", {{"id", "marks"}})("");
  const Html script = Html("\nconst rate = ") + ScriptData(JsonText(rate)) + Html(";\nconst frames = ") +
                      ScriptData(JsonText(data)) + Html(";") + Player();
  const Html head = Html("<meta charset=\"utf-8\">") + Tag("title")(scene.name) + Html("\n") + PlayerStyle();
  const Html body = Tag("h1")(scene.name) + Html("\n") + Svg(screen, picture + Html("\n")) + PlayerControls() +
                    Tag("script")(script);
  return Document(Tag("head")(head), Tag("body")(body));
}

#define STICTION_INSTANTIATE(Kind)                                                                       \
  template void View::Include(const SceneIn<Kind, double>&);                                             \
  template MarksIn<Kind> MarksOf(const SimulationIn<Kind>&);                                             \
  template FrameIn<Kind> RecordFrame(const SceneIn<Kind, double>&, double, MarksIn<Kind>);               \
  template void SetPoses(SceneIn<Kind, double>&, const FrameIn<Kind>&);                                  \
  template std::string DrawSvg(const SceneIn<Kind, double>&, const View&, const MarksIn<Kind>&, double); \
  template Html DrawInline(const SceneIn<Kind, double>&, const View&, const MarksIn<Kind>&,              \
                           const std::string&);                                                          \
  template std::string DrawAnimation(const SceneIn<Kind, double>&, const View&,                          \
                                     const std::vector<FrameIn<Kind>>&, double, double)

STICTION_INSTANTIATE(Plane);
STICTION_INSTANTIATE(Space);

#undef STICTION_INSTANTIATE

}  // namespace stiction
