// SPDX-License-Identifier: Apache-2.0
#include "bench/dials.h"

#include <algorithm>
#include <array>

#include "bench/structure.h"
#include "certify/exact/exact.h"
#include "corpus/rounded.h"
#include "search/exponential.h"
#include "search/generators.h"

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;
using Vector = ExactProblem::Vector;

Rational PowerOfTen(int exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned>(std::abs(exponent)));
  return exponent >= 0 ? Rational(power) : Rational(1, power);
}

Rational Uniform(int most, Choices& choices) { return choices.Integer(-most, most); }

constexpr std::array kFrictionsDrawn = {MuChoice{1, 5}, MuChoice{1, 2}, MuChoice{1, 1}, MuChoice{2, 1}};

// ---- Bodies --------------------------------------------------------------------------------------

// A = J W J', b = J y.
struct Draft {
  std::vector<Rational> mu;
  Matrix J;
  Vector W, y;

  int contacts() const { return static_cast<int>(mu.size()); }
};

ExactProblem Made(const Draft& draft) {
  ExactProblem problem;
  for (const Rational& mu : draft.mu) problem.contacts.push_back({ContactKind::kStatic, mu, {}});
  const Matrix JW = draft.J * draft.W.asDiagonal();
  problem.A = JW * draft.J.transpose();
  problem.b = draft.J * draft.y;
  return problem;
}

// A unit vector with rational components.
std::array<Rational, 2> DrawDirection(Choices& choices) {
  constexpr std::array<std::array<int, 3>, 5> kTriples = {
      {{1, 0, 1}, {3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}}};
  const auto& triple = kTriples[choices.Integer(0, 4)];
  std::array<Rational, 2> direction = {Rational(triple[0], triple[2]), Rational(triple[1], triple[2])};
  if (choices.Integer(0, 1) == 0) std::swap(direction[0], direction[1]);
  for (Rational& x : direction) {
    if (choices.Integer(0, 1) == 0) x = -x;
  }
  return direction;
}

// Rows of a contact on a body: its normal and its tangent, with the arm at which it acts.
void SetRows(int contact, int body, int sign, const std::array<Rational, 2>& normal, Choices& choices,
             Matrix& J) {
  const std::array<std::array<Rational, 2>, 2> directions = {{normal, {Rational(-normal[1]), normal[0]}}};
  const Rational x = Uniform(9, choices) / 4, y = Uniform(9, choices) / 4;
  for (int r = 0; r < 2; ++r) {
    const auto& d = directions[r];
    J(2 * contact + r, 3 * body) = sign * d[0];
    J(2 * contact + r, 3 * body + 1) = sign * d[1];
    J(2 * contact + r, 3 * body + 2) = sign * (x * d[1] - y * d[0]);
  }
}

// Each contact is of a body with another, or with the ground; as many bodies as contacts, or one fewer.
Draft DrawBodies(Choices& choices) {
  Draft draft;
  const int contacts = static_cast<int>(choices.Integer(2, 4)),
            bodies = contacts - static_cast<int>(choices.Integer(0, 1));
  draft.J = Matrix::Constant(2 * contacts, 3 * bodies, Rational(0));
  for (int i = 0; i < contacts; ++i) {
    const MuChoice& mu = kFrictionsDrawn[choices.Integer(0, kFrictionsDrawn.size() - 1)];
    draft.mu.push_back(Rational(mu.numerator, mu.denominator));
    const auto normal = DrawDirection(choices);
    const int body = i < bodies ? i : static_cast<int>(choices.Integer(0, bodies - 1));
    SetRows(i, body, 1, normal, choices, draft.J);
    const int other = static_cast<int>(choices.Integer(-1, bodies - 1));
    if (other >= 0 && other != body) SetRows(i, other, -1, normal, choices, draft.J);
  }
  draft.W = Vector::Constant(3 * bodies, Rational(1));
  for (int k = 0; k < bodies; ++k) {
    const Rational mass = choices.Integer(1, 4);
    draft.W[3 * k] = draft.W[3 * k + 1] = 1 / mass;
    draft.W[3 * k + 2] = 1 / (mass * choices.Integer(1, 2));
  }
  draft.y = Vector(3 * bodies);
  for (Rational& y : draft.y) y = Uniform(20, choices);
  return draft;
}

