// SPDX-License-Identifier: Apache-2.0
// stiction search, status, merge, problem: campaigns and their stores.

#include "search/search.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iostream>
#include <limits>
#include <optional>
#include <thread>

#include "cli/command_line.h"
#include "cli/night.h"
#include "cli/shared.h"
#include "cli/version.h"
#include "corpus/formats/read_problem.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/machine.h"
#include "corpus/named_rows.h"
#include "corpus/record/counts.h"
#include "corpus/record/fields.ipp"
#include "corpus/record/kinds.h"
#include "corpus/store/store_lock.h"
#include "reports/text/text_report.h"
#include "search/adversary/optimized_unit.h"
#include "search/adversary/parents.h"
#include "search/families.h"
#include "search/generators/exponential.h"
#include "search/summary.h"
#include "search/testimony.h"
#include "search/under_test/simple_scene.h"
#include "search/under_test/solver_process.h"
#include "search/under_test/solver_report.h"
#include "search/units/known_signatures.h"
#include "search/units/regenerate.h"

namespace stiction {
namespace {

constexpr double kDefaultMinutes = 1;
constexpr const char* kUsualStore = "stiction.store";
constexpr double kLook = 2;  // seconds between looks at a store that is watched

// What a field of a campaign was given as, by its kind.
struct Given {
  std::optional<std::uint64_t> seed;
  std::optional<std::int64_t> number;
  bool truth = false;
  std::string text;

  bool operator==(const Given&) const = default;
};

// Of a campaign; what is empty is the campaign's.
struct CampaignWords {
  std::array<Given, kCampaignFields.size()> fields;
  std::vector<std::string> generators, mu, policies;
  std::vector<int> contacts;
  std::string arithmetic, objective, optimizer;
  std::vector<std::string> parents;  // files

  bool operator==(const CampaignWords&) const = default;
};

struct SearchVerb {
  std::string campaign;
  std::string store;  // empty: the usual one
  CampaignWords words;
  std::optional<double> minutes;
  std::optional<std::int64_t> problems;
  std::string shard = "0/1";
  int threads = 0;
  std::optional<double> finishing;  // percent
  bool finish = false;
  std::string solver;  // file
  std::string on_finding;
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

void Set(const FieldOf<Campaign>& field, const Given& given, Campaign& campaign) {
  WithValue(field, campaign, [&given](auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::uint64_t>) value = given.seed.value_or(value);
    if constexpr (std::is_same_v<Value, std::int64_t>) value = given.number.value_or(value);
    if constexpr (std::is_same_v<Value, bool>) value |= given.truth;
    if constexpr (std::is_same_v<Value, std::string>)
      if (!given.text.empty()) value = given.text;
  });
}

// A solver that says nothing costs no more than the search would.
SolverProcess SolverOf(const SearchVerb& verb) {
  constexpr double kLeast = 5;
  const double budget = 60 * verb.minutes.value_or(kDefaultMinutes);
  return SolverProcess(
      SolverCommand(verb.solver), [&interrupted = Interruption()] { return interrupted.load(); },
      std::min(kGreetingSeconds, std::max(kLeast, budget)));
}

Campaign CampaignOf(const SearchVerb& verb) {
  Campaign campaign = verb.campaign.empty() ? Campaign{} : ReadCampaign(verb.campaign);
  const CampaignWords& o = verb.words;
  for (std::size_t i = 0; i < kCampaignFields.size(); ++i) Set(kCampaignFields[i], o.fields[i], campaign);
  if (!o.arithmetic.empty()) campaign.arithmetic = ParseSearchArithmetic(o.arithmetic);
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
      for (const Policy& policy : ParsePolicies(text)) {
        const auto& all = campaign.policies;
        if (std::find(all.begin(), all.end(), policy) != all.end()) {
          throw InputError(
              fmt::format("--policy: found {} twice, expected each policy once", PolicyName(policy)));
        }
        campaign.policies.push_back(policy);
      }
    }
  }
  if (!o.objective.empty()) {
    campaign.objective = o.objective;
    campaign.optimizer = FindObjective(o.objective)->optimizer;
  }
  if (!o.optimizer.empty()) campaign.optimizer = o.optimizer;
  if (!o.optimizer.empty() && campaign.objective.empty())
    throw InputError(
        fmt::format("--optimizer: found {} without an objective, expected --objective too", o.optimizer));
  if (!o.parents.empty() && campaign.objective.empty())
    throw InputError("--from: found parents without an objective, expected --objective too");
  for (const std::string& source : o.parents) {
    for (Candidate& parent : ParentsFrom(source, campaign)) campaign.parents.push_back(std::move(parent));
  }
  if (!verb.solver.empty()) {
    const SolverProcess solver = SolverOf(verb);
    campaign.solver = solver.about();
    campaign.no_leaks |= solver.KeepsMemory();
  }
  RequireConsistent(campaign);
  return campaign;
}

