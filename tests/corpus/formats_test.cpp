// SPDX-License-Identifier: Apache-2.0
// Formats of others: what is written is read back, texts mean what Siconos and FCLIB mean, bad files are
// refused.

#include "corpus/formats/formats.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <variant>

#include "corpus/formats/siconos.h"
#include "corpus/json.h"
#include "corpus/record/asymmetry.h"
#include "corpus/record/problem_file.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;
using Catch::Contains;

// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "stiction-formats-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// Doubles of all sizes; asymmetric, so that a transposed matrix is noticed; some entries zero.
ExactEntries RandomDoubles(const std::vector<ContactKind>& kinds, int dimension, std::uint64_t seed) {
  Choices choices(seed);
  const auto number = [&choices] {
    return Rational(static_cast<double>(choices.Integer(-1000, 1000)) / 7.0 *
                    std::ldexp(1.0, static_cast<int>(choices.Integer(-60, 60))));
  };
  ExactEntries problem;
  SparseMatrix A;
  problem.dimension = dimension;
  for (const ContactKind kind : kinds) {
    const bool rough = kind == ContactKind::kStatic;
    problem.contacts.push_back(
        {kind, rough ? Rational(0.1 * static_cast<double>(choices.Integer(0, 9))) : 0, {}});
  }
  const int rows = RowCount(problem.contacts, dimension);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.b[i] = number();
    for (int j = 0; j < rows; ++j) {
      const Rational value = choices.Integer(0, 2) == 0 ? number() : Rational(0);
      if (value != 0) A[{i, j}] = value;
    }
  }
  problem.A = ToEigen(A, rows, rows);
  return problem;
}

ProblemFile FileOf(AnyProblem problem) {
  ProblemFile file;
  file.problem = std::move(problem);
  return file;
}

// The entries of A, by rows.
SparseMatrix EntriesIn(const ProblemFile& file) { return ByRows(file.problem.entries().A); }

void CheckEqual(const ProblemFile& found, const AnyProblem& expected) {
  CHECK(found.problem.dimension() == expected.dimension());
  REQUIRE(found.problem.contacts().size() == expected.contacts().size());
  for (std::size_t i = 0; i < expected.contacts().size(); ++i) {
    CHECK(found.problem.contacts()[i].kind == expected.contacts()[i].kind);
    CHECK(found.problem.contacts()[i].mu == expected.contacts()[i].mu);
  }
  CHECK((EntriesIn(found) == ByRows(expected.entries().A)));
  CHECK((found.problem.b() == expected.b()));
}

TEST_CASE("formats: problems without contacts or without entries are written and read") {
  const Folder folder;
  for (const PublishedFormat& format : PublishedFormats()) {
    for (const std::string& storage : format.storages) {
      for (const int contacts : {0, 2}) {
        CAPTURE(format.name, storage, contacts);
        const bool lcp = format.name == "siconos-lcp";
        ExactEntries problem;
        problem.contacts.assign(contacts, {lcp ? ContactKind::kFrictionless : ContactKind::kStatic, 0, {}});
        problem.b = ExactVector::Constant(RowCount(problem.contacts, 2), Rational(1));
        problem.A.resize(problem.rows(), problem.rows());
        WritePublished(FileOf(problem), folder / "empty", format.name, storage, Rounding::kRefused);
        CheckEqual(ReadPublished(folder / "empty", format.name), problem);
      }
    }
  }
}

TEST_CASE("formats: numbers that are no doubles are refused, or rounded and counted") {
  const Folder folder;
  ExactEntries problem = RandomDoubles({ContactKind::kStatic, ContactKind::kStatic}, 2, 7);
  problem.A.coeffRef(0, 0) = Rational(1, 3);
  problem.contacts[1].mu = Number("0.3");
  for (const PublishedFormat& format : PublishedFormats()) {
    if (format.name == "siconos-lcp") continue;
    CAPTURE(format.name);
    CHECK_THROWS_WITH(WritePublished(FileOf(problem), folder / "x", format.name, "", Rounding::kRefused),
                      Contains("A[0][0]") && Contains("1/3") && Contains("--round"));
    const ExportReport report =
        WritePublished(FileOf(problem), folder / "x", format.name, "", Rounding::kAllowed);
    CHECK(report.rounded == 2);
    CHECK(report.largest_change > 0);
    CHECK(report.largest_change < Rational(1, 1000000000));
    const ProblemFile read = ReadPublished(folder / "x");
    CHECK(read.problem.dense().A(0, 0) == Rational(1.0 / 3.0));
    CHECK(read.problem.contacts()[1].mu == Rational(0.3));
  }
  problem.b[0] = Number("1e400");
  CHECK_THROWS_WITH(WritePublished(FileOf(problem), folder / "x", "fclib", "", Rounding::kAllowed),
                    Contains("b[0]") && Contains("range of doubles"));
}

