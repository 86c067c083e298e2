// SPDX-License-Identifier: Apache-2.0
#include "search/generators/scenes.h"

#include <fmt/format.h>

#include "search/generators/drawing.h"
#include "search/generators/scenes.ipp"
#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr int kFloor = 0, kCeiling = 3, kFirstCut = 4, kSecondCut = 5;
constexpr int kAttempts = 8;  // then a design without chance, whose interfaces hold eight contacts

bool Less(const SmallFraction& p, const SmallFraction& q) {
  return static_cast<std::int64_t>(p.numerator) * q.denominator <
         static_cast<std::int64_t>(q.numerator) * p.denominator;
}

// ---- Lines -----------------------------------------------------------------------------------

// (2 p q, p^2 - q^2), of length p^2 + q^2.
SceneLine WithNormal(int p, int q) { return {2 * p * q, p * p - q * q, p * p + q * q, 0, 0}; }

// Upright, or up to 37 degrees off.
SceneLine DrawUpright(int slope, Choices& choices) {
  const int p = static_cast<int>(choices.Integer(3 * slope, 7 * slope));
  return WithNormal(p, static_cast<int>(choices.Integer(-slope, slope)));
}

SceneLine Turned(const SceneLine& line, int quarters) {
  SceneLine turned = line;
  turned.nx = -quarters * line.ny;
  turned.ny = quarters * line.nx;
  return turned;
}

// Along the floor, along the left wall, or anyhow.
SceneLine DrawCut(const SceneDesign& design, Choices& choices) {
  const int kind = static_cast<int>(choices.Integer(0, 3));
  SceneLine cut = design.lines[kind == 1 ? 1 : 0];
  if (kind >= 2) {
    const int most = 4 * design.grain.slope;
    const int p = static_cast<int>(choices.Integer(-most, most));
    const int q = static_cast<int>(choices.Integer(-most, most));
    cut = WithNormal(p == 0 && q == 0 ? 1 : p, q);
  }
  const int tenth = design.grain.unit / 10;
  cut.x = static_cast<int>(choices.Integer(design.lines[1].x + tenth, design.lines[2].x - tenth));
  cut.y = static_cast<int>(choices.Integer(tenth, design.lines[kCeiling].y - tenth));
  return cut;
}

void DrawLines(Choices& choices, SceneDesign& design) {
  const int slope = design.grain.slope, tenth = design.grain.unit / 10;
  design.lines[0] = DrawUpright(slope, choices);
  design.lines[1] = Turned(DrawUpright(slope, choices), -1);
  design.lines[1].x = static_cast<int>(choices.Integer(-15 * tenth, -4 * tenth));
  design.lines[2] = Turned(DrawUpright(slope, choices), 1);
  design.lines[2].x = static_cast<int>(choices.Integer(4 * tenth, 15 * tenth));
  design.lines[kCeiling] = {0, -1, 1, 0, static_cast<int>(choices.Integer(8 * tenth, 30 * tenth))};
  if (design.cells > 1) design.lines[kFirstCut] = DrawCut(design, choices);
  if (design.cells > 2) design.lines[kSecondCut] = DrawCut(design, choices);
}

// A pile of boxes between upright walls.
void SetPlainLines(SceneDesign& design) {
  const int tenth = design.grain.unit / 10;
  design.lines = {{{0, 1, 1, 0, 0},
                   {1, 0, 1, -6 * tenth, 0},
                   {-1, 0, 1, 6 * tenth, 0},
                   {0, -1, 1, 0, 20 * tenth},
                   {0, 1, 1, 0, 6 * tenth},
                   {0, 1, 1, 0, 12 * tenth}}};
}

// ---- Cells and interfaces --------------------------------------------------------------------

void SetSides(SceneDesign& design) {
  for (int c = 0; c < design.cells; ++c) {
    auto& side = design.cell[c].side;
    side = {1, 1, 1, 1, 0, 0};
    if (design.cells > 1) side[kFirstCut] = c == 0 ? -1 : 1;
    if (c > 0 && design.cells > 2) side[kSecondCut] = c == 1 ? -1 : 1;
  }
}

