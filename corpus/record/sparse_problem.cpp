// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/sparse_problem.h"

#include <fmt/format.h>

#include "corpus/json.h"

namespace stiction {
namespace {

Rational EntryAt(const SparseMatrix& A, int i, int j) {
  const auto found = A.find({i, j});
  return found == A.end() ? Rational(0) : found->second;
}

template <class Scalar, class Convert>
SparseContactProblem<Scalar> Converted(const SparseProblem& problem, Convert convert) {
  SparseContactProblem<Scalar> other;
  other.dimension = problem.dimension;
  for (const Contact<Rational>& contact : problem.contacts) {
    const Scalar slip[] = {convert(contact.slip[0]), convert(contact.slip[1])};
    other.contacts.push_back({contact.kind, convert(contact.mu), {slip[0], slip[1]}});
  }
  std::vector<Eigen::Triplet<Scalar>> entries;
  for (const auto& [at, value] : problem.A) entries.emplace_back(at.first, at.second, convert(value));
  other.A.resize(problem.rows(), problem.rows());
  other.A.setFromTriplets(entries.begin(), entries.end());
  other.b = problem.b.unaryExpr(convert);
  return other;
}

}  // namespace

SparseProblem WithMatrix(SparseProblem problem) {
  if (problem.factors && problem.A.empty()) problem.A = FormA(*problem.factors);
  return problem;
}

SparseProblem ToSparse(const ProblemFile& file) {
  const ExactProblem& dense = file.problem;
  SparseProblem problem{file.name, dense.dimension, dense.contacts, {}, dense.b, Json::object(), file.factors};
  for (int i = 0; i < dense.rows(); ++i) {
    for (int j = 0; j < dense.rows(); ++j) {
      if (dense.A(i, j) != 0) problem.A.emplace_hint(problem.A.end(), std::pair(i, j), dense.A(i, j));
    }
  }
  if (file.origin) problem.origin = *file.origin;
  return problem;
}

ProblemFile ToDense(const SparseProblem& problem, const std::string& source) {
  const int rows = problem.rows();
  if (rows > kMostDenseRows) {
    throw InputError(source, "rows", std::to_string(rows),
                     fmt::format("at most {} for a dense matrix; stiction solve and stiction survey take more",
                                 kMostDenseRows));
  }
  ProblemFile file;
  file.name = problem.name;
  file.origin = problem.origin;
  file.factors = problem.factors;
  if (problem.factors) {
    file.problem = ToDense(*problem.factors);
    return file;
  }
  file.problem.dimension = problem.dimension;
  file.problem.contacts = problem.contacts;
  file.problem.A = ExactProblem::Matrix::Constant(rows, rows, Rational(0));
  for (const auto& [at, value] : problem.A) file.problem.A(at.first, at.second) = value;
  file.problem.b = problem.b;
  return file;
}

SparseContactProblem<Rational> OverRationals(const SparseProblem& problem) {
  return Converted<Rational>(problem, [](const Rational& x) { return x; });
}

SparseContactProblem<double> InDoubles(const SparseProblem& problem) {
  return Converted<double>(problem, &ToDouble);
}

Asymmetry LargestAsymmetry(const SparseProblem& problem) {
  Asymmetry largest;
  for (const auto& [at, value] : problem.A) {
    const auto [i, j] = at;
    const Rational difference = abs(Rational(value - EntryAt(problem.A, j, i)));
    if (difference > largest.difference) largest = {difference, std::min(i, j), std::max(i, j)};
  }
  return largest;
}

void Symmetrize(SparseProblem& problem) {
  const Asymmetry largest = LargestAsymmetry(problem);
  if (largest.difference == 0) return;
  SparseMatrix sum;
  for (const auto& [at, value] : problem.A) {
    const auto [i, j] = at;
    const Rational mean = (value + EntryAt(problem.A, j, i)) / 2;
    if (mean != 0) sum[{i, j}] = sum[{j, i}] = mean;
  }
  problem.A = std::move(sum);
  problem.origin["symmetrized"] = {
      {"largest difference", ToString(largest.difference)}, {"i", largest.i}, {"j", largest.j}};
}

}  // namespace stiction