TEST_CASE("formats: contacts that a format does not have are refused") {
  const Folder folder;
  using enum ContactKind;
  const auto refused = [&folder](const std::vector<ContactKind>& kinds, const std::string& format) {
    const ExactEntries problem = RandomDoubles(kinds, 2, 1);
    CHECK_THROWS_WITH(WritePublished(FileOf(problem), folder / "x", format, "", Rounding::kRefused),
                      Contains("contacts[1]"));
  };
  refused({kFrictionless, kStatic}, "siconos-lcp");
  refused({kStatic, kFrictionless}, "siconos-fc");
  refused({kStatic, kFrictionless}, "fclib");
  refused({kBilateral, kStatic}, "fclib");
  ExactEntries problem = RandomDoubles({kStatic, kBilateral}, 2, 1);
  problem.A.coeffRef(0, 2) = 1;
  problem.A.coeffRef(2, 0) = 0;
  CHECK_THROWS_WITH(WritePublished(FileOf(problem), folder / "x", "fclib", "", Rounding::kRefused),
                    Contains("mirror"));
  CHECK_THROWS_WITH(WritePublished(FileOf(problem), folder / "x", "siconos-fc", "rows", Rounding::kRefused),
                    Contains("storage 'rows'"));
}

// ---- Siconos ---------------------------------------------------------------------------------

ProblemFile Parse(const std::string& text) { return ParseSiconos(text, std::nullopt, "file"); }

const std::string kDense = "2 1 0 2 2 2 2\n 1 2\n 3 4\n -5 0.1\n 0.5\n\nwhatever stands here\n";
const std::string kBlocks =
    "2 2 1 4 4\n3\n2\n2\n2 4\n2 4\n3\n3\n0 1 3\n0 0 1\n0\n 1 2 3 4\n1\n 5 6 7 8\n2\n 9 0 0 1\n 1 2 3 4\n 1 "
    "0\n1\n";
const std::string kColumns =
    "2 1 2 2 2 2\nCSparse Version 3.1.9, May 4, 2016.  Copyright (c) whoever\n"
    "2-by-2, nzmax: 2 nnz: 2, 1-norm: 7\n    col 0 : locations 0 to 1\n      0 : 3\n      1 : 4\n"
    "    col 1 : locations 2 to 1\n 1 2\n 0.5\n";
const std::string kTriplet =
    "2\n2\n2\n2\n1\nCSparse Version 3.1.9\ntriplet: 2-by-2, nzmax: 4 nnz: 3\n    1 0 : 2\n    0 0 : 3\n"
    "    1 0 : 0.5\n -1 -2\n";

TEST_CASE("Siconos: a dense matrix stands column by column, q and mu behind it, then a remark") {
  const ProblemFile problem = Parse(kDense);
  CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, 1}, {{1, 0}, 2}, {{0, 1}, 3}, {{1, 1}, 4}}));
  CHECK(problem.problem.b()[0] == -5);
  CHECK(problem.problem.b()[1] == Rational(0.1));
  CHECK(problem.problem.contacts().front().mu == Rational(1, 2));
  CHECK((*problem.origin)["storage"] == "dense");
}

TEST_CASE("Siconos: blocks stand row by row, each column by column, missing ones are zero") {
  const ProblemFile problem = Parse(kBlocks);
  CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, 1},
                                            {{1, 0}, 2},
                                            {{0, 1}, 3},
                                            {{1, 1}, 4},
                                            {{2, 0}, 5},
                                            {{3, 0}, 6},
                                            {{2, 1}, 7},
                                            {{3, 1}, 8},
                                            {{2, 2}, 9},
                                            {{3, 3}, 1}}));
  CHECK(problem.problem.b()[3] == 4);
  CHECK(problem.problem.contacts()[1].mu == 0);
}

TEST_CASE("Siconos: CSparse text, compressed and triplet, entries listed twice add up") {
  CHECK((EntriesIn(Parse(kColumns)) == SparseMatrix{{{0, 0}, 3}, {{1, 0}, 4}}));
  const ProblemFile lcp = Parse(kTriplet);
  CHECK((EntriesIn(lcp) == SparseMatrix{{{0, 0}, 3}, {{1, 0}, Rational(5, 2)}}));
  CHECK(lcp.problem.contacts().size() == 2);
  CHECK(lcp.problem.contacts()[0].kind == ContactKind::kFrictionless);
}

std::string Without(std::string text, const std::string& part, const std::string& instead) {
  const std::size_t at = text.find(part);
  REQUIRE(at != text.npos);
  return text.replace(at, part.size(), instead);
}

