// SPDX-License-Identifier: Apache-2.0
// Optimized searches: every candidate is a problem, every value is exact, and nothing depends on threads or
// kills.

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <set>

#include "certify/claims/condition.h"
#include "certify/exact/exact.h"
#include "certify/exact/properties.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "scene/polygon.h"
#include "search/adversary/optimized_unit.h"
#include "search/adversary/trial.h"
#include "search/search.h"
#include "search/summary.h"
#include "tests/scratch.h"
#include "tests/support.h"

namespace stiction {
namespace {

using testing::ReferenceProblem;

Optimization Problem(const char* objective, GeneratorId generator, int contacts, std::int64_t evaluations,
                     std::uint64_t seed = 1) {
  Optimization o;
  o.objective = FindObjective(objective);
  REQUIRE(o.objective != nullptr);
  o.like = {generator, contacts, {1, 1}, false, {}};
  o.palette = {{1, 1}};
  o.evaluations = evaluations;
  o.seed = seed;
  o.limits = Campaign().limits;
  return o;
}

double Exactly(const char* objective, const ExactProblem& problem) {
  ExactTrial trial(problem, {}, Campaign().limits);
  const auto value = FindObjective(objective)->exact(trial);
  REQUIRE(value.has_value());
  return *value;
}

// ---- Candidates --------------------------------------------------------------------------------

TEST_CASE("adversary: any integers are a candidate, over doubles and rationals, and come back from JSON") {
  Choices random(3);
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;
    for (int contacts = 1; contacts <= 4; ++contacts) {
      CAPTURE(row.name, contacts);
      const bool quiet = row.has_gravity && contacts % 2 == 0;
      Candidate candidate{row.id, contacts, {3, 7}, quiet, {}};
      for (int k = 0; k < 60; ++k) candidate.choices.push_back(random.Integer(-2000, 2000));
      const ExactProblem exact = ExactOf(candidate);
      REQUIRE(IsSymmetric(exact));
      for (const auto& contact : exact.contacts) REQUIRE(contact.mu == Rational(3, 7));
      std::vector<Choice> made;
      const ContactProblem<double> rounded = RoundedOf(candidate, &made);
      const double A = rounded.A.cwiseAbs().maxCoeff(), b = rounded.b.cwiseAbs().maxCoeff();
      for (int i = 0; i < exact.rows(); ++i) {
        REQUIRE(std::abs(rounded.b[i] - ToDouble(exact.b[i])) <= 1e-9 * std::max(1.0, b));
        for (int j = 0; j < exact.rows(); ++j)
          REQUIRE(std::abs(rounded.A(i, j) - ToDouble(exact.A(i, j))) <= 1e-9 * std::max(1.0, A));
      }
      for (const Choice& choice : made) REQUIRE((choice.low <= choice.value && choice.value <= choice.high));
      Candidate clamped = candidate;
      clamped.choices = ValuesOf(made);
      const ExactProblem again = ExactOf(clamped);
      REQUIRE((again.A == exact.A && again.b == exact.b));
      const Json json = ToJson(candidate);
      const std::string source = "test";
      REQUIRE(CandidateFromJson(JsonPlace(json, source, "")) == candidate);
      const ProblemFile file = FileOf(candidate, "candidate");
      REQUIRE(bool(file.scene) == (row.id == GeneratorId::kScenes || row.id == GeneratorId::kFineScenes));
      REQUIRE(file.problem.dense().A == exact.A);
    }
  }
}

TEST_CASE("adversary: friction is lowered to the simplest coefficient of its range, and never to zero") {
  for (const MuChoice mu : {MuChoice{1, 1}, MuChoice{1, 11}, MuChoice{4, 55}, MuChoice{999, 1000}}) {
    for (int k = 1; k <= 12; ++k) {
      const MuChoice lowered = Lowered(mu, k, 1'000'000);
      const Rational old = Rational(mu.numerator) / Rational(mu.denominator);
      const Rational now = Rational(lowered.numerator) / Rational(lowered.denominator);
      const Rational part = 1 / Rational(mpz_class(1) << k);
      CAPTURE(mu.numerator, mu.denominator, k, ToString(now));
      CHECK(now > 0);
      CHECK(now <= old * (1 - part));
      CHECK(now >= old * (k == 1 ? Rational(1, 4) : Rational(1 - 2 * part)));
      for (int q = 1; q < lowered.denominator; ++q) {  // nothing simpler is in the range
        const mpz_class p =
            mpz_class(Rational(old * (1 - part) * q).get_num() / Rational(old * (1 - part) * q).get_den());
        const Rational simpler = Rational(p) / q;
        REQUIRE_FALSE((simpler >= old * (k == 1 ? Rational(1, 4) : Rational(1 - 2 * part)) && simpler > 0));
      }
    }
  }
  CHECK(Lowered({0, 1}, 3, 64) == MuChoice{0, 1});
  CHECK(Lowered({1, 1'000'000}, 12, 1'000'000) == MuChoice{1, 1'000'000});  // no room for its parts: it stays
  CHECK(SimplestNear(Rational(333333, 1000000), {1, 1}, 64) == MuChoice{1, 3});
  CHECK(SimplestNear(0, {1, 2}, 64) == MuChoice{1, 2});
}

// ---- Objectives --------------------------------------------------------------------------------

TEST_CASE("adversary: objectives have names of their own, and say what they are") {
  std::set<std::string_view> names;
  for (const Objective& objective : Objectives()) {
    names.insert(objective.name);
    CHECK(FindObjective(objective.name)->name == objective.name);
    CHECK(objective.help.size() > 10);
    CHECK((objective.exact != nullptr) == !objective.of_solver);
    CHECK(std::abs(objective.sign) == 1);
  }
  CHECK(names.size() == Objectives().size());
  CHECK(FindObjective("nothing") == nullptr);
  CHECK(FindOptimizer("nothing") == nullptr);
}

TEST_CASE("adversary: the values of a known loop and of a known solution") {
  const ExactProblem loop = ReferenceProblem();
  const ExactRun run = RunExact(loop, {.limits = Campaign().limits});
  REQUIRE(run.verdict.outcome == Outcome::kCycle);
  CHECK(Exactly("period", loop) == static_cast<double>(run.verdict.period));
  CHECK(Exactly("start", loop) == static_cast<double>(run.verdict.start));
  CHECK(Exactly("friction", loop) == -1);
  CHECK(Exactly("distance", loop) == 0);
  const double condition = -Exactly("condition", loop);
  CHECK(condition > 5.828);  // safe below: certify/condition_number.md
  const double margin = Exactly("margin", loop);
  CHECK((margin > 0 && margin < 1));
  const ExactProblem solved = testing::GiveUpProblem();
  const ExactRun solving = RunExact(solved, {.limits = Campaign().limits});
  REQUIRE(solving.verdict.outcome == Outcome::kSolved);
  CHECK(Exactly("steps", solved) == static_cast<double>(solving.verdict.statistics.steps));
  CHECK(Exactly("give-ups", solved) == static_cast<double>(solving.verdict.statistics.give_ups));
  CHECK(Exactly("scans", solved) == static_cast<double>(solving.verdict.statistics.outer_scans));
  CHECK(Exactly("solutions", testing::ThreeSolutions()) == 3);
  CHECK(Exactly("ipopt", solved) >= 1);
  CHECK(Exactly("ipopt", solved) <= 21);
  ExactTrial trial(solved, {}, Campaign().limits);
  for (const char* of_loops : {"period", "start", "friction", "condition", "margin"})
    CHECK_FALSE(FindObjective(of_loops)->exact(trial).has_value());
}

// One part in a thousand of the margin of every decision: the same loop, whatever entry is moved.
TEST_CASE("adversary: a loop survives changes that are small beside its margin") {
  const ExactProblem loop = ReferenceProblem();
  const ExactRun run = RunExact(loop, {.limits = Campaign().limits});
  const Rational small = Rational(Exactly("margin", loop)) / 10000;
  for (int i = 0; i < loop.rows(); ++i) {
    for (int j = i; j < loop.rows(); ++j) {
      ExactProblem moved = loop;
      moved.A(i, j) += small;
      moved.A(j, i) = moved.A(i, j);
      const ExactRun again = RunExact(moved, {.limits = Campaign().limits});
      REQUIRE(again.verdict.outcome == Outcome::kCycle);
      REQUIRE(again.verdict.period == run.verdict.period);
    }
  }
}

// ---- Optimizers --------------------------------------------------------------------------------

TEST_CASE(
    "adversary: every optimizer repeats itself, keeps its budget, and its values are those of exact problems") {
  for (const OptimizerRow& optimizer : Optimizers()) {
    for (const char* objective : {"steps", "period", "friction", "bits", "margin"}) {
      CAPTURE(optimizer.name, objective);
      const Optimization o = Problem(objective, GeneratorId::kPsd, 2, 600);
      const Optimized first = optimizer.run(o), second = optimizer.run(o);
      CHECK(first.evaluations <= 600);
      CHECK(first.evaluations >= 590);
      REQUIRE(!first.elites.empty());
      REQUIRE(first.elites.size() == second.elites.size());
      for (std::size_t i = 0; i < first.elites.size(); ++i) {
        const Assessed &mine = first.elites[i], &other = second.elites[i];
        REQUIRE(mine.candidate == other.candidate);
        REQUIRE_FALSE((i > 0 && first.elites[i - 1].worth < mine.worth));
        if (!mine.worth.value) continue;
        REQUIRE(mine.confirmed);
        ExactTrial trial(ExactOf(mine.candidate), o.policy, o.limits);
        REQUIRE(o.objective->exact(trial) == mine.worth.value);
      }
      for (const Assessed& loop : first.loops)
        REQUIRE(RunExact(ExactOf(loop.candidate), {.policy = o.policy, .limits = o.limits}).verdict.outcome ==
                Outcome::kCycle);
    }
  }
}

// ---- Frontiers (search/adversary/frontiers.md) ---------------------------------------------------

// The family of part 4, where friction forces are given in units of mu.
ExactProblem NearTheBound(const Rational& mu, const Rational& eta) {
  const Rational h = 2 + mu * mu, k = 2 * (1 + mu * mu) * eta, s = (1 + eta) / mu;
  ExactProblem problem;
  problem.contacts.resize(2);
  for (auto& contact : problem.contacts) contact.mu = mu;
  problem.A.resize(4, 4);
  problem.b.resize(4);
  const Rational f = h / (mu * mu), c = k / mu;
  problem.A << 1, s, 0, c, s, f, -c, 0, 0, -c, 1, s, c, 0, s, f;
  problem.b << eta, 1 / mu, -eta, 1 / mu;
  return problem;
}

TEST_CASE("adversary: loops come as near to the bound of the condition number as one likes") {
  for (const Rational& mu : {Rational(1, 10), Rational(1, 2), Rational(1), Rational(3)}) {
    const double m = ToDouble(mu), root = (1 + std::sqrt(1 + m * m)) / m;
    double before = 1e300;
    for (int k = 12; k <= 60; k += 8) {
      CAPTURE(ToString(mu), k);
      const ExactProblem problem = NearTheBound(mu, Rational(1) / Rational(mpz_class(1) << k));
      const ExactRun run = RunExact(problem, {.limits = Campaign().limits});
      REQUIRE(run.verdict.outcome == Outcome::kCycle);
      CHECK(run.verdict.start == 3);
      CHECK(run.verdict.period == 4);
      CHECK(run.verdict.statistics.give_ups >= 2);
      if (k > 30) continue;
      const auto condition = Condition(Rounded<double>(problem));
      REQUIRE(condition.has_value());
      const double excess = *condition / (root * root) - 1;
      CHECK(excess > 0);
      CHECK(excess < before / 64);  // eta falls by 2^8
      before = excess;
    }
  }
  CHECK(AllEndIn(Outcome::kCycle, NearTheBound(1, Rational(1, 10000)), PlanarGrid(), Campaign().limits));
}

// The body of part 3 with this friction and radius of inertia.
ExactProblem OneBody(const Rational& mu) {
  ExactMatrix J(4, 3);  // over the root of the masses
  J << Rational(-24, 25), Rational(7, 25), 6, Rational(-7, 25), Rational(-24, 25), -6 / mu,  //
      Rational(-4, 5), Rational(3, 5), 1, Rational(-3, 5), Rational(-4, 5), -5 / mu;
  ExactVector y(3);
  y << 4, 0, 1;
  ExactProblem problem;
  problem.contacts.resize(2);
  for (auto& contact : problem.contacts) contact.mu = mu;
  problem.A = J * J.transpose();
  problem.b = J * y;
  return problem;
}

TEST_CASE("adversary: one body loops at low friction") {
  for (const int k : {4, 10, 20, 40}) {
    const ExactRun run =
        RunExact(OneBody(Rational(1) / Rational(mpz_class(1) << k)), {.limits = Campaign().limits});
    CHECK(run.verdict.outcome == Outcome::kCycle);
    CHECK(run.verdict.start == 2);
    CHECK(run.verdict.period == 5);
  }
}

TEST_CASE("adversary: what is learned beats what is drawn at random", "[slow]") {
  const auto best = [](const char* optimizer, const char* objective) {
    const Optimized result = FindOptimizer(optimizer)->run(Problem(objective, GeneratorId::kPsd, 3, 8000));
    return result.elites.front().worth;
  };
  CHECK(best("random", "steps") < best("evolution", "steps"));
  if (testing::Short()) return;
  for (const char* optimizer : {"evolution", "nlopt", "continuation"}) {
    CAPTURE(optimizer);
    CHECK(best("random", "pivot") < best(optimizer, "pivot"));
  }
  CHECK(best("random", "friction") < best("evolution", "friction"));
}

TEST_CASE("adversary: a value over doubles that rationals deny is no value") {
  Attempt attempt(Problem("period", GeneratorId::kPsd, 2, 1));
  Assessed assessed = attempt.Look(RandomCandidate({GeneratorId::kPsd, 2, {1, 1}, false, {}}, 7));
  REQUIRE_FALSE(assessed.worth.value.has_value());  // it does not loop
  assessed.worth.value = 5;                         // what a mistaken run might say
  attempt.Confirm(assessed);
  CHECK_FALSE(assessed.worth.value.has_value());
  CHECK(attempt.found().denied == 1);
  CHECK(attempt.found().confirmations == 1);
  attempt.Confirm(assessed);
  CHECK(attempt.found().confirmations == 1);
  // One that they confirm is not denied.
  Attempt confirming(Problem("steps", GeneratorId::kPsd, 2, 1));
  Assessed confirmed = confirming.Look(RandomCandidate({GeneratorId::kPsd, 2, {1, 1}, false, {}}, 7));
  REQUIRE(confirmed.worth.value.has_value());
  confirming.Confirm(confirmed);
  CHECK(confirmed.worth.value.has_value());
  CHECK(confirming.found().confirmations == 1);
  CHECK(confirming.found().denied == 0);
}

TEST_CASE("adversary: elites keep one of every behaviour, the better one, and no more than there is room for") {
  Attempt attempt(Problem("steps", GeneratorId::kPsd, 2, 1));
  const auto make = [](std::int64_t behaviour, double value) {
    Assessed assessed;
    assessed.behaviour = {0, behaviour, 0, 0, 0};
    assessed.worth.value = value;
    assessed.confirmed = true;
    return assessed;
  };
  CHECK(attempt.Admit(make(1, 5)));
  CHECK_FALSE(attempt.Admit(make(1, 4)));
  CHECK(attempt.Admit(make(1, 5)));  // as good: it drifts
  CHECK(attempt.Admit(make(2, 1)));
  CHECK(attempt.found().elites.size() == 2);
  CHECK(*attempt.Best().worth.value == 5);
  for (std::size_t k = 3; k < 200; ++k)
    attempt.Admit(make(static_cast<std::int64_t>(k), static_cast<double>(k)));
  CHECK(attempt.found().elites.size() == Attempt::kMostElites);
  CHECK(*attempt.Best().worth.value == 199);
  CHECK_FALSE(attempt.Admit(make(1000, 0)));  // new, but the worst
}

// ---- Campaigns ---------------------------------------------------------------------------------

Campaign Adversarial(const char* objective, const char* optimizer) {
  Campaign campaign;
  campaign.generators = {GeneratorId::kPsd};
  campaign.contacts = {2};
  campaign.palette = {{1, 1}};
  campaign.unit_problems = 150;
  campaign.objective = objective;
  campaign.optimizer = optimizer;
  return campaign;
}

void Run(const Campaign& campaign, const std::filesystem::path& store, int threads, std::int64_t problems) {
  SearchOptions options;
  options.store = store;
  options.threads = threads;
  options.problems = problems;
  RunSearch(campaign, IdentityOf(campaign), options, [](const SearchProgress&) {});
}

void RequireEqualStores(const std::filesystem::path& left, const std::filesystem::path& right) {
  const Store mine = Store::OpenToRead(left), other = Store::OpenToRead(right);
  REQUIRE(mine.Elites() == other.Elites());
  REQUIRE(mine.Findings() == other.Findings());
  REQUIRE(mine.Total() == other.Total());
}

TEST_CASE("adversary: the same records on one thread and on three, at once and in pieces") {
  const testing::Scratch scratch;
  for (const char* optimizer : {"evolution", "continuation"}) {
    CAPTURE(optimizer);
    const Campaign campaign = Adversarial("friction", optimizer);
    const std::string name(optimizer);
    const auto alone = scratch / (name + "-1"), shared = scratch / (name + "-3"),
               pieces = scratch / (name + "-p");
    Run(campaign, alone, 1, 150 * 20);  // two epochs and a half
    Run(campaign, shared, 3, 150 * 20);
    RequireEqualStores(alone, shared);
    for (const std::int64_t units : {3, 9, 10, 20}) {
      SearchOptions hurried;  // gives units up in the middle
      hurried.store = pieces;
      hurried.threads = 2;
      hurried.minutes = 1e-4;
      hurried.problems = 150 * units;
      RunSearch(campaign, IdentityOf(campaign), hurried, [](const SearchProgress&) {});
      Run(campaign, pieces, 2, 150 * units);
    }
    RequireEqualStores(alone, pieces);
  }
}

TEST_CASE("adversary: parents are the best of earlier epochs, of the same task and shard") {
  Campaign campaign = Adversarial("steps", "evolution");
  campaign.contacts = {2, 5};  // several tasks
  const std::vector<Task> schedule = Schedule(campaign);
  const Shard shard{1, 3};
  Heritage heritage(campaign, shard);
  const auto elite = [&](std::int64_t unit, double value) {
    UnitElites elites;
    const Task task = TaskOf(schedule, unit);
    elites.elites.push_back({{task.generator, task.contacts, {1, 1}, false, {unit}}, {value, 0}});
    return elites;
  };
  for (std::int64_t unit = 0; unit < 200; ++unit)
    heritage.Add(unit, elite(unit, static_cast<double>(unit % 37)));
  CHECK(heritage.ParentsOf(1).empty());
  const std::int64_t later = 100;
  REQUIRE(shard.Owns(later));
  const auto parents = heritage.ParentsOf(later);
  REQUIRE(!parents.empty());
  std::map<int, double> last;  // by contacts: smaller ones are made larger
  for (const Candidate& parent : parents) {
    const std::int64_t unit = parent.choices.front();
    CHECK(shard.Owns(unit));
    CHECK(Heritage::EpochOf(unit, shard) < Heritage::EpochOf(later, shard));
    const int contacts = TaskOf(schedule, unit).contacts;
    CHECK(parent.contacts == contacts);
    CHECK(contacts <= TaskOf(schedule, later).contacts);
    const auto value = static_cast<double>(unit % 37);
    if (last.count(contacts) > 0) CHECK(value <= last[contacts]);
    last[contacts] = value;
  }
  CHECK(last.size() == (TaskOf(schedule, later).contacts == 5 ? 2 : 1));
}

TEST_CASE("adversary: a store says what was best, and no rate") {
  const testing::Scratch scratch;
  const Campaign campaign = Adversarial("period", "evolution");
  Run(campaign, scratch / "store", 2, 150 * 4);
  const Store store = Store::OpenToRead(scratch / "store");
  const auto best = BestOf(store, 1);
  REQUIRE(best.size() == 1);
  const std::string text = OptimizedText(store, "store");
  CHECK(text.find("objective period") != std::string::npos);
  CHECK(text.find("in a million") == std::string::npos);
  const Json json = SummaryToJson(store);
  CHECK(json.at("candidates").get<std::int64_t>() >= 590);
  if (best.front().worth.value)
    CHECK(json.at("best").at(0).at("value").get<double>() == *best.front().worth.value);
  for (const Finding& finding : store.Findings()) CHECK(finding.kind == "cycle");
}

TEST_CASE("search: progress counts what the store holds, begun or gone on with") {
  const testing::Scratch scratch;
  Campaign campaign;
  campaign.generators = {GeneratorId::kNearDegenerate};
  campaign.contacts = {2};
  campaign.unit_problems = 2000;
  for (const std::int64_t units : {4, 6}) {
    SearchOptions options;
    options.store = scratch / "store";
    options.problems = 2000 * units;
    options.finishing = 0;
    std::optional<std::int64_t> at_first;
    options.started = [&at_first](const SearchProgress& progress) { at_first = progress.findings; };
    const auto report = RunSearch(campaign, IdentityOf(campaign), options, [](const SearchProgress&) {});
    const Record total = Store::OpenToRead(options.store).Total();
    std::int64_t findings = 0;
    for (const auto& [signature, count] : total.signatures) findings += count;
    CHECK(findings > 0);
    CHECK(report.progress.findings == findings);
    CHECK(report.progress.groups == std::ssize(total.signatures));
    CHECK((units == 4 ? at_first == 0 : at_first > 0));
    CHECK(report.progress.units_done == units);
    CHECK(report.progress.units_wanted == units);
    CHECK(report.progress.problems == 2000 * units);
    CHECK(report.progress.problems_before == (units == 4 ? 0 : 8000));
  }
}

TEST_CASE("adversary: damaged elites are refused by their place") {
  const UnitElites elites{{{{GeneratorId::kPsd, 2, {1, 1}, false, {1, 2}}, {3.0, 0}}}, 10, 2, 1};
  const std::string text = ToText(elites);
  const UnitElites read = ElitesFromText(text, "store");
  REQUIRE(read.elites.size() == 1);
  CHECK(read.elites[0].candidate == elites.elites[0].candidate);
  CHECK(ToText(read) == text);
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"\"psd\"", "\"nothing\""},
                                                        {"[1,2]", "[1,true]"},
                                                        {"\"contacts\":2", "\"contacts\":99"},
                                                        {"\"value\":3.0", "\"value\":\"x\""},
                                                        {"\"denied\":1", "\"denied\":-1"},
                                                        {"\"1\"", "\"-1\""}}) {
    std::string damaged = text;
    REQUIRE(damaged.find(from) != std::string::npos);
    damaged.replace(damaged.find(from), from.size(), to);
    CAPTURE(damaged);
    CHECK_THROWS_AS(ElitesFromText(damaged, "store"), InputError);
  }
}

