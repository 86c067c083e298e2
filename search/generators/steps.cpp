// SPDX-License-Identifier: Apache-2.0
// steps: the problem of one step of an engine, on a stack, a wall, a pile, a grasp, or bodies anyhow.
//
// A world is drawn with as many contacts as the problem has, and stepped as engines do, in floats throughout:
// at the level of velocities, u = v + h g; sweeps over the contacts from the impulses of the step before
// (projected Gauss-Seidel), with Baumgarte's term for overlap; then x = x + h v. Contacts stay where they are
// on their bodies. So overlap, creep and unfinished sweeps are in the velocities, and rounding is in J, as
// engines have both.
//
// The problem is that of the last step: impulses p with
//
//   A = J W J',  b = J u
//
// J, the inverse masses W and u are floats; A and b are formed of them exactly. So A is semidefinite and b in
// its range, as engines' own A are but for a rounding; but rows that geometry makes dependent are so only
// nearly. Baumgarte's term, which can leave the range, is not part of b.
//
// Floats are added, multiplied, divided, and roots of them taken: each is rounded alike on every machine.

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/plane.h"
#include "search/generators/drawing.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

constexpr int kMostBodies = kMaxContacts, kTheFixed = -1;
constexpr float kMostSpeed = 1024;  // m/s: sweeps that diverge end here

using Vector = Vector2<float>;

struct SteppedBody {
  Vector at = {0, 0}, turn = {1, 0};      // centre of mass, m; cosine and sine
  std::array<float, 3> speed = {};        // x, y, spin
  std::array<float, 3> inverse = {};      // 1/m, 1/m, 1/I
  std::array<float, 3> push = {0, 0, 0};  // acceleration by what acts on it, gravity among it
};

struct SteppedContact {
  int a = 0, b = kTheFixed;
  Vector at_a, at_b, normal;              // of a and b; the normal of b, from b to a
  std::array<float, 2> impulse = {0, 0};  // of the step before
};

// A row of J: the parts of a and of b.
using SteppedRow = std::array<std::array<float, 3>, 2>;

struct SteppedWorld {
  int bodies = 0, contacts = 0;
  std::array<SteppedBody, kMostBodies> body;
  std::array<SteppedContact, kMaxContacts> contact;
  std::array<float, kMaxContacts> mu = {};
  std::array<SteppedRow, 2 * kMaxContacts> row = {};
  float h = 0, baumgarte = 0;
  int sweeps = 0;
};

int Draw(int low, int high, Choices& choices) { return static_cast<int>(choices.Integer(low, high)); }
// In 64ths, which floats are.
float Part(int low, int high, Choices& choices) { return static_cast<float>(Draw(low, high, choices)) / 64; }

// (2pq, p^2 - q^2) / (p^2 + q^2): straight up for q = 0.
Vector UnitNormal(int p, int q) {
  if (p == 0 && q == 0) p = 1;
  const auto length = static_cast<float>(p * p + q * q);
  return {static_cast<float>(2 * p * q) / length, static_cast<float>(p * p - q * q) / length};
}

// q is drawn first: arguments of a call would be drawn in an order of the compiler's choice.
Vector DrawNormal(int least_p, int most_q, Choices& choices) {
  const int q = Draw(-most_q, most_q, choices);
  return UnitNormal(Draw(least_p, 7, choices), q);
}

// ---- Worlds ----------------------------------------------------------------------------------

// Masses 1, 3, 10, ..., up to 10^4 apart.
float DrawMass(int spread, Choices& choices) {
  constexpr std::array<float, 9> kMasses = {1, 3, 10, 30, 100, 300, 1000, 3000, 10000};
  return kMasses[static_cast<std::size_t>(Draw(0, spread, choices))];
}

// `gyration`: the square of the radius of gyration.
int AddBody(const Vector& at, float gyration, int spread, SteppedWorld& world, Choices& choices) {
  SteppedBody& body = world.body[world.bodies];
  body.at = at;
  const float mass = DrawMass(spread, choices);
  body.inverse = {1 / mass, 1 / mass, 1 / (mass * gyration)};
  body.push = {0, -10, 0};
  if (choices.Integer(0, 1) == 1) {
    for (float& speed : body.speed) speed = Part(-16, 16, choices) / 8;
  }
  return world.bodies++;
}
float GyrationOfBox(float half_width, float half_height) {
  return (half_width * half_width + half_height * half_height) / 3;
}

void AddTouch(int a, int b, const Vector& point, const Vector& normal, SteppedWorld& world) {
  SteppedContact& contact = world.contact[world.contacts++];
  contact.a = a;
  contact.b = b;
  contact.at_a = point - world.body[a].at;
  contact.at_b = b == kTheFixed ? point : point - world.body[b].at;
  contact.normal = normal;
}

