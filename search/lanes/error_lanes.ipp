// SPDX-License-Identifier: Apache-2.0
// Lenient errors of forces in lanes: MeasureLeniently of solver/problem/lenient.h, of the forces alone,
// operation by operation; included once by the file of each instruction set.

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
    Real a[Rows], counted[Rows], size[Rows], unit[Rows], force[Rows];
    for (int i = 0; i < Rows; ++i) {
      a[i] = b_[i];
      for (int j = 0; j < Rows; ++j) a[i] += A_[i][j] * f_[j];
      size[i] = All(0);
    }
    for (int contact = 0; contact < kContacts; ++contact) Count(contact, counted);
    for (int j = 0; j < Rows; ++j) {
      for (int i = 0; i < Rows; ++i) size[i] += Abs(A_[i][j]) * counted[j];
    }
    for (int i = 0; i < Rows; ++i) unit[i] = Abs(b_[i]) + size[i];
    for (int i = 0; i < Rows; ++i) force[i] = ForceUnit(i, unit);
    Real error = All(0);
    for (int contact = 0; contact < kContacts; ++contact)
      error = Max(error, ErrorOfContact(contact, a, size, unit, force));
    return error;
  }

 private:
  static constexpr int kContacts = Rows / 2;

  // What the forces of a contact count.
  void Count(int contact, Real (&counted)[Rows]) const {
    const int n = 2 * contact, t = n + 1;
    const Mask carries = (f_[n] != 0) | (f_[t] != 0);
    for (int i = n; i <= t; ++i) {
      const Real own = Abs(A_[i][i]), asked = Select(own > 0, Abs(b_[i]) / own, All(0));
      counted[i] = Select(carries, Max(Abs(f_[i]), asked), All(0));
    }
    counted[t] = Max(counted[t], counted[n]);
  }

  Real ForceUnit(int j, const Real (&unit)[Rows]) const {
    Real least = Infinite();
    Mask noticed = Never();
    for (int i = 0; i < Rows; ++i) {
      const Real entry = Abs(A_[i][j]);
      least = Select(entry > 0, Min(least, unit[i] / entry), least);
      noticed |= entry > 0;
    }
    const Real own = Abs(A_[j][j]);
    return Select(own > 0, unit[j] / own, Select(noticed, least, All(0)));
  }

  Real ErrorOfContact(int contact, const Real (&a)[Rows], const Real (&size)[Rows], const Real (&unit)[Rows],
                      const Real (&force_unit)[Rows]) const {
    const int n = 2 * contact, t = n + 1;
    const Real zero = All(0), speed = Abs(a[t]), own = Abs(A_[n][n]);
    const Real limit = Select(f_[n] > 0, mu_[contact] * f_[n], zero);
    const Real normal = Max(zero, f_[n]) + Select(own > 0, size[n] / own, zero);
    const Real friction_unit = force_unit[t] + Select(normal > 0, mu_[contact] * normal, zero);
    Real open = InUnits(Max(zero, -a[n]), unit[n]);
    open = Max(open, InUnits(Abs(f_[n]), force_unit[n]));
    open = Max(open, InUnits(Abs(f_[t]), force_unit[t]));
    Real closed = InUnits(Abs(a[n]), unit[n]);
    closed = Max(closed, InUnits(Max(zero, -f_[n]), force_unit[n]));
    const Real sticks = Max(InUnits(speed, unit[t]), InUnits(Max(zero, Abs(f_[t]) - limit), friction_unit));
    const Real slips = Select((speed > 0) & (limit < Infinite()),
                              InUnits(Abs(f_[t] + limit * (a[t] / speed)), friction_unit), Infinite());
    return Min(open, Max(closed, Min(sticks, slips)));
  }

  static Real Infinite() { return All(0) + std::numeric_limits<double>::infinity(); }
  static Real InUnits(Real x, Real unit) {
    const Real quotient = Select((unit > 0) & (x < Infinite()), x / unit, Infinite());
    return Select(x == 0, All(0), quotient);
  }
  Real A_[Rows][Rows], b_[Rows], mu_[kContacts], f_[Rows];
};

template <int Rows>
void MeasureErrorsOf(Block<Rows>& block, int count) {
  for (int i = 0; i < count; i += kLanes) Store(LaneErrors<Rows>(block, i).Largest(), block.error + i);
}

}  // namespace
}  // namespace stiction