// ---- Verbs -----------------------------------------------------------------------------------

// For the end of a search, which knows the file of a solver under test, and for `status`.
std::string SummaryOf(const Store& store, const std::string& file, const std::string& solver = kAnySolverFile) {
  const std::string families = Folded(FamiliesText(store, file));
  if (!CampaignOf(store.identity(), file).objective.empty()) return OptimizedText(store, file) + families;
  return (TestsSolver(store, file) ? SolverText(store, file, solver) : SummaryText(store, file)) + families;
}

// Grave findings are an alarm.
int ExitOf(const Store& store, const std::string& file) {
  int grave = 0;
  for (const Finding& finding : store.Findings()) grave += IsGrave(finding.kind);
  if (grave == 0) return kExitDone;
  fmt::print(std::cerr,
             "stiction: {}: holds {}: methods that prove disagree, or a safe problem cycles, "
             "which ties alone can make\n",
             file, Counted(grave, "grave finding"));
  return kExitGrave;
}

// What --finish works on: the campaign of the store, and no other.
Campaign CampaignToFinish(const SearchVerb& o) {
  const Campaign campaign = CampaignOf(Store::OpenToRead(o.store).identity(), o.store);
  if (!o.campaign.empty() || o.words != CampaignWords{} || o.problems || o.finishing)
    throw InputError(
        "--finish: found options of a campaign or of its size, expected --store, --shard, --solver, "
        "--minutes, --threads, --on-finding and --json alone: the campaign is that of the store");
  return campaign;
}

SearchOptions OptionsOf(const SearchVerb& o) {
  SearchOptions options;
  options.store = o.store;
  options.build = BuildId();
  options.machine = MachineText();
  options.shard = ParseShard(o.shard);
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  options.threads = o.threads > 0 ? o.threads : std::max(1, cores);
  options.minutes = o.minutes;
  options.problems = o.problems;
  if (o.finishing) options.finishing = *o.finishing / 100;
  options.only_finish = o.finish;
  if (!o.solver.empty()) options.solver = SolverCommand(o.solver);
  if (!o.minutes && !o.problems && !o.finish) options.minutes = kDefaultMinutes;
  options.interrupted = &Interruption();
  return options;
}

// The usual store, unless it is of another search: then the first of NAME-2, NAME-3, ... that is not.
std::string StoreFor(const CampaignIdentity& identity) {
  const auto fits = [&identity](const std::string& file) {
    return !std::filesystem::exists(std::filesystem::symlink_status(file)) ||
           Store::IdentityIn(file) == identity;
  };
  std::string file = kUsualStore;
  for (int i = 2; !fits(file); ++i)
    file = fmt::format("{}-{}.store", std::filesystem::path(kUsualStore).stem().string(), i);
  if (file != kUsualStore)
    fmt::print(std::cerr, "{} holds another search ({}): this one is in {}\n", kUsualStore,
               Difference(Store::IdentityIn(kUsualStore), identity), file);
  return file;
}

