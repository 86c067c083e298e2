// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/finding_words.h"

#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

FindingForm SimplestForm(const Finding& finding) {
  return finding.minimized.empty() ? FindingForm::kFound : FindingForm::kMinimized;
}

ProvedRun ProvedRunOf(const Finding& finding, FindingForm form) {
  const bool found = form == FindingForm::kFound;
  // A finding that was minimized with another certificate has none of the problem as found.
  const std::string& certificate = found ? finding.certificate : finding.minimized_certificate;
  if (!certificate.empty()) {
    const ProvedRun run = ProvedRunOf(ParseJson(certificate, finding.signature), finding.policy);
    if (run.kind != ProofKind::kNone) return run;
  }
  const std::string source = "facts of " + finding.signature;
  const Json facts = finding.facts.empty() ? Json::object() : ParseJson(finding.facts, source);
  const char* key = found ? "found" : "minimized";
  if (!facts.contains(key)) return {};
  const bool in_space = ParseProblem(finding.problem, finding.signature).problem.dimension == 3;
  const Json& of = facts[key];
  return {in_space ? ProofKind::kNone : ProofKind::kStates, of.value("start", std::int64_t{0}),
          of.value("period", std::int64_t{0}), in_space ? 0 : of.value("steps", std::int64_t{0})};
}

std::string_view UnitOfLoop(const Finding& finding) {
  return finding.exact_outcome == Name(Outcome::kStall) ? "step" : "drive";
}

std::string SentenceOf(const Finding& finding) {
  if (!finding.done || !IsLoopKind(finding.kind)) return "";
  return LoopSentence(ProvedRunOf(finding, SimplestForm(finding)), UnitOfLoop(finding));
}

std::string ReplayOptionsOf(const Finding& finding) {
  std::string options;
  if (finding.policy != "paper") options += " --policy " + ShellWord(finding.policy);
  if (IsOfDoubles(finding.kind)) options += " --arithmetic double";
  return options;
}

}  // namespace stiction
