// SPDX-License-Identifier: Apache-2.0
#include "reports/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/draw_page.h"

namespace stiction {
namespace {

constexpr std::array kLevelColours = {"#e89a3c", "#9a6fb0", "#6aa84f", "#4f81bd", "#c0504d"};

const char* ColourOf(const RigidBody<double>& body) {
  if (body.fixed) return "#333333";
  const int count = static_cast<int>(kLevelColours.size());
  return kLevelColours[static_cast<std::size_t>(((body.level % count) + count) % count)];
}

// The pieces of a body in its own coordinates, y up; behind them a rod to each of its joints.
std::string Pieces(const Scene<double>& scene, int index, double scale) {
  const RigidBody<double>& body = scene.bodies[index];
  std::string text;
  for (const auto& joint : scene.joints) {
    if (body.fixed || (joint.a != index && joint.b != index)) continue;
    const Vector2<double>& at = joint.a == index ? joint.at_a : joint.at_b;
    text += fmt::format("<path d=\"M0,0 L{:.5g},{:.5g}\"/>", at[0], at[1]);
  }
  for (const auto& shape : body.shapes) {
    if (shape.IsDisc()) {
      // The radius line shows the turning.
      text += fmt::format(
          "<circle cx=\"{0:.5g}\" cy=\"{1:.5g}\" r=\"{2:.5g}\"/><path d=\"M{0:.5g},{1:.5g} h{2:.5g}\"/>",
          shape.center[0], shape.center[1], shape.radius);
      continue;
    }
    text += "<polygon points=\"";
    for (const auto& corner : shape.polygon) text += fmt::format("{:.6g},{:.6g} ", corner[0], corner[1]);
    text += "\"/>";
  }
  return fmt::format("<g fill=\"{}\" stroke=\"black\" stroke-width=\"{:.4g}\" fill-opacity=\"0.85\">{}</g>",
                     ColourOf(body), 1 / scale, text);
}

std::string Matrix(const Screen& screen, double x, double y, double c, double s) {
  const double k = screen.scale;
  return fmt::format("matrix({:.5g} {:.5g} {:.5g} {:.5g} {:.5g} {:.5g})", k * c, -k * s, -k * s, -k * c,
                     screen.X(x), screen.Y(y));
}

std::string Circle(const Screen& screen, const Vector2<double>& p, const char* fill, double radius) {
  return fmt::format("<circle cx=\"{:.5g}\" cy=\"{:.5g}\" r=\"{}\" fill=\"{}\" stroke=\"black\"/>\n",
                     screen.X(p[0]), screen.Y(p[1]), radius, fill);
}

}  // namespace

void View::Include(const Scene<double>& scene) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!(right > left)) left = bottom = kInfinite, right = top = -kInfinite;
  const auto include = [this](const Vector2<double>& p, double r) {
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
      const bool driven = body.spin != 0 || !body.velocity.isZero(0) || !body.acceleration.isZero(0);
      if ((body.fixed && !driven) != fixed) continue;
      include(body.position, 0.01);
      for (const auto& shape : body.shapes) {
        if (shape.IsDisc()) include(body.At(shape.center), shape.radius);
        for (const auto& corner : shape.polygon) include(body.At(corner), 0);
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

Marks MarksOf(const Simulation& simulation) {
  Marks marks;
  for (const auto& contact : simulation.contacts()) marks.contacts.push_back(contact.point);
  marks.forces = simulation.forces();
  return marks;
}

RecordedFrame RecordFrame(const Scene<double>& scene, double time, Marks marks) {
  RecordedFrame frame;
  frame.time = time;
  for (const auto& body : scene.bodies)
    frame.bodies.push_back({body.position[0], body.position[1], body.rotation[0], body.rotation[1]});
  frame.marks = std::move(marks);
  return frame;
}

void SetPoses(Scene<double>& scene, const RecordedFrame& frame) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const auto& [x, y, c, s] = frame.bodies[i];
    scene.bodies[i].position = {x, y};
    scene.bodies[i].rotation = {c, s};
  }
}

