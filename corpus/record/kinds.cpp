// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/kinds.h"

#include <vector>

#include "solver/problem/solution.h"

namespace stiction {

bool IsOfDoubles(std::string_view kind) { return kind == "wrong-answer" || kind == "disagreement"; }

bool IsLoopKind(std::string_view kind) {
  return kind == kSafeCycle || kind == Name(Outcome::kCycle) || kind == Name(Outcome::kStall);
}

std::string KindOf(const std::string& signature) {
  // disagreement-of-methods before disagreement, which it begins with.
  std::vector<std::string_view> kinds = {kSafeCycle, kDisagreementOfMethods, "wrong-answer", "disagreement"};
  kinds.insert(kinds.end(), kOutcomeNames.begin(), kOutcomeNames.end());
  for (const std::string_view kind : kinds) {
    if (signature.starts_with(std::string(kind) + "-")) return std::string(kind);
  }
  return signature;
}

}  // namespace stiction
