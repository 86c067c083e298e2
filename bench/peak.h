// SPDX-License-Identifier: Apache-2.0
// What one core can do at most in an instruction set: the roof of a roofline.

#pragma once

#include "search/lanes/instructions.h"

namespace stiction {

// A second of processor time, the best of several runs: additions and multiplications of doubles in equal
// number, apart (no operation of both, which would round once); divisions; bytes read and written within the
// nearest cache.
struct Peak {
  double operations = 0, quotients = 0, bytes = 0;
};

// kNone: of what every processor has. Requires a set of this processor.
Peak MeasurePeak(InstructionSet set);

}  // namespace stiction
