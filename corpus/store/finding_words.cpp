// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/finding_words.h"

#include <fmt/format.h>

#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "solver/problem/solution.h"

namespace stiction {

FindingForm SimplestForm(const Finding& finding) {
  return finding.minimized.empty() ? FindingForm::kFound : FindingForm::kMinimized;
}

namespace {

ProvedRun ByFacts(const Finding& finding, const char* key) {
  const Json facts = finding.facts.empty() ? Json::object() : ParseJson(finding.facts, finding.signature);
  if (!facts.contains(key)) return {};
  const bool in_space = ParseProblem(finding.problem, finding.signature).problem.dimension() == 3;
  // Facts of earlier builds have fewer counts.
  const auto count = [&](const char* name) { return facts.at(key).value(name, std::int64_t{0}); };
  if (in_space) return {ProofKind::kNone, count("start"), count("period"), 0};
  return {ProofKind::kStates, count("start"), count("period"), count("steps")};
}

}  // namespace

ProvedRun ProvedRunOf(const Finding& finding, FindingForm form) try {
  const bool found = form == FindingForm::kFound;
  const std::string& certificate = found ? finding.certificate : finding.minimized_certificate;
  if (!certificate.empty()) {
    const ProvedRun run = ProvedRunOf(ParseJson(certificate, finding.signature), finding.policy);
    if (run.kind != ProofKind::kNone) return run;
  }
  return ByFacts(finding, found ? "found" : "minimized");
} catch (const Json::exception&) {
  throw InputError(fmt::format(
      "{}: found a certificate or facts that say nothing of a run, expected those of one", finding.signature));
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
