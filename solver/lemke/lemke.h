// SPDX-License-Identifier: Apache-2.0
// Lemke's method, lexicographic, on the static problem as a linear complementarity problem: in the plane, and
// in space with polygons of friction.
//
// The corners d_k of a contact's friction polygon (complete/polygon.h) are two in the plane, +1 and -1, which
// makes fF any number in [-mu fN, mu fN]. The law P(D) of complete driving in space, which is (15), (16) of
// [Baraff94] in the plane, is the LCP  w = M z + q >= 0, z >= 0, z'w = 0  with
//
//   z = (fN, beta_k, l),   w = (aN, d_k.aF + l, mu fN - sum of beta_k),   fF = sum of beta_k d_k
//
//         normal row      corner row     multiplier row          q
//   fN    A_NN            d_k.A_FN       mu               normal row       b_N
//   beta  A_NF d_j        d_k.A_FF d_j   -1               corner row       d_k.b_F
//   l     0               1              0                multiplier row   0
//
// where rows and columns of corners and multipliers are those of the static contacts: a frictionless contact
// contributes its normal alone. Starting from w = q + e z0 with e = (1, ..., 1), or another e > 0 (`Cover`),
// the path keeps z'w = 0 until z0 is zero again: a solution; or until nothing limits it: a ray.
//
// The law      sum of beta_k (d_k.aF + l) = 0 and l >= -d_k.aF: where l > 0, sum of beta_k = mu fN and fF is
//              where fF.aF is least in mu fN times the polygon; where l = 0, aF = 0, since the polygon contains
//              0 inside, and fF is any of its points.
// Copositive   z'Mz = f'Af + sum of mu_i l_i fN_i >= 0 for z >= 0 and A positive semidefinite: the beta_k
//              gather f'Af, and l sum of beta_k stands in the corner rows and, with the other sign, in the
//              multiplier's. So it is in the plane and in space. It is used at a ray, a direction (v, v0) at a
//              point (z, z0) of the path with z0 > 0 and z'(Mv + e v0) = 0, v'w = 0, v'(Mv + e v0) = 0:
//              - v'Mv and v0 e'v are both >= 0 with sum 0, so v0 = 0, v'Mv = 0, Mv >= 0; v /= 0, since the
//                ray is not the first one;
//              - (z + t v)'M(z + t v) >= 0 for all t >= 0 with v'Mv = 0 = z'Mv gives v'Mz >= 0;
//              - so 0 = v'w gives q'v = -v'Mz - z0 e'v < 0.
//              For symmetric A: f = (vN, sum of v_k d_k) is in the cones of the polygons, hence in K, A f = 0
//              and b'f = q'v < 0, which b in range(A) excludes. So every problem that satisfies the paper's
//              assumptions is solved, and a ray proves that (H) fails. It does not prove that there is no
//              solution.
// Finite       the lexicographic rule: rows of (inv(B) q, inv(B)) are lexicographically positive and no basis
//              recurs. The path ends as soon as z0 can leave at the smallest ratio, even in a tie.
// Source       R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, 1992, 3.8 and 4.4;
//              the LCP of polygons: D. E. Stewart, J. C. Trinkle 1996, M. Anitescu, F. A. Potra 1997 (numbers
//              and years to be checked).
// Shapes       m = contacts + sum over static contacts of (corners + 1); a dense tableau m x (m + 1). Units: f
// in
//              N, a in m/s^2.
// Names        of contact 1, in the trace: fN1, f+1, f-1, l1 with aN1, a+1, a-1, m1; in space beta_k is f0.1,
//              f1.1, ... with a0.1, a1.1, ...; and z0.
// Exactness    only + - * / and signs. Over inexact scalars signs are relative to the column (option
//              `pivot`), equal quotients to the option `force`. An answer whose errors exceed the
//              option `loop_grain` is `undecided`; so is a ray unless its forces show A ray = 0, b'ray < 0.
//              Over enclosures (problem/enclosure.h) the variables that are multiples of z0 by the rows of
//              their contact end with it, which no ends of intervals could tell; and the tableau is computed
//              anew at every pivot, O(m^3), since updates would let the ends drift apart.
// Cost         O(m^2) per pivot; with a trace, O(rows^2) more.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/complete/polygon.h"
#include "solver/problem/enclosure.h"
#include "solver/problem/problem.h"
#include "solver/problem/solution.h"

namespace stiction {

// The covering vector d of q + d z0: 1 in every row; or 1 m/s^2 in the rows of accelerations
// and 1/max A_ii N in those of force limits. The second path does not depend on the units of the data, and is
// the one to take over inexact scalars: where A is far from 1 the first mixes magnitudes. Graded: g^r, g =
// Grade(), in the rows of accelerations, r the row of A, and 1/g in those of force limits. For exact scalars;
// the path is that of complete driving (complete/equivalence.md).
enum class Cover : std::uint8_t { kOnes, kUnits, kGraded };

// Large beside the quotients of a problem, whose bits are few beside 200.
template <class Scalar>
Scalar Grade() {
  const Scalar fifty(static_cast<double>(std::int64_t{1} << 50));
  return fifty * fifty * fifty * fifty;
}

// Why an answer over inexact scalars is undecided whose path came to its end: f() and a() are where it ended.
inline constexpr std::string_view kImprecise = "errors of the answer";

// Reusable: memory is kept between runs.
template <class Scalar, int Rows = Eigen::Dynamic>
class LemkeAlgorithm {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using Vector = typename Problem::Vector;
  using Polygons = std::vector<FrictionPolygon<Scalar>>;

