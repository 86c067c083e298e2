// SPDX-License-Identifier: Apache-2.0
#include "reports/pictures/draw.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "corpus/order_statistics.h"
#include "reports/pictures/draw_bodies.h"
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
  return 0.15 * (view.top - view.bottom) / QuartilesOf(std::move(largest)).median;
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

}  // namespace

template <class Kind>
std::string DrawSvg(const SceneIn<Kind, double>& scene, const View& view, const MarksIn<Kind>& marks,
                    double newton, const Overlay& over) {
  Screen screen(view);
  const Html content = Bodies(scene, screen) + Marks(scene, screen, marks, newton) + over.html;
  screen.height += over.below;
  return Svg(screen, content).markup();
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

#define STICTION_INSTANTIATE(Kind)                                                                      \
  template void View::Include(const SceneIn<Kind, double>&);                                            \
  template MarksIn<Kind> MarksOf(const SimulationIn<Kind>&);                                            \
  template FrameIn<Kind> RecordFrame(const SceneIn<Kind, double>&, double, MarksIn<Kind>);              \
  template void SetPoses(SceneIn<Kind, double>&, const FrameIn<Kind>&);                                 \
  template std::string DrawSvg(const SceneIn<Kind, double>&, const View&, const MarksIn<Kind>&, double, \
                               const Overlay&);                                                         \
  template Html DrawInline(const SceneIn<Kind, double>&, const View&, const MarksIn<Kind>&, const std::string&)

STICTION_INSTANTIATE(Plane);
STICTION_INSTANTIATE(Space);

#undef STICTION_INSTANTIATE

}  // namespace stiction
