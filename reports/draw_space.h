// SPDX-License-Identifier: Apache-2.0
// Draw in space: draw.h seen from one direction, without perspective.
//
// Faces that look away are left out; convex pieces are drawn from the back to the front. Of two pieces that a
// face's plane parts, the one on the viewer's side is in front.

#ifndef STICTION_REPORTS_DRAW_SPACE_H_
#define STICTION_REPORTS_DRAW_SPACE_H_

#include <string>
#include <vector>

#include "reports/draw.h"
#include "scene/simulate_space.h"

namespace stiction {

// The part of the picture's plane that is shown.
struct ViewInSpace : View {
  void Include(const SceneInSpace<double>& scene);  // bodies that move; all if none does
};

struct MarksInSpace {
  std::vector<Vector3<double>> contacts;
  std::vector<AppliedForceIn<3>> forces;
};
MarksInSpace MarksOf(const SimulationInSpace& simulation);

struct RecordedFrameInSpace {
  struct Pose {
    Vector3<double> position;
    Quaternion<double> rotation;
  };
  double time = 0;  // s
  std::vector<Pose> bodies;
  MarksInSpace marks;
};
RecordedFrameInSpace RecordFrame(const SceneInSpace<double>& scene, double time, MarksInSpace marks);
void SetPoses(SceneInSpace<double>& scene, const RecordedFrameInSpace& frame);

std::string DrawSvg(const SceneInSpace<double>& scene, const ViewInSpace& view, const MarksInSpace& marks,
                    double newton);
std::string DrawAnimation(const SceneInSpace<double>& scene, const ViewInSpace& view,
                          const std::vector<RecordedFrameInSpace>& frames, double newton, double rate);

template <>
struct DrawingOf<SceneInSpace<double>> {
  using FrameType = RecordedFrameInSpace;
  using ViewType = ViewInSpace;
};

}  // namespace stiction

#endif  // STICTION_REPORTS_DRAW_SPACE_H_
