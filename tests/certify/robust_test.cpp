// SPDX-License-Identifier: Apache-2.0
// Robust loops: the radius is that of a box in which every problem, or scene, loops alike, and is not claimed
// where some do not.

#include "certify/claims/robust.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <utility>

#include "certify/claims/robust_scene.h"
#include "corpus/json.h"
#include "corpus/record/scene_file.h"
#include "search/generators/choices.h"
#include "tests/support.h"

namespace stiction {
namespace {

using testing::Few;
using testing::MakeProblem;
using testing::ReferenceProblem;

const Limits kLimits = {1000, 10000, 100000};

// corpus/two-contact-cycle-every-policy-period-4.json: no ties.
ExactProblem Loop() {
  return MakeProblem({2, 2}, {{3, 2, 0, 3}, {2, 5, -3, 0}, {0, -3, 3, 2}, {3, 0, 2, 6}}, {1, 4, -2, 1});
}

// A problem on or in the box, not symmetric in general.
ExactProblem Moved(const ExactProblem& problem, const Rational& radius, Choices& random) {
  ExactProblem moved = problem;
  Rational A = 0, b = 0;
  for (const Rational& x : problem.A.reshaped()) A = std::max<Rational>(A, abs(x));
  for (const Rational& x : problem.b) b = std::max<Rational>(b, abs(x));
  const auto part = [&] { return Rational(radius * random.Integer(-8, 8) / 8); };
  for (Rational& x : moved.A.reshaped()) x += A * part();
  for (Rational& x : moved.b) x += b * part();
  for (auto& contact : moved.contacts) contact.mu *= 1 + part();
  return moved;
}

TEST_CASE("robust: every problem of the box loops with the same start and period") {
  const ExactProblem problem = Loop();
  const Request options{.limits = kLimits};
  const auto radius = RadiusOfLoop(problem, options);
  REQUIRE(radius.has_value());
  CHECK(*radius > Rational(1, 100000));
  const ExactRun run = RunExact(problem, options);
  Choices random(5);
  for (int k = 0; k < 200; ++k) {
    const ExactRun near = RunExact(Moved(problem, *radius, random), options);
    REQUIRE(near.verdict.outcome == Outcome::kCycle);
    CHECK(near.verdict.start == run.verdict.start);
    CHECK(near.verdict.period == run.verdict.period);
    CHECK(near.sets == run.sets);
  }
}

TEST_CASE("robust: a box that holds a problem without the loop is not proved") {
  const ExactProblem problem = Loop();
  const Request options{.limits = kLimits};
  const ExactRun run = RunExact(problem, options);
  Choices random(6);
  int others = 0;
  for (int k = 4; k <= 64; ++k) {
    const Rational radius(1, k);
    bool other = false;
    for (int i = 0; i < 50 && !other; ++i) {
      const ExactRun near = RunExact(Moved(problem, radius, random), options);
      other = near.verdict.outcome != Outcome::kCycle || near.verdict.start != run.verdict.start ||
              near.verdict.period != run.verdict.period;
    }
    if (!other) continue;
    ++others;
    CHECK_FALSE(LoopsWithin(problem, run, options, radius));
  }
  CHECK(others > 0);
}

TEST_CASE("robust: no radius for a run that solves") {
  ExactProblem problem = ReferenceProblem();
  for (auto& contact : problem.contacts) contact.mu = Rational(1, 8);
  const Request options{.limits = kLimits};
  REQUIRE(RunExact(problem, options).verdict.outcome == Outcome::kSolved);
  CHECK_FALSE(RadiusOfLoop(problem, options).has_value());
}

TEST_CASE("robust: no radius where two limits are met at once") {
  const Request options{.limits = kLimits};
  REQUIRE(RunExact(ReferenceProblem(), options).verdict.outcome == Outcome::kCycle);
  CHECK_FALSE(RadiusOfLoop(ReferenceProblem(), options).has_value());
}

TEST_CASE("robust: a loop beside another keeps its radius or a part of it") {
  const ExactProblem one = Loop();
  const auto rows = one.A.rows();
  ExactProblem two;
  two.dimension = 2;
  two.contacts = one.contacts;
  two.contacts.insert(two.contacts.end(), one.contacts.begin(), one.contacts.end());
  two.A = ExactProblem::Matrix::Constant(2 * rows, 2 * rows, Rational(0));
  two.A.topLeftCorner(rows, rows) = one.A;
  two.A.bottomRightCorner(rows, rows) = one.A;
  two.b.resize(2 * rows);
  two.b << one.b, one.b;
  // The first copy loops before the second is looked at.
  const auto radius = RadiusOfLoop(two, {.limits = kLimits});
  CHECK(radius.value_or(0) > 0);
  CHECK(radius.value_or(1) <= RadiusOfLoop(one, {.limits = kLimits}).value_or(0));
}

// ---- Scenes --------------------------------------------------------------------------------------

Scene<Rational> SceneNamed(const std::string& name) {
  return ReadScene(STICTION_SOURCES "/corpus/scenes/" + name + ".json").scene;
}

// Of the record of the lowest friction with three contacts: two of them hold a body at rest, so that there are
// ties.
Scene<Rational> SceneOfRecord() {
  const Json record =
      ParseJson(ReadText(STICTION_SOURCES "/corpus/records/friction-gravity-3-contacts.json"), "");
  return ParseScene(record["problem"]["scene"].dump(), "record").scene;
}

using Part = std::function<Rational()>;

// A scene of the box about another: `part` says of each of its numbers, one after the other, how far off it is,
// in [-1, 1].
class Off {
 public:
  Off(const TouchingScene& scene, const Rational& radius, Part part)
      : scene_(scene), radius_(radius), part_(std::move(part)) {
    double square = 0;
    for (const auto& contact : scene.contacts) {
      for (const int body : {contact.a, contact.b}) {
        if (scene.scene.bodies[body].fixed) continue;
        const Vector2<Rational> arm = contact.point - scene.scene.bodies[body].position;
        square = std::max(square, stiction::Dot<Rational>(arm, arm).get_d());
      }
    }
    reach_ = radius * Rational(std::sqrt(square) * (1 - 1e-9));
  }

