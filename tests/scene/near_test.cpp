// SPDX-License-Identifier: Apache-2.0
// What is passed over quickly: bodies that are far apart, and contacts that cannot be redundant. Nothing is
// missed that looking at all pairs would find.

#include <catch2/catch.hpp>
#include <random>

#include "corpus/rational.h"
#include "scene/contacts.h"
#include "scene/mechanics.ipp"
#include "scene/pair_facts.h"
#include "scene/polyhedron.h"

namespace stiction {
namespace {

using Random = std::mt19937;

int Below(Random& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

template <class T>
T OneOf(Random& random, const std::vector<T>& choices) {
  return choices[Below(random, static_cast<int>(choices.size()))];
}

// ---- Boxes -----------------------------------------------------------------------------------

template <class Scalar, int Dimension>
struct Piece {
  Eigen::Matrix<Scalar, Dimension, 1> low, high;
};

// Tenths: over doubles their differences are as often a little above as below.
template <class Scalar>
Scalar Tenths(int n) {
  return Scalar(n) / Scalar(10);
}

template <class Scalar, int Dimension>
std::vector<std::vector<Piece<Scalar, Dimension>>> RandomPieces(Random& random, int bodies) {
  std::vector<std::vector<Piece<Scalar, Dimension>>> placed(bodies);
  for (auto& pieces : placed) {
    pieces.resize(Below(random, 4));
    for (auto& piece : pieces) {
      for (int i = 0; i < Dimension; ++i) {
        const int low = Below(random, 100) - 50;
        piece.low[i] = Tenths<Scalar>(low);
        piece.high[i] = Tenths<Scalar>(low + Below(random, 15));
      }
    }
  }
  return placed;
}

template <class Scalar, int Dimension>
bool AreWithin(const Scalar& reach, const Piece<Scalar, Dimension>& p, const Piece<Scalar, Dimension>& q) {
  for (int i = 0; i < Dimension; ++i) {
    if (p.low[i] - q.high[i] > reach || q.low[i] - p.high[i] > reach) return false;
  }
  return true;
}

template <class Scalar, int Dimension>
Piece<Scalar, Dimension> BoxOf(const std::vector<Piece<Scalar, Dimension>>& pieces) {
  Piece<Scalar, Dimension> box = pieces.at(0);
  for (const auto& piece : pieces) {
    for (int i = 0; i < Dimension; ++i) {
      box.low[i] = std::min<Scalar>(box.low[i], piece.low[i]);
      box.high[i] = std::max<Scalar>(box.high[i], piece.high[i]);
    }
  }
  return box;
}

template <class Scalar, int Dimension>
void CheckNearBodies(int scenes) {
  Random random(1);
  int near_pairs = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    const auto placed = RandomPieces<Scalar, Dimension>(random, 1 + Below(random, 40));
    const Scalar reach = Tenths<Scalar>(Below(random, 4));
    const auto near = NearBodies(placed, reach);
    CHECK(std::is_sorted(near.begin(), near.end()));
    CHECK(std::adjacent_find(near.begin(), near.end()) == near.end());
    near_pairs += static_cast<int>(near.size());
    for (int a = 0; a < static_cast<int>(placed.size()); ++a) {
      for (int b = a + 1; b < static_cast<int>(placed.size()); ++b) {
        const bool found = std::binary_search(near.begin(), near.end(), std::array{a, b});
        for (const auto& p : placed[a]) {
          for (const auto& q : placed[b]) {
            if (AreWithin(reach, p, q)) REQUIRE(found);
          }
        }
        const Scalar wider = reach + Tenths<Scalar>(1) / Scalar(1000000);
        if (found) REQUIRE(AreWithin(wider, BoxOf(placed[a]), BoxOf(placed[b])));
      }
    }
  }
  CHECK(near_pairs > scenes);
}

TEST_CASE("near bodies: the sweep finds all that have pieces within the reach, and none beyond") {
  CheckNearBodies<double, 2>(400);
  CheckNearBodies<double, 3>(400);
  CheckNearBodies<Rational, 2>(20);
  CheckNearBodies<Rational, 3>(20);
}

TEST_CASE("near bodies: what is not a number is near everything, what is infinite near its like") {
  Random random(1);
  auto placed = RandomPieces<double, 2>(random, 40);
  placed[3] = {{{NAN, 0}, {NAN, 1}}};
  placed[5] = {{{INFINITY, INFINITY}, {INFINITY, INFINITY}}};
  placed[7] = {{{-1e300, 0}, {-1e300, 1}}};
  placed[9] = placed[7];
  const auto near = NearBodies(placed, 0.1);
  const auto is_near = [&](int a, int b) {
    return std::binary_search(near.begin(), near.end(), std::array{a, b});
  };
  CHECK(is_near(3, 5));
  CHECK(is_near(7, 9));
  for (int a = 0; a < 40; ++a) {
    if (placed[a].empty() || a == 3) continue;
    for (const auto& piece : placed[a]) {
      if (piece.low[1] <= 1 && piece.high[1] >= 0) CHECK(is_near(std::min(a, 3), std::max(a, 3)));
    }
  }
}

// ---- Scenes ----------------------------------------------------------------------------------

Rational Quarters(int n) { return Rational(n) / 4; }

// What both kinds of scene have; `place` gives a body its position and pieces.
template <class SceneType, class Place>
SceneType RandomScene(Random& random, int bodies, const Place& place) {
  SceneType scene;
  scene.mu = Rational(1, 2);
  scene.gap = OneOf<Rational>(random, {0, Rational(1, 1000), Rational(1, 4)});
  for (int i = 0; i < bodies; ++i) {
    auto& body = scene.bodies.emplace_back();
    body.fixed = Below(random, 4) == 0;
    body.level = Below(random, 4) == 0;
    place(body);
  }
  const auto choose_pair = [&](auto& of) {
    of.a = Below(random, bodies);
    of.b = (of.a + 1 + Below(random, bodies - 1)) % bodies;
  };
  for (int i = Below(random, bodies); i-- > 0;) choose_pair(scene.joints.emplace_back());
  for (int i = Below(random, 3 * bodies); i-- > 0;) {
    auto& rule = scene.pairs.emplace_back();
    choose_pair(rule);
    if (Below(random, 4) == 0 && !scene.joints.empty()) {
      rule.a = scene.joints[0].b;
      rule.b = scene.joints[0].a;
    }
    if (Below(random, 2)) rule.mu = Quarters(Below(random, 4));
    if (Below(random, 2)) rule.collide = Below(random, 2) == 0;
  }
  for (int i = Below(random, 4); i-- > 0;) {
    auto& given = scene.contacts.emplace_back();
    choose_pair(given);
    for (int k = 0; k < given.normal.size(); ++k) {
      given.at_a[k] = given.at_b[k] = Quarters(Below(random, 8));
      given.normal[k] = k == 0;
    }
  }
  return scene;
}

Scene<Rational> RandomPlanarScene(Random& random, int bodies) {
  return RandomScene<Scene<Rational>>(random, bodies, [&](RigidBody<Rational>& body) {
    body.position = MakeVector2<Rational>(Quarters(Below(random, 30)), Quarters(Below(random, 30)));
    body.rotation = OneOf<Vector2<Rational>>(random, {MakeVector2<Rational>(1, 0), MakeVector2<Rational>(0, 1),
                                                      MakeVector2<Rational>(Rational(3, 5), Rational(4, 5))});
    for (int i = Below(random, 4); i-- > 0;) {
      auto& shape = body.shapes.emplace_back();
      shape.center = MakeVector2<Rational>(Quarters(Below(random, 5)), Quarters(Below(random, 5)));
      const Rational w = Quarters(1 + Below(random, 3)), h = Quarters(1 + Below(random, 3));
      if (Below(random, 3) == 0) {
        shape.radius = w;
        continue;
      }
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        shape.corners.push_back(shape.center + MakeVector2<Rational>(x * w, y * h));
      if (Below(random, 3) == 0) shape.corners.pop_back();
    }
  });
}

SceneInSpace<Rational> RandomSceneInSpace(Random& random, int bodies) {
  const auto vector = [&random](int n) {
    return MakeVector3<Rational>(Quarters(Below(random, n)), Quarters(Below(random, n)),
                                 Quarters(Below(random, n)));
  };
  return RandomScene<SceneInSpace<Rational>>(random, bodies, [&](BodyInSpace<Rational>& body) {
    body.position = vector(15);
    body.rotation = MakeQuaternion<Rational>(2, Zero<Vector3<Rational>>());
    if (Below(random, 2)) body.rotation[1 + Below(random, 3)] = 1;
    for (int i = Below(random, 3); i-- > 0;) {
      const Vector3<Rational> center = vector(5),
                              size = vector(3) + MakeVector3<Rational>(1, 1, 1) / Rational(4);
      if (Below(random, 3) == 0) {
        auto& ball = body.shapes.emplace_back();
        ball.center = center;
        ball.radius = size[0];
        continue;
      }
      std::vector<Vector3<Rational>> corners;
      for (int k = 0; k < 8; ++k) {
        const auto side = [&](int bit) { return Rational(k & bit ? size[bit / 2] : -size[bit / 2]); };
        corners.push_back(center + MakeVector3<Rational>(side(1), side(2), side(4)));
      }
      if (Below(random, 2)) corners.resize(5);
      body.shapes.push_back(MakePolyhedron(corners).shape);
    }
  });
}

// What two bodies are to each other, by going through all joints and rules.
template <class SceneType>
PairFacts<decltype(SceneType::mu)> PlainFacts(const SceneType& scene, int a, int b) {
  const auto is_pair = [a, b](const auto& of) { return (of.a == a && of.b == b) || (of.a == b && of.b == a); };
  PairFacts<decltype(SceneType::mu)> facts;
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

TEST_CASE("pairs: the table says of every two bodies what their joints and rules say") {
  Random random(1);
  int collide = 0, jointed = 0, across_levels = 0;
  for (int i = 0; i < 100; ++i) {
    const auto scene = RandomPlanarScene(random, 2 + Below(random, 20));
    const PairTable table(scene);
    for (int a = 0; a < static_cast<int>(scene.bodies.size()); ++a) {
      for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
        if (a == b) continue;
        const auto facts = table.Of(a, b), expected = PlainFacts(scene, a, b);
        REQUIRE(facts.collide == expected.collide);
        REQUIRE(facts.mu == expected.mu);
        if (!facts.collide) continue;
        ++collide;
        across_levels += scene.bodies[a].level != scene.bodies[b].level;
        for (const auto& joint : scene.joints) jointed += joint.a == a && joint.b == b;
      }
    }
  }
  CHECK(collide > 1000);
  CHECK(jointed > 10);
  CHECK(across_levels > 10);
}

// A scene of two of the bodies, without what is given.
template <class SceneType>
SceneType OfTwo(const SceneType& scene, int a, int b) {
  SceneType two;
  two.mu = scene.mu;
  two.gap = scene.gap;
  two.bodies = {scene.bodies[a], scene.bodies[b]};
  const auto keep = [&](const auto& from, auto& to) {
    for (auto of : from) {
      if (std::minmax(of.a, of.b) != std::minmax(a, b)) continue;
      of.a = of.a == a ? 0 : 1;
      of.b = 1 - of.a;
      to.push_back(of);
    }
  };
  keep(scene.joints, two.joints);
  keep(scene.pairs, two.pairs);
  return two;
}

template <class Touch>
bool AreSame(const Touch& x, const Touch& y) {
  return x.a == y.a && x.b == y.b && x.shape_a == y.shape_a && x.shape_b == y.shape_b && x.point == y.point &&
         x.normal == y.normal && x.gap == y.gap && x.mu == y.mu && x.radius_a == y.radius_a &&
         x.radius_b == y.radius_b && x.meeting == y.meeting && x.edge_a == y.edge_a && x.edge_b == y.edge_b;
}

// Scenes of two bodies are looked at without the sweep.
template <class SceneType, class Scalar = decltype(SceneType::mu)>
std::size_t CheckContacts(const SceneType& scene, const Scalar& margin) {
  STATIC_REQUIRE(kFewBodies >= 2);
  REQUIRE(scene.bodies.size() > kFewBodies);
  const auto found = FindContacts(scene, margin);
  auto at = found.begin();
  const auto expect = [&](const SceneType& two, int a, int b) {
    for (auto contact : FindContacts(two, margin)) {
      contact.a = contact.a == 0 ? a : b;
      contact.b = contact.b == 0 ? a : b;
      REQUIRE(at != found.end());
      REQUIRE(AreSame(*at++, contact));
    }
  };
  for (auto given : scene.contacts) {
    SceneType two = OfTwo(scene, given.a, given.b);
    for (auto& body : two.bodies) body.shapes.clear();
    two.contacts = {given};
    two.contacts[0].a = 0;
    two.contacts[0].b = 1;
    expect(two, given.a, given.b);
  }
  const int bodies = static_cast<int>(scene.bodies.size());
  for (int a = 0; a < bodies; ++a) {
    for (int b = a + 1; b < bodies; ++b) expect(OfTwo(scene, a, b), a, b);
  }
  REQUIRE(at == found.end());
  return found.size();
}

template <class MakeScene>
void CheckRandomScenes(int scenes, int exact_scenes, const MakeScene& make) {
  Random random(2);
  std::size_t contacts = 0;
  for (int i = 0; i < scenes; ++i) {
    const auto scene = make(random, static_cast<int>(kFewBodies) + 1 + Below(random, 20));
    const Rational margin = OneOf<Rational>(random, {0, Rational(1, 10), Rational(1, 4)});
    contacts += CheckContacts(Round(scene), ToDouble(margin));
    if (i < exact_scenes) CheckContacts(scene, margin);
  }
  CHECK(contacts > static_cast<std::size_t>(10 * scenes));
}

TEST_CASE("contacts: many bodies have those that each two of them have alone, in their order") {
  CheckRandomScenes(100, 10, RandomPlanarScene);
  CheckRandomScenes(40, 4, RandomSceneInSpace);
}

// ---- Redundant contacts ----------------------------------------------------------------------

template <class Scalar, int Dof>
using Constraints = std::vector<Constraint<Scalar, Dof>>;

// Every contact against all others.
template <class Scalar, int Dof>
std::vector<int> PlainRedundant(const Constraints<Scalar, Dof>& constraints) {
  std::vector<int> redundant;
  for (int i = 0; i < static_cast<int>(constraints.size()); ++i) {
    if (constraints[i].law.kind == ContactKind::kBilateral) continue;
    std::vector<int> others;
    for (int j = 0; j < static_cast<int>(constraints.size()); ++j) {
      const auto& p = constraints[i].bodies;
      const auto& q = constraints[j].bodies;
      const bool same = p == q || p == std::array{q[1], q[0]};
      if (j != i && same && HaveOneLaw(constraints[i], constraints[j]) &&
          std::find(redundant.begin(), redundant.end(), j) == redundant.end())
        others.push_back(j);
    }
    bool found = false;
    for (std::size_t j = 0; j < others.size(); ++j) {
      for (std::size_t k = j; k < others.size(); ++k)
        found = found || IsBetween(constraints[i], constraints[others[j]], constraints[others[k]]);
    }
    if (found || (Dof == 6 && IsInHull(constraints, i, others))) redundant.push_back(i);
  }
  return redundant;
}

// Contacts of a few pairs of bodies, their normal rows means of three with round weights; over doubles with
// errors that are forgiven, and some that are not.
template <class Scalar, int Dof>
Constraints<Scalar, Dof> RandomConstraints(Random& random) {
  using Row = std::array<Eigen::Matrix<Scalar, Dof, 1>, 2>;
  const auto random_row = [&random] {
    Row row;
    const int size = OneOf<int>(random, {1, 1, 100});
    for (auto& part : row) {
      for (int k = 0; k < Dof; ++k) part[k] = Scalar(size * (Below(random, 7) - 3));
    }
    return row;
  };
  const auto error = [&random] {
    return kIsExact<Scalar> ? Scalar(0) : Scalar(OneOf<double>(random, {0, 9e-13, -9e-13, 0, 0, 3e-12, 3e-11}));
  };
  std::array<Row, 3> corners = {random_row(), random_row(), random_row()};
  const Row friction = random_row();
  Constraints<Scalar, Dof> constraints(2 + Below(random, 12));
  const int kinds = 1 + Below(random, 3), pairs = 1 + Below(random, 3);
  for (auto& constraint : constraints) {
    constraint.law.kind = OneOf<ContactKind>(random, {ContactKind::kFrictionless, ContactKind::kStatic,
                                                      ContactKind::kSliding, ContactKind::kBilateral});
    if (kinds == 1) constraint.law.kind = ContactKind::kFrictionless;
    if (kinds == 2) constraint.law.kind = ContactKind::kStatic;
    constraint.bodies = {0, 1 + Below(random, pairs)};
    const int w0 = Below(random, 5), w1 = Below(random, 5 - w0);
    constraint.rows.resize(constraint.law.kind == ContactKind::kFrictionless ? 1 : 2);
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < Dof; ++k) {
        constraint.rows[0].J[side][k] = (Scalar(w0) * corners[0][side][k] + Scalar(w1) * corners[1][side][k] +
                                         Scalar(4 - w0 - w1) * corners[2][side][k]) /
                                            Scalar(4) +
                                        error();
      }
    }
    constraint.rows[0].b = Scalar(Below(random, 2));
    if (constraint.rows.size() > 1) constraint.rows[1].J = friction;
    if (Below(random, 2) == 0) continue;
    std::swap(constraint.bodies[0], constraint.bodies[1]);
    for (auto& row : constraint.rows) std::swap(row.J[0], row.J[1]);
  }
  if (Below(random, 2)) {  // as they are found
    std::stable_sort(constraints.begin(), constraints.end(), [](const auto& x, const auto& y) {
      const auto key = [](const auto& c) {
        return c.law.kind == ContactKind::kBilateral ? 0 : std::max(c.bodies[0], c.bodies[1]);
      };
      return key(x) < key(y);
    });
  }
  return constraints;
}

template <class Scalar, int Dof>
void CheckRedundant(int count) {
  Random random(3);
  std::size_t found = 0, kept = 0;
  for (int i = 0; i < count; ++i) {
    const auto constraints = RandomConstraints<Scalar, Dof>(random);
    const auto redundant = FindRedundant(constraints);
    REQUIRE(redundant == PlainRedundant(constraints));
    found += redundant.size();
    kept += constraints.size() - redundant.size();
  }
  CHECK(found > static_cast<std::size_t>(count / 2));
  CHECK(kept > static_cast<std::size_t>(count / 2));
}

TEST_CASE("redundant contacts: the quick search finds what comparing all with all finds", "[slow]") {
  CheckRedundant<double, 3>(3000);
  CheckRedundant<double, 6>(3000);
  CheckRedundant<Rational, 3>(200);
  CheckRedundant<Rational, 6>(200);
}

}  // namespace
}  // namespace stiction
