// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <tuple>
#include <utility>

#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Block = ExactProblem::Matrix;
using Entries = std::vector<Eigen::Triplet<Rational>>;
using ExactSparse = Eigen::SparseMatrix<Rational>;

Block ZeroBlock(int size) { return Block::Constant(size, size, Rational(0)); }

void AddBlock(const Block& block, int at, Entries& entries) {
  for (int i = 0; i < block.rows(); ++i) {
    for (int j = 0; j < block.cols(); ++j)
      if (block(i, j) != 0) entries.emplace_back(at + i, at + j, block(i, j));
  }
}

// ---- Reading ----

constexpr const char* kJExpected = R"({"size": [rows, velocities], "entries"}, or an array of rows)";
constexpr const char* kBlockExpected = "a block of M: a number, or rows of numbers";

ExactProblem::Vector ReadNumbers(const JsonPlace& place, int count, bool strict, const char* of) {
  const std::string expected = fmt::format("{} numbers, one for each {}", count, of);
  const std::size_t size = place.Size("an array of " + expected);
  if (size != static_cast<std::size_t>(count)) place.Refuse(fmt::format("{} numbers", size), expected);
  ExactProblem::Vector numbers(count);
  for (int i = 0; i < count; ++i) numbers[i] = ExactNumber(place[i], strict);
  return numbers;
}

// J, and how many velocities it has.
std::pair<SparseMatrix, int> ReadJacobian(const JsonPlace& place, int rows, bool strict) {
  const std::string of_contacts = fmt::format("{}, the rows of the contacts", rows);
  SparseMatrix J;
  int velocities = 0;
  if (place.json().is_object()) {
    place.AllowKeys({"size", "entries"});
    const JsonPlace size = place.Required("size", "[rows, velocities]");
    if (size.Size("[rows, velocities]") != 2) size.Refuse("[rows, velocities]");
    size[0].Integer(rows, rows, of_contacts);
    velocities = static_cast<int>(size[1].Integer(0, INT_MAX, "a number of velocities >= 0"));
    J = ReadEntries(place.Required("entries", "an array of entries [i, j, value]"), rows, velocities, strict);
    std::erase_if(J, [](const auto& entry) { return entry.second == 0; });
    return {std::move(J), velocities};
  }
  if (strict || !place.json().is_array()) place.Refuse(kJExpected);
  if (place.Size(kJExpected) != static_cast<std::size_t>(rows))
    place.Refuse(fmt::format("{} rows", place.json().size()), of_contacts);
  for (int i = 0; i < rows; ++i) {
    if (i == 0) velocities = static_cast<int>(place[i].Size("an array of numbers"));
    const ExactProblem::Vector row = ReadNumbers(place[i], velocities, strict, "velocity, as in the first row");
    for (int j = 0; j < velocities; ++j)
      if (row[j] != 0) J.emplace(std::pair(i, j), row[j]);
  }
  return {std::move(J), velocities};
}

Block ReadBlock(const JsonPlace& place, bool strict) {
  if (place.json().is_object()) place.Refuse(kBlockExpected);
  if (!place.json().is_array()) return Block::Constant(1, 1, ExactNumber(place, strict));
  const int size = static_cast<int>(place.json().size());
  if (size == 0) place.Refuse(kBlockExpected);
  Block block(size, size);
  for (int i = 0; i < size; ++i)
    block.row(i) = ReadNumbers(place[i], size, strict, "row of the block").transpose();
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < i; ++j) {
      if (block(i, j) != block(j, i))
        place.Refuse(fmt::format("entries ({0}, {1}) and ({1}, {0}) that differ", j, i), "a symmetric block");
    }
  }
  return block;
}

int SizeOf(const std::vector<Block>& blocks) {
  int size = 0;
  for (const Block& block : blocks) size += static_cast<int>(block.rows());
  return size;
}

