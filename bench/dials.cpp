// SPDX-License-Identifier: Apache-2.0
#include "bench/dials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "bench/structure.h"
#include "bench/suite.h"
#include "certify/exact/exact.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/generators/exponential.h"
#include "search/generators/generators.h"

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;
using Vector = ExactProblem::Vector;

// ---- Numbers -------------------------------------------------------------------------------------

// base^exponent.
Rational Power(int base, int exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), static_cast<unsigned>(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent >= 0 ? Rational(power) : Rational(1, power);
}

Rational Ten(int exponent) { return Power(10, exponent); }

Rational Uniform(int low, int high, Choices& choices) { return choices.Integer(low, high); }

Vector DrawVector(int size, int most, Choices& choices) {
  Vector vector(size);
  for (Rational& x : vector) x = Uniform(-most, most, choices);
  return vector;
}

Matrix DrawMatrix(int rows, int columns, int most, Choices& choices) {
  Matrix matrix(rows, columns);
  for (Rational& x : matrix.reshaped()) x = Uniform(-most, most, choices);
  return matrix;
}

Rational DrawFriction(Choices& choices) {
  constexpr std::array kFrictions = {MuChoice{1, 5}, MuChoice{1, 2}, MuChoice{1, 1}, MuChoice{2, 1}};
  const MuChoice& mu = kFrictions[choices.Integer(0, kFrictions.size() - 1)];
  return Rational(mu.numerator, mu.denominator);
}

// Static contacts, one per mu, without A and b.
ExactProblem Contacts(int dimension, const std::vector<Rational>& mu) {
  ExactProblem problem;
  problem.dimension = dimension;
  for (const Rational& x : mu) problem.contacts.push_back({ContactKind::kStatic, x, {}});
  return problem;
}

// ---- Bodies --------------------------------------------------------------------------------------

// Rows: the normal of a contact and its tangents, over `length`.
struct RationalFrame {
  std::array<int, 9> rows;
  int length;
};
constexpr std::array kFramesOfPlane = {RationalFrame{{1, 0, 0, 1}, 1}, RationalFrame{{3, 4, -4, 3}, 5},
                                       RationalFrame{{5, 12, -12, 5}, 13}, RationalFrame{{8, 15, -15, 8}, 17}};
constexpr std::array kFramesOfSpace = {
    RationalFrame{{1, 0, 0, 0, 1, 0, 0, 0, 1}, 1}, RationalFrame{{1, 2, 2, 2, 1, -2, 2, -2, 1}, 3},
    RationalFrame{{2, 3, 6, 3, -6, 2, 6, 2, -3}, 7}, RationalFrame{{3, 4, 0, -4, 3, 0, 0, 0, 5}, 5}};

// In any order, with any signs.
Matrix DrawFrame(int dimension, Choices& choices) {
  const RationalFrame& drawn = (dimension == 2 ? kFramesOfPlane : kFramesOfSpace)[choices.Integer(0, 3)];
  const int turn = static_cast<int>(choices.Integer(0, dimension - 1));
  Matrix frame(dimension, dimension);
  for (int i = 0; i < dimension; ++i) {
    const bool flip = choices.Integer(0, 1) == 0;
    for (int k = 0; k < dimension; ++k) {
      const int x = drawn.rows[(i + turn) % dimension * dimension + k];
      frame(i, k) = Rational(flip ? -x : x) / drawn.length;
    }
  }
  return frame;
}

// What a force along d at the arm r turns.
Vector Cross(const Vector& r, const Vector& d) {
  Vector turn(d.size() == 2 ? 1 : 3);
  if (d.size() == 2) {
    turn << r[0] * d[1] - r[1] * d[0];
  } else {
    turn << r[1] * d[2] - r[2] * d[1], r[2] * d[0] - r[0] * d[2], r[0] * d[1] - r[1] * d[0];
  }
  return turn;
}

// Inverse masses and inertias W, free accelerations y, contacts J.
struct Bodies {
  int dimension, freedoms;  // of one body
  std::vector<Rational> mu;
  Matrix J;
  Vector W, y;

