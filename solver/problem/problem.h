// SPDX-License-Identifier: Apache-2.0
// ContactProblem: the system a = A f + b with the law of every contact ([Baraff94], (1), (18)).
//
//   A   contact matrix, rows x rows, 1/kg; symmetric positive semidefinite for the paper
//   b   free acceleration, rows x 1, m/s^2; in range(A) for the paper
//   f   contact forces, N; a contact accelerations, m/s^2; row order as below
//
// Rows follow the contacts. A bilateral or frictionless contact has one row; a static or sliding
// one has its normal row and then dimension - 1 tangential rows. Whether A is symmetric and
// positive semidefinite and b in its range are properties to test, not requirements.
//
// Rows is a compile-time row count for planar problems of static contacts only (two rows each),
// which keeps everything on the stack, or Eigen::Dynamic for any problem. MatrixType is how A is held: by
// default dense; SparseContactProblem has its nonzero entries; FactoredProblem (forms.h) its factors. Problem
// (forms.h) is one of these three, as it was read or made.

#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace stiction {

// One T per row: an array for a fixed number of rows, otherwise a vector.
template <class T, int Rows>
using RowArray = std::conditional_t<Rows == Eigen::Dynamic, std::vector<T>,
                                    std::array<T, Rows == Eigen::Dynamic ? 1 : Rows>>;

template <class T, int Rows>
void Reset(RowArray<T, Rows>& values, int rows, T value) {
  if constexpr (Rows == Eigen::Dynamic) {
    values.assign(rows, value);
  } else {
    (void)rows;
    values.fill(value);
  }
}

enum class ContactKind : std::uint8_t { kBilateral, kFrictionless, kStatic, kSliding };

template <class Scalar>
struct Contact {
  ContactKind kind = ContactKind::kStatic;
  Scalar mu = Scalar(0);  // friction coefficient, >= 0; 0 where the kind has none
  // Direction of the sliding velocity of a sliding contact: one component in the plane, two in space.
  std::array<Scalar, 2> slip = {Scalar(0), Scalar(0)};

  bool HasFrictionRows() const { return kind == ContactKind::kStatic || kind == ContactKind::kSliding; }
};

template <class Scalar, int Rows = Eigen::Dynamic, class MatrixType = Eigen::Matrix<Scalar, Rows, Rows>>
struct ContactProblem {
  static_assert(Rows == Eigen::Dynamic || Rows % 2 == 0, "fixed sizes hold static contacts only");
  using Matrix = MatrixType;
  using Vector = Eigen::Matrix<Scalar, Rows, 1>;
  using Contacts = std::conditional_t<Rows == Eigen::Dynamic, std::vector<Contact<Scalar>>,
                                      std::array<Contact<Scalar>, Rows == Eigen::Dynamic ? 1 : Rows / 2>>;

  int dimension = 2;
  Contacts contacts;
  Matrix A;
  Vector b;

  int rows() const { return static_cast<int>(b.size()); }
};

template <class Scalar>
using SparseContactProblem = ContactProblem<Scalar, Eigen::Dynamic, Eigen::SparseMatrix<Scalar>>;

// The same contacts in other numbers: convert(x) of every number x.
template <class To, class From, class Convert>
std::vector<Contact<To>> Converted(const std::vector<Contact<From>>& contacts, Convert convert) {
  std::vector<Contact<To>> result;
  for (const Contact<From>& contact : contacts)
    result.push_back({contact.kind, convert(contact.mu), {convert(contact.slip[0]), convert(contact.slip[1])}});
  return result;
}

// The same problem.
template <class To, class From, class Convert>
ContactProblem<To> Converted(const ContactProblem<From>& problem, Convert convert) {
  return {problem.dimension, Converted<To>(problem.contacts, convert), problem.A.unaryExpr(convert),
          problem.b.unaryExpr(convert)};
}
template <class To, class From, class Convert>
SparseContactProblem<To> Converted(const SparseContactProblem<From>& problem, Convert convert) {
  return {problem.dimension, Converted<To>(problem.contacts, convert), problem.A.unaryExpr(convert),
          problem.b.unaryExpr(convert)};
}

// Number of rows that the contacts ask for.
template <class Contacts>
int RowCount(const Contacts& contacts, int dimension) {
  int rows = 0;
  for (const auto& contact : contacts) rows += contact.HasFrictionRows() ? dimension : 1;
  return rows;
}

// Which variable stands in which row: a normal, or the friction of the normal in the row before. In space
// friction takes two rows.
template <int Rows>
class RowLayout {
 public:
  template <class Contacts>
  void Assign(const Contacts&) {}

  static bool IsNormal(int row) { return row % 2 == 0; }
  static bool HasFriction(int normal_row) {
    (void)normal_row;
    return true;
  }
  static int ContactOf(int row) { return row / 2; }
  static int NormalRowOf(int contact) { return 2 * contact; }
  static constexpr int ContactCount() { return Rows / 2; }
};

template <>
class RowLayout<Eigen::Dynamic> {
 public:
  // Keeps the memory of the problem before.
  template <class Contacts>
  void Assign(const Contacts& contacts, int dimension = 2) {
    contact_of_.clear();
    normal_row_.clear();
    for (const auto& contact : contacts) {
      normal_row_.push_back(static_cast<int>(contact_of_.size()));
      contact_of_.push_back(static_cast<int>(normal_row_.size()) - 1);
      for (int k = 1; k < dimension && contact.HasFrictionRows(); ++k)
        contact_of_.push_back(static_cast<int>(normal_row_.size()) - 1);
    }
  }

  bool IsNormal(int row) const { return normal_row_[contact_of_[row]] == row; }
  bool HasFriction(int normal_row) const {
    return normal_row + 1 < static_cast<int>(contact_of_.size()) &&
           contact_of_[normal_row + 1] == contact_of_[normal_row];
  }
  int ContactOf(int row) const { return contact_of_[row]; }
  int NormalRowOf(int contact) const { return normal_row_[contact]; }
  int ContactCount() const { return static_cast<int>(normal_row_.size()); }

 private:
  std::vector<int> contact_of_;  // by row
  std::vector<int> normal_row_;  // by contact
};

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

// visit(i, A_ij) for the entries of column j.
template <class Matrix, class Visit>
void ForEachInColumn(const Eigen::MatrixBase<Matrix>& A, int column, Visit visit) {
  for (int i = 0; i < A.rows(); ++i) visit(i, A(i, column));
}
template <class Scalar, class Visit>
void ForEachInColumn(const Eigen::SparseMatrix<Scalar>& A, int column, Visit visit) {
  for (typename Eigen::SparseMatrix<Scalar>::InnerIterator entry(A, column); entry; ++entry)
    visit(static_cast<int>(entry.row()), entry.value());
}
}  // namespace stiction
