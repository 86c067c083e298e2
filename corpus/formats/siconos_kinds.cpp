// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/formats/condense.h"
#include "corpus/formats/siconos_words.h"

namespace stiction {
namespace {

// One kind; `read` throws InputError where the text is not of it. `parse` makes a problem of one that is; null
// where its law is none of ours.
struct OtherKind {
  std::string_view name;
  void (*read)(SiconosWords& words);
  ProblemFile (*parse)(SiconosWords& words) = nullptr;
};

// A size that the file derives from two others, each at most the length of the text.
int Multiplied(SiconosWords& words, int left, int right) {
  const double product = static_cast<double>(left) * right;
  if (product > 1e8) words.Refuse("sizes", "fewer rows");
  return static_cast<int>(product);
}

// A square matrix; its rows.
int ReadSquare(SiconosWords& words, int rows = -1) {
  SiconosMatrixReader matrix(words);
  matrix.Read({rows, rows});
  if (matrix.rows() != matrix.columns()) words.Refuse("a matrix", "a square one");
  return matrix.rows();
}

void ReadGlobalFriction(SiconosWords& words) {
  const int dimension = words.Integer("dimension", 2, 3), contacts = words.Count("contacts");
  const int rows = Multiplied(words, dimension, contacts);
  const int n = ReadSquare(words);
  SiconosMatrixReader(words).Read({n, rows});
  words.SkipNumbers(n + rows + contacts);
}

// An M of other sizes than 5 nc is sign enough; otherwise H shows it.
void ReadGlobalRolling(SiconosWords& words) {
  words.Integer("dimension", 5, 5);
  const int rows = Multiplied(words, 5, words.Count("contacts"));
  SiconosMatrixReader M(words);
  M.ReadHeader({});
  if (M.rows() != M.columns()) words.Refuse("a matrix", "a square one");
  if (M.rows() != rows) return;
  M.ReadEntries();
  SiconosMatrixReader(words).Read({rows, rows});
}

void ReadRolling(SiconosWords& words) {
  words.Integer("dimension", 5, 5);
  const int rows = Multiplied(words, 5, words.Count("contacts"));
  SiconosMatrixReader(words).ReadHeader({rows, rows});
}

void ReadTwoCoefficients(SiconosWords& words) {
  words.Integer("dimension", 3, 3);
  const int contacts = words.Count("contacts");
  const int rows = Multiplied(words, 3, contacts);
  ReadSquare(words, rows);
  words.SkipNumbers(rows + 2 * contacts);
  words.ExpectEnd();
}

void ReadPlasticity(SiconosWords& words) {
  const int dimension = words.Integer("dimension", 3, 6), cones = words.Count("cones");
  words.Integer("model", 0, 2);
  const int rows = Multiplied(words, dimension, cones);
  SiconosMatrixReader(words).ReadHeader({rows, rows});
}

void ReadCohesive(SiconosWords& words) {
  const int dimension = words.Integer("dimension", 2, 3), contacts = words.Count("contacts");
  const int points = words.Count("cohesive points");
  if (points == 0) words.Refuse("0", "cohesive points");
  const int rows = Multiplied(words, dimension, contacts + points);
  SiconosMatrixReader(words).ReadHeader({rows, rows});
}

void ReadRelay(SiconosWords& words) {
  const int n = words.Count("size");
  ReadSquare(words, n);
  words.SkipNumbers(3 * n);
  words.ExpectEnd();
}

// Integers that increase from 0 to `last`, at least two; how many.
int ReadBegins(SiconosWords& words, int last) {
  int count = 1;
  for (int begin = words.Integer("a begin", 0, 0); begin < last; ++count) {
    begin = words.Integer("a begin", begin + 1, last);
  }
  return count;
}

void ReadSecondOrderCones(SiconosWords& words) {
  const int n = words.Count("size"), cones = words.Count("cones");
  ReadSquare(words, n);
  words.SkipNumbers(n);
  if (ReadBegins(words, n) != cones + 1)
    words.Refuse("begins of cones", "as many as there are cones, and the end");
  words.SkipNumbers(cones);
}

void ReadMixed(SiconosWords& words) {
  const bool has_whole = words.Integer("M is given", 0, 1) == 1,
             has_parts = words.Integer("A is given", 0, 1) == 1;
  const int n = words.Count("equations"), m = words.Count("conditions");
  if (n + m == 0 || !(has_whole || has_parts)) words.Refuse("no rows", "some");
  if (has_whole) {
    const int blocks = ReadBegins(words, n + m) - 1;
    for (int k = 0; k < blocks; ++k) words.Integer("the kind of a block", 0, 9);
    SiconosMatrixReader(words).ReadHeader({-1, n + m});
  } else {
    words.SkipNumbers(Multiplied(words, n + m, n + m + 1));
    words.ExpectEnd();
  }
}

void ReadOlderMixed(SiconosWords& words) {
  const int n = words.Count("equations"), m = words.Count("conditions"), rows = words.Count("rows");
  if (m == 0 || rows < n + m) words.Refuse("too few rows", "n + m and more");
  words.SkipNumbers(Multiplied(words, rows, n + m + 1));
  words.ExpectEnd();
}

void ReadGenericMechanical(SiconosWords& words) {
  constexpr int kFriction = 4;  // in space, one contact
  SiconosMatrixReader matrix(words);
  matrix.Read({});
  const bool has_parts = matrix.rows() == matrix.columns() && matrix.block_rows() > 0;
  if (!has_parts) words.Refuse("a matrix", "a square one in blocks");
  words.SkipNumbers(matrix.rows());
  for (int k = 0; k < matrix.block_rows(); ++k) {
    if (words.Integer("the kind of a part", 0, 9) == kFriction) words.SkipNumbers(1);
  }
  words.ExpectEnd();
}

// ---- Kinds that become problems ----------------------------------------------------------------

ExactProblem::Vector ReadVector(SiconosWords& words, int count, const char* name) {
  ExactProblem::Vector numbers(count);
  for (int i = 0; i < count; ++i) numbers[i] = Rational(words.Number(fmt::format("{}[{}]", name, i)));
  return numbers;
}

// Where the numbers end; a remark may stand behind them.
ProblemFile FileOf(const char* format, const std::string& storage, SiconosWords& words) {
  ProblemFile file;
  file.origin.Add({{"format", format}, {"storage", storage}});
  const std::string remark = words.ExpectEnd();
  if (!remark.empty()) file.origin.Add({{"remark", remark}});
  return file;
}

void DropZeros(SparseMatrix& matrix) {
  std::erase_if(matrix, [](const auto& entry) { return entry.second == 0; });
}

// M v = H r + q, u = H'v + b.
ProblemFile ParseGlobalFriction(SiconosWords& words) {
  const int dimension = words.Integer("the dimension", 2, 3), count = words.Count("the number of contacts");
  const int rows = Multiplied(words, dimension, count);
  GlobalEquations equations;
  SiconosMatrixReader M(words, &equations.M);
  M.Read({});
  if (M.rows() != M.columns()) words.Refuse("a matrix M", "a square one");
  SiconosMatrixReader(words, &equations.B).Read({M.rows(), rows});
  DropZeros(equations.M);
  DropZeros(equations.B);
  equations.f = ReadVector(words, M.rows(), "q");
  equations.w = ReadVector(words, rows, "b");
  const ExactProblem::Vector mu = ReadVector(words, count, "mu");
  std::vector<Contact<Rational>> contacts;
  for (int i = 0; i < count; ++i) {
    if (mu[i] < 0) words.Refuse(ToString(mu[i]), fmt::format("mu[{}], a number >= 0", i));
    contacts.push_back({ContactKind::kStatic, mu[i], {}});
  }
  ProblemFile file = FileOf("siconos-gfc", M.storage(), words);
  const auto made = Condense(equations, dimension, std::move(contacts), file);
  if (const int* row = std::get_if<int>(&made))
    words.Refuse(fmt::format("an M with a zero pivot in row {}", *row), "a positive definite matrix");
  file.problem = std::get<AnyProblem>(made);
  return file;
}

// Equations are bilateral contacts, conditions are frictionless ones.
void AddRows(ExactEntries& problem, int count, ContactKind kind) {
  problem.contacts.insert(problem.contacts.end(), count, {kind, Rational(0), {}});
}

// A, B, C, D, a, b, row by row: n equations A u + C v + a = 0, then m conditions on v and D u + B v + b.
void ReadParts(SiconosWords& words, int n, int m, ExactEntries& problem) {
  SparseMatrix M;
  const auto block = [&](const char* name, int rows, int columns, int row, int column) {
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < columns; ++j)
        M[{row + i, column + j}] = Rational(words.Number(fmt::format("{}[{}, {}]", name, i, j)));
    }
  };
  block("A", n, n, 0, 0);
  block("B", m, m, n, n);
  block("C", n, m, 0, n);
  block("D", m, n, n, 0);
  AddRows(problem, n, ContactKind::kBilateral);
  AddRows(problem, m, ContactKind::kFrictionless);
  problem.A = ToEigen(M, n + m, n + m);
  problem.b = ReadVector(words, n + m, "a, b");
}

