// SPDX-License-Identifier: Apache-2.0
// stiction slurm: a campaign as a job array and a job that merges what it leaves.
//
// A task runs the units of its shard into a store of its own, under another name until it is whole, so that an
// old copy of a task that still runs somewhere does no harm: both write the same. Tasks finish no findings,
// since shards meet the same ones; the merge does. The scripts need bash and, to start over, Slurm's commands;
// without Slurm the same tasks run in a loop or under GNU parallel.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "cli/command_line.h"
#include "cli/shared.h"
#include "corpus/atomic_file.h"
#include "corpus/json.h"
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

constexpr const char* kCommon = R"sh(
set -u
shards=@SHARDS@ units=@UNITS@ problems=@PROBLEMS@
dir=@DIR@
stiction=${STICTION:-@STICTION@}
cd "$dir" || exit 2

note() { printf '%s %s\n' "$(date '+%F %T')" "$*" >&2; }

# Units that a store holds.
units_of() { "$stiction" status "$1" --json | tr ',' '\n' | sed -n 's/^{*"units":\([0-9]*\).*/\1/p' | head -n 1; }

# Units of a shard when it is whole.
units_wanted() { echo $(((units - $1 + shards - 1) / shards)); }
)sh";

// Slurm takes indices of an array up to 1000, unless its MaxArraySize says otherwise.
constexpr const char* kArrays = R"sh(
# sbatch's options, which submit.sh was given, one a line.
options=()
[[ ! -e options ]] || mapfile -t options <options

