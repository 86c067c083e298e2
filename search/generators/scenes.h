// SPDX-License-Identifier: Apache-2.0
// Scenes: random planar bodies that touch and do not overlap, for the generator of that name.
//
// A floor and two walls are half planes, a ceiling closes the room between them, and one or two cuts divide it:
// the first the room, the second what lies above the first. Each of the one to three cells is convex and holds
// one body, the convex hull of
//   - points inside: the corners of the cell, drawn toward their mean;
//   - points on lines that bound the cell, where the body touches: one or two at each neighbour.
// So bodies do not overlap, whatever is drawn, and touch where two of them have a point of the same line in
// common: at an interface, the piece of a line between two cells or a cell and the world. There the points of
// one side are contacts, the other side covers them; or both overlap, like bricks that are set off. What is on
// a line is strictly inside its interface, so no point lies on two lines.
//
// All of this is decided by integers (SceneDesign): the same over doubles and rationals. Lines have rational
// unit normals (Pythagorean), so all coordinates, A and b are rational. Bodies are of uniform density, each of
// its own, and at rest.
//
// Contacts come in the order of FindContacts on the scene (scene/contacts.h), so that its full model
// (Assemble, minimal = false) is the problem itself.

#pragma once

#include <array>
#include <optional>

#include "corpus/rational.h"
#include "scene/scene.h"
#include "search/generators/generators.h"

namespace stiction {

inline constexpr int kMostSceneBodies = 3;
inline constexpr int kSceneLines = 6;  // floor, left wall, right wall, ceiling, first cut, second cut
inline constexpr int kSceneWalls = 3;  // of these lines the first three are bodies of the world
inline constexpr int kTheWorld = -1;   // where a cell is expected

// How finely a design is drawn. `scenes` has numbers that people can read, `fine-scenes` what an optimizer asks
// for.
struct SceneGrain {
  int unit;    // in parts of so many of a metre stand the points of lines; a multiple of 10
  int slope;   // slopes of lines are q/p with p and q up to a few times this
  int places;  // an interface is divided into so many parts
  int fill;    // and the way of a corner from the mean of its cell
  int mass;    // numerator and denominator of a mass are at most this
};
inline constexpr SceneGrain kCoarseScenes = {10, 1, 16, 8, 5};
inline constexpr SceneGrain kFineScenes = {1000, 8, 4096, 256, 1000};

// denominator > 0.
struct SmallFraction {
  int numerator = 0, denominator = 1;
};

// Through (x, y), in metres times `unit`, across the normal N = (nx, ny) of integer length. Points of it are
// (x, y) + t D with D = (-ny, nx). Its upper side is the one that N points to.
struct SceneLine {
  int nx = 0, ny = 1, length = 1;
  int x = 0, y = 0;
  int unit = kCoarseScenes.unit;
};

// A piece of a line, from < to.
struct LinePiece {
  SmallFraction from, to;
};

// Places on it divide `piece` into SceneGrain::places parts; strictly between its ends.
struct SceneInterface {
  int line = 0;
  int lower = kTheWorld, upper = 0;  // cells below and above the line
  LinePiece piece;
  int contacts = 0;                       // 0, 1 or 2
  std::array<int, 2> at{};                // of the contacts, in order
  std::array<int, 2> of_lower, of_upper;  // ends of what each body has on the line; equal: a corner
};

struct SceneCell {
  std::array<int, kSceneLines> side{};  // 1 above, -1 below the line, 0 where it does not matter
  std::array<std::optional<LinePiece>, kSceneLines> edge;  // on each line; empty where it has none
  int fill = 0;  // corners of the cell are drawn to fill / SceneGrain::fill of their way from the mean
  SmallFraction mass = {1, 1};  // kg
  std::array<int, 3> load{};    // applied force, N, and moment, N m
};

struct SceneDesign {
  SceneGrain grain = kCoarseScenes;
  int cells = 0;
  int interfaces = 0;  // that have contacts
  std::array<SceneLine, kSceneLines> lines;
  std::array<SceneCell, kMostSceneBodies> cell;
  std::array<SceneInterface, kSceneWalls * kMostSceneBodies + 3> interface;
};

// A design of exactly so many contacts, 1 to 8. Every body but the first touches one before it, and one touches
// the floor.
SceneDesign DrawSceneDesign(int contacts, const SceneGrain& grain, bool gravity_only, Choices& choices);

// The scene of the problem that Generate (generators.h) makes of the same choices; empty unless `id` is
// kScenes or kFineScenes. Walls that nothing touches are left out.
std::optional<Scene<Rational>> GenerateScene(GeneratorId id, int contacts, const Surroundings& surroundings,
                                             Choices& choices);

}  // namespace stiction
