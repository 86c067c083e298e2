// SPDX-License-Identifier: Apache-2.0
// stiction explain: one problem in words (narration/explained.h).

#include <iostream>

#include "cli/command_line.h"
#include "cli/narration/explained.h"
#include "cli/program.h"
#include "cli/shared.h"

namespace stiction {
namespace {

struct ExplainVerb : ExplainOptions {
  bool json = false;
};

int RunExplain(const ExplainVerb& o) {
  const SharedJson found = Explained(ReadProblem(o.file, kAnyRows), o);
  std::cout << (o.json ? JsonText(found) + "\n" : AsTyped(ExplainedText(found)));
  return kExitDone;
}

}  // namespace

const ListedVerb kExplainVerb("Solve", 20, [](CommandLine& program) {
  auto [verb, o] = program.Add(
      "explain", "What a problem is, whether it has a solution, and what the methods do on it", RunExplain);
  verb.footer =
      "Up to 24 rows every method runs and every claim of such problems is tried, up to 8 contacts every "
      "policy "
      "and every contact mode, too; of larger problems what `survey` finds is told.";
  verb.Positional("FILE", o.file, kFileHelp).Required().Details(kFileDetails);
  verb.Prints(o.json,
              "one problem: what it is, what the methods do on it, what can be certified, what to type next",
              R"({
      file: text, kinds: {*: integer}, mu?: [exact, exact], diagonal?: [exact, exact],
      survey: object,  // an entry of survey --json, without its file
      rank?: integer,
      methods?: [{method: method, arithmetic: arithmetic, outcome: outcome, reason?: text, start?: integer,
                  period?: integer, unique_accelerations?: false}],
      solve?: {method: text, arithmetic: arithmetic, outcome: outcome | "not tried", reason?: text,
               start?: integer, period?: integer, unique_accelerations?: false},  // what `solve` says by default
      policies?: {all: integer, arithmetic: arithmetic, outcomes: {*: integer},
                  loops: {outcome: outcome, start: integer, period: integer, policy: text, proved: truth,
                          kind: "states" | "box", reason?: text} | null},
      solutions?: {complete: truth, modes: [[text]], unique: truth},
      safety?: object,  // what certify --safe --json prints
      safe_below?: exact | null, radius?: exact | null,
      claims?: [{claim: text, meaning: text, state: "proved" | "disproved" | "not decided", says: text,
                 certificate: text | null, command: text}],
      next: [{command: text, shows: text}]})");
  AddLimits(verb, o.limits);
});

}  // namespace stiction
