// SPDX-License-Identifier: Apache-2.0
// Files that are read whole: regular ones, and standard input as "-".

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace stiction {

// More is refused wherever a file is read (ReadText). The largest dense problem that is read has some 70
// million numbers.
inline constexpr std::size_t kMostInputBytes = std::size_t{1} << 30;

// The bytes of a file. "-", /dev/stdin and /dev/fd/N may be pipes; standard input is read once, and gives the
// same text again. InputError, before anything is read, for folders, named pipes, devices and files of more
// than `most` bytes, and for what cannot be read.
std::string ReadInput(const std::filesystem::path& file, std::size_t most);

}  // namespace stiction
