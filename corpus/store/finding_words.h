// SPDX-License-Identifier: Apache-2.0
// What is said of one finding, in every medium alike: what is proved of its run, and how to see it again.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "corpus/record/loop_sentence.h"
#include "corpus/store/store.h"

namespace stiction {

enum class FindingForm : std::uint8_t { kFound, kMinimized };

// The minimized problem, where there is one.
FindingForm SimplestForm(const Finding& finding);

// What is proved of the loop of a finished finding: by its certificate; without one, as where it would be too
// dear, by its facts.
ProvedRun ProvedRunOf(const Finding& finding, FindingForm form);

// "drive", of a stall "step": of its start and period.
std::string_view UnitOfLoop(const Finding& finding);

// LoopSentence of the simplest form; empty of what is no loop, or is not finished.
std::string SentenceOf(const Finding& finding);

// Options of `replay` under which the run of a finding is the one that was found: its policy, and doubles where
// they are what fails. Each begins with a space.
std::string ReplayOptionsOf(const Finding& finding);

}  // namespace stiction
