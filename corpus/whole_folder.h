// SPDX-License-Identifier: Apache-2.0
// A folder that is written whole: beside its target until it takes the target's place.
//
// Whoever looks, and whoever is killed when, finds the old folder or the new one. Where the file system can,
// they change places in one call, otherwise in two. The new folder names its files in `.stiction-files`, so
// that the verb that wrote it may replace it without asking; a folder that holds anything else is refused, or,
// if its owner agrees, kept under another name. What a killed process leaves is `.NAME.stiction` beside the
// target; the next one removes it. Anything else of that name, a link above all, is left alone and refused.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "corpus/descriptor.h"

namespace stiction {

enum class Occupied { kRefused, kSetAside };  // a target that holds what its writer did not write

class WholeFolder {
 public:
  // `writer`: the verb. InputError for a target that is no folder, that is occupied, that holds the current
  // folder or is a mount point, where `.NAME.stiction` is somebody else's, and while another process writes it;
  // OutputError where it cannot be written.
  WholeFolder(const std::filesystem::path& target, std::string writer, Occupied occupied);
  WholeFolder(const WholeFolder&) = delete;
  WholeFolder& operator=(const WholeFolder&) = delete;
  ~WholeFolder();  // what was not committed goes

  // Where a path in the target is until Commit; another path is itself.
  std::filesystem::path Place(const std::filesystem::path& path) const;
  // A file of the folder; makes the folders that it is in.
  void Write(const std::filesystem::path& name, std::string_view text) const;

  // Returns the name under which an occupied target was kept, NAME.old or the next free number, or nothing.
  std::filesystem::path Commit();

 private:
  void RequireReplaceable(Occupied occupied) const;
  void LockAndEmpty();
  void WriteList() const;
  std::filesystem::path SetAside() const;
  void TakePlace();

  std::string writer_;
  std::filesystem::path target_, building_;
  Descriptor lock_;
  bool committed_ = false;
};

}  // namespace stiction
