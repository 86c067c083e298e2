// SPDX-License-Identifier: Apache-2.0
#include "search/campaign.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/json.h"
#include "corpus/named_rows.h"
#include "corpus/record/fields.ipp"
#include "search/adversary/optimizer.h"
#include "search/adversary/parents.h"
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

std::string OneOf(const auto& rows) { return fmt::format("one of {}", fmt::join(NamesOf(rows), ", ")); }

template <class Read>
auto ReadList(const JsonPlace& list, Read read) {
  std::vector<decltype(read(list))> values;
  const std::size_t size = list.Size("a list that is not empty");
  if (size == 0) list.Refuse("a list that is not empty");
  for (std::size_t i = 0; i < size; ++i) values.push_back(read(list[i]));
  return values;
}

template <class Values, class Write>
Json WriteList(const Values& values, Write write) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(write(value));
  return list;
}

}  // namespace

GeneratorId ReadGenerator(const JsonPlace& place) {
  const auto id = FindGenerator(place.Text("the name of a generator"));
  if (!id) place.Refuse(OneOf(Generators()));
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

// ---- Fields that have a form of their own in files -------------------------------------------

const FormOf<Campaign> kGeneratorsForm = {
    "[text+]",
    [](const JsonPlace& list, Campaign& campaign) { campaign.generators = ReadList(list, ReadGenerator); },
    [](const Campaign& campaign) {
      return WriteList(campaign.generators, [](GeneratorId id) { return Row(id).name; });
    }};

const FormOf<Campaign> kContactsForm = {
    "[integer+]",
    [](const JsonPlace& list, Campaign& campaign) {
      campaign.contacts = ReadList(list, [](const JsonPlace& place) {
        return static_cast<int>(
            place.Integer(1, kMaxContacts, fmt::format("a number of contacts, 1 to {}", kMaxContacts)));
      });
    },
    [](const Campaign& campaign) { return Json(campaign.contacts); }};

const FormOf<Campaign> kPaletteForm = {
    "[text+]", [](const JsonPlace& list, Campaign& campaign) { campaign.palette = ReadList(list, ReadMu); },
    [](const Campaign& campaign) {
      return WriteList(campaign.palette, [](const MuChoice& mu) {
        return ToString(Rational(mu.numerator) / Rational(mu.denominator));
      });
    }};

const FormOf<Campaign> kPoliciesForm = {
    R"("*" | [text+])",
    [](const JsonPlace& list, Campaign& campaign) {
      if (list.json() == "*") {
        campaign.policies = PlanarGrid();
        return;
      }
      const std::vector<Policy>& policies = campaign.policies = ReadList(list, ReadPolicy);
      for (std::size_t i = 0; i < policies.size(); ++i) {
        const auto here = policies.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(policies.begin(), here, *here) != here) list[i].Refuse("each policy once");
      }
    },
    [](const Campaign& campaign) { return WriteList(campaign.policies, PolicyName); }};

const FormOf<Campaign> kArithmeticForm = {
    R"("double" | "filtered" | "exact")",
    [](const JsonPlace& place, Campaign& campaign) {
      try {
        campaign.arithmetic = ParseSearchArithmetic(place.Text("an arithmetic"));
      } catch (const InputError& error) {
        place.Refuse(error.what());
      }
    },
    [](const Campaign& campaign) {
      return campaign.arithmetic == Arithmetic::kDouble ? Json() : Json(Name(campaign.arithmetic));
    }};

const FormOf<Campaign> kObjectiveForm = {
    "text",
    [](const JsonPlace& place, Campaign& campaign) {
      campaign.objective = place.Text("the name of an objective");
      const Objective* objective = FindObjective(campaign.objective);
      if (objective == nullptr) place.Refuse(OneOf(Objectives()));
      campaign.optimizer = objective->optimizer;  // until one is read
    },
    [](const Campaign& campaign) { return campaign.objective.empty() ? Json() : Json(campaign.objective); }};

const FormOf<Campaign> kOptimizerForm = {
    "text",
    [](const JsonPlace& place, Campaign& campaign) {
      campaign.optimizer = place.Text("the name of an optimizer");
      if (FindOptimizer(campaign.optimizer) == nullptr) place.Refuse(OneOf(Optimizers()));
    },
    [](const Campaign& campaign) { return campaign.objective.empty() ? Json() : Json(campaign.optimizer); }};