// Cuts `piece` of a line down to one side of another; false if nothing is left.
bool Clip(const SceneLine& line, const SceneLine& other, int side, LinePiece& piece) {
  // side N.(P + t D - Q) >= 0:  slope t >= bound
  const int slope = side * (other.ny * line.nx - other.nx * line.ny);
  const int bound = -side * (other.nx * (line.x - other.x) + other.ny * (line.y - other.y));
  if (slope == 0) return bound < 0;
  const SmallFraction t = slope > 0 ? SmallFraction{bound, slope} : SmallFraction{-bound, -slope};
  if (slope > 0 && Less(piece.from, t)) piece.from = t;
  if (slope < 0 && Less(t, piece.to)) piece.to = t;
  return Less(piece.from, piece.to);
}

// What a cell leaves of a piece.
bool Clip(const SceneDesign& design, const SceneCell& cell, int line, LinePiece& piece) {
  for (int other = 0; other < kSceneLines; ++other) {
    if (other == line || cell.side[other] == 0) continue;
    if (!Clip(design.lines[line], design.lines[other], cell.side[other], piece)) return false;
  }
  return true;
}

constexpr LinePiece kWholeLine = {{-1000000, 1}, {1000000, 1}};

// Sets the edges of a cell; false if they enclose nothing.
bool SetEdges(const SceneDesign& design, SceneCell& cell) {
  int edges = 0;
  for (int line = 0; line < kSceneLines; ++line) {
    LinePiece piece = kWholeLine;
    const bool has_edge = cell.side[line] != 0 && Clip(design, cell, line, piece);
    cell.edge[line] = has_edge ? std::optional(piece) : std::nullopt;
    edges += has_edge;
  }
  return edges >= 3;
}

// Interfaces are a tenth of a metre long at least.
bool IsLong(const SceneLine& line, const LinePiece& piece) {
  const auto [a, b] = std::pair<std::int64_t, std::int64_t>(piece.from.numerator, piece.from.denominator);
  const auto [c, d] = std::pair<std::int64_t, std::int64_t>(piece.to.numerator, piece.to.denominator);
  return (c * b - a * d) * line.length >= line.unit / 10 * (b * d);
}

void AddInterface(int line, int lower, int upper, SceneDesign& design) {
  if (!design.cell[upper].edge[line]) return;
  LinePiece piece = *design.cell[upper].edge[line];
  if (lower != kTheWorld && !Clip(design, design.cell[lower], line, piece)) return;
  if (!IsLong(design.lines[line], piece)) return;
  SceneInterface& interface = design.interface[design.interfaces++];
  interface = {};
  interface.line = line;
  interface.lower = lower;
  interface.upper = upper;
  interface.piece = piece;
}

// In the order in which FindContacts goes through pairs of bodies: those of the world first.
void FindInterfaces(SceneDesign& design) {
  design.interfaces = 0;
  for (int wall = 0; wall < kSceneWalls; ++wall) {
    for (int c = 0; c < design.cells; ++c) AddInterface(wall, kTheWorld, c, design);
  }
  if (design.cells > 1) AddInterface(kFirstCut, 0, 1, design);
  if (design.cells > 2) AddInterface(kFirstCut, 0, 2, design);
  if (design.cells > 2) AddInterface(kSecondCut, 1, 2, design);
}

// ---- Contacts --------------------------------------------------------------------------------

// Gives one contact to one of the interfaces that `may` have it and have room; false if there is none.
template <class May>
bool PlaceContact(SceneDesign& design, Choices& choices, May may) {
  std::array<int, kSceneWalls * kMostSceneBodies + 3> candidates;
  int count = 0;
  for (int i = 0; i < design.interfaces; ++i) {
    if (design.interface[i].contacts < 2 && may(design.interface[i])) candidates[count++] = i;
  }
  if (count == 0) return false;
  ++design.interface[candidates[choices.Integer(0, count - 1)]].contacts;
  return true;
}

