// SPDX-License-Identifier: Apache-2.0
// Engines: the same boxes in several of them, step by step (table `engines`, engines.cpp).
//
// Every engine is given the world below and its own defaults, but for these: bodies never sleep, restitution is
// 0, and two surfaces have the coefficient mu.

#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stiction {

struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

// A solid box.
struct EngineBody {
  bool fixed = false;
  double mass = 1;
  Eigen::Vector3d half = Eigen::Vector3d::Ones();  // of its edges
  Pose pose;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), spin = Eigen::Vector3d::Zero();

  Eigen::Vector3d Inertia() const {
    const Eigen::Vector3d squares = half.cwiseAbs2();
    return mass / 3 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
  }
};

// Planar: boxes 1 m deep that stay in the plane z = 0.
struct EngineWorld {
  bool planar = false;
  double mu = 0, step = 0;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<EngineBody> bodies;
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void Step() = 0;
  virtual Pose PoseOf(int body) const = 0;
};

struct EngineKind {
  std::string name, version;
  bool plane = true, space = true;  // which worlds it takes
  std::function<std::unique_ptr<Engine>(const EngineWorld&)> make;
};

// None where the package was not found.
std::vector<EngineKind> BulletEngines();  // engine_bullet.cpp
std::vector<EngineKind> OdeEngines();     // engine_ode.cpp
std::vector<EngineKind> Box2dEngines();   // engine_box2d.cpp
std::vector<EngineKind> MujocoEngines();  // engine_mujoco.cpp

}  // namespace stiction
