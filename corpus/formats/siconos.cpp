// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "corpus/formats/siconos_kinds.h"
#include "corpus/formats/siconos_words.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// ---- Reading ---------------------------------------------------------------------------------

constexpr const char* kReadKinds =
    "an LCP (n, storage type, n, n, ...) or a local friction problem (dimension 2 or 3, contacts, storage "
    "type, "
    "rows, columns, ...)";

// Contacts of a friction problem, or of an LCP; friction coefficients are read later.
int ReadHeader(SiconosWords& words, SiconosKind kind, ExactEntries& problem) {
  if (kind == SiconosKind::kLcp) {
    const int rows = words.Count("the size of the LCP");
    problem.contacts.assign(rows, {ContactKind::kFrictionless, Rational(0), {}});
    return rows;
  }
  problem.dimension = words.Integer("the dimension", 2, 3);
  const int contacts = words.Count("the number of contacts");
  problem.contacts.assign(contacts, {ContactKind::kStatic, Rational(0), {}});
  return problem.dimension * contacts;
}

// Which of the two a text is by its first words, if any. Only an LCP of n = 2 in blocks and one planar contact
// in csparse begin alike, and differ in the word CSparse.
std::optional<SiconosKind> KindByFirstWords(const std::string& text, const std::string& source) {
  SiconosWords words(text, source);
  std::array<std::string_view, 7> first;
  for (std::string_view& word : first) word = words.Next();
  const auto number = [&first](int k) {
    int value = -1;
    const auto [end, error] = std::from_chars(first[k].data(), first[k].data() + first[k].size(), value);
    return error == std::errc() && end == first[k].data() + first[k].size() ? value : -1;
  };
  const auto is_type = [&](int k) {
    return number(k) == 0 || number(k) == 1 || (number(k) == 2 && first[k + 4] == "CSparse");
  };
  const int n = number(0), contacts = number(1);
  const double rows = static_cast<double>(n) * contacts;
  if ((n == 2 || n == 3) && contacts >= 0 && is_type(2) && number(3) == rows && number(4) == rows) {
    return SiconosKind::kFriction;
  }
  if (n >= 0 && is_type(1) && number(2) == n && number(3) == n) return SiconosKind::kLcp;
  return std::nullopt;
}

ProblemFile ParseAs(SiconosKind kind, const std::string& text, const std::string& source) {
  SiconosWords words(text, source);
  ExactEntries problem;
  SparseMatrix A;
  const int rows = ReadHeader(words, kind, problem);
  SiconosMatrixReader matrix(words, &A);
  matrix.Read({rows, rows});
  problem.A = ToEigen(A, rows, rows);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) problem.b[i] = Rational(words.Number(fmt::format("q[{}]", i)));
  if (kind == SiconosKind::kFriction) {
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
      const std::string what = fmt::format("mu[{}], a number >= 0", i);
      Rational& mu = problem.contacts[i].mu = Rational(words.Number(what));
      if (mu < 0) words.Refuse(ToString(mu), what);
    }
  }
  ProblemFile file;
  file.problem = std::move(problem);
  const std::string remark = words.ExpectEnd();
  file.origin.Add(
      {{"format", kind == SiconosKind::kLcp ? "siconos-lcp" : "siconos-fc"}, {"storage", matrix.storage()}});
  if (!remark.empty()) file.origin.Add({{"remark", remark}});
  return file;
}

}  // namespace

ProblemFile ParseSiconos(const std::string& text, std::optional<SiconosKind> kind, const std::string& source) {
  const bool is_asked_for = kind.has_value();
  if (!kind) kind = KindByFirstWords(text, source);
  if (!kind) {
    if (auto problem = ParseOtherSiconos(text, source)) return *std::move(problem);
    const std::string other = OtherSiconosKind(text);
    if (!other.empty()) throw InputError(source, "line 1", other, kReadKinds);
    throw InputError(source, "line 1", "numbers that are neither",
                     std::string(kReadKinds) + "; stiction import --format says what it should be");
  }
  try {
    return ParseAs(*kind, text, source);
  } catch (const InputError& error) {
    if (auto problem = is_asked_for ? std::nullopt : ParseOtherSiconos(text, source))
      return *std::move(problem);
    const std::string other = OtherSiconosKind(text);
    if (other.empty()) throw;
    throw InputError(fmt::format("{}; the file is {}, which is not read", error.what(), other));
  }
}

// ---- Writing ---------------------------------------------------------------------------------

namespace {

std::string Text(const Rational& x) {
  const double value = ToDouble(x);
  STICTION_CHECK(Rational(value) == x, "a number of a .dat file that is no double");
  return fmt::format("{}", value);
}

class MatrixWriter {
 public:
  MatrixWriter(const ExactEntries& problem, int block)
      : A_(ByRows(problem.A)), rows_(problem.rows()), block_(block) {
    for (const auto& [at, value] : A_) columns_[{at.second, at.first}] = Text(value);
  }