  Bodies(int dimension_given, int bodies, int contacts, Choices& choices)
      : dimension(dimension_given), freedoms(dimension == 2 ? 3 : 6) {
    J = Matrix::Constant(contacts * dimension, bodies * freedoms, Rational(0));
    for (int i = 0; i < contacts; ++i) mu.push_back(DrawFriction(choices));
    W.resize(bodies * freedoms);
    for (int k = 0; k < bodies; ++k) {
      const Rational mass = Uniform(1, 4, choices), inertia = mass * Uniform(1, 2, choices);
      for (int j = 0; j < freedoms; ++j) W[k * freedoms + j] = 1 / (j < dimension ? mass : inertia);
    }
    y = DrawVector(bodies * freedoms, 20, choices);
  }

  int bodies() const { return static_cast<int>(W.size()) / freedoms; }

  // The contact acts on the body at an arm, in the directions of the frame.
  void Touch(int contact, int body, const Matrix& frame, const Vector& arm) {
    for (int k = 0; k < dimension; ++k) {
      const Vector d = frame.row(k).transpose();
      J.row(contact * dimension + k).segment(body * freedoms, dimension) = d.transpose();
      J.row(contact * dimension + k).segment(body * freedoms + dimension, freedoms - dimension) =
          Cross(arm, d).transpose();
    }
  }
  Vector DrawArm(Choices& choices) const { return DrawVector(dimension, 9, choices) / Rational(4); }

  // A contact of a body with another, or with the ground (-1).
  void TouchBoth(int contact, int body, int other, const Matrix& frame, Choices& choices) {
    Touch(contact, body, frame, DrawArm(choices));
    if (other >= 0) Touch(contact, other, -frame, DrawArm(choices));
  }

  ExactProblem Problem() const {
    ExactProblem problem = Contacts(dimension, mu);
    const Matrix JW = J * W.asDiagonal();
    problem.A = JW * J.transpose();
    problem.b = J * y;
    return problem;
  }
};

// As many bodies as contacts, or fewer.
Bodies DrawBodies(int dimension, int fewest, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(fewest, 4)),
            bodies = static_cast<int>(choices.Integer(1, contacts));
  Bodies drawn(dimension, bodies, contacts, choices);
  for (int i = 0; i < contacts; ++i) {
    const int body = i < bodies ? i : static_cast<int>(choices.Integer(0, bodies - 1));
    const int other = static_cast<int>(choices.Integer(-1, bodies - 1));
    drawn.TouchBoth(i, body, other == body ? -1 : other, DrawFrame(dimension, choices), choices);
  }
  return drawn;
}

// Nothing is turned.
template <int kDimension>
ExactProblem Tame(int, Choices& choices) {
  return DrawBodies(kDimension, 1, choices).Problem();
}

// The ratio of masses: a light body and a heavy one, each pressed on the ground; every second time they touch.
template <int kDimension>
ExactProblem TwoMasses(int setting, Choices& choices) {
  const int together = static_cast<int>(choices.Integer(0, 1)), heavy = static_cast<int>(choices.Integer(0, 1));
  Bodies two(kDimension, 2, 2 + together, choices);
  for (int k = 0; k < 2; ++k) {
    const Matrix frame = DrawFrame(kDimension, choices);
    two.TouchBoth(k, k, -1, frame, choices);
    two.y.segment(k * two.freedoms, kDimension) -= frame.row(0).transpose() * Uniform(0, 40, choices);
  }
  if (together == 1) two.TouchBoth(2, 0, 1, DrawFrame(kDimension, choices), choices);
  two.W.segment(heavy * two.freedoms, two.freedoms) /= Ten(setting);
  return two.Problem();
}

// The ratio of masses of several bodies.
ExactProblem Masses(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(2, 2, choices);
  const int heavy = static_cast<int>(choices.Integer(0, bodies.bodies() - 1));
  for (int k = 0; k < bodies.bodies(); ++k) {
    const bool is_heavy = k == heavy || choices.Integer(0, 1) == 0;
    if (is_heavy) bodies.W.segment(3 * k, 3) /= Ten(setting);
  }
  return bodies.Problem();
}

// The unit of mass, and so of all forces.
ExactProblem Units(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(2, 2, choices);
  bodies.W *= Ten(setting);
  return bodies.Problem();
}

