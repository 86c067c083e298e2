// SPDX-License-Identifier: Apache-2.0
// Lenient units: what an acceleration and a force of each row are measured in, to accuse another program.
//
// The strict measure (errors.h) refuses what is not nearly exact. Whoever accuses must be sure, so these units
// are as large as a reader may wish them. With
//
//   F_j   what force j counts: 0 at a contact without any force, else the largest of abs(f_j), abs(b_j) / A_jj
//         and, for friction, F of the normal
//   S_i   sum_j abs(A_ij) F_j
//
//   acceleration   s_N = abs(b_N) + S_N,   s_T = abs(b_T) + abs(S_T), one for the tangents of a contact
//   force          phi = s / A_jj of its own row, A_TT the largest of the tangents'; where that is 0, the least
//                  s_i / abs(A_ij) of its column, the force that no row notices; 0 if the column is empty
//   friction       phi_T + mu (max(0, f_N) + S_N / A_NN)
//
// So a force that is off by 1e-12 of the largest at its contact misses at most some 1e-12 of its unit. With a
// positive factor per contact, A -> D A D, b -> D b, f -> D^-1 f, units change as accelerations and forces do.
// mu is never divided by. Shapes: rows. Units: m/s^2, N. Memory is kept between calls.

#pragma once

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <vector>

#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

// Groups of contacts that A couples, directly or through others.
class Groups {
 public:
  template <class Problem>
  void Find(const Problem& problem) {
    Begin(problem);
    ForEachEntry(problem.A, [this](int i, int j, const auto& x) { this->Join(i, j, x); });
    End();
  }

  // Find in parts: Join for each entry, between the two.
  template <class Problem>
  void Begin(const Problem& problem) {
    const int count = static_cast<int>(problem.contacts.size());
    contact_of_.clear();
    for (int i = 0; i < count; ++i)
      contact_of_.resize(contact_of_.size() + (problem.contacts[i].HasFrictionRows() ? problem.dimension : 1),
                         i);
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0);
    groups_ = count;
  }
  template <class Scalar>
  void Join(int i, int j, const Scalar& x) {
    if (groups_ == 1 || contact_of_[i] == contact_of_[j] || x == 0) return;
    const int one = Root(contact_of_[i]), other = Root(contact_of_[j]);
    groups_ -= one != other;
    parent_[std::max(one, other)] = std::min(one, other);
  }
  void End() {
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = Root(static_cast<int>(i));
  }

  int ContactOf(int row) const { return contact_of_[row]; }
  // The first contact of its group.
  int Of(int contact) const { return parent_[contact]; }
  int OfRow(int row) const { return parent_[contact_of_[row]]; }

 private:
  int Root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<int> contact_of_;  // by row
  std::vector<int> parent_;      // by contact
  int groups_ = 0;
};

// Rows of a contact.
template <class Scalar>
int RowsOf(const Contact<Scalar>& contact, int dimension) {
  return contact.HasFrictionRows() ? dimension : 1;
}
// visit(contact, its normal row, its number of rows)
template <class Problem, class Visit>
void ForEachContact(const Problem& problem, Visit visit) {
  int row = 0;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const int count = RowsOf(problem.contacts[i], problem.dimension);
    visit(i, row, count);
    row += count;
  }
}
// The normal row of each contact.
template <class Problem>
std::vector<int> NormalRowsOf(const Problem& problem) {
  std::vector<int> rows;
  ForEachContact(problem, [&rows](int, int row, int) { rows.push_back(row); });
  return rows;
}

// The length of the tangential rows of a contact: from `row` + 1 on, one or two, or none.
template <class Values>
auto TangentLength(const Values& x, int row, int rows) {
  using Scalar = std::decay_t<decltype(x[0])>;
  if (rows == 1) return Scalar(0);
  return rows == 2 ? Scalar(Abs(Scalar(x[row + 1]))) : Scalar(Length(Scalar(x[row + 1]), Scalar(x[row + 2])));
}

template <class Scalar>
class LenientUnits {
 public:
  template <class Problem, class Vector>
  void Take(const Problem& problem, const Vector& f) {
    const int rows = problem.rows();
    Count(problem, f);
    size_.assign(rows, Scalar(0));
    ForEachEntry(problem.A, [&](int i, int j, const auto& x) {
      if (counted_[j] > 0) size_[i] += Scalar(Abs(Scalar(x))) * counted_[j];
    });
    acceleration_.resize(rows);
    force_.resize(rows);
    friction_.resize(problem.contacts.size());
    ForEachContact(problem, [&](int, int row, int count) {
      acceleration_[row] = Abs(Scalar(problem.b[row])) + size_[row];
      const Scalar tangents = TangentLength(problem.b, row, count) + TangentLength(size_, row, count);
      for (int k = 1; k < count; ++k) acceleration_[row + k] = tangents;
    });
    ForEachContact(problem, [&](int i, int row, int count) {
      force_[row] = ForceUnit(problem, row, 1);
      friction_[i] = Scalar(0);
      if (count == 1) return;
      const Scalar tangents = ForceUnit(problem, row + 1, count - 1);
      for (int k = 1; k < count; ++k) force_[row + k] = tangents;
      const Scalar mu(problem.contacts[i].mu),
          noise = own_[row] > 0 ? Scalar(size_[row] / own_[row]) : Scalar(0);
      const Scalar normal = std::max(Scalar(0), Scalar(f[row])) + noise;
      friction_[i] = tangents + (normal > 0 ? Scalar(mu * normal) : Scalar(0));
    });
  }

  const Scalar& acceleration(int row) const { return acceleration_[row]; }
  const Scalar& force(int row) const { return force_[row]; }
  const Scalar& friction(int contact) const { return friction_[contact]; }

 private:
  // F and the diagonal of A.
  template <class Problem, class Vector>
  void Count(const Problem& problem, const Vector& f) {
    counted_.assign(problem.rows(), Scalar(0));
    own_.resize(problem.rows());
    for (int i = 0; i < problem.rows(); ++i) own_[i] = Abs(Scalar(problem.A.coeff(i, i)));
    ForEachContact(problem, [&](int, int row, int count) {
      bool carries = false;
      for (int k = row; k < row + count; ++k) carries |= f[k] != 0;
      for (int k = row; k < row + count && carries; ++k) {
        counted_[k] = Abs(Scalar(f[k]));
        if (own_[k] > 0) counted_[k] = std::max(counted_[k], Scalar(Abs(Scalar(problem.b[k])) / own_[k]));
        counted_[k] = std::max(counted_[k], counted_[row]);
      }
    });
  }

  // Of `count` rows with one unit of acceleration.
  template <class Problem>
  Scalar ForceUnit(const Problem& problem, int row, int count) const {
    Scalar own(0), least(-1);
    for (int k = row; k < row + count; ++k) own = std::max(own, own_[k]);
    if (own > 0) return acceleration_[row] / own;
    for (int k = row; k < row + count; ++k) {
      ForEachInColumn(problem.A, k, [&](int i, const auto& x) {
        if (x == 0) return;
        const Scalar unnoticed = acceleration_[i] / Scalar(Abs(Scalar(x)));
        if (least < 0 || unnoticed < least) least = unnoticed;
      });
    }
    return std::max(Scalar(0), least);
  }

  std::vector<Scalar> counted_, own_, size_, acceleration_, force_;  // by row
  std::vector<Scalar> friction_;                                     // by contact
};

}  // namespace stiction
