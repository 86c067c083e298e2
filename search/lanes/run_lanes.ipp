// SPDX-License-Identifier: Apache-2.0
// The published algorithm in lanes; included once by the file of each instruction set. Names and order are
// those of solver/published/published.ipp, solver/linear/direction.ipp and solver/published/step_size.ipp,
// which say why; a condition there is a mask here.
//
// Why no state is compared with earlier ones: a drive that gives nothing up puts its variable into a set and
// takes none out of one, so that the sets of a run grow; and inside a drive a variable that goes back to the
// set that it left last, in a step of length zero, is given up, so that no state of it stands twice
// (solver/published/readings.md, 6). Lanes that give up, drive a variable that has a set, or drive a force to
// zero are left.

#include "search/lanes/lanes.h"
#include "solver/problem/index_sets.h"

namespace stiction {
namespace {

constexpr int kMostLaneSteps = 100;  // a lane with more is left

constexpr double Code(IndexSet set) { return static_cast<double>(static_cast<int>(set)); }
constexpr double kNone = Code(IndexSet::kNone), kClamped = Code(IndexSet::kClamped),
                 kSeparating = Code(IndexSet::kSeparating), kSticking = Code(IndexSet::kSticking),
                 kAtLower = Code(IndexSet::kAtLower), kAtUpper = Code(IndexSet::kAtUpper);

template <int Rows>
class LaneRuns {
 public:
  LaneRuns(Block<Rows>& block, int count, const LaneTolerances& tolerances)
      : block_(block), count_(count), tolerances_(tolerances) {
    for (int& number : number_) number = -1;
  }

  void Run() {
    while (true) {
      Scan();
      const unsigned free = BitsOf(~driving_);
      if (free == kEveryLane || (next_ < count_ && __builtin_popcount(free) >= kRefillFrom)) {
        Retire(free);
        if (next_ >= count_ && free == kEveryLane) return;
        Refill(free);
        continue;
      }
      Step();
    }
  }

 private:
  static constexpr int kContacts = Rows / 2;
  static constexpr int kRefillFrom = kLanes / 4;  // lanes without a problem

  // ---- Lanes take problems and give them back ----

  void Retire(unsigned free) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const int i = number_[lane];
      if ((free >> lane & 1u) == 0 || i < 0) continue;
      number_[lane] = -1;
      const auto count = [lane](const Real& x) { return static_cast<std::uint8_t>(x[lane]); };
      block_.ends[i] = {is_left_[lane] != 0, count(drives_),           count(steps_),
                        count(zero_steps_),  count(longest_zero_run_), count(singular_directions_)};
      for (int row = 0; row < Rows; ++row) block_.f[row][i] = f_[row][lane];
    }
  }

  void Refill(unsigned free) {
    Word take = {};
    Word from = {};
    const int first = next_;
    for (int lane = 0; lane < kLanes; ++lane) {
      if ((free >> lane & 1u) == 0 || next_ >= count_) continue;
      take[lane] = ~std::uint64_t{0};
      from[lane] = static_cast<std::uint64_t>(next_ - first);
      number_[lane] = next_++;
    }
    const Mask fresh = (Mask)take;
    const auto load = [&](Real& x, const double* numbers) {
      x = Select(fresh, Spread(Load(numbers + first), from), x);
    };
    for (int i = 0; i < Rows; ++i) {
      for (int j = 0; j < Rows; ++j) load(A_[i][j], block_.A[i][j]);
      load(b_[i], block_.b[i]);
    }
    for (int contact = 0; contact < kContacts; ++contact) load(mu_[contact], block_.mu[contact]);
    Start(fresh);
  }

  // Lane i receives x[from[i]].
  static Real Spread(Real x, Word from) {
#if defined(__clang__)
    Real spread;
    for (int i = 0; i < kLanes; ++i) spread[i] = x[from[i]];
    return spread;
#else
    return __builtin_shuffle(x, from);
#endif
  }

