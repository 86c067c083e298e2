// SPDX-License-Identifier: Apache-2.0
// Draw: a state as an SVG. Text only; no file is written here. animation.h has the page of a run.
//
// Fixed bodies are dark or grey, others have the colour of their level; joints are white circles, contacts
// green ones, forces of contacts red arrows, as they act on the body that moves, or on the later one of two. An
// arrow that would be longer than a quarter of the picture's height is dashed and that long. Space is seen from
// one direction, without perspective.

#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "reports/html/html.h"
#include "scene/plane.h"
#include "scene/scene.h"

namespace stiction {

// scene/simulate.h
template <class Kind, class Scalar>
struct TouchPointIn;
template <class Kind>
struct AppliedForceIn;
template <class Kind>
class SimulationIn;

// The part of the plane, or of the picture's plane, that is shown.
struct View {
  double left = 0, right = 0, bottom = 0, top = 0;

  // Bodies that move, and joints; all bodies if none moves.
  template <class Kind>
  void Include(const SceneIn<Kind, double>& scene);
  void AddMargin();
};

// What is drawn besides the bodies.
template <class Kind>
struct MarksIn {
  std::vector<typename Kind::template Vector<double>> contacts;
  std::vector<AppliedForceIn<Kind>> forces;
};
template <class Kind>
MarksIn<Kind> MarksOf(const SimulationIn<Kind>& simulation);

// What a page needs of a state.
template <class Kind>
struct FrameIn {
  struct Pose {
    typename Kind::template Vector<double> position;
    typename Kind::template Rotation<double> rotation;
  };
  double time = 0;  // s
  std::vector<Pose> bodies;
  MarksIn<Kind> marks;
  std::vector<std::string> problems = {};  // that the forces solve, as texts of stiction-problem files
  std::string remark = {};                 // what is to be said of it
  std::array<double, 2> energy = {};       // J: kinetic, potential
  std::array<double, 2> drift = {};        // m: of joints, overlap, the worst since the frame before
};
template <class Kind>
FrameIn<Kind> RecordFrame(const SceneIn<Kind, double>& scene, double time, MarksIn<Kind> marks);
template <class Kind>
void SetPoses(SceneIn<Kind, double>& scene, const FrameIn<Kind>& frame);

// The largest force of a contact, N; 0 if there is none.
template <class Kind>
double LargestForce(const MarksIn<Kind>& marks) {
  double largest = 0;
  for (const auto& force : marks.forces) {
    if (!force.from_joint) largest = std::max(largest, force.force.norm());
  }
  return largest;
}
// A newton in metres: 0.15 of the view's height for the median of these forces, zeros left out, each the
// largest of a picture.
double ForceScale(const View& view, std::vector<double> largest);

// What is drawn over all else, and pixels that stand below the picture for it.
struct Overlay {
  Html html = {};
  double below = 0;
};
template <class Kind>
std::string DrawSvg(const SceneIn<Kind, double>& scene, const View& view, const MarksIn<Kind>& marks,
                    double newton, const Overlay& over = {});
// The same as a picture of its own: the number of each contact, as `assemble --explain` has it; its cone, of
// the body that the force is shown on; joints as pins; gravity; how long a metre and a newton are.
template <class Kind>
std::string DrawExplained(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<TouchPointIn<Kind, double>>& touches,
                          const std::vector<AppliedForceIn<Kind>>& forces, double newton);
// The same in a page with others: with contacts alone, and no id. `label` says what is seen.
template <class Kind>
Html DrawInline(const SceneIn<Kind, double>& scene, const View& view, const MarksIn<Kind>& marks,
                const std::string& label);

}  // namespace stiction
