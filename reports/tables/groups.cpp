// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/groups.h"

#include <algorithm>
#include <map>
#include <utility>

namespace stiction {
namespace {

KeyPart PartOf(const std::string& name, const TallyKey& key, const StratumKey& stratum) {
  if (name == "generator") return key.generator;
  if (name == "contacts") return std::int64_t{key.contacts};
  if (name == "policy") return key.policy;
  if (name == "method") return key.method;
  if (name == "arithmetic") return key.arithmetic;
  if (name == "friction") return stratum.friction;
  return std::int64_t{stratum.rank};
}

bool IsNumber(const std::string& name) { return name == "contacts" || name == "rank"; }

struct InOrder {
  static bool Less(const KeyPart& left, const KeyPart& right) {
    if (std::holds_alternative<std::int64_t>(left)) return left < right;
    return NaturalLess(std::get<std::string>(left), std::get<std::string>(right));
  }
  bool operator()(const std::vector<KeyPart>& left, const std::vector<KeyPart>& right) const {
    return std::lexicographical_compare(left.begin(), left.end(), right.begin(), right.end(), &Less);
  }
};

// The least number of steps that a share of the runs do not exceed.
int StepsWithin(const Tally& tally, double share) {
  std::int64_t below = 0;
  int steps = 0;
  const auto wanted = share * static_cast<double>(tally.problems);
  while (steps < Tally::kBins - 1 && static_cast<double>(below += tally.steps[steps]) < wanted) ++steps;
  return steps;
}

}  // namespace

std::vector<Group> GroupsBy(const Record& record, const By& by) {
  std::map<std::vector<KeyPart>, Group, InOrder> groups;
  const auto group_of = [&](const TallyKey& key, const StratumKey& stratum) -> Group& {
    std::vector<KeyPart> parts;
    for (const std::string& name : by) parts.push_back(PartOf(name, key, stratum));
    return groups[parts];
  };
  const bool of_strata = std::any_of(
      by.begin(), by.end(), [](const std::string& name) { return name == "friction" || name == "rank"; });
  if (by.empty()) groups[{}];
  for (const auto& [key, tally] : record.tallies) {
    if (!of_strata) group_of(key, {}).tally.Merge(tally);
    for (const auto& [stratum_key, stratum] : tally.strata) {
      if (of_strata) group_of(key, stratum_key).stratum.Merge(stratum);
    }
  }
  std::vector<Group> sorted;
  for (auto& [key, group] : groups) {
    group.key = key;
    of_strata ? group.counts.Add(group.stratum) : group.counts.Add(group.tally);
    sorted.push_back(std::move(group));
  }
  return sorted;
}

Numbers NumbersOf(const Group& group) {
  const Counts& c = group.counts;
  Numbers numbers = {{"problems", group.tally.problems},
                     {"runs", c.runs},
                     {"loops", c.Loops()},
                     {"suspicious", c.suspicious},
                     {"unsuspected", c.runs - c.suspicious},
                     {"confirmed", c.confirmed},
                     {"doubles_differ", c.doubles_differ},
                     {"wrong", c.wrong},
                     {"audited", c.audited},
                     {"misjudged", c.misjudged},
                     {"with_zero_steps", c.with_zero_steps},
                     {"with_give_ups", c.with_give_ups},
                     {"median_steps", StepsWithin(group.tally, 0.5)},
                     {"steps_of_99_percent", StepsWithin(group.tally, 0.99)}};
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    const std::string name(kOutcomeNames[i]);
    numbers[name] = group.tally.outcomes[i];
    numbers["exact_" + name] = c.exact[i];
  }
  for (const auto& [of, statistics] : {std::pair("sum_", &group.tally.sums), {"max_", &group.tally.maxima}})
    ForEachField(*statistics, [&, of = std::string(of)](const char* name, const char*, std::int64_t value) {
      numbers[of + name] = value;
    });
  return numbers;
}

Numbers NumbersOf(const ExistenceTally& existence, const AgreementTally& agreement) {
  Numbers numbers;
  ForEachCounter(existence,
                 [&](const char* name, std::int64_t value) { numbers[std::string("driven_") + name] = value; });
  ForEachCounter(agreement, [&](const char* name, std::int64_t value) { numbers[name] = value; });
  return numbers;
}

Numbers NumbersOf(const LoopTally& loops) {
  Numbers numbers;
  ForEachCounter(loops,
                 [&](const char* name, std::int64_t value) { numbers[std::string("period_") + name] = value; });
  return numbers;
}

Table CountedBy(const std::string& name, const By& by, const std::vector<Group>& groups) {
  const Table described = Described(name);
  Table table = Keyed(name, described.caption, by, described.columns);
  for (const Group& group : groups) table.AddCounted(Behind(group, {}), NumbersOf(group));
  return table;
}

Table Keyed(const std::string& name, const std::string& caption, const By& by,
            const std::vector<Column>& columns) {
  Table table{name, caption, {}, {}, {}, static_cast<int>(by.size())};
  for (const std::string& key : by) table.columns.push_back({key, "", !IsNumber(key)});
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  return table;
}

std::vector<TableCell> Behind(const Group& group, const std::vector<TableCell>& more) {
  std::vector<TableCell> cells;
  for (const KeyPart& part : group.key)
    cells.push_back(std::visit([](const auto& each) { return TableCell(each); }, part));
  cells.insert(cells.end(), more.begin(), more.end());
  return cells;
}

}  // namespace stiction