  void Start(Mask fresh) {
    Real b = Abs(b_[0]), A = Abs(A_[0][0]);
    b = Max(All(0), b);
    A = Max(All(0), A);
    for (int row = 1; row < Rows; ++row) {
      b = Max(b, Abs(b_[row]));
      A = Max(A, Abs(A_[row][row]));
    }
    const Real force = Select(A > 0, b / A, All(0));
    acceleration_tolerance_ = tolerances_.acceleration * b;
    force_tolerance_ = tolerances_.force * force;
    rate_tolerance_ = tolerances_.pivot * A;
    for (int row = 0; row < Rows; ++row) {
      f_[row] = Select(fresh, All(0), f_[row]);
      a_[row] = Select(fresh, b_[row], a_[row]);
      set_[row] = Select(fresh, All(kNone), set_[row]);
    }
    for (Real* counter : {&drives_, &steps_, &zero_steps_, &longest_zero_run_, &singular_directions_})
      *counter = Select(fresh, All(0), *counter);
    const Mask is_finite = IsFinite();
    is_left_ = (is_left_ & ~fresh) | (fresh & ~is_finite);
    scanning_ |= fresh & is_finite;
  }

  // x - x is zero for finite x only.
  Mask IsFinite() const {
    Real zero = All(0), sum = All(0);
    for (const Real& mu : mu_) zero += mu - mu;
    for (int i = 0; i < Rows; ++i) {
      sum += Abs(b_[i]);
      for (int j = 0; j < Rows; ++j) zero += A_[i][j] - A_[i][j];
    }
    return (zero == 0) & (sum <= __DBL_MAX__);
  }

  void Leave(Mask lanes) {
    is_left_ |= lanes;
    driving_ &= ~lanes;
    scanning_ &= ~lanes;
  }

  // ---- Main loop ----

  void Scan() {
    if (!Any(scanning_)) return;
    Real picked = All(-1);
    for (int contact = kContacts - 1; contact >= 0; --contact) {
      const int normal = 2 * contact, friction = normal + 1;
      const Mask holds = NormalHolds(normal);
      picked = Select(holds & ~FrictionHolds(contact), All(friction), picked);
      picked = Select(holds, picked, All(normal));
    }
    const Mask begins = scanning_ & (picked >= 0);
    scanning_ = Never();
    Begin(begins, picked);
  }

  Mask NormalHolds(int row) const {
    const Mask f_positive = f_[row] > force_tolerance_, f_negative = f_[row] < -force_tolerance_;
    const Mask a_positive = a_[row] > acceleration_tolerance_, a_negative = a_[row] < -acceleration_tolerance_;
    return ~f_negative & ~a_negative & ~(f_positive & a_positive);
  }

  Mask FrictionHolds(int contact) const {
    const int row = 2 * contact + 1;
    const Real slack = mu_[contact] * f_[row - 1] - Abs(f_[row]);
    const Mask f_positive = f_[row] > force_tolerance_, f_negative = f_[row] < -force_tolerance_;
    const Mask a_positive = a_[row] > acceleration_tolerance_, a_negative = a_[row] < -acceleration_tolerance_;
    const Mask along = (a_positive & f_positive) | (a_negative & f_negative);
    return ~(slack < -force_tolerance_) & ~along & (~(a_positive | a_negative) | ~(slack > force_tolerance_));
  }

  void Begin(Mask begins, Real row) {
    driven_ = Select(begins, row, driven_);
    for (int friction = 1; friction < Rows; friction += 2) {
      const Mask here = begins & (driven_ == friction);
      const Real sign = Select(a_[friction] > 0, All(-1), All(1));
      sign_ = Select(here, sign, sign_);
      const Mask rests = ~(f_[friction] > force_tolerance_) & ~(f_[friction] < -force_tolerance_);
      Leave(here & ~(rests & ((a_[friction] > 0) | (a_[friction] < 0))));
    }
    for (int normal = 0; normal < Rows; normal += 2)
      sign_ = Select(begins & (driven_ == normal), All(1), sign_);
    driving_ |= begins;
    for (int r = 0; r < Rows; ++r) {
      last_left_[r] = Select(begins, All(kNone), last_left_[r]);
      Leave(begins & (driven_ == r) & (set_[r] != kNone));
    }
    driving_ &= ~is_left_;
    drives_ += Select(begins, All(1), All(0));
    zero_run_ = Select(begins, All(0), zero_run_);
  }

