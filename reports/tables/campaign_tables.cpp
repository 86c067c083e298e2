// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/campaign_tables.h"

#include <fmt/format.h>

#include <map>
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

// The colour of so many in a million: one class per factor of ten.
std::string Heat(std::int64_t count, std::int64_t of) {
  if (count == 0 || of == 0) return "";
  const double rate = 1e6 * static_cast<double>(count) / static_cast<double>(of);
  int level = 1;
  for (double limit = 10; level < 5 && rate >= limit; limit *= 10) ++level;
  return fmt::format("h{}", level);
}

// Without a rate where there are none.
TableCell RateIfAny(std::int64_t count, std::int64_t of, bool heat = true) {
  if (count == 0) return 0;
  return {RateOf(count, of), "", heat ? Heat(count, of) : ""};
}

// What must be zero.
TableCell Exception(std::int64_t count) { return {count, "", count == 0 ? "" : "h5"}; }

}  // namespace

// ---- Data alone ----

Table StatisticsTable(const Record& record) {
  Table table = Keyed("statistics", "", kByAll,
                      Columns("problems @ audited misjudged wrong with_zero_steps with_give_ups sum_# max_#"));
  for (const Group& g : GroupsBy(record, kByAll)) {
    const Tally& t = g.tally;
    std::vector<TableCell> cells = {t.problems};
    AddAll(cells, t.outcomes);
    cells.insert(cells.end(), {t.audited, t.misjudged, t.wrong, t.with_zero_steps, t.with_give_ups});
    AddAll(cells, t.sums);
    AddAll(cells, t.maxima);
    table.Add(Behind(g, cells));
  }
  return table;
}

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