  ExactProblem Problem() {
    Scene<Rational> scene = scene_.scene;
    Turn(scene.gravity);
    for (auto& body : scene.bodies) {
      if (body.fixed) continue;
      for (Rational* x : {&body.mass, &body.inertia, &body.force[0], &body.force[1], &body.torque})
        *x *= 1 + radius_ * part_();
      Move(body.position);
    }
    auto contacts = scene_.contacts;
    for (auto& contact : contacts) {
      Move(contact.point);
      Turn(contact.normal);
      contact.mu *= 1 + radius_ * part_();
    }
    return Assemble(scene, contacts, Level::kForces, /*minimal=*/false).Problem(0);
  }

 private:
  void Move(Vector2<Rational>& point) {
    for (Rational& x : point) x += reach_ * part_();
  }
  void Turn(Vector2<Rational>& v) {  // by 2 atan(t) <= 2 t
    const Rational t = radius_ * part_() / 2, scale = 1 + t * t;
    v = Rotate<Rational>(MakeVector2<Rational>(Rational((1 - t * t) / scale), Rational(2 * t / scale)), v);
  }

  const TouchingScene& scene_;
  Rational radius_, reach_;
  Part part_;
};

// At the ends more often than between them.
Part AnyPart(Choices& random) {
  return [&random] {
    const auto k = random.Integer(-8, 8);
    return k < -4 ? Rational(-1) : k > 4 ? Rational(1) : Rational(k, 4);
  };
}

ExactProblem OffBy(const TouchingScene& scene, const Rational& radius, const std::vector<int>& parts) {
  std::size_t next = 0;
  return Off(scene, radius, [&] { return Rational(parts.at(next++)); }).Problem();
}

std::vector<Rational> NumbersOf(const ExactProblem& problem) {
  std::vector<Rational> numbers(problem.A.reshaped().begin(), problem.A.reshaped().end());
  numbers.insert(numbers.end(), problem.b.begin(), problem.b.end());
  for (const auto& contact : problem.contacts) numbers.push_back(contact.mu);
  return numbers;
}

int PartsOf(const TouchingScene& scene) {
  int parts = 0;
  Off(scene, 0, [&] { return ++parts, Rational(0); }).Problem();
  return parts;
}

bool LoopsAlike(const ExactProblem& problem, const ExactRun& run, const Request& options) {
  const ExactRun near = RunExact(problem, options);
  return near.verdict.outcome == Outcome::kCycle && near.verdict.start == run.verdict.start &&
         near.verdict.period == run.verdict.period && near.sets == run.sets;
}

TEST_CASE("robust: every scene of the box loops with the same start and period") {
  const Request options{.limits = kLimits};
  Choices random(7);
  const auto check = [&](const Scene<Rational>& scene, const Rational& least, int draws) {
    const TouchingScene touching = Touching(scene);
    const ExactRun run = RunExact(touching.problem, options);
    const auto radius = RadiusOfSceneLoop(touching, options);
    REQUIRE(radius.has_value());
    CHECK(*radius > least);
    Off draw(touching, *radius, AnyPart(random));
    for (int k = 0; k < draws; ++k) REQUIRE(LoopsAlike(draw.Problem(), run, options));
  };
  check(SceneNamed("weight-on-two-pegs"), Rational(1, 10000), Few(200));
  check(SceneNamed("block-in-a-valley"), Rational(1, 10000), Few(200));
  check(SceneOfRecord(), Rational(1, 1000000000), Few(20));
}

// With given forces and a given moment.
Scene<Rational> Loaded() {
  Scene<Rational> scene = SceneNamed("weight-on-two-pegs");
  scene.bodies[1].force = MakeVector2<Rational>(Rational(1, 10), Rational(-1, 10));
  scene.bodies[1].torque = Rational(1, 100);
  return scene;
}

// The scene in which a number of its problem is greatest or least is in the box, and not in a smaller one:
// every part of a scene that moves the number has its parameter, in its right size.
TEST_CASE("robust: the box of a scene is as large as it is said to be, and no larger") {
  const Rational radius(1, 10000);
  for (const auto& scene :
       {Touching(Loaded()), Touching(SceneNamed("block-in-a-valley")), Touching(SceneOfRecord())}) {
    const int parts = PartsOf(scene);
    std::vector<std::vector<Rational>> rates;  // of each number, by part
    for (int k = 0; k < parts; ++k) {
      std::vector<int> one(parts, 0);
      one[k] = 1;
      const auto there = NumbersOf(OffBy(scene, radius, one));
      one[k] = -1;
      const auto back = NumbersOf(OffBy(scene, radius, one));
      auto& rate = rates.emplace_back();
      for (std::size_t i = 0; i < there.size(); ++i) rate.push_back(there[i] - back[i]);
    }
    for (std::size_t i = 0; i < rates[0].size(); ++i) {
      for (const int side : {-1, 1}) {
        std::vector<int> corner;
        for (const auto& rate : rates) corner.push_back(side * sgn(rate[i]));
        const ExactProblem farthest = OffBy(scene, radius, corner);
        CAPTURE(i, side);
        CHECK(IsInBox(scene, radius, farthest));
        if (std::any_of(corner.begin(), corner.end(), [](int x) { return x != 0; }))
          CHECK_FALSE(IsInBox(scene, radius * Rational(98, 100), farthest));
      }
    }
  }
}

TEST_CASE("robust: every scene of the box loops where forces and moments are given, too") {
  const TouchingScene touching = Touching(Loaded());
  const Request options{.limits = kLimits};
  const ExactRun run = RunExact(touching.problem, options);
  REQUIRE(run.verdict.outcome == Outcome::kCycle);
  const auto radius = RadiusOfSceneLoop(touching, options);
  REQUIRE(radius.value_or(0) > 0);
  Choices random(9);
  Off draw(touching, *radius, AnyPart(random));
  for (int k = 0; k < Few(100); ++k) REQUIRE(LoopsAlike(draw.Problem(), run, options));
}

TEST_CASE("robust: a box that holds a scene without the loop is not proved") {
  const Request options{.limits = kLimits};
  Choices random(8);
  for (const char* name : {"weight-on-two-pegs", "block-in-a-valley"}) {
    const TouchingScene touching = Touching(SceneNamed(name));
    const ExactRun run = RunExact(touching.problem, options);
    int others = 0;
    for (int k = 2; k <= 256; k *= 2) {
      Off draw(touching, Rational(1, k), AnyPart(random));
      bool other = false;
      for (int i = 0; i < 50 && !other; ++i) other = !LoopsAlike(draw.Problem(), run, options);
      if (!other) continue;
      ++others;
      CHECK_FALSE(SceneLoopsWithin(touching, run, options, Rational(1, k)));
    }
    CHECK(others > 0);
  }
}

TEST_CASE("robust: a scene knows ties that a body at rest explains, the matrix alone does not") {
  const TouchingScene touching = Touching(SceneOfRecord());
  const Request options{.limits = kLimits};
  CHECK_FALSE(RadiusOfLoop(touching.problem, options).has_value());
  CHECK(RadiusOfSceneLoop(touching, options).value_or(0) > 0);
}

TEST_CASE("robust: three independent rows hold a body, dependent ones and a body that moves do not") {
  const Rational radius(1, 1000);
  const auto follow = [&](const Scene<Rational>& scene, const std::vector<int>& zero) {
    const TouchingScene touching = Touching(scene);
    std::vector<bool> marked(touching.problem.rows(), false);
    for (const int row : zero) marked[row] = true;
    std::vector<int> found;
    for (int row = 0; row < touching.problem.rows(); ++row) {
      if (Follows(touching, radius, marked, row)) found.push_back(row);
    }
    return found;
  };
  Scene<Rational> flat = SceneNamed("weight-on-two-pegs");  // its weight on three points of a level floor
  GivenContactIn<Plane, Rational> contact = flat.contacts[0];
  flat.contacts.clear();
  contact.normal = MakeVector2<Rational>(0, 1);
  for (const int x : {-1, 0, 1}) {
    contact.at_a = contact.at_b = MakeVector2<Rational>(x, -1);
    flat.contacts.push_back(contact);
  }
  const std::vector<int> all = {0, 1, 2, 3, 4, 5};
  CHECK(follow(flat, {0, 2}).empty());
  CHECK(follow(flat, {0, 2, 4}).empty());  // free to slide
  CHECK(follow(flat, {0, 1, 2}) == all);
  // Two contacts of body 1 with what is fixed, one with body 2.
  const Scene<Rational> record = SceneOfRecord();
  CHECK(follow(record, {0, 1, 2}) == std::vector<int>{0, 1, 2, 3});
  CHECK(follow(record, {0, 2, 4}).empty());
}

TEST_CASE("robust: no radius of a scene that is solved") {
  Scene<Rational> scene = SceneNamed("weight-on-two-pegs");
  scene.mu = Rational(1, 10);
  const TouchingScene touching = Touching(scene);
  const Request options{.limits = kLimits};
  REQUIRE(RunExact(touching.problem, options).verdict.outcome == Outcome::kSolved);
  CHECK_FALSE(RadiusOfSceneLoop(touching, options).has_value());
}

TEST_CASE("robust: scenes that move, are joined or do not touch have no box") {
  const Scene<Rational> fit = SceneNamed("weight-on-two-pegs");
  CHECK_FALSE(UnfitForBox(fit).has_value());
  const auto path = [&](const std::function<void(Scene<Rational>&)>& change) {
    Scene<Rational> scene = fit;
    change(scene);
    return UnfitForBox(scene).value_or(Rejected{}).path;
  };
  CHECK(path([](auto& scene) { scene.bodies[1].velocity[0] = 1; }) == "bodies[1]");
  CHECK(path([](auto& scene) { scene.bodies[0].spin = 1; }) == "bodies[0]");
  CHECK(path([](auto& scene) { scene.bodies[0].acceleration[1] = 1; }) == "bodies[0].acceleration");
  CHECK(path([](auto& scene) { scene.joints.push_back({}); }) == "joints");
  CHECK(path([](auto& scene) {
          scene.contacts.clear();
          scene.bodies[1].position[1] = 5;
        }) == "contacts");
}

}  // namespace
}  // namespace stiction