// Heavy bodies beside light ones.
ExactProblem Masses(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  const int bodies = static_cast<int>(draft.W.size()) / 3,
            heavy = static_cast<int>(choices.Integer(0, bodies - 1));
  for (int k = 0; k < bodies; ++k) {
    const bool is_heavy = k == heavy || choices.Integer(0, 1) == 0;
    if (is_heavy) draft.W.segment(3 * k, 3) /= PowerOfTen(setting);
  }
  return Made(draft);
}

// Arms at which contacts act, beside masses that stay.
ExactProblem Levers(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  for (int column = 2; column < draft.J.cols(); column += 3) draft.J.col(column) *= PowerOfTen(setting);
  return Made(draft);
}

// All masses at once, and so all forces.
ExactProblem Units(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  draft.W *= PowerOfTen(setting);
  return Made(draft);
}

// The second contact is the first, but for so little.
ExactProblem Parallel(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  draft.J.middleRows(2, 2) = draft.J.middleRows(0, 2) + PowerOfTen(-setting) * draft.J.middleRows(2, 2);
  return Made(draft);
}

// So many contacts are the first once more.
ExactProblem Duplicates(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  const int contacts = draft.contacts(), rows = 2 * contacts;
  Matrix J(rows + 2 * setting, draft.J.cols());
  J.topRows(rows) = draft.J;
  for (int copy = 0; copy < setting; ++copy) {
    J.middleRows(rows + 2 * copy, 2) = draft.J.topRows(2);
    draft.mu.push_back(draft.mu.front());
  }
  draft.J = J;
  return Made(draft);
}

constexpr int kNone = -999;  // a setting of friction: none

Rational FrictionOf(int setting) { return setting == kNone ? Rational(0) : PowerOfTen(setting); }

ExactProblem Friction(int setting, Choices& choices) {
  Draft draft = DrawBodies(choices);
  for (Rational& mu : draft.mu) {
    if (choices.Integer(0, 2) > 0) mu = FrictionOf(setting);
  }
  return Made(draft);
}

// A body between two walls that nearly face each other: it jams.
ExactProblem Wedge(int setting, Choices& choices) {
  Draft draft;
  const Rational lean = PowerOfTen(-setting) * choices.Integer(1, 9) / 9;
  draft.mu = {Rational(choices.Integer(1, 8)) / 4, Rational(choices.Integer(1, 8)) / 4};
  draft.J = Matrix::Constant(4, 3, Rational(0));
  SetRows(0, 0, 1, {Rational(1), lean}, choices, draft.J);
  SetRows(1, 0, 1, {Rational(-1), lean}, choices, draft.J);
  draft.W = Vector::Constant(3, Rational(1));
  draft.y = Vector(3);
  for (Rational& y : draft.y) y = Uniform(20, choices);
  return Made(draft);
}

// ---- Without bodies ------------------------------------------------------------------------------

Draft DrawMatrix(int contacts, int columns, Choices& choices) {
  Draft draft;
  for (int i = 0; i < contacts; ++i) {
    const MuChoice& mu = kFrictionsDrawn[choices.Integer(0, kFrictionsDrawn.size() - 1)];
    draft.mu.push_back(Rational(mu.numerator, mu.denominator));
  }
  draft.J = Matrix(2 * contacts, columns);
  for (Rational& x : draft.J.reshaped()) x = Uniform(100, choices);
  draft.W = Vector::Constant(columns, Rational(1));
  draft.y = Vector(columns);
  for (Rational& y : draft.y) y = Uniform(100, choices);
  return draft;
}

// Nothing is turned.
ExactProblem Tame(int, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 4));
  return Made(DrawMatrix(contacts, 2 * contacts, choices));
}

// The condition number of A, about.
ExactProblem Conditioned(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 4)), columns = 2 * contacts;
  Draft draft = DrawMatrix(contacts, columns, choices);
  for (int k = 0; k < columns; ++k) draft.W[k] = PowerOfTen(-setting * k / (columns - 1));
  return Made(draft);
}

// b is so far from the range of A, and may have no solution.
ExactProblem Range(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(2, 4));
  ExactProblem problem = Made(DrawMatrix(contacts, contacts, choices));
  for (Rational& b : problem.b) b += PowerOfTen(-setting) * Uniform(100, choices);
  return problem;
}

