// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/condense.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "corpus/record/definite_block.h"

namespace stiction {
namespace {

constexpr Eigen::Index kMostBlock = 24;  // rows of a block whose inverse is kept

// By the factors; empty where M has none that are kept.
std::optional<ExactFactors> FactorsOf(const GlobalEquations& equations, int dimension,
                                      const std::vector<Contact<Rational>>& contacts) {
  const auto velocities = equations.f.size();
  FactorParts parts{{}, BlocksOf(ToEigen(equations.M, velocities, velocities)), equations.f, equations.w};
  const bool fits = std::all_of(parts.M.begin(), parts.M.end(), [](const ExactProblem::Matrix& block) {
    return block.rows() <= kMostBlock && block == block.transpose();
  });
  if (!fits) return std::nullopt;
  int at = 0;
  for (const ExactProblem::Matrix& block : parts.M) {
    const auto inverse = InverseOfDefinite(block);
    if (!inverse) return std::nullopt;
    const ExactProblem::Vector force = parts.w.segment(at, block.rows());
    parts.w.segment(at, block.rows()) = *inverse * force;
    at += static_cast<int>(block.rows());
  }
  for (const auto& [place, value] : equations.B) parts.J.emplace(std::pair(place.second, place.first), value);
  return MakeFactors(dimension, contacts, std::move(parts));
}

using SparseRow = std::map<int, Rational>;

// Makes the first `count` columns of all later rows zero, by the diagonal pivots of the first rows. The row
// whose pivot is zero, if one is.
std::optional<int> Eliminate(std::vector<SparseRow>& K, int count) {
  std::vector<std::set<int>> below(count);  // rows below the diagonal, by column
  for (int i = 0; i < static_cast<int>(K.size()); ++i) {
    std::erase_if(K[i], [](const auto& entry) { return entry.second == 0; });
    for (const auto& [j, value] : K[i]) {
      if (j < std::min(i, count)) below[j].insert(i);
    }
  }
  for (int k = 0; k < count; ++k) {
    const auto pivot = K[k].find(k);
    if (pivot == K[k].end()) return k;
    for (const int i : below[k]) {
      const auto entry = K[i].find(k);
      if (entry == K[i].end()) continue;
      const Rational factor = entry->second / pivot->second;
      for (auto at = std::next(pivot); at != K[k].end(); ++at) {
        Rational& value = K[i][at->first];
        value -= factor * at->second;
        if (at->first < std::min(i, count)) below[at->first].insert(i);
        if (value == 0) K[i].erase(at->first);
      }
      K[i].erase(k);
    }
  }
  return std::nullopt;
}

}  // namespace

std::variant<AnyProblem, int> Condense(const GlobalEquations& equations, int dimension,
                                       std::vector<Contact<Rational>> contacts, ProblemFile& file) {
  if (auto factors = FactorsOf(equations, dimension, contacts)) {
    file.origin.Add({{"factors", "J = B', M, w = inv(M) f, c = w, of M v = B r + f, u = B'v + w"}});
    return AnyProblem(*std::move(factors));
  }
  // Elimination of v from [M, -B, -f; B', 0, w].
  const int first = static_cast<int>(equations.f.size()), rows = static_cast<int>(equations.w.size()),
            last = first + rows;
  std::vector<SparseRow> K(last);
  for (const auto& [at, value] : equations.M) K[at.first][at.second] = value;
  for (const auto& [at, value] : equations.B) {
    K[at.first][first + at.second] = -value;
    K[first + at.second][at.first] = value;
  }
  for (int i = 0; i < first; ++i) K[i][last] = -equations.f[i];
  if (const auto row = Eliminate(K, first)) return *row;
  SparseMatrix A;
  ExactProblem::Vector b = equations.w;
  for (int i = 0; i < rows; ++i) {
    for (const auto& [j, value] : K[first + i]) {
      if (j == last) b[i] += value;
      if (first <= j && j < last) A[{i, j - first}] = value;
    }
  }
  file.origin.Add({{"condensed", "A = B' inv(M) B, over rationals"}});
  return AnyProblem(ExactEntries{dimension, std::move(contacts), ToEigen(A, rows, rows), std::move(b)});
}

}  // namespace stiction