// Where whole units hold more problems than were asked for.
std::string RoundedText(const Campaign& campaign, std::optional<std::int64_t> asked) {
  if (!asked) return "";
  const std::vector<Task> schedule = Schedule(campaign);
  std::int64_t problems = 0;
  const std::int64_t units = UnitsFor(campaign, *asked);
  for (std::int64_t unit = 0; unit < units; ++unit)
    problems += UnitProblems(campaign, TaskOf(schedule, unit), unit);
  if (problems == *asked) return "";
  return fmt::format(
      "; {} {} asked for, {} fill whole units; the same command with --problems above {} goes on",
      Counted(*asked, "problem"), *asked == 1 ? "was" : "were", Grouped(problems), problems);
}

// Whether the words of the command name a store and no search: then it is the search of the store.
bool IsOfStore(const SearchVerb& o) {
  return !o.store.empty() && o.campaign.empty() && o.words == CampaignWords{} &&
         std::filesystem::is_regular_file(o.store);
}

Campaign CampaignToRun(SearchVerb& o) {
  if (o.store.empty() && o.finish) o.store = kUsualStore;
  if (o.finish) return CampaignToFinish(o);
  if (IsOfStore(o)) return CampaignOf(Store::IdentityIn(o.store), o.store);
  const Campaign campaign = CampaignOf(o);
  if (o.store.empty()) {
    const bool is_older =
        std::filesystem::is_regular_file(kUsualStore) && Store::IdentityIn(kUsualStore) == IdentityOf(campaign);
    o.store = is_older ? kUsualStore : StoreFor(IdentityOf(AsBegun(campaign)));
  }
  return AsBegunIn(o.store, campaign);
}

// How the search ended, and whether there is more to do.
std::string EndText(const SearchReport& report, const SearchVerb& o) {
  const SearchProgress& progress = report.progress;
  switch (report.end) {
    case SearchEnd::kInterrupted:
      return "Interrupted; everything done so far is stored. The same command goes on from here.";
    case SearchEnd::kTimeUp:
      return fmt::format(
          "Out of time after {:.0f} s; everything done so far is stored. The same command goes on "
          "from here.",
          progress.seconds);
    case SearchEnd::kLeft:
      return fmt::format("All problems were tried. Not finished: {}. --finish finishes them.",
                         Counted(progress.pending + progress.left_out, "finding"));
    case SearchEnd::kDone:
      break;
  }
  if (o.finish)
    return progress.finished > 0 ? "Finished: no finding waits." : "Finished: there was no finding to finish.";
  const bool before = progress.problems == progress.problems_before;
  return fmt::format(
      "Finished: all problems that were asked for {} tried. --problems with a larger number goes on.",
      before ? "had been" : "were");
}

int RunSearchVerb(const SearchVerb& asked) {
  SearchVerb o = asked;
  const Campaign campaign = CampaignToRun(o);
  SearchOptions options = OptionsOf(o);
  options.started = [&](const SearchProgress& progress) {
    const std::int64_t before = progress.problems_before;
    fmt::print(std::cerr, "{} seed {}, {}, shard {}, store {}{}{}\n", TimeOfDay(), campaign.seed,
               Counted(options.threads, "thread"), o.shard, o.store,
               before > 0 ? fmt::format("; it holds {}, counted too", Counted(before, "problem")) : "",
               RoundedText(campaign, o.problems));
  };
  NightLog log(options.minutes);
  std::int64_t untold = 0;
  const SearchReport report =
      RunSearch(campaign, IdentityOf(campaign), options, [&](const SearchProgress& progress) {
        log.Show(progress);
        if (o.on_finding.empty()) return;
        for (const Finding& finding : progress.news) {
          if (*options.interrupted) {
            ++untold;
          } else {
            RunOnFinding(o.on_finding, o.store, finding);
          }
        }
      });
  log.Finish(report.progress);
  if (untold > 0)
    fmt::print(std::cerr, "{} --on-finding: interrupted before the command of {}\n", TimeOfDay(),
               Counted(untold, "finding"));
  const Store store = Store::OpenToRead(o.store);
  if (o.json) {
    std::cout << JsonText(SummaryToJson(store)) << "\n";
  } else {
    std::cout << SummaryOf(store, o.store, o.solver);
  }
  fmt::print(std::cerr, "{} {}\n", TimeOfDay(), EndText(report, o));
  return ExitOf(store, o.store);
}

