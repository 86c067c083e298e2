// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";

// Words of a text, one after the other, and the line that the last one stands in.
class Words {
 public:
  Words(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  [[noreturn]] void Refuse(const std::string& found, const std::string& expected) const {
    throw InputError(source_, fmt::format("line {}", line_), found, expected);
  }

  // The next word, without a comma at its end; empty at the end of the text.
  std::string_view Next() {
    while (at_ < text_.size() && kSpace.find(text_[at_]) != kSpace.npos) line_ += text_[at_++] == '\n';
    const std::size_t end = std::min(text_.find_first_of(kSpace, at_), text_.size());
    std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    if (word.ends_with(',')) word.remove_suffix(1);
    return word;
  }

  std::string_view Some(const std::string& expected) {
    const std::string_view word = Next();
    if (word.empty()) Refuse("the end of the file", expected);
    return word;
  }

  void Expect(std::string_view expected) {
    const std::string_view word = Some(fmt::format("'{}'", expected));
    if (word != expected) Refuse(Quoted(word), fmt::format("'{}'", expected));
  }

  void SkipLine() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  // How many there are of something; each takes a character at least.
  int Count(const std::string& what) {
    return Integer(what, 0, static_cast<int>(std::min<std::size_t>(text_.size(), kMost)));
  }

  // An integer from `least` to `most`.
  int Integer(const std::string& what, int least, int most) {
    const std::string expected = least == most ? fmt::format("{}, {}", least, what)
                                               : fmt::format("{}, from {} to {}", what, least, most);
    const std::string_view word = Some(expected);
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < least || value > most) {
      Refuse(Quoted(word), expected);
    }
    return value;
  }

  // The nearest double, exactly.
  Rational Number(const std::string& what) {
    const std::string_view word = Some(what);
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
      Refuse(Quoted(word), what + ", a number in the range of doubles");
    }
    return Rational(value);
  }

  static std::string Quoted(std::string_view word) { return fmt::format("'{}'", Shortened(std::string(word))); }

 private:
  static constexpr std::size_t kMost = 100'000'000;

  std::string_view text_;
  const std::string& source_;
  std::size_t at_ = 0;
  int line_ = 1;
};

// ---- Reading ---------------------------------------------------------------------------------

class MatrixReader {
 public:
  MatrixReader(Words& words, int rows) : words_(words), rows_(rows) {}

  SparseMatrix Read() {
    const int type = words_.Integer("the storage type of the matrix (0 dense, 1 blocks, 2 csparse)", 0, 2);
    Sizes();
    if (type == 0) Dense();
    if (type == 1) Blocks();
    if (type == 2) CSparse();
    return std::move(A_);
  }

  const char* storage() const { return storage_; }

 private:
  void Sizes() {
    words_.Integer("the rows of the matrix", rows_, rows_);
    words_.Integer("the columns of the matrix", rows_, rows_);
  }

  // Entries that are listed more than once add up, as CSparse has it.
  void Add(int i, int j, const Rational& value) {
    if (value != 0) A_[{i, j}] += value;
  }