Table WorkTable(const Work& work) {
  Table table{"work", "", Columns("what* meaning* value*")};
  for (const std::string& machine : work.machines) table.Add({"machine", "", machine});
  ForEachPart(work.time, [&table](const char* name, const char* meaning, std::int64_t value) {
    table.Add({name, meaning, fmt::format("{:.6f}", static_cast<double>(value) * 1e-6)});
  });
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

Table IpoptTable(const std::vector<Discovery>& discoveries) {
  Table table{"ipopt", "", Columns("signature* kind* outcome* starts")};
  for (const Discovery& d : discoveries) {
    if (d.ipopt) table.Add({d.signature, d.kind, d.ipopt->outcome, d.ipopt->starts});
  }
  return table;
}

// ---- Data and figures ----

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

Table ZeroStepsTable(const Record& record, const std::string& name) {
  Table table{name, "", Columns("contacts zero_steps loops")};
  for (const auto& [contacts, tally] : record.loops) {
    for (const auto& [zero_steps, loops] : tally.by_zero_steps) table.Add({contacts, zero_steps, loops});
  }
  return table;
}

Table RatesFigure(const Record& record) {
  Table table{"rates", "",
              Columns("by* generator* policy* contacts value* outcome* runs count,,rate,low,high")};
  for (const char* by : {"contacts", "friction", "rank"}) {
    for (const Group& g : GroupsBy(record, {"generator", "policy", "contacts", by})) {
      const Counts& c = g.counts;
      const std::string value = std::visit([](const auto& part) { return fmt::format("{}", part); }, g.key[3]);
      for (const auto& [outcome, count] : {std::pair("loop", c.Loops()),
                                           {"singular", c.Of(Outcome::kSingular)},
                                           {"ray", c.Of(Outcome::kRay)}}) {
        if (c.runs > 0)
          table.Add({by, g.Text(0), g.Text(1), g.Number(2), value, outcome, c.runs, RateOf(count, c.runs)});
      }
    }
  }
  return table;
}

Table OftenFigure(const Record& record) {
  Table table = Keyed("often", "", {"policy", "contacts", "friction"}, Columns("runs loops,,rate,low,high"));
  for (const Group& g : GroupsBy(record, {"policy", "contacts", "friction"})) {
    if (g.counts.runs > 0) table.Add(Behind(g, {g.counts.runs, RateOf(g.counts.Loops(), g.counts.runs)}));
  }
  return table;
}

Table CostFigure(const Record& record) {
  Table table = Keyed("cost", "", {"policy", "contacts"},
                      Columns("runs median of_99_percent most zero_steps,,zero_share,zero_low,zero_high "
                              "give_ups,,give_up_share,give_up_low,give_up_high"));
  for (const Group& g : GroupsBy(record, {"policy", "contacts"})) {
    const Counts& c = g.counts;
    if (c.runs == 0) continue;
    const auto within = [&g](double share) {
      std::int64_t below = 0;
      int steps = 0;
      const auto wanted = share * static_cast<double>(g.tally.problems);
      while (steps < Tally::kBins - 1 && static_cast<double>(below += g.tally.steps[steps]) < wanted) ++steps;
      return steps;
    };
    table.Add(Behind(g, {c.runs, within(0.5), within(0.99), g.tally.maxima.steps,
                         ShareOf(c.with_zero_steps, c.runs), ShareOf(c.with_give_ups, c.runs)}));
  }
  return table;
}

Table TrustFigure(const Record& record) {
  Table table = Keyed("trust", "", {"generator"}, {{"audited runs, misjudged"}, {"runs with a wrong answer"}});
  for (const Group& g : GroupsBy(record, {"generator"})) {
    const Counts& c = g.counts;
    table.Add(Behind(g, {ShareOf(c.misjudged, c.audited), ShareOf(c.wrong, c.runs)}));
  }
  return Melted(table, kShareParts);
}

Table PivotingFigure(const Record& record) {
  Table table = Select(ContactsTable(record, {"generator", "policy", "contacts"}),
                       "generator policy contacts with_zero_steps=a_step_of_length_zero "
                       "with_give_ups=a_variable_given_up",
                       "");
  table.name = "pivoting";
  return Melted(table, kShareParts);
}

Table DrivingFigure(const Record& record) {
  Table table =
      Select(AgreementTable(record), "contacts with_folds=folds with_descents=descents with_ties=ties", "");
  table.name = "driving";
  return Melted(table, kShareParts);
}

// ---- Data and people ----

Table LoopsTable(const Record& record) {
  Table table{"loops",
              "Loops in exact arithmetic, by number of contacts in the period",
              {{"contacts"},
               {"loops"},
               {"drives", "of a period: mean"},
               {"steps", "of a period: mean"},
               {"zero_steps", "of a period: mean"},
               {"without_zero_steps", "loops without a step of length zero in the period; below: their share"},
               {"of_zero_steps_alone", "loops whose period has no other steps; below: their share"}}};
  for (const auto& [contacts, t] : record.loops) {
    table.Add({contacts, t.loops, MeanOf(t.drives, t.loops), MeanOf(t.steps, t.loops),
               MeanOf(t.zero_steps, t.loops), ShareOf(t.without_zero_steps, t.loops),
               ShareOf(t.of_zero_steps_alone, t.loops)});
  }
  return table;
}

Table AgreementTable(const Record& record) {
  Table table{
      "agreement",
      "",
      {{"contacts"},
       {"problems", "that the published algorithm did not solve, audited, or drawn"},
       {"solved", "complete driving returned a solution that stood exact verification"},
       {"", "", false, "not solved"},
       {"pieces", "of the path, mean"},
       {"with_folds", "the path turns back: where the published algorithm gives up"},
       {"with_descents", "a driven force returns to zero"},
       {"with_ties", "decided by symbolic perturbation"},
       {"compared", "published algorithm, complete driving and Lemke's method"},
       {"enumerated", "of these, with every word of contact modes decided by exact linear programs", false,
        "all modes tried"},
       {"disagreements",
        "a wrong solution, a method that ends otherwise than it must, a solution that another misses"},
       {"continua", "a word of modes with more than one solution; below: of those with all modes tried"},
       {"regular", "every solution stands inside one word, alone; below: of those with all modes tried"},
       {"signs_not_one",
        "regular, and the signs of the reduced determinants do not sum to 1; A singular, or a disagreement"},
       {"safety_decided", "audited problems of at most three contacts"},
       {"safe", "all reduced determinants are positive"},
       {"safe_gave_up", "safe, and something was given up under apex=suspended", false, "gave up"},
       {"safe_gave_up_no_ties", "of these, without any tie: a disagreement", false, "without ties"}}};
  const auto add = [&table](const TableCell& contacts, const ExistenceTally& e, const AgreementTally& a) {
    table.Add({contacts, e.problems, e.solved, Exception(e.problems - e.solved), MeanOf(e.pieces, e.problems),
               ShareOf(e.with_folds, e.problems), ShareOf(e.with_descents, e.problems),
               ShareOf(e.with_ties, e.problems), a.compared, a.enumerated, Exception(a.disagreements),
               ShareOf(a.continua, a.enumerated), ShareOf(a.regular, a.enumerated), Exception(a.signs_not_one),
               a.safety_decided, ShareOf(a.safe, a.safety_decided), a.safe_gave_up,
               Exception(a.safe_gave_up_no_ties)});
  };
  for (const auto& [contacts, existence] : record.existence) {
    const auto found = record.agreement.find(contacts);
    add(contacts, existence, found == record.agreement.end() ? AgreementTally{} : found->second);
  }
  add("all", SumOf(record.existence), SumOf(record.agreement));
  table.TotalIsLast();
  return table;
}

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
  Table table{"methods",
              "What each method made of what it was asked",
              Columns("method* asked_about* contacts asked solved,,share,low,high"),
              {},
              {},
              3};
  table.columns.back().hint = "below: the share, with its exact interval at 95 %";
  for (const Asked* row : {&doubles, &exact, &complete, &lemke, &again, &ipopt, &certified}) {
    for (const auto& [contacts, solved] : row->solved) {
      if (solved.of > 0) table.Add({row->method, row->about, contacts, solved.of, solved});
    }
  }
  return table;
}