  // ---- One step of a drive ----

  void Step() {
    FindDirection();
    FindStep();
    Advance();
    MoveLimiting();
  }

  // Columns of A, a normal's with its friction along while that is at a limit.
  void FindDirection() {
    for (int row = 0; row < Rows; ++row) {
      is_driven_[row] = driven_ == row;
      unknown_[row] = set_[row] == (row % 2 == 0 ? kClamped : kSticking);
    }
    Real M[Rows][Rows];
    for (int contact = 0; contact < kContacts; ++contact) {
      const int normal = 2 * contact;
      at_upper_[contact] = set_[normal + 1] == kAtUpper;
      at_lower_[contact] = set_[normal + 1] == kAtLower;
      for (int i = 0; i < Rows; ++i) {
        const Real along = mu_[contact] * A_[i][normal + 1];
        M[i][normal] = Select(at_upper_[contact], A_[i][normal] + along,
                              Select(at_lower_[contact], A_[i][normal] - along, A_[i][normal]));
        M[i][normal + 1] = A_[i][normal + 1];
      }
    }
    Real right[Rows];
    for (int i = 0; i < Rows; ++i) {
      Real entry = M[i][Rows - 1];
      for (int j = 0; j < Rows - 1; ++j) entry = Select(is_driven_[j], M[i][j], entry);
      right[i] = Select(sign_ > 0, -entry, entry);
    }
    Solve(M, right);
    SpreadDirection();
  }

  // Gauss with the largest entry of each column, of equal ones that in the first place.
  void Solve(Real (&M)[Rows][Rows], Real (&right)[Rows]) {
    Mask waiting[Rows];  // rows of unknowns that are no pivot's
    Real place[Rows];
    Real rank = All(0), before = All(0);
    for (int i = 0; i < Rows; ++i) {
      waiting[i] = unknown_[i];
      place[i] = before;
      before += Select(unknown_[i], All(1), All(0));
    }
    Mask has_pivot[Rows];
    Real pivot_row[Rows][Rows], pivot_right[Rows];
    for (int column = 0; column < Rows; ++column) {
      has_pivot[column] = Never();
      if (!Any(unknown_[column])) continue;
      Mask is_pivot[Rows];
      Real size = All(0), at = All(0);
      for (int i = 0; i < Rows; ++i) {
        const Real entry = Abs(M[i][column]);
        const Mask may = waiting[i] & unknown_[column] & (entry > rate_tolerance_);
        const Mask better = may & (~has_pivot[column] | (entry > size) | ((entry == size) & (place[i] < at)));
        for (int k = 0; k < i; ++k) is_pivot[k] &= ~better;
        is_pivot[i] = better;
        size = Select(better, entry, size);
        at = Select(better, place[i], at);
        has_pivot[column] |= better;
      }
      for (int j = column; j < Rows; ++j) {
        pivot_row[column][j] = M[Rows - 1][j];
        for (int i = 0; i < Rows - 1; ++i)
          pivot_row[column][j] = Select(is_pivot[i], M[i][j], pivot_row[column][j]);
      }
      pivot_right[column] = right[Rows - 1];
      for (int i = 0; i < Rows - 1; ++i)
        pivot_right[column] = Select(is_pivot[i], right[i], pivot_right[column]);
      for (int i = 0; i < Rows; ++i) {
        waiting[i] &= ~is_pivot[i];
        place[i] = Select(has_pivot[column] & (place[i] == rank), at, place[i]);
        const Real below = M[i][column];
        const Mask clear = waiting[i] & has_pivot[column] & ((below > 0) | (below < 0));
        const Real factor = below / pivot_row[column][column];
        for (int j = column + 1; j < Rows; ++j)
          M[i][j] = Select(clear, M[i][j] - factor * pivot_row[column][j], M[i][j]);
        right[i] = Select(clear, right[i] - factor * pivot_right[column], right[i]);
      }
      rank += Select(has_pivot[column], All(1), All(0));
    }
    Mask singular = Never(), inconsistent = Never();
    for (int i = 0; i < Rows; ++i) {
      singular |= waiting[i];
      inconsistent |= waiting[i] & (Abs(right[i]) > rate_tolerance_);
    }
    singular_directions_ += Select(driving_ & singular, All(1), All(0));
    Leave(driving_ & inconsistent);
    BackSubstitute(has_pivot, pivot_row, pivot_right);
  }

