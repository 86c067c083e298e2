// SPDX-License-Identifier: Apache-2.0
// What two bodies of a scene are to each other: whether they may touch, and their friction; all pairs of pieces
// that may and are near. Plane and space.

#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stiction {

template <class Scalar>
struct PairFacts {
  bool collide = true;
  Scalar mu = Scalar(0);
};

// The facts of all pairs of bodies. Holds a reference to the scene.
template <class SceneType>
class PairTable {
 public:
  using Scalar = decltype(SceneType::mu);

  explicit PairTable(const SceneType& scene) : scene_(scene) {
    const auto add = [this](const auto& of, int number) {
      exceptions_.push_back({std::min(of.a, of.b), std::max(of.a, of.b), number});
    };
    for (const auto& joint : scene.joints) add(joint, kJoint);
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) add(scene.pairs[i], static_cast<int>(i));
    std::sort(exceptions_.begin(), exceptions_.end());
  }

  // In the logarithm of the numbers of joints and rules. A later rule overrides an earlier one, and any rule a
  // joint.
  PairFacts<Scalar> Of(int a, int b) const {
    PairFacts<Scalar> facts;
    facts.mu = scene_.mu;
    facts.collide = scene_.bodies[a].level == scene_.bodies[b].level;
    const int first = std::min(a, b), second = std::max(a, b);
    auto at = std::lower_bound(exceptions_.begin(), exceptions_.end(), Exception{first, second, kJoint});
    for (; at != exceptions_.end() && (*at)[0] == first && (*at)[1] == second; ++at) {
      if ((*at)[2] == kJoint) {
        facts.collide = false;
        continue;
      }
      const auto& rule = scene_.pairs[(*at)[2]];
      if (rule.mu) facts.mu = *rule.mu;
      if (rule.collide) facts.collide = *rule.collide;
    }
    facts.collide = facts.collide && !(scene_.bodies[a].fixed && scene_.bodies[b].fixed);
    return facts;
  }

 private:
  using Exception = std::array<int, 3>;  // the lower body, the higher, and the number of a rule or kJoint
  static constexpr int kJoint = -1;

  const SceneType& scene_;
  std::vector<Exception> exceptions_;
};

inline double AsDouble(double x) { return x; }
inline double AsDouble(const mpq_class& x) { return x.get_d(); }

// The bounding box of a body over doubles. Boxes of bodies that have pieces whose own boxes are no farther
// apart than the reach overlap: lower ends are lowered by it, and all are moved outward by more than what
// rounding does, here and where the boxes of pieces are compared.
template <int Dimension>
struct ReachBox {
  std::array<double, Dimension> low, high;
  int body = 0;

  template <class Placed>
  ReachBox(int body, const std::vector<Placed>& pieces, double reach) : body(body) {
    low.fill(HUGE_VAL);
    high.fill(-HUGE_VAL);
    for (const Placed& piece : pieces) {
      for (int i = 0; i < Dimension; ++i) Include(i, AsDouble(piece.low[i]), AsDouble(piece.high[i]), reach);
    }
  }

  bool Overlaps(const ReachBox& other) const {
    for (int i = 0; i < Dimension; ++i) {
      if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
    }
    return true;
  }

 private:
  void Include(int i, double from, double to, double reach) {
    const double rounding =
        0x1p-50 * (std::abs(from) + std::abs(to) + reach) + std::numeric_limits<double>::min();
    const double below = from - reach - rounding, above = to + rounding;
    const bool is_number = below <= above;  // what is none is everywhere
    low[i] = is_number ? std::min(low[i], below) : -HUGE_VAL;
    high[i] = is_number ? std::max(high[i], above) : HUGE_VAL;
  }
};

// The coordinate in which the centres of the boxes are spread widest.
template <int Dimension>
int WidestAxis(const std::vector<ReachBox<Dimension>>& boxes) {
  std::array<double, Dimension> sum{}, squares{};
  for (const auto& box : boxes) {
    for (int i = 0; i < Dimension; ++i) {
      const double center = box.low[i] + box.high[i];
      sum[i] += center;
      squares[i] += center * center;
    }
  }
  const auto spread = [&](int i) { return squares[i] - sum[i] * sum[i] / static_cast<double>(boxes.size()); };
  int widest = 0;
  for (int i = 1; i < Dimension; ++i) {
    if (spread(i) > spread(widest)) widest = i;
  }
  return widest;
}

// The pairs of bodies whose boxes overlap, in order. `placed` holds the pieces of each body, with their boxes
// `low` and `high`. Sorts along the widest axis and sweeps: n log n, and what overlaps in that coordinate.
template <class Placed, class Scalar>
std::vector<std::array<int, 2>> NearBodies(const std::vector<std::vector<Placed>>& placed,
                                           const Scalar& reach) {
  using Box = ReachBox<decltype(Placed::low)::RowsAtCompileTime>;
  std::vector<Box> boxes;
  boxes.reserve(placed.size());
  for (std::size_t a = 0; a < placed.size(); ++a) {
    if (!placed[a].empty()) boxes.emplace_back(static_cast<int>(a), placed[a], AsDouble(reach));
  }
  const int axis = WidestAxis(boxes);
  std::sort(boxes.begin(), boxes.end(),
            [axis](const Box& p, const Box& q) { return p.low[axis] < q.low[axis]; });
  std::vector<std::array<int, 2>> near;
  for (auto p = boxes.begin(); p != boxes.end(); ++p) {
    for (auto q = p + 1; q != boxes.end() && q->low[axis] <= p->high[axis]; ++q) {
      if (p->Overlaps(*q)) near.push_back({std::min(p->body, q->body), std::max(p->body, q->body)});
    }
  }
  std::sort(near.begin(), near.end());
  return near;
}

inline constexpr std::size_t kFewBodies = 12;  // up to here looking at all pairs is faster

// visit(a, b), a < b, for all pairs of bodies that are near, in order, and for others.
template <class Placed, class Scalar, class Visit>
void ForEachNear(const std::vector<std::vector<Placed>>& placed, const Scalar& reach, const Visit& visit) {
  if (placed.size() > kFewBodies) {
    for (const auto& [a, b] : NearBodies(placed, reach)) visit(a, b);
    return;
  }
  const int bodies = static_cast<int>(placed.size());
  for (int a = 0; a < bodies; ++a) {
    for (int b = a + 1; b < bodies; ++b) visit(a, b);
  }
}

// visit(pattern, piece of a, piece of b) for all pairs of pieces that may touch, and whose bodies are within
// the reach. The pattern is a Touch that names bodies and pieces, and has their friction.
template <class Touch, class SceneType, class Placed, class Scalar, class Visit>
void ForEachPair(const PairTable<SceneType>& table, const std::vector<std::vector<Placed>>& placed,
                 const Scalar& reach, const Visit& visit) {
  ForEachNear(placed, reach, [&](int a, int b) {
    const auto facts = table.Of(a, b);
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
  });
}

}  // namespace stiction