// Each contact in its own units: D A D, D b, with the same power of two, 2^-k to 2^k, for its rows.
template <int kDimension>
ExactProblem ContactUnits(int setting, Choices& choices) {
  ExactProblem problem = DrawBodies(kDimension, 2, choices).Problem();
  Vector D(problem.rows());
  for (int row = 0; row < problem.rows(); row += kDimension)
    D.segment(row, kDimension).setConstant(Power(2, static_cast<int>(choices.Integer(-setting, setting))));
  const Matrix DA = D.asDiagonal() * problem.A;
  problem.A = DA * D.asDiagonal();
  problem.b = D.cwiseProduct(problem.b).eval();
  return problem;
}

constexpr int kNone = -999;  // a setting of friction: none

template <int kDimension>
ExactProblem Friction(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(kDimension, 1, choices);
  for (Rational& mu : bodies.mu) {
    if (choices.Integer(0, 2) > 0) mu = setting == kNone ? Rational(0) : Ten(setting);
  }
  return bodies.Problem();
}

// Arms at which contacts act, beside masses that stay: 10^k m.
template <int kDimension>
ExactProblem Levers(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(kDimension, 1, choices);
  const int turns = bodies.freedoms - kDimension;
  for (int k = 0; k < bodies.bodies(); ++k)
    bodies.J.middleCols(k * bodies.freedoms + kDimension, turns) *= Ten(setting);
  return bodies.Problem();
}

// The second contact is the first, but for 10^-k.
template <int kDimension>
ExactProblem Parallel(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(kDimension, 2, choices);
  const Matrix first = bodies.J.topRows(kDimension);
  bodies.J.middleRows(kDimension, kDimension) =
      (first + bodies.J.middleRows(kDimension, kDimension) * Ten(-setting)).eval();
  return bodies.Problem();
}

// So many contacts are the first once more.
ExactProblem Duplicates(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(2, 2, choices);
  const Matrix J = bodies.J;
  bodies.J.resize(J.rows() + 2 * setting, J.cols());
  bodies.J.topRows(J.rows()) = J;
  for (int copy = 0; copy < setting; ++copy) {
    bodies.J.middleRows(J.rows() + 2 * copy, 2) = J.topRows(2);
    bodies.mu.push_back(bodies.mu.front());
  }
  return bodies.Problem();
}

// ---- Jams ----------------------------------------------------------------------------------------

constexpr int kExactly = 99;  // a setting of what is nearly so: it is so

// 10^-setting.
Rational Nearly(int setting) { return setting == kExactly ? Rational(0) : Ten(-setting); }

// A = [p z] B [p z]', B = [[e, e/2], [e/2, 1]]: forces along p, which friction allows, do little work, 10^-k,
// or none. b is that of forces of some Newton, or, where there is work, such that they are about 1 / e.
template <int kDimension>
ExactProblem Jam(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 2)), rows = contacts * kDimension;
  const Rational e = Nearly(setting);
  std::vector<Rational> mu;
  Vector p(rows);
  for (int i = 0; i < contacts; ++i) {
    const int press = static_cast<int>(choices.Integer(1, 3));
    p[i * kDimension] = press;
    for (int k = 1; k < kDimension; ++k) p[i * kDimension + k] = Uniform(-press, press, choices);
    mu.push_back(Uniform(kDimension - 1, 4, choices));
  }
  Vector z = DrawVector(rows, 3, choices);
  if (choices.Integer(0, 1) == 0) z = (z - p * Rational(z.dot(p) / p.squaredNorm())).eval();
  Matrix Q(rows, 2), B(2, 2);
  Q << p, z;
  B << e, e / 2, e / 2, 1;
  ExactProblem problem = Contacts(kDimension, mu);
  const Matrix QB = Q * B;
  problem.A = QB * Q.transpose();
  const bool large = choices.Integer(0, 1) == 0 && e > 0;
  problem.b = large ? Vector(Q * DrawVector(2, 3, choices))
                    : Vector(problem.A * DrawVector(rows, 6, choices) / Rational(3));
  return problem;
}

// A body between two walls that face each other but for 10^-k: it jams.
template <int kDimension>
ExactProblem Wedge(int setting, Choices& choices) {
  const Rational lean = Nearly(setting) * Uniform(1, 9, choices) / 9;
  Bodies body(kDimension, 1, 2, choices);
  const int up = kDimension - 1;
  for (int i = 0; i < 2; ++i) {
    const Rational side = i == 0 ? 1 : -1;
    Matrix frame = Matrix::Identity(kDimension, kDimension);
    frame(0, 0) = side;
    frame(0, up) = lean;
    frame(up, 0) = -side * lean;
    body.Touch(i, 0, frame, body.DrawArm(choices));
    body.mu[i] = Uniform(1, 8, choices) / 4;
  }
  return body.Problem();
}

