// SPDX-License-Identifier: Apache-2.0
// Box2D, in floats: 8 iterations of velocities, 3 of positions.

#include "bench/peers/engines.h"

#ifdef STICTION_PEER_BOX2D
#include <box2d/box2d.h>
#include <fmt/format.h>

#include <cmath>
#endif

namespace stiction {

#ifdef STICTION_PEER_BOX2D
namespace {

class Box2dEngine : public Engine {
 public:
  explicit Box2dEngine(const EngineWorld& given)
      : world_(In2d(given.gravity)), step_(static_cast<float>(given.step)) {
    world_.SetAllowSleeping(false);
    for (const EngineBody& body : given.bodies) {
      b2BodyDef definition;
      definition.type = body.fixed ? b2_staticBody : b2_dynamicBody;
      definition.position = In2d(body.pose.position);
      definition.linearVelocity = In2d(body.velocity);
      bodies_.push_back(world_.CreateBody(&definition));
      b2PolygonShape shape;
      const b2Vec2 half = In2d(body.half);
      shape.SetAsBox(half.x, half.y);
      b2FixtureDef fixture;
      fixture.shape = &shape;
      fixture.friction = static_cast<float>(given.mu);  // of a pair it takes the geometric mean
      fixture.density = static_cast<float>(body.mass) / (4 * half.x * half.y);
      bodies_.back()->CreateFixture(&fixture);
    }
  }

  void Step() override { world_.Step(step_, 8, 3); }
  Pose PoseOf(int body) const override {
    const b2Vec2 at = bodies_[body]->GetPosition();
    const double half_angle = 0.5 * bodies_[body]->GetAngle();
    return {{at.x, at.y, 0}, {std::cos(half_angle), 0, 0, std::sin(half_angle)}};
  }

 private:
  static b2Vec2 In2d(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y())};
  }

  b2World world_;
  float step_;
  std::vector<b2Body*> bodies_;  // the world's
};

}  // namespace

std::vector<EngineKind> Box2dEngines() {
  return {{"Box2D, 8 and 3 iterations",
           fmt::format("{}.{}.{}", b2_version.major, b2_version.minor, b2_version.revision), true, false,
           [](const EngineWorld& world) { return std::make_unique<Box2dEngine>(world); }}};
}
#else
std::vector<EngineKind> Box2dEngines() { return {}; }
#endif

}  // namespace stiction
