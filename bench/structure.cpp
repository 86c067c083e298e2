// SPDX-License-Identifier: Apache-2.0
#include "bench/structure.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "corpus/scene_file.h"
#include "scene/contacts.h"
#include "scene/simulate.h"
#include "search/generators.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Problem = ContactProblem<double>;
using Problems = std::vector<Problem>;

constexpr int kUnit = 32;  // lengths below are in 1/32 m

// ---- Scenes of blocks, written as a file would be ------------------------------------------------

struct Block {
  int x = 0, y = 0, up = 0;  // centre; y in space only
  std::int64_t mass = 1;
};

// How a family of such scenes is drawn.
struct Building {
  int dimension = 2;
  bool friction = true;
  int decades = 0;  // masses are 1, 10, ..., 10^decades kg
};

Json Length(int units) { return fmt::format("{}/{}", units, kUnit); }

// A point or a size: (x, up) in the plane, (x, y, up) in space.
Json Lengths(int dimension, int x, int y, int up) {
  if (dimension == 2) return {Length(x), Length(up)};
  return {Length(x), Length(y), Length(up)};
}

std::int64_t DrawMass(const Building& building, Choices& choices) {
  std::int64_t mass = 1;
  for (std::int64_t k = choices.Integer(0, building.decades); k > 0; --k) mass *= 10;
  return mass;
}

Json BodyJson(int number, std::int64_t mass, const Json& position, const Json& shape) {
  return {{"name", fmt::format("body {}", number)},
          {"mass", mass},
          {"position", position},
          {"shapes", Json::array({shape})}};
}

Json FixedJson(const std::string& name, const Json& position, const Json& size) {
  return {
      {"name", name}, {"fixed", true}, {"position", position}, {"shapes", Json::array({Json{{"box", size}}})}};
}

// Of the bodies given; friction and the direction of gravity are drawn.
Json SceneJson(const Building& building, const Json& bodies, Choices& choices) {
  const std::string mu = building.friction ? fmt::format("{}/10", choices.Integer(3, 10)) : "0";
  const std::string aside = fmt::format("{}/10", choices.Integer(-5, 5));
  const Json gravity = building.dimension == 2 ? Json{aside, "-10"} : Json{aside, "0", "-10"};
  return {
      {"format", "stiction-scene"}, {"version", 1}, {"name", "structured"}, {"dimension", building.dimension},
      {"gravity", gravity},         {"mu", mu},     {"gap", "1/1000"},      {"bodies", bodies}};
}

// Blocks of one size on a floor whose top is at 0.
Json BlocksJson(const Building& building, const std::vector<Block>& blocks, const std::array<int, 3>& size,
                Choices& choices) {
  const int dimension = building.dimension;
  Json bodies = Json::array({FixedJson("floor", Lengths(dimension, 0, 0, -kUnit),
                                       Lengths(dimension, 200 * kUnit, 200 * kUnit, 2 * kUnit))});
  const Json box = {{"box", Lengths(dimension, size[0], size[1], size[2])}};
  for (const Block& block : blocks) {
    const Json position = Lengths(dimension, block.x, block.y, block.up);
    bodies.push_back(BodyJson(static_cast<int>(bodies.size()), block.mass, position, box));
  }
  return SceneJson(building, bodies, choices);
}

// Each up to 3/32 m off the middle.
Json StackJson(int boxes, const Building& building, Choices& choices) {
  const std::array<int, 3> size = {2 * kUnit, 2 * kUnit, kUnit};
  std::vector<Block> blocks;
  for (int k = 0; k < boxes; ++k) {
    const int x = static_cast<int>(choices.Integer(-3, 3)), y = static_cast<int>(choices.Integer(-3, 3));
    blocks.push_back({x, y, k * size[2] + size[2] / 2, DrawMass(building, choices)});
  }
  return BlocksJson(building, blocks, size, choices);
}

// Every second course is half a brick off, and one brick shorter; neighbours do not touch.
Json WallJson(int courses, int bricks, const Building& building, Choices& choices) {
  const std::array<int, 3> size = {kUnit - 1, kUnit / 2, kUnit / 2};
  std::vector<Block> blocks;
  for (int course = 0; course < courses; ++course) {
    const int shift = course % 2;
    for (int k = 0; k < bricks - shift; ++k) {
      const int x = kUnit * k + shift * kUnit / 2;
      blocks.push_back({x, 0, course * size[2] + size[2] / 2, DrawMass(building, choices)});
    }
  }
  return BlocksJson(building, blocks, size, choices);
}