ProblemFile ParseMixed(SiconosWords& words) {
  ExactEntries problem;
  const bool has_whole = words.Integer("M is given", 0, 1) == 1;
  const bool has_parts = words.Integer("A is given", 0, 1) == 1;
  const int n = words.Count("equations"), m = words.Count("conditions"), rows = n + m;
  std::string storage = "parts";
  if (has_whole) {
    std::vector<int> begins = {words.Integer("a begin", 0, 0)};
    while (begins.back() < rows) begins.push_back(words.Integer("a begin", begins.back() + 1, rows));
    for (std::size_t k = 1; k < begins.size(); ++k) {
      const bool is_condition = words.Integer("the kind of a block, 0: equations, 1: conditions", 0, 1) == 1;
      AddRows(problem, begins[k] - begins[k - 1],
              is_condition ? ContactKind::kFrictionless : ContactKind::kBilateral);
    }
    SparseMatrix entries;
    SiconosMatrixReader M(words, &entries);
    M.Read({rows, rows});
    problem.A = ToEigen(entries, rows, rows);
    storage = M.storage();
    problem.b = ReadVector(words, rows, "q");
    if (has_parts) words.SkipNumbers(Multiplied(words, rows, rows + 1));  // A, B, C, D, a, b: the same numbers
  } else {
    ReadParts(words, n, m, problem);
  }
  ProblemFile file = FileOf("siconos-mlcp", storage, words);
  file.problem = std::move(problem);
  return file;
}