  void BackSubstitute(const Mask (&has_pivot)[Rows], const Real (&pivot_row)[Rows][Rows],
                      const Real (&pivot_right)[Rows]) {
    for (int column = Rows - 1; column >= 0; --column) {
      df_[column] = All(0);
      if (!Any(has_pivot[column])) continue;
      Real x = pivot_right[column];
      for (int k = column + 1; k < Rows; ++k) x = Select(has_pivot[k], x - pivot_row[column][k] * df_[k], x);
      df_[column] = Select(has_pivot[column], x / pivot_row[column][column], All(0));
    }
  }

  void SpreadDirection() {
    for (int row = 0; row < Rows; ++row) df_[row] = Select(is_driven_[row], sign_, df_[row]);
    for (int contact = 0; contact < kContacts; ++contact) {
      const int normal = 2 * contact;
      const Mask moves = unknown_[normal] | is_driven_[normal];
      const Real bound = mu_[contact] * df_[normal];
      Real& friction = df_[normal + 1];
      friction = Select(moves & at_upper_[contact], bound, friction);
      friction = Select(moves & at_lower_[contact], -bound, friction);
    }
    for (int row = 0; row < Rows; ++row) {
      Real change = All(0);
      for (int j = 0; j < Rows; ++j) change += A_[row][j] * df_[j];
      da_[row] = Select(unknown_[row], All(0), change);
    }
  }

  struct Limit {
    Mask exists;
    Real s, wants;
  };

  static Limit Offer(Mask may, Real gap, Real rate, Real wants, Real tolerance) {
    Limit limit;
    limit.exists = may & (rate > tolerance);
    const Real s = gap / rate;
    limit.s = Select(s < 0, All(0), s);
    limit.wants = wants;
    return limit;
  }

  Limit LimitNormal(int row) const {
    const Mask clamped = set_[row] == kClamped, driven = is_driven_[row];
    const Mask may = driven | clamped | (set_[row] == kSeparating);
    const Real gap = Select(driven, -a_[row], Select(clamped, f_[row], a_[row]));
    const Real rate = Select(driven, da_[row], Select(clamped, -df_[row], -da_[row]));
    const Mask closes = driven | ~clamped;
    return Offer(may, gap, rate, Select(closes, All(kClamped), All(kSeparating)),
                 Select(closes, rate_tolerance_, All(tolerances_.pivot)));
  }

  Limit LimitFriction(int contact) const {
    const int row = 2 * contact + 1;
    const Mask driven = is_driven_[row], sticks = set_[row] == kSticking, forward = sign_ > 0;
    const Mask upper = at_upper_[contact], lower = at_lower_[contact];
    const Real bound = mu_[contact] * f_[row - 1], growth = mu_[contact] * df_[row - 1];
    const Real to_upper = bound - f_[row], to_lower = bound + f_[row];
    const Real gap_a = Select(driven, Abs(a_[row]), Select(upper, -a_[row], a_[row]));
    const Real rate_a = Select((driven & forward) | (~driven & upper), da_[row], -da_[row]);
    Limit first =
        Offer(driven | upper | lower | sticks, Select(sticks, to_upper, gap_a),
              Select(sticks, df_[row] - growth, rate_a), Select(sticks, All(kAtUpper), All(kSticking)),
              Select(sticks, All(tolerances_.pivot), rate_tolerance_));
    const Mask up = driven & forward;
    const Limit second =
        Offer(driven | sticks, Select(up, to_upper, to_lower), Select(driven, 1 - growth, -df_[row] - growth),
              Select(up, All(kAtUpper), All(kAtLower)), All(tolerances_.pivot));
    const Mask sooner = second.exists & ~(first.exists & ~(second.s < first.s));
    first.exists |= sooner;
    first.s = Select(sooner, second.s, first.s);
    first.wants = Select(sooner, second.wants, first.wants);
    return first;
  }

