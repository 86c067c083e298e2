// SPDX-License-Identifier: Apache-2.0
// Generators: random problems that satisfy the paper's hypotheses, most of them
// planar and of static contacts.
//
// Every generator makes a matrix J and sets A = J W J', symmetric and positive semidefinite, and b = J y,
// or b = A x, in range(A): range(J W J') = range(J) for a diagonal W > 0. This is exact by construction,
// not to a tolerance. One template serves all scalars: the same choices give the exact problem over
// rationals and the filter problem over doubles, to the bit on every machine, since only + - * / in a
// fixed order are used (-ffp-contract=off).
//
// Shapes      rows = 2 contacts: the normal of a contact and then its friction; of a bilateral contact its
//             normal alone; in space the normal and two rows of friction. J: rows x columns.
// Requires    1 <= contacts <= kMaxContacts; contacts = Rows / 2 where Rows is fixed, which is for static
//             contacts of the plane only; a palette that is
//             not empty, of coefficients with 0 <= numerator <= most and 1 <= denominator <= most, where most
//             is Row(id).most_mu_part; gravity_only only where the generator has gravity.
// Cost        fixed Rows over floating-point scalars: no allocation. Eigen::Dynamic resizes.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "search/generators/choices.h"
#include "search/generators/list.h"
#include "solver/problem/problem.h"

namespace stiction {

inline constexpr int kMaxContacts = 8;

// A friction coefficient, numerator / denominator. It is an exact double if the denominator is a power of
// two.
struct MuChoice {
  int numerator = 0;
  int denominator = 1;

  bool operator==(const MuChoice&) const = default;
};

// All exact doubles.
inline constexpr std::array<MuChoice, 5> kDefaultPalette = {{{1, 4}, {1, 2}, {1, 1}, {2, 1}, {5, 1}}};

#define STICTION_GENERATOR_ID(name) k##name,
enum class GeneratorId : std::uint8_t { STICTION_GENERATORS(STICTION_GENERATOR_ID) };
#undef STICTION_GENERATOR_ID

#define STICTION_ONE_GENERATOR(name) +1
inline constexpr int kGeneratorCount = STICTION_GENERATORS(STICTION_ONE_GENERATOR);
#undef STICTION_ONE_GENERATOR
// Of these the first are part of a campaign that names none.
inline constexpr int kOrdinaryGeneratorCount = static_cast<int>(GeneratorId::kScenes) + 1;

struct GeneratorRow {
  GeneratorId id = {};                 // by the list
  std::string_view name = {};          // on the command line
  std::string_view distribution = {};  // friction coefficients apart: see Generate
  // Whether the double problem is the rational problem, given a palette of exact doubles. Otherwise the
  // double problem is a filter: what it shows must be seen again over rationals.
  bool exact_in_double = false;
  bool has_gravity = false;  // bodies, which `gravity_only` leaves without applied forces
  // Of some contacts; with sliding ones there may be no solution.
  ContactKind other_kind = ContactKind::kStatic;
  int dimension = 2;
  // Numerators and denominators of friction coefficients are at most this: exactness has bounds.
  int most_mu_part = std::numeric_limits<int>::max();

  constexpr bool HasOtherKinds() const { return other_kind != ContactKind::kStatic; }
  constexpr bool InSpace() const { return dimension == 3; }
  // What most of this suite asks for: static contacts of the plane.
  constexpr bool IsPlain() const { return !HasOtherKinds() && !InSpace(); }
};

// The table, in the order of GeneratorId. A row stands in the file of its generator.
const std::array<GeneratorRow, kGeneratorCount>& Generators();

inline const GeneratorRow& Row(GeneratorId id) { return Generators()[static_cast<int>(id)]; }

// The largest part of a friction coefficient that optimizers make.
inline int LargestMuPart(GeneratorId id) { return std::min(Row(id).most_mu_part, 1'000'000); }

// What all problems of a generator share.
struct Surroundings {
  // From anything that holds coefficients; it must outlive this.
  template <class Palette>
  Surroundings(const Palette& coefficients, bool only_gravity = false)  // NOLINT: a palette is most of it
      : palette(coefficients), gravity_only(only_gravity) {}

  std::span<const MuChoice> palette;
  bool gravity_only = false;  // no applied forces; of generators with `has_gravity`
};

// What is told of a problem beside its numbers, for statistics.
struct Drawn {
  static constexpr int kMixed = -1;
  int friction = kMixed;  // of all contacts, its number in the palette; kMixed where they differ
  int rank = 0;           // what rank(A) is at most: columns of J, and no more than its different rows
};

// Empty if no generator has this name.
std::optional<GeneratorId> FindGenerator(std::string_view name);

// Fills `problem`, whose memory is reused, from `choices`. The friction coefficients are drawn first: one
// of the palette for all contacts with probability 1/2, otherwise one per contact, uniformly; contacts of two
// bodies of `scenes` share that of their first. Scalars: double with Rows fixed or dynamic, Rational dynamic.
template <class Scalar, int Rows>
Drawn Generate(GeneratorId id, int contacts, const Surroundings& surroundings, Choices& choices,
               ContactProblem<Scalar, Rows>& problem);

}  // namespace stiction
