// SPDX-License-Identifier: Apache-2.0
// ODE's own solver. The library exports it, and no header declares it: the declaration, and the first three
// fields of the memory that it draws from, are those of ODE 0.16.2.

#include "bench/peers/dantzig.h"

#ifdef STICTION_PEER_ODE
#include <ode/common.h>
#include <ode/error.h>

#include <cstdarg>

class dxWorldProcessMemArena;
extern void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* A, double* pairs_bx, double* w,
                       unsigned unbounded, double* pairs_low_high, int* friction_index);
extern std::size_t dxEstimateSolveLCPMemoryReq(unsigned n, bool outer_w);
#endif

namespace stiction {

#ifdef STICTION_PEER_ODE
namespace {

static_assert(std::is_same_v<dReal, double>, "ODE built for doubles");

bool complained = false;
void Complain(int, const char*, va_list) { complained = true; }
[[noreturn]] void Break(int, const char*, va_list) { throw BrokenCheck(); }

class OdeContender : public DantzigContender {
 public:
  OdeContender(bool friction, double cfm) : DantzigContender(friction, cfm) {
    dSetMessageHandler(Complain);
    dSetDebugHandler(Break);
  }
  int Stride(int rows) const override { return rows > 1 ? ((rows - 1) | 3) + 1 : rows; }
  void Load(const std::vector<PeerProblem>& problems) override {
    DantzigContender::Load(problems);
    pool_.resize(dxEstimateSolveLCPMemoryReq(rows_, true) / sizeof(double) + 64);
    pairs_.resize(2 * rows_);
    bounds_.resize(2 * rows_);
  }
  bool Solve(int k) override {
    const Loaded& from = loaded_[k];
    std::copy(from.A.begin(), from.A.end(), A_.begin());
    for (int i = 0; i < rows_; ++i) {
      pairs_[2 * i] = from.b[i];
      bounds_[2 * i] = from.low[i];
      bounds_[2 * i + 1] = from.high[i];
    }
    if (friction_) std::copy(from.index.begin(), from.index.end(), index_.begin());
    Arena arena{pool_.data(), pool_.data(), pool_.data() + pool_.size(), nullptr, nullptr};
    complained = false;
    try {
      dxSolveLCP(reinterpret_cast<dxWorldProcessMemArena*>(&arena), rows_, A_.data(), pairs_.data(), w_.data(),
                 0, bounds_.data(), FrictionIndex());
    } catch (const BrokenCheck&) {
      complained = true;
    }
    for (int i = 0; i < rows_; ++i) x_[i] = pairs_[2 * i + 1];
    return !complained;
  }

 private:
  struct Arena {
    void *current, *begin, *end, *buffer;
    const void* manager;
  };
  std::vector<double> pool_, pairs_, bounds_;
};

}  // namespace
std::unique_ptr<Contender> MakeOde(bool friction, double cfm) {
  return std::make_unique<OdeContender>(friction, cfm);
}
#else
std::unique_ptr<Contender> MakeOde(bool, double) { return nullptr; }
#endif

}  // namespace stiction
