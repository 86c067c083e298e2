// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/campaign_tables.h"

#include <fmt/format.h>

#include <numeric>

#include "corpus/intervals.h"
#include "corpus/store/finding_words.h"
#include "reports/tables/since.h"

namespace stiction {
namespace {

using Outcomes = Tally::Outcomes;

constexpr int kSolvedOutcome = static_cast<int>(Outcome::kSolved);
constexpr const char* kShareParts = "count,of,share,low,high";

std::string NameOf(int outcome) { return std::string(kOutcomeNames[static_cast<std::size_t>(outcome)]); }

void AddAll(std::vector<TableCell>& cells, const Outcomes& counts) {
  cells.insert(cells.end(), counts.begin(), counts.end());
}
void AddAll(std::vector<TableCell>& cells, const Statistics& statistics) {
  ForEachField(statistics, [&](const char*, const char*, std::int64_t value) { cells.emplace_back(value); });
}

// Groups, and at last that of all runs.
std::vector<Group> GroupsAndAll(const Record& record, const By& by) {
  std::vector<Group> groups = GroupsBy(record, by);
  groups.push_back(GroupsBy(record, {}).front());
  groups.back().key.assign(by.size(), "");
  groups.back().key.front() = "all";
  return groups;
}

// With runs alone.
std::vector<Group> RunsBy(const Record& record, const By& by) {
  std::vector<Group> groups = GroupsBy(record, by);
  std::erase_if(groups, [](const Group& group) { return group.counts.runs == 0; });
  return groups;
}

}  // namespace

Table CountedByContacts(const std::string& name, const Record& record) {
  Table table = Described(name);
  for (const auto& [contacts, existence] : record.existence) {
    const auto found = record.agreement.find(contacts);
    table.AddCounted({contacts},
                     NumbersOf(existence, found == record.agreement.end() ? AgreementTally{} : found->second));
  }
  table.AddCounted({"all"}, NumbersOf(SumOf(record.existence), SumOf(record.agreement)));
  table.TotalIsLast();
  return table;
}

Table MethodsTable(const Record& record, const std::vector<Discovery>& discoveries) {
  static constexpr const char* kFinished = "finished findings";
  struct Asked {
    const char *method, *about;
    std::map<int, Ratio> solved = {};  // by contacts

    void Add(int contacts, std::int64_t asked, std::int64_t good) {
      solved[contacts].count += good;
      solved[contacts].of += asked;
    }
  };
  Asked doubles{"published, in doubles", "every run"}, exact{"published, exact", "runs repeated on suspicion"},
      complete{"complete driving", "problems given to it"}, lemke{"Lemke’s method", "problems compared"},
      again{"published, exact", kFinished}, ipopt{"Ipopt", kFinished},
      certified{"certified to have a solution", kFinished};
  for (const Group& g : GroupsBy(record, {"contacts"})) {
    doubles.Add(g.Number(0), g.tally.problems, g.tally.outcomes[kSolvedOutcome] - g.tally.wrong);
    exact.Add(g.Number(0), g.counts.suspicious, g.counts.Of(Outcome::kSolved));
  }
  for (const auto& [contacts, tally] : record.existence) complete.Add(contacts, tally.problems, tally.solved);
  for (const auto& [contacts, tally] : record.agreement)
    lemke.Add(contacts, tally.compared, tally.compared - tally.disagreements);
  for (const Discovery& discovery : discoveries) {
    if (!discovery.Finished() || !discovery.ipopt || discovery.ipopt->outcome == "unavailable") continue;
    const Finding& finding = *discovery.representative;
    again.Add(finding.contacts, 1, finding.exact_outcome == Name(Outcome::kSolved));
    ipopt.Add(finding.contacts, 1, discovery.ipopt->outcome == "solved");
    certified.Add(finding.contacts, 1, finding.existence.find("solution-exists") != std::string::npos);
  }
  Table table = Described("methods");
  for (const Asked* row : {&doubles, &exact, &complete, &lemke, &again, &ipopt, &certified}) {
    for (const auto& [contacts, solved] : row->solved) {
      if (solved.of > 0) table.Add({row->method, row->about, contacts, solved.of, solved});
    }
  }
  return table;
}

Table FindingsTable(const std::vector<Discovery>& discoveries) {
  Table table{"findings", "",
              Columns("signature* kind* count unit index generator* contacts policy* inexact_outcome* "
                      "exact_outcome* state* loop_drives loop_steps start period steps whole_grid* "
                      "every_policy_loops* found_grid_@ minimized_contacts minimized_start minimized_period "
                      "minimized_steps minimized_grid_@ problem_file* original_file* certificate_file* "
                      "existence_file* original_existence_file* safe* minimized_safe* words words_exact* "
                      "proof* minimized_proof*")};
  for (const Discovery& d : discoveries) {
    std::vector<TableCell> cells = {d.signature, d.kind, d.met};
    // The cells are empty where there is nothing to tell.
    const auto add = [&cells](bool told, std::size_t count, auto more) {
      const std::size_t end = cells.size() + count;
      if (told) more();
      cells.resize(end);
    };
    const auto put = [&cells](std::initializer_list<TableCell> more) { cells.insert(cells.end(), more); };
    const Finding* const f = d.representative;
    add(f != nullptr, 7, [&] {
      put({f->unit, f->index, f->generator, f->contacts, f->policy, f->inexact_outcome, f->exact_outcome});
    });
    put({StateOf(d)});
    add(d.loop.has_value(), 2, [&] { put({d.loop->drives, d.loop->steps}); });
    add(d.found.has_value(), 3, [&] { put({d.found->start, d.found->period, d.found->steps}); });
    add(d.SawPolicies(), 2 + kOutcomeCount, [&] {
      put({d.WholeGrid(), d.EveryPolicyLoops()});
      AddAll(cells, d.found->grid.counts);
    });
    add(d.minimized.has_value(), 4, [&] {
      put({d.minimized->contacts, d.minimized->start, d.minimized->period, d.minimized->steps});
    });
    add(d.minimized && d.minimized->grid.Total() > 0, kOutcomeCount,
        [&] { AddAll(cells, d.minimized->grid.counts); });
    const FindingFiles& files = d.files;
    put({files.problem, files.original, files.certificate, files.existence, files.original_existence});
    add(d.found.has_value(), 1, [&] { put({d.found->safe}); });  // where it was decided
    add(d.minimized.has_value(), 1, [&] { put({d.minimized->safe}); });
    add(d.words.has_value(), 2, [&] { put({d.Words(), d.words->IsExact()}); });
    const bool proves = f != nullptr && d.IsLoop();
    const auto proof = [&](FindingForm form) { return std::string(Name(ProvedRunOf(*f, form).kind)); };
    add(proves && d.found, 1, [&] { put({proof(FindingForm::kFound)}); });
    add(proves && d.minimized, 1, [&] { put({proof(FindingForm::kMinimized)}); });
    table.Add(std::move(cells));
  }
  return table;
}

Table WorkTable(const Work& work) {
  Table table{"work", "", Columns("what* meaning* value*")};
  for (const std::string& machine : work.machines) table.Add({"machine", "", machine});
  ForEachPart(work.time, [&table](const char* name, const char* meaning, std::int64_t value) {
    table.Add({name, meaning, fmt::format("{:.6f}", static_cast<double>(value) * 1e-6)});
  });
  return table;
}

namespace {

// All counters, sums and maxima of every tally.
Table StatisticsTable(const Record& record) {
  return CountedBy("statistics", kByAll, GroupsBy(record, kByAll));
}

// Outcomes of doubles and of exact runs apart, by friction and rank.
Table StrataTable(const Record& record) {
  Table table = Keyed("strata", "", kByAll,
                      Columns("friction* rank problems steps zero_steps audited misjudged @ exact_@"));
  for (const Group& g : GroupsBy(record, kByAll)) {
    for (const auto& [key, s] : g.tally.strata) {
      std::vector<TableCell> cells = {key.friction, key.rank,  s.problems, s.steps,
                                      s.zero_steps, s.audited, s.misjudged};
      AddAll(cells, s.outcomes);
      AddAll(cells, s.exact);
      table.Add(Behind(g, cells));
    }
  }
  return table;
}

// A row per finding that Ipopt was asked about. Apart, since its answers depend on the machine's libraries.
Table IpoptTable(const std::vector<Discovery>& discoveries) {
  Table table{"ipopt", "", Columns("signature* kind* outcome* starts")};
  for (const Discovery& d : discoveries) {
    if (d.ipopt) table.Add({d.signature, d.kind, d.ipopt->outcome, d.ipopt->starts});
  }
  return table;
}

// Runs repeated exactly on suspicion: by what doubles said and what is exact, as far as it occurred.
Table VerdictsTable(const Record& record, const std::string& name, const By& by, const std::string& columns) {
  Table table = Keyed(name, "", by, Columns(columns));
  for (const Group& g : GroupsBy(record, by)) {
    for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
      for (int exact = 0; exact < kOutcomeCount; ++exact) {
        const std::int64_t runs = g.tally.verdicts[inexact][exact];
        if (runs > 0) table.Add(Behind(g, {NameOf(inexact), NameOf(exact), runs}));
      }
    }
  }
  return table;
}

// Runs by their steps; the last bin, which holds all above, too, is marked.
Table StepsTable(const Record& record, const std::string& name, const By& by, const std::string& runs) {
  Table table = Keyed(name, "", by, Columns("steps or_more* " + runs));
  for (const Group& g : GroupsBy(record, by)) {
    for (int steps = 0; steps < Tally::kBins; ++steps) {
      if (g.tally.steps[steps] == 0) continue;
      table.Add(Behind(g, {steps, steps == Tally::kBins - 1, g.tally.steps[steps]}));
    }
  }
  return table;
}

// Loops by how many zero steps their period has.
Table ZeroStepsTable(const Record& record, const std::string& name) {
  Table table{name, "", Columns("contacts zero_steps loops")};
  for (const auto& [contacts, tally] : record.loops) {
    for (const auto& [zero_steps, loops] : tally.by_zero_steps) table.Add({contacts, zero_steps, loops});
  }
  return table;
}

// Failures confirmed exactly, by contacts, friction (mu) and rank.
Table RatesFigure(const Record& record) {
  Table table{"rates", "",
              Columns("by* generator* policy* contacts value* outcome* runs count,,rate,low,high")};
  for (const char* by : {"contacts", "friction", "rank"}) {
    for (const Group& g : RunsBy(record, {"generator", "policy", "contacts", by})) {
      const Counts& c = g.counts;
      const std::string value = std::visit([](const auto& part) { return fmt::format("{}", part); }, g.key[3]);
      for (const auto& [outcome, count] : {std::pair("loop", c.Loops()),
                                           {"singular", c.Of(Outcome::kSingular)},
                                           {"ray", c.Of(Outcome::kRay)}}) {
        table.Add({by, g.Text(0), g.Text(1), g.Number(2), value, outcome, c.runs, RateOf(count, c.runs)});
      }
    }
  }
  return table;
}

// Loops confirmed exactly of all generators together, by contacts and friction.
Table OftenFigure(const Record& record) {
  const By by = {"policy", "contacts", "friction"};
  return CountedBy("often", by, RunsBy(record, by));
}

// Steps of a run, at most so many in half of the runs, in 99 of 100, in all; and shares of runs.
Table CostFigure(const Record& record) {
  return CountedBy("cost", {"policy", "contacts"}, RunsBy(record, {"policy", "contacts"}));
}

// Audited runs that were misjudged, and solutions that are none, by generator.
Table TrustFigure(const Record& record) {
  Table table = CountedBy("trusted", {"generator"}, GroupsBy(record, {"generator"}));
  table.name = "trust";
  return Melted(table, kShareParts);
}

// Runs with a step of length zero, and with something given up.
Table PivotingFigure(const Record& record) {
  const By by = {"generator", "policy", "contacts"};
  return Melted(CountedBy("pivoting", by, GroupsBy(record, by)), kShareParts);
}

// Paths of complete driving with folds, with descents, with ties.
Table DrivingFigure(const Record& record) {
  Table table = CountedByContacts("paths", record);
  table.name = "driving";
  return Melted(table, kShareParts);
}

// Loops of exact arithmetic by the number of contacts in their period.
Table LoopsTable(const Record& record) {
  Table table = Described("loops");
  for (const auto& [contacts, tally] : record.loops) table.AddCounted({contacts}, NumbersOf(tally));
  return table;
}

// Problems by number of mode words that have solutions (`counted` = words), regular ones by number of
// solutions.
Table SolutionsTable(const Record& record) {
  Table table{"solutions", "", Columns("contacts counted* count problems"), {}, {}, 3};
  for (const auto& [contacts, tally] : record.agreement) {
    for (const auto& [counted, histogram] :
         {std::pair("words", &tally.words), {"solutions", &tally.solutions}}) {
      for (const auto& [count, problems] : *histogram) table.Add({contacts, counted, count, problems});
    }
  }
  return table;
}

// How the runs in doubles ended.
Table OutcomesTable(const Record& record) {
  std::vector<Group> groups = GroupsAndAll(record, kByAll);
  for (Group& g : groups) {
    const TallyKey usual;
    // Method and arithmetic are named only where they are not the published algorithm in doubles.
    if (g.Text(2) != "" && (g.Text(3) != usual.method || g.Text(4) != usual.arithmetic))
      g.key[2] = fmt::format("{} ({}, {})", g.Text(2), g.Text(3), g.Text(4));
    g.key.resize(3);
  }
  Table table = CountedBy("outcomes", {"generator", "contacts", "policy"}, groups);
  table.TotalIsLast();
  return table;
}

// Rates of the runs that doubles do not solve: generators down, contacts across.
Table UnsolvedTable(const Record& record) {
  const By by = {"generator", "contacts"};
  const Table described = Described("unsolved");
  Table table = Keyed("unsolved", described.caption, by, described.columns);
  for (const Group& g : GroupsBy(record, by)) {
    Numbers numbers = NumbersOf(g);
    numbers["unsolved"] = numbers["problems"] - numbers["solved"];
    const TableCell rate = CellOf("unsolved/problems^", numbers);
    table.Add(Behind(g, {{RateText(numbers["unsolved"], numbers["problems"]), "",
                          numbers["unsolved"] == 0 ? "zero" : rate.style}}));
  }
  table = Pivoted(table, "contacts", "unsolved", {"", "", "zero"});
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    table.columns[i].head = Counted(std::stoi(table.columns[i].name), "contact");
  return table;
}

// Suspicious runs of doubles and their exact outcomes.
Table SuspicionsTable(const Record& record) {
  Table table = Described("suspicions");
  const Tally all = GroupsBy(record, {}).front().tally;
  for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
    const Outcomes& exact = all.verdicts[inexact];
    const std::int64_t runs = std::accumulate(exact.begin(), exact.end(), std::int64_t{0});
    if (runs == 0) continue;
    // A solution that is wrong is never confirmed by another one that is right.
    const int same = inexact == kSolvedOutcome ? -1 : inexact;
    std::vector<TableCell> cells = {same < 0 ? "solved, but wrong" : NameOf(inexact), runs};
    for (int i = 0; i < kOutcomeCount; ++i)
      cells.emplace_back(exact[i], "", i == same && exact[i] > 0 ? "same" : "");
    cells.push_back(same < 0 ? TableCell("–") : ShareOf(exact[same], runs));
    table.Add(std::move(cells));
  }
  return table;
}

