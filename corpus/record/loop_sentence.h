// SPDX-License-Identifier: Apache-2.0
// What is proved of a run of the published algorithm that does not end well, by the kind of its certificate
// (certify/certificates.md), and the sentence for it. Every text, page and table takes it from here.
//
// states   A state recurs: exactly in the plane; in space its sets do, and decide its forces.
// box      In space the run never leaves a box. Whether a state recurs is not said.
// endless  In space the run never leaves a box, and no state recurs.
// ray      In space the run comes to a step that nothing limits.
// none     There is no certificate.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "corpus/json_text.h"

namespace stiction {

enum class ProofKind : std::uint8_t { kNone, kStates, kBox, kEndless, kRay };
std::string_view Name(ProofKind kind);  // "" of none

// Of a run: the state after `start` drives, then those of a period; of a ray the steps alone.
struct ProvedRun {
  ProofKind kind = ProofKind::kNone;
  std::int64_t start = 0, period = 0;
  std::int64_t steps = 0;  // from f = 0 to the end of the first period; 0 where it is not known

  bool Recurs() const { return kind == ProofKind::kStates; }
  std::int64_t drives() const { return start + period; }
};

// What a certificate proves of the run under a policy: `cycle`, `counterexample`, `endless`, `ray`. Of another
// one, or of none, the kind is kNone. Requires a certificate that a checker accepts.
ProvedRun ProvedRunOf(const Json& certificate, const std::string& policy);

// "the state after 3 drives recurs 4 drives later"; of a box "from the state after 5 drives on it never leaves
// a box, the same steps every 48 drives". `unit`: of start and period.
std::string LoopClause(const ProvedRun& run, std::string_view unit = "drive");
// The same, ", for ever" behind it where it is.
std::string LoopSentence(const ProvedRun& run, std::string_view unit = "drive");

}  // namespace stiction