// ---- What is small beside what is large ----------------------------------------------------------

// Static contacts whose normal rows are `normals`; each has a tangent of its own, which is coupled to nothing.
// Free accelerations of the coordinates: `pushed`, of tangents drawn up to 20.
ExactProblem BesideEachOther(const Matrix& normals, const Vector& pushed, Choices& choices) {
  const int contacts = static_cast<int>(normals.rows()), columns = static_cast<int>(normals.cols());
  Bodies made(2, 1, contacts, choices);
  made.J = Matrix::Zero(2 * contacts, columns + contacts);
  made.W = Vector::Constant(columns + contacts, Rational(1));
  made.y.resize(columns + contacts);
  made.y << pushed, DrawVector(contacts, 20, choices);
  for (int i = 0; i < contacts; ++i) {
    made.J.row(2 * i).head(columns) = normals.row(i);
    made.J(2 * i + 1, columns + i) = 1;
  }
  return made.Problem();
}

// A chain in which only 10^-k acts on the first contact, the next parts, and the last bears 10^k.
ExactProblem Shadow(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(3, 5));
  Matrix normals = Matrix::Identity(contacts, contacts);
  for (int i = 1; i < contacts; ++i) normals(i, i - 1) = Uniform(1, 4, choices) / 10;
  Vector pushed = DrawVector(contacts, 9, choices);
  pushed[0] = -Ten(-setting) * Uniform(1, 9, choices);
  pushed[1] = Uniform(1, 9, choices);
  pushed[contacts - 1] = -Ten(setting) * Uniform(1, 9, choices);
  return BesideEachOther(normals, pushed, choices);
}

// Two contacts that can press against each other without an end, joined by 10^-k to a third that bears 10^k.
ExactProblem ThirdOfJam(int setting, Choices& choices) {
  Matrix normals = Matrix::Zero(3, 2);
  normals(0, 0) = 1;
  normals(1, 0) = -1;
  normals(2, 0) = -Ten(-setting) * Uniform(1, 9, choices);
  normals(2, 1) = 1;
  Vector pushed(2);
  pushed << Uniform(-9, 9, choices), -Ten(setting) * Uniform(1, 9, choices);
  return BesideEachOther(normals, pushed, choices);
}

// A contact that parts with 10^k, and whose friction would carry what the others bear.
ExactProblem Ghost(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(2, 4));
  Bodies made(2, 1, contacts, choices);
  made.J = Matrix::Zero(2 * contacts, contacts + 1);
  made.W = Vector::Constant(contacts + 1, Rational(1));
  made.y = DrawVector(contacts + 1, 20, choices);
  made.J(0, 0) = 1;  // of the first normal alone
  made.y[0] = Ten(setting) * Uniform(1, 9, choices);
  made.J.bottomRightCorner(2 * contacts - 1, contacts) = DrawMatrix(2 * contacts - 1, contacts, 5, choices);
  return made.Problem();
}

// ---- Without bodies ------------------------------------------------------------------------------

// J of so many columns, integers up to `most`; W = 1.
Bodies DrawDense(int dimension, int contacts, int columns, int most, Choices& choices) {
  Bodies dense(dimension, 1, contacts, choices);
  dense.J = DrawMatrix(dimension * contacts, columns, most, choices);
  dense.W = Vector::Constant(columns, Rational(1));
  dense.y = DrawVector(columns, 100, choices);
  return dense;
}

// The condition number of A, about.
ExactProblem Conditioned(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 4)), columns = 2 * contacts;
  Bodies dense = DrawDense(2, contacts, columns, 100, choices);
  for (int k = 0; k < columns; ++k) dense.W[k] = Ten(-setting * k / (columns - 1));
  return dense.Problem();
}

// b is 10^-k from the range of A, and there may be no solution.
template <int kDimension>
ExactProblem Range(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 4));
  ExactProblem problem = DrawDense(kDimension, contacts, (kDimension - 1) * contacts, 100, choices).Problem();
  problem.b += DrawVector(problem.rows(), 100, choices) * Ten(-setting);
  return problem;
}