// Suspicions, audits and wrong answers by generator.
Table TrustTable(const Record& record) {
  Table table = CountedBy("trust", {"generator"}, GroupsAndAll(record, {"generator"}));
  table.TotalIsLast();
  return table;
}

// Counters of a run: mean and maximum.
Table PivotsTable(const Record& record) {
  std::vector<Column> columns = {{"runs"}};
  const Statistics names;
  ForEachField(names, [&](const char* name, const char* help, std::int64_t) {
    columns.push_back({name, help});
  });
  Table table =
      Keyed("pivots", "Work per problem: mean, and maximum below", {"generator", "contacts"}, columns);
  for (const Group& g : GroupsAndAll(record, {"generator", "contacts"})) {
    std::vector<TableCell> cells = {g.counts.runs}, maxima;
    AddAll(maxima, g.tally.maxima);
    ForEachField(g.tally.sums, [&](const char*, const char*, std::int64_t sum) {
      const std::string maximum = Shown(maxima[cells.size() - 1]);
      cells.emplace_back(MeanOf(sum, g.counts.runs), maximum, maximum == "0" ? "zero" : "");
    });
    table.Add(Behind(g, cells));
  }
  table.TotalIsLast();
  return table;
}

const By kByRun = {"generator", "contacts", "policy"};

