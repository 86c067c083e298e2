// SPDX-License-Identifier: Apache-2.0
// Walks drawn anew, as many as STICTION_MODEL says (by default what takes twenty seconds), of
// STICTION_MODEL_SEED from number STICTION_MODEL_FIRST on, their ends through every method and arithmetic; what
// is false is shrunk and printed. Campaigns in shards. And that each check sees what once was false, or what is
// altered.

#include <catch2/catch.hpp>
#include <cstdlib>

#include "search/search.h"
#include "tests/model/hold.h"

namespace stiction {
namespace {

using namespace testing;

std::int64_t Asked(const char* name, std::int64_t usual) {
  const char* text = std::getenv(name);
  return text == nullptr ? usual : std::atoll(text);
}

std::uint64_t AskedSeed() { return static_cast<std::uint64_t>(Asked("STICTION_MODEL_SEED", 1)); }

TEST_CASE("model: nothing false is said of problems drawn at random, nor of what is made of them") {
  const std::int64_t walks = Asked("STICTION_MODEL", Few(400)), first = Asked("STICTION_MODEL_FIRST", 0);
  int faults = 0;
  Shares shares;
  for (std::int64_t index = first; index < first + walks && faults < 5; ++index) {
    std::vector<Choice> record;
    Choices choices(ProblemSeed(AskedSeed(), 0, static_cast<std::uint64_t>(index)), &record);
    Walk walk;
    if (!FaultOfDraw(choices, walk, &shares)) continue;
    ++faults;
    FAIL_CHECK(Told(ValuesOf(record)) << "\nSTICTION_MODEL=1 STICTION_MODEL_SEED=" << AskedSeed()
                                      << " STICTION_MODEL_FIRST=" << index
                                      << " build/release/tests/test_model");
  }
  CHECK(FaultOfShares(shares) == "");
}

// ---- Campaigns ---------------------------------------------------------------------------------------

Campaign DrawCampaign(Choices& choices) {
  Campaign campaign;
  campaign.seed = static_cast<std::uint64_t>(choices.Integer(1, 1000000));
  campaign.generators = {static_cast<GeneratorId>(choices.Integer(0, kOrdinaryGeneratorCount - 1)),
                         static_cast<GeneratorId>(choices.Integer(0, kOrdinaryGeneratorCount - 1))};
  if (campaign.generators[0] == campaign.generators[1]) campaign.generators.pop_back();
  campaign.contacts = {static_cast<int>(choices.Integer(1, 2)), 3};
  if (choices.Integer(0, 1) == 1) campaign.policies = {RandomPolicy(choices)};
  campaign.unit_problems = choices.Integer(20, 2000);
  campaign.audit_every = campaign.complete_every = campaign.lemke_every = choices.Integer(10, 1000);
  campaign.representatives_per_unit = choices.Integer(1, 4);
  return campaign;
}

// The stores of the shards of a campaign, the work of each done in two parts; one shard is the whole.
std::vector<std::filesystem::path> RunInShards(const Scratch& scratch, const Campaign& campaign, int shards,
                                               std::int64_t problems, int threads) {
  std::vector<std::filesystem::path> stores;
  for (int k = 0; k < shards; ++k) {
    stores.push_back(scratch / fmt::format("{}-of-{}", k, shards));
    SearchOptions options;
    options.store = stores.back();
    options.shard = {k, shards};
    options.threads = threads;
    options.finishing = 0;
    for (const std::int64_t part : {problems / 3, problems}) {
      options.problems = part;
      RunSearch(campaign, IdentityOf(campaign), options, [](const SearchProgress&) {});
    }
  }
  return stores;
}

bool AreAlike(const Store& left, const Store& right) {
  return left.Units().Count() == right.Units().Count() && left.Total() == right.Total() &&
         left.Findings() == right.Findings();
}

TEST_CASE("model: shards of a campaign, merged in any order, are the campaign run whole") {
  for (std::uint64_t index = 0; index < 4; ++index) {
    Choices choices(ProblemSeed(AskedSeed(), 1, index));
    const Scratch scratch;
    const Campaign campaign = DrawCampaign(choices);
    const std::int64_t problems = campaign.unit_problems * choices.Integer(8, 15);
    CAPTURE(AskedSeed(), index);
    const auto whole = RunInShards(scratch, campaign, 1, problems, 2);
    auto parts = RunInShards(scratch, campaign, static_cast<int>(choices.Integer(2, 4)), problems, 1);
    std::swap(parts.front(), parts[choices.Integer(0, static_cast<std::int64_t>(parts.size()) - 1)]);
    Store merged(scratch / "merged", IdentityOf(campaign));
    for (const auto& part : parts) {
      CHECK_FALSE(AreAlike(merged, Store::OpenToRead(whole.front())));
      merged.MergeFrom(Store::OpenToRead(part));
    }
    CHECK(AreAlike(merged, Store::OpenToRead(whole.front())));
  }
}

// ---- The checks themselves -----------------------------------------------------------------------------

std::string Kind(const std::string& fault) { return Fault{fault}.Kind(); }

ExactProblem SolvableProblem() {
  return MakeProblem({-1, -1}, {{Rational(25, 81), Rational(10, 27)}, {Rational(10, 27), Rational(4, 9)}},
                     {Rational(-10, 9), Rational(-4, 3)});
}

// Answers altered as programs once were wrong.
TEST_CASE("model: an answer that proves a falsehood, decides nothing, or is of another problem is seen") {
  const ExactProblem problem = SolvableProblem();
  const Truth truth = TruthOf(problem);
  REQUIRE(truth.solvable);
  const auto kind_of = [&](const Truth& known, const auto& answer, Arithmetic arithmetic) {
    return Kind(FaultOfAnswer(problem, known, {RequestFor("complete", arithmetic)}, {.answer = answer}));
  };
  ExactAnswer none;
  none.method = "enumerate";
  none.outcome = Outcome::kNoSolution;
  CHECK(kind_of(truth, none, Arithmetic::kDouble) == "falsehood");
  ExactAnswer open;
  open.method = "complete";
  CHECK(kind_of(truth, open, Arithmetic::kExact) == "open");
  CHECK(kind_of(truth, open, Arithmetic::kInterval) == "");
  open.outcome = Outcome::kRay;
  CHECK(kind_of(truth, open, Arithmetic::kExact) == "undecided");
  open.ray = Vector({1, 1});
  CHECK(kind_of(truth, open, Arithmetic::kExact) == "ray");
  ExactAnswer right = open;
  right.outcome = Outcome::kSolved;
  right.f = truth.f;
  right.a = Accelerations(problem, truth.f);
  CHECK(kind_of(truth, right, Arithmetic::kExact) == "");
  CHECK(kind_of({true, false}, right, Arithmetic::kExact) == "falsehood");
  right.a[0] += 1;
  CHECK(kind_of(truth, right, Arithmetic::kExact) == "inexact");
  right.method = "?";
  right.a[0] -= 1;
  CHECK(kind_of(truth, right, Arithmetic::kExact) == "name");
  InexactAnswer rounded;
  rounded.method = "complete";
  rounded.outcome = Outcome::kNoSolution;
  CHECK(kind_of(truth, rounded, Arithmetic::kDouble) == "rounded");
  rounded.outcome = Outcome::kSolved;
  rounded.arithmetic = Arithmetic::kDouble;
  rounded.f = Eigen::Vector2d(0, 0);
  CHECK(kind_of(truth, rounded, Arithmetic::kDouble) == "gate");
  rounded.outcome = Outcome::kUndecided;
  rounded.arithmetic = Arithmetic::kQuad;
  CHECK(kind_of(truth, rounded, Arithmetic::kDouble) == "name");
  CHECK(FaultIn({problem}, {true, false}).Kind() == "falsehood");
  CHECK(FaultIn({problem}, truth, [](auto&, auto&) { return "back: so it is"; }).Kind() == "back");
}

TEST_CASE("model: an operation that is none is seen") {
  const Case from{MakeProblem({1}, {{2, 1}, {1, 3}}, {-2, 1})};
  Case slides = from;
  slides.problem.contacts[0].kind = ContactKind::kSliding;
  slides.problem.contacts[0].slip[0] = 1;
  const ExactVector other = Vector({Rational(5, 4), Rational(-1, 2)});
  const auto kind_of = [&](const Case& start, const Step& step) {
    Truth truth = TruthOf(start.problem);
    REQUIRE(truth.solvable);
    return Kind(FaultOfStep(start.problem, step, other, truth));
  };
  const ExactMatrix flip = Matrix({{1, 0}, {0, -1}});
  const auto flipped = [flip](const ExactVector& f) -> ExactVector { return flip * f; };
  Step turn = InRows("turn", slides, slides.problem.contacts, flip, flipped);
  CHECK(kind_of(slides, turn) == "walk");  // its slip does not turn along
  turn.to.problem.contacts[0].slip[0] = -1;
  CHECK(kind_of(slides, turn) == "");
  turn.forward = Same();
  CHECK(kind_of(slides, turn) == "walk");
  Step units = InRows("units", from, from.problem.contacts, Matrix({{1, 0}, {0, 3}}), [](const ExactVector& f) {
    return Vector({f[0], f[1] / 3});
  });
  units.keeps_errors = true;
  CHECK(kind_of(from, units) == "errors");  // without another mu
  Choices choices(1);
  Step border = Border(from, choices);
  CHECK(kind_of(from, border) == "");
  Walk walk{from, {border}};
  const Solution solution = SolveIn(border.to.problem, RequestFor("complete", Arithmetic::kExact));
  CHECK(FaultOfWayBack(walk, solution) == "");
  walk.steps[0].backward = [](const ExactVector& f) -> ExactVector { return f.head(2); };
  CHECK(Kind(FaultOfWayBack(walk, solution)) == "back");
  Truth truth = TruthOf(from.problem);
  Step sum = Beside("sum", from, NoSolution(), Vector({0, 0}));
  sum.solvable = false;
  CHECK(FaultOfStep(from.problem, sum, other, truth) == "");
  CHECK((truth.is_known && !truth.solvable));
}

TEST_CASE("model: factors, a scene, an export and forces of another problem are seen") {
  Choices choices(3);
  const Case drawn = DrawScene(choices);
  CHECK_FALSE(FaultOfForms(drawn));
  CHECK_FALSE(FaultOfSparse(drawn));
  Case other = drawn;
  other.factors->c[0] += 1;
  other.factors->b[0] += 1;
  CHECK(FaultOfForms(other).Kind() == "copy");
  CHECK(FaultOfSparse(other).Kind() == "sparse");
  CHECK(FaultIn(other, TruthOf(other.problem)).Kind() == "gate");
  other = drawn;
  other.scene->scene.gravity *= Rational(2);
  CHECK(FaultOfForms(other).Kind() == "copy");
  ExactProblem changed = drawn.problem;
  changed.contacts[0].mu += 1;
  CHECK(Kind(FaultOfCopy("fclib", drawn.problem, changed)) == "copy");
  const ExactVector f = TruthOf(drawn.problem).f;
  REQUIRE(f.size() > 0);
  CHECK(FaultOfForces(drawn.problem, f, true) == "");
  CHECK(Kind(FaultOfForces(drawn.problem, ExactVector(f * Rational(2)), true)) == "refusal");
  const Scene<Rational>& scene = drawn.scene->scene;
  const SceneModel<Rational> full = FullModel(scene), minimal = Assemble(scene, FindContacts(scene));
  std::vector<ExactVector> forces;
  for (std::size_t k = 0; k < minimal.islands.size(); ++k) forces.push_back(TruthOf(minimal.Problem(k)).f);
  CHECK(FaultOfIslands(drawn.problem, full, minimal, forces) == "");
  forces[0] *= Rational(2);
  CHECK(Kind(FaultOfIslands(drawn.problem, full, minimal, forces)) == "scene");
}

TEST_CASE("model: a method that solves few of what can be solved is seen") {
  Shares shares = {{"fast over double in 2", {30, 40}}, {"lemke over interval in 2", {0, 40}}};
  CHECK(FaultOfShares(shares) == "");
  shares["fast over double in 2"].solved = 15;
  CHECK(Kind(FaultOfShares(shares)) == "share");
}

TEST_CASE("model: choices are shrunk until no smaller or fewer ones keep the fault") {
  const auto keeps = [](const Values& values) {
    return values.size() >= 3 && values[2] >= 7 && values[0] <= -2;
  };
  CHECK(Shrunk({-40, 12, 900, 3, 5, 8}, keeps) == Values{-2, 0, 7});
}

}  // namespace
}  // namespace stiction