// The problem of two contacts on which the published algorithm loops.
ExactProblem Loop(const Rational& b) {
  constexpr int kA[4][4] = {{7, -2, -6, 0}, {-2, 9, -1, -7}, {-6, -1, 7, 3}, {0, -7, 3, 7}};
  ExactProblem problem = Contacts(2, {1, 1});
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

// 10^-k from the border of the problems that loop, on either side.
ExactProblem NearLoops(int setting, Choices& choices) {
  const Rational away = Ten(-setting) * choices.Integer(1, 9) / 9;
  return Loop(choices.Integer(0, 1) == 0 ? Rational(BorderOfLoops() + away) : Rational(BorderOfLoops() - away));
}

// Paths of 2^n - 1 pivots, of n contacts.
ExactProblem Exponential(int setting, Choices& choices) {
  ExactProblem problem = ExponentialFamily(setting);
  for (Rational& b : problem.b) b *= choices.Integer(1, 9);
  return problem;
}

// ---- Boxes ---------------------------------------------------------------------------------------

// A cube of 1 kg and 1 m on its four corners, pushed sideways, with friction 10^k: A has rank 6 of 12.
ExactProblem Cube(int setting, Choices& choices) {
  Bodies cube(3, 1, 4, choices);
  Matrix frame(3, 3);
  frame << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  for (int i = 0; i < 4; ++i) {
    Vector corner(3);
    corner << Rational(i % 2 == 0 ? -1 : 1, 2), Rational(i < 2 ? -1 : 1, 2), Rational(-1, 2);
    cube.Touch(i, 0, frame, corner);
    cube.mu[i] = Ten(setting);
  }
  cube.W << 1, 1, 1, 6, 6, 6;
  cube.y[2] = -Uniform(1, 20, choices);
  if (choices.Integer(0, 1) == 0) cube.y.tail(3).setZero();
  return cube.Problem();
}

// Ratios of masses 10^k.
ExactProblem Stack(int setting, Choices& choices) {
  return Unrounded(StackProblem(4, {2, true, setting}, choices));
}
ExactProblem StackInSpace(int setting, Choices& choices) {
  return Unrounded(StackProblem(2, {3, true, setting}, choices));
}
ExactProblem Wall(int setting, Choices& choices) {
  return Unrounded(WallProblem(3, 2, {2, true, setting}, choices));
}

// ---- The table -----------------------------------------------------------------------------------

constexpr int kLadder = static_cast<int>(Dials::kLadder), kGate = static_cast<int>(Dials::kGate);

struct Dial {
  const char* name;
  std::vector<int> settings;
  int uses;
  ExactProblem (*make)(int setting, Choices& choices);
  bool has_solution = true, is_large = false;
};

// In the order of the tables.
const std::vector<Dial>& AllDials() {
  static const std::vector<int> masses = {0, 2, 4, 6, 8, 12, 16}, units = {0, 4, 10, 26},
                                jam = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, kExactly};
  static const std::vector<Dial> dials = {
      {"tame", {0}, kLadder | kGate, &Tame<2>},
      {"masses", {0, 2, 4, 8, 12, 16}, kLadder | kGate, &Masses},
      {"levers", {-150, -75, -16, -8, 0, 8, 16, 75, 150}, kLadder | kGate, &Levers<2>},
      {"units", {-300, -150, 0, 150, 300}, kLadder | kGate, &Units},
      {"conditioned", {0, 8, 16, 32, 100, 300}, kLadder | kGate, &Conditioned},
      {"parallel", {1, 4, 8, 12, 16, 40}, kLadder | kGate, &Parallel<2>},
      {"duplicates", {0, 1, 2, 4}, kLadder | kGate, &Duplicates},
      {"friction", {kNone, -16, -8, 0, 8, 16}, kLadder | kGate, &Friction<2>},
      {"wedge", {0, 2, 4, 8, 12, 16}, kLadder | kGate, &Wedge<2>},
      {"range", {0, 4, 8, 12, 16, 40}, kLadder | kGate, &Range<2>, false},
      {"near-loops", {1, 4, 8, 12, 16, 30}, kLadder, &NearLoops},
      {"exponential", {2, 4, 6, 8, 10}, kLadder, &Exponential},
      {"stack", {0, 4, 8, 12, 16}, kLadder | kGate, &Stack, true, true},
      {"wall", {0, 4, 8, 12, 16}, kLadder, &Wall, true, true},
      {"two-masses", masses, kGate, &TwoMasses<2>},
      {"contact-units", units, kGate, &ContactUnits<2>},
      {"jam", jam, kGate, &Jam<2>},
      {"shadow", {2, 4, 6, 8, 12}, kGate, &Shadow},
      {"third-of-jam", {2, 4, 8, 12, 15}, kGate, &ThirdOfJam},
      {"ghost", {2, 4, 8, 12}, kGate, &Ghost},
      {"space-tame", {0}, kGate, &Tame<3>},
      {"space-two-masses", masses, kGate, &TwoMasses<3>},
      {"space-levers", {-8, -4, 4, 8}, kGate, &Levers<3>},
      {"space-contact-units", units, kGate, &ContactUnits<3>},
      {"space-friction", {-16, -8, 0, 4, 8, 16}, kGate, &Friction<3>},
      {"space-parallel", {1, 4, 8, 12, 16}, kGate, &Parallel<3>},
      {"space-jam", jam, kGate, &Jam<3>},
      {"space-wedge", {0, 2, 4, 8, 12, 16, kExactly}, kGate, &Wedge<3>},
      {"space-range", {0, 4, 8, 12, 16}, kGate, &Range<3>, false},
      {"space-cube", {-8, -1, 0, 1, 4, 7, 9, 12, 16}, kGate, &Cube},
      {"space-stack", {0, 4, 8, 16}, kGate, &StackInSpace, true, true},
  };
  return dials;
}

