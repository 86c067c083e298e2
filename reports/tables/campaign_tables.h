// SPDX-License-Identifier: Apache-2.0
// The tables of a campaign, each defined once, whatever medium shows it. A new one is a function there, with
// its columns in tables.txt.

#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "corpus/record/work.h"
#include "reports/tables/discovery.h"
#include "reports/tables/groups.h"

namespace stiction {

// A table of tables.txt by number of contacts: existence decided by complete driving, methods compared, safe
// problems.
Table CountedByContacts(const std::string& name, const Record& record);
// What each method made of what it was asked.
Table MethodsTable(const Record& record, const std::vector<Discovery>& discoveries);
// A row per signature, in the order of signature.
Table FindingsTable(const std::vector<Discovery>& discoveries);
// What another run of the same campaign need not repeat: machines, and processor seconds by what they went
// into.
Table WorkTable(const Work& work);

// Those that a report and a data package write as NAME.csv, and Python has.
std::vector<Table> CampaignTables(const Record& record, const std::vector<Discovery>& discoveries);
// Those that the figures of a page draw.
std::vector<Table> CampaignFigures(const Record& record, const std::vector<Discovery>& discoveries);
// Those of the record alone that people are shown, by their names in told/report.txt. It must outlive them.
using TablesMaker = std::function<std::vector<Table>()>;
std::map<std::string, TablesMaker> ShownTables(const Record& record);

}  // namespace stiction
