// SPDX-License-Identifier: Apache-2.0
// Bullet's copy of the solver, and its Lemke's method on the frictionless problem, in its build for doubles.

#include "bench/peers/dantzig.h"

#ifdef STICTION_PEER_BULLET
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>
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
    for (double& bound : low_) bound = std::max(bound, -double(BT_INFINITY));
    return btSolveDantzigLCP(rows_, A_.data(), x_.data(), b_.data(), w_.data(), 0, low_.data(), high_.data(),
                             FrictionIndex(), scratch_);
  }

 private:
  btDantzigScratchMemory scratch_;
};

class BulletLemkeContender : public Contender {
 public:
  void Load(const std::vector<PeerProblem>& problems) override {
    loaded_.clear();
    for (const PeerProblem& problem : problems) {
      Loaded& to = loaded_.emplace_back();
      const int rows = problem.rows();
      to.A.resize(rows, rows);
      to.b.resize(rows);
      for (int i = 0; i < rows; ++i) {
        to.b[i] = problem.b[i];
        for (int j = 0; j < rows; ++j) to.A.setElem(i, j, problem.A(i, j));
      }
    }
  }
  bool Solve(int k) override {
    constexpr unsigned kLoops = 1000;  // as many as btLemkeSolver takes
    btLemkeAlgorithm lemke(loaded_[k].A, loaded_[k].b);
    const btVectorXu solution = lemke.solve(kLoops);
    const int rows = loaded_[k].b.size();
    f_.resize(rows);
    for (int i = 0; i < rows; ++i) f_[i] = solution[rows + i];  // after the accelerations
    return lemke.getInfo() == 0;
  }
  Eigen::VectorXd Forces() const override { return f_; }

 private:
  struct Loaded {
    btMatrixXu A;
    btVectorXu b;
  };
  std::vector<Loaded> loaded_;
  Eigen::VectorXd f_;
};

}  // namespace
std::unique_ptr<Contender> MakeBulletLemke() { return std::make_unique<BulletLemkeContender>(); }
std::unique_ptr<Contender> MakeBullet(bool friction) { return std::make_unique<BulletContender>(friction); }
#else
std::unique_ptr<Contender> MakeBullet(bool) { return nullptr; }
std::unique_ptr<Contender> MakeBulletLemke() { return nullptr; }
#endif

}  // namespace stiction
