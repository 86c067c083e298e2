// SPDX-License-Identifier: Apache-2.0
// stiction slurm: a campaign as a job array and a job that merges what it leaves.
//
// A task runs the units of its shard into a store of its own, under another name until it is whole, so that an
// old copy of a task that still runs somewhere does no harm: both write the same. Tasks finish no findings,
// since shards meet the same ones; the merge does. The scripts need bash and, to start over, Slurm's commands;
// without Slurm the same tasks run in a loop or under GNU parallel.

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>

#include "cli/command_line.h"
#include "cli/shared.h"
#include "cli/slurm.sh_in.h"
#include "corpus/plain_text.h"
#include "corpus/text_template.h"
#include "search/campaign.h"

namespace stiction {
namespace {

struct SlurmVerb {
  std::string campaign, folder;
  int shards = 0;
  std::int64_t problems = 0;
  int cpus = 1;
  int time = 120;  // minutes
  bool replace = false, json = false;
};

int RunSlurm(const SlurmVerb& o) {
  namespace fs = std::filesystem;
  const Campaign campaign = AsBegun(ReadCampaign(o.campaign));
  RequireConsistent(campaign);
  const std::int64_t units = UnitsFor(campaign, o.problems);
  if (units < o.shards) {
    throw InputError(fmt::format("--shards: found {}, expected at most {}: so many units hold {} problems",
                                 o.shards, units, o.problems));
  }
  const fs::path folder = fs::absolute(o.folder).lexically_normal();
  if (folder.string().find_first_of("\n%\"\\") != std::string::npos)
    throw InputError(
        fmt::format("{}: found %, \", \\ or a line feed in the name, expected a folder that Slurm can name",
                    folder.string()));
  const std::map<std::string, std::string> places = {
      {"SHARDS", std::to_string(o.shards)},
      {"LAST", std::to_string(o.shards - 1)},
      {"UNITS", std::to_string(units)},
      {"PROBLEMS", std::to_string(o.problems)},
      {"CPUS", std::to_string(o.cpus)},
      {"TIME", std::to_string(o.time)},
      {"DIR", ShellWord(folder.string())},
      {"LOGS", (folder / "logs").string()},
      {"STICTION", ShellWord(fs::read_symlink("/proc/self/exe").string())}};
  WholeFolder whole(folder, "slurm", OccupiedIf(o.replace));
  whole.Write("campaign.json", JsonText(ToJson(campaign), 1) + "\n");
  for (const std::string name : {"task", "merge", "submit"}) {
    whole.Write(name + ".sh", Filled(kSlurmSh, {places, {name}}));
    fs::permissions(whole.Place(folder / (name + ".sh")), fs::perms(0755));
  }
  whole.Write("logs/.keep", "");
  whole.Write("shards/.keep", "");
  TellAside(whole.Commit());
  const std::string submit = o.folder + "/submit.sh";
  SayWhatWasDone(
      o.folder, o.json, submit + "\n",
      {{"written", std::vector{o.folder}}, {"submit", submit}, {"shards", o.shards}, {"units", units}});
  return kExitDone;
}

}  // namespace

const ListedVerb kSlurmVerb("Find", 70, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("slurm", "Write a campaign as a job array and a job that merges its shards", RunSlurm);
  verb.footer =
      "Writes task.sh, merge.sh and submit.sh, which submits both, and campaign.json; options of submit.sh "
      "(--partition, --account, ...) are sbatch's, of tasks and merge. Tasks that are killed are queued again; "
      "the merge has what is missing run again, finishes all findings and writes merged.store and report/. A "
      "thousand tasks make an array. Without Slurm: seq 0 LAST | parallel FOLDER/task.sh; then "
      "FOLDER/merge.sh. How many shards there are changes nothing, unless the campaign has an objective: a "
      "shard learns from its own units. STICTION names another program.";
  verb.Positional("CAMPAIGN", o.campaign, "stiction-campaign file").Required();
  verb.Option("--shards", o.shards, "tasks; each should take minutes").Required().Range(1, 100000);
  verb.Option("-n,--problems", o.problems, "size of the whole campaign, rounded up to whole units")
      .Required()
      .AtLeast(1);
  verb.Option("-o,--output", o.folder, "folder to write, which every node sees").Required();
  verb.Option("--cpus", o.cpus, "cores of a task").Range(1, 1024);
  verb.Option("--time", o.time, "limit of a task").Unit("min").Range(1, 100000);
  verb.Prints(o.json, "a job array", "{written: written, submit: text, shards: integer, units: integer}");
  AddReplace(verb, o.replace);
});

}  // namespace stiction