TEST_CASE("Siconos: a malformed file is refused with its line, what was found and what was expected") {
  struct Case {
    std::string text, line, found, expected;
  };
  for (const Case& c : std::vector<Case>{
           {Without(kDense, "0.1", "nan"), "line 4", "'nan'", "q[1]"},
           {Without(kDense, "0.1", "1e999"), "line 4", "'1e999'", "range of doubles"},
           {Without(kDense, "0.1", "0.1x"), "line 4", "'0.1x'", "q[1]"},
           {Without(kDense, "0.5", "-0.5"), "line 5", "-1/2", "mu[0], a number >= 0"},
           {Without(kDense, "2 2 2 2", "2 2 2 3"), "line 1", "'3'", "2, the columns of the matrix"},
           {Without(kDense, " 3 4\n", ""), "line 6", "'whatever'", "q[1]"},
           {kDense.substr(0, 22), "line 3", "the end of the file", "entry"},
           {Without(kBlocks, "2 4\n2 4", "2 5\n2 4"), "line 5", "'5'", "4, the end of block row 1"},
           {Without(kBlocks, "0 1 3", "0 4 3"), "line 9", "'4'", "row pointer 1"},
           {Without(kBlocks, "0 0 1", "0 2 1"), "line 10", "'2'", "block column of block 1"},
           {Without(kBlocks, "\n1\n 5", "\n2\n 5"), "line 13", "'2'", "1, the number of the block"},
           {Without(kColumns, "0 to 1", "0 to 2"), "line 4", "'2'", "the last location"},
           {Without(kColumns, "2 to 1", "1 to 1"), "line 7", "'1'", "2, the first location"},
           {Without(kColumns, "      1 :", "      2 :"), "line 6", "'2'", "a row, from 0 to 1"},
           {Without(kColumns, "2-by-2", "3-by-2"), "line 3", "'3-by-2'", "'2-by-2'"},
           {Without(kColumns, "CSparse", "csparse"), "line 2", "'csparse'", "block columns"},
           {Without(kTriplet, "1 0 : 2", "1 2 : 2"), "line 8", "'2'", "a column, from 0 to 1"},
           {Without(kTriplet, "nnz: 3", "nnz: 1.2e+06"), "line 7", "'1.2e+06'", "number of entries"},
           {"1000000000 0 1000000000 1000000000", "line 1", "'1000000000'", "the size of the LCP"},
       }) {
    CAPTURE(c.text);
    CHECK_THROWS_WITH(Parse(c.text),
                      Contains("file: " + c.line + ": found " + c.found) && Contains(c.expected));
  }
}

TEST_CASE("Siconos: LCP or friction is told by the first words") {
  CHECK_THROWS_WITH(Parse("hello"), Contains("neither") && Contains("--format"));
  CHECK_THROWS_WITH(Parse(""), Contains("neither"));
  // n = 2, blocks, 2 of them: not one planar contact, csparse.
  const ProblemFile lcp = Parse("2 1 2 2 2\n2 2\n1 2\n1 2\n3 2\n0 1 2\n0 1\n0\n4\n1\n5\n -1 -2\n");
  CHECK(lcp.problem.contacts()[0].kind == ContactKind::kFrictionless);
  CHECK((EntriesIn(lcp) == SparseMatrix{{{0, 0}, 4}, {{1, 1}, 5}}));
  CHECK(Parse(kColumns).problem.contacts()[0].kind == ContactKind::kStatic);
}

TEST_CASE("Siconos: behind the last number may stand a flag, and below an empty line a remark, which is kept") {
  const std::string lcp = "2 0 2 2 2 2\n1 2\n3 4\n-5 6\n";
  const std::string friction = "2 1 0 2 2 2 2\n1 2\n3 4\n-5 6\n0.5\n";
  const std::string parts = "1 1 1 1\n0 1 2\n0 1\n0 2 2 2 2\n1 2\n3 4\n-5 6\n1 4 3 2 -5 6\n";
  for (const std::string& text : {lcp, friction, parts}) {
    const ProblemFile problem = Parse(text);
    for (const auto& [rest, remark] :
         std::vector<std::pair<std::string, std::string>>{{"0", ""},
                                                          {"1\n", ""},
                                                          {"\f\n", ""},
                                                          {"\n# of 3 files", "# of 3 files"},
                                                          {"0\n \n# \xff", "# ?"},
                                                          {"\nExample 4.4.7\n 8 9", "Example 4.4.7 8 9"}}) {
      CAPTURE(text, rest);
      const ProblemFile read = Parse(text + rest);
      CHECK(read.origin->value("remark", "") == remark);
      CheckEqual(read, problem.problem);
    }
    const std::string line = text == lcp ? "line 5" : text == friction ? "line 6" : "line 9";
    for (const std::string rest : {"garbage", "1 solved", "# a remark", "4.4.7 CPS", "x 0 1", "\xff"}) {
      CAPTURE(text, rest);
      CHECK_THROWS_WITH(Parse(text + rest), Contains("file: " + line + ": found text, from '") &&
                                                Contains("expected the end of the file"));
    }
    CHECK_THROWS_WITH(Parse(text + "0\n# of 3 files"), Contains("found text, from '#' on"));
  }
}

