// SPDX-License-Identifier: Apache-2.0
#include "search/testimony.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "corpus/json_text.h"
#include "corpus/rational.h"
#include "corpus/record/digest.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "search/adversary/candidate.h"
#include "search/adversary/optimized_unit.h"
#include "solver/problem/solution.h"

namespace stiction {
namespace {

bool IsOutcome(std::string_view text) { return std::ranges::count(kOutcomeNames, text) > 0; }

bool IsKind(std::string_view text) {
  return text == kSafeCycle || text == kDisagreementOfMethods || text == "wrong-answer" ||
         text == "disagreement" || IsOutcome(text) || IsOfSolver(text);
}

// Refuses texts of one place.
class Witness {
 public:
  explicit Witness(std::string place) : place_(std::move(place)) {}

  const std::string& place() const { return place_; }
  void Require(bool holds, const char* what, const std::string& found, const std::string& expected) const {
    if (!holds) throw InputError(place_, what, found, expected);
  }
  void RequireOneOf(const char* what, std::string_view found, bool known, const char* expected) const {
    Require(known, what, fmt::format("'{}'", Shortened(std::string(found))), expected);
  }

 private:
  std::string place_;
};

void RequirePolicy(const Witness& witness, const std::string& name, const Campaign& campaign) {
  const auto is_this = [&name](const Policy& policy) { return PolicyName(policy) == name; };
  witness.RequireOneOf("policy", name, std::any_of(campaign.policies.begin(), campaign.policies.end(), is_this),
                       "one of the campaign's");
}

// ---- Findings --------------------------------------------------------------------------------

ExactProblem ReadStored(const Witness& witness, const char* what, const std::string& text) {
  const std::string source = witness.place() + ": " + what;
  return ParseProblem(text, source).problem;
}

// Of the problem, to the digest; which claim it makes is for the checkers.
void RequireCertificate(const Witness& witness, const char* what, const std::string& text,
                        const ExactProblem& problem) {
  if (text.empty()) return;
  const std::string source = witness.place() + ": " + what;
  const JsonPlace root(text, source);
  root.RequireObject();
  root.AllowKeys({"format", "version", "claim", "problem", "witness"});
  root.RequireFormat("stiction-certificate");
  root.Required("claim", "a claim").Text("a claim");
  root.Required("witness", "a witness");
  const JsonPlace stated = root.Required("problem", "a problem");
  const std::string digest = ProblemDigest(ProblemFromJson(stated.json(), source, "problem", /*strict=*/true));
  const std::string expected = ProblemDigest(problem);
  witness.Require(digest == expected, what, "the certificate of " + digest, expected);
}

void RequireRunFacts(const JsonPlace& facts, std::int64_t contacts) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  facts.RequireObject();
  facts.AllowKeys({"contacts", "outcome", "start", "period", "steps", "grid", "safe", "existence"});
  facts.Required("contacts", "a number of contacts").Integer(contacts, contacts, fmt::format("{}", contacts));
  const JsonPlace outcome = facts.Required("outcome", "an outcome");
  if (!IsOutcome(outcome.Text("an outcome"))) outcome.Refuse("an outcome");
  for (const char* key : {"start", "period", "steps"})
    facts.Required(key, "a count").Integer(0, kMost, "a count");
  for (const auto& [name, count] : facts.Required("grid", "policies by outcome").Members()) {
    if (!IsOutcome(name)) count.Refuse(name, "an outcome");
    count.Integer(0, kMost, "a count");
  }
  if (const auto safe = facts.Optional("safe"); safe && !safe->IsNull()) safe->Truth("true, false or null");
  const JsonPlace existence = facts.Required("existence", "what is known of a solution");
  existence.RequireObject();
  existence.AllowKeys({"claim", "method", "pieces", "folds", "descents"});
  const JsonPlace claim = existence.Required("claim", "a claim or null");
  if (!claim.IsNull()) claim.Text("a claim or null");
}

// Of a solver under test.
void RequireSolverFacts(const Witness& witness, const Finding& finding, bool has_minimized) {
  const std::string source = witness.place() + ": facts";
  const JsonPlace root(finding.facts, source);
  root.RequireObject();
  root.AllowKeys({"library", "found", "minimized", "alone", "scene"});
  if (const auto library = root.Optional("library")) library->Truth();
  root.Required("found", "facts of the problem as found").RequireObject();
  const auto alone = root.Optional("alone"), small = root.Optional("minimized");
  witness.Require(alone.has_value() == finding.done, "facts", alone ? "those of a finished finding" : "others",
                  "whether its problem alone shows it, of a finished finding and only there");
  if (alone) alone->Truth();
  witness.Require(small.has_value() == has_minimized, "facts", small ? "those of a minimized problem" : "none",
                  "those of a minimized problem where there is one, and only there");
  if (const auto scene = root.Optional("scene")) CandidateFromJson(*scene);
  if (!small) return;
  small->RequireObject();
  small->Required("contacts", "a number of contacts")
      .Integer(0, finding.contacts, "at most as many as were found");
}

void RequireFacts(const Witness& witness, const Finding& finding, const ExactProblem* minimized) {
  if (IsOfSolver(finding.kind)) return RequireSolverFacts(witness, finding, minimized != nullptr);
  if (finding.facts.empty())
    return witness.Require(!finding.done, "facts", "none", "those of a finished finding");
  const std::string source = witness.place() + ": facts";
  const JsonPlace root(finding.facts, source);
  root.RequireObject();
  root.AllowKeys({"found", "minimized", "disagreement", "answers", "ipopt"});
  if (const auto ipopt = root.Optional("ipopt")) {
    ipopt->RequireObject();
    ipopt->AllowKeys({"outcome", "starts"});
    ipopt->Required("outcome", "an outcome of Ipopt").Text("an outcome of Ipopt");
    ipopt->Required("starts", "a count").Integer(0, std::int64_t{1} << 53, "a count");
  }
  if (const auto reason = root.Optional("disagreement")) reason->Text("a reason");
  const auto found = root.Optional("found"), small = root.Optional("minimized");
  if (finding.done || found)
    RequireRunFacts(root.Required("found", "facts of the problem as found"), finding.contacts);
  witness.Require(small.has_value() == (minimized != nullptr), "facts",
                  small ? "those of a minimized problem" : "none",
                  "those of a minimized problem where there is one, and only there");
  if (small) RequireRunFacts(*small, static_cast<std::int64_t>(minimized->contacts.size()));
}

// ---- Statistics ------------------------------------------------------------------------------

template <class Counts>
std::int64_t Sum(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

bool IsFriction(const std::string& name, const Campaign& campaign) {
  return name == kMixedFriction ||
         std::any_of(campaign.palette.begin(), campaign.palette.end(), [&name](const MuChoice& mu) {
           return ToString(Rational(mu.numerator) / Rational(mu.denominator)) == name;
         });
}

// Of a tally: the campaign has its generator and number of contacts.
void RequireFamily(const Witness& witness, const std::string& generator, int contacts,
                   const Campaign& campaign) {
  const auto id = FindGenerator(generator);
  witness.RequireOneOf("generator", generator, id && std::ranges::count(campaign.generators, *id) > 0,
                       "one of the campaign's");
  witness.Require(std::ranges::count(campaign.contacts, contacts) > 0, "contacts", std::to_string(contacts),
                  "one of the campaign's");
}

// What strata count adds up to what the tally counts.
void RequireStrata(const Witness& witness, const TallyKey& key, const Tally& tally, const Campaign& campaign) {
  Stratum sum;
  for (const auto& [stratum_key, stratum] : tally.strata) {
    witness.RequireOneOf("friction", stratum_key.friction, IsFriction(stratum_key.friction, campaign),
                         "one of the campaign's");
    const int rows =
        (FindGenerator(key.generator) && Row(*FindGenerator(key.generator)).InSpace() ? 3 : 2) * key.contacts;
    witness.Require(stratum_key.rank <= rows, "rank", std::to_string(stratum_key.rank),
                    fmt::format("at most {}", rows));
    sum.Merge(stratum);
  }
  Tally::Outcomes exact = {};
  for (const auto& row : tally.verdicts) {
    for (std::size_t i = 0; i < row.size(); ++i) exact[i] += row[i];
  }
  const bool adds_up = sum.problems == tally.problems && sum.outcomes == tally.outcomes && sum.exact == exact &&
                       sum.audited == tally.audited && sum.misjudged == tally.misjudged &&
                       sum.steps == tally.sums.steps && sum.zero_steps == tally.sums.zero_steps;
  witness.Require(adds_up, "strata", "other sums", "counts that add up to those of all problems");
}

void RequireTally(const TallyKey& key, const Tally& tally, const Campaign& campaign, const std::string& file) {
  const Witness witness(fmt::format("{}: statistics of {} of {} contacts, {}", file, Shortened(key.generator),
                                    key.contacts, Shortened(key.policy)));
  RequireFamily(witness, key.generator, key.contacts, campaign);
  RequirePolicy(witness, key.policy, campaign);
  witness.RequireOneOf("method", key.method, key.method == "baraff", "baraff");
  witness.RequireOneOf("arithmetic", key.arithmetic, key.arithmetic == Name(campaign.arithmetic),
                       "the campaign's");
  const auto at_most = [&](const char* what, std::int64_t count, std::int64_t most) {
    witness.Require(count <= most, what, std::to_string(count), fmt::format("at most {}", most));
  };
  const auto as_many = [&](const char* what, std::int64_t count) {
    witness.Require(count == tally.problems, what, fmt::format("{} in all", count),
                    fmt::format("as many as problems, {}", tally.problems));
  };
  as_many("outcomes", Sum(tally.outcomes));
  as_many("steps", Sum(tally.steps));
  at_most("misjudged", tally.misjudged, tally.audited);
  at_most("wrong", tally.wrong, tally.problems);
  at_most("with_zero_steps", tally.with_zero_steps, tally.problems);
  at_most("with_give_ups", tally.with_give_ups, tally.problems);
  at_most("audited", tally.audited, tally.problems);
  RequireStrata(witness, key, tally, campaign);
}

// Every problem came to one end, but for leaks, which are seen beside it.
void RequireUnderTest(const Witness& witness, const UnderTestKey& key, const UnderTestTally& tally,
                      const Campaign& campaign) {
  RequireFamily(witness, key.generator, key.contacts, campaign);
  witness.RequireOneOf("friction", key.friction, IsFriction(key.friction, campaign), "one of the campaign's");
  std::int64_t ends = 0;
  ForEachCounter(tally, [&ends](std::string_view name, std::int64_t count) {
    const bool is_beside = name == "leak" || name == "misses_coulomb" || name == "neither";
    if (name != "problems" && !is_beside) ends += count;
  });
  witness.Require(ends == tally.problems, "under_test", fmt::format("{} ends", ends),
                  fmt::format("as many as problems, {}", tally.problems));
}

void RequireLoops(const Witness& witness, int contacts, const LoopTally& tally) {
  const auto at_most = [&](const char* what, std::int64_t count, std::int64_t most) {
    witness.Require(count <= most, "loops", fmt::format("{} {} of {} contacts", count, what, contacts),
                    fmt::format("at most {}", most));
  };
  at_most("without zero steps", tally.without_zero_steps, tally.loops);
  at_most("of zero steps alone", tally.of_zero_steps_alone, tally.loops);
  at_most("zero steps", tally.zero_steps, tally.steps);
  std::int64_t loops = 0;
  for (const auto& [zero_steps, count] : tally.by_zero_steps) loops += count;
  witness.Require(loops == tally.loops, "loops", fmt::format("{} by their zero steps", loops),
                  fmt::format("{} of {} contacts", tally.loops, contacts));
}

}  // namespace

void RequireSound(const Finding& finding, const Campaign& campaign, const std::string& file) {
  const Witness witness(fmt::format("{}: finding {}", file, Shortened(finding.signature, 100)));
  witness.RequireOneOf("kind", finding.kind,
                       IsKind(finding.kind) && IsOfSolver(finding.kind) == !campaign.solver.name.empty(),
                       "a kind of findings of its campaign");
  witness.RequireOneOf("signature", finding.signature, IsKind(KindOf(finding.signature)),
                       "one that begins with a kind");
  const auto in_range = [&witness](const char* what, std::int64_t number) {
    witness.Require(number >= 0 && number < std::int64_t{1} << 62, what, std::to_string(number), "0 or more");
  };
  in_range("unit", finding.unit);
  in_range("index", finding.index);
  const Task task = TaskOf(Schedule(campaign), finding.unit);
  witness.RequireOneOf("generator", finding.generator, finding.generator == Row(task.generator).name,
                       "that of its unit");
  witness.Require(finding.contacts == task.contacts, "contacts", std::to_string(finding.contacts),
                  fmt::format("{}, as its unit has", task.contacts));
  RequirePolicy(witness, finding.policy, campaign);
  witness.RequireOneOf("inexact_outcome", finding.inexact_outcome, IsOutcome(finding.inexact_outcome),
                       "an outcome");
  witness.RequireOneOf("exact_outcome", finding.exact_outcome, IsOutcome(finding.exact_outcome), "an outcome");
  const ExactProblem problem = ReadStored(witness, "problem", finding.problem);
  witness.Require(static_cast<int>(problem.contacts.size()) == finding.contacts, "problem",
                  fmt::format("{} contacts", problem.contacts.size()), std::to_string(finding.contacts));
  std::optional<ExactProblem> minimized;
  if (!finding.minimized.empty()) minimized = ReadStored(witness, "minimized", finding.minimized);
  RequireCertificate(witness, "certificate", finding.certificate, problem);
  RequireCertificate(witness, "existence", finding.existence, problem);
  for (const auto& [what, text] : {std::pair("minimized_certificate", &finding.minimized_certificate),
                                   std::pair("minimized_existence", &finding.minimized_existence)}) {
    witness.Require(text->empty() || minimized, what, "one", "none without a minimized problem");
    if (minimized) RequireCertificate(witness, what, *text, *minimized);
  }
  RequireFacts(witness, finding, minimized ? &*minimized : nullptr);
}

void RequireSound(const Record& total, const Campaign& campaign, const std::string& file) {
  total.ForEachTally(
      [&](const TallyKey& key, const Tally& tally) { RequireTally(key, tally, campaign, file); });
  const Witness witness(file);
  for (const auto& [signature, count] : total.signatures) {
    witness.RequireOneOf("signatures", signature, IsKind(KindOf(signature)),
                         "signatures that begin with a kind");
  }
  const bool tests = !campaign.solver.name.empty();
  witness.Require(tests ? total.tallies.empty() : total.under_test.empty(), "statistics",
                  tests ? "runs of the published algorithm" : "answers of a solver under test",
                  "what the campaign leaves");
  for (const auto& [key, tally] : total.under_test) RequireUnderTest(witness, key, tally, campaign);
  const auto is_size = [&campaign](int contacts) {
    return std::ranges::count(campaign.contacts, contacts) > 0;
  };
  for (const auto& [contacts, tally] : total.existence) {
    witness.Require(is_size(contacts), "existence", fmt::format("{} contacts", contacts),
                    "a size of the campaign's");
    witness.Require(tally.solved <= tally.problems, "existence", fmt::format("{} solved", tally.solved),
                    fmt::format("at most {}", tally.problems));
  }
  for (const auto& [contacts, tally] : total.loops) RequireLoops(witness, contacts, tally);
  for (const auto& [signature, sketch] : total.words) {
    const auto met = total.signatures.find(signature);
    witness.RequireOneOf("words", signature, met != total.signatures.end(), "signatures that were met");
    witness.Require(static_cast<std::int64_t>(sketch.hashes().size()) <= met->second, "words",
                    fmt::format("{} of {}", sketch.hashes().size(), Shortened(signature, 100)),
                    fmt::format("at most {}, the loops that were met", met->second));
  }
  for (const auto& [contacts, tally] : total.agreement)
    witness.Require(is_size(contacts), "agreement", fmt::format("{} contacts", contacts),
                    "a size of the campaign's");
}

void RequireSound(const Store& store, const std::string& file, const ShowFindings& show) {
  const Campaign campaign = CampaignOf(store.identity(), file);
  RequireSound(store.Total(), campaign, file);
  const std::vector<Finding> findings = store.Findings();
  const auto of = static_cast<std::int64_t>(findings.size());
  for (std::int64_t done = 0; done < of; ++done) {
    RequireSound(findings[static_cast<std::size_t>(done)], campaign, file);
    if (show) show(done + 1, of);
  }
  for (const auto& [unit, text] : store.Elites())
    ElitesFromText(text, fmt::format("{}: elites of unit {}", file, unit));
}

Store OpenSound(const std::string& file, const ShowFindings& show) {
  Store store = Store::OpenToRead(file);
  RequireSound(store, file, show);
  return store;
}

}  // namespace stiction