// ---- People alone ----

Table FailuresTable(const Record& record, const By& by) {
  const std::string hint = "in exact arithmetic; below: in a million runs, with the interval";
  Table table =
      Keyed("failures",
            "Failures confirmed exactly, with intervals, per generator, number of contacts and policy", by,
            {{"runs"},
             {"loops", "never end (cycle or stall) " + hint},
             {"singular", hint},
             {"ray", hint},
             {"audited", "run again exactly without a suspicion, as a sample"},
             {"misjudged", "audited with another exact outcome; below: their share, with the interval"}});
  for (const Group& g : GroupsBy(record, by)) {
    const Counts& c = g.counts;
    table.Add(Behind(g, {c.runs, RateOf(c.Loops(), c.runs), RateOf(c.Of(Outcome::kSingular), c.runs),
                         RateOf(c.Of(Outcome::kRay), c.runs), c.audited, ShareOf(c.misjudged, c.audited)}));
  }
  return table;
}

Table OutcomesTable(const Record& record) {
  Table table = Keyed(
      "outcomes", "Outcomes per generator, number of contacts and policy", {"generator", "contacts", "policy"},
      {{"problems"},
       {"solved", "forces that satisfy every condition"},
       {"cycle", "the outer state recurs exactly, or in space the run never leaves a box: it never ends"},
       {"stall", "within one drive the inner state recurs exactly: the drive never ends"},
       {"ray", "nothing limits the step"},
       {"singular", "the direction system has no solution"},
       {"limit", "a budget of drives, pivots or bits is spent"},
       {"undecided", "a sign could not be told"}});
  for (Group& g : GroupsAndAll(record, kByAll)) {
    const TallyKey usual;
    // Method and arithmetic are named only where they are not the published algorithm in doubles.
    if (g.Text(2) != "" && (g.Text(3) != usual.method || g.Text(4) != usual.arithmetic))
      g.key[2] = fmt::format("{} ({}, {})", g.Text(2), g.Text(3), g.Text(4));
    g.key.resize(3);
    std::vector<TableCell> cells = {g.tally.problems};
    for (int i = 0; i < kOutcomeCount; ++i) {
      const std::int64_t count = g.tally.outcomes[i];
      cells.push_back(i == kSolvedOutcome ? TableCell(count) : RateIfAny(count, g.tally.problems));
    }
    table.Add(Behind(g, cells));
  }
  table.TotalIsLast();
  return table;
}