ExactSparse BlockDiagonal(const std::vector<Block>& blocks) {
  Entries entries;
  int at = 0;
  for (const Block& block : blocks) {
    AddBlock(block, at, entries);
    at += static_cast<int>(block.rows());
  }
  ExactSparse matrix(at, at);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

ExactFactors FromParts(int dimension, std::vector<Contact<Rational>> contacts, FactorParts parts,
                       const std::vector<Block>& inverses) {
  Entries entries;
  for (const auto& [at, value] : parts.J) entries.emplace_back(at.first, at.second, value);
  ExactFactors::Matrix::Rows J(parts.c.size(), parts.w.size());
  J.setFromTriplets(entries.begin(), entries.end());
  ExactFactors problem;
  problem.dimension = dimension;
  problem.contacts = std::move(contacts);
  problem.A = {std::move(J), BlockDiagonal(inverses)};
  problem.M = BlockDiagonal(parts.M);
  problem.b = parts.c;
  for (const auto& [at, value] : parts.J) problem.b[at.first] += value * parts.w[at.second];
  problem.w = std::move(parts.w);
  problem.c = std::move(parts.c);
  return problem;
}

template <class Numbers>
Json ExactNumbers(const Numbers& numbers) {
  Json json = Json::array();
  for (int i = 0; i < numbers.size(); ++i) json.push_back(ToString(numbers(i)));
  return json;
}

}  // namespace

// [M | I] becomes [I | W] without exchanges of rows; M is definite if all pivots are > 0.
std::optional<ExactProblem::Matrix> InverseOfDefinite(const ExactProblem::Matrix& M) {
  const int size = static_cast<int>(M.rows());
  Block rest = M, W = ZeroBlock(size);
  for (int i = 0; i < size; ++i) W(i, i) = 1;
  for (int k = 0; k < size; ++k) {
    const Rational pivot = rest(k, k);
    if (pivot <= 0) return std::nullopt;
    for (int j = 0; j < size; ++j) {
      rest(k, j) /= pivot;
      W(k, j) /= pivot;
    }
    for (int i = 0; i < size; ++i) {
      const Rational factor = rest(i, k);
      if (i == k || factor == 0) continue;
      for (int j = 0; j < size; ++j) {
        rest(i, j) -= factor * rest(k, j);
        W(i, j) -= factor * W(k, j);
      }
    }
  }
  return W;
}

