// SPDX-License-Identifier: Apache-2.0
// Which violated variable is driven next, and which limiting one is given up: rules that do not depend on what
// the variables are, shared by the plane and by space (readings.md, 2 and 3).
//
// A variable is named by its row: the normal row of its contact, or the row after it for the friction.
//   violated(row)      whether the conditions of the variable fail
//   worse(row, other)  of two violated normals, or two violated frictions: whether `row` fails by more

#pragma once

#include "solver/problem/options.h"

namespace stiction {

// Goes round the contacts from `first` in steps of `stride` (1 upward, contacts - 1 downward).
template <class Layout, class Violated>
int PickInOrder(const Layout& layout, bool normals, bool frictions, int first, int stride,
                const Violated& violated) {
  const int contacts = layout.ContactCount();
  for (int k = 0, contact = first; k < contacts; ++k, contact = (contact + stride) % contacts) {
    const int row = layout.NormalRowOf(contact);
    if (normals && violated(row)) return row;
    if (frictions && layout.HasFriction(row) && violated(row + 1)) return row + 1;
  }
  return -1;
}

template <class Layout, class Violated, class Worse>
int PickMostViolated(const Layout& layout, const Violated& violated, const Worse& worse) {
  int normal = -1, friction = -1;
  for (int contact = 0; contact < layout.ContactCount(); ++contact) {
    const int row = layout.NormalRowOf(contact);
    if (violated(row) && (normal < 0 || worse(row, normal))) normal = row;
    if (!layout.HasFriction(row) || !violated(row + 1)) continue;
    if (friction < 0 || worse(row + 1, friction)) friction = row + 1;
  }
  return normal >= 0 ? normal : friction;
}

// The row of the variable to drive next, -1 if no condition is violated. `last_driven`: contact, -1 for none.
template <class Layout, class Violated, class Worse>
int PickViolated(const Layout& layout, Scan scan, Resume resume, int last_driven, const Violated& violated,
                 const Worse& worse) {
  const int contacts = layout.ContactCount();
  const bool round = resume == Resume::kRound && last_driven >= 0;
  const int first = round ? last_driven : scan == Scan::kHighest ? contacts - 1 : 0;
  switch (scan) {
    case Scan::kLowest:
      return PickInOrder(layout, true, true, first, 1, violated);
    case Scan::kHighest:
      return PickInOrder(layout, true, true, first, contacts - 1, violated);
    case Scan::kNormalsFirst: {
      const int normal = PickInOrder(layout, true, false, first, 1, violated);
      return normal >= 0 ? normal : PickInOrder(layout, false, true, first, 1, violated);
    }
    case Scan::kMostViolated:
      return PickMostViolated(layout, violated, worse);
  }
  return -1;
}

// Whether a limiting variable is given up (5.5). `wants_back`: into the set that it just left; `zero`,
// `last_zero`: whether this step, and the step before it in this drive, have length zero.
inline bool GivesUp(GiveUp rule, bool wants_back, bool zero, bool last_zero) {
  if (!wants_back) return false;
  switch (rule) {
    case GiveUp::kFirst:
      return zero;
    case GiveUp::kPrevious:
      return last_zero;
    case GiveUp::kSecond:
      return zero && last_zero;
  }
  return false;
}

}  // namespace stiction