bool PlaceContacts(int contacts, SceneDesign& design, Choices& choices) {
  for (int c = 1; c < design.cells; ++c) {
    if (!PlaceContact(design, choices, [c](const auto& i) { return i.upper == c && i.lower != kTheWorld; }))
      return false;
  }
  if (!PlaceContact(design, choices, [](const auto& i) { return i.line == kFloor; })) return false;
  for (int rest = contacts - design.cells; rest > 0; --rest) {
    if (!PlaceContact(design, choices, [](const auto&) { return true; })) return false;
  }
  return true;
}

// Who has what at an interface. `below`: the lower body must cover, since it reaches beyond the interface.
void DrawPlaces(int places, bool below, SceneInterface& interface, Choices& choices) {
  const bool two = interface.contacts == 2;
  const int apart = places / 16;  // from each other and from the ends, at least
  const int first = static_cast<int>(choices.Integer(two ? apart : 2 * apart, 14 * apart));
  const int last = two ? static_cast<int>(choices.Integer(first + apart, 15 * apart)) : first;
  interface.at = {first, last};
  interface.of_lower = interface.of_upper = interface.at;
  if (interface.lower == kTheWorld) return;
  const int from = static_cast<int>(choices.Integer(apart, two ? first : first - apart));
  const int to = static_cast<int>(choices.Integer(two ? last : last + apart, 15 * apart));
  const int kind = below ? 0 : static_cast<int>(choices.Integer(0, two ? 2 : 1));
  if (kind == 0) interface.of_lower = {from, to};
  if (kind == 1) interface.of_upper = {from, to};
  if (kind == 2) interface.of_lower[0] = from, interface.of_upper[1] = to;
}

// Keeps the interfaces that have contacts.
void DrawAllPlaces(SceneDesign& design, Choices& choices) {
  int kept = 0, on_first_cut = 0;
  for (int i = 0; i < design.interfaces; ++i) {
    if (design.interface[i].contacts == 0) continue;
    on_first_cut += design.interface[i].line == kFirstCut;
    design.interface[kept++] = design.interface[i];
  }
  design.interfaces = kept;
  for (int i = 0; i < kept; ++i) {
    SceneInterface& interface = design.interface[i];
    const bool below = interface.line == kFirstCut && on_first_cut == 2;
    DrawPlaces(design.grain.places, below, interface, choices);
  }
}

bool DrawArrangement(int contacts, bool plain, SceneDesign& design, Choices& choices) {
  if (plain) {
    SetPlainLines(design);
  } else {
    DrawLines(choices, design);
  }
  for (SceneLine& line : design.lines) line.unit = design.grain.unit;
  SetSides(design);
  for (int c = 0; c < design.cells; ++c) {
    if (!SetEdges(design, design.cell[c])) return false;
  }
  FindInterfaces(design);
  return PlaceContacts(contacts, design, choices);
}

void DrawBodies(bool gravity_only, SceneDesign& design, Choices& choices) {
  const bool applied = !gravity_only && choices.Integer(0, 1) == 1;
  for (int c = 0; c < design.cells; ++c) {
    SceneCell& cell = design.cell[c];
    cell.fill = static_cast<int>(choices.Integer(design.grain.fill / 8, design.grain.fill * 7 / 8));
    cell.mass.numerator = static_cast<int>(choices.Integer(1, design.grain.mass));
    cell.mass.denominator = static_cast<int>(choices.Integer(1, design.grain.mass));
    for (int k = 0; applied && k < 3; ++k) cell.load[k] = static_cast<int>(choices.Integer(-20, 20));
  }
}

// ---- As a scene ------------------------------------------------------------------------------

constexpr std::array<const char*, kSceneWalls> kWallNames = {"floor", "left wall", "right wall"};

// A slab of 2/10 m below the line, 1/10 m longer at each end than what the cells have of it.
RigidBody<Rational> WallBody(const SceneDesign& design, int wall) {
  const SceneLine& line = design.lines[wall];
  std::optional<LinePiece> whole;
  for (int c = 0; c < design.cells; ++c) {
    const auto& edge = design.cell[c].edge[wall];
    if (!edge) continue;
    if (!whole) whole = edge;
    if (Less(edge->from, whole->from)) whole->from = edge->from;
    if (Less(whole->to, edge->to)) whole->to = edge->to;
  }
  const Rational beyond = Rational(line.unit / 10) / Rational(line.length);
  const auto normal = NormalOf<Rational>(line);
  const auto p = PointOf<Rational>(line, Value<Rational>(whole->from) - beyond);
  const auto q = PointOf<Rational>(line, Value<Rational>(whole->to) + beyond);
  const Rational depth(1, 5);
  RigidBody<Rational> body;
  body.name = kWallNames[wall];
  body.fixed = true;
  body.shapes.resize(1);
  // Below the line the piece runs anticlockwise from p to q.
  body.shapes[0].corners = {p, q, q - depth * normal, p - depth * normal};
  return body;
}

