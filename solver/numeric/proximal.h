// SPDX-License-Identifier: Apache-2.0
// Thousands of planar contacts with a sparse A: proximal points, each by Newton's method.
//
//   proximal   from f, the problem with (A + eps D, b - eps D f) is solved instead; D holds the diagonal of A.
//              Where A is positive semidefinite its matrix is positive definite. Its solution is the next f.
//              eps is halved as long as that works, and grows where it does not. At a fixed point f the
//              problem itself is solved, whatever eps is.
//   Newton     every contact's cell is read from f - inv(D) a, as in a natural residual; the cells give a
//              linear system in the forces that they leave free, whose solution gives the next cells: a
//              semismooth Newton method, or block pivoting.
//
// For contacts of any kind. What is found is called solved only if its errors (problem/errors.h), computed
// from f alone, are at most `residual`; otherwise the outcome is `undecided`. Where there is no solution,
// forces grow without end. Shapes      f, a: rows x 1. Units: f in N, a in m/s^2. Requires    nothing of A and
// b. Without friction and with A semidefinite, proximal points converge (R. T.
//             Rockafellar, SIAM Journal on Control and Optimization 14, 1976); with friction there is no such
//             theorem.
// Cost        one sparse LU factorization of the free rows per step of Newton's method.

#pragma once

#include <vector>

#include "solver/complete/complete.h"
#include "solver/problem/errors.h"
#include "solver/problem/problem.h"

namespace stiction {

// Of a request residual and limits.stop are read. Requires a floating-point Scalar.
template <class Scalar>
class ProximalNewton {
 public:
  using Problem = SparseContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  // aim: residual at which it ends; between the two it ends when points gain nothing. 0: the residual.
  explicit ProximalNewton(const Request& request = {}, double aim = 0)
      : request_(request), aim_(aim > 0 ? aim : ResidualOf<Scalar>(request)) {}

  // Requires dimension 2. Starts from f = 0.
  RunEnd<> Run(const Problem& problem);

  // The best forces that the last run found, and a = A f + b.
  const Vector& f() const { return best_f_; }
  const Vector& a() const { return best_a_; }

 private:
  static inline const Scalar kSettled = Scalar(1e-12);  // error of a proximal problem

  void Start(const Problem& problem);
  Scalar Measured() const;
  void Regularize(Scalar eps);
  bool Settle();
  void TakeCells();
  void ListUnknowns();
  bool SolveCells();

  Request request_;
  double aim_;
  const Problem* problem_ = nullptr;
  RunEnd<> verdict_;
  Vector f_, a_;
  Vector best_f_, best_a_;
  Vector D_;
  std::vector<int> row_of_;  // normal row by contact

  Problem proximal_;
  Vector trial_, trial_a_;
  std::vector<Cell> cells_;
  std::vector<int> unknowns_;    // rows whose force is free
  std::vector<int> unknown_of_;  // by row, or -1
  Vector follows_;               // by normal row: fF / fN where friction follows the normal, or 0
};

extern template class ProximalNewton<float>;
extern template class ProximalNewton<double>;

}  // namespace stiction
