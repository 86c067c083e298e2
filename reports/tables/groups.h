// SPDX-License-Identifier: Apache-2.0
// Group-by: what a store has counted, by generator, contacts, policy, method, arithmetic, and by friction and
// rank. Whoever tells numbers of runs by something groups them here.

#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "corpus/record/counts.h"
#include "reports/tables/table.h"

namespace stiction {

using KeyPart = std::variant<std::int64_t, std::string>;

struct Group {
  std::vector<KeyPart> key;  // in the order of `by`; empty: all runs
  Tally tally;               // merged; by friction or rank it stays empty
  Counts counts;
  Stratum stratum = {};  // merged, by friction or rank alone

  const std::string& Text(std::size_t i) const { return std::get<std::string>(key[i]); }
  int Number(std::size_t i) const { return static_cast<int>(std::get<std::int64_t>(key[i])); }
};

using By = std::vector<std::string>;
inline const By kByAll = {"generator", "contacts", "policy", "method", "arithmetic"};

// In the order of the key: numbers by value, friction coefficients before `mixed`. By nothing: one group of
// all.
std::vector<Group> GroupsBy(const Record& record, const By& by);

// What was counted, by name: of runs `runs`, `loops`, `exact_ray`, ..., outcomes in doubles, `sum_steps`,
// `max_steps`; of paths of complete driving `driven_problems`, ...; of methods compared `compared`, ...; of
// loops `period_loops`, ...
Numbers NumbersOf(const Group& group);
Numbers NumbersOf(const ExistenceTally& existence, const AgreementTally& agreement);
Numbers NumbersOf(const LoopTally& loops);

// A table of tables.txt with a row for each group.
Table CountedBy(const std::string& name, const By& by, const std::vector<Group>& groups);
// A table whose rows are named by such keys.
Table Keyed(const std::string& name, const std::string& caption, const By& by,
            const std::vector<Column>& columns);
// The cells of a row: the key, and what stands behind it.
std::vector<TableCell> Behind(const Group& group, const std::vector<TableCell>& more);

}  // namespace stiction
