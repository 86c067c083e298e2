// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos.h"

#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

bool TakesSiconos(const std::string& text, SiconosKind kind) {
  using enum SiconosStorage;
  const auto problem = Unrefused([&text, kind] { return ParseSiconos(text, kind, "input"); });
  if (!problem) return false;
  if (problem->problem.rows() > kMostRowsPrinted || !IsInDoubles(problem->problem)) return true;
  for (const SiconosStorage storage : {kDense, kBlocks, kTriplet, kColumns}) {
    const std::string printed = PrintSiconos(problem->problem.entries(), kind, storage);
    STICTION_CHECK(IsSame(ParseSiconos(printed, kind, "what was written").problem, problem->problem),
                   "a problem that is read back to another");
  }
  return true;
}

}  // namespace

bool FuzzSiconos(std::string_view bytes) {
  const std::string text(bytes);
  const bool lcp = TakesSiconos(text, SiconosKind::kLcp), friction = TakesSiconos(text, SiconosKind::kFriction);
  Unrefused([&text] { return ParseSiconos(text, std::nullopt, "input"); });
  return lcp || friction;
}

}  // namespace stiction::fuzz
