// SPDX-License-Identifier: Apache-2.0
// Errors of forces in lanes: MeasureErrors of solver/problem/errors.h, of the forces alone, operation by
// operation; included once by the file of each instruction set.

#include <limits>

#include "search/lanes/lanes.h"

namespace stiction {
namespace {

template <int Rows>
class LaneErrors {
 public:
  // Of problems i, ..., i + kLanes - 1.
  LaneErrors(const Block<Rows>& block, int i) {
    for (int row = 0; row < Rows; ++row) {
      for (int j = 0; j < Rows; ++j) A_[row][j] = Load(block.A[row][j] + i);
      b_[row] = Load(block.b[row] + i);
      f_[row] = Load(block.f[row] + i);
    }
    for (int contact = 0; contact < kContacts; ++contact) mu_[contact] = Load(block.mu[contact] + i);
  }

  Real Largest() const {
    Real a[Rows], sum[Rows], size[Rows], unit[Rows], force_unit[Rows];
    for (int i = 0; i < Rows; ++i) {
      a[i] = b_[i];
      for (int j = 0; j < Rows; ++j) a[i] += A_[i][j] * f_[j];
      sum[i] = size[i] = All(0);
    }
    for (int j = 0; j < Rows; ++j) {
      const Real own = Abs(A_[j][j]), asked = Select(own > 0, Abs(b_[j]) / own, All(0));
      const Real counts = Max(Abs(f_[j]), asked);
      for (int i = 0; i < Rows; ++i) {
        sum[i] += Abs(A_[i][j]) * counts;
        size[i] += Abs(A_[i][j]) * Abs(f_[j]);
      }
    }
    Mask coupled[kContacts][kContacts];
    Couple(coupled);
    Real least[kContacts];
    for (int contact = 0; contact < kContacts; ++contact) least[contact] = LeastWork(a, size, coupled[contact]);
    for (int i = 0; i < Rows; ++i) {
      const Real own = Abs(A_[i][i]);
      unit[i] = Abs(b_[i]) + Min(sum[i], Root(own * least[i / 2]));
      force_unit[i] = Select(own > 0, unit[i] / own, All(0));
    }
    Real error = All(0);
    for (int contact = 0; contact < kContacts; ++contact)
      error = Max(error, ErrorOfContact(contact, a, unit, force_unit));
    return error;
  }

 private:
  static constexpr int kContacts = Rows / 2;

  // Which contacts are of one group (units.h).
  void Couple(Mask (&coupled)[kContacts][kContacts]) const {
    for (int m = 0; m < kContacts; ++m) {
      coupled[m][m] = ~Never();
      for (int n = 0; n < m; ++n) {
        Mask touch = Never();
        for (int i = 2 * m; i < 2 * m + 2; ++i) {
          for (int j = 2 * n; j < 2 * n + 2; ++j) touch |= (A_[i][j] != 0) | (A_[j][i] != 0);
        }
        coupled[m][n] = coupled[n][m] = touch;
      }
    }
    for (int through = 0; through < kContacts; ++through) {
      for (int m = 0; m < kContacts; ++m) {
        for (int n = 0; n < kContacts; ++n) coupled[m][n] |= coupled[m][through] & coupled[through][n];
      }
    }
  }

  // Of the contacts in `group`. What is added for others is a zero, which leaves a sum as it is.
  Real LeastWork(const Real (&a)[Rows], const Real (&size)[Rows], const Mask (&group)[kContacts]) const {
    const Real rounding = All(4 * (Rows + 2) * std::numeric_limits<double>::epsilon() / 2);
    Real done = All(0), free = All(0), error = All(0);
    for (int i = 0; i < Rows; ++i) {
      const Real f = Select(group[i / 2], f_[i], All(0));
      done += f * (a[i] - b_[i]);
      free += f * b_[i];
      error += rounding * Abs(f) * (size[i] + Abs(b_[i]));
    }
    return Max(All(0), Min(Abs(done), Abs(free)) - error);
  }

  Real ErrorOfContact(int contact, const Real (&a)[Rows], const Real (&unit)[Rows],
                      const Real (&force_unit)[Rows]) const {
    const int n = 2 * contact, t = n + 1;
    const Real zero = All(0), speed = Abs(a[t]);
    const Real limit = Select(f_[n] > 0, mu_[contact] * f_[n], zero);
    const Real wide = Select(force_unit[n] > 0, mu_[contact] * force_unit[n], zero);
    const Real friction_unit = Max(force_unit[t], wide);
    Real open = InUnits(Max(zero, -a[n]), unit[n]);
    open = Max(open, InUnits(Abs(f_[n]), force_unit[n]));
    open = Max(open, InUnits(Abs(f_[t]), force_unit[t]));
    Real closed = InUnits(Abs(a[n]), unit[n]);
    closed = Max(closed, InUnits(Max(zero, -f_[n]), force_unit[n]));
    const Real sticks = Max(InUnits(speed, unit[t]), InUnits(Max(zero, Abs(f_[t]) - limit), friction_unit));
    const Real slips =
        Select(speed > 0, InUnits(Abs(f_[t] + limit * (a[t] / speed)), friction_unit), Infinite());
    return Min(open, Max(closed, Min(sticks, slips)));
  }

  static Real Infinite() { return All(0) + std::numeric_limits<double>::infinity(); }
  static Real InUnits(Real x, Real unit) {
    const Real quotient = Select((unit > 0) & (x < Infinite()), x / unit, Infinite());
    return Select(x == 0, All(0), quotient);
  }
  static Real Root(Real x) {
    Real root;
    for (int lane = 0; lane < kLanes; ++lane) root[lane] = __builtin_sqrt(x[lane]);
    return root;
  }

  Real A_[Rows][Rows], b_[Rows], mu_[kContacts], f_[Rows];
};

template <int Rows>
void MeasureErrorsOf(Block<Rows>& block, int count) {
  for (int i = 0; i < count; i += kLanes) Store(LaneErrors<Rows>(block, i).Largest(), block.error + i);
}

}  // namespace
}  // namespace stiction