struct StatusVerb {
  std::string store;
  bool watch = false;
  bool json = false;
};

// How many problems were run.
std::int64_t RunsOf(const Record& record) {
  std::int64_t runs = CountAll(record).runs;
  for (const auto& [key, tally] : record.under_test) runs += tally.problems;
  return runs;
}

// Names at most `most` of the new groups.
std::string Changes(const Record& before, const Record& now, std::int64_t most) {
  std::string names;
  std::int64_t groups = 0;
  for (const auto& [signature, count] : now.signatures) {
    if (before.signatures.contains(signature) || groups++ >= most) continue;
    const std::string known(KnownAs(signature));
    names +=
        fmt::format("{}{}{}", groups > 1 ? ", " : ": ", signature, known.empty() ? "" : " (" + known + ")");
  }
  if (groups > most) names += ", ...";
  return fmt::format(
      "{}, {} more; {}, {} new{}", Counted(RunsOf(now), "run"), Grouped(RunsOf(now) - RunsOf(before)),
      Counted(static_cast<std::int64_t>(now.signatures.size()), "group"), Grouped(groups), names);
}

// On a terminal: all of it anew, with what is new above the summary, cut to the height.
void Redraw(const std::string& news, const std::string& summary) {
  winsize size{};
  const std::size_t rows = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 2 ? size.ws_row : 24;
  const std::string text = news + "\n\n" + summary;
  std::size_t end = 0, lines = 0;
  while (end < text.size() && lines + 1 < rows) {
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
    ++lines;
  }
  fmt::print(stderr, "\033[H\033[2J{}", std::string_view(text).substr(0, end));
  std::fflush(stderr);
}

constexpr std::int64_t kMostNewOnScreen = 4;  // groups that are named: the summary is to be seen

