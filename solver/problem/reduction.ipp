// SPDX-License-Identifier: Apache-2.0
// Definitions for reduction.h.

#pragma once

#include <algorithm>

#include "solver/problem/reduction.h"
#include "solver/problem/units.h"

namespace stiction {

template <class Scalar>
bool Reduction<Scalar>::Concerns(const Problem& problem) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(), [](const Contact<Scalar>& contact) {
    return contact.kind == ContactKind::kBilateral || contact.kind == ContactKind::kSliding;
  });
}

template <class Scalar>
Reduction<Scalar>::Reduction(const Problem& problem, const Tolerances& tolerances, bool exchanges) {
  Sort(problem);
  ReplaceSlidingFriction(problem);
  EliminateBilateral(tolerances, exchanges);
}

// Which rows remain, and the contacts that they make up.
template <class Scalar>
void Reduction<Scalar>::Sort(const Problem& problem) {
  reduced_.dimension = problem.dimension;
  ForEachContact(problem, [&](int number, int row, int rows) {
    const Contact<Scalar>& contact = problem.contacts[number];
    if (contact.kind == ContactKind::kBilateral) {
      bilateral_.push_back(row);
    } else {
      const bool slides = contact.kind == ContactKind::kSliding;
      for (int i = 0; i < (slides ? 1 : rows); ++i) row_of_.push_back(row + i);
      contact_of_.push_back(number);
      reduced_.contacts.push_back(slides ? Contact<Scalar>{ContactKind::kFrictionless, Scalar(0), {}}
                                         : contact);
    }
  });
}

// (24): E maps the variables, the reduced rows and then the bilateral ones, to all forces; M = A E.
template <class Scalar>
void Reduction<Scalar>::ReplaceSlidingFriction(const Problem& problem) {
  const int kept = static_cast<int>(row_of_.size());
  const int variables = kept + static_cast<int>(bilateral_.size());
  E_ = Matrix::Constant(problem.rows(), variables, Scalar(0));
  for (int j = 0; j < variables; ++j) E_(j < kept ? row_of_[j] : bilateral_[j - kept], j) = Scalar(1);
  M_.resize(problem.rows(), variables);
  for (int j = 0; j < variables; ++j) M_.col(j) = problem.A.col(j < kept ? row_of_[j] : bilateral_[j - kept]);
  ForEachContact(problem, [&](int number, int row, int rows) {
    const Contact<Scalar>& contact = problem.contacts[number];
    if (contact.kind != ContactKind::kSliding) return;
    const auto at = std::find(row_of_.begin(), row_of_.end(), row);
    const int j = static_cast<int>(at - row_of_.begin());
    for (int i = 1; i < rows; ++i) {
      const Scalar factor = -contact.mu * contact.slip[i - 1];
      E_(row + i, j) = factor;
      M_.col(j) += problem.A.col(row + i) * factor;
    }
  });
  b_ = problem.b;
}

// (4.5): Gauss-Jordan elimination on [A_BU A_BB b_B], pivots anywhere in A_BB; over exact scalars in its first
// column that does not depend on those before. Returns the bilateral variable that each row determines, fewer
// than there are rows if A_BB is singular.
template <class Scalar>
std::vector<int> Reduction<Scalar>::SolveBilateral(Matrix& T, const Scalar& zero) const {
  const int count = static_cast<int>(bilateral_.size()), kept = static_cast<int>(row_of_.size());
  std::vector<int> determines;
  for (int rank = 0; rank < count; ++rank) {
    int row = -1, column = -1;
    for (int j = 0; j < count; ++j) {  // columns of earlier pivots are zero here
      for (int i = rank; i < count; ++i) {
        if (Sign(T(i, kept + j), zero) == 0) continue;
        if (row >= 0 && (kIsExact<Scalar> || !(Abs(T(i, kept + j)) > Abs(T(row, kept + column))))) continue;
        row = i;
        column = j;
      }
    }
    if (row < 0) break;
    T.row(rank).swap(T.row(row));
    determines.push_back(column);
    T.row(rank) /= Scalar(T(rank, kept + column));
    for (int i = 0; i < count; ++i) {
      const Scalar factor = T(i, kept + column);
      if (i == rank || Sign(factor) == 0) continue;
      T.row(i) -= factor * T.row(rank);
      T(i, kept + column) = Scalar(0);
    }
  }
  return determines;
}

// x_B = X x_U + x0, zero where a constraint is redundant. Then rows U of M (x_U, x_B) + b are the problem.
template <class Scalar>
void Reduction<Scalar>::EliminateBilateral(const Tolerances& tolerances, bool exchanges) {
  const int count = static_cast<int>(bilateral_.size()), kept = static_cast<int>(row_of_.size());
  Scalar zero(0), zero_acceleration(0);
  if constexpr (!kIsExact<Scalar>) {
    for (int i = 0; i < b_.size(); ++i) {
      zero = std::max(zero, M_.row(i).cwiseAbs().maxCoeff());
      zero_acceleration = std::max(zero_acceleration, Abs(b_[i]));
    }
    zero *= Scalar(tolerances.pivot);
    zero_acceleration *= Scalar(tolerances.acceleration);
  }
  Matrix T(count, kept + count + 1);
  for (int i = 0; i < count; ++i) {
    T.row(i).head(kept + count) = M_.row(bilateral_[i]);
    T(i, kept + count) = b_[bilateral_[i]];
  }
  std::vector<int> determines = SolveBilateral(T, zero);
  const int rank = static_cast<int>(determines.size());
  Matrix X = Matrix::Constant(count, kept + count, Scalar(0));  // of x_U, and of redundant forces
  Vector x0 = Vector::Constant(count, Scalar(0));
  for (int j = 0; j < count; ++j) X(j, kept + j) = Scalar(1);
  for (int i = 0; i < rank; ++i) {
    X.row(determines[i]) = -T.row(i).head(kept + count);
    X(determines[i], kept + determines[i]) = Scalar(0);
    x0[determines[i]] = -T(i, kept + count);
  }
  Matrix A = M_.rightCols(count) * X;
  A.leftCols(kept) += M_.leftCols(kept);
  Vector b = b_ + M_.rightCols(count) * x0;
  e_ = E_.rightCols(count) * x0;
  Matrix E = E_.rightCols(count) * X;
  E.leftCols(kept) += E_.leftCols(kept);
  E_ = std::move(E);
  exchanged_.assign(kept, false);
  if (exchanges) Exchange(A, b, determines, zero);
  end_ = Classify(A, b, determines, zero, zero_acceleration);
  reduced_.A.resize(kept, kept);
  reduced_.b.resize(kept);
  for (int i = 0; i < kept; ++i) {
    const int row = row_of_[i];
    reduced_.A.row(i) = exchanged_[i] ? E_.row(row).head(kept) : A.row(row).head(kept);
    reduced_.b[i] = exchanged_[i] ? e_[row] : b[row];
  }
  E_ = E_.leftCols(kept).eval();  // redundant forces rest at zero
}

