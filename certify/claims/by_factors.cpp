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

// Operations of a product, of velocities and of entries of J.
double OperationsOf(const ExactProblem& problem, double velocities, double entries) {
  return ProductOperations(problem.rows(), 1) + 15 * velocities + 6 * entries;
}

// Before any number is read: a row touches each block of M, with an entry of J of its own.
void RequireFewVelocities(const ExactProblem& problem, const Json& json) {
  if (!json.is_object() || !json.contains("J")) return;  // refused where it is read
  const Json& J = json["J"];
  if (!J.is_object() || !J.contains("size") || !J.contains("entries")) return;
  const Json &size = J["size"], &entries = J["entries"];
  if (!size.is_array() || size.size() != 2 || !size[1].is_number_unsigned() || !entries.is_array()) return;
  if (!json.contains("M") || !json["M"].is_array()) return;
  if (json["M"].size() > entries.size())
    throw Rejected{"witness.factors.M", fmt::format("{} blocks", json["M"].size()),
                   fmt::format("at most {}, the entries of J", entries.size())};
  Cost(OperationsOf(problem, size[1].get<double>(), static_cast<double>(entries.size())));
}

// Of every block of M, whether a row has an entry in it.
void RequireTouchedBlocks(const FactorParts& parts) {
  const auto rows_of = RowsOfBlocks(parts);
  const auto untouched = std::ranges::find_if(rows_of, [](const auto& rows) { return rows.empty(); });
  if (untouched == rows_of.end()) return;
  throw Rejected{ElementPath("witness.factors.M", static_cast<std::size_t>(untouched - rows_of.begin())),
                 "a block that no row of J touches", "none"};
}

// What certificates.md says of it, before anything is computed.
void RequireCheap(const ExactProblem& problem, const FactorParts& parts) {
  const auto rows_of = RowsOfBlocks(parts);
  double operations =
      OperationsOf(problem, static_cast<double>(parts.w.size()), static_cast<double>(parts.J.size()));
  for (std::size_t k = 0; k < parts.M.size(); ++k) {
    const double s = static_cast<double>(parts.M[k].rows()), t = static_cast<double>(rows_of[k].size());
    operations += 20 + 2 * s * (s + t) * (s + t) + 4 * t * t;
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

// Without the blocks of M that no row touches: nothing depends on these.
Json FactorsWitness(const ExactFactors& factors) {
  const Json all = ToJson(factors);
  std::set<int> touched;
  for (const Json& entry : all["J"]["entries"]) touched.insert(entry[1].get<int>());
  std::vector<int> number;  // that a velocity gets; -1 where it is left out
  Json M = Json::array(), w = Json::array(), entries = Json::array();
  for (const Json& block : all["M"]) {
    const int first = static_cast<int>(number.size());
    const int end = first + (block.is_array() ? static_cast<int>(block.size()) : 1);
    const auto next = touched.lower_bound(first);
    const bool keeps = next != touched.end() && *next < end;
    if (keeps) M.push_back(block);
    for (int j = first; j < end; ++j) {
      number.push_back(keeps ? static_cast<int>(w.size()) : -1);
      if (keeps) w.push_back(all["w"][j]);
    }
  }
  for (const Json& entry : all["J"]["entries"])
    entries.push_back(Json::array({entry[0], number[entry[1].get<int>()], entry[2]}));
  Json kept = {{"J", {{"size", {all["J"]["size"][0], w.size()}}, {"entries", std::move(entries)}}},
               {"M", std::move(M)},
               {"w", std::move(w)}};
  if (all.contains("c")) kept["c"] = all["c"];
  return {{"factors", std::move(kept)}};
}

bool HasFactors(const Json& witness) { return witness.is_object() && witness.contains("factors"); }

ExactVector RequireFactorsOfProblem(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"factors"});
  RequireFewVelocities(problem, witness["factors"]);
  FactorParts parts = ReadParts(problem, witness["factors"]);
  RequireTouchedBlocks(parts);
  RequireCheap(problem, parts);
  const auto factors = MakeFactors(problem.dimension, problem.contacts, std::move(parts));
  if (!factors) throw Rejected{"witness.factors.M", "a block that is not definite", "a positive definite one"};
  const ExactProblem stated = DenseOf(*factors);
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = 0; j < problem.rows(); ++j)
      RequireEqual(stated.A(i, j), problem.A(i, j), fmt::format("(J inv(M) J')[{}][{}]", i, j));
    RequireEqual(stated.b[i], problem.b[i], fmt::format("(J w + c)[{}]", i));
  }
  return factors->c;
}

}  // namespace stiction
