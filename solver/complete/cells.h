// SPDX-License-Identifier: Apache-2.0
// Cells: the law of a finished contact is a union of convex cones, and in each of them all is linear.
//
// Friction is limited by mu fN times a polygon with corners d_k, edges t_k and outer normals n_k (polygon.h);
// in the plane by a segment, whose corners +1 and -1 are their own normals.
//
//   law      plane  space
//   kBreak     B      B    f = 0, aN >= 0
//   kCorner   + -     Vk   aN = 0, fN >= 0, fF = mu fN d_k, opposed to aF: aF.t_k >= 0 >= aF.t_(k-1),
//                          or in the plane aF d_k <= 0
//   kEdge             Ek   aN = 0, fF between mu fN d_k and mu fN d_(k+1), aF = -c n_k, c >= 0
//   kInside    S      I    aN = aF = 0, fF in mu fN times the polygon
//   kFree      0      0    aN = 0, fN >= 0, fF = -mu fN slip: no friction, mu = 0, or sliding (24)
//   kHold      H      H    aN = 0, fN of any sign: bilateral

#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solver/problem/index_sets.h"

namespace stiction {

enum class Law : std::uint8_t { kNone, kHold, kBreak, kFree, kCorner, kEdge, kInside };

struct LawCell {
  Law law = Law::kNone;
  int side = 0;  // k of a corner or an edge; 1 of a bilateral contact that depends on those before it

  auto operator<=>(const LawCell&) const = default;
};

using CellWord = std::vector<LawCell>;  // one cell per contact

inline std::string Name(const LawCell& cell, int dimension) {
  constexpr std::array<char, 7> kPlane = {'?', 'H', 'B', '0', '+', '?', 'S'};
  constexpr std::array<char, 7> kSpace = {'?', 'H', 'B', '0', 'V', 'E', 'I'};
  const int law = static_cast<int>(cell.law);
  if (dimension == 2) return {cell.law == Law::kCorner && cell.side == 1 ? '-' : kPlane[law]};
  const bool has_side = cell.law == Law::kCorner || cell.law == Law::kEdge;
  return kSpace[law] + (has_side ? std::to_string(cell.side) : std::string());
}

// The names of the cells, with blanks between them.
inline std::string Name(const CellWord& word, int dimension) {
  std::string text;
  for (const LawCell& cell : word) text += (text.empty() ? "" : " ") + Name(cell, dimension);
  return text;
}

// The cells of the plane as one value each.
enum class Cell : std::uint8_t { kNone, kBreak, kStick, kUpper, kLower, kFree };

inline constexpr char Name(Cell cell) {
  constexpr std::array<char, 6> kNames = {'?', 'B', 'S', '+', '-', '0'};
  return kNames[static_cast<int>(cell)];
}

inline Cell PlanarCell(const LawCell& cell) {
  if (cell.law == Law::kBreak) return Cell::kBreak;
  if (cell.law == Law::kInside) return Cell::kStick;
  if (cell.law == Law::kCorner) return cell.side == 0 ? Cell::kUpper : Cell::kLower;
  return cell.law == Law::kFree || cell.law == Law::kHold ? Cell::kFree : Cell::kNone;
}

// The planar cell of a contact whose normal and friction are in these sets.
inline constexpr Cell CellOf(IndexSet normal, IndexSet friction) {
  if (normal != IndexSet::kClamped) return Cell::kBreak;
  if (friction == IndexSet::kSticking) return Cell::kStick;
  if (friction == IndexSet::kAtUpper) return Cell::kUpper;
  return friction == IndexSet::kAtLower ? Cell::kLower : Cell::kFree;
}

// The sets that a planar cell stands for: of the normal, and of its friction.
inline std::array<IndexSet, 2> SetsOf(const LawCell& cell) {
  switch (cell.law) {
    case Law::kNone:
      return {IndexSet::kNone, IndexSet::kNone};
    case Law::kBreak:
      return {IndexSet::kSeparating, IndexSet::kSuspended};
    case Law::kCorner:
      return {IndexSet::kClamped, cell.side == 0 ? IndexSet::kAtUpper : IndexSet::kAtLower};
    case Law::kInside:
      return {IndexSet::kClamped, IndexSet::kSticking};
    default:
      return {IndexSet::kClamped, IndexSet::kSuspended};
  }
}

// What is behind a facet: the cell that it names; a corner, by the sign of aF; or an end of the stage, at which
// the contact is in the cell that it names.
enum class Beyond : std::uint8_t { kCell, kCorners, kStart, kEnd };

// A linear function of (f, a, rho) that is not negative in a cell or stage, and zero on one of its facets.
struct Facet {
  enum class Kind : std::uint8_t {
    kForce,         // fN
    kAcceleration,  // sign aN
    kOpposed,       // -aF.n_k
    kAlong,         // sign aF.t_k
    kFromCorner,    // d_k x fF: the share of the corner k + 1
    kToCorner,      // fF x d_(k+1): the share of the corner k
    kBound,         // mu fN h_k - fF.n_k, or with rho for mu fN
    kSide,          // fF.n_k: asked for its sign only
    kRadius,        // rho
    kRest,          // mu fN - rho
  };
  Kind kind;
  Beyond beyond;
  int contact;
  int k;
  int sign;
  LawCell cell;

  Facet(Kind kind, int contact, int k = 0, int sign = 1, Beyond beyond = Beyond::kCell, LawCell cell = {})
      : kind(kind), beyond(beyond), contact(contact), k(k), sign(sign), cell(cell) {}

  bool OfAcceleration() const {
    return kind == Kind::kAcceleration || kind == Kind::kOpposed || kind == Kind::kAlong;
  }
  bool OfNormal() const { return kind == Kind::kForce || kind == Kind::kAcceleration; }
};

// A kind that is known where the program is compiled.
template <Facet::Kind kind>
using KindIs = std::integral_constant<Facet::Kind, kind>;

}  // namespace stiction
