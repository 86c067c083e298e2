// SPDX-License-Identifier: Apache-2.0
// K = M + J' S J of a problem in factors, with a block S per contact: as large as the bodies' velocities,
// whatever the number of contacts, with entries where two bodies touch. Its ordering is kept as long as the
// same bodies touch.
//
// Shapes  S: rows x rows of a contact, at most 3 x 3; y, v: velocities x 1. Units: K kg or kg m^2. Doubles.
// Cost    a sparse LDL' or LU factorization (sparse_lu.h).

#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <span>
#include <vector>

#include "solver/linear/sparse_lu.h"
#include "solver/problem/forms.h"

namespace stiction {

// Reusable. Memory and the ordering are kept from problem to problem; results do not depend on earlier ones.
class BodyMatrix {
 public:
  using Problem = FactoredProblem<double>;
  using Vector = Eigen::VectorXd;
  using Block = std::array<std::array<double, 3>, 3>;

  // A contact's rows of J, dense in the columns that they have entries in.
  struct Piece {
    int row = 0, rows = 0;
    int column = 0, columns = 0;  // where its columns begin in columns_
    int slot = 0;                 // where its columns x columns places in K begin in slots_
    int entry = 0;                // where its rows x columns numbers begin in entries_
  };

  // The problem outlives what follows.
  void Take(const Problem& problem);

  // By contact.
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::span<const int> columns(const Piece& piece) const {
    return {columns_.data() + piece.column, static_cast<std::size_t>(piece.columns)};
  }
  const double* entries(const Piece& piece) const { return entries_.data() + piece.entry; }
  // The largest A_ii of a contact; that of all where its own is 0.
  double own(int contact) const { return own_[contact]; }
  int widest() const { return widest_; }  // most columns of a contact

  // A block whose [0][0] is 0 counts as zero. False where K is found singular.
  bool Factor(const std::vector<Block>& S, bool is_symmetric);
  // inv(K) y, of the K factored last.
  Vector Solve(const Vector& y);

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  void TakePieces();
  void TakePattern();

  const Problem* problem_ = nullptr;
  std::vector<Piece> pieces_;
  std::vector<int> columns_;
  std::vector<double> entries_;
  std::vector<int> slots_, mass_slots_;
  std::vector<int> known_columns_, known_rows_;  // of the pattern that K has
  std::vector<int> known_mass_;
  std::vector<double> own_;
  int widest_ = 0;

  Matrix K_;
  Eigen::SimplicialLDLT<Matrix> ldlt_;
  SparseLu lu_;
  bool uses_lu_ = false, ldlt_knows_ = false, lu_knows_ = false;
};

// What Coulomb's law makes of the forces p that a contact asks for: the normal force max(0, pN), friction the
// nearest point to pF of the interval or disc of radius mu fN; S its slope (zero where it separates). rows: of
// p, of f and of S. True where S is symmetric.
bool ProjectOnLaw(const Contact<double>& contact, int rows, const double* p, double* f, BodyMatrix::Block& S);

}  // namespace stiction
