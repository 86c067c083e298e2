// SPDX-License-Identifier: Apache-2.0
// Definitions for generators.h.
//
// Arithmetic on small integers stays in int; everything else is done over Scalar, so that rationals redo
// exactly what doubles do. For the exact generators a bound on every integer that can arise is stated: all
// partial sums are integers (times one power of two) of at most 53 bits, hence exact in any order.
//
//   r <= 24 rows, c <= 24 columns (the plane: 16); abs(J) <= p, abs(x) <= q, abs(y) <= q:
//   abs(A) <= c p^2,  abs(J y) <= c p q,  abs(A x) <= r c p^2 q

#ifndef STICTION_SEARCH_GENERATORS_IPP_
#define STICTION_SEARCH_GENERATORS_IPP_

#include <algorithm>
#include <utility>

#include "search/generators/generators.h"
#include "search/generators/scenes.ipp"
#include "solver/problem/check.h"
#include "solver/problem/scalar.h"

namespace stiction {
namespace generators {

inline constexpr int kMaxRows = 2 * kMaxContacts;  // of the plane
inline constexpr int kMaxBodies = kMostSceneBodies;

// On the stack for fixed Rows. Only the leading columns in use are ever set or read.
template <class Scalar, int Rows>
using Jacobian = Eigen::Matrix<Scalar, Rows, Rows>;

template <class Scalar, int Rows>
Jacobian<Scalar, Rows> MakeJacobian(int rows, int columns) {
  Jacobian<Scalar, Rows> J;
  if constexpr (Rows == Eigen::Dynamic) J.resize(rows, columns);
  return J;
}

template <class Scalar, int Rows>
void Resize(int contacts, int dimension, ContactProblem<Scalar, Rows>& problem) {
  problem.dimension = dimension;
  if constexpr (Rows == Eigen::Dynamic) {
    problem.contacts.resize(contacts);
    problem.A.resize(dimension * contacts, dimension * contacts);
    problem.b.resize(dimension * contacts);
  }
}

// Makes all contacts static and returns their friction coefficients.
template <class Scalar, int Rows>
std::array<MuChoice, kMaxContacts> DrawFriction(std::span<const MuChoice> palette, Choices& choices,
                                                ContactProblem<Scalar, Rows>& problem) {
  std::array<MuChoice, kMaxContacts> chosen;
  const int last = static_cast<int>(palette.size()) - 1;
  const bool single = choices.Integer(0, 1) == 0;
  std::size_t pick = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (i == 0 || !single) pick = choices.Integer(0, last);
    chosen[i] = palette[pick];
    Contact<Scalar>& contact = problem.contacts[i];
    contact.kind = ContactKind::kStatic;
    contact.mu = Scalar(chosen[i].numerator);
    if (chosen[i].denominator != 1) contact.mu /= Scalar(chosen[i].denominator);
    contact.slip = {Scalar(0), Scalar(0)};
  }
  return chosen;
}

// `columns` columns of uniform integers, column by column.
template <class Scalar, int Rows, int kLow, int kHigh>
Jacobian<Scalar, Rows> DrawIntegers(int rows, int columns, Choices& choices) {
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<kLow, kHigh>(rows * columns, [entries](int i, int value) { entries[i] = Scalar(value); });
  return J;
}

// A = L R', which is symmetric: L = J W, R = J.
template <class Scalar, int Rows, class Factor>
void SetProduct(const Factor& L, const Factor& R, int columns, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  typename ContactProblem<Scalar, Rows>::Vector column(rows);
  for (int j = 0; j < rows; ++j) {
    const int first = kIsExact<Scalar> ? j : 0;  // over doubles whole columns are faster
    for (int i = first; i < rows; ++i) column[i] = L(i, 0) * R(j, 0);
    for (int k = 1; k < columns; ++k) {
      for (int i = first; i < rows; ++i) column[i] += L(i, k) * R(j, k);
    }
    for (int i = first; i < rows; ++i) problem.A(i, j) = column[i];
  }
}

template <class Scalar, int Rows>
void MirrorLowerTriangle(ContactProblem<Scalar, Rows>& problem) {
  for (int j = 1; j < problem.rows(); ++j) {
    for (int i = 0; i < j; ++i) problem.A(i, j) = problem.A(j, i);
  }
}

// A = J J'.
template <class Scalar, int Rows>
void SetGram(const Jacobian<Scalar, Rows>& J, int columns, ContactProblem<Scalar, Rows>& problem) {
  SetProduct(J, J, columns, problem);
  if constexpr (kIsExact<Scalar>) MirrorLowerTriangle(problem);
}

// b = M times y(0), ..., y(columns - 1).
template <class Scalar, int Rows, class Factor, class Coefficient>
void SetImage(const Factor& M, int columns, Coefficient y, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  for (int i = 0; i < rows; ++i) problem.b[i] = Scalar(0);
  for (int k = 0; k < columns; ++k) {
    const Scalar coefficient = y(k);
    for (int i = 0; i < rows; ++i) problem.b[i] += M(i, k) * coefficient;
  }
}

// b = M x with uniform integers x.
template <class Scalar, int Rows, int kLow, int kHigh, class Factor>
void DrawImage(const Factor& M, int columns, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  std::array<int, 3 * kMaxContacts> x;
  choices.ForEach<kLow, kHigh>(columns, [&x](int i, int value) { x[i] = value; });
  SetImage(
      M, columns, [&x](int k) { return Scalar(x[k]); }, problem);
}

// ---- integers, space, duplicates ---------------------------------------------------------------------

// A = J J', and b = J y or b = A x. Bound: 24 * 24 * 5^2 * 5 < 2^17.
template <class Scalar, int Rows>
void SetFromIntegers(const Jacobian<Scalar, Rows>& J, int columns, Choices& choices,
                     ContactProblem<Scalar, Rows>& problem) {
  SetGram(J, columns, problem);
  if (choices.Integer(0, 1) == 0) {
    DrawImage<Scalar, Rows, -5, 5>(J, columns, choices, problem);
  } else {
    DrawImage<Scalar, Rows, -5, 5>(problem.A, problem.rows(), choices, problem);
  }
}

template <class Scalar, int Rows>
int Integers(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  const auto J = DrawIntegers<Scalar, Rows, -5, 5>(problem.rows(), columns, choices);
  SetFromIntegers(J, columns, choices, problem);
  return columns;
}

// Of which one contact at least, and each other with probability 1/2, is of another kind.
template <class Scalar, int Rows>
int WithOtherKinds(ContactKind kind, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  if constexpr (Rows == Eigen::Dynamic) {
    const auto contacts = static_cast<std::int64_t>(problem.contacts.size());
    const std::int64_t certain = choices.Integer(0, contacts - 1);
    for (std::int64_t i = 0; i < contacts; ++i) {
      if (i != certain && choices.Integer(0, 1) == 0) continue;
      Contact<Scalar>& contact = problem.contacts[static_cast<std::size_t>(i)];
      contact.kind = kind;
      if (kind == ContactKind::kBilateral) contact.mu = Scalar(0);
      if (kind == ContactKind::kSliding) contact.slip[0] = Scalar(choices.Integer(0, 1) == 0 ? 1 : -1);
    }
    const int rows = RowCount(problem.contacts, 2);
    problem.A.resize(rows, rows);
    problem.b.resize(rows);
    return Integers(choices, problem);
  } else {
    STICTION_CHECK(false, "fixed sizes hold static contacts only");
    return 0;
  }
}

// Contact `to` becomes contact `from`, its tangent reversed if sign = -1.
template <class Scalar, int Rows>
void CopyContact(int from, int to, int sign, int columns, Jacobian<Scalar, Rows>& J) {
  for (int k = 0; k < columns; ++k) {
    J(2 * to, k) = J(2 * from, k);
    J(2 * to + 1, k) = Scalar(sign) * J(2 * from + 1, k);
  }
}

template <class Scalar, int Rows>
int Duplicates(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int contacts = problem.rows() / 2;
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  auto J = DrawIntegers<Scalar, Rows, -5, 5>(problem.rows(), columns, choices);
  const int certain = contacts > 1 ? static_cast<int>(choices.Integer(1, contacts - 1)) : 0;
  int copies = 0;
  for (int to = 1; to < contacts; ++to) {
    if (to != certain && choices.Integer(0, 3) != 3) continue;
    ++copies;
    const int from = static_cast<int>(choices.Integer(0, to - 1));
    const int sign = choices.Integer(0, 1) == 0 ? 1 : -1;
    CopyContact<Scalar, Rows>(from, to, sign, columns, J);
  }
  SetFromIntegers(J, columns, choices, problem);
  return std::min(columns, 2 * (contacts - copies));
}

// ---- psd --------------------------------------------------------------------------------------

// Entries of J are multiples of 2^-15 in [-1, 1), x multiples of 2^-11 in [-1, 1). In units of 2^-30
// abs(A) <= 16 * 2^30 = 2^34, in units of 2^-41 abs(A x) <= 16 * 2^34 * 2^11 = 2^49.
template <class Scalar, int Rows>
int Psd(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int columns = static_cast<int>(choices.Integer(1, rows));
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<-32768, 32767>(rows * columns,
                                 [entries](int i, int value) { entries[i] = Scalar(value * 0x1p-15); });
  SetGram(J, columns, problem);
  std::array<int, kMaxRows> x;
  choices.ForEach<-2048, 2047>(rows, [&x](int i, int value) { x[i] = value; });
  SetImage(
      problem.A, rows, [&x](int k) { return Scalar(x[k] * 0x1p-11); }, problem);
  return columns;
}

// ---- small ------------------------------------------------------------------------------------

// Values are -2 ... 2 with weights 1 1 5 1 1. Bound: abs(A) <= 16 * 2^2, abs(J y) <= 16 * 2 * 2.
template <class Scalar, int Rows>
int Small(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int columns = static_cast<int>(choices.Integer(1, problem.rows()));
  auto J = MakeJacobian<Scalar, Rows>(problem.rows(), columns);
  Scalar* entries = J.data();
  choices.ForEach<-4, 4>(problem.rows() * columns, [entries](int i, int value) {
    entries[i] = Scalar(value - std::clamp(value, -2, 2));
  });
  SetGram(J, columns, problem);
  DrawImage<Scalar, Rows, -2, 2>(J, columns, choices, problem);
  return columns;
}

// ---- near-degenerate --------------------------------------------------------------------------

// Forces f0 at or near the boundary of every contact's conditions: open (fN = 0), at a friction limit
// (fF = +-mu fN), or inside. Integers: fN is a multiple of mu's denominator. abs(f0) <= 4 * 64.
inline std::array<int, kMaxRows> DrawBoundaryForces(int contacts, const std::array<MuChoice, kMaxContacts>& mu,
                                                    Choices& choices) {
  std::array<int, kMaxRows> f0;
  for (int i = 0; i < contacts; ++i) {
    const int state = static_cast<int>(choices.Integer(0, 3));
    const int size = state == 0 ? 0 : static_cast<int>(choices.Integer(1, 4));
    const int limit = size * mu[i].numerator;
    f0[2 * i] = size * mu[i].denominator;
    f0[2 * i + 1] = state == 3 ? -limit : limit;
    if (state == 1) f0[2 * i + 1] = static_cast<int>(choices.Integer(-limit, limit));
  }
  return f0;
}

// J = 2^k [C 0] + N with C, N in [-3, 3], 2 <= k <= 16: nearly of the rank of C. b = J (e - J' f0) with e
// in [-1, 1] or e = 0: the acceleration at f0 is J e, small beside b, or zero.
//
// Bounds: abs(J) <= 3 * 2^k + 3 <= 2^(k + 2), abs(A) <= 2^(2k + 8) <= 2^40, abs(J' f0) <= 16 * 2^(k + 2) *
// 2^8 = 2^(k + 14), abs(b) <= 16 * 2^(k + 2) * (2^(k + 14) + 1) <= 2^52 + 2^22.
template <class Scalar, int Rows>
int NearDegenerate(const std::array<MuChoice, kMaxContacts>& mu, Choices& choices,
                   ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int columns = static_cast<int>(choices.Integer(1, rows));
  const int coarse_columns = static_cast<int>(choices.Integer(1, columns));
  const int scale = 1 << choices.Integer(2, 16);
  std::array<int, kMaxRows * kMaxRows> coarse;
  choices.ForEach<-3, 3>(rows * coarse_columns, [&coarse](int i, int value) { coarse[i] = value; });
  std::fill(coarse.begin() + rows * coarse_columns, coarse.begin() + rows * columns, 0);
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  Scalar* entries = J.data();
  choices.ForEach<-3, 3>(rows * columns, [entries, &coarse, scale](int i, int value) {
    entries[i] = Scalar(scale * coarse[i] + value);
  });
  const std::array<int, kMaxRows> f0 = DrawBoundaryForces(rows / 2, mu, choices);
  std::array<int, kMaxRows> e{};
  if (choices.Integer(0, 3) != 0) {
    choices.ForEach<-1, 1>(columns, [&e](int i, int value) { e[i] = value; });
  }
  SetGram(J, columns, problem);
  const auto y = [&](int k) {
    Scalar sum = Scalar(e[k]);
    for (int i = 0; i < rows; ++i) sum -= J(i, k) * Scalar(f0[i]);
    return sum;
  };
  SetImage(J, columns, y, problem);
  return columns;
}

// ---- conditioned ------------------------------------------------------------------------------

// 10^(-1 / m), nearest double; [0] is for a single singular value.
inline constexpr std::array<double, kMaxRows> kRootsOfATenth = {
    1.0,
    0x1.999999999999ap-4,
    0x1.43d136248490fp-2,
    0x1.db4c7760bcff2p-2,
    0x1.1feb33c1c381ep-1,
    0x1.430cd74f6d478p-1,
    0x1.5cd2506741989p-1,
    0x1.707aa3f9e1202p-1,
    0x1.7ff2224115d9ap-1,
    0x1.8c6c4a1731220p-1,
    0x1.96b230bcdc434p-1,
    0x1.9f4c8a4e09bc7p-1,
    0x1.a69b609b6a52fp-1,
    0x1.ace415695e178p-1,
    0x1.b25a001781193p-1,
    0x1.b723eab4b8f23p-1,
};

// J = diag(sigma): `columns` values, geometric from 1 down to 10^-exponent.
template <int Rows>
Jacobian<double, Rows> SingularValues(int rows, int columns, int exponent) {
  double ratio = 1;
  for (int i = 0; i < exponent; ++i) ratio *= kRootsOfATenth[columns - 1];
  auto J = MakeJacobian<double, Rows>(rows, columns);
  double sigma = 1;
  for (int k = 0; k < columns; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = 0;
    J(k, k) = sigma;
    sigma *= ratio;
  }
  return J;
}

// Applies I - 2 v v' / v'v, v = (0, ..., 0, drawn integers), to the last `size` rows. v = 0: the identity.
template <int Rows>
void DrawReflection(int rows, int columns, int size, Choices& choices, Jacobian<double, Rows>& J) {
  std::array<double, kMaxRows> v;
  choices.ForEach<-128, 127>(size, [&v](int i, int value) { v[i] = value; });
  double length2 = 0;
  for (int i = 0; i < size; ++i) length2 += v[i] * v[i];
  if (length2 == 0) return;
  const double factor = 2 / length2;
  const int first = rows - size;
  for (int k = 0; k < columns; ++k) {
    double along = 0;
    for (int i = 0; i < size; ++i) along += v[i] * J(first + i, k);
    along *= factor;
    for (int i = 0; i < size; ++i) J(first + i, k) -= along * v[i];
  }
}

// J = U diag(sigma) rounded to double, taken exactly from there on. U: reflections of 2, 3, ..., 2n rows,
// their vectors uniform in a cube.
template <class Scalar, int Rows>
int Conditioned(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int exponent = static_cast<int>(choices.Integer(0, 8));
  const bool full = choices.Integer(0, 1) == 0;
  const int columns = full ? rows : static_cast<int>(choices.Integer(1, rows - 1));
  Jacobian<double, Rows> rounded = SingularValues<Rows>(rows, columns, exponent);
  for (int size = 2; size <= rows; ++size) DrawReflection<Rows>(rows, columns, size, choices, rounded);
  auto J = MakeJacobian<Scalar, Rows>(rows, columns);
  for (int k = 0; k < columns; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = Scalar(rounded(i, k));
  }
  SetGram(J, columns, problem);
  DrawImage<Scalar, Rows, -5, 5>(J, columns, choices, problem);
  return columns;
}

// ---- bodies -----------------------------------------------------------------------------------

// A planar body; lengths in tenths of a metre, masses in kg, inertias in kg m^2.
template <class Scalar>
struct Body {
  int x = 0, y = 0;                         // centre of mass, in tenths
  std::array<Scalar, 3> inverse_mass;       // 1/m, 1/m, 1/I
  std::array<Scalar, 3> free_acceleration;  // of the centre along x and y, and angular
};

// Columns of J, three per body.
template <class Scalar, int Rows>
using BodyJacobian =
    Eigen::Matrix<Scalar, Rows, Rows == Eigen::Dynamic ? Eigen::Dynamic : 3 * std::min(kMaxBodies, Rows / 2)>;

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

// Contact point and unit normal (nx, ny); the tangent is (-ny, nx).
template <class Scalar>
struct ContactFrame {
  int x, y;  // in tenths
  Scalar nx, ny;
};

// Normals 2pq : p^2 - q^2 over p^2 + q^2, all quadrants; p = q = 0 counts as (1, 0): straight up.
template <class Scalar>
ContactFrame<Scalar> DrawContactFrame(Choices& choices) {
  const int x = static_cast<int>(choices.Integer(-20, 20));
  const int y = static_cast<int>(choices.Integer(-20, 20));
  int p = static_cast<int>(choices.Integer(-7, 7));
  const int q = static_cast<int>(choices.Integer(-7, 7));
  if (p == 0 && q == 0) p = 1;
  const Scalar length = Scalar(p * p + q * q);
  return {x, y, Scalar(2 * p * q) / length, Scalar(p * p - q * q) / length};
}

// The rows of one contact in the columns of one body: sign * (n, r x n) and sign * (t, r x t).
template <class Scalar, class Columns>
void SetContactRows(const ContactFrame<Scalar>& frame, const Body<Scalar>& body, int contact, int index,
                    int sign, Columns& J) {
  const Scalar rx = Scalar(frame.x - body.x) / Scalar(10);
  const Scalar ry = Scalar(frame.y - body.y) / Scalar(10);
  const Scalar nx = Scalar(sign) * frame.nx;
  const Scalar ny = Scalar(sign) * frame.ny;
  J(2 * contact, 3 * index) = nx;
  J(2 * contact, 3 * index + 1) = ny;
  J(2 * contact, 3 * index + 2) = rx * ny - ry * nx;
  J(2 * contact + 1, 3 * index) = -ny;
  J(2 * contact + 1, 3 * index + 1) = nx;
  J(2 * contact + 1, 3 * index + 2) = rx * nx + ry * ny;
}

template <class Scalar, int Rows>
BodyJacobian<Scalar, Rows> NoContacts(int rows, int bodies) {
  BodyJacobian<Scalar, Rows> J;
  if constexpr (Rows == Eigen::Dynamic) J.resize(rows, 3 * bodies);
  for (int k = 0; k < 3 * bodies; ++k) {
    for (int i = 0; i < rows; ++i) J(i, k) = Scalar(0);
  }
  return J;
}

// J by contacts: contact i < bodies is one of body i, so that each body has one; the partner is the world
// or another body. One point and one frame per contact, so that all arms fit together.
template <class Scalar, int Rows>
BodyJacobian<Scalar, Rows> DrawContacts(int rows, int bodies, const std::array<Body<Scalar>, kMaxBodies>& body,
                                        Choices& choices) {
  BodyJacobian<Scalar, Rows> J = NoContacts<Scalar, Rows>(rows, bodies);
  for (int contact = 0; contact < rows / 2; ++contact) {
    const ContactFrame<Scalar> frame = DrawContactFrame<Scalar>(choices);
    const int mine = contact < bodies ? contact : static_cast<int>(choices.Integer(0, bodies - 1));
    const int offset = static_cast<int>(choices.Integer(0, bodies - 1));  // 0: the world
    SetContactRows(frame, body[mine], contact, mine, 1, J);
    const int other = (mine + offset) % bodies;
    if (other != mine) SetContactRows(frame, body[other], contact, other, -1, J);
  }
  return J;
}

// A = J M^-1 J', b = J M^-1 F for bodies at rest.
template <class Scalar, int Rows, class AnyBody>
void SetFromBodies(const BodyJacobian<Scalar, Rows>& J, int bodies, const std::array<AnyBody, kMaxBodies>& body,
                   ContactProblem<Scalar, Rows>& problem) {
  BodyJacobian<Scalar, Rows> weighted = J;
  for (int k = 0; k < 3 * bodies; ++k) {
    for (int i = 0; i < problem.rows(); ++i) weighted(i, k) *= body[k / 3].inverse_mass[k % 3];
  }
  SetProduct(weighted, J, 3 * bodies, problem);
  MirrorLowerTriangle(problem);
  SetImage(
      J, 3 * bodies, [&body](int k) { return body[k / 3].free_acceleration[k % 3]; }, problem);
}

// Not modelled: shapes. Bodies may overlap each other and
// the world, and lie on either side of a contact.
template <class Scalar, int Rows>
int Bodies(bool gravity_only, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const int bodies = static_cast<int>(choices.Integer(1, std::min(kMaxBodies, rows / 2)));
  const int load = gravity_only ? 0 : static_cast<int>(choices.Integer(0, 2));
  std::array<Body<Scalar>, kMaxBodies> body;
  for (int i = 0; i < bodies; ++i) body[i] = DrawBody<Scalar>(load != 1, load != 0, choices);
  const BodyJacobian<Scalar, Rows> J = DrawContacts<Scalar, Rows>(rows, bodies, body, choices);
  SetFromBodies(J, bodies, body, problem);
  return 3 * bodies;
}

// The rows of one contact in the columns of one body, as SetContactRows.
template <class Scalar, class Columns>
void SetSceneRows(const Vector2<Scalar>& normal, const Vector2<Scalar>& arm, int contact, int index, int sign,
                  Columns& J) {
  const Vector2<Scalar> n = Scalar(sign) * normal, t = Quarter<Scalar>(n);
  for (int k = 0; k < 2; ++k) {
    J(2 * contact, 3 * index + k) = n[k];
    J(2 * contact + 1, 3 * index + k) = t[k];
  }
  J(2 * contact, 3 * index + 2) = Cross<Scalar>(arm, n);
  J(2 * contact + 1, 3 * index + 2) = Cross<Scalar>(arm, t);
}

// ---- one-body ---------------------------------------------------------------------------------

// The centre of mass is the origin; points in millimetres.
template <class Scalar, int Rows>
int OneBody(bool gravity_only, Choices& choices, ContactProblem<Scalar, Rows>& problem) {
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
    int p = static_cast<int>(choices.Integer(-64, 64));
    const int q = static_cast<int>(choices.Integer(-64, 64));
    if (p == 0 && q == 0) p = 1;
    const Scalar length = Scalar(p * p + q * q);
    const Vector2<Scalar> normal =
        MakeVector2<Scalar>(Scalar(Scalar(2 * p * q) / length), Scalar(Scalar(p * p - q * q) / length));
    SetSceneRows<Scalar>(normal, MakeVector2<Scalar>(x, y), contact, 0, 1, J);
  }
  SetFromBodies(J, 1, body, problem);
  return 3;
}

