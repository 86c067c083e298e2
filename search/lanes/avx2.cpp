// SPDX-License-Identifier: Apache-2.0
// Lanes of AVX2.

#include "search/lanes/block.h"
#include "search/lanes/draw_lanes.ipp"
#include "search/lanes/run_lanes.ipp"

namespace stiction {

const LaneCode kAvx2Lanes = {
    [](Block& block, int count, const LaneTolerances& tolerances) { LaneRuns(block, count, tolerances).Run(); },
    [](Block& block, const LaneDraw& draw) { LaneDraws(block, draw).Draw(); },
};

}  // namespace stiction
