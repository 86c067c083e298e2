// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/solvers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "reports/comparison/comparison.h"
#include "reports/comparison/solvers_txt.h"
#include "reports/report_files.h"

namespace stiction {
namespace {

// The first is "all"; then by generator and number of contacts.
using CountsByFamily = std::map<std::pair<std::string, int>, Numbers>;

constexpr const char* kAllProblems = "all";

std::vector<std::string> KindColumns() {
  std::vector<std::string> names;
  ForEachCounter(UnderTestTally{}, [&names](std::string_view name, std::int64_t) {
    std::string kind(name);
    std::ranges::replace(kind, '_', '-');
    if (IsOfSolver(kind)) names.emplace_back(name);
  });
  return names;
}

CountsByFamily CountsOf(const Record& record) {
  CountsByFamily families;
  for (const auto& [key, tally] : record.under_test) {
    for (const auto& family : {std::pair(std::string(), 0), std::pair(key.generator, key.contacts)})
      ForEachCounter(
          tally, [&counts = families[family]](const char* name, std::int64_t value) { counts[name] += value; });
  }
  ForEachCounter(UnderTestTally{}, [&counts = families[{"", 0}]](const char* name, std::int64_t) {
    counts.try_emplace(name, 0);  // of an empty store
  });
  return families;
}

Json SolverOf(const CampaignIdentity& identity) {
  const Json definition = JsonOrText(identity.definition);
  return definition.is_object() ? definition.value("solver", Json()) : Json();
}

// Names of the solvers; with the file where two have one name.
std::vector<std::string> NamesOfSolvers(const std::vector<Store>& stores,
                                        const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const Store& store : stores) {
    const Json solver = SolverOf(store.identity());
    names.push_back(
        fmt::format("{} {}", solver["name"].get<std::string>(), solver["version"].get<std::string>()));
  }
  std::vector<std::string> shown = names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::ranges::count(names, names[i]) > 1) shown[i] += fmt::format(" ({})", files[i]);
  return shown;
}

// Of each search what it has otherwise than the first.
std::vector<std::string> DifferencesOfSearches(const std::vector<Store>& stores,
                                               const std::vector<std::string>& files) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < stores.size(); ++i) {
    for (const auto& [part, of_first, of_this] : DifferencesOf(stores[0].identity(), stores[i].identity())) {
      if (!part.starts_with("solver "))
        lines.push_back(fmt::format("{}: {} in {}, {} in {}", part, of_first.empty() ? "none" : of_first,
                                    files[0], of_this.empty() ? "none" : of_this, files[i]));
    }
  }
  if (lines.empty()) lines.emplace_back("none: all were given the same problems, as far as each search went");
  return lines;
}

Table SolversTable(const std::vector<Store>& stores, const std::vector<std::string>& files,
                   const std::vector<std::string>& names, const std::vector<CountsByFamily>& counts) {
  Table table = Described("solvers");
  for (std::size_t i = 0; i < stores.size(); ++i) {
    const Json solver = SolverOf(stores[i].identity());
    table.AddCounted(
        {names[i], files[i], solver["law"].get<std::string>(), solver["accuracy"].get<std::string>()},
        counts[i].at({"", 0}));
  }
  return table;
}

Table FailuresTable(const std::vector<std::string>& names, const std::vector<CountsByFamily>& counts) {
  Table table{"failures", "Failures, in a million problems", Columns("family* solver* problems"), {}, {}, 2};
  table.columns.back().from = "problems";
  for (const std::string& kind : KindColumns()) {
    std::string head = kind;
    std::ranges::replace(head, '_', '-');
    table.columns.push_back({fmt::format("{0},,{0}_rate,{0}_low,{0}_high", kind),
                             "in a million, with the exact interval at 95 %", false, head, kind + "/problems"});
  }
  CountsByFamily all;
  for (const CountsByFamily& of : counts) all.insert(of.begin(), of.end());
  for (const auto& [family, unused] : all) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto found = counts[i].find(family);
      if (found == counts[i].end()) continue;
      const std::string name =
          family.first.empty() ? kAllProblems : fmt::format("{}, {}", family.first, family.second);
      table.AddCounted({name, names[i]}, found->second);
    }
  }
  return table;
}