// Discs of diameter 1 m in a channel 8/5 m wide, each on the one before and against the other wall.
Json ChannelJson(int discs, const Building& building, Choices& choices) {
  const auto fixed = [](const char* name, int x, int y, int width, int height) {
    return FixedJson(name, {fmt::format("{}/10", x), y}, {width, height});
  };
  Json bodies = Json::array(
      {fixed("floor", 0, -1, 4, 2), fixed("left", -18, 50, 2, 100), fixed("right", 18, 50, 2, 100)});
  const Json disc = {{"disc", "1/2"}};
  for (int k = 0; k < discs; ++k) {
    const Json position = {k % 2 == 0 ? "3/10" : "-3/10", fmt::format("{}/10", 5 + 8 * k)};
    bodies.push_back(BodyJson(k + 1, DrawMass(building, choices), position, disc));
  }
  return SceneJson(building, bodies, choices);
}

// ---- Their problems ------------------------------------------------------------------------------

bool IsAllOf(const Problem& problem, ContactKind kind) {
  return std::all_of(problem.contacts.begin(), problem.contacts.end(),
                     [kind](const auto& contact) { return contact.kind == kind; });
}

ContactKind KindOf(bool friction) { return friction ? ContactKind::kStatic : ContactKind::kFrictionless; }

// At rest, at this instant. The scene is one island.
template <class Kind>
Problem ProblemOf(const Json& json) {
  const auto scene = Round(ParseScene<Kind>(json.dump(), "structured").scene);
  const auto model = Assemble(scene, FindContacts(scene));
  STICTION_CHECK(model.islands.size() == 1, "blocks that stand on each other are one island");
  return model.Problem(0);
}

// draw(building, choices) returns a scene.
template <class Draw>
StructuredFamily BuildingFamily(const std::string& name, const std::string& title, int problems,
                                const Building& building, Draw draw) {
  std::string whole = title;
  if (building.dimension == 3) whole += " in space";
  if (building.decades > 0) whole += fmt::format(", masses 1 to 10^{}", building.decades);
  if (!building.friction) whole += ", frictionless";
  return {name + (building.decades > 0 ? "-masses" : "") + (building.friction ? "" : "-smooth"),
          whole,
          building.dimension,
          building.friction,
          problems,
          [=](int count, std::uint64_t seed) {
            Problems made;
            for (int k = 0; k < count; ++k) {
              Choices choices(ProblemSeed(seed, 1, k));
              const Json scene = draw(building, choices);
              made.push_back(building.dimension == 2 ? ProblemOf<Plane>(scene) : ProblemOf<Space>(scene));
            }
            return made;
          }};
}

StructuredFamily Stack(int boxes, int problems, const Building& building) {
  return BuildingFamily(fmt::format("{}stack-{}", building.dimension == 3 ? "space-" : "", boxes),
                        fmt::format("stack of {} boxes", boxes), problems, building,
                        [=](const Building& of, Choices& choices) { return StackJson(boxes, of, choices); });
}

StructuredFamily Wall(int courses, int bricks, int problems, const Building& building) {
  return BuildingFamily(
      fmt::format("{}wall-{}x{}", building.dimension == 3 ? "space-" : "", courses, bricks),
      fmt::format("wall of {} courses, {} bricks wide", courses, bricks), problems, building,
      [=](const Building& of, Choices& choices) { return WallJson(courses, bricks, of, choices); });
}

StructuredFamily Channel(int discs, int problems, const Building& building) {
  return BuildingFamily(fmt::format("channel-{}", discs), fmt::format("{} discs in a channel", discs), problems,
                        building,
                        [=](const Building& of, Choices& choices) { return ChannelJson(discs, of, choices); });
}

// ---- Scenes of the corpus, as a simulation meets them ---------------------------------------------

constexpr int kFirstFrames = 10;

// Forces of the first frames, all islands: those of the most rows. On one thread.
template <class Kind>
Problems FirstProblems(const SceneFileIn<Kind>& file, bool friction) {
  Problems met;
  std::size_t rows = 1;
  SimulationOptions options;
  options.step = ToDouble(file.step);
  SimulationIn<Kind> simulation(Round(file.scene), options, [&](const FrameProblem& of) {
    const std::size_t size = of.problem.b.size();
    if (of.level != Level::kForces || size < rows || !IsAllOf(of.problem, KindOf(friction))) return;
    if (size > rows) met.clear();
    rows = size;
    met.push_back(of.problem);
  });
  tbb::task_arena one_thread(1);
  one_thread.execute([&] {
    for (int frame = 0; frame < kFirstFrames; ++frame) simulation.Step();
  });
  return met;
}