  std::string Print(SiconosStorage storage) {
    const int type = storage == SiconosStorage::kDense ? 0 : storage == SiconosStorage::kBlocks ? 1 : 2;
    out_ = fmt::format("{}\n{}\n{}\n", type, rows_, rows_);
    if (storage == SiconosStorage::kDense) Dense();
    if (storage == SiconosStorage::kBlocks) Blocks();
    if (storage == SiconosStorage::kTriplet) Triplets();
    if (storage == SiconosStorage::kColumns) Columns();
    return std::move(out_);
  }

 private:
  std::string_view At(int i, int j) const {
    const auto found = columns_.find({j, i});
    return found == columns_.end() ? std::string_view("0") : std::string_view(found->second);
  }

  void Dense() {
    out_ += fmt::format("{}\t{}\n", rows_, rows_);
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < rows_; ++i) out_ += fmt::format("{}{}", i == 0 ? "" : " ", At(i, j));
      out_ += '\n';
    }
  }

  // One block row and column per contact; blocks without an entry are left out.
  void Blocks() {
    std::map<std::pair<int, int>, int> blocks;
    for (const auto& [at, value] : A_) blocks[{at.first / block_, at.second / block_}] = 0;
    out_ += fmt::format("{}\n", blocks.size());
    if (blocks.empty()) return;
    const int count = rows_ / block_;
    out_ += fmt::format("{}\n{}\n", count, count);
    std::string ends, pointers = "0", columns;
    for (int k = 1; k <= count; ++k) ends += fmt::format("{}\t", k * block_);
    out_ += fmt::format("{}\n{}\n{}\n{}\n", ends, ends, count + 1, blocks.size());
    auto block = blocks.begin();
    for (int row = 0, listed = 0; row < count; ++row) {
      for (; block != blocks.end() && block->first.first == row; ++block, ++listed) {
        columns += fmt::format("{}\t", block->first.second);
      }
      pointers += fmt::format("\t{}", listed);
    }
    out_ += fmt::format("{}\n{}\n", pointers, columns);
    int number = 0;
    for (const auto& [at, unused] : blocks) {
      out_ += fmt::format("{}\n", number++);
      for (int j = 0; j < block_; ++j) {
        for (int i = 0; i < block_; ++i) {
          out_ += fmt::format("{}\n", At(at.first * block_ + i, at.second * block_ + j));
        }
      }
    }
  }

  void Triplets() {
    out_ += fmt::format("1\nCSparse Version 3 (text by stiction)\ntriplet: {}-by-{}, nzmax: {} nnz: {}\n",
                        rows_, rows_, columns_.size(), columns_.size());
    for (const auto& [at, value] : columns_)
      out_ += fmt::format("    {} {} : {}\n", at.second, at.first, value);
  }

  void Columns() {
    double norm = 0;
    std::vector<std::vector<std::pair<int, std::string>>> columns(rows_);
    std::vector<double> sums(rows_);
    for (const auto& [at, value] : columns_) columns[at.first].emplace_back(at.second, value);
    for (const auto& [at, value] : A_) norm = std::max(norm, sums[at.second] += std::abs(ToDouble(value)));
    out_ += fmt::format("2\nCSparse Version 3 (text by stiction)\n{}-by-{}, nzmax: {} nnz: {}, 1-norm: {}\n",
                        rows_, rows_, columns_.size(), columns_.size(), norm);
    std::size_t next = 0;
    for (int j = 0; j < rows_; ++j) {
      out_ += fmt::format("    col {} : locations {} to {}\n", j, next,
                          static_cast<int>(next + columns[j].size()) - 1);
      for (const auto& [i, value] : columns[j]) out_ += fmt::format("      {} : {}\n", i, value);
      next += columns[j].size();
    }
  }

  const SparseMatrix A_;
  int rows_, block_;
  std::map<std::pair<int, int>, std::string> columns_;  // by (column, row)
  std::string out_;
};

}  // namespace

std::string PrintSiconos(const ExactEntries& problem, SiconosKind kind, SiconosStorage storage) {
  const bool lcp = kind == SiconosKind::kLcp;
  for (const auto& contact : problem.contacts) {
    STICTION_CHECK(contact.kind == (lcp ? ContactKind::kFrictionless : ContactKind::kStatic),
                   "a contact that the format does not have");
  }
  std::string out = lcp ? fmt::format("{}\n", problem.rows())
                        : fmt::format("{}\n{}\n", problem.dimension, problem.contacts.size());
  out += MatrixWriter(problem, lcp ? 1 : problem.dimension).Print(storage);
  for (int i = 0; i < problem.rows(); ++i) out += fmt::format("{}{}", i == 0 ? "" : " ", Text(problem.b[i]));
  out += '\n';
  if (lcp) return out;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    out += fmt::format("{}{}", i == 0 ? "" : " ", Text(problem.contacts[i].mu));
  }
  return out + '\n';
}

}  // namespace stiction
