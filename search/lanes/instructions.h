// SPDX-License-Identifier: Apache-2.0
// Which vectors of the processor problems are batched in (batch.h). What comes out does not depend on it.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace stiction {

// kNone: every problem is run by itself, which is quicker than lanes of two, as every processor has them.
enum class InstructionSet : std::uint8_t { kNone, kAvx2, kAvx512 };

std::string_view Name(InstructionSet set);
// Those of this processor, kNone first, the best last.
std::vector<InstructionSet> InstructionSets();
inline InstructionSet BestInstructionSet() { return InstructionSets().back(); }

}  // namespace stiction