// The candidate whose value is not zero: over exact scalars the first, otherwise that of the largest; -1: none.
template <class Scalar, class ValueOf>
int PivotAmong(const std::vector<int>& candidates, const Scalar& zero, ValueOf value_of) {
  int best = -1;
  for (const int candidate : candidates) {
    const bool found = best >= 0 && (kIsExact<Scalar> || !(Abs(value_of(candidate)) > Abs(value_of(best))));
    if (!found && Sign(value_of(candidate), zero) != 0) best = candidate;
  }
  return best;
}

// Of a = A x + b, f = E x + e with x the reduced forces and then the redundant ones: a_r = 0 of a bilateral row
// tells x_k of a frictionless contact, and a_k a redundant x_c, whose place a_k takes, as k.
template <class Scalar>
void Reduction<Scalar>::Exchange(Matrix& A, Vector& b, std::vector<int>& determines, const Scalar& zero) {
  const int kept = static_cast<int>(row_of_.size());
  std::vector<int> redundant, frictionless;  // columns
  for (int j = 0; j < static_cast<int>(bilateral_.size()); ++j)
    if (std::find(determines.begin(), determines.end(), j) == determines.end()) redundant.push_back(kept + j);
  ForEachContact(reduced_, [&](int i, int row, int) {
    if (reduced_.contacts[i].kind == ContactKind::kFrictionless) frictionless.push_back(row);
  });
  const auto row_of = [&](int k) {
    return PivotAmong(bilateral_, zero, [&](int row) { return Scalar(A(row, k)); });
  };
  const auto column_of = [&](int k) {
    return PivotAmong(redundant, zero, [&](int column) { return Scalar(A(row_of_[k], column)); });
  };
  // x_column = (x_k - the rest of the row) / its pivot
  const auto substitute = [&](int row, int column, int k, const Scalar& of_k) {
    const Scalar pivot = A(row, column), constant = -b[row] / pivot;
    Vector values = -A.row(row).transpose() / pivot;
    values[column] = Scalar(0);
    if (of_k != 0) values[k] = of_k / pivot;
    const auto into = [&](Matrix& M, Vector& m) {
      for (int i = 0; i < M.rows(); ++i) {
        const Scalar factor = M(i, column);
        if (Sign(factor) == 0) continue;
        M(i, column) = Scalar(0);
        M.row(i) += factor * values.transpose();
        m[i] += factor * constant;
      }
    };
    into(A, b);
    into(E_, e_);
  };
  while (!redundant.empty()) {
    const int k = PivotAmong(frictionless, Scalar(0), [&](int at) {
      const int row = row_of(at), column = column_of(at);
      return row < 0 || column < 0 ? Scalar(0) : Scalar(A(row, at) * A(row_of_[at], column));
    });
    if (k < 0) return;
    const int row = row_of(k), column = column_of(k);
    substitute(row, k, k, Scalar(0));
    A.row(row).setConstant(Scalar(0));
    b[row] = Scalar(0);
    substitute(row_of_[k], column, k, Scalar(1));
    exchanged_[k] = true;
    determines.push_back(column - kept);
    std::erase(redundant, column);
    std::erase(frictionless, k);
  }
}

// A, b: accelerations as functions of the reduced forces and then of the redundant ones. The bilateral ones
// among them must be zero, and redundant forces without effect.
template <class Scalar>
ReductionEnd Reduction<Scalar>::Classify(const Matrix& A, const Vector& b, const std::vector<int>& determines,
                                         const Scalar& zero, const Scalar& zero_acceleration) const {
  const int kept = static_cast<int>(row_of_.size());
  if (determines.size() == bilateral_.size()) return ReductionEnd::kReduced;
  for (const int row : bilateral_) {
    for (int j = 0; j < kept; ++j) {
      if (Sign(A(row, j), zero) != 0) return ReductionEnd::kSingular;
    }
  }
  for (int j = 0; j < static_cast<int>(bilateral_.size()); ++j) {
    if (std::find(determines.begin(), determines.end(), j) != determines.end()) continue;
    for (const int row : row_of_) {
      if (Sign(A(row, kept + j), zero) != 0) return ReductionEnd::kSingular;
    }
  }
  for (const int row : bilateral_) {
    if (Sign(b[row], zero_acceleration) != 0) return ReductionEnd::kInconsistent;
  }
  return ReductionEnd::kReduced;
}

}  // namespace stiction
