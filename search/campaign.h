// SPDX-License-Identifier: Apache-2.0
// Campaign: what a search tries, in units that are the same on every machine.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "corpus/record/fields.h"
#include "corpus/store/store.h"
#include "search/adversary/candidate.h"
#include "search/generators/generators.h"
#include "search/under_test/solver.h"
#include "solver/problem/options.h"

namespace stiction {

// All modes of more contacts are not tried: 4^n words.
inline constexpr int kMostContactsEnumerated = 3;

// Files: {"format": "stiction-campaign", "version": 1, ...} with any of the fields below.
struct Campaign {
  std::uint64_t seed = 1;
  std::vector<GeneratorId> generators;  // default: all ordinary ones (generators.h)
  std::vector<int> contacts = {1, 2, 3, 4, 5, 6, 7, 8};
  std::vector<MuChoice> palette = {kDefaultPalette.begin(), kDefaultPalette.end()};
  std::vector<Policy> policies = {Policy{}};
  std::int64_t unit_problems = 10000;  // problems of a unit of at most two contacts; see UnitProblems
  // The first unit of each family has so many, and each further one twice as many as the one before, up to
  // unit_problems: so any budget tries all families. 0: all units are alike, as in a store from before this was
  // so.
  std::int64_t first_unit_problems = 0;
  std::int64_t audit_every = 5000;  // one problem in so many is also run exactly
  // Complete driving runs on all problems that are audited, on the first of each group of a unit that the
  // published algorithm does not solve, and on one in so many, drawn by their seeds, of the suspicions. Of what
  // it runs on, one in so many is run by Lemke's method too (audited problems: all); and of those of at most
  // enumerate_contacts contacts one in so many is enumerated: all of up to 4^n contact modes.
  // Representatives are run by all when finished.
  std::int64_t complete_every = 100;
  std::int64_t lemke_every = 100;
  std::int64_t enumerate_every = 1000;
  std::int64_t enumerate_contacts = kMostContactsEnumerated;
  std::int64_t representatives_per_unit = 4;  // new signatures of a unit whose problem is kept
  Limits limits = {1000, 10000, 100000};
  // double: suspicions are decided again, filtered. filtered, exact: every problem is decided so at once.
  Arithmetic arithmetic = Arithmetic::kDouble;
  bool gravity_only = false;  // bodies without applied forces
  bool no_leaks = false;      // the memory of a solver under test is not looked at
  // A unit spends its problems on the candidates of an optimizer, under the one policy (adversary/). Empty:
  // random problems.
  std::string objective;
  std::string optimizer = "evolution";
  std::vector<Candidate> parents;  // that an optimizer starts from, besides random ones
  // Is given the problems in place of the published algorithm, and its answers are judged (under_test/).
  SolverUnderTest solver;
  std::string note;  // why it is run, for people

