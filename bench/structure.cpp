// SPDX-License-Identifier: Apache-2.0
#include "bench/structure.h"

#include <fmt/format.h>

#include "corpus/json.h"
#include "corpus/record/scene_file.h"
#include "scene/contacts.h"
#include "scene/simulate.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Dense = ContactProblem<double>;

constexpr int kUnit = 32;  // lengths below are in 1/32 m

// ---- Scenes of blocks, written as a file would be ------------------------------------------------

struct Block {
  int x = 0, y = 0, up = 0;  // centre; y in space only
  std::int64_t mass = 1;
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

// The problem of the bodies given; friction and the direction of gravity are drawn.
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

// take(model) of the scene at rest, at this instant, which is one island.
template <class Kind, class Take>
auto FromModel(const Json& json, Take take) {
  const auto scene = Round(ParseScene<Kind>(JsonText(json), "structured").scene);
  const auto model = Assemble(scene, FindContacts(scene));
  STICTION_CHECK(model.islands.size() == 1, "blocks that stand on each other are one island");
  return take(model);
}

template <class Take>
auto FromModel(const Building& building, const Json& json, Take take) {
  return building.dimension == 2 ? FromModel<Plane>(json, take) : FromModel<Space>(json, take);
}

Dense ProblemOf(const Building& building, const Json& json) {
  return FromModel(building, json, [](const auto& model) { return model.Problem(0); });
}

}  // namespace

Dense StackProblem(int boxes, const Building& building, Choices& choices) {
  return ProblemOf(building, StackJson(boxes, building, choices));
}

Dense WallProblem(int courses, int bricks, const Building& building, Choices& choices) {
  return ProblemOf(building, WallJson(courses, bricks, building, choices));
}

FactoredProblem<double> WallInFactors(int courses, int bricks, const Building& building, Choices& choices) {
  return FromModel(building, WallJson(courses, bricks, building, choices),
                   [](const auto& model) { return model.InFactors(0); });
}

Dense ChannelProblem(int discs, const Building& building, Choices& choices) {
  return ProblemOf(building, ChannelJson(discs, building, choices));
}

}  // namespace stiction