  void Dense() {
    storage_ = "dense";
    Sizes();
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < rows_; ++i) Add(i, j, words_.Number(fmt::format("entry ({}, {})", i, j)));
    }
  }

  // Ends of block rows or columns: increasing, the last one is the size of the matrix.
  std::vector<int> Ends(int count, const char* what) {
    std::vector<int> ends;
    for (int k = 0; k < count; ++k) {
      const int least = k == count - 1 ? rows_ : (ends.empty() ? 1 : ends.back() + 1);
      ends.push_back(words_.Integer(fmt::format("the end of block {} {}", what, k), least, rows_));
    }
    return ends;
  }

  void Blocks() {
    storage_ = "blocks";
    const int blocks = words_.Count("the number of blocks");
    if (blocks == 0) return;
    const int block_rows = words_.Integer("the number of block rows", 1, rows_);
    const int block_columns = words_.Integer("the number of block columns", 1, rows_);
    const std::vector<int> row_ends = Ends(block_rows, "row"), column_ends = Ends(block_columns, "column");
    words_.Integer("the number of row pointers", block_rows + 1, block_rows + 1);
    words_.Integer("the number of blocks", blocks, blocks);
    std::vector<int> pointers;
    for (int k = 0; k <= block_rows; ++k) {
      const int least = k == block_rows ? blocks : pointers.empty() ? 0 : pointers.back();
      const int most = k == 0 ? 0 : blocks;
      pointers.push_back(words_.Integer(fmt::format("row pointer {}", k), least, most));
    }
    std::vector<int> columns;
    for (int k = 0; k < blocks; ++k) {
      columns.push_back(words_.Integer(fmt::format("the block column of block {}", k), 0, block_columns - 1));
    }
    for (int row = 0; row < block_rows; ++row) {
      for (int k = pointers[row]; k < pointers[row + 1]; ++k) {
        words_.Integer("the number of the block", k, k);
        OneBlock(row_ends, row, column_ends, columns[k]);
      }
    }
  }

  void OneBlock(const std::vector<int>& row_ends, int row, const std::vector<int>& column_ends, int column) {
    const int first_row = row == 0 ? 0 : row_ends[row - 1];
    const int first_column = column == 0 ? 0 : column_ends[column - 1];
    for (int j = first_column; j < column_ends[column]; ++j) {
      for (int i = first_row; i < row_ends[row]; ++i) {
        Add(i, j, words_.Number(fmt::format("entry ({}, {})", i, j)));
      }
    }
  }

  void CSparse() {
    const int form = words_.Integer("the form of the matrix (1 triplet, 2 compressed columns)", 1, 2);
    words_.Expect("CSparse");
    words_.SkipLine();
    if (form == 1) words_.Expect("triplet:");
    words_.Expect(fmt::format("{}-by-{}", rows_, rows_));
    words_.Expect("nzmax:");
    words_.Some("the room for entries");
    words_.Expect("nnz:");
    const int entries = words_.Count("the number of entries");
    if (form == 1) {
      Triplets(entries);
    } else {
      words_.Expect("1-norm:");
      words_.Some("the norm");
      Columns(entries);
    }
  }

  int Index(const char* what) { return words_.Integer(what, 0, rows_ - 1); }

  void Triplets(int entries) {
    storage_ = "csparse triplet";
    for (int k = 0; k < entries; ++k) {
      const int i = Index("a row"), j = Index("a column");
      words_.Expect(":");
      Add(i, j, words_.Number(fmt::format("entry ({}, {})", i, j)));
    }
  }

  void Columns(int entries) {
    storage_ = "csparse columns";
    int next = 0;
    for (int j = 0; j < rows_; ++j) {
      words_.Expect("col");
      words_.Integer("the column", j, j);
      words_.Expect(":");
      words_.Expect("locations");
      words_.Integer("the first location of the column", next, next);
      words_.Expect("to");
      const int least = j == rows_ - 1 ? entries - 1 : next - 1;
      const int last = words_.Integer("the last location of the column", least, entries - 1);
      for (; next <= last; ++next) {
        const int i = Index("a row");
        words_.Expect(":");
        Add(i, j, words_.Number(fmt::format("entry ({}, {})", i, j)));
      }
    }
  }

  Words& words_;
  int rows_;
  SparseMatrix A_;
  const char* storage_ = "";
};

// Contacts of a friction problem, or of an LCP; friction coefficients are read later.
int ReadHeader(Words& words, SiconosKind kind, SparseProblem& problem) {
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

}  // namespace

// Only an LCP of n = 2 in blocks and one planar contact in csparse begin alike, and differ in the word CSparse.
SiconosKind SiconosKindOf(const std::string& text, const std::string& source) {
  Words words(text, source);
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
  throw InputError(
      source, "line 1", "neither of them",
      "an LCP (n, storage type, n, n, ...) or a friction problem (dimension, contacts, storage type, "
      "rows, columns, ...); --format says what it should be");
}

SparseProblem ParseSiconos(const std::string& text, SiconosKind kind, const std::string& source) {
  Words words(text, source);
  SparseProblem problem;
  const int rows = ReadHeader(words, kind, problem);
  MatrixReader matrix(words, rows);
  problem.A = matrix.Read();
  std::erase_if(problem.A, [](const auto& entry) { return entry.second == 0; });
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) problem.b[i] = words.Number(fmt::format("q[{}]", i));
  if (kind == SiconosKind::kFriction) {
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
      const std::string what = fmt::format("mu[{}], a number >= 0", i);
      Rational& mu = problem.contacts[i].mu = words.Number(what);
      if (mu < 0) words.Refuse(ToString(mu), what);
    }
  }
  problem.origin = {{"format", kind == SiconosKind::kLcp ? "siconos-lcp" : "siconos-fc"},
                    {"storage", matrix.storage()}};
  return problem;
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
  MatrixWriter(const SparseProblem& problem, int block) : A_(problem.A), rows_(problem.rows()), block_(block) {
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

  const SparseMatrix& A_;
  int rows_, block_;
  std::map<std::pair<int, int>, std::string> columns_;  // by (column, row)
  std::string out_;
};

}  // namespace

std::string PrintSiconos(const SparseProblem& problem, SiconosKind kind, SiconosStorage storage) {
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
