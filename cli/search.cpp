// SPDX-License-Identifier: Apache-2.0
// stiction search, status, merge, problem, report: campaigns and their stores.

#include "search/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iostream>
#include <thread>

#include "cli/shared.h"
#include "cli/verbs.h"
#include "cli/version.h"
#include "corpus/grouped.h"
#include "corpus/json_text.h"
#include "corpus/kinds.h"
#include "corpus/store_lock.h"
#include "reports/report.h"
#include "search/adversary/optimized_unit.h"
#include "search/exponential.h"
#include "search/summary.h"
#include "search/unit.h"

namespace stiction {
namespace {

constexpr double kDefaultMinutes = 1;
constexpr double kLogSeconds = 10;  // between progress lines where standard error is no terminal

struct SearchVerb {
  std::string campaign;
  std::string store = "stiction.store";
  std::vector<std::string> generators, mu, policies;
  std::vector<int> contacts;
  std::optional<std::uint64_t> seed;
  std::optional<double> minutes;
  std::optional<std::int64_t> problems, audit_every, enumerate_every;
  std::string arithmetic;  // empty: the campaign's
  std::string shard = "0/1";
  int threads = 0;
  std::string objective, optimizer;
  std::vector<std::string> parents;  // files
  bool gravity_only = false;
  bool json = false;
};

// All of the text as a number.
template <class Number>
bool ReadNumber(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

Shard ParseShard(const std::string& text) {
  Shard shard;
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  if (ReadNumber(std::string_view(text).substr(0, slash), shard.index) &&
      ReadNumber(std::string_view(text).substr(slash + 1), shard.count) && shard.index >= 0 &&
      shard.index < shard.count) {
    return shard;
  }
  throw InputError(fmt::format("--shard: found '{}', expected i/N with 0 <= i < N", text));
}

Campaign CampaignOf(const SearchVerb& o) {
  Campaign campaign = o.campaign.empty() ? Campaign{} : ReadCampaign(o.campaign);
  if (o.seed) campaign.seed = *o.seed;
  if (o.audit_every) campaign.audit_every = *o.audit_every;
  if (!o.arithmetic.empty()) campaign.arithmetic = ParseSearchArithmetic(o.arithmetic);
  if (o.enumerate_every) campaign.enumerate_every = *o.enumerate_every;
  if (!o.contacts.empty()) campaign.contacts = o.contacts;
  if (!o.generators.empty()) {
    campaign.generators.clear();
    for (const std::string& name : o.generators) campaign.generators.push_back(*FindGenerator(name));
  }
  if (!o.mu.empty()) {
    campaign.palette.clear();
    for (const std::string& text : o.mu) campaign.palette.push_back(ParseMu(text));
  }
  if (!o.policies.empty()) {
    campaign.policies.clear();
    for (const std::string& text : o.policies) {
      for (const Policy& policy : PoliciesNamed(text)) {
        const auto& all = campaign.policies;
        if (std::find(all.begin(), all.end(), policy) != all.end()) {
          throw InputError(
              fmt::format("--policy: found {} twice, expected each policy once", PolicyName(policy)));
        }
        campaign.policies.push_back(policy);
      }
    }
  }
  campaign.gravity_only |= o.gravity_only;
  if (!o.objective.empty()) campaign.objective = o.objective;
  if (!o.optimizer.empty()) campaign.optimizer = o.optimizer;
  if (!o.optimizer.empty() && campaign.objective.empty())
    throw InputError(
        fmt::format("--optimizer: found {} without an objective, expected --objective too", o.optimizer));
  for (const std::string& file : o.parents)
    campaign.parents.push_back(CandidateOf(ReadProblem(file), file));
  RequireConsistent(campaign);
  return campaign;
}

// ---- Progress on standard error --------------------------------------------------------------

class ProgressLine {
 public:
  explicit ProgressLine(std::optional<double> minutes) : minutes_(minutes) {}

  void Show(const SearchProgress& progress) {
    if (bar_.IsShown()) {
      bar_.Show(Fraction(progress), Line(progress));
    } else if (progress.seconds - last_ >= kLogSeconds) {
      last_ = progress.seconds;
      fmt::print(stderr, "{}\n", Line(progress));
      std::fflush(stderr);
    }
  }
  void Finish() const { bar_.Clear(); }

 private:
  double Fraction(const SearchProgress& progress) const {
    double fraction = 0;
    if (minutes_) fraction = progress.seconds / (*minutes_ * 60);
    if (progress.units_wanted && *progress.units_wanted > 0) {
      fraction = std::max(
          fraction, static_cast<double>(progress.units_done) / static_cast<double>(*progress.units_wanted));
    }
    return std::min(fraction, 1.0);
  }
  std::string Line(const SearchProgress& progress) const {
    const double fraction = Fraction(progress);
    const double left = fraction > 0 ? progress.seconds * (1 - fraction) / fraction : 0;
    return fmt::format("{} problems, {} a second, {} findings in {} groups, {} to finish, {:.0f} s left",
                       Grouped(progress.problems),
                       Grouped(static_cast<std::int64_t>(static_cast<double>(progress.problems) /
                                                         std::max(progress.seconds, 1e-9))),
                       Grouped(progress.findings), Grouped(progress.groups), progress.pending, left);
  }

  std::optional<double> minutes_;
  ProgressBar bar_;
  double last_ = 0;
};

// ---- Verbs -----------------------------------------------------------------------------------

// Grave findings are an alarm.
int ExitOf(const Store& store, const std::string& file) {
  int grave = 0;
  for (const Finding& finding : store.Findings()) grave += IsGrave(finding.kind);
  if (grave == 0) return kExitDone;
  fmt::print(stderr,
             "stiction: {}: holds {} grave findings: methods that prove disagree, or a safe problem cycles\n",
             file, grave);
  return kExitGrave;
}

int RunSearchVerb(const SearchVerb& o) {
  const Campaign campaign = CampaignOf(o);
  SearchOptions options;
  options.store = o.store;
  options.shard = ParseShard(o.shard);
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  options.threads = o.threads > 0 ? o.threads : std::max(1, cores);
  options.minutes = o.minutes;
  options.problems = o.problems;
  if (!o.minutes && !o.problems) options.minutes = kDefaultMinutes;
  options.interrupted = &Interruption();
  fmt::print(stderr, "seed {}, {} threads, shard {}, store {}\n", campaign.seed, options.threads, o.shard,
             o.store);
  ProgressLine line(options.minutes);
  const SearchReport report = RunSearch(campaign, IdentityOf(campaign, BuildId()), options,
                                        [&line](const SearchProgress& progress) { line.Show(progress); });
  line.Finish();
  const Store store = Store::OpenToRead(o.store);
  if (o.json) {
    std::cout << JsonText(SummaryToJson(store)) << "\n";
  } else {
    std::cout << SummaryText(store, o.store);
  }
  if (report.end == SearchEnd::kInterrupted) {
    fmt::print(stderr, "Interrupted; everything done so far is stored. The same command goes on from here.\n");
  }
  return ExitOf(store, o.store);
}

struct StatusVerb {
  std::string store;
  bool json = false;
};

int RunStatus(const StatusVerb& o) {
  const Store store = Store::OpenToRead(o.store);
  std::cout << (o.json ? JsonText(SummaryToJson(store)) + "\n" : SummaryText(store, o.store));
  return kExitDone;
}

struct ProblemVerb {
  std::string store, output = "-";
  std::optional<std::int64_t> unit, index;
  std::optional<int> exponential;  // contacts
  bool scaled = false;
  bool best = false;
};

ProblemFile ExponentialFile(int contacts, bool scaled) {
  ProblemFile file;
  file.name = fmt::format("exponential-pivots-{}-frictionless{}", contacts, scaled ? "-scaled" : "");
  file.problem = ExponentialFamily(contacts, scaled);
  file.origin = {{"family", "exponential"}, {"contacts", contacts}, {"scaled", scaled}};
  return file;
}

ProblemFile StoredFile(const ProblemVerb& o) {
  const Store store = Store::OpenToRead(o.store);
  const Campaign campaign = CampaignOf(store.identity(), o.store);
  if (o.best) {
    const std::vector<Elite> best = BestOf(store, 1);
    if (best.empty())
      throw InputError(fmt::format("{}: has no best problem: it is of no search with an objective", o.store));
    ProblemFile file = FileOf(best.front().candidate, "best-" + campaign.objective);
    (*file.origin)["objective"] = campaign.objective;
    return file;
  }
  if (!campaign.objective.empty()) {
    throw InputError(fmt::format(
        "{}: found an optimized search, expected --best: its units are not drawn at random", o.store));
  }
  if (!store.Units().Contains(*o.unit))
    throw InputError(fmt::format("{}: found unit {}, expected one that the store holds", o.store, *o.unit));
  const std::int64_t problems = UnitProblems(campaign, TaskOf(Schedule(campaign), *o.unit));
  if (*o.index >= problems) {
    throw InputError(fmt::format("{}: found index {} in unit {}, expected 0 to {}", o.store, *o.index, *o.unit,
                                 problems - 1));
  }
  return RegenerateFile(campaign, *o.unit, *o.index);
}

int RunProblem(const ProblemVerb& o) {
  const bool stored = !o.store.empty();
  const bool complete = o.index.has_value() != o.best && (!o.best || !o.unit.has_value());
  if (stored == o.exponential.has_value() || (stored ? !complete || o.scaled : o.best || o.index.has_value())) {
    throw InputError(
        "problem: expected either STORE UNIT INDEX, or STORE --best, or --exponential N and perhaps --scaled");
  }
  WriteText(o.output, Print(stored ? StoredFile(o) : ExponentialFile(*o.exponential, o.scaled)));
  return kExitDone;
}

struct MergeVerb {
  std::string out;
  std::vector<std::string> stores;
};

int RunMerge(const MergeVerb& o) {
  const Store first = Store::OpenToRead(o.stores.front());
  const StoreLock lock(o.out, Shard{});
  Store merged(o.out, first.identity());
  for (const std::string& file : o.stores) merged.MergeFrom(Store::OpenToRead(file));
  std::cout << SummaryText(merged, o.out);
  return ExitOf(merged, o.out);
}

struct ReportVerb {
  std::string store, folder;
  std::vector<std::string> benches;
  bool replace = false;
};

int RunReport(const ReportVerb& o) {
  TellAside(WriteReport(Store::OpenToRead(o.store), o.folder, OccupiedIf(o.replace),
                        {o.benches.begin(), o.benches.end()}));
  fmt::print("{}/index.html\n", o.folder);
  return kExitDone;
}

// ---- Options ---------------------------------------------------------------------------------

std::string MinutesError(const std::string& text) {
  constexpr double kMost = 60 * 24 * 366 * 10;  // ten years; what a clock can count to is not much more
  double minutes = 0;
  const bool fits = ReadNumber(text, minutes) && minutes > 0 && minutes <= kMost;
  return fits ? "" : fmt::format("found '{}', expected a number of minutes, above 0 to {}", text, kMost);
}

template <class Rows>
std::vector<std::string> NamesOf(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

template <class Rows>
std::string HelpOf(const Rows& rows) {
  std::string help;
  for (const auto& row : rows) help += fmt::format("\n  {}: {}", row.name, row.help);
  return help;
}

void AddCampaignOptions(Verb& verb, SearchVerb& o) {
  std::vector<std::string> names;
  for (const GeneratorRow& row : Generators()) names.emplace_back(row.name);
  verb.Positional("CAMPAIGN", o.campaign, "stiction-campaign file; by default all generators and sizes");
  verb.Option("--generator", o.generators, "only these generators").OneOf(names);
  verb.Option("--contacts", o.contacts, "only these numbers of contacts").Range(1, kMaxContacts);
  verb.Option("--mu", o.mu, "friction coefficients to draw from, e.g. 1/2 1 2");
  verb.Option("--policy", o.policies, "readings to run, as 'stiction policies' lists them; by default paper")
      .Details("'*' is the planar grid")
      .Check([](const std::string& text) { return PolicyError(text, Grid::kAllowed); });
  verb.Option("--arithmetic", o.arithmetic, "what every problem is decided with")
      .Choices({{"double", "rounded numbers; what they do not solve is decided again, filtered"},
                {"filtered", "certified signs at once, rationals where nothing less tells them"},
                {"exact", "rationals"}});
  verb.Option("--audit-every", o.audit_every, "run one problem in so many exactly though nothing is suspected")
      .AtLeast(1)
      .Details("Existence included; 1 audits all");
  verb.Option("--enumerate-every", o.enumerate_every, "try all contact modes of one problem in so many")
      .AtLeast(1)
      .Details("Of those of at most three contacts that are run exactly");
  verb.Flag("--gravity-only", o.gravity_only, "bodies without applied forces: of generators of bodies");
  verb.Option("--objective", o.objective, "optimize instead of drawing at random: one of the objectives below")
      .OneOf(NamesOf(Objectives()))
      .Details("A unit starts from the best of earlier ones");
  verb.Option("--optimizer", o.optimizer, "how; by default evolution").OneOf(NamesOf(Optimizers()));
  verb.Option("--from", o.parents, "problems to start from, as `problem STORE --best` writes them");
  verb.Option("--seed", o.seed, "the one source of randomness; by default 1");
}

}  // namespace

void AddSearch(CommandLine& program) {
  auto [verb, o] = program.Add("search", "Search for loops of the published algorithm", RunSearchVerb);
  AddCampaignOptions(verb, o);
  verb.Option("--store", o.store, "SQLite file; a search goes on where its store stopped");
  verb.Option("--minutes", o.minutes, "wall clock, everything counted; by default 1 without --problems")
      .Check(MinutesError);
  verb.Option("--problems", o.problems, "size of the whole campaign, rounded up to whole units").AtLeast(1);
  verb.Option("--shard", o.shard, "i/N: only the units u with u mod N = i");
  verb.Option("--threads", o.threads, "by default one per core").Range(1, 1024);
  verb.Flag("--json", o.json, "machine output");
  verb.footer = "Generators:";
  for (const GeneratorRow& row : Generators())
    verb.footer += fmt::format("\n  {}: {}", row.name, row.distribution);
  verb.footer += "\nObjectives:" + HelpOf(Objectives()) + "\nOptimizers:" + HelpOf(Optimizers());
}

void AddStatus(CommandLine& program) {
  auto [verb, o] = program.Add("status", "What a store holds, of a running or a stopped search", RunStatus);
  verb.Positional("STORE", o.store, "store of a search").Required();
  verb.Flag("--json", o.json, "machine output");
}

void AddMerge(CommandLine& program) {
  auto [verb, o] = program.Add("merge", "Join the stores of one campaign", RunMerge);
  verb.Positional("OUT", o.out, "store to write or to add to").Required();
  verb.Positional("STORE", o.stores, "stores to take in").Required();
}

void AddProblem(CommandLine& program) {
  auto [verb, o] =
      program.Add("problem", "Write any problem that a search tried as a problem file", RunProblem);
  verb.footer =
      "With its scene where it has one. Or the worst case without friction, on which the published algorithm "
      "takes 2^n - 1 pivots.";
  verb.Positional("STORE", o.store, "store of a search");
  verb.Positional("UNIT", o.unit, "number of the unit").AtLeast(0);
  verb.Positional("INDEX", o.index, "number of the problem in its unit, from 0").AtLeast(0);
  verb.Flag("--best", o.best, "instead of a number: the best of a search with an objective");
  verb.Option("--exponential", o.exponential, "instead: the worst case, of so many contacts").Range(1, 200);
  verb.Flag("--scaled", o.scaled, "of it the form that is so for scan=most-violated too");
  verb.Option("-o,--output", o.output, "file to write; - is standard output");
}

void AddReport(CommandLine& program) {
  auto [verb, o] =
      program.Add("report", "Write a store as an HTML page, CSV files and problem files", RunReport);
  verb.Positional("STORE", o.store, "store of a search").Required();
  verb.Option("-o,--output", o.folder, "folder to write; what a report before wrote is replaced").Required();
  verb.Option("--bench", o.benches, "files of bench --suite trade or extremes, --csv, to draw besides");
  AddReplace(verb, o.replace);
}

}  // namespace stiction