# Submits tasks for shards, in ascending order; prints the jobs with colons between them. Where Slurm takes no more, the
# merge after those that it took has the rest run.
submit_tasks() {
  local jobs= job first list from to
  while (($#)); do
    first=$(($1 / 1000 * 1000)) list=
    while (($# && ${1:-0} < first + 1000)); do
      from=$(($1 - first)) to=$from
      shift
      while (($# && to < 999 && ${1:-0} == first + to + 1)); do
        ((++to))
        shift
      done
      list+=,$from
      ((from == to)) || list+=-$to
    done
    job=$(sbatch --parsable "${options[@]}" --array="${list:1}" --export=ALL,STICTION_FIRST="$first" task.sh) || {
      echo "sbatch takes no more from shard $first on: the merge has them run, if any was taken" >&2
      break
    }
    jobs+=:${job%%;*}
  done
  [[ -n $jobs ]] && echo "${jobs:1}"
}

# submit_merge JOBS ROUND: the merge, once these jobs have ended.
submit_merge() {
  local job
  job=$(sbatch --parsable "${options[@]}" --export=ALL,STICTION_ROUND="$2" --dependency="afterany:$1" merge.sh) || return
  echo "${job%%;*}"
}
)sh";

constexpr const char* kTask = R"sh(#!/bin/bash
# One shard of a campaign: task NUMBER, or STICTION_FIRST + SLURM_ARRAY_TASK_ID. Leaves shards/NUMBER.store, or nothing.
#SBATCH --job-name=stiction
#SBATCH --cpus-per-task=@CPUS@
#SBATCH --time=@TIME@
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="@LOGS@/task-%A-%a.log"
@COMMON@
shard=${1-}
[[ -n $shard || -z ${SLURM_ARRAY_TASK_ID-} ]] || shard=$((${STICTION_FIRST:-0} + SLURM_ARRAY_TASK_ID))
[[ $shard =~ ^[0-9]+$ ]] && ((shard < shards)) || { note "task: found shard '$shard', expected 0 to $((shards - 1))"; exit 2; }
whole=shards/$shard.store
[[ ! -e $whole ]] || exit 0
# Of this attempt alone: another one may still be running on a node that was given up.
work=$(mktemp -d "shards/.$shard.XXXXXX") || exit 74
trap 'rm -rf -- "$work"' EXIT
store=$work/store

# What a signal or a lost child leaves is done again, a few times. Slurm does not requeue a task whose program was killed.
again() {
  if [[ -n ${SLURM_ARRAY_JOB_ID-} ]] && ((${SLURM_RESTART_COUNT:-0} < 5)); then
    note "shard $shard: $1: once more"
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID" && sleep 60
  fi
  note "shard $shard: $1"
  exit 75
}

"$stiction" search campaign.json --store "$store" --shard "$shard/$shards" --problems "$problems" --finishing 0 \
  --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" >/dev/null &
child=$!
trap 'kill -TERM "$child" 2>/dev/null' TERM INT HUP
wait "$child"
status=$?
while kill -0 "$child" 2>/dev/null; do wait "$child"; status=$?; done  # a signal ends `wait` first
case $status in
  0 | 4) ;;  # 4: a grave finding, which the merge reports
  2 | 70) note "shard $shard: stiction ended with status $status"; exit "$status" ;;
  *) again "stiction ended with status $status" ;;
esac
have=$(units_of "$store")
[[ $have == "$(units_wanted "$shard")" ]] || again "has ${have:-no} units, expected $(units_wanted "$shard")"
[[ ! -s $store-wal ]] || again "its store is not closed"
sync -- "$store" && mv -fT -- "$store" "$whole" || exit 74
note "shard $shard: $have units"
)sh";

constexpr const char* kMerge = R"sh(#!/bin/bash
# Merges the shards once all are there; has those that are missing run again, and itself after them.
#SBATCH --job-name=stiction-merge
#SBATCH --cpus-per-task=@CPUS@
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="@LOGS@/merge.log"
@COMMON@@ARRAYS@
round=${STICTION_ROUND:-1}
missing=() stores=()
for ((shard = 0; shard < shards; ++shard)); do
  store=shards/$shard.store
  if [[ ! -e $store ]]; then
    missing+=("$shard")
    continue
  fi
  have=$(units_of "$store")
  if [[ $have == "$(units_wanted "$shard")" ]]; then
    stores+=("$store")
  else
    note "shard $shard: ${have:-no} units can be read, expected $(units_wanted "$shard"); kept as $store.damaged"
    mv -fT -- "$store" "$store.damaged"
    missing+=("$shard")
  fi
done
if ((${#missing[@]})); then
  note "${#missing[@]} of $shards shards are missing: $(IFS=,; echo "${missing[*]}")"
  if ((round >= 5)) || ! command -v sbatch >/dev/null; then
    note "run them with task.sh, then merge.sh again"
    exit 75
  fi
  jobs=$(submit_tasks "${missing[@]}") && submit_merge "$jobs" $((round + 1)) >/dev/null || exit 75
  exit 0
fi

work=$(mktemp -d .merged.XXXXXX) || exit 74
trap 'rm -rf -- "$work"' EXIT
merged=$work/store
for ((first = 0; first < ${#stores[@]}; first += 1000)); do  # a command line has an end
  "$stiction" merge "$merged" "${stores[@]:first:1000}" >/dev/null
  status=$?
  [[ $status == 0 || $status == 4 ]] || exit "$status"
done
[[ $(units_of "$merged") == "$units" ]] || { note "the merged store has $(units_of "$merged") units, expected $units"; exit 70; }
"$stiction" search --store "$merged" --finish --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" >/dev/null
status=$?
[[ $status == 0 || $status == 4 ]] || exit "$status"
mv -fT -- "$merged" merged.store || exit 74
rm -rf -- shards/.[0-9]*  # of tasks whose nodes died
"$stiction" report merged.store -o report || exit
"$stiction" status merged.store
exit "$status"
)sh";

constexpr const char* kSubmit = R"sh(#!/bin/bash
# Submits the shards, and the merge after them. Options are sbatch's, for both: --partition=... --account=...
cd -- @DIR@ || exit 2
rm -f -- options
set -C  # never through a link
for option; do printf '%s\n' "$option"; done >options || exit 74
@ARRAYS@
jobs=$(submit_tasks $(seq 0 @LAST@)) && merge=$(submit_merge "$jobs" 1) || exit
echo "tasks ${jobs//:/, }, merge $merge"
)sh";

// As one word of a shell.
std::string ShellWord(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// Each mark @NAME@ of the text replaced by its value, in which no mark is looked for.
std::string Filled(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  while (!text.empty()) {
    const auto value = std::find_if(values.begin(), values.end(), [text](const auto& entry) {
      return text.starts_with("@" + entry.first + "@");
    });
    const bool is_mark = value != values.end();
    filled += is_mark ? value->second : std::string(text.substr(0, 1));
    text.remove_prefix(is_mark ? value->first.size() + 2 : 1);
  }
  return filled;
}

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
  std::map<std::string, std::string> values = {
      {"SHARDS", std::to_string(o.shards)},
      {"LAST", std::to_string(o.shards - 1)},
      {"UNITS", std::to_string(units)},
      {"PROBLEMS", std::to_string(o.problems)},
      {"CPUS", std::to_string(o.cpus)},
      {"TIME", std::to_string(o.time)},
      {"DIR", ShellWord(folder.string())},
      {"LOGS", (folder / "logs").string()},
      {"STICTION", ShellWord(fs::read_symlink("/proc/self/exe").string())}};
  values["COMMON"] = Filled(kCommon, values);
  values["ARRAYS"] = kArrays;
  WholeFolder whole(folder, "slurm", OccupiedIf(o.replace));
  whole.Write("campaign.json", JsonText(ToJson(campaign), 1) + "\n");
  for (const auto& [name, text] : {std::pair("task.sh", kTask), {"merge.sh", kMerge}, {"submit.sh", kSubmit}}) {
    whole.Write(name, Filled(text, values));
    fs::permissions(whole.Place(folder / name), fs::perms(0755));
  }
  whole.Write("logs/.keep", "");
  whole.Write("shards/.keep", "");
  TellAside(whole.Commit());
  const std::string submit = o.folder + "/submit.sh";
  SayWhatWasDone(
      o.folder, o.json, submit + "\n",
      {{"written", Json::array({o.folder})}, {"submit", submit}, {"shards", o.shards}, {"units", units}});
  return kExitDone;
}

}  // namespace

const ListedVerb kSlurmVerb("Find", 70, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("slurm", "Write a campaign as a job array and a job that merges its shards", RunSlurm);
  verb.footer =
      "Writes task.sh, merge.sh and submit.sh, which submits both, and campaign.json; options of submit.sh "
      "(--partition, --account, ...) are sbatch's, of tasks and merge. Tasks that are killed are queued "
      "again; the merge has what is missing run again, finishes all findings and writes merged.store and "
      "report/. A thousand tasks make an array. "
      "Without Slurm: seq 0 LAST | parallel FOLDER/task.sh; then FOLDER/merge.sh. How many shards there are "
      "changes "
      "nothing, unless the campaign has an objective: a shard learns from its own units. STICTION names "
      "another "
      "program.";
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