StructuredFamily SceneFamily(const std::filesystem::path& scenes, const std::string& name, int dimension,
                             bool friction) {
  return {name,
          fmt::format("the first {} frames of {}.json", kFirstFrames, name),
          dimension,
          friction,
          80,
          [=](int count, std::uint64_t) {
            const auto file = ReadAnyScene(scenes / (name + ".json"));
            Problems met = std::visit([&](const auto& of) { return FirstProblems(of, friction); }, file);
            STICTION_CHECK(!met.empty(), "a scene of the comparison has contacts of one kind");
            met.resize(std::min<std::size_t>(met.size(), count));
            return met;
          }};
}

// ---- Without bodies ------------------------------------------------------------------------------

StructuredFamily GeneratedFamily(GeneratorId id, int contacts) {
  const std::string name(Row(id).name);
  return {"generator-" + name,
          fmt::format("generator {}, {} contacts", name, contacts),
          2,
          true,
          200,
          [=](int count, std::uint64_t seed) {
            Problems made(count);
            for (int k = 0; k < count; ++k) {
              Choices choices(ProblemSeed(seed, 2, k));
              Generate(id, contacts, kDefaultPalette, choices, made[k]);
            }
            return made;
          }};
}

double DrawUniform(Choices& choices) { return static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-6; }

// J of two rows a contact and as many columns, uniform in [-1, 1]; the second half of the rows are those of the
// first half and 1e-9 of other ones. A = J J', b = J y.
Problem NearlyDependent(int contacts, Choices& choices) {
  Eigen::MatrixXd J(2 * contacts, 2 * contacts);
  for (double& x : J.reshaped()) x = DrawUniform(choices);
  J.bottomRows(contacts) = J.topRows(contacts) + 1e-9 * J.bottomRows(contacts);
  Eigen::VectorXd y(2 * contacts);
  for (double& x : y) x = DrawUniform(choices);
  Problem problem;
  problem.A = J * J.transpose();
  problem.b = J * y;
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, 0.55 + 0.45 * DrawUniform(choices), {}});
  return problem;
}

StructuredFamily NearlyDependentFamily(int contacts) {
  return {"nearly-dependent",
          fmt::format("{} contacts, half of them the others but for 1e-9", contacts),
          2,
          true,
          200,
          [=](int count, std::uint64_t seed) {
            Problems made;
            for (int k = 0; k < count; ++k) {
              Choices choices(ProblemSeed(seed, 3, k));
              made.push_back(NearlyDependent(contacts, choices));
            }
            return made;
          }};
}

}  // namespace

Problem StackProblem(int boxes, int decades, Choices& choices) {
  return ProblemOf<Plane>(StackJson(boxes, {2, true, decades}, choices));
}

Problem SpaceStackProblem(int boxes, int decades, Choices& choices) {
  return ProblemOf<Space>(StackJson(boxes, {3, true, decades}, choices));
}

Problem WallProblem(int courses, int bricks, int decades, Choices& choices) {
  return ProblemOf<Plane>(WallJson(courses, bricks, {2, true, decades}, choices));
}

std::vector<StructuredFamily> StructuredFamilies(const std::filesystem::path& scenes) {
  constexpr int kProblems = 100;  // of a family of buildings, at most
  const Building plain, heavy = {2, true, 4}, smooth = {2, false, 4}, space = {3, true, 0},
                        heavy_space = {3, true, 4};
  const Building very_heavy = {2, true, 8};
  const auto scene = [&](const char* name, int dimension, bool friction) {
    return SceneFamily(scenes, name, dimension, friction);
  };
  return {Stack(10, kProblems, plain),
          Stack(10, kProblems, heavy),
          Stack(30, kProblems, heavy),
          Wall(6, 5, kProblems, plain),
          Wall(6, 5, kProblems, heavy),
          Channel(20, kProblems, very_heavy),
          NearlyDependentFamily(8),
          GeneratedFamily(GeneratorId::kScenes, 8),
          GeneratedFamily(GeneratorId::kNearDegenerate, 8),
          scene("stack", 2, true),
          scene("many-stacks", 2, true),
          scene("card-house", 2, true),
          scene("arch-stands", 2, true),
          scene("large/brick-wall", 2, true),
          Stack(10, kProblems, smooth),
          Stack(30, kProblems, smooth),
          Wall(6, 5, kProblems, smooth),
          scene("two-towers", 2, false),
          Stack(5, kProblems, space),
          Stack(10, kProblems, heavy_space),
          Wall(4, 3, kProblems, heavy_space),
          scene("space/stack", 3, true),
          scene("large/brick-wall-in-space", 3, true)};
}

}  // namespace stiction