// Loops by what is known of a stratum, which stands across.
Table StrataLoops(const Record& record, const std::string& across, const char* caption) {
  By by = kByRun;
  by.push_back(across);
  Table table = Pivoted(CountedBy("failures", by, GroupsBy(record, by)), across, "loops", "–");
  table.caption = caption;
  return table;
}

// Contacts down, counts across.
std::vector<Table> Histogram(const Record& record, const std::string& counted, const char* caption) {
  const auto parts = SplitBy(SolutionsTable(record), "counted");
  const auto found = parts.find(counted);
  if (found == parts.end()) return {};
  Table table = Pivoted(found->second, "count", "problems", 0);
  table.caption = caption;
  return {table};
}

}  // namespace

std::vector<Table> CampaignTables(const Record& record, const std::vector<Discovery>& discoveries) {
  return {StatisticsTable(record),
          VerdictsTable(record, "verdicts", kByAll, "inexact_outcome* exact_outcome* count"),
          StrataTable(record),
          StepsTable(record, "steps", kByAll, "problems"),
          LoopsTable(record),
          ZeroStepsTable(record, "zero_steps"),
          CountedByContacts("agreement", record),
          SolutionsTable(record),
          FindingsTable(discoveries),
          IpoptTable(discoveries)};
}

std::vector<Table> CampaignFigures(const Record& record, const std::vector<Discovery>& discoveries) {
  return {OftenFigure(record),
          CostFigure(record),
          RatesFigure(record),
          VerdictsTable(record, "doubles", {"policy"}, "in_doubles* exact* runs"),
          TrustFigure(record),
          StepsTable(record, "steps", {"policy", "contacts"}, "runs"),
          ZeroStepsTable(record, "loop-steps"),
          PivotingFigure(record),
          DrivingFigure(record),
          MethodsTable(record, discoveries)};
}