// As long as a process works on the store: on a terminal a summary that is drawn anew, otherwise lines of what
// is new, on standard error.
void Watch(const std::string& file) {
  const std::atomic<bool>& interrupted = Interruption();
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::optional<Record> before;
  while (!interrupted && StoreLock::IsHeld(file)) {
    if (std::filesystem::exists(file)) {  // a search makes it in its first moment
      const Store store = OpenSound(file);
      const Record now = store.Total();
      const std::int64_t most = terminal ? kMostNewOnScreen : std::numeric_limits<std::int64_t>::max();
      const std::string line = fmt::format("{} {}", TimeOfDay(), Changes(before.value_or(now), now, most));
      if (terminal) {
        Redraw(Folded(line, TextWidth(STDERR_FILENO)), SummaryOf(store, file));
      } else if (!before || RunsOf(now) != RunsOf(*before)) {
        fmt::print(std::cerr, "{}\n", line);
      }
      before = now;
    }
    for (double waited = 0; waited < kLook && !interrupted && StoreLock::IsHeld(file); waited += 0.1)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (terminal && before) fmt::print(stderr, "\033[H\033[2J");
  if (!interrupted) fmt::print(std::cerr, "{} no process works on {}\n", TimeOfDay(), file);
}

int RunStatus(const StatusVerb& o) {
  if (o.watch) Watch(o.store);
  ProgressBar progress;
  const Store store = OpenSound(o.store, Reading(progress));
  progress.Clear();
  std::cout << (o.json ? JsonText(SummaryToJson(store)) + "\n" : SummaryOf(store, o.store));
  return kExitDone;
}

struct ProblemVerb {
  std::string store, output = "-";
  std::string unit;  // its number, or the signature of a finding
  std::optional<std::int64_t> index;
  std::optional<int> exponential;  // contacts
  bool scaled = false;
  bool best = false, scene = false, json = false;
};

ProblemFile ExponentialFile(int contacts, bool scaled) {
  ProblemFile file;
  file.name = fmt::format("exponential-pivots-{}-frictionless{}", contacts, scaled ? "-scaled" : "");
  file.problem = ExponentialFamily(contacts, scaled);
  file.origin = {{"family", "exponential"}, {"contacts", contacts}, {"scaled", scaled}};
  return file;
}

bool IsNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

std::int64_t UnitOf(const ProblemVerb& o) {
  constexpr std::size_t kMostDigits = 15;
  if (o.unit.size() > kMostDigits)
    throw InputError(fmt::format("problem: UNIT: found '{}', expected an integer of at most {} digits", o.unit,
                                 kMostDigits));
  return std::stoll(o.unit);
}

ProblemFile StoredFile(const ProblemVerb& o) {
  const Store store = Store::OpenToRead(o.store);
  const Campaign campaign = CampaignOf(store.identity(), o.store);
  if (o.best) {
    const std::vector<Elite> best = BestOf(store, 1);
    if (best.empty())
      throw InputError(fmt::format("{}: has no best problem: it is of no search with an objective", o.store));
    return BestFile(best.front(), campaign);
  }
  if (!campaign.objective.empty()) {
    throw InputError(fmt::format(
        "{}: found an optimized search, expected --best: its units are not drawn at random", o.store));
  }
  const std::int64_t unit = UnitOf(o);
  if (!store.Units().Contains(unit))
    throw InputError(fmt::format("{}: found unit {}, expected one that the store holds", o.store, unit));
  const std::int64_t problems = UnitProblems(campaign, TaskOf(Schedule(campaign), unit), unit);
  if (*o.index >= problems) {
    throw InputError(
        fmt::format("{}: found index {} in unit {}, expected 0 to {}", o.store, *o.index, unit, problems - 1));
  }
  return FileOf(campaign, unit, *o.index, Regenerate(campaign, unit, *o.index).problem);
}

// Of a solver under test.
ProblemFile SceneFileOf(const ProblemVerb& o) {
  const std::string source = o.store + ":" + o.unit;
  const auto named = FindNamed(source);
  const bool has_facts = named && !named->finding.facts.empty();
  const JsonPlace facts(has_facts ? named->finding.facts : "{}", source);
  const auto place = facts.Optional("scene");
  if (!place)
    throw InputError(
        source +
        ": found none, expected a scene: a finding of search --solver has one when it is finished, "
        "where its generator makes scenes and one coefficient of friction shows it");
  const Candidate scene = CandidateFromJson(*place);
  const Campaign campaign = CampaignOf(Store::OpenToRead(named->store).identity(), o.store);
  return PosedFileOf(scene, campaign.solver.law, named->finding.signature + "-scene");
}

int RunProblem(const ProblemVerb& o) {
  const bool stored = !o.store.empty();
  if (o.index && !IsNumber(o.unit))
    throw InputError(fmt::format(
        "problem: UNIT: found '{}', expected an integer; a signature in its place goes without INDEX", o.unit));
  const bool is_finding = !o.unit.empty() && !IsNumber(o.unit) && !o.index && !o.best;
  const bool complete =
      is_finding || (o.index.has_value() != o.best && (o.best ? o.unit.empty() : IsNumber(o.unit)));
  if (stored == o.exponential.has_value() || (stored ? !complete || o.scaled : o.best || o.index.has_value())) {
    throw InputError(
        "problem: expected either STORE UNIT INDEX, or STORE SIGNATURE, or STORE --best, or --exponential N "
        "and perhaps --scaled");
  }
  if (o.scene && !is_finding) throw InputError("problem: found --scene, expected it with STORE SIGNATURE");
  const ProblemFile file = o.scene      ? SceneFileOf(o)
                           : is_finding ? ReadProblem(o.store + ":" + o.unit)
                           : stored     ? StoredFile(o)
                                        : ExponentialFile(*o.exponential, o.scaled);
  WriteText(o.output, Print(file));
  const SharedJson done = {
      {"written", std::vector{o.output}}, {"contacts", file.problem.contacts().size()}, {"name", file.name}};
  if (o.json) SayWhatWasDone(o.output, o.json, "", done);
  return kExitDone;
}

struct MergeVerb {
  std::string out;
  std::vector<std::string> stores;
  bool salvage = false, json = false;
};

// That of the first store whose campaign can be read.
CampaignIdentity IdentityOfAny(const std::vector<std::string>& stores) {
  for (std::size_t i = 0; i + 1 < stores.size(); ++i) {
    try {
      return Store::IdentityIn(stores[i]);
    } catch (const InputError&) {
    }
  }
  return Store::IdentityIn(stores.back());
}

// A store that was made only now goes with a merge that failed.
class NewStore {
 public:
  explicit NewStore(const std::string& file) {
    if (IsThere(file)) return;
    for (const char* end : {"", "-wal", "-shm"})
      if (!IsThere(file + end)) files_.push_back(file + end);
  }
  NewStore(const NewStore&) = delete;
  NewStore& operator=(const NewStore&) = delete;
  ~NewStore() {
    std::error_code ignored;
    for (const std::string& file : files_) std::filesystem::remove(file, ignored);
  }
  void Keep() { files_.clear(); }

 private:
  static bool IsThere(const std::string& file) {
    return std::filesystem::exists(std::filesystem::symlink_status(file));
  }

  std::vector<std::string> files_;
};

void TakeWhatIsSound(Store& merged, const std::vector<std::string>& stores) {
  std::size_t left_out = 0, refused = 0;
  for (const std::string& file : stores) {
    try {
      const std::vector<std::string> lines = merged.Salvage(file);
      for (const std::string& line : lines) fmt::print(std::cerr, "left out: {}\n", line);
      left_out += lines.size();
    } catch (const InputError& error) {
      fmt::print(std::cerr, "left out: {}\n", error.what());
      ++refused;
    }
  }
  fmt::print(std::cerr, "left out in all: {}, {}\n", Counted(static_cast<std::int64_t>(left_out), "row"),
             Counted(static_cast<std::int64_t>(refused), "whole store"));
  if (refused == stores.size())
    throw InputError(fmt::format("merge: found {} of which none can be read, expected one",
                                 Counted(static_cast<std::int64_t>(refused), "store")));
}

int RunMerge(const MergeVerb& o) {
  ProgressBar progress;
  const auto open = [&](const std::string& file) { return OpenSound(file, Reading(progress, file)); };
  std::optional<Store> first;
  if (!o.salvage) first = open(o.stores.front());
  CampaignIdentity identity = first ? first->identity() : IdentityOfAny(o.stores);
  identity.remarks.clear();  // those of the first store that has some
  const StoreLock lock(o.out, Shard{});
  NewStore made(o.out);
  {
    Store merged(o.out, identity);
    if (first) {
      merged.MergeFrom(*first);
      for (std::size_t k = 1; k < o.stores.size(); ++k) merged.MergeFrom(open(o.stores[k]));
    } else {
      TakeWhatIsSound(merged, o.stores);
    }
    RequireSound(merged, o.out, Reading(progress, o.out));
  }
  progress.Clear();
  made.Keep();
  const Store merged = Store::OpenToRead(o.out);
  std::cout << (o.json ? JsonText(SummaryToJson(merged)) + "\n" : SummaryOf(merged, o.out));
  return ExitOf(merged, o.out);
}

// ---- Options ---------------------------------------------------------------------------------

std::string MinutesError(const std::string& text) {
  constexpr double kMost = 60 * 24 * 366 * 10;  // ten years; what a clock can count to is not much more
  double minutes = 0;
  const bool fits = ReadNumber(text, minutes) && minutes > 0 && minutes <= kMost;
  return fits ? "" : fmt::format("found '{}', expected a number of minutes, above 0 to {}", text, kMost);
}

template <class Rows>
std::string HelpOf(const Rows& rows) {
  std::string help;
  for (const auto& row : rows) help += fmt::format("\n  {}: {}", row.name, row.help);
  return help;
}

// "--audit-every" of "audit_every".
std::string OptionOf(std::string_view name) {
  std::string option = fmt::format("--{}", name);
  std::ranges::replace(option, '_', '-');
  return option;
}

// Of a field that is a number, a truth or a text.
void AddOption(Verb& verb, const FieldOf<Campaign>& field, Given& given) {
  Campaign campaign;
  const std::string name = OptionOf(field.name);
  OptionRow* row = nullptr;
  WithValue(field, campaign, [&](const auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::uint64_t>) row = &verb.Option(name, given.seed, field.help);
    if constexpr (std::is_same_v<Value, std::int64_t>)
      row = &verb.Option(name, given.number, field.help).Range(field.least, field.most);
    if constexpr (std::is_same_v<Value, bool>) row = &verb.Flag(name, given.truth, field.help);
    if constexpr (std::is_same_v<Value, std::string>)
      row = &verb.Option(name, given.text, field.help).Check([](const std::string& text) {
        return IsLine(text) ? "" : fmt::format("found {}, expected {}", Shown(Json(text)), kLineExpected);
      });
  });
  row->Details(std::string(field.details));
}