// ---- exponential ------------------------------------------------------------------------------

// y with L' y = (8^-n - 1, ..., 8^-1 - 1), in units of 8^-n: abs(y) <= 3 * 2^24. With the sums S_i = y_i +
// ... + y_n, row i reads y_i + 2 S_(i+1), so S_i = b_i - S_(i+1): between -1 and 0.
inline std::array<std::int64_t, kMaxContacts> ExponentialCoefficients(int contacts) {
  std::array<std::int64_t, kMaxContacts> y{};
  std::int64_t sum = 0;
  for (int i = contacts - 1; i >= 0; --i) {
    const std::int64_t b = (std::int64_t{1} << (3 * i)) - (std::int64_t{1} << (3 * contacts));
    y[i] = b - 2 * sum;
    sum = b - sum;
  }
  return y;
}

// Places of the contacts: as they come, or, with probability 1/2, in random order.
inline std::array<int, kMaxContacts> DrawPlaces(int contacts, Choices& choices) {
  std::array<int, kMaxContacts> places;
  for (int i = 0; i < contacts; ++i) places[i] = i;
  if (choices.Integer(0, 1) == 0) return places;
  for (int i = 0; i + 1 < contacts; ++i) std::swap(places[i], places[i + choices.Integer(0, contacts - 1 - i)]);
  return places;
}

