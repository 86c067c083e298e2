// SPDX-License-Identifier: Apache-2.0
// Words, numbers and matrices of Siconos' text files (siconos.h), one after the other.
//
// Whatever is not there as expected is an InputError with its line, what was found and what was expected.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/record/sparse_matrix.h"

namespace stiction {

// Words of a text, and the line that the last one stands in. Keeps references.
class SiconosWords {
 public:
  SiconosWords(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  [[noreturn]] void Refuse(const std::string& found, const std::string& expected) const;

  // The next word, without a comma at its end; empty at the end of the text.
  std::string_view Next();
  std::string_view Some(const std::string& expected);
  void Expect(std::string_view expected);
  void SkipLine();

  // How many there are of something; each takes a character at least.
  int Count(const std::string& what);
  // An integer from `least` to `most`.
  int Integer(const std::string& what, int least, int most);
  // The nearest double.
  double Number(const std::string& what);
  // `count` numbers, infinite ones too.
  void SkipNumbers(int count);

  // Behind the last number may stand one flag, 0 or 1, and below an empty line a remark, which is returned:
  // words of which the first is no number and begins no matrix.
  std::string ExpectEnd();

 private:
  std::string_view text_;
  const std::string& source_;
  std::size_t at_ = 0;
  int line_ = 1;
  int lines_passed_ = 0;  // before the last word
};

// The sizes that a matrix must have; any if negative.
struct SiconosSizes {
  int rows = -1, columns = -1;
};

// Reads one matrix. Without `entries` its numbers are read and forgotten.
class SiconosMatrixReader {
 public:
  explicit SiconosMatrixReader(SiconosWords& words, SparseMatrix* entries = nullptr)
      : words_(words), entries_(entries) {}

  void Read(SiconosSizes expected);
  // The two parts of it: storage type and sizes; the rest.
  void ReadHeader(SiconosSizes expected);
  void ReadEntries();

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int block_rows() const { return block_rows_; }  // of a matrix in blocks
  const char* storage() const { return storage_; }

 private:
  void Add(int i, int j, double value);
  double Entry(int i, int j);
  void Dense();
  std::vector<int> Ends(int count, int size, const char* what);
  std::vector<int> Pointers(int blocks);
  void Blocks();
  void OneBlock(const std::vector<int>& row_ends, int row, const std::vector<int>& column_ends, int column);
  void CSparse();
  void Triplets(int count);
  void Columns(int count);

  SiconosWords& words_;
  SparseMatrix* entries_;
  int type_ = 0, rows_ = 0, columns_ = 0, block_rows_ = 0;
  const char* storage_ = "";
};

}  // namespace stiction
