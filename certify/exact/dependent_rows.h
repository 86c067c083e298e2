// SPDX-License-Identifier: Apache-2.0
// Rows of (A b) that follow from others, told over rationals, and remembered.

#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/properties.h"
#include "corpus/exact_problem.h"
#include "solver/linear/direction.h"

namespace stiction {

// Of one problem, which must outlive it. Cost of a new question: a system of `zero` unknowns.
class ExactDependentRows final : public DependentRows {
 public:
  explicit ExactDependentRows(const ExactProblem& problem) : problem_(problem) {}

  bool Follows(const std::vector<bool>& zero, int row) override;
  // The direction of these sets.
  using System = DirectionSystem<Rational, Eigen::Dynamic>;
  System::Status SolveDirection(const std::vector<IndexSet>& sets, int driven, int sign);
  const System& direction() const { return direction_; }

 private:
  using Integers = Eigen::Matrix<Elimination<Rational>::Entry, Eigen::Dynamic, Eigen::Dynamic>;

  bool IsCombination(const std::vector<bool>& zero, int row);
  void ScaleToIntegers();

  const ExactProblem& problem_;
  Integers integers_;  // (A b), each row scaled; from the first question on
  Elimination<Rational> system_;
  std::optional<RowLayout<Eigen::Dynamic>> layout_;  // from the first direction on
  System direction_;
  std::map<std::pair<std::vector<bool>, int>, bool> known_;
};

// Of the rows of M that are listed, the first that follow from none before are kept; of each other, by row,
// how it follows: weights of those that are kept, in the order of rows.
std::map<int, ExactVector> WeightsOfDependent(const ExactMatrix& M, const std::vector<int>& listed);

}  // namespace stiction
