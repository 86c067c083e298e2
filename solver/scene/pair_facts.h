// SPDX-License-Identifier: Apache-2.0
// What two bodies of a scene are to each other: whether they may touch, and their friction; all pairs of pieces
// that may. Plane and space.

#ifndef STICTION_SOLVER_SCENE_PAIR_FACTS_H_
#define STICTION_SOLVER_SCENE_PAIR_FACTS_H_

#include <algorithm>
#include <vector>

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

// visit(pattern, piece of a, piece of b) for all pairs of pieces that may touch; `placed` holds each body's.
// The pattern is a Touch that names bodies and pieces, and has their friction.
template <class Touch, class SceneType, class Placed, class Visit>
void ForEachPair(const SceneType& scene, const std::vector<std::vector<Placed>>& placed, const Visit& visit) {
  const int bodies = static_cast<int>(placed.size());
  for (int a = 0; a < bodies; ++a) {
    for (int b = a + 1; b < bodies; ++b) {
      const auto facts = FactsOf(scene, a, b);
      for (std::size_t i = 0; facts.collide && i < placed[a].size(); ++i) {
        for (std::size_t j = 0; j < placed[b].size(); ++j) {
          Touch pattern;
          pattern.a = a;
          pattern.b = b;
          pattern.shape_a = static_cast<int>(i);
          pattern.shape_b = static_cast<int>(j);
          pattern.mu = facts.mu;
          visit(pattern, placed[a][i], placed[b][j]);
        }
      }
    }
  }
}

}  // namespace stiction

#endif  // STICTION_SOLVER_SCENE_PAIR_FACTS_H_
