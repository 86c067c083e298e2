// SPDX-License-Identifier: Apache-2.0
// ODE: the step with its Dantzig solver, and the quick one with 20 iterations; friction is a pyramid.

#include "bench/peers/engines.h"

#ifdef STICTION_PEER_ODE
#include <ode/ode.h>
#include <ode/version.h>

#include <array>
#endif

namespace stiction {

#ifdef STICTION_PEER_ODE
namespace {

class OdeEngine : public Engine {
 public:
  OdeEngine(const EngineWorld& given, bool quick) : mu_(given.mu), step_(given.step), quick_(quick) {
    static const int started = dInitODE2(0);
    (void)started;
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, given.gravity.x(), given.gravity.y(), given.gravity.z());
    dWorldSetQuickStepNumIterations(world_, 20);
    for (const EngineBody& body : given.bodies) Add(body, given.planar);
  }
  ~OdeEngine() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }

  void Step() override {
    dSpaceCollide(space_, this, &Touch);
    if (quick_) {
      dWorldQuickStep(world_, step_);
    } else {
      dWorldStep(world_, step_);
    }
    dJointGroupEmpty(contacts_);
  }
  Pose PoseOf(int body) const override {
    const dReal* p = dGeomGetPosition(geoms_[body]);
    dQuaternion q;
    dGeomGetQuaternion(geoms_[body], q);
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }

 private:
  void Add(const EngineBody& given, bool planar) {
    const Eigen::Vector3d size = 2 * given.half, at = given.pose.position;
    geoms_.push_back(dCreateBox(space_, size.x(), size.y(), size.z()));
    if (given.fixed) {
      dGeomSetPosition(geoms_.back(), at.x(), at.y(), at.z());
      return;
    }
    const dBodyID body = dBodyCreate(world_);
    dMass mass;
    dMassSetBoxTotal(&mass, given.mass, size.x(), size.y(), size.z());
    dBodySetMass(body, &mass);
    dGeomSetBody(geoms_.back(), body);
    dBodySetPosition(body, at.x(), at.y(), at.z());
    dBodySetLinearVel(body, given.velocity.x(), given.velocity.y(), given.velocity.z());
    dBodySetAngularVel(body, given.spin.x(), given.spin.y(), given.spin.z());
    dBodySetAutoDisableFlag(body, 0);
    if (planar) dJointAttach(dJointCreatePlane2D(world_, nullptr), body, nullptr);
  }

  static void Touch(void* self, dGeomID a, dGeomID b) {
    constexpr int kMost = 8;
    auto& engine = *static_cast<OdeEngine*>(self);
    const dBodyID body = dGeomGetBody(a), other = dGeomGetBody(b);
    if (body == other) return;
    std::array<dContact, kMost> contacts{};
    const int count = dCollide(a, b, kMost, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface.mode = dContactApprox1;
      contacts[i].surface.mu = engine.mu_;
      dJointAttach(dJointCreateContact(engine.world_, engine.contacts_, &contacts[i]), body, other);
    }
  }

  double mu_, step_;
  bool quick_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dGeomID> geoms_;
};

}  // namespace

std::vector<EngineKind> OdeEngines() {
  const auto make = [](bool quick) {
    return [quick](const EngineWorld& world) { return std::make_unique<OdeEngine>(world, quick); };
  };
  return {{"ODE, step", dODE_VERSION, true, true, make(false)},
          {"ODE, quick, 20 iterations", dODE_VERSION, true, true, make(true)}};
}
#else
std::vector<EngineKind> OdeEngines() { return {}; }
#endif

}  // namespace stiction
