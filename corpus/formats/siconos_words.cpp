// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "corpus/printable.h"

namespace stiction {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";
constexpr std::size_t kMostInFile = 100'000'000;
constexpr std::size_t kMostBytesOfRemark = 1000;

std::string Quoted(std::string_view word) { return fmt::format("'{}'", Shortened(Printable(word))); }

// The double nearest to a word that is a number, infinite where it is too large; nothing if it is none.
std::optional<double> ParseDouble(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument) return {};
  return error == std::errc() ? value : HUGE_VAL;
}

}  // namespace

// ---- Words -----------------------------------------------------------------------------------

void SiconosWords::Refuse(const std::string& found, const std::string& expected) const {
  throw InputError(source_, fmt::format("line {}", line_), found, expected);
}

std::string_view SiconosWords::Next() {
  const int line = line_;
  while (at_ < text_.size() && kSpace.find(text_[at_]) != kSpace.npos) line_ += text_[at_++] == '\n';
  lines_passed_ = line_ - line;
  const std::size_t end = std::min(text_.find_first_of(kSpace, at_), text_.size());
  std::string_view word = text_.substr(at_, end - at_);
  at_ = end;
  if (word.ends_with(',')) word.remove_suffix(1);
  return word;
}

std::string_view SiconosWords::Some(const std::string& expected) {
  const std::string_view word = Next();
  if (word.empty()) Refuse("the end of the file", expected);
  return word;
}

void SiconosWords::Expect(std::string_view expected) {
  const std::string_view word = Some(fmt::format("'{}'", expected));
  if (word != expected) Refuse(Quoted(word), fmt::format("'{}'", expected));
}

void SiconosWords::SkipLine() { at_ = std::min(text_.find('\n', at_), text_.size()); }

int SiconosWords::Count(const std::string& what) {
  return Integer(what, 0, static_cast<int>(std::min(text_.size(), kMostInFile)));
}

int SiconosWords::Integer(const std::string& what, int least, int most) {
  const std::string expected =
      least == most ? fmt::format("{}, {}", least, what) : fmt::format("{}, from {} to {}", what, least, most);
  const std::string_view word = Some(expected);
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < least || value > most) {
    Refuse(Quoted(word), expected);
  }
  return value;
}

double SiconosWords::Number(const std::string& what) {
  const std::string_view word = Some(what);
  const std::optional<double> value = ParseDouble(word);
  if (!value || !std::isfinite(*value)) Refuse(Quoted(word), what + ", a number in the range of doubles");
  return *value;
}

void SiconosWords::SkipNumbers(int count) {
  for (int i = 0; i < count; ++i) {
    const std::string_view word = Some("a number");
    if (!ParseDouble(word)) Refuse(Quoted(word), "a number");
  }
}

std::string SiconosWords::ExpectEnd() {
  const char* expected = "the end of the file, a single 0 or 1, or a remark below an empty line";
  int numbers = 0, line = 0;
  std::string_view first, word = Next();
  for (; ParseDouble(word); word = Next()) {
    if (numbers++ > 0) continue;
    first = word;
    line = line_;
  }
  if (word == "CSparse") Refuse("another matrix", expected);
  const bool is_flag = numbers == 1 && (first == "0" || first == "1");
  if (numbers > 0 && !is_flag) {
    line_ = line;
    Refuse(fmt::format("{} number{} more, from {} on", numbers, numbers == 1 ? "" : "s", Quoted(first)),
           expected);
  }
  if (!word.empty() && lines_passed_ < 2) Refuse(fmt::format("text, from {} on", Quoted(word)), expected);
  if (word.empty()) return "";
  std::string remark;  // whitespace is one blank
  for (const char c : text_.substr(static_cast<std::size_t>(word.data() - text_.data()))) {
    const bool is_blank = std::string_view(" \t\r\n").find(c) != std::string_view::npos;
    if (!is_blank) {
      remark += c;
    } else if (!remark.empty() && remark.back() != ' ') {
      remark += ' ';
    }
  }
  if (!remark.empty() && remark.back() == ' ') remark.pop_back();
  return Shortened(Printable(remark), kMostBytesOfRemark);
}

// ---- Matrices --------------------------------------------------------------------------------

void SiconosMatrixReader::Read(SiconosSizes expected) {
  ReadHeader(expected);
  ReadEntries();
}

void SiconosMatrixReader::ReadHeader(SiconosSizes expected) {
  type_ = words_.Integer("the storage type of the matrix (0 dense, 1 blocks, 2 csparse)", 0, 2);
  const auto size = [this](const std::string& what, int expected_size) {
    return expected_size < 0 ? words_.Count(what) : words_.Integer(what, expected_size, expected_size);
  };
  rows_ = size("the rows of the matrix", expected.rows);
  columns_ = size("the columns of the matrix", expected.columns);
}

void SiconosMatrixReader::ReadEntries() {
  if (type_ == 0) Dense();
  if (type_ == 1) Blocks();
  if (type_ == 2) CSparse();
}