// The problem of two contacts on which the published algorithm loops.
ExactProblem Loop(const Rational& b) {
  constexpr int kA[4][4] = {{7, -2, -6, 0}, {-2, 9, -1, -7}, {-6, -1, 7, 3}, {0, -7, 3, 7}};
  ExactProblem problem;
  problem.contacts.assign(2, {ContactKind::kStatic, Rational(1), {}});
  problem.A.resize(4, 4);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) problem.A(i, j) = kA[i][j];
  }
  problem.b.resize(4);
  problem.b << b, -1, -2, 2;
  return problem;
}

// b_1 up to which it does, within 2^-100.
const Rational& BorderOfLoops() {
  static const Rational border = [] {
    Rational loops = 2, ends = 64;
    for (int step = 0; step < 105; ++step) {
      const Rational middle = (loops + ends) / 2;
      const bool is_loop = RunExact(Loop(middle), {}).verdict.outcome == Outcome::kCycle;
      (is_loop ? loops : ends) = middle;
    }
    return loops;
  }();
  return border;
}

// So far from the border of the problems that loop, on either side.
ExactProblem NearLoops(int setting, Choices& choices) {
  const Rational away = PowerOfTen(-setting) * choices.Integer(1, 9) / 9;
  return Loop(choices.Integer(0, 1) == 0 ? Rational(BorderOfLoops() + away) : Rational(BorderOfLoops() - away));
}

ExactProblem Exponential(int setting, Choices& choices) {
  ExactProblem problem = ExponentialFamily(setting);
  for (Rational& b : problem.b) b *= choices.Integer(1, 9);
  return problem;
}

// ---- Blocks --------------------------------------------------------------------------------------

ExactProblem StackOfMasses(int setting, Choices& choices) {
  return Unrounded(StackProblem(4, setting, choices));
}

ExactProblem WallOfMasses(int setting, Choices& choices) {
  return Unrounded(WallProblem(3, 2, setting, choices));
}

}  // namespace

const std::vector<Dial>& Dials() {
  static const std::vector<Dial> dials = {
      {"tame", "nothing", "", {0}, true, &Tame},
      {"masses", "ratio of masses", "10^k", {0, 2, 4, 8, 12, 16}, true, &Masses},
      {"levers",
       "arms of contacts beside masses",
       "10^k m",
       {-150, -75, -16, -8, 0, 8, 16, 75, 150},
       true,
       &Levers},
      {"units", "unit of mass", "10^k kg", {-300, -150, 0, 150, 300}, true, &Units},
      {"conditioned", "condition number of A", "10^k", {0, 8, 16, 32, 100, 300}, true, &Conditioned},
      {"parallel", "contacts alike but for", "10^-k", {1, 4, 8, 12, 16, 40}, true, &Parallel},
      {"duplicates", "copies of a contact", "copies", {0, 1, 2, 4}, true, &Duplicates},
      {"friction", "coefficient of friction", "10^k, -999: none", {kNone, -16, -8, 0, 8, 16}, true, &Friction},
      {"wedge", "walls that face each other but for", "10^-k", {0, 2, 4, 8, 12, 16}, true, &Wedge},
      {"range", "distance of b from the range of A", "10^-k", {0, 4, 8, 12, 16, 40}, false, &Range},
      {"near-loops", "distance from the border of a loop", "10^-k", {1, 4, 8, 12, 16, 30}, true, &NearLoops},
      {"exponential", "paths of 2^n - 1 pivots", "contacts n", {2, 4, 6, 8, 10}, true, &Exponential},
      {"stack", "four boxes, ratio of masses", "10^k", {0, 4, 8, 12, 16}, true, &StackOfMasses, true},
      {"wall",
       "three courses of bricks, ratio of masses",
       "10^k",
       {0, 4, 8, 12, 16},
       true,
       &WallOfMasses,
       true},
  };
  return dials;
}

const Dial* FindDial(const std::string& name) {
  const auto& dials = Dials();
  const auto dial = std::find_if(dials.begin(), dials.end(), [&name](auto& d) { return d.name == name; });
  return dial == dials.end() ? nullptr : &*dial;
}

ExactProblem MakeDialProblem(const Dial& dial, int setting, std::uint64_t seed, std::int64_t index) {
  const auto place = static_cast<std::uint64_t>(&dial - Dials().data());
  Choices choices(ProblemSeed(seed, (place << 32) ^ static_cast<std::uint64_t>(setting + 4096),
                              static_cast<std::uint64_t>(index)));
  return dial.make(setting, choices);
}

}  // namespace stiction
