// SPDX-License-Identifier: Apache-2.0
#include "cli/playable.h"

#include "cli/narration/page_of_run.h"
#include "cli/narration/published_ends.h"
#include "cli/version.h"
#include "corpus/input_error.h"
#include "corpus/plain_text.h"
#include "corpus/record/digest.h"

namespace stiction {

Playable PlayableOf(const Wanted& wanted, const ProblemFile& file, const SharedJson& picture,
                    const Solution& solution, const std::optional<InexactAnswer>& over_intervals,
                    const std::string& source, const std::string& command) {
  return {PageOfRun(wanted, file, source, picture, solution, over_intervals),
          {command, Version(), ProblemDigest(file.problem)}};
}

std::optional<Playable> PlayFinding(const ProblemFile& file, const std::string& policy,
                                    const std::string& path) {
  Wanted wanted;
  wanted.method = "baraff";
  wanted.policy = policy;
  std::string command = "stiction replay " + ShellWord(path.empty() ? "problem.json" : path);
  if (policy != Wanted().policy) command += " --policy " + ShellWord(policy);
  try {
    const Request request = PathRequestOf(wanted, file.problem, file.name);
    const Solution solution = SolveAsked(file.problem, request, file.name);
    return PlayableOf(wanted, file, {}, solution, OverIntervals(file.problem, request, solution.outcome()),
                      file.name, command + " --html OUT");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace stiction