RigidBody<Rational> CellBody(const SceneDesign& design, int c) {
  const auto made = MakeSceneBody<Rational>(design, c);
  RigidBody<Rational> body;
  body.name = fmt::format("body {}", c + 1);
  body.mass = made.mass;
  body.inertia = made.inertia;
  body.position = made.center;
  for (int k = 0; k < 2; ++k) body.force[k] = design.cell[c].load[k];
  body.torque = design.cell[c].load[2];
  body.shapes.resize(1);
  for (int i = 0; i < made.polygon.size; ++i)
    body.shapes[0].corners.push_back(made.polygon.points[i] - made.center);
  return body;
}

// mu: by contacts, equal for those of one interface.
Scene<Rational> SceneOf(const SceneDesign& design, std::span<const Rational> mu) {
  Scene<Rational> scene;
  scene.gravity = MakeVector2<Rational>(Rational(0), Rational(-10));
  scene.gap = Rational(1, 1000000);  // for pictures and simulations over doubles; over rationals gaps are 0
  std::array<int, kSceneWalls> number{};
  for (int wall = 0; wall < kSceneWalls; ++wall) {
    for (int i = 0; i < design.interfaces; ++i) {
      if (design.interface[i].line != wall) continue;
      number[wall] = static_cast<int>(scene.bodies.size());
      scene.bodies.push_back(WallBody(design, wall));
      break;
    }
  }
  const int walls = static_cast<int>(scene.bodies.size());
  for (int c = 0; c < design.cells; ++c) scene.bodies.push_back(CellBody(design, c));
  int contact = 0;
  for (int i = 0; i < design.interfaces; ++i) {
    const SceneInterface& interface = design.interface[i];
    const bool wall = interface.lower == kTheWorld;
    scene.pairs.push_back({wall ? number[interface.line] : walls + interface.lower, walls + interface.upper,
                           mu[contact], std::nullopt});
    contact += interface.contacts;
  }
  return scene;
}

}  // namespace

SceneDesign DrawSceneDesign(int contacts, const SceneGrain& grain, bool gravity_only, Choices& choices) {
  SceneDesign design;
  design.grain = grain;
  for (int attempt = 0; attempt <= kAttempts; ++attempt) {
    const bool plain = attempt == kAttempts;
    // One body has at most six contacts with a floor and two walls.
    design.cells =
        static_cast<int>(choices.Integer(contacts > 6 ? 2 : 1, std::min(kMostSceneBodies, contacts)));
    const bool placed = DrawArrangement(contacts, plain, design, choices);
    STICTION_CHECK(placed || !plain, "a plain pile has room for eight contacts");
    if (placed) break;
  }
  DrawAllPlaces(design, choices);
  DrawBodies(gravity_only, design, choices);
  return design;
}

std::optional<Scene<Rational>> GenerateScene(GeneratorId id, int contacts, const Surroundings& surroundings,
                                             Choices& choices) {
  if (id != GeneratorId::kScenes && id != GeneratorId::kFineScenes) return std::nullopt;
  ContactProblem<Rational> problem;
  generators::Resize(contacts, 2, problem);
  generators::DrawFriction(surroundings.palette, choices, problem);
  std::vector<Rational> mu;
  for (const auto& contact : problem.contacts) mu.push_back(contact.mu);
  const SceneGrain& grain = id == GeneratorId::kScenes ? kCoarseScenes : kFineScenes;
  return SceneOf(DrawSceneDesign(contacts, grain, surroundings.gravity_only, choices), mu);
}

}  // namespace stiction