TEST_CASE("adversary: campaigns that cannot be are refused by name") {
  Campaign campaign = Adversarial("steps", "evolution");
  RequireConsistent(campaign);
  campaign.gravity_only = true;
  CHECK_THROWS_WITH(RequireConsistent(campaign), Catch::Contains("psd"));
  campaign.gravity_only = false;
  campaign.palette = {{1, 1000}};
  RequireConsistent(campaign);
  campaign.generators = {GeneratorId::kNearDegenerate};
  CHECK_THROWS_WITH(RequireConsistent(campaign),
                    Catch::Contains("near-degenerate") && Catch::Contains("1/1000"));
  campaign = Adversarial("steps", "evolution");
  campaign.policies = PlanarGrid();
  CHECK_THROWS_WITH(RequireConsistent(campaign), Catch::Contains("policies"));
}

// ---- Frontiers (search/adversary/frontiers.md) -------------------------------------------------

TEST_CASE("adversary: one contact never loops") {
  int problems = 0;
  std::int64_t most_drives = 0;
  for (int nn = 0; nn <= 2; ++nn) {
    for (int ff = 0; ff <= 2; ++ff) {
      for (int nf = -2; nf <= 2; ++nf) {
        for (int bn = -2; bn <= 2; ++bn) {
          for (int bf = -2; bf <= 2; ++bf) {
            for (const Rational& mu : {Rational(0), Rational(1, 3), Rational(1), Rational(4)}) {
              const ExactProblem problem = testing::MakeProblem({mu}, {{nn, nf}, {nf, ff}}, {bn, bf});
              if (!MeetsAssumptions(problem)) continue;
              ++problems;
              for (const PolicyClass& equal : RunPolicies(problem, PlanarGrid(), {})) {
                CAPTURE(nn, nf, ff, bn, bf, ToString(mu), PolicyName(equal.policies.front()));
                REQUIRE(equal.verdict.outcome == Outcome::kSolved);
                REQUIRE(equal.verdict.statistics.steps == equal.verdict.statistics.drives);
                REQUIRE(equal.verdict.statistics.give_ups == 0);
                most_drives = std::max(most_drives, equal.verdict.statistics.drives);
              }
            }
          }
        }
      }
    }
  }
  CHECK(problems > 1000);
  CHECK(most_drives == 2);
}

