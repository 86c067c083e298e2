// SPDX-License-Identifier: Apache-2.0
// Draw: a state as an SVG, a run as one HTML page that moves. Text only; no file is written here.
//
// Fixed bodies are dark, others have the colour of their level; joints are white circles, contacts green ones,
// forces red arrows from where they act on the first body of the contact.

#ifndef STICTION_SOLVER_SCENE_DRAW_H_
#define STICTION_SOLVER_SCENE_DRAW_H_

#include <array>
#include <string>
#include <vector>

#include "solver/scene/simulate.h"

namespace stiction {

// The part of the plane that is shown.
struct View {
  double left = 0, right = 0, bottom = 0, top = 0;

  void Include(const Scene<double>& scene);  // bodies that move, and the corners of fixed ones near them
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
RecordedFrame Record(const Scene<double>& scene, double time, Marks marks);
void SetPoses(Scene<double>& scene, const RecordedFrame& frame);

// A newton in metres: a quarter of the view for the weight of all bodies that move, or 1 without gravity.
double ForceScale(const Scene<double>& scene, const View& view);

std::string DrawSvg(const Scene<double>& scene, const View& view, const Marks& marks);
// `scene` gives shapes and colours, frames the poses. `rate`: frames a second when played.
std::string DrawAnimation(const Scene<double>& scene, const View& view,
                          const std::vector<RecordedFrame>& frames, double rate);

// The types of a scene's drawing.
template <class SceneType>
struct DrawingOf;

template <>
struct DrawingOf<Scene<double>> {
  using FrameType = RecordedFrame;
  using ViewType = View;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_SCENE_DRAW_H_
