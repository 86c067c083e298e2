// SPDX-License-Identifier: Apache-2.0
// Every reader, method and writer on every file of the corpus and on problems at the edge of what is one. A
// signal ends the program, and with it the test.

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "corpus/input_file.h"
#include "tests/fuzz/degenerate.h"
#include "tests/fuzz/targets.h"
#include "tests/support.h"

namespace stiction::fuzz {
namespace {

namespace fs = std::filesystem;

std::string FaultOfEvery(const std::string& text) {
  try {
    FuzzEvery(text);
    return "";
  } catch (const std::exception& fault) {
    return fault.what();
  }
}

// Every n-th of them, from the first on.
void CheckSome(const std::vector<std::string>& texts, std::size_t n) {
  for (std::size_t i = 0; i < texts.size(); i += n) {
    CAPTURE(texts[i]);
    CHECK(FaultOfEvery(texts[i]).empty());
  }
}

TEST_CASE("every reader, method and writer takes problems without rows, columns, entries or motion") {
  const std::vector<std::string> texts = DegenerateProblems();
  CHECK(texts.size() > 1000);
  // The steps are coprime to the numbers of loads, forms and contacts.
  CheckSome(texts, testing::Short() ? 97 : testing::All() ? 1 : 23);
}

TEST_CASE("every reader refuses a file that tells no sizes, by what it lacks") {
  for (const std::string& text : FilesWithoutSizes()) {
    CAPTURE(text);
    bool taken = true;
    CHECK_NOTHROW(taken = FuzzEvery(text));
    CHECK(!taken);
  }
}

TEST_CASE("every reader, method and writer takes the small files of the corpus", "[slow]") {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(STICTION_SOURCES) / "corpus")) {
    if (entry.path().extension() == ".json" && entry.file_size() < 4000) files.push_back(entry.path());
  }
  for (const auto& entry : fs::directory_iterator(fs::path(STICTION_SOURCES) / "tests/problems")) {
    if (entry.path().extension() == ".json" && entry.file_size() < 1000) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  CHECK(files.size() > 50);
  for (std::size_t i = 0; i < files.size(); i += testing::All() ? 1 : 3) {
    CAPTURE(files[i]);
    CHECK(FaultOfEvery(ReadInput(files[i], kMostInputBytes)).empty());
  }
}

}  // namespace
}  // namespace stiction::fuzz
