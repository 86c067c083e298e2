// SPDX-License-Identifier: Apache-2.0
// The table of known signatures is that of the corpus.

#include "search/units/known_signatures.h"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "certify/exact/exact.h"
#include "corpus/exact_problem.h"
#include "corpus/formats/read_problem.h"
#include "search/units/signature.h"

namespace stiction {
namespace {

TEST_CASE("known signatures: the table has every loop of the corpus under paper, and nothing else") {
  const std::filesystem::path corpus = std::filesystem::path(STICTION_SCENES).parent_path();
  std::vector<std::pair<std::string, std::string>> found;
  for (const auto& folder : {corpus, corpus / "sliding"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      const ExactProblem problem = ReadProblem(entry.path()).problem;
      const ExactRun run = RunExact(problem, {});
      if (IsLoop(run.verdict.outcome))
        found.emplace_back(Signature(problem, run), entry.path().stem().string());
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::pair<std::string, std::string>> table;
  for (const KnownSignature& known : KnownSignatures()) table.emplace_back(known.signature, known.name);
  std::string expected;
  for (const auto& [signature, name] : found)
    expected += fmt::format("    {{\"{}\", \"{}\"}},\n", signature, name);
  INFO("the table for search/units/known_signatures.cpp, " << found.size() << " rows:\n" << expected);
  CHECK(table == found);
  REQUIRE(!found.empty());
  CHECK(KnownAs(found.front().first) == found.front().second);
  CHECK(KnownAs(found.front().first + "@ties=contacts") == found.front().second);
  CHECK(KnownAs("cycle-2c-4d-12s-0000000000000000").empty());
  CHECK(KnownAs("").empty());
}

}  // namespace
}  // namespace stiction
