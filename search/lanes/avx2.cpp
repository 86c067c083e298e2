// SPDX-License-Identifier: Apache-2.0
// Lanes of AVX2.

#include "search/lanes/lane_codes.ipp"

namespace stiction {

const LaneCodes kAvx2Lanes = kLaneCodes;

}  // namespace stiction