// "A = 2 -1, -1 1; b = 0 -1; mu = 1/2"; of more than six rows their number.
std::string ProblemInWords(const ExactProblem& problem) {
  constexpr int kMostRowsShown = 6;
  if (problem.rows() > kMostRowsShown) return fmt::format("{} rows", problem.rows());
  std::string A, b, mu;
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j) A += (j > 0 ? " " : i > 0 ? ", " : "") + ToString(problem.A(i, j));
    b += (i > 0 ? " " : "") + ToString(problem.b[i]);
  }
  for (const auto& contact : problem.contacts)
    if (contact.HasFrictionRows()) mu += (mu.empty() ? "; mu = " : " ") + ToString(contact.mu);
  return fmt::format("A = {}; b = {}{}", A, b, mu);
}

Table SmallestTable(const std::vector<Store>& stores, const std::vector<std::string>& names) {
  Table table{"smallest", "The smallest problem of each kind of failure",
              Columns("kind* solver* finding* times contacts minimized* problem*")};
  table.keys = 2;
  std::map<std::tuple<std::string, std::size_t>, std::tuple<bool, std::size_t, Finding>> least;
  for (std::size_t i = 0; i < stores.size(); ++i) {
    for (const Finding& finding : stores[i].Findings()) {
      const bool raw = finding.minimized.empty();
      const std::size_t size = (raw ? finding.problem : finding.minimized).size();
      const auto [at, is_new] = least.try_emplace({finding.kind, i}, raw, size, finding);
      if (!is_new && std::pair(raw, size) < std::pair(std::get<0>(at->second), std::get<1>(at->second)))
        at->second = {raw, size, finding};
    }
  }
  for (const auto& [key, value] : least) {
    const auto& [raw, size, finding] = value;
    const std::size_t i = std::get<1>(key);
    const ExactProblem problem =
        ParseProblem(raw ? finding.problem : finding.minimized, finding.signature).problem;
    const auto signatures = stores[i].Total().signatures;
    const auto counted = signatures.find(finding.signature);  // not yet, of a unit that is not whole
    const std::int64_t count = counted == signatures.end() ? 1 : counted->second;
    table.Add({finding.kind, names[i], finding.signature, count, problem.contacts.size(), !raw,
               ProblemInWords(problem)});
  }
  return table;
}

}  // namespace

SolversCompared CompareSolvers(const std::vector<Store>& stores, const std::vector<std::string>& files) {
  std::vector<CountsByFamily> counts;
  for (const Store& store : stores) counts.push_back(CountsOf(store.Total()));
  const std::vector<std::string> names = NamesOfSolvers(stores, files);
  return {files, DifferencesOfSearches(stores, files), SolversTable(stores, files, names, counts),
          FailuresTable(names, counts), SmallestTable(stores, names)};
}

Told Tell(const SolversCompared& c) {
  Facts facts{{{"failed", std::ssize(c.smallest.rows)}}};
  for (const std::string& file : c.files) facts.texts["files"] += " " + ShellWord(file);
  for (const std::string& line : c.differences) facts.lists["differences"].emplace_back(line, "");
  for (const Table* table : {&c.solvers, &c.failures, &c.smallest})
    facts.tables[table->name] = [table] { return std::vector<Table>{*table}; };
  return Tell(kSolversTxt, facts, {"text", "page"});
}

SharedJson SolversToJson(const SolversCompared& c) {
  return {{"differences", c.differences},
          {"solvers", ToJson(c.solvers)},
          {"failures", ToJson(c.failures)},
          {"smallest", ToJson(c.smallest)}};
}

std::filesystem::path WriteSolvers(const SolversCompared& compared, const std::filesystem::path& directory,
                                   Occupied occupied) {
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const FixedTextWidth of_the_file(kUsualTextWidth);
  const Told told = Tell(compared);
  folder.Write("solvers.txt", ToText(told, "text"));
  folder.Write("index.html", ComparisonPage("stiction: solvers side by side",
                                            "Which solver fails, how, and how often?", told));
  for (const Table* table : {&compared.solvers, &compared.failures, &compared.smallest})
    folder.Write(table->name + ".csv", ToCsv(*table));
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
