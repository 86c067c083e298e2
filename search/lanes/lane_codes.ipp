// SPDX-License-Identifier: Apache-2.0
// The functions of one instruction set; included once by the file of each.

#include "search/lanes/block.h"
#include "search/lanes/draw_lanes.ipp"
#include "search/lanes/error_lanes.ipp"
#include "search/lanes/run_lanes.ipp"

namespace stiction {
namespace {

template <int Rows>
constexpr LaneCode<Rows> kLaneCode = {
    [](Block<Rows>& block, int count, const LaneTolerances& tolerances) {
      LaneRuns<Rows>(block, count, tolerances).Run();
      MeasureErrorsOf(block, count);
    },
    [](Block<Rows>& block, const LaneDraw& draw) { LaneDraws<Rows>(block, draw).Draw(); },
};

constexpr LaneCodes kLaneCodes = {kLaneCode<4>, kLaneCode<6>, kLaneCode<8>};

}  // namespace
}  // namespace stiction
