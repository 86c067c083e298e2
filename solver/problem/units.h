// SPDX-License-Identifier: Apache-2.0
// Units: what an acceleration and a force of each row are measured in.
//
// With W the work that forces do in the group of contacts that A couples to row i,
//
//   acceleration   s_i = abs(b_i) + min(sum_j abs(A_ij) max(abs(f_j), abs(b_j) / A_jj), sqrt(A_ii W))
//   force          s_i / A_ii, and 0 where A_ii = 0
//   W = min(f'Af, -b'f + power of sliding friction)
//
// What acts at a row is b and A f. The sum bounds abs(A f)_i, and so does the root (Cauchy and Schwarz, A
// semidefinite). In the sum a force counts at least as what b asks for at its row: else a row where nothing
// acts but the rounding of forces that are zero would be held to that. Forces that only press against each
// other, a jam, can be as large as they like; they do no work, so the root keeps them from making a unit large.
// Of a solution f'a is the power of sliding friction, or at most 0 where nothing slides, so f'Af = f'a - b'f is
// W; of other forces the smaller of the two does not count the work of their errors. (The absolute values of
// both are taken: an A that is not semidefinite has units, too.)
//
// With a positive factor per contact, A -> D A D, b -> D b, f -> D^-1 f, W stays, and units change as
// accelerations and forces do. mu is not in them. Groups that are far apart do not see each other.
//
// W is a lower bound: its own rounding is taken off. Shapes: rows. Units: m/s^2, N. Memory is kept between
// calls.

#ifndef STICTION_SOLVER_PROBLEM_UNITS_H_
#define STICTION_SOLVER_PROBLEM_UNITS_H_

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

// visit(i, j, A_ij) for all entries, or for those that a sparse A has.
template <class Matrix, class Visit>
void ForEachEntry(const Eigen::MatrixBase<Matrix>& A, Visit visit) {
  for (int j = 0; j < A.cols(); ++j)
    for (int i = 0; i < A.rows(); ++i) visit(i, j, A(i, j));
}
template <class Scalar, class Visit>
void ForEachEntry(const Eigen::SparseMatrix<Scalar>& A, Visit visit) {
  for (int j = 0; j < A.outerSize(); ++j)
    for (typename Eigen::SparseMatrix<Scalar>::InnerIterator entry(A, j); entry; ++entry)
      visit(static_cast<int>(entry.row()), j, entry.value());
}

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

template <class Scalar>
class Units {
 public:
  // Of forces f with accelerations a = A f + b. Scalar: that of f and a; it may be wider than the problem's.
  template <class Problem, class Vector>
  void Take(const Problem& problem, const Vector& f, const Vector& a) {
    groups_.Begin(problem);
    const int rows = problem.rows();
    own_.resize(rows);
    force_.resize(rows);  // for now what counts of each force
    for (int i = 0; i < rows; ++i) {
      own_[i] = Abs(Scalar(problem.A.coeff(i, i)));
      const Scalar asked = own_[i] > 0 ? Scalar(Abs(Scalar(problem.b[i])) / own_[i]) : Scalar(0);
      force_[i] = std::max(Scalar(Abs(f[i])), asked);
    }
    sum_.assign(rows, Scalar(0));
    size_.assign(rows, Scalar(0));
    ForEachEntry(problem.A, [&](int i, int j, const auto& x) {
      groups_.Join(i, j, x);
      if (!(force_[j] > 0)) return;
      const Scalar entry = Abs(Scalar(x));
      sum_[i] += entry * force_[j];
      if (f[j] != 0) size_[i] += entry * Abs(f[j]);
    });
    groups_.End();
    acceleration_.resize(rows);
    TakeWork(problem, f, a);
    for (int i = 0; i < rows; ++i) {
      const Scalar free = Abs(Scalar(problem.b[i]));
      const Scalar bound = Root(Scalar(own_[i] * work_[groups_.OfRow(i)].least));
      acceleration_[i] = free + std::min(sum_[i], bound);
      force_[i] = own_[i] > 0 ? Scalar(acceleration_[i] / own_[i]) : Scalar(0);
      size_[i] += free;
    }
  }

  const Scalar& acceleration(int row) const { return acceleration_[row]; }
  const Scalar& force(int row) const { return force_[row]; }
  // abs(b_i) + sum_j abs(A_ij f_j): what rounding is relative to.
  const Scalar& size(int row) const { return size_[row]; }
  const Groups& groups() const { return groups_; }

  // Relative rounding of an acceleration that is computed in Scalar, in units of size(row); N. J. Higham,
  // Accuracy and Stability of Numerical Algorithms, 2002, section 3.1.
  static Scalar Rounding(int rows) {
    if constexpr (kIsExact<Scalar>) {
      return Scalar(0);
    } else {
      return Scalar(rows + 2) * std::numeric_limits<Scalar>::epsilon() / 2;
    }
  }

 private:
  struct Work {
    Scalar done = Scalar(0), free = Scalar(0), sliding = Scalar(0);  // f'Af, b'f, power of sliding friction
    Scalar error = Scalar(0);                                        // of the sums
    Scalar least = Scalar(0);                                        // W
  };

  template <class Problem, class Vector>
  void TakeWork(const Problem& problem, const Vector& f, const Vector& a) {
    const Scalar unit = 4 * Rounding(problem.rows());
    work_.assign(problem.contacts.size(), Work{});
    for (int i = 0; i < problem.rows(); ++i) {
      if (f[i] == 0) continue;
      const Scalar b = Scalar(problem.b[i]), power = f[i] * a[i];
      const int contact = groups_.ContactOf(i);
      const bool friction = i > 0 && groups_.ContactOf(i - 1) == contact;
      Work& work = work_[groups_.Of(contact)];
      work.done += f[i] * (a[i] - b);
      work.free += f[i] * b;
      if (friction && problem.contacts[contact].kind == ContactKind::kSliding) work.sliding += power;
      work.error += unit * Abs(f[i]) * (size_[i] + Abs(b));
    }
    for (Work& work : work_) {
      const Scalar given = Abs(work.free) + std::max(Scalar(0), work.sliding);
      work.least = std::max(Scalar(0), Scalar(std::min(Abs(work.done), given) - work.error));
    }
  }

  static Scalar Root(const Scalar& x) { return SquareRoot<Scalar>::Of(x); }

  Groups groups_;
  std::vector<Work> work_;  // by the first contact of a group
  std::vector<Scalar> acceleration_, force_, sum_, size_, own_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_UNITS_H_
