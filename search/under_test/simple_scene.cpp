// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/simple_scene.h"

#include <string>
#include <vector>

#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/adversary/minimize_candidate.h"
#include "search/adversary/parents.h"
#include "search/under_test/solver_process.h"

namespace stiction {
namespace {

// What the finding's problem was made of; its friction is not told.
Candidate DrawnFor(const Finding& finding, const Campaign& campaign) {
  if (!campaign.objective.empty())
    return CandidateOf(ParseProblem(finding.problem, finding.signature), finding.signature);
  return CandidateOf(campaign, finding.unit, finding.index);
}

ContactProblem<double> AsPosed(const Candidate& scene, SolverLaw law) {
  return PosedFor(law, RoundedOf(scene, nullptr));
}

}  // namespace

std::optional<Candidate> SimpleSceneOf(const Finding& finding, const Campaign& campaign,
                                       const std::function<bool(const ContactProblem<double>&)>& fails,
                                       const std::function<bool()>& cancelled) {
  const SolverLaw law = campaign.solver.law;
  const auto keep = [&](const Candidate& scene) { return fails(AsPosed(scene, law)); };
  Candidate drawn = DrawnFor(finding, campaign);
  if (!FileOf(drawn, finding.signature).scene) return std::nullopt;
  std::vector<MuChoice> frictions = campaign.palette;
  if (law == SolverLaw::kFrictionless) frictions = {{0, 1}};
  for (const MuChoice& mu : frictions) {
    drawn.mu = mu;
    if (cancelled()) return std::nullopt;
    if (!keep(drawn)) continue;
    const MinimizedCandidate simple = MinimizeCandidate(drawn, keep, cancelled);
    if (simple.cancelled) return std::nullopt;
    return simple.candidate;
  }
  return std::nullopt;
}

ProblemFile PosedFileOf(const Candidate& scene, SolverLaw law, const std::string& name) {
  ProblemFile file = FileOf(scene, name);
  file.problem = Unrounded(AsPosed(scene, law));
  return file;
}

}  // namespace stiction
