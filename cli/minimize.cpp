// SPDX-License-Identifier: Apache-2.0
// stiction minimize: a simpler problem with the same certified finding.

#include "search/units/minimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "certify/exact/exact.h"
#include "certify/exact/published_space.h"
#include "cli/command_line.h"
#include "cli/help.h"
#include "cli/narration/outcome_text.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "search/adversary/minimize_candidate.h"
#include "search/units/signature.h"

namespace stiction {
namespace {

struct MinimizeVerb {
  std::string file;
  std::string output;
  std::string keep;  // empty: the outcome under the policy
  std::string policy = "paper";
  bool keep_signature = false;
  bool as_scene = false, further = false;
  bool json = false;
  Limits limits;
};

std::optional<Outcome> FindOutcome(std::string_view name) {
  const auto found = std::find(kOutcomeNames.begin(), kOutcomeNames.end(), name);
  if (found == kOutcomeNames.end()) return std::nullopt;
  return static_cast<Outcome>(found - kOutcomeNames.begin());
}

std::string CheckKeep(const std::string& text) {
  const std::string outcome = text.ends_with(":*") ? text.substr(0, text.size() - 2) : text;
  if (FindOutcome(outcome)) return "";
  const std::string nearest = Nearest(outcome, {kOutcomeNames.begin(), kOutcomeNames.end()});
  return fmt::format("found '{}', expected one of {}, with :* behind it for the whole policy grid{}", text,
                     fmt::join(kOutcomeNames, ", "), nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

// The choices of the generator that made the file are made simpler, and the problem with its scene anew of
// them.
int MinimizeAsScene(const MinimizeVerb& o, const ProblemFile& file, const Policy& policy,
                    const MinimizeOptions& options) {
  const Candidate candidate = CandidateOf(file, o.file);
  const auto keep = [&](const Candidate& tried) {
    const ExactProblem problem = ExactOf(tried);
    const bool kept = AllEndIn(options.keep, problem, options.policies, o.limits);
    return kept && (!options.signature ||
                    Signature(problem, RunExact(problem, {.policy = policy, .limits = o.limits})) ==
                        *options.signature);
  };
  if (!keep(candidate)) {
    throw InputError(o.file, "--keep", std::string(Name(options.keep)),
                     "an outcome of the problem that the choices in its origin make");
  }
  const MinimizedCandidate minimized = MinimizeCandidate(candidate, keep);
  ProblemFile simple = FileOf(minimized.candidate, file.name + "-minimized");
  simple.expect = {{options.policies.size() > 1 ? "*" : PolicyName(policy), std::string(Name(options.keep))}};
  WriteText(o.output, Print(simple));
  (o.output == "-" ? std::cerr : std::cout)
      << Folded(fmt::format("{}: {}, {}; was {}, {}. Tried {}, took {}.\n", Name(options.keep),
                            Counted(minimized.candidate.contacts, "contact"),
                            Counted(static_cast<std::int64_t>(minimized.candidate.choices.size()), "choice"),
                            candidate.contacts, candidate.choices.size(), minimized.tried, minimized.accepted));
  return kExitDone;
}

// In space the published algorithm is run over intervals, under what is built of it there.
void RequireForSpace(const MinimizeVerb& o, const Policy& policy) {
  const auto refuse = [&o](const char* option, const std::string& found) {
    throw InputError(o.file, "dimension", "3", fmt::format("2 with {}{}", option, found));
  };
  if (!PublishedReadsInSpace(policy)) refuse("--policy ", o.policy);
  if (o.keep.ends_with(":*")) refuse("--keep ", o.keep);
  if (o.keep_signature) refuse("--keep-signature", "");
  if (o.as_scene) refuse("--as-scene", "");
}

// How it loops, as `replay` says it.
std::string EndOfMinimized(const ExactProblem& problem, const Request& published) {
  const std::string under = fmt::format("under {}, ", PolicyName(published.policy));
  if (problem.dimension == 3) return under + Describe(RunIntervalsInSpace(problem, published));
  return under + Describe(RunExact(problem, published).verdict);
}

int RunMinimize(const MinimizeVerb& o) {
  ProblemFile file = ReadProblem(o.file);
  const Policy policy = ParsePolicy(o.policy);
  const Request published{.policy = policy, .limits = o.limits};
  const bool in_space = file.problem.dimension() == 3;
  if (in_space) RequireForSpace(o, policy);
  const ExactRun run = in_space ? ExactRun() : RunExact(file.problem, published);
  const Outcome outcome = in_space ? RunIntervalsInSpace(file.problem, published).outcome : run.verdict.outcome;
  const std::string keep = o.keep.empty() ? std::string(Name(outcome)) : o.keep;
  const bool whole_grid = keep.ends_with(":*");
  MinimizeOptions options;
  options.keep = *FindOutcome(whole_grid ? keep.substr(0, keep.size() - 2) : keep);
  options.policies = {policy};
  if (whole_grid) {
    options.policies = PlanarGrid();
    std::iter_swap(options.policies.begin(),
                   std::find(options.policies.begin(), options.policies.end(), policy));
  }
  if (in_space && options.keep == Outcome::kUndecided) {
    const std::string place = o.keep.empty() ? "outcome under " + o.policy : "--keep";
    throw InputError(o.file, place, "undecided", "an outcome that intervals prove");
  }
  if (o.keep_signature) options.signature = Signature(file.problem, run);
  options.limits = o.limits;
  options.further = o.further;
  if (o.as_scene) return MinimizeAsScene(o, file, policy, options);
  const Simplicity before = SimplicityOf(file.problem);
  const Minimized minimized = Minimize(file.problem, options);
  const Simplicity after = SimplicityOf(minimized.problem);
  file.problem = minimized.problem;
  file.origin = {{"parent", file.name}, {"minimized", true}};
  if (file.scene) file.origin.Add({{"scene", kSceneOfParent}});
  file.scene = {};
  file.name += "-minimized";
  file.expect = {{whole_grid ? "*" : PolicyName(policy), std::string(Name(options.keep))}};
  WriteText(o.output, Print(file));
  const auto size = [](const Simplicity& s) {
    return SharedJson{{"contacts", s.contacts}, {"rows", s.rows}, {"nonzeros", s.nonzeros}, {"bits", s.bits}};
  };
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  const std::string loop =
      IsLoop(options.keep) ? EndOfMinimized(file.problem, published) : "";  // under the first policy
  if (o.json) {
    out << JsonText(SharedJson{{"keep", keep},
                               {"before", size(before)},
                               {"after", size(after)},
                               {"candidates", minimized.candidates},
                               {"accepted", minimized.accepted},
                               {"says", loop}})
        << "\n";
  } else {
    out << Folded(fmt::format("{}: {}, {}, {}; was {}, {}, {}. Tried {}, took {}.\n", keep,
                              Counted(after.contacts, "contact"), Counted(after.nonzeros, "nonzero"),
                              Counted(after.bits, "bit"), before.contacts, before.nonzeros, before.bits,
                              minimized.candidates, minimized.accepted) +
                  (loop.empty() ? "" : loop + "\n"));
  }
  return kExitDone;
}

}  // namespace

const ListedVerb kMinimizeVerb("Find", 30, [](CommandLine& program) {
  auto [verb, o] = program.Add("minimize", "A simpler problem with the same certified finding", RunMinimize);
  verb.Positional("FILE", o.file, kFileHelp)
      .Required()
      .Details(std::string(kFileDetails) + ". In space what intervals prove is kept, under one policy");
  verb.Option("-o,--output", o.output, "problem to write; - is standard output").Required();
  verb.Option("--keep", o.keep, "outcome to keep, e.g. cycle; by default the outcome under the policy")
      .Details("With :* behind it under every policy of the planar grid")
      .Check(CheckKeep);
  verb.Flag("--keep-signature", o.keep_signature, "keep the sequence of pivots of the loop as well");
  verb.Flag("--further", o.further, "also round by lot and change two entries at once; takes longer");
  verb.Flag("--as-scene", o.as_scene,
            "keep it a scene that can be built: of a problem with the choices of a generator");
  AddPolicyOption(verb, o.policy, Grid::kRefused);
  verb.Prints(o.json, "how much smaller a problem has become; the problem itself where -o is -",
              "{keep: text, before: size, after: size, candidates: integer, accepted: integer,\n"
              " says: text  // how it loops; empty of what does not\n} | problem");
  AddLimits(verb, o.limits);
});

}  // namespace stiction
