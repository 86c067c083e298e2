// SPDX-License-Identifier: Apache-2.0
// Problem: a = A f + b with the law of every contact, A in the form that it came in.
//
//   dense      ContactProblem: all of A
//   entries    SparseContactProblem: what is not zero
//   factors    FactoredProblem: A = J W J', b = J w + c
//
// Whoever needs another form asks for it: dense() and entries() are made when they are first asked for, once,
// by any thread, and kept. Copies share them. Scalar is an exact type: what is formed is the same problem.
//
// FactoredProblem: a = A f + b with A = J W J' and b = J w + c, where A is not formed.
//
//   J   rows x velocities, 1 or m: what the contacts make of the bodies' velocities; sparse
//   M   velocities x velocities, kg or kg m^2: the masses; symmetric, positive definite, in blocks of a body
//   each W   the inverse of M w   velocities x 1, m/s^2 or 1/s^2: accelerations of the bodies without contact
//   forces c   rows x 1, m/s^2: accelerations of the contacts where the bodies have none
//
// A is symmetric and positive semidefinite, whatever J is; with c = 0 or in the range of J, b is in range(A).

#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

// ---- Factors ---------------------------------------------------------------------------------------

// J W J', entry by entry where they are asked for.
template <class Scalar>
class FactoredMatrix {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Rows = Eigen::SparseMatrix<Scalar, Eigen::RowMajor>;

  FactoredMatrix() = default;
  FactoredMatrix(Rows J, Matrix W) : J_(std::move(J)), W_(std::move(W)), JW_(J_ * W_), columns_(J_) {}
  // Where blocks of W are too long to be formed over exact numbers, and J W is not: W is zero there.
  FactoredMatrix(Rows J, Matrix W, const Rows& JW_of_others)
      : J_(std::move(J)), W_(std::move(W)), JW_(Rows(J_ * W_) + JW_of_others), columns_(J_) {}

  const Rows& J() const { return J_; }
  const Matrix& W() const { return W_; }
  const Rows& JW() const { return JW_; }

  Scalar coeff(int i, int j) const { return JW_.row(i).dot(J_.row(j)); }

  // visit(i, j, A_ij) for the entries that a shared velocity makes, row by row. The matrices are compressed.
  template <class Visit>
  void ForEach(Visit visit) const {
    ForEachOf<false>(visit);
  }
  // Of these those with j <= i: A is symmetric.
  template <class Visit>
  void ForEachOfHalf(Visit visit) const {
    ForEachOf<true>(visit);
  }

  // visit(i, A_ij) for the rows that share a velocity with row j.
  template <class Visit>
  void ForEachInColumn(int j, Visit visit) const {
    const Eigen::SparseVector<Scalar> column = J_ * Eigen::SparseVector<Scalar>(JW_.row(j).transpose());
    for (typename Eigen::SparseVector<Scalar>::InnerIterator entry(column); entry; ++entry)
      visit(static_cast<int>(entry.index()), entry.value());
  }

 private:
  template <bool kIsHalf, class Visit>
  void ForEachOf(Visit visit) const {
    const int *begin = JW_.outerIndexPtr(), *of = JW_.innerIndexPtr();
    const int *column = columns_.outerIndexPtr(), *other = columns_.innerIndexPtr();
    const Scalar *x = JW_.valuePtr(), *y = columns_.valuePtr();
    const int rows = static_cast<int>(J_.rows());
    std::vector<Scalar> row(rows, Scalar(0));
    std::vector<int> touched(rows), last(rows, -1);
    for (int i = 0; i < rows; ++i) {
      int count = 0;
      for (int p = begin[i]; p < begin[i + 1]; ++p) {
        for (int q = column[of[p]]; q < column[of[p] + 1]; ++q) {
          const int j = other[q];
          if (kIsHalf && j > i) break;
          if (last[j] == i) {
            row[j] += x[p] * y[q];
            continue;
          }
          last[j] = i;
          row[j] = x[p] * y[q];
          touched[count++] = j;
        }
      }
      for (int k = 0; k < count; ++k) visit(i, touched[k], row[touched[k]]);
    }
  }

  Rows J_;
  Matrix W_;
  Rows JW_;
  Matrix columns_;  // J
};

template <class Scalar, class Visit>
void ForEachEntry(const FactoredMatrix<Scalar>& A, Visit visit) {
  A.ForEach(visit);
}

template <class Scalar, class Visit>
void ForEachInColumn(const FactoredMatrix<Scalar>& A, int column, Visit visit) {
  A.ForEachInColumn(column, visit);
}

