// SPDX-License-Identifier: Apache-2.0
// What a reduced system is made of: each unknown scales a force, and keeps an acceleration at rest.
//
//   M_ij = rest_i . A force_j     unknowns i, j; the driven force is one more column, the right side
//
// Forces and rests are combinations of rows of one contact: the normal force alone, or with friction at its
// limit, friction along an edge of a polygon. Systems (direction.h, updated_system.h) are templates over the
// type that has them: SetUnknowns below, which reads the sets of the paper, or ListedUnknowns. An unknown is
// named by a row; two of the same contact never by the same.

#pragma once

#include <array>
#include <type_traits>

#include "solver/problem/state.h"

namespace stiction {

// Of the rows from `row` on.
template <class Number>
struct RowCombination {
  int row = 0;
  int size = 0;       // 0: nothing
  bool unit = false;  // the row itself; factors are not read
  std::array<Number, 3> factors = {};

  static RowCombination Unit(int row) { return {row, 1, true, {}}; }

  void SetUnit(int first) {
    row = first;
    size = 1;
    unit = true;
  }
  template <class... Numbers>
  void Set(int first, const Numbers&... numbers) {
    row = first;
    size = sizeof...(numbers);
    unit = false;
    int r = 0;
    ((factors[r++] = numbers), ...);
  }

  bool operator==(const RowCombination& other) const {
    if (row != other.row || size != other.size || unit != other.unit) return false;
    for (int r = 0; r < size && !unit; ++r) {
      if (factors[r] != other.factors[r]) return false;
    }
    return true;
  }
};

// sum += x y, for scalars and for their integers.
template <class Scalar, class Number>
void AddProduct(Number& sum, const Number& x, const Number& y) {
  if constexpr (std::is_same_v<Number, Scalar>) {
    sum += x * y;
  } else {
    Fractions<Scalar>::AddProduct(sum, x, y);
  }
}

// The product of row i of A with a force.
template <class Scalar, class Matrix, class Number>
Number RowTimes(const Matrix& A, int i, const RowCombination<Number>& force) {
  if (force.unit) return A(i, force.row);
  Number sum(0);
  for (int s = 0; s < force.size; ++s) AddProduct<Scalar>(sum, A(i, force.row + s), force.factors[s]);
  return sum;
}

// rest . A force
template <class Scalar, class Matrix, class Number>
Number EntryOf(const RowCombination<Number>& rest, const Matrix& A, const RowCombination<Number>& force) {
  if (rest.unit) return RowTimes<Scalar>(A, rest.row, force);
  Number sum(0);
  for (int r = 0; r < rest.size; ++r)
    AddProduct<Scalar>(sum, rest.factors[r], RowTimes<Scalar>(A, rest.row + r, force));
  return sum;
}

template <class Scalar, class Vector>
Scalar Dot(const RowCombination<Scalar>& combination, const Vector& values) {
  if (combination.unit) return values[combination.row];
  Scalar sum(0);
  for (int r = 0; r < combination.size; ++r) sum += combination.factors[r] * values[combination.row + r];
  return sum;
}

// values += x times the combination
template <class Scalar, class Number, class Vector>
void AddTo(Vector& values, const RowCombination<Number>& combination, const Number& x) {
  if (combination.unit) {
    values[combination.row] += x;
    return;
  }
  for (int r = 0; r < combination.size; ++r)
    AddProduct<Scalar>(values[combination.row + r], combination.factors[r], x);
}

// The sets of the published algorithm: an unknown for every row in C and CF; a normal takes its friction along
// while that is in NC+ or NC- (5.3). `driven` changes by `sign`; -1: none.
template <class Scalar, int Rows>
struct SetUnknowns {
  const ContactProblem<Scalar, Rows>& problem;
  const RowLayout<Rows>& layout;
  const IndexSets<Rows>& sets;
  int driven = -1;
  int sign = 1;

