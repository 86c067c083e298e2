// SPDX-License-Identifier: Apache-2.0
#include "search/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "corpus/json.h"
#include "search/adversary/optimizer.h"
#include "search/algorithm_version.h"
#include "solver/published/published_space.h"

namespace stiction {
namespace {

constexpr int kLargestMuPart = std::numeric_limits<int>::max();

int WeightOf(int contacts) {
  switch (contacts) {
    case 2:
      return 8;
    case 3:
      return 4;
    case 4:
      return 2;
    default:
      return 1;
  }
}

Policy ReadPolicy(const JsonPlace& place) {
  try {
    return ParsePolicy(place.Text("a policy"));
  } catch (const std::invalid_argument& error) {
    place.Refuse(error.what());
  }
}

template <class Rows>
std::string NamesOf(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += fmt::format("{}{}", names.empty() ? "" : ", ", row.name);
  return names;
}

template <class Read>
auto ReadList(const JsonPlace& list, Read read) {
  std::vector<decltype(read(list))> values;
  const std::size_t size = list.Size("a list that is not empty");
  if (size == 0) list.Refuse("a list that is not empty");
  for (std::size_t i = 0; i < size; ++i) values.push_back(read(list[i]));
  return values;
}

}  // namespace

GeneratorId ReadGenerator(const JsonPlace& place) {
  const auto id = FindGenerator(place.Text("the name of a generator"));
  if (!id) {
    std::vector<std::string_view> names;
    for (const GeneratorRow& row : Generators()) names.push_back(row.name);
    place.Refuse(fmt::format("one of {}", fmt::join(names, ", ")));
  }
  return *id;
}

MuChoice ReadMu(const JsonPlace& place) {
  try {
    return ParseMu(place.Text("a friction coefficient as a string"));
  } catch (const InputError& error) {
    place.Refuse(error.what());
  }
}

Campaign::Campaign() {
  for (const GeneratorRow& row : Generators()) {
    if (generators.size() < kOrdinaryGeneratorCount) generators.push_back(row.id);
  }
}

MuChoice ParseMu(const std::string& text) {
  const auto mu = ParseRational(text);
  const bool fits = mu && *mu >= 0 && mu->get_num() <= kLargestMuPart && mu->get_den() <= kLargestMuPart;
  if (!fits) {
    throw InputError(
        fmt::format("friction coefficient: found '{}', expected p/q with 0 <= p <= {} and 1 <= q <= {}", text,
                    kLargestMuPart, kLargestMuPart));
  }
  return {static_cast<int>(mu->get_num().get_si()), static_cast<int>(mu->get_den().get_si())};
}

Arithmetic ParseSearchArithmetic(const std::string& text) {
  for (const Arithmetic arithmetic : {Arithmetic::kDouble, Arithmetic::kFiltered, Arithmetic::kExact}) {
    if (text == Name(arithmetic)) return arithmetic;
  }
  throw InputError(fmt::format("arithmetic: found '{}', expected double, filtered or exact", text));
}

Campaign ParseCampaign(const std::string& text, const std::string& source) {
  const Json json = ParseJson(text, source);
  const JsonPlace root(json, source, "");
  root.RequireObject();
  const JsonPlace format = root.Required("format", "\"stiction-campaign\"");
  if (format.Text("\"stiction-campaign\"") != "stiction-campaign") format.Refuse("\"stiction-campaign\"");
  root.AllowKeys({"format",
                  "version",
                  "seed",
                  "generators",
                  "contacts",
                  "mu",
                  "policies",
                  "unit_problems",
                  "audit_every",
                  "complete_every",
                  "lemke_every",
                  "enumerate_every",
                  "representatives_per_unit",
                  "max_drives",
                  "max_pivots",
                  "max_bits",
                  "arithmetic",
                  "gravity_only",
                  "objective",
                  "optimizer",
                  "parents"});
  root.Required("version", "1").Integer(1, 1, "1");
  Campaign campaign;
  const auto integer = [&root](const char* key, std::int64_t least, std::int64_t most, auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    if (const auto place = root.Optional(key)) {
      value =
          static_cast<Value>(place->Integer(least, most, fmt::format("an integer from {} to {}", least, most)));
    }
  };
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  integer("seed", 0, std::numeric_limits<std::int64_t>::max(), campaign.seed);
  integer("unit_problems", 1, kMost, campaign.unit_problems);
  integer("audit_every", 1, kMost, campaign.audit_every);
  integer("complete_every", 1, kMost, campaign.complete_every);
  integer("lemke_every", 1, kMost, campaign.lemke_every);
  integer("enumerate_every", 1, kMost, campaign.enumerate_every);
  integer("representatives_per_unit", 1, kMost, campaign.representatives_per_unit);
  integer("max_drives", 1, kMost, campaign.limits.drives);
  integer("max_pivots", 1, kMost, campaign.limits.pivots);
  integer("max_bits", 1, kMost, campaign.limits.bits);
  if (const auto list = root.Optional("generators")) campaign.generators = ReadList(*list, ReadGenerator);
  if (const auto list = root.Optional("mu")) campaign.palette = ReadList(*list, ReadMu);
  if (const auto list = root.Optional("policies"); list && list->json() == "*") {
    campaign.policies = PlanarGrid();
  } else if (list) {
    campaign.policies = ReadList(*list, ReadPolicy);
    for (std::size_t i = 0; i < campaign.policies.size(); ++i) {
      const auto here = campaign.policies.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::find(campaign.policies.begin(), here, *here) != here) (*list)[i].Refuse("each policy once");
    }
  }
  if (const auto list = root.Optional("contacts")) {
    campaign.contacts = ReadList(*list, [](const JsonPlace& place) {
      return static_cast<int>(
          place.Integer(1, kMaxContacts, fmt::format("a number of contacts, 1 to {}", kMaxContacts)));
    });
  }
  if (const auto place = root.Optional("gravity_only")) {
    if (!place->json().is_boolean()) place->Refuse("true or false");
    campaign.gravity_only = place->json().get<bool>();
  }
  if (const auto place = root.Optional("arithmetic")) {
    try {
      campaign.arithmetic = ParseSearchArithmetic(place->Text("an arithmetic"));
    } catch (const InputError& error) {
      place->Refuse(error.what());
    }
  }
  if (const auto place = root.Optional("objective")) {
    campaign.objective = place->Text("the name of an objective");
    if (FindObjective(campaign.objective) == nullptr) place->Refuse("one of " + NamesOf(Objectives()));
  }
  if (const auto place = root.Optional("optimizer")) {
    campaign.optimizer = place->Text("the name of an optimizer");
    if (FindOptimizer(campaign.optimizer) == nullptr) place->Refuse("one of " + NamesOf(Optimizers()));
  }
  if (const auto list = root.Optional("parents")) campaign.parents = ReadList(*list, CandidateFromJson);
  return campaign;
}

