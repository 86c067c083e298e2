// SPDX-License-Identifier: Apache-2.0
// A folder for the files of a test, which goes with it.

#pragma once

#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <string>

namespace stiction::testing {

class Scratch {
 public:
  Scratch() : path_((std::filesystem::temp_directory_path() / "stiction-test-XXXXXX").string()) {
    REQUIRE(mkdtemp(path_.data()) != nullptr);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return std::filesystem::path(path_) / name; }

  // Hidden ones too.
  int Entries() const {
    return static_cast<int>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::string path_;
};

}  // namespace stiction::testing
