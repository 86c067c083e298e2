// SPDX-License-Identifier: Apache-2.0
#include "scene/creep.h"

#include <algorithm>
#include <cmath>

namespace stiction {

template <class Kind>
void MotionTrack<Kind>::Add(double time, const SceneIn<Kind, double>& scene,
                            const std::vector<Support>& supports) {
  if (states_.empty()) scene_ = scene;
  State state{added_++, time, {}, supports};
  for (const auto& body : scene.bodies) state.poses.push_back({body.position, body.rotation});
  state.supports.resize(scene.bodies.size());
  states_.push_back(std::move(state));
  const std::size_t last = states_.size() - 1;
  if (last > 0 && states_[last - 1].number % stride_ != 0) RemoveBefore(last);
  if (states_.size() <= kMostStates) return;
  stride_ *= 2;
  for (std::size_t i = states_.size() - 1; i-- > 0;) {
    if (states_[i].number % stride_ != 0) RemoveBefore(i + 1);
  }
}

// The state before this one goes; what bore on its bodies did so before this one.
template <class Kind>
void MotionTrack<Kind>::RemoveBefore(std::size_t at) {
  for (std::size_t body = 0; body < states_[at].supports.size(); ++body) {
    states_[at].supports[body].is_borne |= states_[at - 1].supports[body].is_borne;
    states_[at].supports[body].slides |= states_[at - 1].supports[body].slides;
  }
  states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(at) - 1);
}

// The last but the very last.
template <class Kind>
std::size_t MotionTrack<Kind>::LastUpTo(double time) const {
  std::size_t last = 0;
  for (std::size_t i = 1; i + 1 < states_.size(); ++i) {
    if (states_[i].time <= time) last = i;
  }
  return last;
}

// How far any point of the body is from where it was.
template <class Kind>
double MotionTrack<Kind>::Moved(int body, std::size_t from, std::size_t to) const {
  using Vector = typename Kind::template Vector<double>;
  const Pose &before = states_[from].poses[body], &after = states_[to].poses[body];
  const auto turn_before = TurnOf(before.rotation), turn_after = TurnOf(after.rotation);
  const Vector way = after.position - before.position;
  const auto moved = [&](const Vector& local) {
    return Vector(way + Rotate(turn_after, local) - Rotate(turn_before, local));
  };
  const auto& shapes = scene_.bodies[body].shapes;
  double most = shapes.empty() ? way.norm() : 0;
  for (const auto& shape : shapes) {
    for (const auto& corner : shape.corners) most = std::max(most, moved(corner).norm());
    if (!shape.IsRound()) continue;
    // The norm of a difference of rotations is that of its columns by the root of 2: one direction, or none,
    // stays.
    double squares = 0;
    for (int k = 0; k < Kind::kDimension; ++k) {
      const Vector axis = Vector::Unit(k);
      squares += (moved(axis) - way).squaredNorm();
    }
    most = std::max(most, moved(shape.center).norm() + shape.radius * std::sqrt(squares / 2));
  }
  return most;
}

template <class Kind>
double MotionTrack<Kind>::MostMoved(int body, std::size_t from) const {
  double most = 0;
  for (std::size_t to = from + 1; to < states_.size(); ++to) most = std::max(most, Moved(body, from, to));
  return most;
}

template <class Kind>
std::vector<BodyMotion> MotionTrack<Kind>::Motions() const {
  std::vector<BodyMotion> motions;
  if (states_.size() < 2) return motions;
  const double begin = states_.front().time, end = states_.back().time;
  const std::size_t window = LastUpTo((begin + end) / 2), part = LastUpTo((begin + 3 * end) / 4);
  for (int body = 0; body < static_cast<int>(scene_.bodies.size()); ++body) {
    if (scene_.bodies[body].fixed) continue;
    BodyMotion motion{body, MostMoved(body, window), end - states_[window].time,
                      MostMoved(body, part) / (end - states_[part].time), ""};
    Support support;
    for (std::size_t i = part + 1; i < states_.size(); ++i) {
      support.is_borne |= states_[i].supports[body].is_borne;
      support.slides |= states_[i].supports[body].slides;
    }
    motion.word = motion.speed <= kRestSpeed    ? "rests"
                  : !support.is_borne           ? "flies"
                  : motion.speed <= kCreepSpeed ? "creeps"
                  : support.slides              ? "slides"
                                                : "moves";
    motions.push_back(motion);
  }
  return motions;
}

template class MotionTrack<Plane>;
template class MotionTrack<Space>;

}  // namespace stiction