// k^2 = I / m and d^2 of a uniform triangle, with the contact at its first corner.
TEST_CASE("adversary: a corner of a uniform triangle folds at no mu up to 3/4, and a thin one just above") {
  using Point = Vector2<Rational>;
  const auto quotient = [](const Point& p, const Point& q, const Point& r, const Point& normal) {
    BodyShape<Rational> shape;
    shape.corners = {p, q, r};
    const auto properties = MassPropertiesOf({shape});
    const Rational k2 = properties.inertia / properties.mass - properties.center.dot(properties.center);
    const Point arm = properties.center - p;
    const Rational y = arm.dot(normal), x = Cross<Rational>(normal, arm);
    return x * y == 0 ? Rational(1000) : Rational((k2 + x * x) / abs(Rational(x * y)));
  };
  Choices random(5);
  const auto point = [&random] {
    return MakeVector2<Rational>(Rational(random.Integer(-20, 20)), Rational(random.Integer(-20, 20)));
  };
  for (int k = 0; k < 2000; ++k) {
    Point p = point(), q = point(), r = point();
    const Rational area = Cross<Rational>(Point(q - p), Point(r - p));
    if (area == 0) continue;
    if (area < 0) std::swap(q, r);
    for (const auto& [nx, ny] : {std::pair(3, 4), std::pair(-7, 24), std::pair(0, 1), std::pair(5, -12)}) {
      const int length = nx == 0 ? 1 : nx == 3 ? 5 : nx == 5 ? 13 : 25;
      const Point normal = MakeVector2<Rational>(Rational(nx) / length, Rational(ny) / length);
      REQUIRE(quotient(p, q, r, normal) > Rational(3, 4));
    }
  }
  // Height 10 along (1, 3), half a base of 1/10 across.
  const Point apex = MakeVector2<Rational>(Rational(0), Rational(0)),
              up = MakeVector2<Rational>(Rational(0), Rational(1));
  const Point left = MakeVector2<Rational>(Rational(97, 10), Rational(301, 10)),
              right = MakeVector2<Rational>(Rational(103, 10), Rational(299, 10));
  const Rational thin = quotient(apex, right, left, up);
  CHECK(thin > Rational(3, 4));
  CHECK(thin < Rational(3001, 4000));
}

}  // namespace
}  // namespace stiction
