// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/loop_sentence.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/grouped.h"
#include "corpus/json.h"

namespace stiction {
namespace {

ProofKind KindInSpace(const Json& certificate) {
  const std::string claim = certificate.at("claim");
  if (claim == "endless") return ProofKind::kEndless;
  if (claim == "ray") return ProofKind::kRay;
  return certificate.at("witness").at("kind") == "states" ? ProofKind::kStates : ProofKind::kBox;
}

// The run that names the policy; the first one where none does.
const Json& RunUnder(const Json& runs, const std::string& policy) {
  for (const Json& run : runs) {
    const Json& policies = run.at("policies");
    if (std::find(policies.begin(), policies.end(), Json(policy)) != policies.end()) return run;
  }
  return runs.at(0);
}

bool IsOfRuns(const Json& certificate) {
  constexpr std::string_view kClaims[] = {"cycle", "counterexample", "endless", "ray"};
  return certificate.is_object() &&
         std::find(std::begin(kClaims), std::end(kClaims), certificate.value("claim", "")) != std::end(kClaims);
}

// "the state after 3 drives".
std::string StateAfter(const ProvedRun& run, std::string_view unit) {
  return "the state after " + Counted(run.start, unit);
}

std::string InBox(const ProvedRun& run, std::string_view unit) {
  return fmt::format("from {} on it never leaves a box, the same steps every {}", StateAfter(run, unit),
                     Counted(run.period, unit));
}

}  // namespace

std::string_view Name(ProofKind kind) {
  constexpr std::string_view kNames[] = {"", "states", "box", "endless", "ray"};
  return kNames[static_cast<int>(kind)];
}

ProvedRun ProvedRunOf(const Json& certificate, const std::string& policy) {
  if (!IsOfRuns(certificate)) return {};
  const Json& witness = certificate.at("witness");
  const auto size = [](const Json& list) { return static_cast<std::int64_t>(list.size()); };
  if (witness.contains("runs")) {
    const Json& run = RunUnder(witness.at("runs"), policy);
    return {ProofKind::kStates, run.at("start").get<std::int64_t>(), run.at("period").get<std::int64_t>(),
            size(run.at("pivots"))};
  }
  ProvedRun run{KindInSpace(certificate), 0, 0, size(witness.at("word"))};
  if (run.kind == ProofKind::kRay) return run;
  run.start = witness.at("start").get<std::int64_t>();
  run.period = witness.at("period").get<std::int64_t>();
  return run;
}

std::string LoopClause(const ProvedRun& run, std::string_view unit) {
  switch (run.kind) {
    case ProofKind::kStates:
      return fmt::format("{} recurs {} later", StateAfter(run, unit), Counted(run.period, unit));
    case ProofKind::kBox:
      return InBox(run, unit);
    case ProofKind::kEndless:
      return "no state recurs: " + InBox(run, unit);
    case ProofKind::kRay:
      return fmt::format("after {} it comes to a step that nothing limits", Counted(run.steps, "step"));
    case ProofKind::kNone:
      break;
  }
  return fmt::format("from {} on the same steps every {}", StateAfter(run, unit), Counted(run.period, unit));
}

std::string LoopSentence(const ProvedRun& run, std::string_view unit) {
  return LoopClause(run, unit) + (run.kind == ProofKind::kRay ? "" : ", for ever");
}

}  // namespace stiction
