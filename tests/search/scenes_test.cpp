// SPDX-License-Identifier: Apache-2.0
// The generator `scenes` against solver/scene: its bodies touch where it says and nowhere else, none overlap,
// and the scene's own model is the problem. Over rationals, with ==.

#include "search/generators/scenes.h"

#include <catch2/catch.hpp>
#include <set>

#include "scene/assemble.h"
#include "scene/polygon.h"
#include "tests/support.h"

namespace stiction {
namespace {

constexpr std::array<MuChoice, 4> kPalette = {{{1, 5}, {1, 3}, {1, 2}, {1, 1}}};
constexpr int kIndices = 40;

struct Made {
  Scene<Rational> scene;
  ExactProblem problem;
};

Made Make(GeneratorId id, int contacts, Choices for_scene, Choices for_problem) {
  Made made;
  made.scene = GenerateScene(id, contacts, kPalette, for_scene).value();
  Generate(id, contacts, kPalette, for_problem, made.problem);
  return made;
}

Made Make(GeneratorId id, int contacts, int index) {
  const std::uint64_t seed = ProblemSeed(5, contacts, index);
  return Make(id, contacts, Choices(seed), Choices(seed));
}
Made Make(int contacts, int index) { return Make(GeneratorId::kScenes, contacts, index); }

// visit(contacts, made) for all sizes, and for choices that have run out.
template <class Visit>
void ForEachScene(Visit visit) {
  for (const GeneratorId id : {GeneratorId::kScenes, GeneratorId::kFineScenes}) {
    for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
      CAPTURE(Row(id).name, contacts);
      visit(contacts, Make(id, contacts, Choices::Replay({}), Choices::Replay({})));
      for (int index = 0; index < kIndices; ++index) {
        CAPTURE(index);
        visit(contacts, Make(id, contacts, index));
      }
    }
  }
}

std::vector<Vector2<Rational>> Corners(const RigidBody<Rational>& body) {
  std::vector<Vector2<Rational>> corners;
  for (const auto& corner : body.shapes.at(0).corners) corners.push_back(body.At(corner));
  return corners;
}

// Whether an edge of `p` has all of `q` on its outer side or on it.
bool HasSeparatingEdge(const std::vector<Vector2<Rational>>& p, const std::vector<Vector2<Rational>>& q) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2<Rational> along = p[(i + 1) % p.size()] - p[i];
    if (std::all_of(q.begin(), q.end(), [&](const auto& corner) {
          return Cross<Rational>(along, Vector2<Rational>(corner - p[i])) <= 0;
        }))
      return true;
  }
  return false;
}

// One problem with all contacts.
ExactProblem FullModel(const Scene<Rational>& scene) {
  const auto model = Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/false);
  REQUIRE(model.islands.size() == 1);
  return model.Problem(0);
}

TEST_CASE("scenes: contact finding sees the contacts asked for and no other, all of them without gap",
          "[slow]") {
  ForEachScene([](int contacts, Made made) {
    for (const Rational& gap : {Rational(0), made.scene.gap}) {
      made.scene.gap = gap;
      const auto found = FindContacts(made.scene);
      REQUIRE(static_cast<int>(found.size()) == contacts);
      for (const auto& contact : found) REQUIRE(contact.gap == 0);
    }
  });
}

TEST_CASE("scenes: the full model of the scene is the problem, contacts in the same order", "[slow]") {
  ForEachScene([](int, const Made& made) {
    const ExactProblem problem = FullModel(made.scene);
    REQUIRE(problem.A == made.problem.A);
    REQUIRE(problem.b == made.problem.b);
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
      REQUIRE(problem.contacts[i].kind == ContactKind::kStatic);
      REQUIRE(problem.contacts[i].mu == made.problem.contacts[i].mu);
    }
  });
}

TEST_CASE("scenes: bodies are convex polygons of uniform density, and no two overlap") {
  ForEachScene([](int, const Made& made) {
    const auto& bodies = made.scene.bodies;
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      REQUIRE(PolygonFault(bodies[a].shapes.at(0).corners) == "");
      for (std::size_t b = 0; b < a; ++b) {
        const auto p = Corners(bodies[a]), q = Corners(bodies[b]);
        REQUIRE((bodies[a].fixed || HasSeparatingEdge(p, q) || HasSeparatingEdge(q, p)));
      }
      if (bodies[a].fixed) continue;
      const auto properties = MassPropertiesOf(bodies[a].shapes);
      REQUIRE((properties.center[0] == 0 && properties.center[1] == 0));
      REQUIRE(properties.inertia * bodies[a].mass == bodies[a].inertia * properties.mass);
    }
  });
}

// What the words of the table promise: a body on two others, one wedged between two, a tilted floor, ...
TEST_CASE("scenes: all arrangements occur") {
  std::set<std::set<std::pair<int, int>>> touching;  // pairs of moving bodies in contact, of three
  std::set<std::string> walls;
  int tilted = 0, pushed = 0, corners = 0;
  for (int index = 0; index < 300; ++index) {
    const Made made = Make(5, index);
    const auto& bodies = made.scene.bodies;
    int fixed = 0;
    for (const auto& body : bodies) {
      fixed += body.fixed;
      if (body.fixed) walls.insert(body.name);
      pushed += body.torque != 0;
    }
    std::set<std::pair<int, int>> pairs;
    for (const auto& contact : FindContacts(made.scene)) {
      const auto [a, b] = std::minmax(contact.a, contact.b);
      if (!bodies[a].fixed) pairs.insert({a - fixed, b - fixed});
      tilted += contact.normal[0] != 0 && contact.normal[1] != 0;
      corners += contact.a == a;  // otherwise the edge is that of the body of the lower number
    }
    if (static_cast<int>(bodies.size()) == fixed + 3) touching.insert(pairs);
  }
  CHECK(touching.size() == 3);  // in a row, two at the first, each at both others
  CHECK(walls.size() == 3);
  CHECK(tilted > 300);
  CHECK(pushed > 100);
  CHECK(corners > 50);
}

TEST_CASE("scenes: under gravity alone no body is pushed, and the model of the scene is the problem") {
  const Surroundings quiet(kPalette, /*only_gravity=*/true);
  for (const GeneratorId id : {GeneratorId::kScenes, GeneratorId::kFineScenes}) {
    for (int index = 0; index < kIndices; ++index) {
      const std::uint64_t seed = ProblemSeed(5, 4, index);
      Choices for_scene(seed), for_problem(seed);
      const auto scene = GenerateScene(id, 4, quiet, for_scene).value();
      for (const auto& body : scene.bodies)
        REQUIRE((body.force[0] == 0 && body.force[1] == 0 && body.torque == 0));
      ExactProblem problem;
      Generate(id, 4, quiet, for_problem, problem);
      const ExactProblem model = FullModel(scene);
      REQUIRE((model.A == problem.A && model.b == problem.b));
    }
  }
  Choices choices(1);
  ExactProblem problem;
  CHECK_THROWS(Generate(GeneratorId::kPsd, 2, quiet, choices, problem));
}

TEST_CASE("scenes: only the generators of that name have scenes") {
  Choices choices(1);
  CHECK_FALSE(GenerateScene(GeneratorId::kBodies, 2, kPalette, choices).has_value());
}

}  // namespace
}  // namespace stiction