double ForceScale(const View& view, std::vector<double> largest) {
  largest.erase(std::remove(largest.begin(), largest.end(), 0.0), largest.end());
  if (largest.empty()) return 1;
  const auto median = largest.begin() + static_cast<std::ptrdiff_t>(largest.size() / 2);
  std::nth_element(largest.begin(), median, largest.end());
  return 0.15 * (view.top - view.bottom) / *median;
}

std::string DrawSvg(const Scene<double>& scene, const View& view, const Marks& marks, double newton) {
  const Screen screen(view);
  std::string text = Head(screen);
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) {
    const auto& body = scene.bodies[i];
    text += fmt::format("<g transform=\"{}\">{}</g>\n",
                        Matrix(screen, body.position[0], body.position[1], body.rotation[0], body.rotation[1]),
                        Pieces(scene, i, screen.scale));
  }
  for (const auto& joint : scene.joints)
    text += Circle(screen, scene.bodies[joint.a].At(joint.at_a), "white", 4);
  for (const auto& point : marks.contacts) text += Circle(screen, point, "#30c030", 3);
  for (const auto& force : marks.forces) {
    if (force.from_joint || force.force.norm() == 0) continue;
    text += Line(ArrowOf(screen, force.point, newton * ShownForce(scene, force)));
  }
  return text + "</svg>\n";
}

namespace {

std::string FrameData(const Scene<double>& scene, const Screen& screen, const RecordedFrame& frame,
                      double newton) {
  std::string poses, joints, contacts, forces;
  Scene<double> moved = scene;
  SetPoses(moved, frame);
  for (const auto& [x, y, c, s] : frame.bodies) poses += '"' + Matrix(screen, x, y, c, s) + "\",";
  for (const auto& joint : scene.joints) {
    const Vector2<double> p = moved.bodies[joint.a].At(joint.at_a);
    joints += fmt::format("[{:.1f},{:.1f}],", screen.X(p[0]), screen.Y(p[1]));
  }
  for (const auto& p : frame.marks.contacts)
    contacts += fmt::format("[{:.1f},{:.1f}],", screen.X(p[0]), screen.Y(p[1]));
  for (const auto& force : frame.marks.forces) {
    if (force.from_joint || force.force.norm() == 0) continue;
    const Arrow arrow = ArrowOf(screen, force.point, newton * ShownForce(scene, force));
    forces +=
        fmt::format("[{:.1f},{:.1f},{:.1f},{:.1f},{:d}],", arrow.x1, arrow.y1, arrow.x2, arrow.y2, arrow.cut);
  }
  return fmt::format("[{:.9g},[{}],[{}],[{}],[{}]],\n", frame.time, poses, joints, contacts, forces);
}

constexpr const char* kShow = R"js(
const bodies = [...document.querySelectorAll('#bodies > g')], marks = document.getElementById('marks');
function circle(p, fill, r) { return `<circle cx="${p[0]}" cy="${p[1]}" r="${r}" fill="${fill}" stroke="black"/>`; }
function show(k) {
  const [time, poses, joints, contacts, forces] = frames[k];
  poses.forEach((m, i) => bodies[i].setAttribute('transform', m));
  marks.innerHTML = joints.map(p => circle(p, 'white', 4)).join('') +
    contacts.map(p => circle(p, '#30c030', 3)).join('') +
    forces.map(f => `<line x1="${f[0]}" y1="${f[1]}" x2="${f[2]}" y2="${f[3]}" stroke="#d00000" ` +
      `stroke-width="1.5" ${f[4] ? 'stroke-dasharray="6 3"' : ''} marker-end="url(#tip)"/>`).join('');
  slider.value = k;
  label.textContent = `t = ${time.toFixed(3)} s`;
}
)js";

}  // namespace

std::string DrawAnimation(const Scene<double>& scene, const View& view,
                          const std::vector<RecordedFrame>& frames, double newton, double rate) {
  const Screen screen(view);
  std::string text = PageHead(scene.name);
  text += Head(screen) + "<g id=\"bodies\">\n";
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    text += "<g>" + Pieces(scene, i, screen.scale) + "</g>\n";
  text += "</g>\n<g id=\"marks\"></g>\n</svg>\n";
  std::string data;
  for (const auto& frame : frames) data += FrameData(scene, screen, frame, newton);
  return text + PageTail(data, rate, kShow);
}

}  // namespace stiction
