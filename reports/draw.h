// SPDX-License-Identifier: Apache-2.0
// Draw: a state as an SVG, a run as one HTML page that moves. Text only; no file is written here.
//
// Fixed bodies are dark, others have the colour of their level; joints are white circles, contacts green ones,
// forces of contacts red arrows, as they act on the body that moves, or on the later one of two. An arrow that
// would be longer than a quarter of the picture's height is dashed and that long.

#ifndef STICTION_REPORTS_DRAW_H_
#define STICTION_REPORTS_DRAW_H_

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "scene/simulate.h"

namespace stiction {

// The part of the plane that is shown.
struct View {
  double left = 0, right = 0, bottom = 0, top = 0;

  void Include(const Scene<double>& scene);  // bodies that move, and joints; all bodies if none moves
  void AddMargin();
};

// What is drawn besides the bodies.
struct Marks {
  std::vector<Vector2<double>> contacts;
  std::vector<AppliedForce> forces;
};
Marks MarksOf(const Simulation& simulation);

// What a page needs of a state.
struct RecordedFrame {
  double time = 0;                            // s
  std::vector<std::array<double, 4>> bodies;  // x, y, cos, sin
  Marks marks;
};
RecordedFrame RecordFrame(const Scene<double>& scene, double time, Marks marks);
void SetPoses(Scene<double>& scene, const RecordedFrame& frame);

// The largest force of a contact, N; 0 if there is none.
template <class MarksType>
double LargestForce(const MarksType& marks) {
  double largest = 0;
  for (const auto& force : marks.forces) {
    if (!force.from_joint) largest = std::max(largest, force.force.norm());
  }
  return largest;
}
// A newton in metres: 0.15 of the view's height for the median of these forces, zeros left out, each the
// largest of a picture.
double ForceScale(const View& view, std::vector<double> largest);

std::string DrawSvg(const Scene<double>& scene, const View& view, const Marks& marks, double newton);
// `scene` gives shapes and colours, frames the poses. `rate`: frames a second when played.
std::string DrawAnimation(const Scene<double>& scene, const View& view,
                          const std::vector<RecordedFrame>& frames, double newton, double rate);

// The types of a scene's drawing.
template <class SceneType>
struct DrawingOf;

template <>
struct DrawingOf<Scene<double>> {
  using FrameType = RecordedFrame;
  using ViewType = View;
};

}  // namespace stiction

#endif  // STICTION_REPORTS_DRAW_H_