// 0 with probability 1/2, otherwise 2^-k with k uniform.
inline double DrawSmall(int least, int most, Choices& choices) {
  if (choices.Integer(0, 1) == 0) return 0;
  return 1.0 / static_cast<double>(std::int64_t{1} << choices.Integer(least, most));
}

// Columns 0 to n - 1 belong to the normals, column n + i to the friction of contact i of the family.
//
// Bounds, without the factors 4^(n-i), which are powers of two of whole rows: J in units of 2^-20, abs(J) <=
// 2^21 + 1, so that abs(A) <= 9 (2^21 + 1)^2 < 2^46; y in units of 8^-n >= 2^-24, abs(J y) <= 8 (2^21 + 1) 3
// 2^24 + 2^44 < 2^50. The moves of J are less than 1/2 beside its inverse, so that the normals stay
// independent.
template <class Scalar, int Rows>
int Exponential(Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows(), contacts = rows / 2;
  const bool scaled = choices.Integer(0, 1) == 1;
  const std::array<int, kMaxContacts> place = DrawPlaces(contacts, choices);
  const double move = DrawSmall(8, 20, choices);
  const double coupling = DrawSmall(0, 8, choices);
  const int missing = choices.Integer(0, 1) == 0 ? 0 : static_cast<int>(choices.Integer(0, contacts));
  std::array<int, kMaxRows * kMaxContacts> moves{};
  if (move > 0 || coupling > 0)
    choices.ForEach<-1, 1>(rows * contacts, [&moves](int i, int value) { moves[i] = value; });
  auto J = MakeJacobian<Scalar, Rows>(rows, rows);
  for (int i = 0; i < contacts; ++i) {
    const int normal = 2 * place[i];
    const double scale = scaled ? static_cast<double>(std::int64_t{1} << (2 * (contacts - 1 - i))) : 1.0;
    for (int k = 0; k < contacts; ++k) {
      const double entry = k < i ? 0 : k == i ? 1 : 2;
      J(normal, k) = Scalar(scale * (entry + move * moves[rows * k + 2 * i]));
      J(normal + 1, k) = Scalar(scale * coupling * moves[rows * k + 2 * i + 1]);
      J(normal, contacts + k) = Scalar(0);
      J(normal + 1, contacts + k) = Scalar(k == i && i >= missing ? scale : 0.0);
    }
  }
  SetGram(J, rows, problem);
  const std::array<std::int64_t, kMaxContacts> of_normals = ExponentialCoefficients(contacts);
  const double unit = static_cast<double>(std::int64_t{1} << (3 * contacts));
  std::array<int, kMaxRows> of_friction;
  choices.ForEach<-4, 4>(contacts, [&of_friction](int i, int value) { of_friction[i] = value; });
  const auto y = [&](int k) {
    return Scalar(k < contacts ? static_cast<double>(of_normals[k]) / unit : 0.25 * of_friction[k - contacts]);
  };
  SetImage(J, rows, y, problem);
  return rows - missing;  // columns of friction that are zero
}

