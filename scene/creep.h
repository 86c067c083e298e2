// SPDX-License-Identifier: Apache-2.0
// Does it really rest? How far each body of a run moved at its end, how fast, and a word for it.
//
// The window is the second half of the run, its last part the last quarter. Of a body
//
//   moved   how far any of its points gets from where it was when the window began, m
//   speed   the same from where it was when the last part began, divided by the time of that part, m/s
//
// (corners of polygons and polyhedra, every point of a disc, of a ball a bound; of a body without pieces its
// centre). The word, the first that holds:
//
//   rests    speed <= kRestSpeed
//   flies    nothing bears on it in the last part: no contact with a force, no joint. What falls flies
//   creeps   speed <= kCreepSpeed: slower than anything that is seen to move, and it does not stay
//   slides   one of its contacts slides in the last part
//   moves    any other way: it swings, rolls, tips, or is carried along
//
// A body that trembles about its place has the speed of its width, and creeps by this measure. Bodies that are
// fixed have no word.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace stiction {

inline constexpr double kRestSpeed = 1e-6, kCreepSpeed = 1e-3;  // m/s

struct BodyMotion {
  int body = 0;
  double moved = 0;    // m
  double seconds = 0;  // of the window
  double speed = 0;    // m/s
  std::string_view word;
};

// What bears on a body within a step.
struct Support {
  bool is_borne = false, slides = false;
};

// The states of a run, of which at most kMostStates are kept, at even distances.
template <class Kind>
class MotionTrack {
 public:
  // A state, later than those before. `supports`: by body, of the time since the state before; they may be
  // those of no body where nothing bears on any.
  void Add(double time, const SceneIn<Kind, double>& scene, const std::vector<Support>& supports);

  // Of each body that is not fixed, in order; empty before a second state.
  std::vector<BodyMotion> Motions() const;

 private:
  static constexpr std::size_t kMostStates = 128;

  struct Pose {
    typename Kind::template Vector<double> position;
    typename Kind::template Rotation<double> rotation;
  };
  struct State {
    std::int64_t number = 0;
    double time = 0;
    std::vector<Pose> poses;
    std::vector<Support> supports;
  };
  void RemoveBefore(std::size_t at);
  std::size_t LastUpTo(double time) const;
  double Moved(int body, std::size_t from, std::size_t to) const;
  double MostMoved(int body, std::size_t from) const;

  SceneIn<Kind, double> scene_;  // of the first state, for its shapes
  std::vector<State> states_;    // of multiples of stride_, and the last one
  std::int64_t added_ = 0, stride_ = 1;
};

}  // namespace stiction