void AddCampaignOptions(Verb& verb, CampaignWords& o) {
  verb.Option("-g,--generator", o.generators, "only these generators").OneOf(NamesOf(Generators()));
  verb.Option("-c,--contacts", o.contacts, "only these numbers of contacts").Range(1, kMaxContacts);
  verb.Option("--mu", o.mu, "friction coefficients to draw from, e.g. 1/2 1 2");
  verb.Option("-p,--policy", o.policies, "policies to run, as 'stiction policies' lists them; by default paper")
      .Details("'*' is the planar grid")
      .Check([](const std::string& text) { return PolicyError(text, Grid::kAllowed); });
  verb.Option("-a,--arithmetic", o.arithmetic, "what every problem is decided with")
      .Choices({{"double", "rounded numbers; what they do not solve is decided again, filtered"},
                {"filtered", "certified signs at once, rationals where nothing less tells them"},
                {"exact", "rationals"}});
  for (std::size_t i = 0; i < kCampaignFields.size(); ++i)
    if (!kCampaignFields[i].help.empty()) AddOption(verb, kCampaignFields[i], o.fields[i]);
  verb.Option("--objective", o.objective, "optimize instead of drawing at random: one of the objectives below")
      .OneOf(NamesOf(Objectives()))
      .Details("A unit starts from the best of earlier ones");
  verb.Option("--optimizer", o.optimizer,
              "how; by default continuation for memory, scans and rounding, evolution otherwise")
      .OneOf(NamesOf(Optimizers()));
  verb.Option("--from", o.parents, "problems to start from: files, records, STORE:FINDING, a store, a folder")
      .Details(
          "A planar problem that no search drew gives a problem of psd near it. Of stores and folders what "
          "fits is taken; of integers and psd smaller problems too, side by side with others");
}

}  // namespace