  bool IsUnknown(int row) const { return stiction::IsUnknown(sets[row]); }
  // Whether the acceleration of the row itself is zero.
  bool Rests(int row) const { return IsUnknown(row); }
  RowCombination<Scalar> Rest(int row) const { return RowCombination<Scalar>::Unit(row); }

  RowCombination<Scalar> Force(int row) const {
    const int limit = FrictionLimitSign(layout, sets, row);
    if (limit == 0) return RowCombination<Scalar>::Unit(row);
    const Scalar& mu = problem.contacts[layout.ContactOf(row)].mu;
    return {row, 2, false, {Scalar(1), limit > 0 ? mu : Scalar(-mu)}};
  }

  RowCombination<Scalar> Driven() const {
    RowCombination<Scalar> force = Force(driven);
    if (sign > 0) return force;
    if (force.unit) return {driven, 1, false, {Scalar(-1)}};
    for (Scalar& factor : force.factors) factor = -factor;
    return force;
  }

  // The same without combinations: the column of an unknown or of the driven force, entry by row; and df of
  // their rows where they change by x.
  auto Column(int row) const {
    return [this, row, limit = FrictionLimitSign(layout, sets, row)](int of) {
      Scalar entry = problem.A(of, row);
      if (limit == 0) return entry;
      const Scalar along = problem.contacts[layout.ContactOf(row)].mu * problem.A(of, row + 1);
      if (limit > 0) {
        entry += along;
      } else {
        entry -= along;
      }
      return entry;
    };
  }
  auto DrivenColumn() const {
    return [this, column = Column(driven)](int of) {
      Scalar entry = column(of);
      return sign > 0 ? entry : Scalar(-entry);
    };
  }
  template <class Vector>
  void Place(int row, const Scalar& x, Vector& df) const {
    df[row] = x;
    const int limit = FrictionLimitSign(layout, sets, row);
    if (limit == 0) return;
    const Scalar bound = problem.contacts[layout.ContactOf(row)].mu * x;
    if (limit > 0) {
      df[row + 1] = bound;
    } else {
      df[row + 1] = -bound;
    }
  }
  template <class Vector>
  void PlaceDriven(const Scalar& x, Vector& df) const {
    Place(driven, sign > 0 ? x : Scalar(-x), df);
  }
};

// Unknowns of any kind, kept by row.
template <class Scalar, int Rows>
struct ListedUnknowns {
  const ContactProblem<Scalar, Rows>* problem = nullptr;
  RowArray<RowCombination<Scalar>, Rows> forces, rests;  // rests of size 0: no unknown
  RowCombination<Scalar> driven;

  void Start(const ContactProblem<Scalar, Rows>& of) {
    problem = &of;
    const int rows = of.rows();
    if constexpr (Rows == Eigen::Dynamic) {
      forces.resize(rows);
      rests.resize(rows);
    }
    for (auto& rest : rests) rest.size = 0;
    driven.size = 0;
  }

  bool IsUnknown(int row) const { return rests[row].size > 0; }
  bool Rests(int row) const { return rests[row].size > 0 && rests[row].unit; }
  const RowCombination<Scalar>& Rest(int row) const { return rests[row]; }
  const RowCombination<Scalar>& Force(int row) const { return forces[row]; }
  const RowCombination<Scalar>& Driven() const { return driven; }

  auto Column(int row) const { return ColumnOf(forces[row]); }
  auto DrivenColumn() const { return ColumnOf(driven); }
  template <class Vector>
  void Place(int row, const Scalar& x, Vector& df) const {
    AddTo<Scalar>(df, forces[row], x);
  }
  template <class Vector>
  void PlaceDriven(const Scalar& x, Vector& df) const {
    AddTo<Scalar>(df, driven, x);
  }

 private:
  auto ColumnOf(const RowCombination<Scalar>& force) const {
    return [this, &force](int of) {
      if (force.unit && rests[of].unit) return problem->A(of, force.row);
      return EntryOf<Scalar>(rests[of], problem->A, force);
    };
  }
};

}  // namespace stiction