// Boxes on each other, two contacts each; of an odd number the last has one.
void MakeStack(int contacts, int spread, SteppedWorld& world, Choices& choices) {
  float x = 0, y = 0, width = 2;
  for (int below = kTheFixed; world.contacts < contacts;) {
    const float next_width = Part(16, 64, choices), height = Part(8, 48, choices);
    const float next_x = x + Part(-15, 15, choices);
    const float left = std::max(x - width, next_x - next_width),
                right = std::min(x + width, next_x + next_width);
    const int box = AddBody({next_x, y + height}, GyrationOfBox(next_width, height), spread, world, choices);
    if (world.contacts + 1 == contacts) {
      AddTouch(box, below, {(left + right) / 2, y}, {0, 1}, world);
    } else {
      AddTouch(box, below, {left, y}, {0, 1}, world);
      AddTouch(box, below, {right, y}, {0, 1}, world);
    }
    x = next_x;
    y += 2 * height;
    width = next_width;
    below = box;
  }
}

// Two bricks and one across both; contacts at their corners, those without which it falls first.
void MakeWall(int contacts, int spread, SteppedWorld& world, Choices& choices) {
  struct Place {
    int a, b;
    Vector point, normal;
  };
  const float width = Part(32, 96, choices), height = Part(12, 48, choices), shift = Part(-15, 15, choices);
  const std::array<Vector, 3> places = {{{-width, height}, {width, height}, {shift, 3 * height}}};
  for (int i = 0; i < std::min(contacts, 3); ++i)
    AddBody(places[static_cast<std::size_t>(i)], GyrationOfBox(width, height), spread, world, choices);
  const float top = 2 * height;
  std::array<Place, 9> all = {{{0, kTheFixed, {-2 * width, 0}, {0, 1}},
                               {1, kTheFixed, {2 * width, 0}, {0, 1}},
                               {2, 0, {shift - width, top}, {0, 1}},
                               {2, 1, {shift + width, top}, {0, 1}},
                               {0, kTheFixed, {0, 0}, {0, 1}},
                               {1, kTheFixed, {0, 0}, {0, 1}},
                               {2, 0, {0, top}, {0, 1}},
                               {2, 1, {0, top}, {0, 1}},
                               {1, 0, {0, height}, {1, 0}}}};
  for (int i = 0; i < contacts; ++i) {
    if (i >= 4) std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(Draw(i, 8, choices))]);
    const Place& place = all[static_cast<std::size_t>(i)];
    AddTouch(place.a, place.b, place.point, place.normal, world);
  }
}

// Discs on the floor and on each other, in a vessel whose wall touches them here and there.
void MakePile(int contacts, int spread, SteppedWorld& world, Choices& choices) {
  const int discs = Draw((contacts + 1) / 2, contacts, choices);
  std::array<float, kMostBodies> radius;
  for (int i = 0; i < discs; ++i) {
    const float r = radius[static_cast<std::size_t>(i)] = Part(8, 64, choices);
    const int below = Draw(kTheFixed, i - 1, choices);
    const Vector normal = DrawNormal(3, 3, choices);
    if (below == kTheFixed) {
      const float x = Part(-256, 256, choices);
      AddTouch(AddBody({x, r}, r * r / 2, spread, world, choices), kTheFixed, {x, 0}, {0, 1}, world);
      continue;
    }
    const Vector centre = world.body[below].at,
                 point = centre + normal * radius[static_cast<std::size_t>(below)];
    AddTouch(AddBody(point + normal * r, r * r / 2, spread, world, choices), below, point, normal, world);
  }
  while (world.contacts < contacts) {
    const int disc = Draw(0, discs - 1, choices);
    const Vector normal = DrawNormal(1, 7, choices);
    const Vector point = world.body[disc].at - normal * radius[static_cast<std::size_t>(disc)];
    AddTouch(disc, kTheFixed, point, normal, world);
  }
}

// A box between fingers, which press on it or stand.
void MakeGrasp(int contacts, int spread, SteppedWorld& world, Choices& choices) {
  const float width = Part(8, 64, choices), height = Part(16, 96, choices);
  const int box = AddBody({0, 0}, GyrationOfBox(width, height), spread, world, choices);
  std::array<int, 2> finger = {kTheFixed, kTheFixed};
  const int moving = Draw(0, std::min(2, contacts), choices);
  for (int k = 0; k < moving; ++k) {
    const float side = k == 0 ? -1.0F : 1.0F;
    finger[static_cast<std::size_t>(k)] = AddBody({side * (width + 0.25F), 0}, 0.125F, spread, world, choices);
    SteppedBody& body = world.body[finger[static_cast<std::size_t>(k)]];
    body.push = {-side * static_cast<float>(Draw(1, 40, choices)), 0, 0};
  }
  for (int i = 0; i < contacts; ++i) {
    const float side = i % 2 == 0 ? -1.0F : 1.0F;
    const Vector tilted = UnitNormal(8, Draw(-2, 2, choices));
    const Vector point = {side * width, height * Part(-64, 64, choices)};
    AddTouch(box, finger[static_cast<std::size_t>(i % 2)], point,
             MakeVector2<float>(tilted[1], tilted[0]) * -side, world);
  }
}