const ListedVerb kSearchVerb("Find", 10, [](CommandLine& program) {
  auto [verb, o] = program.Add("search", "Search for loops of the published algorithm", RunSearchVerb);
  verb.Positional("CAMPAIGN", o.campaign, "stiction-campaign file; by default all generators and sizes");
  AddCampaignOptions(verb, o.words);
  verb.Option("-s,--store", o.store,
              "SQLite file; by default stiction.store, or stiction-2.store, ... if that is of another search")
      .Details("A search goes on where its store stopped");
  verb.Option("-m,--minutes", o.minutes, "wall clock, everything counted; by default 1 without --problems")
      .Check(MinutesError);
  verb.Option("-n,--problems", o.problems, "size of the whole campaign, rounded up to whole units").AtLeast(1);
  verb.Option("--shard", o.shard, "i/N: only the units u with u mod N = i; with --finish, only their findings");
  verb.Option("-t,--threads", o.threads, "by default one per core").Range(1, 1024);
  verb.Option("--finishing", o.finishing, "most processor time for finishing findings")
      .Unit("%")
      .Range(0, 100)
      .Details(
          "By default 20, with an objective 5; 0 finishes none, 100 leaves none unfinished. Of a kind and "
          "number of contacts at most 100 are finished. After the last unit of --problems half a minute of "
          "each thread is used in any case; what waits then is left to --finish");
  verb.Flag("--finish", o.finish, "run no problems: finish all findings of the store, however many");
  verb.Option("--solver", o.solver,
              "test this solver in place of the published algorithm: NAME.so, or a program")
      .Details(
          "It is given the problems in a process of its own, and its forces are judged by the conditions of "
          "its law: search/under_test/README.md. With --finish, the solver that the store tests");
  verb.Option("--on-finding", o.on_finding, "shell command to run for each new group and each grave finding")
      .Details(
          "The finding is on its standard input as JSON, and in STICTION_SIGNATURE, STICTION_KIND, "
          "STICTION_GRAVE, STICTION_KNOWN, STICTION_CONTACTS, STICTION_UNIT, STICTION_INDEX and "
          "STICTION_STORE. One that fails, or takes a minute, is reported");
  verb.Prints(o.json, "what a store holds", "summary | optimized | tested");
  verb.footer = "Generators:";
  for (const GeneratorRow& row : Generators())
    verb.footer += fmt::format("\n  {}: {}", row.name, row.distribution);
  verb.footer += "\nObjectives:" + HelpOf(Objectives()) + "\nOptimizers:" + HelpOf(Optimizers());
});

