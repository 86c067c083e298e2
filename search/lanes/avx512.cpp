// SPDX-License-Identifier: Apache-2.0
// Lanes of AVX-512 (DQ, VL).

#include "search/lanes/lane_codes.ipp"

namespace stiction {

const LaneCodes kAvx512Lanes = kLaneCodes;

}  // namespace stiction