Table UnsolvedTable(const Record& record) {
  Table table =
      Keyed("unsolved", "Runs not solved in doubles, per million", {"generator", "contacts"}, {{"unsolved"}});
  for (const Group& g : GroupsBy(record, {"generator", "contacts"})) {
    const std::int64_t runs = g.tally.problems, count = runs - g.tally.outcomes[kSolvedOutcome];
    table.Add(Behind(g, {{RateText(count, runs), "", count == 0 ? "zero" : Heat(count, runs)}}));
  }
  table = Pivoted(table, "contacts", "unsolved", {"", "", "zero"});
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    table.columns[i].head = Counted(std::stoi(table.columns[i].name), "contact");
  return table;
}

Table SuspicionsTable(const Record& record) {
  Table table{"suspicions",
              "Suspicious runs in doubles and their exact outcome",
              {{"in doubles", "how the run ended in double arithmetic", kText},
               {"runs", "all of these are repeated exactly"}}};
  for (int i = 0; i < kOutcomeCount; ++i) table.columns.push_back({NameOf(i), "outcome of the exact run"});
  table.columns.push_back({"confirmed", "the exact run ended in the same outcome"});
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
    cells.emplace_back(same < 0 ? "–" : Percent(exact[same], runs));
    table.Add(std::move(cells));
  }
  return table;
}

Table TrustTable(const Record& record) {
  Table table =
      Keyed("trust", "Suspicions, audits and wrong answers per generator", {"generator"},
            {{"runs"},
             {"suspicious", "not solved, or with a wrong answer; below: per million"},
             {"refuted", "the exact run of a suspicious problem is solved; below: share of the suspicious"},
             {"audited", "run again exactly without a suspicion, as a sample"},
             {"misjudged", "audited with another exact outcome"},
             {"wrong answers", "called solved with an error above the bound of the gate; below: per million"}});
  for (const Group& g : GroupsAndAll(record, {"generator"})) {
    const Counts& c = g.counts;
    const std::int64_t refuted = c.Of(Outcome::kSolved);
    table.Add(Behind(g, {c.runs,
                         RateIfAny(c.suspicious, c.runs, false),
                         {refuted, Percent(refuted, c.suspicious)},
                         c.audited,
                         c.misjudged,
                         RateIfAny(c.wrong, c.runs)}));
  }
  table.TotalIsLast();
  return table;
}

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

Table ContactsTable(const Record& record, const By& by) {
  Table table = Keyed("contacts", "", by, Columns("runs steps with_zero_steps with_give_ups loops"));
  for (const Group& g : GroupsBy(record, by)) {
    const Counts& c = g.counts;
    table.Add(Behind(g, {c.runs, MeanOf(g.tally.sums.steps, c.runs), ShareOf(c.with_zero_steps, c.runs),
                         ShareOf(c.with_give_ups, c.runs), RateOf(c.Loops(), c.runs)}));
  }
  return table;
}

std::vector<Table> CampaignTables(const Record& record, const std::vector<Discovery>& discoveries) {
  return {StatisticsTable(record),
          VerdictsTable(record, "verdicts", kByAll, "inexact_outcome* exact_outcome* count"),
          StrataTable(record),
          StepsTable(record, "steps", kByAll, "problems"),
          LoopsTable(record),
          ZeroStepsTable(record, "zero_steps"),
          AgreementTable(record),
          SolutionsTable(record),
          FindingsTable(discoveries),
          IpoptTable(discoveries)};
}

}  // namespace stiction