const FormOf<Campaign> kParentsForm = {
    "[object+]",
    [](const JsonPlace& list, Campaign& campaign) {
      campaign.parents = ReadList(list, [](const JsonPlace& parent) { return CandidateFromJson(parent); });
    },
    [](const Campaign& campaign) {
      return campaign.parents.empty()
                 ? Json()
                 : WriteList(campaign.parents, [](const Candidate& parent) { return ToJson(parent); });
    }};

const FormOf<Campaign> kSolverForm = {
    "{name: text, version: text, law: text, accuracy: text}",
    [](const JsonPlace& place, Campaign& campaign) {
      place.RequireObject();
      place.AllowKeys({"name", "version", "law", "accuracy"});
      const auto text = [&place](const char* key) { return place.Required(key, "a text").Text("a text"); };
      const std::string law = text("law");
      const auto* const known = std::find(kSolverLawNames.begin(), kSolverLawNames.end(), law);
      if (known == kSolverLawNames.end())
        place.Required("law", "a law").Refuse(fmt::format("one of {}", fmt::join(kSolverLawNames, ", ")));
      const auto accuracy = ParseRational(text("accuracy"));
      if (!accuracy || *accuracy <= 0)
        place.Required("accuracy", "a number").Refuse("a number above 0, as text");
      if (text("name").empty()) place.Required("name", "a text").Refuse("a name");
      campaign.solver = {text("name"), text("version"), static_cast<SolverLaw>(known - kSolverLawNames.begin()),
                         text("accuracy")};
    },
    [](const Campaign& campaign) {
      const SolverUnderTest& solver = campaign.solver;
      return solver.name.empty() ? Json()
                                 : Json{{"name", solver.name},
                                        {"version", solver.version},
                                        {"law", kSolverLawNames[static_cast<std::size_t>(solver.law)]},
                                        {"accuracy", solver.accuracy}};
    }};

namespace {

constexpr std::span<const FieldOf<Campaign>> kFields = kCampaignFields;

Json FieldsOf(const Campaign& campaign, FieldUse use, Json json = Json::object()) {
  WriteFields(kFields, use, campaign, json);
  return json;
}

}  // namespace

Campaign ParseCampaign(const std::string& text, const std::string& source) {
  const JsonPlace root(text, source);
  root.RequireFormat("stiction-campaign");
  Campaign campaign;
  Faults faults(source);
  ReadFields(kFields, root, campaign, faults, {"format", "version"});
  faults.Throw();
  return campaign;
}

static void RequireParents(const Campaign& campaign) {
  if (!campaign.parents.empty() && campaign.objective.empty())
    throw InputError("parents: found some without an objective, expected --objective too");
  for (const Candidate& parent : campaign.parents) {
    if (const std::string obstacle = ObstacleOf(parent, campaign); !obstacle.empty())
      throw InputError("parents: " + obstacle);
  }
}

// A solver under test is given contacts that rest; its objectives are its own.
static void RequireTestable(const Campaign& campaign) {
  const bool of_solver = !campaign.objective.empty() && FindObjective(campaign.objective)->of_solver;
  const bool tests = !campaign.solver.name.empty();
  if (of_solver && !tests)
    throw InputError(
        fmt::format("objective: found {} without a solver, expected --solver too", campaign.objective));
  if (tests && !campaign.objective.empty() && !of_solver)
    throw InputError(
        fmt::format("objective: found {} with a solver, expected error or time", campaign.objective));
  if (!tests) return;
  for (const GeneratorId id : campaign.generators)
    if (Row(id).other_kind == ContactKind::kSliding)
      throw InputError(
          fmt::format("solver: found generator {}, expected one without sliding contacts", Row(id).name));
}