Source SourceOf(const Dial& dial, int setting) {
  const auto place = static_cast<std::uint64_t>(&dial - AllDials().data());
  const std::uint64_t stream = (place << 32) ^ static_cast<std::uint64_t>(setting + 4096);
  return {dial.name, setting, dial.has_solution, dial.is_large,
          [&dial, setting, stream](std::uint64_t seed, std::int64_t index) {
            Choices choices(ProblemSeed(seed, stream, static_cast<std::uint64_t>(index)));
            return dial.make(setting, choices);
          }};
}

}  // namespace

std::vector<Source> DialSources(Dials which, const std::vector<std::string>& families) {
  std::vector<std::string_view> names;
  std::vector<Source> sources;
  for (const Dial& dial : AllDials()) {
    if ((dial.uses & static_cast<int>(which)) == 0) continue;
    names.push_back(dial.name);
    if (!families.empty() && std::find(families.begin(), families.end(), dial.name) == families.end()) continue;
    for (const int setting : dial.settings) sources.push_back(SourceOf(dial, setting));
  }
  for (const std::string& name : families) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("--families: found '{}', expected one of {}", name, fmt::join(names, ", ")));
  }
  return sources;
}

std::vector<Source> GeneratorSources(const std::vector<int>& sizes) {
  std::vector<Source> sources;
  for (const GeneratorRow& row : Generators()) {
    if (!row.IsPlain()) continue;
    for (const int contacts : sizes)
      sources.push_back({std::string(row.name), contacts, true, false,
                         [id = row.id, contacts](std::uint64_t seed, std::int64_t index) {
                           Choices choices(ProblemSeed(seed, 100 + contacts, index));
                           ExactProblem problem;
                           Generate<Rational, Eigen::Dynamic>(id, contacts, kDefaultPalette, choices, problem);
                           return problem;
                         }});
  }
  return sources;
}

int BenchProblems(const BenchOptions& o) {
  for (const Source& source :
       o.contacts.empty() ? DialSources(Dials::kLadder, o.families) : GeneratorSources(o.contacts)) {
    std::vector<SharedJson> problems;
    for (std::int64_t index = 0; index < o.problems.value_or(25); ++index)
      problems.push_back(ProblemToJson(source.make(o.seed, index)));
    std::cout << JsonText(SharedJson{{"family", source.family},
                                     {"setting", source.setting},
                                     {"has_solution", source.has_solution},
                                     {"problems", std::move(problems)}})
              << std::endl;
  }
  return kExitDone;
}

}  // namespace stiction
