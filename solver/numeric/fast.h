// SPDX-License-Identifier: Apache-2.0
// The fast method: guess the cells of all contacts, verify, and drive where guessing fails.
//
// For planar problems over floating-point scalars, with contacts of any kind. Cells are those of complete.h; a
// bilateral contact and a closed sliding one are in the cell 0 (free), where a sliding contact has
// fF = -mu slip fN, equation (24) of [Baraff94].
//
//   sweep     a few projected Gauss-Seidel sweeps from f = 0, or the cells of an earlier solution
//   exchange  the cells give a linear system M u = -b for the forces that they leave free; every contact
//             that then violates its cell moves to the next: block pivoting, or a semismooth Newton method.
//             A closing contact starts at the limit that opposes its tangential acceleration. With friction,
//             where M is singular: of all forces about the least ones, and all contacts stick at first.
//   active    without friction, A symmetric, where exchanging has not ended or M is singular: the active set
//             method of Lawson and Hanson; f'Af / 2 + b'f decreases until a >= 0. A contact enters for a
//             violation above the tolerance only, so that M stays regular where A is singular; M is updated,
//             not factored.
//   resweep   with friction, where exchanging has not ended and M is regular: more sweeps, and again
//   published the published algorithm, for the kinds that it is built for, within a budget of pivots
//   complete  complete driving, for the same
//
// Whatever is found is called solved only if the errors of (f, A f + b), computed from f alone, are at most
// `residual` (problem/errors.h); otherwise the outcome is `undecided`. How the cells were found is of no
// account.
//
// Shapes      f, a: rows x 1. Units: f in N, a in m/s^2.
// Cost        a factorization of the free rows per exchange; typically 1 to 5 of them.
// Source      exchange: J. J. Judice, F. M. Pires, Computers and Operations Research 21, 1994, 587-596; active:
//             C. L. Lawson, R. J. Hanson, Solving Least Squares Problems, 1974, chapter 23.

#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/complete/complete.h"
#include "solver/linear/dense_factor.h"
#include "solver/problem/errors.h"
#include "solver/problem/units.h"
#include "solver/published/published.h"

namespace stiction {

// Of a request tolerances (which violations move a contact, which columns of M are dependent), limits, residual
// and noise are read; limits.pivots bounds the updates of a factored matrix, too.
//
// Reusable: a run of a problem no larger than one before allocates nothing, unless another method is called.
template <class Scalar>
class FastSolver {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  explicit FastSolver(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }

  bool drives = true;  // whether the published algorithm and complete driving are behind guesses

  // Of the plane. `guess` holds a cell per contact to start from, such as cells() of a
  // problem solved before; cells that a contact cannot be in are replaced. Without it, sweeps start.
  RunEnd<> Run(const Problem& problem, std::span<const Cell> guess = {});

  // Forces in which the last run ended, and a = A f + b.
  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }
  // Cell of every contact; of use after a solved run. Those of the published algorithm may leave forces open.
  const std::vector<Cell>& cells() const { return cells_; }
  std::string Word() const;

 private:
  void Start(const Problem& problem);
  void Guess(std::span<const Cell> guess);
  bool Find();
  void FallBack();
  bool SolveAsPublished();
  bool Verify();
  bool IsSymmetric(Scalar tolerance) const;
  bool Project();
  void AddColumn(int row, Scalar factor);

  // Gauss-Seidel.
  void Sweep(int sweeps);
  void SweepFriction(const Contact<Scalar>& contact, int row);
  void Push(int row, Scalar step);
  void TakeCells();

  // Exchanges.
  bool ExchangeUntilSettled();
  bool SolveCells();
  void ListUnknowns();
  bool Shift();
  bool FactorCells();
  bool IsRefined();
  bool IsSolvedAsSymmetric() const;
  bool FactorSymmetric();
  bool FactorGeneral();
  void SolveFactored(Scalar* y) const;
  void SetForces();
  void SetAccelerations();
  int ListMoves();
  Cell NextCell(int contact) const;
  void Move(bool last_only);

  // Active set of frictionless contacts.
  bool ActiveSet();
  bool StartActiveSet();
  int MostViolated() const;
  bool Enter(int contact);
  void Descend();
  int Blocking(Scalar& step) const;
  void Leave(int unknown);

  Request request_;
  const Problem* problem_ = nullptr;
  RunEnd<> verdict_;
  Vector f_, a_, inverse_;  // inverse_: of the diagonal of A
  Vector a_told_;           // but for noise
  std::vector<Cell> cells_, next_;
  std::vector<int> row_of_;                                             // normal row by contact
  bool frictionless_ = false;                                           // one row per contact
  bool is_given_ = false;                                               // the first cells are an earlier run's
  bool distrust_ = false;                                               // A is not symmetric
  Scalar max_A_ = Scalar(0), max_b_ = Scalar(0), unit_ = Scalar(0);     // unit_ = 1 / max_A_
  Scalar pivot_ = Scalar(0), zero_a_ = Scalar(0), zero_f_ = Scalar(0);  // tolerances, relative,
  Scalar least_a_ = Scalar(0), least_f_ = Scalar(0);                    // and of the last forces

  // The reduced system of the cells.
  int size_ = 0;
  std::vector<int> unknowns_;       // rows of A whose force is free; without friction rows, also contacts
  std::vector<Scalar> limit_;       // fF / fN of a normal whose friction follows it, or 0
  std::vector<Scalar> u_;           // forces of the unknowns
  std::vector<Scalar> correction_;  // of u_, where M is shifted
  Scalar shift_ = Scalar(0);        // of M's diagonal, relative to A's
  bool symmetric_ = false, dropped_ = false;
  DenseFactor<Scalar> factor_;
  ErrorMeter<Scalar> meter_;

  PublishedAlgorithm<Scalar> published_;
  CompleteDriving<Scalar> driving_;
};

}  // namespace stiction
