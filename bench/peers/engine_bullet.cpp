// SPDX-License-Identifier: Apache-2.0
// Bullet, in its build for doubles: sequential impulses, and its copy of the Dantzig solver.

#include "bench/peers/engines.h"

#ifdef STICTION_PEER_BULLET
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <cmath>
#include <deque>
#endif

namespace stiction {

#ifdef STICTION_PEER_BULLET
namespace {

btVector3 InBullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

class BulletEngine : public Engine {
 public:
  BulletEngine(const EngineWorld& given, bool dantzig)
      : dispatcher_(&configuration_),
        solver_(dantzig ? std::make_unique<btMLCPSolver>(&dantzig_)
                        : std::make_unique<btSequentialImpulseConstraintSolver>()),
        world_(&dispatcher_, &broadphase_, solver_.get(), &configuration_),
        step_(given.step) {
    world_.setGravity(InBullet(given.gravity));
    world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    if (dantzig) world_.getSolverInfo().m_minimumSolverBatchSize = 1;  // each island by itself
    for (const EngineBody& body : given.bodies) Add(body, given);
  }
  ~BulletEngine() override {
    for (btRigidBody& body : bodies_) world_.removeRigidBody(&body);
  }

  void Step() override { world_.stepSimulation(step_, 0); }
  Pose PoseOf(int body) const override {
    const btTransform& at = bodies_[body].getWorldTransform();
    const btVector3& p = at.getOrigin();
    const btQuaternion q = at.getRotation();
    return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
  }

 private:
  void Add(const EngineBody& body, const EngineWorld& given) {
    shapes_.emplace_back(InBullet(body.half));
    bodies_.emplace_back(body.fixed ? 0 : body.mass, nullptr, &shapes_.back(), InBullet(body.Inertia()));
    btRigidBody& added = bodies_.back();
    added.setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), InBullet(body.pose.position)));
    added.setFriction(std::sqrt(given.mu));  // of a pair it takes the product
    added.setActivationState(DISABLE_DEACTIVATION);
    added.setLinearVelocity(InBullet(body.velocity));
    added.setAngularVelocity(InBullet(body.spin));
    if (given.planar) added.setLinearFactor({1, 1, 0});
    if (given.planar) added.setAngularFactor({0, 0, 1});
    world_.addRigidBody(&added);
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btDantzigSolver dantzig_;
  std::unique_ptr<btSequentialImpulseConstraintSolver> solver_;
  btDiscreteDynamicsWorld world_;
  std::deque<btBoxShape> shapes_;
  std::deque<btRigidBody> bodies_;
  double step_;
};

}  // namespace

std::vector<EngineKind> BulletEngines() {
  const std::string version = fmt::format("{}.{}", btGetVersion() / 100, btGetVersion() % 100);
  const auto make = [](bool dantzig) {
    return [dantzig](const EngineWorld& world) { return std::make_unique<BulletEngine>(world, dantzig); };
  };
  return {{"Bullet, 10 iterations", version, true, true, make(false)},
          {"Bullet, Dantzig", version, true, true, make(true)}};
}
#else
std::vector<EngineKind> BulletEngines() { return {}; }
#endif

}  // namespace stiction