TEST_CASE("Siconos: behind the last number stands no other number") {
  const std::string lcp = "2 0 2 2 2 2\n1 2\n3 4\n-5 6\n";
  const std::string friction = "2 1 0 2 2 2 2\n1 2\n3 4\n-5 6\n0.5\n";
  for (const std::string& text : {lcp, friction}) {
    struct Case {
      std::string rest, line, found;
    };
    const std::string line = text == lcp ? "line 5" : "line 6", later = text == lcp ? "line 6" : "line 7";
    for (const Case& c : std::vector<Case>{{"2", line, "1 number more, from '2' on"},
                                           {"0.0", line, "1 number more, from '0.0' on"},
                                           {"1e0 text", line, "1 number more, from '1e0' on"},
                                           {"0 1", line, "2 numbers more, from '0' on"},
                                           {"\n7,\n8 9 text 3", later, "3 numbers more, from '7' on"},
                                           {"+1e999", line, "1 number more, from '+1e999' on"},
                                           {"nan", line, "1 number more, from 'nan' on"}}) {
      CAPTURE(text, c.rest);
      CHECK_THROWS_WITH(Parse(text + c.rest),
                        Contains("file: " + c.line + ": found " + c.found + ", expected the end of the file"));
    }
  }
}

// ---- Siconos: files of other kinds -----------------------------------------------------------

std::string Numbers(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format("{} ", 0.25 * i - 1);
  return text + "\n";
}

std::string DenseMatrix(int rows, int columns) {
  return fmt::format("0\n{}\n{}\n{}\t{}\n", rows, columns, rows, columns) + Numbers(rows * columns);
}

// Ones on the diagonal.
std::string TripletMatrix(int rows, int columns) {
  const int count = std::min(rows, columns);
  std::string text = fmt::format("2\n{}\n{}\n1\nCSparse Version 4.4.0\ntriplet: {}-by-{}, nzmax: {} nnz: {}\n",
                                 rows, columns, rows, columns, count + 1, count);
  for (int i = 0; i < count; ++i) text += fmt::format("    {} {} : 1\n", i, i);
  return text;
}

std::string BlockMatrix(int rows, int columns) {
  return fmt::format("1\n{}\n{}\n1\n1\n1\n{}\t\n{}\t\n2\n1\n0\t1\t\n0\t\n0\n", rows, columns, rows, columns) +
         Numbers(rows * columns);
}

const char* const kMlcp = "a mixed linear complementarity problem (MLCP";
const char* const kTwoCoefficients =
    "a problem with two coefficients a contact: rolling friction in the plane (mu, mu_r) or plasticity (eta, "
    "theta)";