const ListedVerb kStatusVerb("Find", 20, [](CommandLine& program) {
  auto [verb, o] = program.Add("status", "What a store holds, of a running or a stopped search", RunStatus);
  verb.Positional("STORE", o.store, "store of a search").Required();
  verb.Flag("--watch", o.watch, "say what is new every two seconds while a process works on it")
      .Details("A terminal is drawn anew, with the summary; a log has a line where something is new");
  verb.Prints(o.json, "what a store holds", "summary | optimized | tested");
});

const ListedVerb kMergeVerb("Find", 60, [](CommandLine& program) {
  auto [verb, o] = program.Add("merge", "Join the stores of one campaign", RunMerge);
  verb.Positional("OUT", o.out, "store to write or to add to").Required();
  verb.Positional("STORE", o.stores, "stores to take in").Required();
  verb.Flag("--salvage", o.salvage, "take what is sound of damaged stores, and say what is left out");
  verb.Prints(o.json, "what a store holds", "summary | optimized | tested");
});

const ListedVerb kProblemVerb("Find", 40, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("problem", "Write any problem that a search tried as a problem file", RunProblem);
  verb.footer =
      "With its scene where it has one. Or the worst case without friction, on which the published algorithm "
      "takes 2^n - 1 pivots.";
  verb.Positional("STORE", o.store, "store of a search");
  verb.Positional("UNIT", o.unit, "number of the unit; or the signature of a finding, without INDEX");
  verb.Positional("INDEX", o.index, "number of the problem in its unit, from 0").AtLeast(0);
  verb.Flag("--best", o.best, "instead of a number: the best of a search with an objective");
  verb.Flag("--scene", o.scene, "of a finding of search --solver: the simplest scene that shows it");
  verb.Option("--exponential", o.exponential, "instead: the worst case, of so many contacts").Range(1, 200);
  verb.Prints(o.json, "a problem of a store, or of a family",
              "{written: written, contacts: integer, name: text}");
  verb.Flag("--scaled", o.scaled, "of it the form that is so for scan=most-violated too");
  verb.Option("-o,--output", o.output, "file to write; - is standard output");
});

}  // namespace stiction