std::vector<ExactProblem::Matrix> BlocksOf(const Eigen::SparseMatrix<Rational>& M) {
  const int size = static_cast<int>(M.cols());
  std::vector<int> last(size);  // of the rows and columns that an entry couples with this one
  for (int k = 0; k < size; ++k) last[k] = k;
  for (int k = 0; k < size; ++k) {
    for (ExactSparse::InnerIterator of(M, k); of; ++of) {
      if (of.value() == 0) continue;
      const int other = static_cast<int>(of.row()), low = std::min(k, other);
      last[low] = std::max({last[low], k, other});
    }
  }
  std::vector<Block> blocks;
  for (int begin = 0, end = 0; begin < size; begin = end) {
    end = last[begin] + 1;
    for (int k = begin; k < end; ++k) end = std::max(end, last[k] + 1);
    Block block = ZeroBlock(end - begin);
    for (int k = begin; k < end; ++k) {
      for (ExactSparse::InnerIterator of(M, k); of; ++of)
        if (of.value() != 0) block(of.row() - begin, k - begin) = of.value();
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::optional<ExactFactors> MakeFactors(int dimension, std::vector<Contact<Rational>> contacts,
                                        FactorParts parts) {
  std::vector<Block> inverses;
  for (const Block& block : parts.M) {
    auto inverse = InverseOfDefinite(block);
    if (!inverse) return std::nullopt;
    inverses.push_back(*std::move(inverse));
  }
  return FromParts(dimension, std::move(contacts), std::move(parts), inverses);
}

int RowsOfFactors(const JsonPlace& place) {
  const Json& factors = place.json();
  const Json J = factors.is_object() ? factors.value("J", Json()) : Json();
  if (J.is_array()) return static_cast<int>(J.size());
  const Json size = J.is_object() ? J.value("size", Json()) : Json();
  const bool tells = size.is_array() && size.size() == 2 && size[0].is_number_unsigned() && size[0] <= INT_MAX;
  return tells ? size[0].get<int>() : -1;
}

FactorParts ReadFactorParts(const JsonPlace& place, int rows, bool strict, Faults& faults) {
  FactorParts parts;
  parts.c = ExactProblem::Vector::Constant(std::max(rows, 0), Rational(0));
  int columns = -1;  // of J
  faults.Try([&] { place.AllowKeys({"J", "M", "w", "c"}); });
  faults.Try([&] {
    const JsonPlace J = place.Required("J", kJExpected);
    if (rows >= 0) std::tie(parts.J, columns) = ReadJacobian(J, rows, strict);
  });
  Faults of_masses(place.source());
  of_masses.Try([&] {
    const JsonPlace M = place.Required("M", "an array of blocks");
    for (std::size_t k = 0; k < M.Size("an array of blocks"); ++k)
      of_masses.Try([&] { parts.M.push_back(ReadBlock(M[k], strict)); });
    const int size = SizeOf(parts.M);
    if (of_masses.empty() && rows > 0 && columns >= 0 && size != columns)
      M.Refuse(fmt::format("blocks of {} velocities", size), fmt::format("{}, the columns of J", columns));
  });
  faults.Take(of_masses);
  faults.Try([&] {
    const JsonPlace w = place.Required("w", "an array of numbers, one for each velocity");
    if (of_masses.empty()) parts.w = ReadNumbers(w, SizeOf(parts.M), strict, "velocity");
  });
  faults.Try([&] {
    const auto c = place.Optional("c");
    if (c && rows >= 0) parts.c = ReadNumbers(*c, rows, strict, "row");
  });
  return parts;
}

std::optional<ExactFactors> ReadFactors(const JsonPlace& place, int dimension,
                                        const std::vector<Contact<Rational>>& contacts, int rows,
                                        Faults& faults) {
  Faults own(place.source());
  FactorParts parts;
  std::vector<Block> inverses;
  own.Try([&] {
    place.RequireObject();
    parts = ReadFactorParts(place, rows, false, own);
  });
  const bool is_read = own.empty() && rows >= 0;
  for (std::size_t k = 0; is_read && k < parts.M.size(); ++k) {
    own.Try([&] {
      auto inverse = InverseOfDefinite(parts.M[k]);
      const JsonPlace M = place.Required("M", "an array of blocks");
      if (!inverse) M[k].Refuse("a block that is not positive definite", "a positive definite block of masses");
      inverses.push_back(*std::move(inverse));
    });
  }
  faults.Take(own);
  if (!own.empty() || rows < 0) return std::nullopt;
  return FromParts(dimension, contacts, std::move(parts), inverses);
}

Json ToJson(const ExactFactors& factors) {
  const auto& J = factors.A.J();
  Json entries = Json::array(), blocks = Json::array();
  for (int i = 0; i < J.rows(); ++i) {
    for (ExactFactors::Matrix::Rows::InnerIterator of(J, i); of; ++of)
      if (of.value() != 0) entries.push_back(Json::array({i, of.col(), ToString(of.value())}));
  }
  for (const Block& block : BlocksOf(factors.M)) {
    Json rows = Json::array();
    for (int i = 0; i < block.rows(); ++i) rows.push_back(ExactNumbers(block.row(i)));
    blocks.push_back(block.size() == 1 ? rows[0][0] : rows);
  }
  Json json = {{"J", {{"size", {J.rows(), J.cols()}}, {"entries", std::move(entries)}}},
               {"M", std::move(blocks)},
               {"w", ExactNumbers(factors.w)}};
  if (!IsInRangeByFactors(factors)) json["c"] = ExactNumbers(factors.c);
  return json;
}

bool IsInRangeByFactors(const ExactFactors& factors) { return (factors.c.array() == Rational(0)).all(); }

SparseMatrix FormA(const ExactFactors& factors) {
  SparseMatrix A;
  ForEachEntry(factors.A, [&A](int i, int j, const Rational& value) {
    if (value != 0) A.emplace(std::pair(i, j), value);
  });
  return A;
}

ExactProblem ToDense(const ExactFactors& factors) {
  const int rows = factors.rows();
  STICTION_CHECK(rows <= kMostDenseRows, "too many rows for a dense matrix");
  ExactProblem problem{factors.dimension, factors.contacts, Block::Constant(rows, rows, Rational(0)),
                       factors.b};
  ForEachEntry(factors.A, [&problem](int i, int j, const Rational& value) { problem.A(i, j) = value; });
  return problem;
}

FactoredProblem<double> InDoubles(const ExactFactors& factors) {
  FactoredProblem<double> rounded;
  rounded.dimension = factors.dimension;
  for (const Contact<Rational>& contact : factors.contacts)
    rounded.contacts.push_back(
        {contact.kind, ToDouble(contact.mu), {ToDouble(contact.slip[0]), ToDouble(contact.slip[1])}});
  rounded.A = {factors.A.J().unaryExpr(&ToDouble), factors.A.W().unaryExpr(&ToDouble)};
  rounded.M = factors.M.unaryExpr(&ToDouble);
  rounded.w = factors.w.unaryExpr(&ToDouble);
  rounded.c = factors.c.unaryExpr(&ToDouble);
  rounded.b = factors.b.unaryExpr(&ToDouble);
  return rounded;
}

}  // namespace stiction