void RequireConsistent(const Campaign& campaign) {
  RequireTestable(campaign);
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
    const bool of_solver_in_space = !campaign.solver.name.empty() && Row(id).InSpace();
    if (!campaign.objective.empty() && !Row(id).IsPlain() && !of_solver_in_space)
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
  if (!JsonPlace(identity.definition, source).Optional("complete_every")) campaign.complete_every = 1;
  const std::string place = source + ": policies";
  campaign.policies = ReadList(JsonPlace(identity.policies, place), ReadPolicy);
  if (!identity.remarks.empty()) {
    const std::string of_remarks = source + ": remarks";
    const JsonPlace root(identity.remarks, of_remarks);
    root.RequireObject();
    std::vector<FieldOf<Campaign>> told;
    std::ranges::copy_if(kFields, std::back_inserter(told),
                         [](const auto& f) { return f.use == FieldUse::kRemark; });
    Faults faults(of_remarks);
    ReadFields(std::span<const FieldOf<Campaign>>(told), root, campaign, faults);
    faults.Throw();
  }
  return campaign;
}

Json DefinitionToJson(const Campaign& campaign) {
  return FieldsOf(campaign, FieldUse::kDefines, {{"format", "stiction-campaign"}, {"version", 1}});
}

SharedJson ToJson(const Campaign& campaign) {
  return FieldsOf(campaign, FieldUse::kRemark,
                  FieldsOf(campaign, FieldUse::kApart, DefinitionToJson(campaign)));
}

std::string ShapeOfCampaign() { return ShapeOf(kFields, R"(format: "stiction-campaign", version: 1)"); }

CampaignIdentity IdentityOf(const Campaign& campaign) {
  const Json remarks = FieldsOf(campaign, FieldUse::kRemark);
  return {JsonText(DefinitionToJson(campaign)), campaign.seed, JsonText(kPoliciesForm.write(campaign)),
          campaign.solver.name.empty() ? kCountsVersion : kJudgeVersion,
          remarks.empty() ? "" : JsonText(remarks)};
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

std::int64_t FamilyCount(const Campaign& campaign) {
  return static_cast<std::int64_t>(campaign.contacts.size() * campaign.generators.size());
}

std::int64_t UnitProblems(const Campaign& campaign, const Task& task, std::int64_t unit) {
  const auto of_size = [&task](std::int64_t problems) {
    return std::max<std::int64_t>(1, problems >> std::max(0, task.contacts - 2));
  };
  const std::int64_t whole = of_size(campaign.unit_problems);
  if (campaign.first_unit_problems == 0) return whole;
  constexpr std::int64_t kMostDoublings = 62;
  std::int64_t problems = std::min(campaign.first_unit_problems, whole);
  const std::int64_t doublings = std::min(unit / FamilyCount(campaign), kMostDoublings);
  for (std::int64_t turn = 0; turn < doublings && problems < whole; ++turn) problems *= 2;
  return std::min(problems, whole);
}

std::int64_t UnitsFor(const Campaign& campaign, std::int64_t problems) {
  const std::vector<Task> schedule = Schedule(campaign);
  const auto round = static_cast<std::int64_t>(schedule.size());
  // One by one while they grow, then by rounds of the schedule, then one by one again.
  std::int64_t unit = 0, rest = problems;
  const auto take = [&] {
    rest -= UnitProblems(campaign, TaskOf(schedule, unit), unit);
    ++unit;
  };
  const auto grows = [&] {
    return UnitProblems(campaign, {campaign.generators.front(), 1}, unit) < campaign.unit_problems;
  };
  while (rest > 0 && (grows() || unit % round != 0)) take();
  std::int64_t of_round = 0;  // or of a part that is enough
  for (std::int64_t next = unit; next < unit + round && of_round <= rest; ++next)
    of_round += UnitProblems(campaign, TaskOf(schedule, next), next);
  if (rest > 0) {
    unit += rest / of_round * round;
    rest %= of_round;
  }
  while (rest > 0) take();
  return unit;
}

Campaign AsBegun(Campaign campaign) {
  if (campaign.first_unit_problems == 0 && campaign.objective.empty()) campaign.first_unit_problems = 1;
  return campaign;
}

Campaign AsBegunIn(const std::filesystem::path& store, const Campaign& campaign) {
  const bool is_there = std::filesystem::exists(std::filesystem::symlink_status(store));
  return is_there && Store::IdentityIn(store) == IdentityOf(campaign) ? campaign : AsBegun(campaign);
}

}  // namespace stiction