template <class Scalar>
struct FactoredProblem : ContactProblem<Scalar, Eigen::Dynamic, FactoredMatrix<Scalar>> {
  using Matrix = FactoredMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  typename Matrix::Matrix M;
  Vector w, c;  // b = J w + c

  // W J' f, what the forces change of the bodies' accelerations.
  Vector Responses(const Vector& f) const {
    if constexpr (kIsExact<Scalar>) return this->A.JW().transpose() * f;  // W may not be whole
    return this->A.W() * (this->A.J().transpose() * f);
  }
  // a = A f + b, of the contacts.
  Vector Accelerations(const Vector& f) const { return this->A.J() * Responses(f) + this->b; }
};

// ---- Any form ----------------------------------------------------------------------------------------

// The same problem with all of A: rows x rows numbers, which memory may not hold.
template <class Scalar, class Matrix>
ContactProblem<Scalar> DenseOf(const ContactProblem<Scalar, Eigen::Dynamic, Matrix>& problem) {
  ContactProblem<Scalar> dense{problem.dimension, problem.contacts, {}, problem.b};
  dense.A = ContactProblem<Scalar>::Matrix::Constant(problem.rows(), problem.rows(), Scalar(0));
  ForEachEntry(problem.A, [&dense](int i, int j, const Scalar& x) { dense.A(i, j) = x; });
  return dense;
}

// The same with the entries of A that are not zero.
template <class Scalar, class Matrix>
SparseContactProblem<Scalar> EntriesOf(const ContactProblem<Scalar, Eigen::Dynamic, Matrix>& problem) {
  std::vector<Eigen::Triplet<Scalar>> entries;
  ForEachEntry(problem.A, [&entries](int i, int j, const Scalar& x) {
    if (x != 0) entries.emplace_back(i, j, x);
  });
  SparseContactProblem<Scalar> sparse{problem.dimension, problem.contacts, {}, problem.b};
  sparse.A.resize(problem.rows(), problem.rows());
  sparse.A.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

template <class Scalar>
class Problem {
 public:
  using Dense = ContactProblem<Scalar>;
  using Entries = SparseContactProblem<Scalar>;
  using Factored = FactoredProblem<Scalar>;
  using Vector = typename Dense::Vector;

  Problem() : Problem(Dense()) {}
  Problem(Dense dense) : forms_(std::make_shared<Forms>(std::move(dense))) {}        // NOLINT: any form is one
  Problem(Entries entries) : forms_(std::make_shared<Forms>(std::move(entries))) {}  // NOLINT
  Problem(Factored factored) : forms_(std::make_shared<Forms>(std::move(factored))) {}  // NOLINT

  int dimension() const {
    return InItsForm([](const auto& given) { return given.dimension; });
  }
  const std::vector<Contact<Scalar>>& contacts() const {
    return InItsForm([](const auto& given) -> const auto& { return given.contacts; });
  }
  const Vector& b() const {
    return InItsForm([](const auto& given) -> const auto& { return given.b; });
  }
  int rows() const { return static_cast<int>(b().size()); }

  bool IsDense() const { return std::holds_alternative<Dense>(forms_->given); }
  // Null where it did not come in factors.
  const Factored* factors() const { return std::get_if<Factored>(&forms_->given); }

  // visit(problem), as ContactProblem, SparseContactProblem or FactoredProblem.
  template <class Visit>
  decltype(auto) InItsForm(Visit visit) const {
    return std::visit(visit, forms_->given);
  }

  const Dense& dense() const {
    if (const auto* dense = std::get_if<Dense>(&forms_->given)) return *dense;
    std::call_once(forms_->dense_once,
                   [this] { forms_->dense = InItsForm([](const auto& given) { return DenseOf(given); }); });
    return *forms_->dense;
  }
  operator const Dense&() const { return dense(); }  // NOLINT: whatever takes a dense problem takes this one

  const Entries& entries() const {
    if (const auto* entries = std::get_if<Entries>(&forms_->given)) return *entries;
    std::call_once(forms_->entries_once,
                   [this] { forms_->entries = InItsForm([](const auto& given) { return EntriesOf(given); }); });
    return *forms_->entries;
  }

 private:
  struct Forms {
    explicit Forms(std::variant<Dense, Entries, Factored> as_given) : given(std::move(as_given)) {}

    const std::variant<Dense, Entries, Factored> given;
    std::once_flag dense_once, entries_once;
    std::optional<Dense> dense;
    std::optional<Entries> entries;
  };

  std::shared_ptr<Forms> forms_;
};

}  // namespace stiction
