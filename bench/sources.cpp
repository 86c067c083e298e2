// SPDX-License-Identifier: Apache-2.0
#include "bench/sources.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/dials.h"
#include "corpus/input_error.h"
#include "search/generators.ipp"

namespace stiction {
namespace {

Source GeneratorSource(const GeneratorRow& row, int contacts) {
  return {std::string(row.name), contacts, true, false,
          [id = row.id, contacts](std::uint64_t seed, std::int64_t index) {
            Choices choices(ProblemSeed(seed, 100 + contacts, index));
            ExactProblem problem;
            Generate<Rational, Eigen::Dynamic>(id, contacts, kDefaultPalette, choices, problem);
            return problem;
          }};
}

}  // namespace

std::vector<Source> GeneratorSources(const std::vector<int>& sizes) {
  std::vector<Source> sources;
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;
    for (const int contacts : sizes) sources.push_back(GeneratorSource(row, contacts));
  }
  return sources;
}

std::vector<Source> DialSources(const std::vector<std::string>& families) {
  std::vector<Source> sources;
  for (const std::string& name : families) {
    if (FindDial(name) == nullptr) {
      std::string names;
      for (const Dial& dial : Dials()) names += (names.empty() ? "" : ", ") + dial.name;
      throw InputError(fmt::format("--families: found '{}', expected one of {}", name, names));
    }
  }
  for (const Dial& dial : Dials()) {
    const bool asked =
        families.empty() || std::find(families.begin(), families.end(), dial.name) != families.end();
    if (!asked) continue;
    for (const int setting : dial.settings)
      sources.push_back({dial.name, setting, dial.has_solution, dial.is_large,
                         [&dial, setting](std::uint64_t seed, std::int64_t index) {
                           return MakeDialProblem(dial, setting, seed, index);
                         }});
  }
  return sources;
}

}  // namespace stiction
