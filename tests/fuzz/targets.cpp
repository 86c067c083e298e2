// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/targets.h"

#include <array>

namespace stiction::fuzz {

std::span<const Target> Targets() {
  static constexpr std::array targets = {
      Target{"problem", &FuzzProblem},   Target{"certificate", &FuzzCertificate},
      Target{"rational", &FuzzRational}, Target{"campaign", &FuzzCampaign},
      Target{"scene", &FuzzScene},       Target{"siconos", &FuzzSiconos},
      Target{"fclib", &FuzzFclib},       Target{"hdf5", &FuzzHdf5},
      Target{"store", &FuzzStore},       Target{"solve", &FuzzSolve},
      Target{"certify", &FuzzCertify},   Target{"record", &FuzzRecord},
      Target{"every", &FuzzEvery}};
  return targets;
}

}  // namespace stiction::fuzz