  // The driven variable first, which has no set, then by sets, then by rows.
  void FindStep() {
    Limit limits[Rows];
    Mask exists = Never();
    Real nearest = All(0);
    for (int row = 0; row < Rows; ++row) {
      Limit& limit = limits[row];
      limit = row % 2 == 0 ? LimitNormal(row) : LimitFriction(row / 2);
      const Mask nearer = limit.exists & (~exists | (limit.s < nearest));
      nearest = Select(nearer, limit.s, nearest);
      exists |= nearer;
    }
    Leave(driving_ & ~exists);  // a ray
    const Real reach = nearest + force_tolerance_;
    Real first = All(10);  // more than any set
    for (int row = 0; row < Rows; ++row) {
      const Mask before = limits[row].exists & ~(limits[row].s > reach) & (set_[row] < first);
      first = Select(before, set_[row], first);
      for (int k = 0; k < row; ++k) is_limiting_[k] &= ~before;
      is_limiting_[row] = before;
      s_ = Select(before, limits[row].s, s_);
      wants_ = Select(before, limits[row].wants, wants_);
    }
  }

  void Advance() {
    Real sum = All(0);
    const Mask rests = (wants_ == kClamped) | (wants_ == kSticking);
    for (int row = 0; row < Rows; ++row) {
      f_[row] = Select(driving_, f_[row] + s_ * df_[row], f_[row]);
      a_[row] = Select(driving_, a_[row] + s_ * da_[row], a_[row]);
      const Mask meets = driving_ & is_limiting_[row];
      a_[row] = Select(meets & rests, All(0), a_[row]);
      if (row % 2 == 0) {
        f_[row] = Select(meets & ~rests, All(0), f_[row]);
      } else {
        const Real bound = mu_[row / 2] * f_[row - 1];
        f_[row] = Select(meets & ~rests, Select(wants_ == kAtUpper, bound, -bound), f_[row]);
      }
      sum += Abs(f_[row]) + Abs(a_[row]);
    }
    Leave(driving_ & ~(sum <= __DBL_MAX__));
  }

  void MoveLimiting() {
    const Mask zero = ~(s_ > force_tolerance_);
    steps_ += Select(driving_, All(1), All(0));
    zero_steps_ += Select(driving_ & zero, All(1), All(0));
    zero_run_ = Select(zero, zero_run_ + 1, All(0));
    longest_zero_run_ = Select(driving_, Max(longest_zero_run_, zero_run_), longest_zero_run_);
    Mask ends = Never();
    for (int row = 0; row < Rows; ++row) {
      const Mask moves = driving_ & is_limiting_[row];
      ends |= moves & is_driven_[row];
      Leave(moves & ~is_driven_[row] & (wants_ == last_left_[row]) & zero);  // given up
      last_left_[row] = Select(moves, set_[row], last_left_[row]);
      set_[row] = Select(moves, wants_, set_[row]);
    }
    Leave(driving_ & (steps_ > kMostLaneSteps));
    scanning_ |= ends & driving_;
    driving_ &= ~ends;
  }

  Block<Rows>& block_;
  const int count_;
  const LaneTolerances tolerances_;
  int next_ = 0;  // the first problem that no lane has had

  // Of the problem in a lane.
  Real A_[Rows][Rows] = {}, b_[Rows] = {}, mu_[kContacts] = {};
  Real acceleration_tolerance_ = {}, force_tolerance_ = {}, rate_tolerance_ = {};
  int number_[kLanes];  // in the block; -1: none
  Mask scanning_ = {}, driving_ = {}, is_left_ = {};

  // Where its run stands.
  Real f_[Rows] = {}, a_[Rows] = {}, set_[Rows] = {}, last_left_[Rows] = {};
  Real driven_ = {}, sign_ = {};
  Real drives_ = {}, steps_ = {}, zero_steps_ = {}, zero_run_ = {}, longest_zero_run_ = {},
       singular_directions_ = {};

  // Of one step.
  Mask is_driven_[Rows], unknown_[Rows], at_upper_[kContacts], at_lower_[kContacts], is_limiting_[Rows];
  Real df_[Rows], da_[Rows], s_ = {}, wants_ = {};
};

}  // namespace
}  // namespace stiction