// ---- scenes -----------------------------------------------------------------------------------

template <class Scalar, int Rows>
int Scenes(const SceneGrain& grain, bool gravity_only, Choices& choices,
           ContactProblem<Scalar, Rows>& problem) {
  const int rows = problem.rows();
  const SceneDesign design = DrawSceneDesign(rows / 2, grain, gravity_only, choices);
  std::array<SceneBody<Scalar>, kMaxBodies> body;
  for (int c = 0; c < design.cells; ++c) body[c] = MakeSceneBody<Scalar>(design, c);
  BodyJacobian<Scalar, Rows> J = NoContacts<Scalar, Rows>(rows, design.cells);
  int contact = 0;
  for (int i = 0; i < design.interfaces; ++i) {
    const SceneInterface& interface = design.interface[i];
    const Vector2<Scalar> normal = NormalOf<Scalar>(design.lines[interface.line]);
    for (int k = 0; k < interface.contacts; ++k, ++contact) {
      if (k > 0) problem.contacts[contact].mu = problem.contacts[contact - 1].mu;
      const Vector2<Scalar> point = PointAt<Scalar>(design, interface, interface.at[k]);
      const auto set = [&](int c, int sign) {
        SetSceneRows<Scalar>(normal, point - body[c].center, contact, c, sign, J);
      };
      set(interface.upper, 1);
      if (interface.lower != kTheWorld) set(interface.lower, -1);
    }
  }
  SetFromBodies(J, design.cells, body, problem);
  return 3 * design.cells;
}