ProblemFile ParseOlderMixed(SiconosWords& words) {
  ExactEntries problem;
  const int n = words.Count("equations"), m = words.Count("conditions");
  words.Integer("the number of rows", n + m, n + m);
  ReadParts(words, n, m, problem);
  ProblemFile file = FileOf("siconos-mlcp", "parts", words);
  file.problem = std::move(problem);
  return file;
}

// A kind stands before those that would take its files, too.
constexpr std::array kOtherKinds = {
    OtherKind{"a mixed linear complementarity problem (MLCP: storages, n, m, blocks, matrices, vectors)",
              &ReadMixed, &ParseMixed},
    OtherKind{"a generic mechanical problem (GMP: matrix, q, kinds of its parts)", &ReadGenericMechanical},
    OtherKind{"a second-order cone complementarity problem (SOCLCP: n, cones, matrix, q, their rows, mu)",
              &ReadSecondOrderCones},
    OtherKind{"a global rolling friction problem (dimension 5, contacts, M, H, q, b, mu, mu_r)",
              &ReadGlobalRolling},
    OtherKind{"a rolling friction problem (dimension 5, contacts, matrix, q, mu, mu_r)", &ReadRolling},
    OtherKind{"a plasticity problem (dimension, cones, model, matrix, q, coefficients)", &ReadPlasticity},
    OtherKind{"a cohesive friction problem (dimension, contacts, cohesive points, matrix, ...)", &ReadCohesive},
    OtherKind{"a global friction problem (dimension, contacts, M, H, q, b, mu)", &ReadGlobalFriction,
              &ParseGlobalFriction},
    OtherKind{
        "a problem with two coefficients a contact: rolling friction in the plane (mu, mu_r) or plasticity "
        "(eta, theta)",
        &ReadTwoCoefficients},
    OtherKind{"a relay problem (n, matrix, q, lower bounds, upper bounds)", &ReadRelay},
    OtherKind{"a mixed linear complementarity problem (MLCP: n, m, rows, numbers)", &ReadOlderMixed,
              &ParseOlderMixed},
};

bool IsOfKind(const std::string& text, const OtherKind& kind) {
  static const std::string source;
  SiconosWords words(text, source);
  try {
    kind.read(words);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

const OtherKind* FindOtherKind(const std::string& text) {
  const auto kind = std::find_if(kOtherKinds.begin(), kOtherKinds.end(),
                                 [&text](const OtherKind& k) { return IsOfKind(text, k); });
  return kind == kOtherKinds.end() ? nullptr : &*kind;
}

}  // namespace

std::string OtherSiconosKind(const std::string& text) {
  const OtherKind* kind = FindOtherKind(text);
  return kind == nullptr ? "" : std::string(kind->name);
}

std::optional<ProblemFile> ParseOtherSiconos(const std::string& text, const std::string& source) {
  const OtherKind* kind = FindOtherKind(text);
  if (kind == nullptr || kind->parse == nullptr) return std::nullopt;
  SiconosWords words(text, source);
  try {
    return kind->parse(words);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; the file is {}", error.what(), kind->name));
  }
}

}  // namespace stiction
