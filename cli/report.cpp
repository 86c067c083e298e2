// SPDX-License-Identifier: Apache-2.0
// stiction report: what a store holds, as a page, as text, as a data package; and how two stores compare.

#include "reports/report.h"

#include <fmt/format.h>

#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certify/claims/checker_files.h"
#include "cli/command_line.h"
#include "cli/night.h"
#include "cli/playable.h"
#include "cli/records.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "reports/comparison/comparison.h"
#include "reports/comparison/solvers.h"
#include "reports/papers/package.h"
#include "reports/text/text_report.h"
#include "search/campaign.h"
#include "search/summary.h"
#include "search/testimony.h"
#include "search/under_test/solver_report.h"
#include "search/units/known_signatures.h"

namespace stiction {
namespace {

struct ReportVerb {
  std::string store, folder, package;
  std::vector<std::string> others, benches;
  std::string since;
  std::optional<std::int64_t> files;
  bool replace = false, text = false, all = false, latex = false, json = false;
};

// How far what is made of a store is written.
ShowWriting Writing(ProgressBar& bar) {
  return [&bar](std::int64_t findings, std::int64_t of, std::int64_t files) {
    bar.ShowSome(findings, of, [&] {
      return fmt::format("{} of {} written, {}", Grouped(findings), Counted(of, "finding"),
                         Counted(files, "file"));
    });
  };
}

int PrintReport(const ReportVerb& o, const Store& store) {
  const bool optimized = !CampaignOf(store.identity(), o.store).objective.empty();
  if (o.json)
    std::cout << JsonText(SummaryToJson(store)) << "\n";
  else if (optimized)
    std::cout << OptimizedText(store, o.store);
  else
    std::cout << (TestsSolver(store, o.store)
                      ? SolverText(store, o.store)
                      : TextReport(store, o.store, KnownAs, o.all ? Extent::kAll : Extent::kTwoScreens));
  return kExitDone;
}

// A store of problems that were drawn at random.
Store OpenDrawn(const std::string& file) {
  ProgressBar progress;
  Store store = OpenSound(file, Reading(progress));
  if (!CampaignOf(store.identity(), file).objective.empty())
    throw InputError(
        fmt::format("{}: found an optimized search, expected one at random: others have no rates", file));
  if (TestsSolver(store, file))
    throw InputError(
        fmt::format("{}: found a search that tests a solver, expected one of the published algorithm", file));
  return store;
}

// A difference that is more than noise is a disagreement of the two.
int CompareCampaigns(const ReportVerb& o) {
  const std::string& other = o.others.front();
  const Comparison comparison = Compare(OpenDrawn(o.store), o.store, OpenDrawn(other), other);
  if (!o.folder.empty())
    TellAside(WriteComparison(comparison, o.store, other, o.folder, OccupiedIf(o.replace)));
  std::cout << (o.json ? JsonText(ComparisonToJson(comparison)) + "\n"
                       : ComparisonText(comparison, o.store, other));
  return comparison.MoreThanNoise() ? kExitNotSo : kExitDone;
}

// Any number of them.
int CompareTested(const ReportVerb& o, const std::vector<std::string>& files) {
  std::vector<Store> stores;
  for (const std::string& file : files) {
    ProgressBar progress;
    stores.push_back(OpenSound(file, Reading(progress, file)));
    if (!TestsSolver(stores.back(), file))
      throw InputError(
          fmt::format("{}: found a search of the published algorithm, expected one that tests a solver, "
                      "as {} does",
                      file, o.store));
    if (!CampaignOf(stores.back().identity(), file).objective.empty())
      throw InputError(
          fmt::format("{}: found an optimized search, expected one at random: others have no rates", file));
  }
  const SolversCompared compared = CompareSolvers(stores, files);
  if (!o.folder.empty()) TellAside(WriteSolvers(compared, o.folder, OccupiedIf(o.replace)));
  std::cout << (o.json ? JsonText(SolversToJson(compared)) + "\n" : ToText(Tell(compared), "text"));
  return kExitDone;
}

int CompareStores(const ReportVerb& o) {
  if (!o.package.empty() || !o.benches.empty() || !o.since.empty() || o.latex || o.files || o.text)
    throw InputError(
        "report: found two stores, expected one with --package, --bench, --since, --files, --latex or --text");
  std::vector<std::string> files = o.others;
  files.insert(files.begin(), o.store);
  if (TestsSolver(Store::OpenToRead(o.store), o.store)) return CompareTested(o, files);
  if (files.size() == 2) return CompareCampaigns(o);
  throw InputError(fmt::format("report: found {}, expected two; more only of searches that test solvers",
                               Counted(static_cast<std::int64_t>(files.size()), "store")));
}

// Of fields of a campaign, by their names.
std::map<std::string, std::string> CampaignLabels() {
  std::map<std::string, std::string> labels;
  for (const FieldOf<Campaign>& field : kCampaignFields)
    if (!field.label.empty()) labels.emplace(field.name, field.label);
  return labels;
}

// What is made of one store.
int ReportStore(const ReportVerb& o) {
  ProgressBar progress;
  const Store store = OpenSound(o.store, Reading(progress));
  if (TestsSolver(store, o.store) && !(o.folder.empty() && o.package.empty()))
    throw InputError(fmt::format(
        "{}: found a search that tests a solver, expected --text or --json: it has no pages", o.store));
  std::string text;
  std::vector<std::string> written;
  if (!o.folder.empty()) {
    const auto aside = WriteReport(store, o.folder, OccupiedIf(o.replace),
                                   {{o.benches.begin(), o.benches.end()},
                                    o.since,
                                    o.latex,
                                    o.files.value_or(ReportExtras().files),
                                    KnownFrontiers(),
                                    OwnSearchOf(store),
                                    CampaignLabels(),
                                    Writing(progress),
                                    PlayFinding});
    progress.Clear();
    TellAside(aside);
    text += o.folder + "/index.html\n";
    written.push_back(o.folder);
  }
  if (!o.package.empty()) {
    const auto aside = WritePackage(store, o.package, CheckerFiles(), OccupiedIf(o.replace), Writing(progress));
    progress.Clear();
    TellAside(aside);
    text += fmt::format("{0}: verify it with: python3 {0}/verify.py\n", o.package);
    written.push_back(o.package);
  }
  progress.Clear();
  if (o.text) return PrintReport(o, store);
  SayWhatWasDone("", o.json, text, {{"written", written}});
  return kExitDone;
}

// What only the folder of a report has.
void RequireFolder(const ReportVerb& o) {
  const std::pair<bool, const char*> rows[] = {{o.latex, "--latex"},
                                               {!o.since.empty(), "--since"},
                                               {!o.benches.empty(), "--bench"},
                                               {o.files.has_value(), "--files"}};
  for (const auto& [given, name] : rows) {
    if (given) throw InputError(fmt::format("report: found {} alone, expected -o, a folder to write", name));
  }
}

// A report of benchmarks alone.
int ReportBenches(const ReportVerb& o) {
  if (o.benches.empty()) throw InputError("report: found no STORE, expected the store of a search, or --bench");
  if (o.folder.empty()) throw InputError("report: found --bench without -o, expected a folder to write");
  if (!o.package.empty() || !o.since.empty() || o.latex || o.files || o.text)
    throw InputError(
        "report: found no STORE, expected one with --package, --since, --files, --latex or --text");
  ReportExtras extras;
  extras.benches = {o.benches.begin(), o.benches.end()};
  extras.frontiers = KnownFrontiers();
  TellAside(WriteMeasured(o.folder, OccupiedIf(o.replace), extras));
  SayWhatWasDone("", o.json, o.folder + "/index.html\n", {{"written", std::vector{o.folder}}});
  return kExitDone;
}

int RunReport(const ReportVerb& o) {
  if (o.all && !o.text) throw InputError("report: found --all without --text, expected --text --all");
  if (o.store.empty()) return ReportBenches(o);
  if (!o.others.empty()) return CompareStores(o);
  if (o.folder.empty() && o.package.empty() && !o.text)
    throw InputError("report: found none of -o, --package and --text, expected a folder to write, or --text");
  if (o.folder.empty()) RequireFolder(o);
  return ReportStore(o);
}

}  // namespace

const ListedVerb kReportVerb("Show", 50, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("report", "Write a store as an HTML page, CSV files and problem files", RunReport);
  verb.Positional("STORE", o.store, "store of a search; none with --bench alone");
  verb.Positional("STORE2", o.others, "store of another campaign: the two are compared instead")
      .Details(
          "Exit 1 if a difference is more than noise. Of searches that test solvers any number of stores: "
          "their "
          "failures side by side");
  verb.Option("-o,--output", o.folder, "folder to write; what a report before wrote is replaced");
  verb.Flag("--text", o.text, "print what it holds as text; no folder is needed then");
  verb.Flag("--all", o.all, "with --text: by contacts, friction and every policy, not on two screens");
  verb.Option("--package", o.package, "data package to write: a folder that Python alone verifies");
  verb.Flag("--latex", o.latex, "tables and figures for papers besides, in latex/; with -o");
  verb.Option("--bench", o.benches,
              "files of bench --suite trade or extremes, --csv, to draw; alone or besides");
  verb.Option("--since", o.since, "folder of an earlier report: the page says what is new since");
  verb.Option("--files", o.files,
              "findings that have files of their own; tables and page have all; by default all")
      .AtLeast(0);
  verb.Prints(o.json,
              "what a report wrote; with more stores, how they compare; with --text, what the store holds",
              R"({written: written} | {
      differences: [text],  // of the two campaigns by design
      tests: integer, only_a: [group], only_b: [group],
      rates: [{...group, friction: text, measure: text, a: share, b: share, p: number | null,
               p_corrected: number | null, more_than_noise: truth}]} | {
      differences: [text],  // of searches that test solvers
      solvers: {columns: [text], rows: [[any]]}, failures: {columns: [text], rows: [[any]]},
      smallest: {columns: [text], rows: [[any]]}} | summary | optimized | tested)")
      .help = "machine output: what was written, with more stores the comparison, with --text the summary";
  AddReplace(verb, o.replace);
});

}  // namespace stiction
