// SPDX-License-Identifier: Apache-2.0
// What two bodies of a scene are to each other: whether they may touch, and their friction. Plane and space.

#ifndef STICTION_SOLVER_SCENE_PAIR_FACTS_H_
#define STICTION_SOLVER_SCENE_PAIR_FACTS_H_

#include <algorithm>

namespace stiction {

template <class Scalar>
struct PairFacts {
  bool collide = true;
  Scalar mu = Scalar(0);
};

template <template <class> class SceneType, class Scalar>
PairFacts<Scalar> FactsOf(const SceneType<Scalar>& scene, int a, int b) {
  const auto is_pair = [a, b](const auto& of) { return (of.a == a && of.b == b) || (of.a == b && of.b == a); };
  PairFacts<Scalar> facts;
  facts.mu = scene.mu;
  facts.collide = scene.bodies[a].level == scene.bodies[b].level &&
                  std::none_of(scene.joints.begin(), scene.joints.end(), is_pair);
  for (const auto& rule : scene.pairs) {
    if (!is_pair(rule)) continue;
    if (rule.mu) facts.mu = *rule.mu;
    if (rule.collide) facts.collide = *rule.collide;
  }
  facts.collide = facts.collide && !(scene.bodies[a].fixed && scene.bodies[b].fixed);
  return facts;
}

}  // namespace stiction

#endif  // STICTION_SOLVER_SCENE_PAIR_FACTS_H_
