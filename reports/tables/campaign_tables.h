// SPDX-License-Identifier: Apache-2.0
// The tables of a campaign, each defined once, whatever medium shows it. A new one is a function here.

#ifndef STICTION_REPORTS_TABLES_CAMPAIGN_TABLES_H_
#define STICTION_REPORTS_TABLES_CAMPAIGN_TABLES_H_

#include <string>
#include <vector>

#include "corpus/record/work.h"
#include "reports/tables/discovery.h"
#include "reports/tables/groups.h"
#include "reports/tables/table.h"

namespace stiction {

// ---- Data alone ----

// All counters, sums and maxima of every tally.
Table StatisticsTable(const Record& record);
// Outcomes of doubles and of exact runs apart, by friction and rank.
Table StrataTable(const Record& record);
// What another run of the same campaign need not repeat: machines, and processor seconds by what they went
// into.
Table WorkTable(const Work& work);
// A row per signature, in the order of signature.
Table FindingsTable(const std::vector<Discovery>& discoveries);
// A row per finding that Ipopt was asked about. Apart, since its answers depend on the machine's libraries.
Table IpoptTable(const std::vector<Discovery>& discoveries);

// ---- Data and figures; `columns` name what stands behind the key ----

// Runs repeated exactly on suspicion: by what doubles said and what is exact, as far as it occurred.
Table VerdictsTable(const Record& record, const std::string& name, const By& by, const std::string& columns);
// Runs by their steps; the last bin, which holds all above, too, is marked.
Table StepsTable(const Record& record, const std::string& name, const By& by, const std::string& runs);
// Loops by how many zero steps their period has.
Table ZeroStepsTable(const Record& record, const std::string& name);
// Failures confirmed exactly, by contacts, friction (mu) and rank.
Table RatesFigure(const Record& record);
// Loops confirmed exactly of all generators together, by contacts and friction.
Table OftenFigure(const Record& record);
// Steps of a run, at most so many in half of the runs, in 99 of 100, in all; and shares of runs.
Table CostFigure(const Record& record);
// Audited runs that were misjudged, and solutions that are none, by generator.
Table TrustFigure(const Record& record);
// Runs with a step of length zero, and with something given up.
Table PivotingFigure(const Record& record);
// Paths of complete driving with folds, with descents, with ties.
Table DrivingFigure(const Record& record);

// ---- Data and people ----

// Loops of exact arithmetic by the number of contacts in their period.
Table LoopsTable(const Record& record);
// By number of contacts: existence decided by complete driving, methods compared, safe problems.
Table AgreementTable(const Record& record);
// Problems by number of mode words that have solutions (`counted` = words), regular ones by number of
// solutions.
Table SolutionsTable(const Record& record);
// What each method made of what it was asked.
Table MethodsTable(const Record& record, const std::vector<Discovery>& discoveries);

// ---- People alone ----

// Failures confirmed exactly, and audits.
Table FailuresTable(const Record& record, const By& by);
// How the runs in doubles ended.
Table OutcomesTable(const Record& record);
// Rates of the runs that doubles do not solve: generators down, contacts across.
Table UnsolvedTable(const Record& record);
// Suspicious runs of doubles and their exact outcomes.
Table SuspicionsTable(const Record& record);
// Suspicions, audits and wrong answers by generator.
Table TrustTable(const Record& record);
// Counters of a run: mean and maximum.
Table PivotsTable(const Record& record);
// What runs were like: steps, zero steps, give-ups, loops.
Table ContactsTable(const Record& record, const By& by);

// Those that a report and a data package write as NAME.csv, and Python has.
std::vector<Table> CampaignTables(const Record& record, const std::vector<Discovery>& discoveries);

}  // namespace stiction

#endif  // STICTION_REPORTS_TABLES_CAMPAIGN_TABLES_H_