TEST_CASE("Siconos: a file of another kind is refused by the name of its kind") {
  struct Case {
    std::string kind, text;
  };
  std::vector<Case> cases = {
      {"a relay problem", "2\n" + DenseMatrix(2, 2) + Numbers(2) + "-1 -1\n1 1\n"},
      {"a relay problem", "2\n" + DenseMatrix(2, 2) + Numbers(2) + "-inf -1\n1 inf\n0\n"},
      {"a relay problem", "3\n" + TripletMatrix(3, 3) + Numbers(9)},
      {"a relay problem", "1\n" + BlockMatrix(1, 1) + Numbers(3)},
      {kMlcp, "1\n0\n1\n1\n0 1 2 \n0 1 \n" + DenseMatrix(2, 2) + Numbers(2)},
      {kMlcp, "1\n1\n1\n1\n0 1 2 \n0 1 \n" + DenseMatrix(3, 2) + Numbers(11)},
      {kMlcp, "1\n1\n4\n2\n0 4 6 \n0 1 \n" + DenseMatrix(6, 6) + Numbers(6 + 42 + 7)},
      {kMlcp, "0\n1\n1\n2\n" + Numbers(12)},
      {kMlcp, "1 1 2\n" + Numbers(6)},
      {kMlcp, "3 2 5\n" + Numbers(30)},
      {"a second-order cone complementarity problem",
       "3\n1\n" + DenseMatrix(3, 3) + Numbers(3) + "0 3 \n0.5\n"},
      {"a second-order cone complementarity problem",
       "5\n2\n" + TripletMatrix(5, 5) + Numbers(5) + "0 2 5 \n0.5 1\n"},
      {"a generic mechanical problem", "1\n4\n4\n2\n2\n2\n1\t4\t\n1\t4\t\n3\n2\n0\t1\t2\t\n0\t1\t\n0\n5\n1\n" +
                                           Numbers(9) + "\n" + Numbers(4) + "\n2\n4\n0.5\n"},
      {"a generic mechanical problem", BlockMatrix(1, 1) + "-3\n\n0\n"},
      {"a rolling friction problem (dimension 5", "5\n2\n" + DenseMatrix(10, 10) + Numbers(14)},
      {"a rolling friction problem (dimension 5", "5\n1\n" + TripletMatrix(5, 5) + Numbers(7)},
      {"a global rolling friction problem", "5\n1\n" + TripletMatrix(6, 6) + TripletMatrix(6, 5) + Numbers(13)},
      {"a global rolling friction problem", "5\n1\n" + DenseMatrix(5, 5) + DenseMatrix(5, 5) + Numbers(12)},
      {kTwoCoefficients, "3\n1\n" + DenseMatrix(3, 3) + Numbers(3) + "1\n0.25\n"},
      {kTwoCoefficients, "3\n1\n" + DenseMatrix(3, 3) + Numbers(3) + "0.5\n0.0\n"},
      {kTwoCoefficients, "3\n2\n" + TripletMatrix(6, 6) + Numbers(6) + "0.5 1\n0.25 0\n0\n"},
      {"a plasticity problem", "3\n2\n1\n" + TripletMatrix(6, 6) + Numbers(10)},
      {"a plasticity problem", "3\n1\n2\n" + DenseMatrix(3, 3) + Numbers(4)},
      {"a cohesive friction problem", "3\n1\n2\n" + TripletMatrix(9, 9) + Numbers(20) + TripletMatrix(3, 3)},
  };
  for (const auto& matrix : {DenseMatrix, TripletMatrix, BlockMatrix}) {
    for (const int dimension : {2, 3}) {
      for (const int n : {dimension, 4}) {
        const std::string head = fmt::format("{}\n1\n", dimension) + matrix(n, n) + matrix(n, dimension);
        cases.push_back({"a global friction problem", head + Numbers(n + dimension) + "0.25\n1\n"});
      }
    }
  }
  cases.push_back({"a global friction problem", "2\n0\n" + DenseMatrix(3, 3) + DenseMatrix(3, 0) + Numbers(3)});
  for (const Case& c : cases) {
    CAPTURE(c.text);
    const bool is_read = c.kind == kMlcp || c.kind == "a global friction problem";
    if (!is_read) CHECK_THROWS_WITH(Parse(c.text), Contains("file: line ") && Contains(c.kind));
    for (const SiconosKind kind : {SiconosKind::kLcp, SiconosKind::kFriction}) {
      CHECK_THROWS_WITH(ParseSiconos(c.text, kind, "file"),
                        Contains("file: line ") && Contains("; the file is " + c.kind));
    }
  }
}

// M = 2 I, H = I, q = -(1, 1, 1), b = (0, 0, 4), mu = 1/10; as a local problem it would have q = (0, 3, 3), mu
// = 3.
const std::string kGlobalM = "0\n3\n3\n3\t3\n2 0 0\n0 2 0\n0 0 2\n",
                  kGlobalH = "0\n3\n3\n3\t3\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kGlobal = "3\n1\n" + kGlobalM + kGlobalH + "-1 -1 -1 0 0 4\n0.1\n0\n";

TEST_CASE("Siconos: a global problem is read in its factors, and the sizes of H are no q and no mu") {
  const ProblemFile problem = Parse(kGlobal);
  CHECK(problem.problem.dimension() == 3);
  REQUIRE(problem.problem.contacts().size() == 1);
  CHECK(problem.problem.contacts()[0].mu == Rational(0.1));
  const Rational half(1, 2);
  CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, half}, {{1, 1}, half}, {{2, 2}, half}}));
  CHECK((problem.problem.b() == ExactVector(Eigen::Map<const ExactVector>(
                                    std::array<Rational, 3>{-half, -half, Rational(7, 2)}.data(), 3))));
  REQUIRE(problem.problem.factors() != nullptr);
  CHECK(problem.problem.factors()->c[2] == 4);
  CHECK_THROWS_WITH(ParseSiconos(kGlobal, SiconosKind::kFriction, "file"),
                    Contains("found 18 numbers more, from '3' on") &&
                        Contains("the file is a global friction problem") && Contains("which is not read"));
  const std::string flat = "3\n1\n0\n3\n3\n3\t3\n2 0 0\n0 0 0\n0 0 2\n" + kGlobalH + "-1 -1 -1 0 0 4\n0.1\n";
  CHECK_THROWS_WITH(Parse(flat), Contains("a zero pivot in row 1") && Contains("a positive definite matrix") &&
                                     Contains("the file is a global friction problem"));
}