// A parent is of a task of the campaign.
static void RequireParents(const Campaign& campaign) {
  const auto has = [](const auto& list, const auto& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  if (!campaign.parents.empty() && campaign.objective.empty())
    throw InputError("parents: found some without an objective, expected --objective too");
  for (const Candidate& parent : campaign.parents) {
    if (has(campaign.generators, parent.generator) && has(campaign.contacts, parent.contacts) &&
        parent.gravity_only == campaign.gravity_only) {
      const int most = LargestMuPart(parent.generator);
      const bool fits = parent.mu.numerator <= most && parent.mu.denominator <= most;
      if (fits && (FindObjective(campaign.objective)->lowers_friction || has(campaign.palette, parent.mu)))
        continue;
      throw InputError(fmt::format("parents: found friction coefficient {}/{}, expected one of the campaign's",
                                   parent.mu.numerator, parent.mu.denominator));
    }
    throw InputError(fmt::format("parents: found {} of {} contacts{}, expected problems of the campaign's kind",
                                 Row(parent.generator).name, parent.contacts,
                                 parent.gravity_only ? " under gravity only" : ""));
  }
}

void RequireConsistent(const Campaign& campaign) {
  for (const GeneratorId id : campaign.generators) {
    if (campaign.gravity_only && !Row(id).has_gravity) {
      throw InputError(fmt::format("gravity only: found generator {}, expected one of bodies", Row(id).name));
    }
    const int most = Row(id).most_mu_part;
    for (const MuChoice& mu : campaign.palette) {
      if (mu.numerator <= most && mu.denominator <= most) continue;
      throw InputError(fmt::format("friction coefficient: found {}/{} for {}, expected p/q of at most {}",
                                   mu.numerator, mu.denominator, Row(id).name, most));
    }
  }
  RequireParents(campaign);
  for (const GeneratorId id : campaign.generators) {
    if (campaign.arithmetic != Arithmetic::kDouble && Row(id).InSpace())
      throw InputError(fmt::format("arithmetic: found {} for generator {}, expected double in space",
                                   Name(campaign.arithmetic), Row(id).name));
    if (!campaign.objective.empty() && !Row(id).IsPlain())
      throw InputError(fmt::format(
          "objective: found generator {}, expected one of static contacts of the plane", Row(id).name));
    for (const Policy& policy : campaign.policies) {
      if (!Row(id).InSpace() || PublishedReadsInSpace(policy)) continue;
      throw InputError(
          fmt::format("policies: found {} for generator {}, expected file=no, apex=kept, and slip=literal or "
                      "slip=redirect, as the published algorithm is built in space",
                      PolicyName(policy), Row(id).name));
    }
  }
  if (!campaign.objective.empty() && campaign.arithmetic != Arithmetic::kDouble)
    throw InputError(
        fmt::format("arithmetic: found {} with an objective, expected double", Name(campaign.arithmetic)));
  if (!campaign.objective.empty() && campaign.policies.size() != 1) {
    throw InputError(
        fmt::format("policies: found {}, expected one, for an objective", campaign.policies.size()));
  }
}

Campaign ReadCampaign(const std::filesystem::path& file) {
  return ParseCampaign(ReadText(file), file.string());
}

Campaign CampaignOf(const CampaignIdentity& identity, const std::string& source) {
  Campaign campaign = ParseCampaign(identity.definition, source + ": definition");
  campaign.seed = identity.seed;
  // A store from before it was drawn by lot goes on as it began.
  if (!ParseJson(identity.definition, source).contains("complete_every")) campaign.complete_every = 1;
  const std::string place = source + ": policies";
  const Json policies = ParseJson(identity.policies, place);
  campaign.policies = ReadList(JsonPlace(policies, place, ""), ReadPolicy);
  return campaign;
}

Json DefinitionToJson(const Campaign& campaign) {
  Json generators = Json::array(), palette = Json::array();
  for (const GeneratorId id : campaign.generators) generators.push_back(Row(id).name);
  for (const MuChoice& mu : campaign.palette) {
    palette.push_back(ToString(Rational(mu.numerator) / Rational(mu.denominator)));
  }
  Json definition = {{"format", "stiction-campaign"},
                     {"version", 1},
                     {"generators", generators},
                     {"contacts", campaign.contacts},
                     {"mu", palette},
                     {"unit_problems", campaign.unit_problems},
                     {"audit_every", campaign.audit_every},
                     {"lemke_every", campaign.lemke_every},
                     {"enumerate_every", campaign.enumerate_every},
                     {"representatives_per_unit", campaign.representatives_per_unit},
                     {"max_drives", campaign.limits.drives},
                     {"max_pivots", campaign.limits.pivots},
                     {"max_bits", campaign.limits.bits}};
  if (campaign.complete_every != 1) definition["complete_every"] = campaign.complete_every;
  if (campaign.arithmetic != Arithmetic::kDouble) definition["arithmetic"] = Name(campaign.arithmetic);
  if (campaign.gravity_only) definition["gravity_only"] = true;
  if (!campaign.objective.empty()) {
    definition["objective"] = campaign.objective;
    definition["optimizer"] = campaign.optimizer;
  }
  for (const Candidate& parent : campaign.parents) definition["parents"].push_back(ToJson(parent));
  return definition;
}

CampaignIdentity IdentityOf(const Campaign& campaign) {
  Json policies = Json::array();
  for (const Policy& policy : campaign.policies) policies.push_back(PolicyName(policy));
  return {DefinitionToJson(campaign).dump(), campaign.seed, policies.dump(), kCountsVersion};
}

std::vector<Task> Schedule(const Campaign& campaign) {
  int rounds = 0;
  for (const int contacts : campaign.contacts) rounds = std::max(rounds, WeightOf(contacts));
  std::vector<Task> schedule;
  for (int round = 0; round < rounds; ++round) {
    for (const int contacts : campaign.contacts) {
      if (round >= WeightOf(contacts)) continue;
      for (const GeneratorId generator : campaign.generators) schedule.push_back({generator, contacts});
    }
  }
  return schedule;
}

Task TaskOf(const std::vector<Task>& schedule, std::int64_t unit) {
  return schedule[static_cast<std::size_t>(unit) % schedule.size()];
}

std::int64_t UnitProblems(const Campaign& campaign, const Task& task) {
  return std::max<std::int64_t>(1, campaign.unit_problems >> std::max(0, task.contacts - 2));
}

std::int64_t UnitsFor(const Campaign& campaign, std::int64_t problems) {
  const std::vector<Task> schedule = Schedule(campaign);
  std::int64_t of_round = 0;  // or of a part that is enough
  for (const Task& task : schedule) {
    if (of_round > problems) break;
    of_round += UnitProblems(campaign, task);
  }
  std::int64_t units = problems / of_round * static_cast<std::int64_t>(schedule.size());
  std::int64_t rest = problems % of_round;
  for (const Task& task : schedule) {
    if (rest <= 0) break;
    rest -= UnitProblems(campaign, task);
    ++units;
  }
  return units;
}

}  // namespace stiction