// Entries that are listed more than once add up, as CSparse has it.
void SiconosMatrixReader::Add(int i, int j, double value) {
  if (value != 0 && entries_ != nullptr) (*entries_)[{i, j}] += Rational(value);
}

double SiconosMatrixReader::Entry(int i, int j) {
  if (entries_ != nullptr) return words_.Number(fmt::format("entry ({}, {})", i, j));
  words_.SkipNumbers(1);
  return 0;
}

void SiconosMatrixReader::Dense() {
  storage_ = "dense";
  words_.Integer("the rows of the matrix", rows_, rows_);
  words_.Integer("the columns of the matrix", columns_, columns_);
  for (int j = 0; j < columns_; ++j) {
    for (int i = 0; i < rows_; ++i) Add(i, j, Entry(i, j));
  }
}

// Ends of block rows or columns: increasing, the last one is the size of the matrix.
std::vector<int> SiconosMatrixReader::Ends(int count, int size, const char* what) {
  std::vector<int> ends;
  for (int k = 0; k < count; ++k) {
    const int least = k == count - 1 ? size : (ends.empty() ? 1 : ends.back() + 1);
    ends.push_back(words_.Integer(fmt::format("the end of block {} {}", what, k), least, size));
  }
  return ends;
}

// Where the blocks of each block row begin, and the end of the last.
std::vector<int> SiconosMatrixReader::Pointers(int blocks) {
  std::vector<int> pointers;
  for (int k = 0; k <= block_rows_; ++k) {
    const int least = k == block_rows_ ? blocks : pointers.empty() ? 0 : pointers.back();
    const int most = k == 0 ? 0 : blocks;
    pointers.push_back(words_.Integer(fmt::format("row pointer {}", k), least, most));
  }
  return pointers;
}

void SiconosMatrixReader::Blocks() {
  storage_ = "blocks";
  const int blocks = words_.Count("the number of blocks");
  if (blocks == 0) return;
  block_rows_ = words_.Integer("the number of block rows", 1, rows_);
  const int block_columns = words_.Integer("the number of block columns", 1, columns_);
  const std::vector<int> row_ends = Ends(block_rows_, rows_, "row");
  const std::vector<int> column_ends = Ends(block_columns, columns_, "column");
  words_.Integer("the number of row pointers", block_rows_ + 1, block_rows_ + 1);
  words_.Integer("the number of blocks", blocks, blocks);
  const std::vector<int> pointers = Pointers(blocks);
  std::vector<int> columns;
  for (int k = 0; k < blocks; ++k) {
    columns.push_back(words_.Integer(fmt::format("the block column of block {}", k), 0, block_columns - 1));
  }
  for (int row = 0; row < block_rows_; ++row) {
    for (int k = pointers[row]; k < pointers[row + 1]; ++k) {
      words_.Integer("the number of the block", k, k);
      OneBlock(row_ends, row, column_ends, columns[k]);
    }
  }
}

void SiconosMatrixReader::OneBlock(const std::vector<int>& row_ends, int row,
                                   const std::vector<int>& column_ends, int column) {
  const int first_row = row == 0 ? 0 : row_ends[row - 1];
  const int first_column = column == 0 ? 0 : column_ends[column - 1];
  for (int j = first_column; j < column_ends[column]; ++j) {
    for (int i = first_row; i < row_ends[row]; ++i) Add(i, j, Entry(i, j));
  }
}

void SiconosMatrixReader::CSparse() {
  const int form = words_.Integer("the form of the matrix (1 triplet, 2 compressed columns)", 1, 2);
  words_.Expect("CSparse");
  words_.SkipLine();
  if (form == 1) words_.Expect("triplet:");
  words_.Expect(fmt::format("{}-by-{}", rows_, columns_));
  words_.Expect("nzmax:");
  words_.Some("the room for entries");
  words_.Expect("nnz:");
  const int count = words_.Count("the number of entries");
  if (form == 1) return Triplets(count);
  words_.Expect("1-norm:");
  words_.Some("the norm");
  Columns(count);
}

void SiconosMatrixReader::Triplets(int count) {
  storage_ = "csparse triplet";
  for (int k = 0; k < count; ++k) {
    const int i = words_.Integer("a row", 0, rows_ - 1), j = words_.Integer("a column", 0, columns_ - 1);
    words_.Expect(":");
    Add(i, j, Entry(i, j));
  }
}

void SiconosMatrixReader::Columns(int count) {
  storage_ = "csparse columns";
  int next = 0;
  for (int j = 0; j < columns_; ++j) {
    words_.Expect("col");
    words_.Integer("the column", j, j);
    words_.Expect(":");
    words_.Expect("locations");
    words_.Integer("the first location of the column", next, next);
    words_.Expect("to");
    const int least = j == columns_ - 1 ? count - 1 : next - 1;
    const int last = words_.Integer("the last location of the column", least, count - 1);
    for (; next <= last; ++next) {
      const int i = words_.Integer("a row", 0, rows_ - 1);
      words_.Expect(":");
      Add(i, j, Entry(i, j));
    }
  }
}

}  // namespace stiction
