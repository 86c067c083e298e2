// SPDX-License-Identifier: Apache-2.0
#include "solver/numeric/body_matrix.h"

#include <algorithm>
#include <cmath>

#include "solver/problem/units.h"

namespace stiction {

void BodyMatrix::Take(const Problem& problem) {
  problem_ = &problem;
  lu_.ForgetPivots();
  TakePieces();
  TakePattern();
}

// The rows of J by contact.
void BodyMatrix::TakePieces() {
  const auto& J = problem_->A.J();
  pieces_.clear();
  columns_.clear();
  entries_.clear();
  own_.clear();
  widest_ = 0;
  double largest = 0;
  int slot = 0;
  ForEachContact(*problem_, [&](int, int row, int rows) {
    Piece piece;
    piece.row = row;
    piece.rows = rows;
    piece.column = static_cast<int>(columns_.size());
    piece.entry = static_cast<int>(entries_.size());
    piece.slot = slot;
    for (int i = row; i < row + rows; ++i) {
      for (Problem::Matrix::Rows::InnerIterator of(J, i); of; ++of)
        columns_.push_back(static_cast<int>(of.col()));
    }
    std::sort(columns_.begin() + piece.column, columns_.end());
    columns_.erase(std::unique(columns_.begin() + piece.column, columns_.end()), columns_.end());
    piece.columns = static_cast<int>(columns_.size()) - piece.column;
    widest_ = std::max(widest_, piece.columns);
    slot += piece.columns * piece.columns;
    entries_.resize(entries_.size() + static_cast<std::size_t>(rows * piece.columns), 0);
    double own = 0;
    for (int i = 0; i < rows; ++i) {
      const auto begin = columns_.begin() + piece.column;
      for (Problem::Matrix::Rows::InnerIterator of(J, row + i); of; ++of) {
        const auto at = std::lower_bound(begin, columns_.end(), static_cast<int>(of.col())) - begin;
        entries_[piece.entry + i * piece.columns + at] = of.value();
      }
      own = std::max(own, problem_->A.coeff(row + i, row + i));
    }
    own_.push_back(own);
    largest = std::max(largest, own);
    pieces_.push_back(piece);
  });
  for (double& own : own_) {
    if (!(own > 0)) own = largest > 0 ? largest : 1;
  }
}

// K's pattern, its ordering, and where the pieces and M stand in it; kept where they are those of the problem
// before.
void BodyMatrix::TakePattern() {
  std::vector<int> rows;
  for (const Piece& piece : pieces_) rows.push_back(piece.columns);
  const Matrix& M = problem_->M;
  std::vector<int> mass(M.innerIndexPtr(), M.innerIndexPtr() + M.nonZeros());
  mass.insert(mass.end(), M.outerIndexPtr(), M.outerIndexPtr() + M.outerSize() + 1);
  if (rows == known_rows_ && columns_ == known_columns_ && mass == known_mass_ && K_.cols() == M.cols()) return;
  known_rows_ = rows;
  known_columns_ = columns_;
  known_mass_ = mass;
  std::vector<Eigen::Triplet<double>> places;
  for (int k = 0; k < M.outerSize(); ++k) {
    for (Matrix::InnerIterator of(M, k); of; ++of) places.emplace_back(of.row(), k, 1);
  }
  for (const Piece& piece : pieces_) {
    for (const int j : columns(piece)) {
      for (const int i : columns(piece)) places.emplace_back(i, j, 1);
    }
  }
  K_.resize(M.rows(), M.cols());
  K_.setFromTriplets(places.begin(), places.end());
  const auto slot = [this](int i, int j) {
    const int *from = K_.innerIndexPtr() + K_.outerIndexPtr()[j],
              *to = K_.innerIndexPtr() + K_.outerIndexPtr()[j + 1];
    return static_cast<int>(std::lower_bound(from, to, i) - K_.innerIndexPtr());
  };
  mass_slots_.clear();
  for (int k = 0; k < M.outerSize(); ++k) {
    for (Matrix::InnerIterator of(M, k); of; ++of) mass_slots_.push_back(slot(static_cast<int>(of.row()), k));
  }
  slots_.clear();
  for (const Piece& piece : pieces_) {
    for (const int j : columns(piece)) {
      for (const int i : columns(piece)) slots_.push_back(slot(i, j));
    }
  }
  ldlt_knows_ = lu_knows_ = false;
}

bool BodyMatrix::Factor(const std::vector<Block>& S, bool is_symmetric) {
  if (K_.cols() == 0) return true;
  double* K = K_.valuePtr();
  std::fill(K, K + K_.nonZeros(), 0.0);
  const double* M = problem_->M.valuePtr();
  for (std::size_t k = 0; k < mass_slots_.size(); ++k) K[mass_slots_[k]] += M[k];
  for (std::size_t c = 0; c < pieces_.size(); ++c) {
    if (S[c][0][0] == 0) continue;
    const Piece& piece = pieces_[c];
    const double* J = entries(piece);
    const int* slot = slots_.data() + piece.slot;
    for (int j = 0; j < piece.columns; ++j) {
      std::array<double, 3> SJ{};
      for (int i = 0; i < piece.rows; ++i) {
        for (int k = 0; k < piece.rows; ++k) SJ[i] += S[c][i][k] * J[k * piece.columns + j];
      }
      for (int k = 0; k < piece.columns; ++k, ++slot) {
        double sum = 0;
        for (int i = 0; i < piece.rows; ++i) sum += J[i * piece.columns + k] * SJ[i];
        K[*slot] += sum;
      }
    }
  }
  uses_lu_ = !is_symmetric;
  if (uses_lu_) {
    if (!lu_knows_) lu_.Order(K_);
    lu_knows_ = true;
    return lu_.Factor(K_);
  }
  if (!ldlt_knows_) ldlt_.analyzePattern(K_);
  ldlt_knows_ = true;
  ldlt_.factorize(K_);
  return ldlt_.info() == Eigen::Success;
}

auto BodyMatrix::Solve(const Vector& y) -> Vector {
  if (y.size() == 0) return y;
  if (uses_lu_) return lu_.Solve(K_, y);
  return ldlt_.solve(y);
}

bool ProjectOnLaw(const Contact<double>& contact, int rows, const double* p, double* f, BodyMatrix::Block& S) {
  S = {};
  for (int i = 0; i < rows; ++i) f[i] = 0;
  if (contact.kind != ContactKind::kBilateral && !(p[0] > 0)) return true;
  f[0] = p[0];
  S[0][0] = 1;
  if (!contact.HasFrictionRows()) return true;
  const double limit = contact.mu * p[0];
  if (contact.kind == ContactKind::kSliding) {
    for (int i = 1; i < rows; ++i) {
      f[i] = -contact.slip[i - 1] * limit;
      S[i][0] = -contact.slip[i - 1] * contact.mu;
    }
    return contact.mu == 0;
  }
  const double length = rows == 2 ? std::abs(p[1]) : Length(p[1], p[2]);
  if (length <= limit) {
    for (int i = 1; i < rows; ++i) {
      f[i] = p[i];
      S[i][i] = 1;
    }
    return true;
  }
  for (int i = 1; i < rows; ++i) {
    const double way = p[i] / length;
    f[i] = limit * way;
    S[i][0] = contact.mu * way;
    for (int j = 1; j < rows && rows == 3; ++j) S[i][j] = limit / length * ((i == j) - way * p[j] / length);
  }
  return contact.mu == 0;
}

}  // namespace stiction
