// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/by_factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "corpus/json.h"

namespace stiction {
namespace {

constexpr const char* kPlace = "witness.factors";

// The text, strictly. The first fault is told.
FactorParts ReadParts(const ExactProblem& problem, const Json& json) {
  const std::string source = "certificate";
  Faults faults(source);
  const JsonPlace place(json, source, kPlace);
  place.RequireObject();
  FactorParts parts = ReadFactorParts(place, problem.rows(), true, faults);
  faults.Throw();
  if (json["J"]["size"][1] != parts.w.size())
    throw Rejected{"witness.factors.J.size", Shown(json["J"]["size"]), "as many columns as M has"};
  return parts;
}

// Rows of J that have an entry in a block of M, ascending.
std::vector<std::vector<int>> RowsOfBlocks(const FactorParts& parts) {
  std::vector<int> block_of;  // by velocity
  for (std::size_t k = 0; k < parts.M.size(); ++k)
    block_of.insert(block_of.end(), parts.M[k].rows(), static_cast<int>(k));
  std::vector<std::vector<int>> rows(parts.M.size());
  for (const auto& [at, value] : parts.J) {
    auto& list = rows[block_of[at.second]];
    if (list.empty() || list.back() != at.first) list.push_back(at.first);
  }
  return rows;
}

// What certificates.md says of it, before anything is computed.
void RequireCheap(const ExactProblem& problem, const FactorParts& parts) {
  const auto rows_of = RowsOfBlocks(parts);
  double operations = ProductOperations(problem, 1);
  for (std::size_t k = 0; k < parts.M.size(); ++k) {
    const double s = static_cast<double>(parts.M[k].rows()), t = static_cast<double>(rows_of[k].size());
    operations += s * (s + t) * (s + t);
  }
  Cost cost(operations);
  cost.LongestRow(problem).Vector(parts.w).Vector(parts.c);
  std::vector<std::int64_t> bits(problem.rows(), 0);  // of the blocks that a row of J has entries in
  for (std::size_t k = 0; k < parts.M.size(); ++k) {
    std::int64_t of_block = 0;
    for (int i = 0; i < parts.M[k].rows(); ++i) {
      const ExactVector row = parts.M[k].row(i).transpose();
      of_block = std::min(of_block + cost.BitsOf(row), cost.most() + 1);
    }
    for (const int i : rows_of[k]) bits[i] = std::min(bits[i] + of_block, cost.most() + 1);
  }
  std::int64_t longest = 0;  // row of J
  auto at = parts.J.begin();
  for (int i = 0; i < problem.rows(); ++i) {
    std::vector<Rational> row;
    for (; at != parts.J.end() && at->first.first == i; ++at) row.push_back(at->second);
    const ExactVector numbers = Eigen::Map<ExactVector>(row.data(), static_cast<Eigen::Index>(row.size()));
    longest = std::max(longest, cost.BitsOf(numbers));
  }
  cost.AddBits(2 * longest).AddBits(bits.empty() ? 0 : *std::max_element(bits.begin(), bits.end()));
}

}  // namespace

Json FactorsWitness(const ExactFactors& factors) { return {{"factors", ToJson(factors)}}; }

bool HasFactors(const Json& witness) { return witness.is_object() && witness.contains("factors"); }

ExactVector RequireFactorsOfProblem(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"factors"});
  FactorParts parts = ReadParts(problem, witness["factors"]);
  RequireCheap(problem, parts);
  const auto factors = MakeFactors(problem.dimension, problem.contacts, std::move(parts));
  if (!factors) throw Rejected{"witness.factors.M", "a block that is not definite", "a positive definite one"};
  const ExactProblem stated = ToDense(*factors);
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j)
      RequireEqual(stated.A(i, j), problem.A(i, j), fmt::format("(J inv(M) J')[{}][{}]", i, j));
    RequireEqual(stated.b[i], problem.b[i], fmt::format("(J w + c)[{}]", i));
  }
  return factors->c;
}

}  // namespace stiction
