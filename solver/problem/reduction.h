// SPDX-License-Identifier: Apache-2.0
// Reduction: bilateral constraints and sliding contacts leave a problem before it is solved.
//
// What remains are frictionless and static contacts, which every method takes. In the plane and in space.
//
//   sliding    fF = -mu fN u (24), u the direction of the sliding velocity: "we can replace all occurrences"
//              of fF. The column of fN takes -mu u times the columns of fF along, and the rows of fF say
//              nothing. The matrix is then "unsymmetric and possibly indefinite as well" (section 6).
//   bilateral  aB = 0 and fB is free: "fi always stays in C" (4.5). With U the other rows,
//
//                fB = -inv(A_BB) (A_BU fU + b_B)
//                A' = A_UU - A_UB inv(A_BB) A_BU        b' = b_U - A_UB inv(A_BB) b_B
//
//              which drives, steps and sets of the remaining variables do not notice: A' df is what A df is
//              while B stays in C.
//
// Redundant    bilateral constraints (A_BB singular) rest at zero force: over exact scalars those whose columns
//              depend on the ones before. For A symmetric positive semidefinite they change nothing: A_BB y = 0
//              implies A y = 0. b outside of range(A) shows as y'b /= 0.
// Exchanged    (where it is allowed) is a frictionless contact whose row and column the rest of a singular A_BB
//              acts on: its acceleration takes the place of its force among the variables, and its force that
//              of its acceleration, as in a principal pivot transform; so does one for each that A_BB lacks. It
//              is a frictionless contact again, and A' is semidefinite where A is, in whatever units bilateral
//              rows are. Diode bridges and linear programs are such problems.
// Forces       f = E x + e, x the forces of the reduced problem, of exchanged contacts their accelerations.
// Cost         rows^2 times the bilateral ones.

#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "solver/problem/options.h"
#include "solver/problem/problem.h"
#include "solver/problem/scalar.h"

namespace stiction {

enum class ReductionEnd : std::uint8_t {
  kReduced,
  kInconsistent,  // no forces at all keep the bilateral constraints: there is no solution
  kSingular,      // A_BB is singular and not decoupled from the rest: A is not symmetric, or not semidefinite
};

// Why a problem could not be reduced; empty if it could.
inline constexpr std::string_view Reason(ReductionEnd end) {
  switch (end) {
    case ReductionEnd::kInconsistent:
      return "no forces keep the bilateral constraints";
    case ReductionEnd::kSingular:
      return "the bilateral constraints are singular";
    case ReductionEnd::kReduced:
      break;
  }
  return {};
}

template <class Scalar>
class Reduction {
 public:
  using Problem = ContactProblem<Scalar>;
  using Matrix = typename Problem::Matrix;
  using Vector = typename Problem::Vector;

  // Inexact scalars: pivots below tolerances.pivot of the largest entry are zero, accelerations below
  // tolerances.acceleration of the largest.
  explicit Reduction(const Problem& problem, const Tolerances& tolerances = {}, bool exchanges = false);

  // Whether a problem has anything to reduce.
  static bool Concerns(const Problem& problem);

  ReductionEnd end() const { return end_; }
  // Frictionless and static contacts in the order of the full problem; meaningful if kReduced.
  const Problem& problem() const { return reduced_; }
  // Whether forces and accelerations of some contacts have changed places.
  bool HasExchanges() const {
    return std::find(exchanged_.begin(), exchanged_.end(), true) != exchanged_.end();
  }
  // Row of the full problem for each row of the reduced one.
  const std::vector<int>& row_of() const { return row_of_; }
  // Contact of the full problem for each of the reduced one.
  const std::vector<int>& contact_of() const { return contact_of_; }
  // Values by row of the full problem from values by row of the reduced one; `other`: of the friction of
  // sliding contacts.
  template <class T>
  std::vector<T> Spread(const std::vector<T>& values, const T& bilateral, const T& other) const {
    std::vector<T> all(E_.rows(), other);
    for (const int row : bilateral_) all[row] = bilateral;
    for (std::size_t i = 0; i < values.size(); ++i) all[row_of_[i]] = values[i];
    return all;
  }
  // f = E x + e: full rows x reduced rows, and full rows.
  const Matrix& E() const { return E_; }
  const Vector& e() const { return e_; }
  // x: rows of the reduced problem, N. Returns all forces of the full problem, N.
  Vector Forces(const Vector& x) const { return E_ * x + e_; }
  // The same for a direction: of a ray the impulsive direction of section 6.
  Vector Direction(const Vector& dx) const { return E_ * dx; }

 private:
  void Sort(const Problem& problem);
  void ReplaceSlidingFriction(const Problem& problem);
  void EliminateBilateral(const Tolerances& tolerances, bool exchanges);
  std::vector<int> SolveBilateral(Matrix& T, const Scalar& zero) const;
  void Exchange(Matrix& A, Vector& b, std::vector<int>& determines, const Scalar& zero);
  ReductionEnd Classify(const Matrix& A, const Vector& b, const std::vector<int>& determines,
                        const Scalar& zero, const Scalar& zero_acceleration) const;

  ReductionEnd end_ = ReductionEnd::kReduced;
  Problem reduced_;
  std::vector<int> row_of_, contact_of_;
  std::vector<int> bilateral_;   // rows
  std::vector<bool> exchanged_;  // by row of the reduced problem
  Matrix M_;                     // rows x (reduced rows, bilateral rows): A with sliding friction replaced
  Vector b_;
  Matrix E_;
  Vector e_;
};

extern template class Reduction<float>;
extern template class Reduction<double>;

}  // namespace stiction
