// SPDX-License-Identifier: Apache-2.0
// A store that tests of summaries and of texts are about: what its records add up to is known.

#pragma once

#include <string>
#include <string_view>

#include "corpus/record/kinds.h"
#include "corpus/record/statistics.h"
#include "corpus/store/store.h"

namespace stiction::testing {

// Not finished yet.
inline Finding Waiting(const std::string& signature, std::string_view kind, std::int64_t unit,
                       const std::string& problem) {
  Finding finding;
  finding.signature = signature;
  finding.kind = kind;
  finding.unit = unit;
  finding.index = 7;
  finding.generator = "psd";
  finding.contacts = 2;
  finding.policy = "paper";
  finding.inexact_outcome = finding.exact_outcome = IsLoopKind(kind) ? "cycle" : std::string(kind);
  finding.problem = problem;
  return finding;
}

// `grid`: outcomes of the policies on the minimized problem, as JSON.
inline Finding MinimizedTo(Finding finding, const std::string& problem, const std::string& grid) {
  finding.done = true;
  finding.minimized = problem;
  finding.facts = R"({"minimized":{"contacts":2,"start":3,"period":1,"grid":)" + grid + R"(}})";
  return finding;
}

// Two policies on the same 30 problems; of one of them 4 suspicions, 3 confirmed.
inline Record TwoPolicies() {
  constexpr int kCycle = static_cast<int>(Outcome::kCycle), kRay = static_cast<int>(Outcome::kRay),
                kSolved = static_cast<int>(Outcome::kSolved);
  Record record;
  Tally& paper = record.tallies[{"psd", 2, "paper"}];
  paper.problems = 30;
  paper.verdicts[kCycle][kCycle] = 2;
  paper.verdicts[kRay][kRay] = 1;
  paper.verdicts[kRay][kSolved] = 1;
  paper.audited = 7;
  paper.misjudged = 5;
  paper.wrong = 11;
  Stratum& stratum = paper.strata[{"1/2", 4}];
  stratum.problems = 30;
  stratum.exact[kCycle] = 2;
  record.tallies[{"psd", 2, "ties=contacts"}].problems = 30;
  record.existence[2] = {13, 12, 0, 6, 8, 0};
  AgreementTally& agreement = record.agreement[2];
  agreement.compared = 17;
  agreement.enumerated = 19;
  agreement.disagreements = 23;
  agreement.safety_decided = 29;
  agreement.safe = 31;
  agreement.safe_gave_up = 37;
  record.loops[2] = {.loops = 41,
                     .drives = 200,
                     .steps = 500,
                     .zero_steps = 90,
                     .without_zero_steps = 3,
                     .of_zero_steps_alone = 2,
                     .by_zero_steps = {}};
  record.loops[3].loops = 5;
  record.signatures = {{"cycle-2c-4d-10s-00", 2}, {"cycle-2c-4d-12s-00", 1}, {"ray-2c", 40}};
  return record;
}

}  // namespace stiction::testing
