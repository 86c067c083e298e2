// SPDX-License-Identifier: Apache-2.0
// Bullet's copy of the solver, in its build for doubles.

#include "bench/peers/dantzig.h"

#ifdef STICTION_PEER_BULLET
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#endif

namespace stiction {

#ifdef STICTION_PEER_BULLET
namespace {

static_assert(std::is_same_v<btScalar, double>, "built with BT_USE_DOUBLE_PRECISION");

class BulletContender : public DantzigContender {
 public:
  using DantzigContender::DantzigContender;
  int Stride(int rows) const override { return rows; }
  bool Solve(int k) override {
    Restore(k);
    for (double& bound : high_) bound = std::min(bound, double(BT_INFINITY));
    return btSolveDantzigLCP(rows_, A_.data(), x_.data(), b_.data(), w_.data(), 0, low_.data(), high_.data(),
                             FrictionIndex(), scratch_);
  }

 private:
  btDantzigScratchMemory scratch_;
};

}  // namespace
std::unique_ptr<Contender> MakeBullet(bool friction) { return std::make_unique<BulletContender>(friction); }
#else
std::unique_ptr<Contender> MakeBullet(bool) { return nullptr; }
#endif

}  // namespace stiction