  Campaign();
  bool operator==(const Campaign&) const = default;
};

extern const FormOf<Campaign> kGeneratorsForm, kContactsForm, kPaletteForm, kPoliciesForm, kArithmeticForm,
    kObjectiveForm, kOptimizerForm, kParentsForm, kSolverForm;

// In the order of a definition.
inline constexpr auto kCampaignFields = std::to_array<FieldOf<Campaign>>({
    {"seed", &Campaign::seed, "", "the one source of randomness; by default 1", "", FieldUse::kApart, 0,
     std::numeric_limits<std::int64_t>::max()},
    {"generators", &kGeneratorsForm},
    {"contacts", &kContactsForm, "numbers of contacts"},
    {"mu", &kPaletteForm, "friction palette"},
    {"policies", &kPoliciesForm, "", "", "", FieldUse::kApart},
    {"unit_problems", &Campaign::unit_problems, "problems of a unit"},
    {"first_unit_problems", &Campaign::first_unit_problems, "problems of the first unit of each family", "", "",
     FieldUse::kDefines, 1, kMostOfField, 0},
    {"audit_every", &Campaign::audit_every, "audited: one problem in",
     "run one problem in so many exactly though nothing is suspected", "Existence included; 1 audits all"},
    {"lemke_every", &Campaign::lemke_every, "by Lemke’s method too, of the suspicions: one in"},
    {"enumerate_every", &Campaign::enumerate_every, "all modes tried, of exact runs of few contacts: one in",
     "try all contact modes of one problem in so many", "Of those of few contacts that are run exactly"},
    {"representatives_per_unit", &Campaign::representatives_per_unit, "new representatives per unit, at most"},
    {"max_drives", [](Campaign& c) -> std::int64_t& { return c.limits.drives; }, "budget, drives"},
    {"max_pivots", [](Campaign& c) -> std::int64_t& { return c.limits.pivots; }, "budget, pivots"},
    {"max_bits", [](Campaign& c) -> std::int64_t& { return c.limits.bits; }, "budget, bits of a number"},
    {"complete_every", &Campaign::complete_every, "given to complete driving, of the suspicions: one in", "",
     "", FieldUse::kDefines, 1, kMostOfField, 1},
    {"enumerate_contacts", &Campaign::enumerate_contacts, "all modes tried, of at most so many contacts",
     "the most contacts of a problem whose modes are all tried",
     "By default 3; each more takes four times as long", FieldUse::kDefines, 1, 6, kMostContactsEnumerated},
    {"arithmetic", &kArithmeticForm},
    {"gravity_only", &Campaign::gravity_only, "bodies under gravity alone",
     "bodies without applied forces: of generators of bodies"},
    {"no_leaks", &Campaign::no_leaks, "leaks are not looked for",
     "do not look whether a solver under test leaks",
     "As for one that declares \"leaks\": false: its memory may grow for long until it is collected"},
    {"objective", &kObjectiveForm},
    {"optimizer", &kOptimizerForm},
    {"parents", &kParentsForm},
    {"solver", &kSolverForm, "solver under test"},
    {"note", &Campaign::note, "note", "one line that says why this is searched",
     "Told by status and reports; the same search with another note is the same", FieldUse::kRemark},
});

Campaign ReadCampaign(const std::filesystem::path& file);
// The same of a text; `source` names it in errors.
Campaign ParseCampaign(const std::string& text, const std::string& source);
// InputError if what it asks for does not fit together: a generator and its friction coefficients or its
// gravity, an objective and its policies.
void RequireConsistent(const Campaign& campaign);
// As a new search takes it: units begin small unless it says otherwise. Those of an optimizer are all alike.
Campaign AsBegun(Campaign campaign);
// The same for a store, which, if it is from before units began small, goes on as it began.
Campaign AsBegunIn(const std::filesystem::path& store, const Campaign& campaign);
inline Surroundings SurroundingsOf(const Campaign& campaign) {
  return {campaign.palette, campaign.gravity_only};
}
// The campaign of a store. InputError if it holds none.
Campaign CampaignOf(const CampaignIdentity& identity, const std::string& source);
// Everything but the seed, the policies and remarks, canonical; and the whole, as a file.
Json DefinitionToJson(const Campaign& campaign);
SharedJson ToJson(const Campaign& campaign);
// Of a campaign file (cli/schema.h).
std::string ShapeOfCampaign();
CampaignIdentity IdentityOf(const Campaign& campaign);

// A unit tries one generator at one size.
struct Task {
  GeneratorId generator;
  int contacts;
};
// Units go round the generators and sizes; two, three and four contacts come more often (8, 4 and 2 times).
std::vector<Task> Schedule(const Campaign& campaign);

Task TaskOf(const std::vector<Task>& schedule, std::int64_t unit);

// The first units try each family, a generator at one size, once.
std::int64_t FamilyCount(const Campaign& campaign);

// Problems of a unit: half as many for each contact beyond two, so that no unit takes long; fewer at the
// beginning (first_unit_problems).
std::int64_t UnitProblems(const Campaign& campaign, const Task& task, std::int64_t unit);
// The least number of units, counted from 0, that hold so many problems.
std::int64_t UnitsFor(const Campaign& campaign, std::int64_t problems);

// "1/2" or "0.5" -> MuChoice; InputError otherwise.
MuChoice ParseMu(const std::string& text);
MuChoice ReadMu(const JsonPlace& place);
// double, filtered or exact; InputError otherwise.
Arithmetic ParseSearchArithmetic(const std::string& text);
GeneratorId ReadGenerator(const JsonPlace& place);

}  // namespace stiction
