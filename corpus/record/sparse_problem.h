// SPDX-License-Identifier: Apache-2.0
// SparseProblem: a problem as other programs publish it, large and mostly zeros, over exact numbers.
//
// The published numbers are IEEE doubles, and a double is a rational number: nothing is rounded on reading.

#ifndef STICTION_CORPUS_RECORD_SPARSE_PROBLEM_H_
#define STICTION_CORPUS_RECORD_SPARSE_PROBLEM_H_

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "corpus/record/problem_file.h"
#include "solver/problem/problem.h"

namespace stiction {

struct SparseProblem {
  std::string name;
  int dimension = 2;
  std::vector<Contact<Rational>> contacts;
  SparseMatrix A;  // no entry is zero; empty as long as there are factors alone (WithMatrix)
  ExactProblem::Vector b;
  Json origin = Json::object();  // format, storage, what was computed or changed on reading
  std::optional<ExactFactors> factors = {};

  int rows() const { return static_cast<int>(b.size()); }
};

// Whether A stays as it is until somebody asks for all of it. Factors do so earlier: what they are for does not
// need A.
inline bool StaysSparse(int rows, bool in_factors, int most_dense_rows = kMostDenseRows) {
  return rows > (in_factors ? most_dense_rows / 4 : most_dense_rows);
}

// A problem file; sparse where A is in entries or in factors and stays so. Of factors A is not formed then.
std::variant<ProblemFile, SparseProblem> ParseAnySize(std::string_view text, const std::string& source,
                                                      int most_dense_rows = kMostDenseRows);

// The text of a problem file, A in factors if there are some, otherwise in entries.
std::string Print(const SparseProblem& problem);

// The same problem, its A formed if there are factors alone.
SparseProblem WithMatrix(SparseProblem problem);

SparseProblem ToSparse(const ProblemFile& file);
// InputError, naming `source`, above kMostDenseRows.
ProblemFile ToDense(const SparseProblem& problem, const std::string& source);

// The same numbers, or the nearest doubles.
SparseContactProblem<Rational> OverRationals(const SparseProblem& problem);
SparseContactProblem<double> InDoubles(const SparseProblem& problem);

// The largest abs(A_ij - A_ji), i < j, and where it is first found; zero at (0, 0) if A is symmetric.
struct Asymmetry {
  Rational difference = 0;
  int i = 0, j = 0;
};
Asymmetry LargestAsymmetry(const SparseProblem& problem);

// A becomes (A + A')/2, exactly; `origin` says what the largest difference was. A symmetric A stays as it is,
// as that of factors is.
void Symmetrize(SparseProblem& problem);

}  // namespace stiction

#endif  // STICTION_CORPUS_RECORD_SPARSE_PROBLEM_H_
