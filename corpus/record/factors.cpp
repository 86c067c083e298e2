// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/factors.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "corpus/record/definite_block.h"
#include "solver/problem/errors.h"

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

// J, and how many velocities it has; -1 where it does not tell.
std::pair<SparseMatrix, int> ReadJacobian(const JsonPlace& place, int rows, bool strict, Faults& faults) {
  const std::string of_contacts = fmt::format("{}, the rows of the contacts", rows);
  SparseMatrix J;
  int velocities = 0;
  if (place.json().is_object()) {
    faults.Try([&] { place.AllowKeys({"size", "entries"}); });
    const JsonPlace size = place.Required("size", "[rows, velocities]");
    if (size.Size("[rows, velocities]") != 2) size.Refuse("[rows, velocities]");
    size[0].Integer(rows, rows, of_contacts);
    velocities = static_cast<int>(size[1].Integer(0, INT_MAX, "a number of velocities >= 0"));
    J = ReadEntries(place.Required("entries", "an array of entries [i, j, value]"), rows, velocities, strict);
    std::erase_if(J, [](const auto& entry) { return entry.second == 0; });
    return {std::move(J), velocities};
  }
  if (strict || !place.json().is_array()) place.Refuse(kJExpected);
  if (rows == 0 && place.json().empty()) return {std::move(J), -1};  // whose width it does not tell
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

// inv(M), as far as it is whole, and of the other blocks J inv(M).
class Inverses {
 public:
  explicit Inverses(const FactorParts& parts) : parts_(parts), by_velocity_(parts.w.size()) {
    for (const auto& [at, value] : parts.J) by_velocity_[at.second].push_back({at.first, &value});
  }

  // Block k of M, in this order. False if it is not definite.
  bool Add(std::size_t k) {
    for (const Block& block : BlocksOf(BlockDiagonal({parts_.M[k]}))) {
      const int at = std::exchange(next_, next_ + static_cast<int>(block.rows()));
      if (!(block.rows() > kMostWholeInverse ? AddRows(block, at) : AddWhole(block, at))) return false;
    }
    return true;
  }

  ExactFactors::Matrix Of(ExactFactors::Matrix::Rows J) const {
    ExactSparse W(J.cols(), J.cols());
    W.setFromTriplets(W_.begin(), W_.end());
    ExactFactors::Matrix::Rows JW(J.rows(), J.cols());
    JW.setFromTriplets(JW_.begin(), JW_.end());
    return {std::move(J), std::move(W), JW};
  }

 private:
  struct Entry {
    int row;
    const Rational* value;
  };

  bool AddWhole(const Block& block, int at) {
    const auto inverse = InverseOfDefinite(block);
    if (inverse) AddBlock(*inverse, at, W_);
    return inverse.has_value();
  }

  // inv(M) times the rows of J that touch the block.
  bool AddRows(const Block& block, int at) {
    if (!IsDefinite(block)) return false;
    const int size = static_cast<int>(block.rows());
    std::map<int, int> column_of;  // by row of J
    for (int k = 0; k < size; ++k) {
      for (const Entry& entry : by_velocity_[at + k]) column_of.emplace(entry.row, 0);
    }
    int columns = 0;
    for (auto& [row, column] : column_of) column = columns++;
    Block J = Block::Constant(size, columns, Rational(0));
    for (int k = 0; k < size; ++k) {
      for (const Entry& entry : by_velocity_[at + k]) J(k, column_of[entry.row]) = *entry.value;
    }
    const Block X = SolveDefinite(block, J);
    for (const auto& [row, column] : column_of) {
      for (int k = 0; k < size; ++k) {
        if (X(k, column) != 0) JW_.emplace_back(row, at + k, X(k, column));
      }
    }
    return true;
  }

  const FactorParts& parts_;
  std::vector<std::vector<Entry>> by_velocity_;  // entries of J
  int next_ = 0;
  Entries W_, JW_;
};

ExactFactors FromParts(int dimension, std::vector<Contact<Rational>> contacts, const FactorParts& parts,
                       const Inverses& inverses) {
  ExactFactors::Matrix::Rows J = ToEigen(parts.J, parts.c.size(), parts.w.size());
  ExactFactors problem;
  problem.dimension = dimension;
  problem.contacts = std::move(contacts);
  problem.A = inverses.Of(std::move(J));
  problem.M = BlockDiagonal(parts.M);
  problem.w = parts.w;
  problem.b = problem.c = parts.c;
  for (const auto& [at, value] : parts.J) problem.b[at.first] += value * parts.w[at.second];
  return problem;
}

// W of doubles: the nearest doubles of what is whole, and of other blocks the inverse over doubles.
Eigen::SparseMatrix<double> InverseInDoubles(const ExactFactors& factors) {
  std::vector<Eigen::Triplet<double>> entries;
  const ExactSparse& W = factors.A.W();
  for (int k = 0; k < W.outerSize(); ++k) {
    for (ExactSparse::InnerIterator of(W, k); of; ++of) entries.emplace_back(of.row(), k, ToDouble(of.value()));
  }
  int at = 0;
  for (const Block& block : BlocksOf(factors.M)) {
    const int size = static_cast<int>(block.rows());
    if (size > kMostWholeInverse) {
      const Eigen::MatrixXd M = block.unaryExpr(&ToDouble);
      const Eigen::MatrixXd inverse =
          Eigen::LDLT<Eigen::MatrixXd>(M).solve(Eigen::MatrixXd::Identity(size, size));
      for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i)
          entries.emplace_back(at + i, at + j, (inverse(i, j) + inverse(j, i)) / 2);
      }
    }
    at += size;
  }
  Eigen::SparseMatrix<double> inverse(W.rows(), W.cols());
  inverse.setFromTriplets(entries.begin(), entries.end());
  return inverse;
}

}  // namespace

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
  Inverses inverses(parts);
  for (std::size_t k = 0; k < parts.M.size(); ++k) {
    if (!inverses.Add(k)) return std::nullopt;
  }
  return FromParts(dimension, std::move(contacts), parts, inverses);
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
    if (!J.json().is_object() && (strict || !J.json().is_array())) J.Refuse(kJExpected);
    if (rows >= 0) std::tie(parts.J, columns) = ReadJacobian(J, rows, strict, faults);
  });
  Faults of_masses(place.source());
  of_masses.Try([&] {
    const JsonPlace M = place.Required("M", "an array of blocks");
    for (std::size_t k = 0; k < M.Size("an array of blocks"); ++k)
      of_masses.Try([&] { parts.M.push_back(ReadBlock(M[k], strict)); });
    const int size = SizeOf(parts.M);
    if (of_masses.empty() && columns >= 0 && size != columns)
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
  own.Try([&] {
    place.RequireObject();
    parts = ReadFactorParts(place, rows, false, own);
  });
  if (!own.empty() || rows < 0) {
    faults.Take(own);
    return std::nullopt;
  }
  Inverses inverses(parts);
  for (std::size_t k = 0; k < parts.M.size(); ++k) {
    own.Try([&] {
      const JsonPlace M = place.Required("M", "an array of blocks");
      if (!inverses.Add(k))
        M[k].Refuse("a block that is not positive definite", "a positive definite block of masses");
    });
  }
  faults.Take(own);
  if (!own.empty()) return std::nullopt;
  return FromParts(dimension, contacts, parts, inverses);
}

Json ToJson(const ExactFactors& factors) {
  const auto& J = factors.A.J();
  Json entries = Json::array(), blocks = Json::array();
  for (int i = 0; i < J.rows(); ++i) {
    for (ExactFactors::Matrix::Rows::InnerIterator of(J, i); of; ++of)
      if (of.value() != 0) entries.push_back(Json::array({i, of.col(), ToString(of.value())}));
  }
  for (const Block& block : BlocksOf(factors.M)) {
    Json rows = RowsJson(block);
    blocks.push_back(block.size() == 1 ? rows[0][0] : rows);
  }
  Json json = {{"J", {{"size", {J.rows(), J.cols()}}, {"entries", std::move(entries)}}},
               {"M", std::move(blocks)},
               {"w", ListJson(factors.w)}};
  if (!IsInRangeByFactors(factors)) json["c"] = ListJson(factors.c);
  return json;
}

bool IsInRangeByFactors(const ExactFactors& factors) { return (factors.c.array() == Rational(0)).all(); }

FactoredProblem<double> InDoubles(const ExactFactors& factors) {
  FactoredProblem<double> rounded;
  rounded.dimension = factors.dimension;
  rounded.contacts = Converted<double>(factors.contacts, &ToDouble);
  rounded.A = {factors.A.J().unaryExpr(&ToDouble), InverseInDoubles(factors)};
  rounded.M = factors.M.unaryExpr(&ToDouble);
  rounded.w = factors.w.unaryExpr(&ToDouble);
  rounded.c = factors.c.unaryExpr(&ToDouble);
  rounded.b = factors.b.unaryExpr(&ToDouble);
  return rounded;
}

// Of n roundings each sum is off by at most 2n roundings of the same sum of abs(inv(M) J')_kj abs(J)_ik
// abs(f_j).
void AddSizes(const ExactFactors& factors, const ExactProblem::Vector& f, std::vector<Rational>& size) {
  constexpr double kTiny = 1e-250, kHuge = 1e250;
  using Rows = FactoredMatrix<double>::Rows;
  const Rows J = factors.A.J().unaryExpr(&ToDouble), JW = factors.A.JW().unaryExpr(&ToDouble);
  const Eigen::VectorXd forces = f.unaryExpr([](const Rational& x) { return std::abs(ToDouble(x)); });
  const Eigen::VectorXd all = JW.cwiseAbs() * Eigen::VectorXd(J.cwiseAbs().transpose() * forces);
  const double share = std::ldexp(static_cast<double>(J.rows() + J.cols() + 8), -51);
  const Rows A = JW * J.transpose();
  const Eigen::VectorXd sums = A.cwiseAbs() * forces - share * all;
  const auto sizes = all.array();
  bool fits = sums.allFinite() && (sizes == 0 || (sizes > kTiny && sizes < kHuge)).all();
  for (int j = 0; j < f.size(); ++j) fits = fits && (f[j] == 0 || forces[j] > kTiny);
  if (!fits) return AddSizes<ExactFactors, ExactProblem::Vector, Rational>(factors, f, size);
  for (int i = 0; i < sums.size(); ++i) size[i] += Rational(std::max(sums[i], 0.0));
}

}  // namespace stiction
