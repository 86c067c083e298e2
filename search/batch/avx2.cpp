// SPDX-License-Identifier: Apache-2.0
// Lanes of AVX2.

#include "search/batch/block.h"
#include "search/batch/draw_lanes.ipp"
#include "search/batch/run_lanes.ipp"

namespace stiction {

const LaneCode kAvx2Lanes = {
    [](Block& block, int count, const LaneTolerances& tolerances) { LaneRuns(block, count, tolerances).Run(); },
    [](Block& block, const LaneDraw& draw) { LaneDraws(block, draw).Draw(); },
};

}  // namespace stiction
