// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/kinds.h"

#include <algorithm>
#include <array>
#include <vector>

#include "solver/problem/solution.h"

namespace stiction {

namespace {

constexpr auto kOfSolver = std::to_array<std::string_view>(
    {"crash", "hang", "leak", "not-finite", "silent-wrong", "refused-solvable"});

}  // namespace

bool IsOfSolver(std::string_view kind) {
  return std::find(kOfSolver.begin(), kOfSolver.end(), kind) != kOfSolver.end();
}

bool IsOfDoubles(std::string_view kind) { return kind == "wrong-answer" || kind == "disagreement"; }

bool IsLoopKind(std::string_view kind) {
  return kind == kSafeCycle || kind == Name(Outcome::kCycle) || kind == Name(Outcome::kStall);
}

std::string KindOf(const std::string& signature) {
  // disagreement-of-methods before disagreement, which it begins with.
  std::vector<std::string_view> kinds = {kSafeCycle, kDisagreementOfMethods, "wrong-answer", "disagreement"};
  kinds.insert(kinds.end(), kOutcomeNames.begin(), kOutcomeNames.end());
  kinds.insert(kinds.end(), kOfSolver.begin(), kOfSolver.end());
  for (const std::string_view kind : kinds) {
    if (signature.starts_with(std::string(kind) + "-")) return std::string(kind);
  }
  return signature;
}

}  // namespace stiction
