// SPDX-License-Identifier: Apache-2.0
// bodies: rigid bodies, joined at points. one-body: one of any distribution of mass.

#include <algorithm>
#include <array>

#include "search/generators/body_problem.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

// ---- bodies ----------------------------------------------------------------------------------

template <class Scalar>
Scalar DrawPositive(Choices& choices) {
  const int numerator = static_cast<int>(choices.Integer(1, 5));
  const int denominator = static_cast<int>(choices.Integer(1, 5));
  return Scalar(numerator) / Scalar(denominator);
}

// Mass and inertia n / d with n, d in [1, 5]; gravity of 10 m/s^2 along -y, applied force and torque in
// [-20, 20], or both.
template <class Scalar>
Body<Scalar> DrawBody(bool gravity, bool applied, Choices& choices) {
  Body<Scalar> body;
  body.x = static_cast<int>(choices.Integer(-20, 20));
  body.y = static_cast<int>(choices.Integer(-20, 20));
  const Scalar inverse_mass = Scalar(1) / DrawPositive<Scalar>(choices);
  const Scalar inverse_inertia = Scalar(1) / DrawPositive<Scalar>(choices);
  body.inverse_mass = {inverse_mass, inverse_mass, inverse_inertia};
  body.free_acceleration = {Scalar(0), Scalar(gravity ? -10 : 0), Scalar(0)};
  if (applied) {
    for (int k = 0; k < 3; ++k) {
      body.free_acceleration[k] += Scalar(static_cast<int>(choices.Integer(-20, 20))) * body.inverse_mass[k];
    }
  }
  return body;
}

// J by contacts: contact i < bodies is one of body i, so that each body has one; the partner is the world
// or another body. One point, in tenths, and one normal per contact, so that all arms fit together.
template <class Scalar, int Rows>
BodyJacobian<Scalar, Rows> DrawContacts(int rows, int bodies, const std::array<Body<Scalar>, kMaxBodies>& body,
                                        Choices& choices) {
  BodyJacobian<Scalar, Rows> J = NoContacts<Scalar, Rows>(rows, bodies);
  for (int contact = 0; contact < rows / 2; ++contact) {
    const int x = static_cast<int>(choices.Integer(-20, 20)), y = static_cast<int>(choices.Integer(-20, 20));
    const Vector2<Scalar> normal = DrawNormal<Scalar>(7, choices);
    const auto set = [&](int index, int sign) {
      const Vector2<Scalar> arm = MakeVector2<Scalar>(Scalar(Scalar(x - body[index].x) / Scalar(10)),
                                                      Scalar(Scalar(y - body[index].y) / Scalar(10)));
      SetSceneRows<Scalar>(normal, arm, contact, index, sign, J);
    };
    const int mine = contact < bodies ? contact : static_cast<int>(choices.Integer(0, bodies - 1));
    const int offset = static_cast<int>(choices.Integer(0, bodies - 1));  // 0: the world
    set(mine, 1);
    const int other = (mine + offset) % bodies;
    if (other != mine) set(other, -1);
  }
  return J;
}

// Not modelled: shapes. Bodies may overlap each other and the world, and lie on either side of a contact.
template <class Scalar, int Rows>
int FillBodies(bool gravity_only, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int bodies = static_cast<int>(choices.Integer(1, std::min(kMaxBodies, rows / 2)));
  const int load = gravity_only ? 0 : static_cast<int>(choices.Integer(0, 2));
  std::array<Body<Scalar>, kMaxBodies> body;
  for (int i = 0; i < bodies; ++i) body[i] = DrawBody<Scalar>(load != 1, load != 0, choices);
  const BodyJacobian<Scalar, Rows> J = DrawContacts<Scalar, Rows>(rows, bodies, body, choices);
  SetFromBodies(J, bodies, body, problem);
  return 3 * bodies;
}

// ---- one-body --------------------------------------------------------------------------------

// The centre of mass is the origin; points in millimetres.
template <class Scalar, int Rows>
int FillOneBody(bool gravity_only, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const bool applied = !gravity_only && choices.Integer(0, 1) == 1;
  std::array<Body<Scalar>, kMaxBodies> body;
  const int numerator = static_cast<int>(choices.Integer(1, 1000));
  const int denominator = static_cast<int>(choices.Integer(1, 1'000'000'000));
  const Scalar inertia = Scalar(numerator) / Scalar(denominator);
  body[0].inverse_mass = {Scalar(1), Scalar(1), Scalar(Scalar(1) / inertia)};
  body[0].free_acceleration = {Scalar(0), Scalar(-10), Scalar(0)};
  for (int k = 0; applied && k < 3; ++k) {
    const Scalar load = Scalar(static_cast<int>(choices.Integer(-2000, 2000))) / Scalar(100);
    body[0].free_acceleration[k] += load * body[0].inverse_mass[k];
  }
  BodyJacobian<Scalar, Rows> J = NoContacts<Scalar, Rows>(rows, 1);
  for (int contact = 0; contact < rows / 2; ++contact) {
    const Scalar x = Scalar(static_cast<int>(choices.Integer(-2000, 2000))) / Scalar(1000);
    const Scalar y = Scalar(static_cast<int>(choices.Integer(-2000, 2000))) / Scalar(1000);
    const Vector2<Scalar> normal = DrawNormal<Scalar>(64, choices);
    SetSceneRows<Scalar>(normal, MakeVector2<Scalar>(x, y), contact, 0, 1, J);
  }
  SetFromBodies(J, 1, body, problem);
  return 3;
}

}  // namespace

Generator MakeBodies() {
  static constexpr GeneratorRow kRow = {
      .name = "bodies",
      .distribution =
          "1 to 3 planar rigid bodies at rest and the world, joined at n points: rational "
          "masses, inertias, points and unit normals (Pythagorean), under gravity, applied "
          "forces or both; A = J M^-1 J', b = J M^-1 F. Overlap of shapes is not modelled.",
      .exact_in_double = false,
      .has_gravity = true,
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillBodies(given.gravity_only, choices, problem);
  });
}

Generator MakeOneBody() {
  static constexpr GeneratorRow kRow = {
      .name = "one-body",
      .distribution =
          "One planar rigid body at rest and the world, joined at n points: as bodies, with "
          "numbers of four digits, and any distribution of mass: mass 1, inertia p/q with p in "
          "1..1000 and q in 1..10^9, so that its centre may be far from the points beside its "
          "radius of inertia. Not part of a campaign that names no generators.",
      .exact_in_double = false,
      .has_gravity = true,
  };
  return GeneratorOf<kRow>([](const Given& given, Choices& choices, auto& problem) {
    return FillOneBody(given.gravity_only, choices, problem);
  });
}

}  // namespace stiction::generators
