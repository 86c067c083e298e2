// SPDX-License-Identifier: Apache-2.0
// Lemke's method, lexicographic, on the static problem as a linear complementarity problem.
//
// The conditions (15), (16) of [Baraff94] are the LCP  w = M z + q >= 0, z >= 0, z'w = 0  with
//
//   z = (fN, f+, f-, l),   w = (aN, aF + l, l - aF, mu fN - f+ - f-),   fF = f+ - f-,
//
//       [ A_NN  A_NF  -A_NF  0 ]       [  b_N ]
//   M = [ A_FN  A_FF  -A_FF  I ]   q = [  b_F ]
//       [-A_FN -A_FF   A_FF  I ]       [ -b_F ]
//       [ mu     -I     -I   0 ]       [   0  ]
//
// where N are the normal rows of all contacts, F the friction rows of the static ones: a frictionless contact
// contributes its normal row only. Starting from w = q + e z0 with e = (1, ..., 1), or another e > 0 (`Cover`),
// the path keeps z'w = 0 until z0 is zero again: a solution; or until nothing limits it: a ray.
//
// Copositive   z'Mz = f'Af + sum of mu_i l_i fN_i >= 0 for z >= 0 and A positive semidefinite: the terms of l
//              with f+ and f- cancel. It is used at a ray, a direction (v, v0) at a point (z, z0) of the
//              path with z0 > 0 and z'(Mv + e v0) = 0, v'w = 0, v'(Mv + e v0) = 0:
//              - v'Mv and v0 e'v are both >= 0 with sum 0, so v0 = 0, v'Mv = 0, Mv >= 0; v /= 0, since the
//                ray is not the first one;
//              - (z + t v)'M(z + t v) >= 0 for all t >= 0 with v'Mv = 0 = z'Mv gives v'Mz >= 0;
//              - so 0 = v'w gives q'v = -v'Mz - z0 e'v < 0.
//              For symmetric A: f = (vN, v+ - v-) has f in K, A f = 0 and b'f = q'v < 0, which b in range(A)
//              excludes. So every problem that satisfies the paper's assumptions is solved,
//              and a ray proves that (H) fails. It does not prove that there is no solution.
// Finite       the lexicographic rule: rows of (inv(B) q, inv(B)) are lexicographically positive and no basis
//              recurs. The path ends as soon as z0 can leave at the smallest ratio, even in a tie.
// Source       R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, 1992, 3.8 and 4.4
//              (numbers to be checked).
// Shapes       m = contacts + 3 static contacts; a dense tableau m x (m + 1). Units: f in N, a in m/s^2.
// Exactness    only + - * / and signs. Over inexact scalars signs are relative to the column (option
//              `pivot`), equal quotients to the option `force`. An answer whose natural residual exceeds the
//              option `loop_grain` is `undecided`; so is a ray unless its forces show A ray = 0, b'ray < 0.
// Cost         O(m^2) per pivot.

#ifndef STICTION_SOLVER_LEMKE_LEMKE_H_
#define STICTION_SOLVER_LEMKE_LEMKE_H_

#include <vector>

#include "solver/published/published.h"

namespace stiction {

// The covering vector d of q + d z0: 1 in every row; or 1 m/s^2 in the rows of accelerations
// and 1/max A_ii N in those of force limits. The second path does not depend on the units of the data, and is
// the one to take over inexact scalars: where A is far from 1 the first mixes magnitudes.
enum class Cover : std::uint8_t { kOnes, kUnits };

struct LemkeOptions {
  Cover cover = Cover::kOnes;
  Tolerances tolerances;
  Limits limits;  // pivots and bits

  bool operator==(const LemkeOptions&) const = default;
};

// Reusable: memory is kept between runs.
template <class Scalar, int Rows = Eigen::Dynamic>
class LemkeAlgorithm {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using Vector = typename Problem::Vector;

  explicit LemkeAlgorithm(const LemkeOptions& options = {}) : options_(options) {}

  LemkeOptions& options() { return options_; }

  // Requires PublishedHandles(problem): planar, frictionless and static contacts. Outcome: solved, ray, limit
  // (reason "pivots" or "bits") or undecided. Counts `pivots` only; the first, which brings z0 in, counts.
  Verdict Run(const Problem& problem);

  // Of a solved run: forces, and accelerations a = A f + b.
  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }
  // Of a ray: the direction of the forces, in K; A ray = 0, b'ray < 0 if A is symmetric and semidefinite.
  const Vector& ray() const { return ray_; }

 private:
  static constexpr int kSize = Rows == Eigen::Dynamic ? Eigen::Dynamic : 2 * Rows;
  static constexpr int kColumns = Rows == Eigen::Dynamic ? Eigen::Dynamic : 2 * Rows + 1;

  // A component of z, and of w with the same index.
  enum class Block { kNormal, kPlus, kMinus, kMultiplier };
  struct Component {
    Block block;
    int row;  // of A: the friction row but for kNormal
    int contact;
  };

  void Start(const Problem& problem);
  void SetUnits(const Problem& problem);
  void ListComponents(const Problem& problem);
  Scalar RightSide(const Problem& problem, const Component& w) const;
  Scalar MatrixEntry(const Problem& problem, const Component& w, const Component& z) const;
  Scalar LimitCover(const Problem& problem) const;
  bool IsNonnegative() const;

  // Variables of the path: w_0 ... w_{m-1}, z_0 ... z_{m-1}, z0.
  int Artificial() const { return 2 * size_; }
  Outcome Follow(const Problem& problem);
  int FirstLeaving() const;
  void ComputeColumn(int entering);
  int Leaving() const;
  int CompareQuotients(int i, int k, int c) const;
  bool IsBefore(int i, int k) const;
  void Pivot(int row, int entering);
  bool BudgetSpent();

  void AddForce(int variable, const Scalar& value, Vector& f) const;
  void Extract(const Problem& problem);
  Outcome JudgeSolution(const Problem& problem);
  Outcome JudgeRay(const Problem& problem, int entering);

  LemkeOptions options_;
  int size_ = 0;  // m
  std::vector<Component> components_;
  Eigen::Matrix<Scalar, kSize, kColumns, Eigen::RowMajor> T_;  // inv(B) (q, I)
  Eigen::Matrix<Scalar, kSize, kSize> M_;
  Eigen::Matrix<Scalar, kSize, 1> column_;  // inv(B) times the entering column
  Eigen::Matrix<Scalar, kSize, 1> cover_;   // d
  std::vector<int> basis_;                  // variable of each row
  Scalar unit_A_ = Scalar(1), unit_b_ = Scalar(1);
  Scalar pivot_tolerance_ = Scalar(0), tie_tolerance_ = Scalar(0), residual_tolerance_ = Scalar(0);
  Vector f_, a_, ray_;
  Verdict verdict_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_LEMKE_LEMKE_H_