// As the generator `bodies`: shapes are not looked at.
void MakeRandom(int contacts, int spread, SteppedWorld& world, Choices& choices) {
  const int bodies = Draw(1, contacts, choices);
  for (int i = 0; i < bodies; ++i) {
    const Vector at = {Part(-128, 128, choices), Part(-128, 128, choices)};
    AddBody(at, Part(8, 64, choices), spread, world, choices);
  }
  for (int i = 0; i < contacts; ++i) {
    const int mine = i < bodies ? i : Draw(0, bodies - 1, choices);
    const int other = (mine + Draw(0, bodies - 1, choices)) % bodies;
    const Vector point = {Part(-128, 128, choices), Part(-128, 128, choices)};
    const Vector normal = DrawNormal(-7, 7, choices);
    AddTouch(mine, other == mine ? kTheFixed : other, point, normal, world);
  }
}

// ---- Stepping --------------------------------------------------------------------------------

void SetRow(const Vector& way, const Vector& arm_a, const Vector& arm_b, SteppedRow& row) {
  row[0] = {way[0], way[1], Cross<float>(arm_a, way)};
  row[1] = {-way[0], -way[1], -Cross<float>(arm_b, way)};
}

// Sets the rows of a contact; returns its gap.
float SetRows(int number, SteppedWorld& world) {
  const SteppedContact& contact = world.contact[number];
  const SteppedBody& a = world.body[contact.a];
  SteppedBody b;  // what is fixed: at the origin
  if (contact.b != kTheFixed) b = world.body[contact.b];
  const Vector on_a = a.at + Rotate<float>(a.turn, contact.at_a),
               on_b = b.at + Rotate<float>(b.turn, contact.at_b);
  const Vector normal = Rotate<float>(b.turn, contact.normal), point = (on_a + on_b) * 0.5F;
  SetRow(normal, point - a.at, point - b.at, world.row[2 * number]);
  SetRow({-normal[1], normal[0]}, point - a.at, point - b.at, world.row[2 * number + 1]);
  return Dot<float>(normal, on_a - on_b);
}

float SpeedOf(const SteppedWorld& world, int row) {
  const SteppedContact& contact = world.contact[row / 2];
  float speed = 0;
  for (int k = 0; k < 3; ++k) speed += world.row[row][0][k] * world.body[contact.a].speed[k];
  for (int k = 0; k < 3 && contact.b != kTheFixed; ++k)
    speed += world.row[row][1][k] * world.body[contact.b].speed[k];
  return speed;
}

void ApplyImpulse(int row, float impulse, SteppedWorld& world) {
  const SteppedContact& contact = world.contact[row / 2];
  for (int k = 0; k < 3; ++k) {
    SteppedBody& a = world.body[contact.a];
    a.speed[k] += a.inverse[k] * world.row[row][0][k] * impulse;
    if (contact.b == kTheFixed) continue;
    SteppedBody& b = world.body[contact.b];
    b.speed[k] += b.inverse[k] * world.row[row][1][k] * impulse;
  }
}

float ResponseOf(const SteppedWorld& world, int row) {
  const SteppedContact& contact = world.contact[row / 2];
  float response = 0;
  for (int k = 0; k < 3; ++k) {
    const float of_a = world.row[row][0][k], of_b = world.row[row][1][k];
    response += of_a * of_a * world.body[contact.a].inverse[k];
    if (contact.b != kTheFixed) response += of_b * of_b * world.body[contact.b].inverse[k];
  }
  return response;
}

// The velocities that the contacts of a step find, and its rows; returns the gaps.
std::array<float, kMaxContacts> BeginStep(SteppedWorld& world) {
  std::array<float, kMaxContacts> gaps = {};
  for (int i = 0; i < world.contacts; ++i) gaps[i] = SetRows(i, world);
  for (int i = 0; i < world.bodies; ++i) {
    for (int k = 0; k < 3; ++k) world.body[i].speed[k] += world.h * world.body[i].push[k];
  }
  return gaps;
}

