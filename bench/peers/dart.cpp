// SPDX-License-Identifier: Apache-2.0
// DART's copy of ODE's solver, which has a header.

#include "bench/peers/dantzig.h"

#ifdef STICTION_PEER_DART
#include <dart/external/odelcpsolver/error.h>
#include <dart/external/odelcpsolver/lcp.h>

#include <cstdarg>
#endif

namespace stiction {

#ifdef STICTION_PEER_DART
namespace {

bool complained = false;
void Complain(int, const char*, va_list) { complained = true; }
[[noreturn]] void Break(int, const char*, va_list) { throw BrokenCheck(); }

class DartContender : public DantzigContender {
 public:
  explicit DartContender(bool friction) : DantzigContender(friction) {
    dart::external::ode::dSetMessageHandler(Complain);
    dart::external::ode::dSetDebugHandler(Break);
  }
  int Stride(int rows) const override { return rows > 1 ? ((rows - 1) | 3) + 1 : rows; }
  bool Solve(int k) override {
    Restore(k);
    complained = false;
    try {
      const bool claims = dart::external::ode::dSolveLCP(rows_, A_.data(), x_.data(), b_.data(), w_.data(), 0,
                                                         low_.data(), high_.data(), FrictionIndex());
      return claims && !complained;
    } catch (const BrokenCheck&) {
      return false;
    }
  }
};

}  // namespace
std::unique_ptr<Contender> MakeDart(bool friction) { return std::make_unique<DartContender>(friction); }
#else
std::unique_ptr<Contender> MakeDart(bool) { return nullptr; }
#endif

}  // namespace stiction
