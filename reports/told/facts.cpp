// SPDX-License-Identifier: Apache-2.0
#include "reports/told/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/grouped.h"
#include "corpus/record/kinds.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

// "1 contact", "2 to 8 contacts".
std::string ContactsText(const std::set<int>& contacts) {
  if (contacts.size() < 2) return contacts.empty() ? "" : Counted(*contacts.begin(), "contact");
  return fmt::format("{} to {} contacts", *contacts.begin(), *contacts.rbegin());
}

}  // namespace

Facts FactsOf(const StoreTotals& t, const CampaignIdentity& identity) {
  Facts facts;
  const auto minimized = std::ssize(t.simplest);
  const bool minimized_loop =
      std::ranges::any_of(t.simplest, [](const Finding& f) { return IsLoopKind(f.kind); });
  std::set<std::string> generators;
  std::set<int> contacts;
  for (const Group& group : GroupsBy(t.record, {"generator", "contacts"})) {
    generators.insert(group.Text(0));
    contacts.insert(group.Number(1));
  }
  Numbers& n = facts.numbers = NumbersOf(GroupsBy(t.record, {}).front());
  n.merge(NumbersOf(t.existence, t.agreement));
  n.merge(NumbersOf(t.loops));
  n["problems"] = t.problems;  // each runs under every policy
  n.insert({{"units", t.units},
            {"generators", std::ssize(generators)},
            {"several", n["runs"] != t.problems},
            {"stuck", n["exact_singular"] + n["exact_ray"]},
            {"all_repeated", n["audited"] == n["unsuspected"]},
            {"loop_groups", t.LoopGroups()},
            {"finished_loops", t.finished_loops},
            {"whole_grid", t.whole_grid},
            {"minimized_loop", minimized_loop},
            {"loops_counted", !t.record.loops.empty()},
            {"missed", t.existence.problems - t.existence.solved},
            {"disagreements_met", t.disagreements},
            {"agreement_asked", t.agreement.compared > 0 || t.disagreements > 0},
            {"finished", t.finished},
            {"minimized", minimized},
            {"finished_otherwise", t.finished - minimized},
            {"pending", t.pending}});
  facts.texts = {{"seed", std::to_string(identity.seed)},
                 {"algorithm", std::to_string(identity.algorithm)},
                 {"policies", PoliciesText(t.record)},
                 {"contacts", ContactsText(contacts)}};
  facts.tables = ShownTables(t.record);
  return facts;
}

}  // namespace stiction
