// SPDX-License-Identifier: Apache-2.0
// The table of generators, and what all of them do.

#include "search/generators/generators.h"

#include "corpus/named_rows.h"
#include "search/generators/drawing.h"
#include "search/generators/generator.h"
#include "solver/problem/check.h"

namespace stiction {
namespace generators {
namespace {

const std::array<Generator, kGeneratorCount>& All() {
#define STICTION_MAKE_GENERATOR(name) Make##name(),
  static const std::array<Generator, kGeneratorCount> all = {STICTION_GENERATORS(STICTION_MAKE_GENERATOR)};
#undef STICTION_MAKE_GENERATOR
  return all;
}

// The number in the palette of the coefficient that all contacts with friction have.
template <class Scalar, int Rows>
int CommonFriction(std::span<const MuChoice> palette, const std::array<MuChoice, kMaxContacts>& chosen,
                   const ContactProblem<Scalar, Rows>& problem) {
  int first = -1;
  for (int i = 0; i < static_cast<int>(problem.contacts.size()); ++i) {
    const Contact<Scalar>& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral) continue;
    if (first < 0) first = i;
    if (contact.mu != problem.contacts[first].mu) return Drawn::kMixed;
  }
  if (first < 0) return Drawn::kMixed;
  return static_cast<int>(std::find(palette.begin(), palette.end(), chosen[first]) - palette.begin());
}

}  // namespace
}  // namespace generators

const std::array<GeneratorRow, kGeneratorCount>& Generators() {
  static const auto rows = [] {
    std::array<GeneratorRow, kGeneratorCount> made;
    for (int i = 0; i < kGeneratorCount; ++i) {
      made[i] = generators::All()[i].row;
      made[i].id = static_cast<GeneratorId>(i);
    }
    return made;
  }();
  return rows;
}

std::optional<GeneratorId> FindGenerator(std::string_view name) {
  const GeneratorRow* const row = RowNamed(Generators(), name);
  return row == nullptr ? std::nullopt : std::optional(row->id);
}

template <class Scalar, int Rows>
Drawn Generate(GeneratorId id, int contacts, const Surroundings& surroundings, Choices& choices,
               ContactProblem<Scalar, Rows>& problem) {
  const generators::Generator& generator = generators::All()[static_cast<std::size_t>(id)];
  const auto fill = std::get<generators::Filling<Scalar, Rows>>(generator.fill);
  STICTION_CHECK(contacts >= 1 && contacts <= kMaxContacts, "generators make 1 to 8 contacts");
  STICTION_CHECK(Rows == Eigen::Dynamic || Rows == 2 * contacts, "two rows per contact");
  STICTION_CHECK(fill != nullptr, "fixed sizes hold static contacts of the plane only");
  STICTION_CHECK(!surroundings.palette.empty(), "a palette has at least one friction coefficient");
  STICTION_CHECK(!surroundings.gravity_only || generator.row.has_gravity, "gravity is for bodies");
  generators::Resize(contacts, generator.row.dimension, problem);
  const generators::Given given = {generators::DrawFriction(surroundings.palette, choices, problem),
                                   surroundings.gravity_only};
  const int columns = fill(given, choices, problem);
  return {generators::CommonFriction(surroundings.palette, given.mu, problem),
          std::min(columns, problem.rows())};
}

#define STICTION_INSTANTIATE_GENERATE(Scalar, Rows)                                      \
  template Drawn Generate<Scalar, Rows>(GeneratorId, int, const Surroundings&, Choices&, \
                                        ContactProblem<Scalar, Rows>&)

STICTION_INSTANTIATE_GENERATE(double, 2);
STICTION_INSTANTIATE_GENERATE(double, 4);
STICTION_INSTANTIATE_GENERATE(double, 6);
STICTION_INSTANTIATE_GENERATE(double, 8);
STICTION_INSTANTIATE_GENERATE(double, 10);
STICTION_INSTANTIATE_GENERATE(double, 12);
STICTION_INSTANTIATE_GENERATE(double, 14);
STICTION_INSTANTIATE_GENERATE(double, 16);
STICTION_INSTANTIATE_GENERATE(double, Eigen::Dynamic);
STICTION_INSTANTIATE_GENERATE(Rational, Eigen::Dynamic);

#undef STICTION_INSTANTIATE_GENERATE

}  // namespace stiction
