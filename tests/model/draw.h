// SPDX-License-Identifier: Apache-2.0
// What the model tester begins with: small problems where methods are in doubt, and scenes, from choices alone.
//
// Bodies have few velocities with fractions, so that ranks are low and rounding changes the problem; there are
// jams, zeros, rows without an own acceleration, contacts of every kind, units far apart, b outside the range
// of A, and A that is unsymmetric or indefinite.

#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "certify/exact/properties.h"
#include "corpus/record/factors.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"
#include "search/generators/choices.h"
#include "search/generators/scenes.h"

namespace stiction::testing {

struct Case {
  ExactProblem problem = {};
  std::optional<ExactFactors> factors = {};  // of the problem
  std::optional<SceneFile> scene = {};       // whose full model it is
};

// One in so many.
inline bool OneIn(Choices& choices, int many) { return choices.Integer(0, many - 1) == many - 1; }

inline Rational DrawFraction(Choices& choices, int most) {
  Rational x(choices.Integer(-most, most));
  if (!OneIn(choices, 3)) x /= choices.Integer(1, 13);
  return x;
}

inline std::vector<Contact<Rational>> DrawContacts(Choices& choices, int dimension, int most) {
  static const Rational kMu[] = {0, Rational(1, 3), Rational(1, 2), 1, 2, 10, Rational(1000000000)};
  std::vector<Contact<Rational>> contacts(choices.Integer(1, most));
  const bool smooth = OneIn(choices, 6);
  for (auto& contact : contacts) {
    contact.kind = smooth ? ContactKind::kFrictionless : static_cast<ContactKind>(choices.Integer(0, 3));
    if (!contact.HasFrictionRows()) continue;
    contact.mu = kMu[choices.Integer(0, 6)];
    if (contact.kind != ContactKind::kSliding) continue;
    if (dimension == 2) {
      contact.slip[0] = choices.Integer(0, 1) == 0 ? 1 : -1;
    } else {
      contact.slip = {Rational(3, 5), Rational(4 - 8 * choices.Integer(0, 1), 5)};
    }
  }
  return contacts;
}

// Masses of so many velocities: mostly one, or a block of two that feel each other.
inline std::vector<ExactMatrix> DrawMasses(Choices& choices, int velocities) {
  std::vector<ExactMatrix> M;
  const bool ones = choices.Integer(0, 1) == 0;
  for (int j = 0; j < velocities; ++j) {
    M.push_back(ExactMatrix::Constant(1, 1, ones ? Rational(1) : Rational(choices.Integer(1, 9)) / 2));
    if (ones || j + 1 == velocities || !OneIn(choices, 4)) continue;
    M.back().resize(2, 2);
    M.back() << 2, 1, 1, 3;
    ++j;
  }
  return M;
}

inline Case DrawProblem(Choices& choices, int dimension, int most_contacts) {
  std::vector<Contact<Rational>> contacts = DrawContacts(choices, dimension, most_contacts);
  const int rows = RowCount(contacts, dimension);
  const int columns = static_cast<int>(OneIn(choices, 4) ? 1 : choices.Integer(1, rows));
  ExactMatrix J(rows, columns);
  FactorParts parts;
  parts.w.resize(columns);
  for (int j = 0; j < columns; ++j) {
    parts.w[j] = DrawFraction(choices, 9);
    for (int i = 0; i < rows; ++i) J(i, j) = OneIn(choices, 4) ? Rational(0) : DrawFraction(choices, 3);
  }
  parts.M = DrawMasses(choices, columns);
  parts.c = ExactVector::Constant(rows, Rational(0));
  const auto change = choices.Integer(0, 7);
  const int row = static_cast<int>(choices.Integer(0, rows - 1));
  if (change == 1) parts.c[row] = DrawFraction(choices, 2);  // outside the range of A
  if (change == 2 && (contacts.size() == 1 || rows == static_cast<int>(contacts.size())))
    J.row(row) /= Rational(choices.Integer(1, 1000000));  // other units, far apart
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j)
      if (J(i, j) != 0) parts.J[{i, j}] = J(i, j);
  }
  Case drawn;
  drawn.factors = MakeFactors(dimension, std::move(contacts), std::move(parts)).value();
  drawn.problem = DenseOf(*drawn.factors);
  if (change == 3) {  // unsymmetric, perhaps indefinite
    drawn.problem.A(row, choices.Integer(0, rows - 1)) += DrawFraction(choices, 2);
    drawn.factors.reset();
  }
  return drawn;
}

// As a search draws them.
inline Case DrawGenerated(Choices& choices) {
  const auto id = static_cast<GeneratorId>(choices.Integer(0, kGeneratorCount - 1));
  const bool many = OneIn(choices, 8) && !Row(id).InSpace();
  const int contacts =
      static_cast<int>(many ? choices.Integer(4, 8) : choices.Integer(1, Row(id).InSpace() ? 2 : 3));
  Case drawn;
  Generate(id, contacts, kDefaultPalette, choices, drawn.problem);
  return drawn;
}

inline SceneModel<Rational> FullModel(const Scene<Rational>& scene) {
  return Assemble(scene, FindContacts(scene), Level::kForces, /*minimal=*/false);
}

inline Case DrawScene(Choices& choices) {
  static constexpr std::array<MuChoice, 4> kPalette = {{{1, 5}, {1, 3}, {1, 1}, {2, 1}}};
  const GeneratorId id = choices.Integer(0, 1) == 0 ? GeneratorId::kScenes : GeneratorId::kFineScenes;
  const int contacts = static_cast<int>(choices.Integer(1, 3));
  Case drawn;
  drawn.scene.emplace();
  drawn.scene->scene = GenerateScene(id, contacts, kPalette, choices).value();
  const SceneModel<Rational> model = FullModel(drawn.scene->scene);
  drawn.problem = model.Problem(0);
  drawn.factors = model.InFactors(0);
  return drawn;
}

}  // namespace stiction::testing
