// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/siconos_kinds.h"

#include <array>
#include <string_view>
#include <utility>

#include "corpus/formats/siconos_words.h"

namespace stiction {
namespace {

// One kind; `read` throws InputError where the text is not of it.
struct OtherKind {
  std::string_view name;
  void (*read)(SiconosWords& words);
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

// A kind stands before those that would take its files, too.
constexpr std::array kOtherKinds = {
    OtherKind{"a mixed linear complementarity problem (MLCP: storages, n, m, blocks, matrices, vectors)",
              &ReadMixed},
    OtherKind{"a generic mechanical problem (GMP: matrix, q, kinds of its parts)", &ReadGenericMechanical},
    OtherKind{"a second-order cone complementarity problem (SOCLCP: n, cones, matrix, q, their rows, mu)",
              &ReadSecondOrderCones},
    OtherKind{"a global rolling friction problem (dimension 5, contacts, M, H, q, b, mu, mu_r)",
              &ReadGlobalRolling},
    OtherKind{"a rolling friction problem (dimension 5, contacts, matrix, q, mu, mu_r)", &ReadRolling},
    OtherKind{"a plasticity problem (dimension, cones, model, matrix, q, coefficients)", &ReadPlasticity},
    OtherKind{"a cohesive friction problem (dimension, contacts, cohesive points, matrix, ...)", &ReadCohesive},
    OtherKind{"a global friction problem (dimension, contacts, M, H, q, b, mu)", &ReadGlobalFriction},
    OtherKind{
        "a problem with two coefficients a contact: rolling friction in the plane (mu, mu_r) or plasticity "
        "(eta, theta)",
        &ReadTwoCoefficients},
    OtherKind{"a relay problem (n, matrix, q, lower bounds, upper bounds)", &ReadRelay},
    OtherKind{"a mixed linear complementarity problem (MLCP: n, m, rows, numbers)", &ReadOlderMixed},
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

}  // namespace

std::string OtherSiconosKind(const std::string& text) {
  for (const OtherKind& kind : kOtherKinds) {
    if (IsOfKind(text, kind)) return std::string(kind.name);
  }
  return "";
}

}  // namespace stiction
