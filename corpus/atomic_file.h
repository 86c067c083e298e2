// SPDX-License-Identifier: Apache-2.0
// Files that are written whole: whatever happens, the name stands for the old content or for the new.
//
// The new content is written beside the target, brought to the disk, and renamed. Where that fails the
// target is untouched and nothing is left behind; a process that is killed leaves at most a file
// `.stiction-PID-N` beside the target; a name that something has is passed over. The target itself may be a
// link: the file that it leads to is replaced. Pipes and devices are written directly.

#pragma once

#include <filesystem>
#include <string_view>

namespace stiction {

// "-" and /dev/stdout are standard output. InputError for a path that can name no file (a folder, or in none),
// OutputError where the disk is full or the place cannot be written.
void WriteText(const std::filesystem::path& file, std::string_view text);

// Creates a file in place, where nothing is, not even a link: in a folder that is renamed as a whole.
void WriteNew(const std::filesystem::path& file, std::string_view text);

// Throws what a failed call on a path means: InputError or OutputError. `error`: of errno.
[[noreturn]] void RefuseOutput(const std::filesystem::path& file, int error);

// The names in a folder reach the disk.
void SyncFolder(const std::filesystem::path& folder);

}  // namespace stiction