  explicit LemkeAlgorithm(const Request& request = {}, Cover cover = Cover::kOnes)
      : request_(request), kind_of_cover_(cover) {}

  Request& request() { return request_; }

  // Requires PublishedHandles(problem): planar, frictionless and static contacts. Outcome: solved, ray, limit
  // (reason "pivots" or "bits") or undecided. Counts `pivots` only; the first, which brings z0 in, counts.
  // With `trace`, every pivot is recorded: `driven` is the row of the contact's normal or (first) friction that
  // the entering variable belongs to, `limiting` that of the leaving one; -1 for z0, and where a ray ends the
  // run, which has no leaving variable. s, df, da are told per unit of the entering variable, in N or m/s^2.
  RunEnd<> Run(const Problem& problem, Trace<Scalar>* trace = nullptr);

  // The same in space. Requires dimension 3, frictionless and static contacts, and a polygon per contact, with
  // zero inside.
  RunEnd<> Run(const Problem& problem, const Polygons& polygons, Trace<Scalar>* trace = nullptr);

  // Of a solved run: forces, and accelerations a = A f + b.
  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }
  // Of a ray: the direction of the forces, in K; A ray = 0, b'ray < 0 if A is symmetric and semidefinite.
  const Vector& ray() const { return ray_; }

 private:
  // Integers for fraction-free scalars, otherwise the scalar itself.
  using Entry = typename Fractions<Scalar>::Integer;
  static constexpr int kSize = Rows == Eigen::Dynamic ? Eigen::Dynamic : 2 * Rows;
  static constexpr int kColumns = Rows == Eigen::Dynamic ? Eigen::Dynamic : 2 * Rows + 1;

  // A component of z, and of w with the same index.
  enum class Block { kNormal, kCorner, kMultiplier };
  struct Component {
    Block block;
    int row;  // of A: the first friction row but for kNormal
    int contact;
    int corner = 0;
  };

  RunEnd<> Run();
  void Start();
  void SetUnits();
  void ListComponents();
  void ListCorners();
  int Corners(int contact) const;
  template <class Values>
  Scalar Along(const Component& component, const Values& values) const;
  Scalar RightSide(const Component& w) const;
  Scalar MatrixEntry(const Component& w, const Component& z) const;
  Scalar LimitCover() const;
  Scalar CoverOf(const Component& w, const Scalar& limit_cover) const;
  void SetRow(int i, const Scalar& limit_cover);
  bool IsNonnegative() const;

  // Variables of the path: w_0 ... w_{m-1}, z_0 ... z_{m-1}, z0.
  int Artificial() const { return 2 * size_; }
  const Component& ComponentOf(int variable) const { return components_[variable % size_]; }
  Outcome Follow();
  int FirstLeaving() const;
  void ComputeColumn(int entering);
  int Leaving(int entering) const;
  int CompareQuotients(int i, int k, int c) const;
  bool IsBefore(int i, int k) const;
  void Pivot(int row, int entering);
  void Eliminate(int row);
  void EliminateIntegers(int row);
  bool IsBasic(int variable) const;
  bool FollowsCover(int i, int entering) const;
  void MeetEnd(int entering);
  void Renew();
  Scalar BasisEntry(int row, int variable) const;
  bool BudgetSpent();
  bool MayExceedBits(int i) const;

  Scalar Value(int i) const;
  void AddForce(int variable, const Scalar& value, Vector& f) const;
  void Extract();
  void ComputeRay(int entering);
  Outcome JudgeSolution();
  Outcome JudgeRay();

  std::string NameOf(int variable) const;
  int RowOf(int variable) const;
  Scalar UnitOf(int variable) const;
  void RecordStep(int row, int entering);
  void RecordPoint(int row);

  Request request_;
  Cover kind_of_cover_;
  const Problem* problem_ = nullptr;
  const Polygons* polygons_ = nullptr;  // in space
  Trace<Scalar>* trace_ = nullptr;      // where pivots are kept
  int size_ = 0;                        // m
  std::vector<Component> components_;
  // w - M z - d z0 = q, B its basic columns. Over integers each row is times its unit, w_i with it, and T_ and
  // column_ are times the denominator.
  Eigen::Matrix<Entry, kSize, kColumns, Eigen::RowMajor> T_;  // inv(B) (q, I)
  Eigen::Matrix<Entry, kSize, kSize> M_;
  Eigen::Matrix<Entry, kSize, 1> column_;  // inv(B) times the entering column
  Eigen::Matrix<Entry, kSize, 1> cover_;   // d
  std::vector<Entry> row_units_;
  Entry denominator_ = Entry(1);
  std::vector<int> basis_;  // variable of each row
  Scalar unit_A_ = Scalar(1), unit_b_ = Scalar(1);
  Scalar pivot_tolerance_ = Scalar(0), tie_tolerance_ = Scalar(0), residual_tolerance_ = Scalar(0);
  Vector f_, a_, ray_;
  RunEnd<> verdict_;
};

}  // namespace stiction