void Sweep(const std::array<float, kMaxContacts>& gaps, SteppedWorld& world) {
  for (int row = 0; row < 2 * world.contacts; ++row) {
    const int number = row / 2;
    std::array<float, 2>& impulse = world.contact[number].impulse;
    const bool is_normal = row % 2 == 0;
    const float bias = is_normal ? world.baumgarte * std::min(gaps[number], 0.0F) / world.h : 0;
    const float wanted = impulse[row % 2] - (SpeedOf(world, row) + bias) / ResponseOf(world, row);
    const float most = world.mu[number] * impulse[0];
    const float kept = is_normal ? std::max(wanted, 0.0F) : std::clamp(wanted, -most, most);
    ApplyImpulse(row, kept - impulse[row % 2], world);
    impulse[row % 2] = kept;
  }
}

void EndStep(const std::array<float, kMaxContacts>& gaps, SteppedWorld& world) {
  for (int row = 0; row < 2 * world.contacts; ++row)
    ApplyImpulse(row, world.contact[row / 2].impulse[row % 2], world);
  for (int k = 0; k < world.sweeps; ++k) Sweep(gaps, world);
  for (int i = 0; i < world.bodies; ++i) {
    SteppedBody& body = world.body[i];
    for (float& speed : body.speed) speed = std::clamp(speed, -kMostSpeed, kMostSpeed);
    body.at = body.at + MakeVector2<float>(body.speed[0], body.speed[1]) * world.h;
    const float t = body.speed[2] * world.h / 2, scale = 1 + t * t;
    const Vector turned = Rotate<float>({(1 - t * t) / scale, 2 * t / scale}, body.turn);
    body.turn = turned * (1 / std::sqrt(Dot<float>(turned, turned)));
  }
}

// The world as its last step finds it.
SteppedWorld DrawStep(const Given& given, int contacts, Choices& choices) {
  constexpr std::array<float, 4> kSteps = {1.0F / 30, 1.0F / 60, 1.0F / 120, 1.0F / 240};  // s
  constexpr std::array kMakers = {&MakeStack, &MakeWall, &MakePile, &MakeGrasp, &MakeRandom};
  SteppedWorld world;
  const int maker = Draw(0, 4, choices), spread = Draw(0, 8, choices);
  world.h = kSteps[static_cast<std::size_t>(Draw(0, 3, choices))];
  world.sweeps = 1 << Draw(0, 4, choices);
  world.baumgarte = Part(0, 24, choices);
  const int steps = Draw(1, 12, choices);
  kMakers[static_cast<std::size_t>(maker)](contacts, spread, world, choices);
  for (int i = 0; i < contacts; ++i) {
    world.mu[i] = static_cast<float>(given.mu[i].numerator) / static_cast<float>(given.mu[i].denominator);
  }
  for (int k = 1; k < steps; ++k) EndStep(BeginStep(world), world);
  BeginStep(world);
  return world;
}

template <class Scalar, int Rows>
int FillSteps(const Given& given, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const SteppedWorld world = DrawStep(given, problem.rows() / 2, choices);
  const int columns = 3 * world.bodies;
  Eigen::Matrix<Scalar, Rows, Rows == Eigen::Dynamic ? Eigen::Dynamic : 3 * kMostBodies> J, weighted;
  if constexpr (Rows == Eigen::Dynamic) J.resize(problem.rows(), columns);
  for (int i = 0; i < problem.rows(); ++i) {
    for (int k = 0; k < columns; ++k) J(i, k) = Scalar(0);
    const SteppedContact& contact = world.contact[i / 2];
    for (int k = 0; k < 3; ++k) {
      J(i, 3 * contact.a + k) = Scalar(double{world.row[i][0][k]});
      if (contact.b != kTheFixed) J(i, 3 * contact.b + k) = Scalar(double{world.row[i][1][k]});
    }
  }
  weighted = J;
  for (int k = 0; k < columns; ++k) {
    for (int i = 0; i < problem.rows(); ++i) weighted(i, k) *= Scalar(double{world.body[k / 3].inverse[k % 3]});
  }
  SetProduct(weighted, J, columns, problem);
  MirrorLowerTriangle(problem);
  SetImage(
      J, columns, [&world](int k) { return Scalar(double{world.body[k / 3].speed[k % 3]}); }, problem);
  return columns;
}

}  // namespace

Generator MakeSteps() {
  static constexpr GeneratorRow kRow = {
      .name = "steps",
      .distribution =
          "One step of an engine: a stack, a wall, a pile, a grasp or bodies anyhow, masses up to 10^4 apart, "
          "after 0 to 11 steps of 1/30 to 1/240 s with 1 to 16 sweeps and a Baumgarte term, all in floats; J, "
          "inverse masses and velocities u as floats, A = J W J' and b = J u exactly.",
      .exact_in_double = false,
  };
  return GeneratorOf<kRow>(
      [](const Given& given, Choices& choices, auto& problem) { return FillSteps(given, choices, problem); });
}

}  // namespace stiction::generators
