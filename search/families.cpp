// SPDX-License-Identifier: Apache-2.0
#include "search/families.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace stiction {
namespace {

using FamilyKey = std::pair<std::string, int>;

std::set<FamilyKey> FamiliesWithProblems(const Store& store, const Campaign& campaign) {
  std::set<FamilyKey> families;
  const Record total = store.Total();
  for (const auto& [key, tally] : total.under_test)
    if (tally.problems > 0) families.insert({key.generator, key.contacts});
  total.ForEachTally([&families](const TallyKey& key, const Tally& tally) {
    if (tally.problems > 0) families.insert({key.generator, key.contacts});
  });
  const std::vector<Task> schedule = Schedule(campaign);
  for (const auto& [unit, elites] : store.Elites()) {  // of an optimizer, which counts nothing else
    const Task task = TaskOf(schedule, unit);
    families.insert({std::string(Row(task.generator).name), task.contacts});
  }
  return families;
}

// "integers 2 3, bodies 2"
std::string Named(const std::vector<std::pair<std::string, std::vector<int>>>& families) {
  std::string text;
  for (const auto& [generator, sizes] : families)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", generator, fmt::join(sizes, " "));
  return text;
}

}  // namespace

Families FamiliesOf(const Store& store, const Campaign& campaign) {
  const std::set<FamilyKey> present = FamiliesWithProblems(store, campaign);
  Families families;
  for (const GeneratorId id : campaign.generators) {
    const std::string name(Row(id).name);
    std::vector<int> tried, missing;
    for (const int contacts : campaign.contacts)
      (present.contains({name, contacts}) ? tried : missing).push_back(contacts);
    families.of += static_cast<std::int64_t>(tried.size() + missing.size());
    families.tried += static_cast<std::int64_t>(tried.size());
    if (!tried.empty()) families.were_tried.emplace_back(name, std::move(tried));
    if (!missing.empty()) families.were_not.emplace_back(name, std::move(missing));
  }
  return families;
}

std::string FamiliesText(const Store& store, const std::string& file) {
  const Families families = FamiliesOf(store, CampaignOf(store.identity(), file));
  if (families.were_not.empty()) return "";
  return fmt::format("{} of {} families tried (generator, numbers of contacts){}{}; not reached: {}.\n",
                     families.tried, families.of, families.tried > 0 ? ": " : "", Named(families.were_tried),
                     Named(families.were_not));
}

SharedJson FamiliesToJson(const Store& store) {
  const Families families = FamiliesOf(store, CampaignOf(store.identity(), "summary"));
  std::vector<std::string> missing;
  for (const auto& [generator, sizes] : families.were_not)
    for (const int contacts : sizes) missing.push_back(fmt::format("{} {}", generator, contacts));
  return {{"tried", families.tried}, {"of", families.of}, {"not_reached", std::move(missing)}};
}

}  // namespace stiction