std::map<std::string, TablesMaker> ShownTables(const Record& record) {
  std::map<std::string, TablesMaker> tables;
  const auto add = [&](const std::string& name, auto make) {
    tables[name] = [&record, make] { return std::vector<Table>{make(record)}; };
  };
  add("failures_by_run", [](const Record& r) { return CountedBy("failures", kByRun, GroupsBy(r, kByRun)); });
  add("failures_by_generator", [](const Record& r) {
    Table table = CountedBy("failures", {"generator"}, GroupsBy(r, {"generator"}));
    table.caption = "Failures confirmed exactly, by generator";
    return table;
  });
  add("loops_by_friction",
      [](const Record& r) { return StrataLoops(r, "friction", "Loops by friction coefficient"); });
  add("loops_by_rank", [](const Record& r) { return StrataLoops(r, "rank", "Loops by rank"); });
  add("unsolved", UnsolvedTable);
  add("outcomes", OutcomesTable);
  add("suspicions", SuspicionsTable);
  add("trust", TrustTable);
  add("pivots", PivotsTable);
  add("loops", LoopsTable);
  add("driving", [](const Record& r) { return CountedByContacts("driving", r); });
  add("agreement", [](const Record& r) { return CountedByContacts("compared-methods", r); });
  tables["solutions"] = [&record] {
    return Histogram(record, "solutions", "Regular problems by number of solutions");
  };
  tables["words"] = [&record] {
    return Histogram(record, "words", "Problems by number of mode words with solutions");
  };
  return tables;
}

}  // namespace stiction
