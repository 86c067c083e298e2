// SPDX-License-Identifier: Apache-2.0
// The automatic method of this suite over doubles, so that a search asks of ours what it asks of others.

#include "bench/peers/contender.h"
#include "solver/solve.h"

namespace stiction {
namespace {

class OurContender : public Contender {
 public:
  void Load(const std::vector<PeerProblem>& problems) override { loaded_ = problems; }
  bool Solve(int k) override {
    const Answer<double> answer = stiction::Solve(loaded_[k]);
    f_ = answer.f;
    return answer.Solved();
  }
  Eigen::VectorXd Forces() const override { return f_; }

 private:
  std::vector<PeerProblem> loaded_;
  Eigen::VectorXd f_;
};

}  // namespace

std::unique_ptr<Contender> MakeOurs() { return std::make_unique<OurContender>(); }

}  // namespace stiction