// ---- What a problem is counted by --------------------------------------------------------------

// The number in the palette of the coefficient that all contacts with friction have.
template <class Scalar, int Rows>
int CommonFriction(std::span<const MuChoice> palette, const std::array<MuChoice, kMaxContacts>& chosen,
                   const ContactProblem<Scalar, Rows>& problem) {
  int first = -1;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const Contact<Scalar>& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) continue;
    if (first < 0) first = i;
    if (contact.mu != problem.contacts[first].mu) return Drawn::kMixed;
  }
  if (first < 0) return Drawn::kMixed;
  return static_cast<int>(std::find(palette.begin(), palette.end(), chosen[first]) - palette.begin());
}

// All but friction; returns what rank(A) is at most, by construction.
template <class Scalar, int Rows>
int Fill(GeneratorId id, const std::array<MuChoice, kMaxContacts>& mu, const Surroundings& surroundings,
         Choices& choices, ContactProblem<Scalar, Rows>& problem) {
  switch (id) {
    case GeneratorId::kIntegers:
    case GeneratorId::kSpace:
      return Integers(choices, problem);
    case GeneratorId::kPsd:
      return Psd(choices, problem);
    case GeneratorId::kSmall:
      return Small(choices, problem);
    case GeneratorId::kNearDegenerate:
      return NearDegenerate(mu, choices, problem);
    case GeneratorId::kDuplicates:
      return Duplicates(choices, problem);
    case GeneratorId::kConditioned:
      return Conditioned(choices, problem);
    case GeneratorId::kBodies:
      return Bodies(surroundings.gravity_only, choices, problem);
    case GeneratorId::kExponential:
      return Exponential(choices, problem);
    case GeneratorId::kScenes:
      return Scenes(kCoarseScenes, surroundings.gravity_only, choices, problem);
    case GeneratorId::kOneBody:
      return OneBody(surroundings.gravity_only, choices, problem);
    case GeneratorId::kFineScenes:
      return Scenes(kFineScenes, surroundings.gravity_only, choices, problem);
    case GeneratorId::kBilateral:
    case GeneratorId::kSliding:
      return WithOtherKinds(Row(id).other_kind, choices, problem);
  }
  STICTION_CHECK(false, "all generators are above");
  return 0;
}

}  // namespace generators

template <class Scalar, int Rows>
Drawn Generate(GeneratorId id, int contacts, const Surroundings& surroundings, Choices& choices,
               ContactProblem<Scalar, Rows>& problem) {
  STICTION_CHECK(contacts >= 1 && contacts <= kMaxContacts, "generators make 1 to 8 contacts");
  STICTION_CHECK(Rows == Eigen::Dynamic || (Rows == 2 * contacts && !Row(id).InSpace()),
                 "two rows per contact");
  STICTION_CHECK(!surroundings.palette.empty(), "a palette has at least one friction coefficient");
  STICTION_CHECK(!surroundings.gravity_only || Row(id).has_gravity, "gravity is for bodies");
  generators::Resize(contacts, Row(id).dimension, problem);
  const auto mu = generators::DrawFriction(surroundings.palette, choices, problem);
  const int columns = generators::Fill(id, mu, surroundings, choices, problem);
  return {generators::CommonFriction(surroundings.palette, mu, problem), std::min(columns, problem.rows())};
}

}  // namespace stiction

#endif  // STICTION_SEARCH_GENERATORS_IPP_
