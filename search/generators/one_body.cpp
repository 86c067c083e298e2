// SPDX-License-Identifier: Apache-2.0
// one-body: one body of any distribution of mass.

#include <array>

#include "search/generators/body_problem.h"
#include "search/generators/generator.h"

namespace stiction::generators {
namespace {

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