// Equation 4 u + v + 5 = 0, condition w = u + 3 v - 6 on v; each form says the same.
TEST_CASE("Siconos: an MLCP is read, its equations as bilateral contacts") {
  for (const std::string& text :
       {std::string("1 0 1 1\n0 1 2\n0 1\n0 2 2 2 2\n4 1\n1 3\n5 -6\n"),
        std::string("1 1 1 1\n0 1 2\n0 1\n0 2 2 2 2\n4 1\n1 3\n5 -6\n4\n3\n1\n1\n5 -6\n"),
        std::string("0 1 1 1\n4\n3\n1\n1\n5 -6\n"), std::string("1 1 2\n4\n3\n1\n1\n5 -6\n")}) {
    CAPTURE(text);
    const ProblemFile problem = Parse(text);
    REQUIRE(problem.problem.contacts().size() == 2);
    CHECK(problem.problem.contacts()[0].kind == ContactKind::kBilateral);
    CHECK(problem.problem.contacts()[1].kind == ContactKind::kFrictionless);
    CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, 4}, {{0, 1}, 1}, {{1, 0}, 1}, {{1, 1}, 3}}));
    CHECK(problem.problem.b()[0] == 5);
    CHECK(problem.problem.b()[1] == -6);
    CHECK((*problem.origin)["format"] == "siconos-mlcp");
  }
  // C and D are not each other's mirror; C is 1 x 2, row by row.
  const ProblemFile parts = Parse("1 2 3\n1\n2 3 4 5\n6 7\n8 9\n0 0 0\n");
  CHECK(parts.problem.entries().A.coeff(0, 2) == 7);
  CHECK(parts.problem.entries().A.coeff(2, 0) == 9);
  CHECK(parts.problem.entries().A.coeff(2, 1) == 4);
  CHECK_THROWS_WITH(Parse("1 1 3\n" + Numbers(9)), Contains("MLCP") && Contains("the number of rows"));
}

TEST_CASE("Siconos: a file that is wrong in itself is not taken for one of another kind") {
  const std::string lcp = "2 0 2 2 2 2\n1 2 3 4\n-1 -1\n";
  for (const std::string& text : {kDense, kBlocks, kColumns, kTriplet, lcp}) {
    for (std::size_t length = 1; length + 8 < text.size(); length += 3) {
      try {
        Parse(text.substr(0, length));
      } catch (const InputError& error) {
        CAPTURE(text.substr(0, length));
        CHECK(std::string(error.what()).find("the file is") == std::string::npos);
      }
    }
  }
}

// ---- FCLIB -----------------------------------------------------------------------------------

using Values = std::variant<std::vector<int>, std::vector<double>>;
using Sets = std::map<std::string, Values>;

// Data sets by path, groups as needed.
void WriteSets(const std::filesystem::path& file, const Sets& sets) {
  const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  for (const auto& [path, values] : sets) {
    const auto* integers = std::get_if<std::vector<int>>(&values);
    const auto* doubles = std::get_if<std::vector<double>>(&values);
    const hsize_t size = integers != nullptr ? integers->size() : doubles->size();
    const hid_t type = integers != nullptr ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t set = H5Dcreate2(id, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
    REQUIRE(set >= 0);
    const void* data = integers != nullptr ? static_cast<const void*>(integers->data()) : doubles->data();
    REQUIRE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    H5Dclose(set);
    H5Sclose(space);
  }
  H5Pclose(links);
  H5Fclose(id);
}

void AddMatrix(Sets& sets, const std::string& path, int m, int n, int nz, const std::vector<int>& p,
               const std::vector<int>& i, const std::vector<double>& x) {
  sets[path + "/m"] = std::vector<int>{m};
  sets[path + "/n"] = std::vector<int>{n};
  sets[path + "/nz"] = std::vector<int>{nz};
  sets[path + "/nzmax"] = std::vector<int>{static_cast<int>(x.size())};
  sets[path + "/p"] = p;
  sets[path + "/i"] = i;
  sets[path + "/x"] = x;
}

// M = [2 1 0; 1 2 0; 0 0 4], H = [1 0; 0 1; 1 0], G = (0, 0, 2)', f = (3, 0, 4), w = (1, 2), b = 5.
Sets GlobalProblem() {
  Sets sets;
  sets["/fclib_global/spacedim"] = std::vector<int>{2};
  AddMatrix(sets, "/fclib_global/M", 3, 3, -1, {0, 2, 4, 5}, {0, 1, 0, 1, 2}, {2, 1, 1, 2, 4});
  AddMatrix(sets, "/fclib_global/H", 3, 2, 3, {0, 1, 0}, {0, 1, 2}, {1, 1, 1});
  AddMatrix(sets, "/fclib_global/G", 3, 1, -2, {0, 0, 0, 1}, {0}, {2});
  sets["/fclib_global/vectors/f"] = std::vector<double>{3, 0, 4};
  sets["/fclib_global/vectors/w"] = std::vector<double>{1, 2};
  sets["/fclib_global/vectors/b"] = std::vector<double>{5};
  sets["/fclib_global/vectors/mu"] = std::vector<double>{0.5};
  return sets;
}

void CheckCondensed(const ProblemFile& problem) {
  CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, Rational(11, 12)},
                                            {{0, 1}, Rational(-1, 3)},
                                            {{1, 0}, Rational(-1, 3)},
                                            {{1, 1}, Rational(2, 3)},
                                            {{0, 2}, Rational(1, 2)},
                                            {{2, 0}, Rational(1, 2)},
                                            {{2, 2}, 1}}));
  CHECK((problem.problem.b() == Vector({4, 1, 7})));
  REQUIRE(problem.problem.contacts().size() == 2);
  CHECK(problem.problem.contacts()[0].kind == ContactKind::kStatic);
  CHECK(problem.problem.contacts()[0].mu == Rational(1, 2));
  CHECK(problem.problem.contacts()[1].kind == ContactKind::kBilateral);
}

