// SPDX-License-Identifier: Apache-2.0
// MuJoCo: Newton's method on its soft contacts, with elliptic cones of friction.

#include "bench/peers/engines.h"

#ifdef STICTION_PEER_MUJOCO
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cstring>

#include "corpus/input_error.h"
#endif

namespace stiction {

#ifdef STICTION_PEER_MUJOCO
namespace {

std::string Text(const Eigen::Vector3d& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string ModelOf(const EngineWorld& world) {
  std::string text = fmt::format(
      "<mujoco><option timestep='{}' gravity='{}' cone='elliptic'/><size nstack='20000000' njmax='6000' "
      "nconmax='2000'/>"
      "<default><geom friction='{}'/></default><worldbody>",
      world.step, Text(world.gravity), world.mu);
  for (const EngineBody& body : world.bodies) {
    const char* joints = body.fixed     ? ""
                         : world.planar ? "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/>"
                                          "<joint type='hinge' axis='0 0 1'/>"
                                        : "<freejoint/>";
    text += fmt::format("<body pos='{}'>{}<geom type='box' size='{}' mass='{}'/></body>",
                        Text(body.pose.position), joints, Text(body.half), body.mass);
  }
  return text + "</worldbody></mujoco>";
}

class MujocoEngine : public Engine {
 public:
  explicit MujocoEngine(const EngineWorld& world) {
    const std::string text = ModelOf(world);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "world.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[500] = "";
    model_ = mj_loadXML("world.xml", files.get(), error, sizeof error);
    mj_deleteVFS(files.get());
    if (model_ == nullptr) throw InputError(fmt::format("MuJoCo refuses the world: {}", error));
    data_ = mj_makeData(model_);
    for (int k = 0, dof = 0; k < static_cast<int>(world.bodies.size()); ++k) {
      const EngineBody& body = world.bodies[k];
      if (body.fixed) continue;
      for (int i = 0; i < (world.planar ? 2 : 3); ++i) data_->qvel[dof + i] = body.velocity[i];
      for (int i = 0; i < 3 && !world.planar; ++i) data_->qvel[dof + 3 + i] = body.spin[i];
      dof += world.planar ? 3 : 6;
    }
  }
  ~MujocoEngine() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  void Step() override { mj_step(model_, data_); }
  Pose PoseOf(int body) const override {
    const mjtNum *p = data_->xpos + 3 * (body + 1), *q = data_->xquat + 4 * (body + 1);  // 0 is the world
    return {{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
  }

 private:
  mjModel* model_;
  mjData* data_;
};

}  // namespace

std::vector<EngineKind> MujocoEngines() {
  return {{"MuJoCo, elliptic", mj_versionString(), true, true,
           [](const EngineWorld& world) { return std::make_unique<MujocoEngine>(world); }}};
}
#else
std::vector<EngineKind> MujocoEngines() { return {}; }
#endif

}  // namespace stiction
