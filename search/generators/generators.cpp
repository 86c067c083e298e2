// SPDX-License-Identifier: Apache-2.0
// The table of generators, and the generators over doubles and rationals.

#include "search/generators/generators.ipp"

#include <algorithm>

#include "corpus/rational.h"

namespace stiction {

const std::array<GeneratorRow, kGeneratorCount>& Generators() {
  using enum GeneratorId;
  static constexpr std::array<GeneratorRow, kGeneratorCount> kRows = {{
      {kIntegers, "integers",
       "J of integers in [-5, 5], its number of columns uniform in 1..2n; A = J J', and b = J y or b = A x "
       "with integers in [-5, 5].",
       true},
      {kPsd, "psd",
       "J of multiples of 2^-15 in [-1, 1), its number of columns uniform in 1..2n; A = J J', b = A x with "
       "multiples of 2^-11 in [-1, 1).",
       true},
      {kSmall, "small",
       "J of integers in [-2, 2], zero with probability 5/9, its number of columns uniform in 1..2n; A = "
       "J J', b = J y with integers in [-2, 2].",
       true},
      {kNearDegenerate, "near-degenerate",
       "J = 2^k [C 0] + N with integers in [-3, 3] and k in 2..16, so that its rows are nearly dependent; A "
       "= J J', b = -A f0 + J e where every contact of f0 is open, at a friction limit or inside, and e is 0 "
       "(probability 1/4) or of integers in [-1, 1].",
       true},
      {kDuplicates, "duplicates",
       "As integers, but one contact for certain, and each other with probability 1/4, is a copy of an "
       "earlier one, its tangent reversed with probability 1/2; a single contact has no copy.",
       true},
      {kConditioned, "conditioned",
       "J = U diag(sigma) rounded to double, U orthogonal, sigma geometric from 1 to 10^-k with k in 0..8; "
       "full rank with probability 1/2, otherwise of rank uniform in 1..2n-1; A = J J', b = J y with "
       "integers in [-5, 5].",
       false},
      {kBodies, "bodies",
       "1 to 3 planar rigid bodies at rest and the world, joined at n points: rational masses, inertias, "
       "points and unit normals (Pythagorean), under gravity, applied forces or both; A = J M^-1 J', b = J "
       "M^-1 F. Overlap of shapes is not modelled.",
       false, true},
      {kExponential, "exponential",
       "The normals are the family on which n contacts without friction take 2^n - 1 pivots: J = L', ones on "
       "the diagonal and 2 above, b = (8^(i-n-1) - 1). Every friction row has a column of its own, or, with "
       "probability 1/2, a number of them uniform in 0..n have none; b of it is J y, y of multiples of 1/4 in "
       "[-1, 1]. With probability 1/2 each: the rows of contact i times 4^(n-i); contacts in random order; "
       "entries of J moved by multiples of 2^-k in [-2^-k, 2^-k], k in 8..20; friction coupled to the "
       "normals' columns by multiples of 2^-k in [-2^-k, 2^-k], k in 0..8. A = J J'.",
       true},
      {kScenes, "scenes",
       "1 to 3 planar bodies at rest that touch and do not overlap: convex polygons of uniform density, with "
       "rational coordinates and Pythagorean normals, on a floor, between walls (all up to 37 degrees off), "
       "on, "
       "beside and wedged between each other, under gravity and, with probability 1/2, applied forces and "
       "moments; every body has a contact, and one at least is on the floor. A = J M^-1 J', b = J M^-1 F. Two "
       "bodies have one friction coefficient. Problem files carry the scene.",
       false, true},
      {kFineScenes, "fine-scenes",
       "As scenes, with numbers of three to four digits for slopes, places, shapes and masses where those have "
       "one or "
       "two: for optimizers. Not part of a campaign that names no generators.",
       false, true},
      {kOneBody, "one-body",
       "One planar rigid body at rest and the world, joined at n points: as bodies, with numbers of four "
       "digits, and any "
       "distribution of mass: mass 1, inertia p/q with p in 1..1000 and q in 1..10^9, so that its centre may "
       "be far from "
       "the points beside its radius of inertia. Not part of a campaign that names no generators.",
       false, true},
      {kBilateral, "bilateral",
       "As integers, but one contact for certain, and each other with probability 1/2, is a bilateral "
       "constraint "
       "(4.5), of one row. Not part of a campaign that names no generators.",
       true, false, ContactKind::kBilateral},
      {kSliding, "sliding",
       "As integers, but one contact for certain, and each other with probability 1/2, slides (section 6), to "
       "either "
       "side: there may be no solution. Not part of a campaign that names no generators.",
       true, false, ContactKind::kSliding},
      {kSpace, "space",
       "Contacts of space, with two rows of friction: J of integers in [-5, 5], its number of columns uniform "
       "in 1..3n; A "
       "= J J', and b = J y or b = A x with integers in [-5, 5]. Run over doubles, what they suspect over "
       "intervals, and "
       "existence by complete driving on polygons, over rationals. Not part of a campaign that names no "
       "generators.",
       true, false, ContactKind::kStatic, 3},
  }};
  return kRows;
}

std::optional<GeneratorId> FindGenerator(std::string_view name) {
  const auto& rows = Generators();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [name](const GeneratorRow& r) { return r.name == name; });
  if (row == rows.end()) return std::nullopt;
  return row->id;
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