TEST_CASE("FCLIB: a global problem is condensed exactly, its equations are bilateral contacts") {
  const Folder folder;
  WriteSets(folder / "global.hdf5", GlobalProblem());
  const ProblemFile problem = ReadPublished(folder / "global.hdf5");
  CheckCondensed(problem);
  REQUIRE(problem.problem.factors() != nullptr);
  CHECK(problem.problem.factors()->b == problem.problem.b());
  CHECK(problem.problem.factors()->w == Vector({2, -1, 1}));
  CHECK(problem.problem.factors()->c == Vector({1, 2, 5}));
}

TEST_CASE("FCLIB: a global problem whose M is not symmetric is condensed, and has no factors") {
  const Folder folder;
  Sets sets = GlobalProblem();
  AddMatrix(sets, "/fclib_global/M", 3, 3, -1, {0, 2, 4, 5}, {0, 1, 0, 1, 2}, {2, 0, 1, 2, 4});
  WriteSets(folder / "global.hdf5", sets);
  const ProblemFile problem = ReadPublished(folder / "global.hdf5");
  CHECK(problem.problem.factors() == nullptr);
  CHECK(problem.problem.entries().A.coeff(0, 1) == Rational(-1, 4));
  CHECK(problem.problem.entries().A.coeff(1, 0) == 0);
  CHECK(problem.origin->contains("condensed"));
}

TEST_CASE(
    "FCLIB: an empty file, and a small one of many numbers, are refused before anything is made of them") {
  const Folder folder;
  std::ofstream(folder / "empty");
  CHECK_THROWS_WITH(ReadPublished(folder / "empty", "fclib"), Contains("found an empty file"));
  Sets sets;
  sets["/fclib_local/spacedim"] = std::vector<int>{2};
  for (const char* name : {"m", "n", "nz"}) sets[std::string("/fclib_local/W/") + name] = std::vector<int>{0};
  const std::string file = folder / "zeros.hdf5";
  WriteSets(file, sets);
  constexpr hsize_t kZeros = 4 << 20, kChunk = 1 << 16;
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), packed = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(packed, 1, &kChunk);
  H5Pset_deflate(packed, 9);
  const hid_t space = H5Screate_simple(1, &kZeros, nullptr);
  const hid_t set =
      H5Dcreate2(id, "/fclib_local/W/x", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, packed, H5P_DEFAULT);
  const std::vector<double> zeros(kZeros);
  REQUIRE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data()) >= 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(packed);
  H5Fclose(id);
  CHECK_THROWS_WITH(ReadPublished(file), Contains("W/x") && Contains("bytes of numbers"));
}

TEST_CASE("FCLIB: triplets with rows in p, as fclib.h has it, are told by the shape") {
  const Folder folder;
  Sets sets = GlobalProblem();
  AddMatrix(sets, "/fclib_global/H", 3, 2, 3, {0, 1, 2}, {0, 1, 0}, {1, 1, 1});
  WriteSets(folder / "global.hdf5", sets);
  CheckCondensed(ReadPublished(folder / "global.hdf5"));
}

