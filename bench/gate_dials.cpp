// SPDX-License-Identifier: Apache-2.0
#include "bench/gate_dials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "bench/dials.h"
#include "bench/structure.h"
#include "corpus/rounded.h"
#include "search/generators.h"

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;
using Vector = ExactProblem::Vector;

// ---- Numbers -------------------------------------------------------------------------------------

Rational Ten(int exponent) {
  const Rational power(PowerOfTen(static_cast<unsigned long>(std::abs(exponent))));
  return exponent >= 0 ? power : Rational(1 / power);
}

Rational Two(int exponent) {
  Rational power = 1;
  for (int k = 0; k < std::abs(exponent); ++k) power *= 2;
  return exponent >= 0 ? power : Rational(1 / power);
}

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

constexpr std::array kFrictions = {MuChoice{1, 5}, MuChoice{1, 2}, MuChoice{1, 1}, MuChoice{2, 1}};

Rational DrawFriction(Choices& choices) {
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

  // Of a body with another, or with the ground (-1).
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

template <int kDimension>
ExactProblem Tame(int, Choices& choices) {
  return DrawBodies(kDimension, 1, choices).Problem();
}

// A light body and a heavy one, each pressed on the ground; every second time they touch.
template <int kDimension>
ExactProblem Masses(int setting, Choices& choices) {
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

// Each contact in its own units: D A D, D b, with the same power of two for its rows.
template <int kDimension>
ExactProblem ContactUnits(int setting, Choices& choices) {
  ExactProblem problem = DrawBodies(kDimension, 2, choices).Problem();
  Vector D(problem.rows());
  for (int row = 0; row < problem.rows(); row += kDimension)
    D.segment(row, kDimension).setConstant(Two(static_cast<int>(choices.Integer(-setting, setting))));
  const Matrix DA = D.asDiagonal() * problem.A;
  problem.A = DA * D.asDiagonal();
  problem.b = D.cwiseProduct(problem.b).eval();
  return problem;
}

ExactProblem FrictionInSpace(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(3, 1, choices);
  for (Rational& mu : bodies.mu) {
    if (choices.Integer(0, 2) > 0) mu = Ten(setting);
  }
  return bodies.Problem();
}

// Arms at which contacts act, beside masses that stay.
ExactProblem LeversInSpace(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(3, 1, choices);
  for (int k = 0; k < bodies.bodies(); ++k) bodies.J.middleCols(6 * k + 3, 3) *= Ten(setting);
  return bodies.Problem();
}

// The second contact is the first, but for so little.
ExactProblem ParallelInSpace(int setting, Choices& choices) {
  Bodies bodies = DrawBodies(3, 2, choices);
  bodies.J.middleRows(3, 3) = (bodies.J.topRows(3) + bodies.J.middleRows(3, 3) * Ten(-setting)).eval();
  return bodies.Problem();
}

// ---- Jams ----------------------------------------------------------------------------------------

constexpr int kExactly = 99;  // a setting of what is nearly so: it is so

// 10^-setting.
Rational Nearly(int setting) { return setting == kExactly ? Rational(0) : Ten(-setting); }

// A = [p z] B [p z]', B = [[e, e/2], [e/2, 1]]: forces along p, which friction allows, do little work or none.
// b is that of forces of some Newton, or, where there is work, such that they are about 1 / e.
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

// A body between two walls that face each other but for so much.
ExactProblem WedgeInSpace(int setting, Choices& choices) {
  const Rational lean = Nearly(setting) * Uniform(1, 9, choices) / 9;
  Bodies body(3, 1, 2, choices);
  for (int i = 0; i < 2; ++i) {
    const Rational side = i == 0 ? 1 : -1;
    Matrix frame(3, 3);
    frame << side, 0, lean, 0, 1, 0, -side * lean, 0, 1;
    body.Touch(i, 0, frame, body.DrawArm(choices));
    body.mu[i] = Uniform(1, 8, choices) / 4;
  }
  return body.Problem();
}

// b is so far from the range of A, and may have no solution.
ExactProblem RangeInSpace(int setting, Choices& choices) {
  const int contacts = static_cast<int>(choices.Integer(1, 3)), rows = 3 * contacts;
  std::vector<Rational> mu;
  for (int i = 0; i < contacts; ++i) mu.push_back(DrawFriction(choices));
  ExactProblem problem = Contacts(3, mu);
  const Matrix J = DrawMatrix(rows, 2 * contacts, 9, choices);
  problem.A = J * J.transpose();
  problem.b = J * DrawVector(2 * contacts, 100, choices) + DrawVector(rows, 100, choices) * Ten(-setting);
  return problem;
}

// ---- Boxes ---------------------------------------------------------------------------------------

// A cube of 1 kg and 1 m on its four corners, pushed sideways, with friction 10^setting: A has rank 6 of 12.
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

ExactProblem StackInSpace(int setting, Choices& choices) {
  return Unrounded(SpaceStackProblem(2, setting, choices));
}

// ---- The table -----------------------------------------------------------------------------------

constexpr std::array kOfThePlane = {"tame",     "masses",     "levers", "units", "conditioned", "parallel",
                                    "friction", "duplicates", "wedge",  "range", "stack"};

const std::vector<Dial>& MoreDials() {
  static const std::vector<int> masses = {0, 2, 4, 6, 8, 12, 16}, units = {0, 4, 10, 26},
                                jam = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, kExactly};
  static const std::vector<Dial> dials = {
      {"two-masses", "two bodies apart or touching, ratio of masses", "10^k", masses, true, &Masses<2>},
      {"contact-units", "a unit for each contact", "2^-k to 2^k", units, true, &ContactUnits<2>},
      {"jam", "work of forces that jam", "10^-k, 99: none", jam, true, &Jam<2>},
      {"space-tame", "nothing", "", {0}, true, &Tame<3>},
      {"space-two-masses", "two bodies apart or touching, ratio of masses", "10^k", masses, true, &Masses<3>},
      {"space-levers", "arms of contacts", "10^k m", {-8, -4, 4, 8}, true, &LeversInSpace},
      {"space-contact-units", "a unit for each contact", "2^-k to 2^k", units, true, &ContactUnits<3>},
      {"space-friction", "friction", "10^k", {-16, -8, 0, 4, 8, 16}, true, &FrictionInSpace},
      {"space-parallel", "contacts alike but for", "10^-k", {1, 4, 8, 12, 16}, true, &ParallelInSpace},
      {"space-jam", "work of forces that jam", "10^-k, 99: none", jam, true, &Jam<3>},
      {"space-wedge",
       "walls face each other but for",
       "10^-k",
       {0, 2, 4, 8, 12, 16, kExactly},
       true,
       &WedgeInSpace},
      {"space-range", "b from the range of A", "10^-k", {0, 4, 8, 12, 16}, false, &RangeInSpace},
      {"space-cube", "a cube pushed, friction", "10^k", {-8, -1, 0, 1, 4, 7, 9, 12, 16}, true, &Cube},
      {"space-stack", "two boxes, ratio of masses", "10^k", {0, 4, 8, 16}, true, &StackInSpace, true},
  };
  return dials;
}

Source SourceOf(const Dial& dial, int setting) {
  const auto place = static_cast<std::uint64_t>(&dial - MoreDials().data()) + 1000;
  return {dial.name, setting, dial.has_solution, dial.is_large,
          [&dial, setting, place](std::uint64_t seed, std::int64_t index) {
            const std::uint64_t unit = (place << 32) ^ static_cast<std::uint64_t>(setting + 4096);
            Choices choices(ProblemSeed(seed, unit, static_cast<std::uint64_t>(index)));
            return dial.make(setting, choices);
          }};
}

}  // namespace

std::vector<Source> GateSources(const std::vector<std::string>& families) {
  std::vector<Source> all = DialSources({kOfThePlane.begin(), kOfThePlane.end()});
  for (const Dial& dial : MoreDials()) {
    for (const int setting : dial.settings) all.push_back(SourceOf(dial, setting));
  }
  std::vector<Source> asked;
  for (const Source& source : all) {
    if (families.empty() || std::find(families.begin(), families.end(), source.family) != families.end())
      asked.push_back(source);
  }
  for (const std::string& name : families) {
    if (std::none_of(asked.begin(), asked.end(), [&name](auto& source) { return source.family == name; }))
      throw InputError(fmt::format("--families: found '{}', expected a dial of the suite gate", name));
  }
  return asked;
}

}  // namespace stiction
