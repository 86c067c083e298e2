// SPDX-License-Identifier: Apache-2.0
// Exit codes of the programs.

#pragma once

namespace stiction {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNotSo = 1;      // not solved, rejected, differs
inline constexpr int kExitBadInput = 2;   // usage or input
inline constexpr int kExitUndecided = 3;  // undecided, or a limit
inline constexpr int kExitGrave = 4;      // a search holds a grave finding
inline constexpr int kExitInternal = 70;  // always a bug
inline constexpr int kExitDisk = 74;      // the disk is full, or what is to be written cannot be

}  // namespace stiction