TEST_CASE("FCLIB: a malformed file is refused with the place, what was found and what was expected") {
  const Folder folder;
  const auto refused = [&folder](const Sets& sets, const std::string& path, const std::string& expected) {
    WriteSets(folder / "bad.hdf5", sets);
    CAPTURE(path);
    CHECK_THROWS_WITH(ReadPublished(folder / "bad.hdf5"), Contains("bad.hdf5: /" + path) && Contains(expected));
  };
  const std::string group = "/fclib_global/";
  const auto with = [&group](const std::string& name, const Values& values) {
    Sets sets = GlobalProblem();
    sets[group + name] = values;
    return sets;
  };
  Sets sets = GlobalProblem();
  sets.erase("/fclib_global/vectors/f");
  refused(sets, "fclib_global/vectors/f: found nothing", "expected floating-point numbers");
  refused(with("spacedim", std::vector<int>{4}), "fclib_global/spacedim: found 4", "from 2 to 3");
  refused(with("spacedim", std::vector<double>{2}), "fclib_global/spacedim: found another type", "integers");
  refused(with("M/p", std::vector<int>{0, 2, 1, 5}), "fclib_global/M/p", "do not decrease");
  refused(with("M/p", std::vector<int>{0, 2, 4, 6}), "fclib_global/M/p", "end at 5");
  refused(with("M/i", std::vector<int>{0, 1, 0, 3, 2}), "fclib_global/M/i", "indices from 0 to 2");
  refused(with("M/nz", std::vector<int>{-3}), "fclib_global/M/nz", "from -2");
  refused(with("M/x", std::vector<double>{0, 0, 0, 2, 4}), "fclib_global/M", "positive definite");
  refused(with("H/p", std::vector<int>{0, 1, 9}), "fclib_global/H", "columns below 2");
  refused(with("H/nz", std::vector<int>{4}), "fclib_global/H", "nz = 4");
  refused(with("H/m", std::vector<int>{4}), "fclib_global/H", "3 rows");
  refused(with("H/x", std::vector<double>{1, NAN, 1}), "fclib_global/H/x[1]: found nan", "a number");
  refused(with("vectors/w", std::vector<double>{1}), "fclib_global/vectors/w: found 1 numbers", "expected 2");
  refused(with("vectors/mu", std::vector<double>{-1}), "fclib_global/vectors/mu[0]: found -1", "mu >= 0");
  refused({{"/something", std::vector<int>{1}}}, ": found something",
          "one problem, in fclib_local or fclib_global");
  refused({}, ": found nothing", "one problem");
  Sets both = GlobalProblem();
  both["/fclib_local/spacedim"] = std::vector<int>{2};
  refused(both, ": found fclib_global, fclib_local", "one problem");
  refused({{"/fclib_global_rolling/spacedim", std::vector<int>{5}}},
          "fclib_global_rolling: found a global rolling friction problem", "fclib_local or fclib_global");
  refused({{"/fclib_rolling/spacedim", std::vector<int>{5}}, {"/solution/u", std::vector<double>{1}}},
          "fclib_rolling: found a rolling friction problem", "one problem");
  refused({{"/fclib_\xff/spacedim", std::vector<int>{5}}}, "fclib_?: found another kind of problem",
          "one problem");
  std::ofstream(folder / "bad.hdf5") << "\x89HDF\r\n\x1a\nnothing";
  CHECK_THROWS_WITH(ReadPublished(folder / "bad.hdf5"), Contains("no HDF5 file"));
}

// ---- Symmetrizing, and the way to a problem file -----------------------------------------------

TEST_CASE("symmetrize: A becomes (A + A')/2 exactly, and the largest difference is kept") {
  ProblemFile problem = Parse("2 0 2 2 2 2\n 1 2\n 2.5 4\n 0 0");
  CHECK(LargestAsymmetry(problem.problem).difference == Rational(1, 2));
  Symmetrize(problem);
  CHECK((EntriesIn(problem) ==
         SparseMatrix{{{0, 0}, 1}, {{0, 1}, Rational(9, 4)}, {{1, 0}, Rational(9, 4)}, {{1, 1}, 4}}));
  CHECK((*problem.origin)["symmetrized"]["largest difference"] == "1/2");
  CHECK((*problem.origin)["symmetrized"]["i"] == 0);
  CHECK(LargestAsymmetry(problem.problem).difference == 0);
}

TEST_CASE("symmetrize: an entry and its missing mirror share what there is, a symmetric A is left alone") {
  ProblemFile problem = Parse("2 0 2 2 2 2\n 1 2\n 0 4\n 0 0");
  Symmetrize(problem);
  CHECK((EntriesIn(problem) == SparseMatrix{{{0, 0}, 1}, {{0, 1}, 1}, {{1, 0}, 1}, {{1, 1}, 4}}));
  problem.origin = {};
  Symmetrize(problem);
  CHECK_FALSE(problem.origin->contains("symmetrized"));
}

TEST_CASE("formats: dense and sparse problems are the same problem") {
  const ExactEntries problem = RandomDoubles({ContactKind::kStatic, ContactKind::kStatic}, 3, 3);
  ProblemFile file = FileOf(DenseOf(problem));
  file.name = "name";
  CheckEqual(ParseProblem(Print(file), "text"), problem);
  ExactEntries large;
  large.b.resize(kMostDenseRows + 1);
  CHECK_THROWS_WITH(RequireFewRows(large, "file"), Contains("4001") && Contains("at most 4000"));
}

}  // namespace
}  // namespace stiction
