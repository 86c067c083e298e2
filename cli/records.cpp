// SPDX-License-Identifier: Apache-2.0
// stiction records: the worst problems that are known.

#include "cli/records.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <iostream>

#include "cli/command_line.h"
#include "cli/shared.h"
#include "cli/version.h"
#include "corpus/grouped.h"
#include "corpus/json_text.h"
#include "corpus/named_rows.h"
#include "search/adversary/record.h"
#include "search/campaign.h"
#include "search/summary.h"

namespace stiction {
namespace {

struct RecordsVerb {
  std::string folder;  // empty: RecordsFolder()
  std::string add, frontier, what, objective, command;
  std::string random, random_command;
  std::optional<double> seconds;
  std::int64_t random_evaluations = 0;
  bool check = false, json = false;
  Limits limits;
};

std::string Shown(const Rational& value) {
  return value.get_den() <= 100000 && value.get_num() <= 100000 ? ToString(value)
                                                                : fmt::format("{:.6g}", ToDouble(value));
}

std::string FolderOf(const RecordsVerb& o) { return o.folder.empty() ? RecordsFolder().string() : o.folder; }

int Add(const RecordsVerb& o) {
  if (o.frontier.empty() || o.what.empty() || o.objective.empty() || o.command.empty() || !o.seconds ||
      o.random_command.empty())
    throw InputError(
        "records: --add asks for --frontier, --what, --objective, --command, --seconds and --random-command");
  const ProblemFile added = ReadProblem(o.add);
  FrontierRecord record = MakeRecord(*FindObjective(o.objective), added, o.limits);
  record.frontier = o.frontier;
  record.what = o.what;
  record.command = o.command;
  const std::string build = BuildId();
  record.build = build.substr(0, build.find(", -"));  // flags apart
  record.processor_seconds = *o.seconds;
  if (!o.random.empty()) {
    record.random_value = ParseRational(o.random);
    if (!record.random_value)
      throw InputError(fmt::format("--random: found '{}', expected a number p/q", o.random));
  }
  record.random_evaluations = o.random_evaluations;
  record.random_command = o.random_command;
  const std::string file = FolderOf(o) + "/" + o.frontier + ".json";
  WriteText(file, Print(record));
  fmt::print(std::cout, "{}: {}\n", file, Shown(record.value));
  return kExitDone;
}

int RunRecords(const RecordsVerb& o) {
  if (!o.add.empty()) return Add(o);
  int faults = 0;
  std::vector<SharedJson> rows;
  for (const FrontierRecord& record : ReadRecords(FolderOf(o))) {
    const std::string fault = o.check ? FaultOf(record, o.limits) : "";
    faults += !fault.empty();
    SharedJson row = HeadOf(record);
    row.Add({{"processor_seconds", record.processor_seconds},
             {"random", record.random_value ? SharedJson(ToString(*record.random_value)) : SharedJson()},
             {"random_evaluations", record.random_evaluations},
             {"random_command", record.random_command}});
    if (o.check) row.Add({{"fault", fault.empty() ? SharedJson() : SharedJson(fault)}});
    rows.push_back(std::move(row));
    if (o.json) continue;
    Tell("{}: {}, {}, {}; random: {} of {}{}\n    {}\n", record.frontier, Shown(record.value),
         record.objective->sign > 0 ? "to be high" : "to be low", record.status,
         record.random_value ? Shown(*record.random_value) : "nothing", Grouped(record.random_evaluations),
         !o.check        ? ""
         : fault.empty() ? "; holds"
                         : "; DOES NOT HOLD: " + fault,
         record.what);
  }
  if (o.json) std::cout << JsonText(SharedJson(rows)) << "\n";
  return faults == 0 ? kExitDone : kExitNotSo;
}

}  // namespace

std::filesystem::path RecordsFolder() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const char* place : {"../../corpus/records", "../share/stiction/corpus/records"}) {
    std::error_code error;
    auto folder = (program / place).lexically_normal();
    if (std::filesystem::is_directory(folder, error)) return folder;
  }
  return "corpus/records";
}

std::vector<FrontierLine> KnownFrontiers() {
  std::vector<FrontierLine> lines;
  if (!std::filesystem::is_directory(RecordsFolder())) return lines;
  for (const FrontierRecord& record : ReadRecords(RecordsFolder())) {
    lines.push_back({record.frontier, record.what, std::string(record.objective->name),
                     record.objective->sign > 0, ToString(record.value), record.status, record.command,
                     record.random_value ? ToString(*record.random_value) : "", record.random_evaluations,
                     record.random_command});
  }
  return lines;
}

OwnSearch OwnSearchOf(const Store& store) {
  const Campaign campaign = CampaignOf(store.identity(), "report");
  OwnSearch own;
  if (campaign.objective.empty()) return own;
  for (const BestLine& best : BestLines(store))
    own.bests.push_back({campaign.objective, best.generator, best.mu, best.value, best.contacts});
  const std::vector<Task> schedule = Schedule(campaign);
  for (std::int64_t unit = 0; unit < store.Units().Count(); ++unit)
    own.problems += UnitProblems(campaign, TaskOf(schedule, unit), unit);
  return own;
}

const ListedVerb kRecordsVerb("Find", 50, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("records", "The worst problems that are known, and what random ones reach", RunRecords);
  verb.Option("--folder", o.folder, "of records; by default those of the repository or of the package");
  verb.Flag("--check", o.check, "compute every value anew, and check every certificate");
  verb.Option("--add", o.add, "instead: make a record of this problem file");
  verb.Option("--frontier", o.frontier, "its name, and that of its file");
  verb.Option("--what", o.what, "what the record is one of, in words");
  verb.Option("--objective", o.objective, "what is counted").OneOf(NamesOf(Objectives()));
  verb.Option("--command", o.command, "what found it");
  verb.Option("--seconds", o.seconds, "processor time of that");
  verb.Option("--random", o.random, "the best of random problems at equal cost; without it nothing was found");
  verb.Option("--random-evaluations", o.random_evaluations, "how many of them").AtLeast(0);
  verb.Option("--random-command", o.random_command, "what drew them");
  verb.Prints(o.json, "the worst problems that are known", R"([{
      frontier: text, what: text, objective: text, value: exact, status: text, command: text,
      processor_seconds: number,
      random: text | null,  // what random problems reached; null: nothing
      random_evaluations: integer, random_command: text,
      fault?: text | null  // of --check: what is wrong; null: nothing
    }])");
  AddLimits(verb, o.limits);
});

}  // namespace stiction
