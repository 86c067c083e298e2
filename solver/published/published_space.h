// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space: section 5.6 of [Baraff94].
//
// Solves, for frictionless and static contacts, (15) and the friction conditions of space,
//
//   abs(fF) <= mu fN (22),   fF.aF <= 0 (21),   aF = 0 or abs(fF) = mu fN,
//
// which leave the direction of slip free. readings.md, 8, fixes every choice that the text leaves open.
//
// Frames      Two axes p, q in the tangent plane of each contact are turned so that whatever is driven or kept
//             at its limit runs along an axis: p is the recorded direction in NCF. There NCF is what NC+ is in
//             the plane, and the force direction (fdirection) is found by the same system, direction.h. New are
//             the circle (23), met by a quadratic step, and the direction.
// Shared      scan order and give-up rule (scan.h), force direction, scales. The loop and the step are this
//             class's own: a contact's friction has two components, and square roots leave no exact scalar.
// Loops       Over floating-point scalars `cycle` says that a state recurs after rounding. Forces are
//             irrational, but there are states whose sets alone decide them (`Memoryless`): over intervals
//             `cycle` says that the sets of such a state recur, a proof; rounded states that recur
//             twice end the run `undecided`, and certify/exact/loops_in_space.h looks further. A stall cannot
//             happen (readings.md, 8); a drive that does not end would spend its budget.
// Intervals   Comparisons throw where a sign is unsure; callers catch it. What a set guarantees (a = 0 in C
//             and CF, abs(fF) = mu fN in NCF, and the inequalities that limit steps) is not compared again.
//             Two zeros are known from where the run has been: the line and the trail (readings.md, 8).

#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "solver/linear/direction.h"
#include "solver/problem/enclosure.h"
#include "solver/problem/solution.h"
#include "solver/published/step_size.h"

namespace stiction {

// Whether `problem` has kinds and a dimension that the published algorithm handles in space.
template <class Problem>
bool PublishedHandlesInSpace(const Problem& problem) {
  bool handled = problem.dimension == 3;
  for (const auto& contact : problem.contacts) {
    handled &= contact.kind == ContactKind::kFrictionless || contact.kind == ContactKind::kStatic;
  }
  return handled;
}

// The readings built for space: file=no, apex=kept, slip=literal or redirect; all values of the other switches.
inline bool PublishedReadsInSpace(const Policy& policy) {
  return policy.file == File::kNo && policy.apex == Apex::kKept && policy.slip != Slip::kPolygon;
}

template <class Scalar>
using SpaceTrace = std::vector<Pivot<Scalar>>;

template <class Scalar>
class PublishedInSpace {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;
  using Tangent = std::array<Scalar, 2>;

  explicit PublishedInSpace(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }

  // Runs from f = 0. Requires PublishedHandlesInSpace(problem), PublishedReadsInSpace(options().policy). With
  // `trace`, every step is recorded.
  Verdict Run(const Problem& problem, SpaceTrace<Scalar>* trace = nullptr);

  // ---- The main loop turn by turn, from any of its states: certify/exact/loops_in_space.h proves loops so.

  // What a state of the main loop remembers, in the problem's axes. All other forces follow from it.
  struct Standing {
    IndexSets<Eigen::Dynamic> sets;
    std::vector<char> turned_away;  // by contact
    int last_driven = -1;           // contact, where it matters
    Vector f;
    std::vector<Tangent> recorded;   // by contact, of NCF
    std::vector<int> recorded_anew;  // by contact: how often a direction was recorded
  };

  // f = 0. `problem` must stay as it is.
  void Begin(const Problem& problem, SpaceTrace<Scalar>* trace = nullptr) { Start(problem, trace); }
  // Stands in such a state; the forces of C and CF are solved for anew. Requires Begin. An enclosure throws
  // where it is not sure that the matrix of C and CF is regular and what the sets keep holds strictly.
  void StandAt(const Standing& standing);
  // One turn of the main loop; whether the run goes on.
  bool TakeTurn();
  Standing standing() const;

  // A contact turned away, with `aside`, aF beside its recorded direction. `ends`: were every period like the
  // one before, this line would be one of which a point has aF = 0; so that aside would be zero here.
  struct Turning {
    Scalar aside;
    bool ends;
  };
  // From here on contacts turn away also where it is not told whether aside is zero, and are listed. Requires
  // Begin.
  void AssumeTurnings() { assumes_turnings_ = true; }
  void BeginPeriod();
  const std::vector<Turning>& turnings() const { return turnings_; }

  // Of the last run, also of one that ended in an exception: what it had done. In the problem's own axes.
  const Verdict& verdict() const { return verdict_; }
  Counters counters() const {
    Counters counters = CountersOf(verdict_.statistics);
    counters.Tell(Counter::kRedirects) = redirects_;
    counters.Tell(Counter::kBreaks) = breaks_;
    return counters;
  }
  Vector f() const { return InProblemAxes(state_.f); }
  Vector a() const { return InProblemAxes(state_.a); }
  // The direction of a ray.
  Vector ray() const { return InProblemAxes(direction_.df()); }

 private:
  static constexpr std::string_view kNotFinite = "a number is not finite";

  struct Frame {
    Tangent p = {Scalar(1), Scalar(0)}, q = {Scalar(0), Scalar(1)};
  };
  // Of a line in the space of forces; of equal names the lines are equal. Empty where a matrix is singular.
  using LineName = std::vector<int>;
  // The state at which a normal left C, f and a in the frames of now.
  struct Trail {
    int normal = -1;  // none
    LineName line;    // that the run took from there; empty: it has not moved
    Vector f, a;
  };
  struct Limit {
    bool exists = false;
    Scalar s = Scalar(0);
    IndexSet wants = IndexSet::kNone;
  };
  struct OuterState {
    std::int64_t drives;
    std::uint64_t rounded;
    // Over intervals:
    IndexSets<Eigen::Dynamic> sets;
    std::vector<char> turned_away;
    int contact;                           // driven last, where it matters
    bool memoryless;                       // see Memoryless
    bool regular = false;                  // the matrix of C and CF is, as the drive from here has shown
    std::int64_t singular_directions = 0;  // met before
  };

  void Start(const Problem& problem, SpaceTrace<Scalar>* trace);
  bool Ended() const { return ended_; }
  void End(Outcome outcome, std::string_view reason = {});
  void Finish();

  // Main loop (4.3, 5.5).
  void Sweep();
  int ScanForViolated();
  bool NormalHolds(int row) const;
  bool FrictionHolds(int row) const;
  bool Violated(int row) const;
  bool OpposesNoMore(int row) const;
  void Establish(int row);
  void EstablishFriction(int row);
  bool SetsHold() const;
  bool OuterStateRecurs();
  bool EndCycle(const OuterState& earlier);
  bool Memoryless() const;
  std::uint64_t RoundedHash() const;

  // One drive (4.1-4.3, 5.2-5.6). `sign`: df of the driven row.
  void DriveToZero(int driven, DriveGoal goal, int sign);
  Step<Scalar> FindStep(int driven, DriveGoal goal);
  int FirstOf(int driven, int nearest, Ties ties) const;
  static void Offer(Limit& limit, const Scalar& gap, const Scalar& rate, IndexSet wants,
                    const Scalar& tolerance);
  void LimitDriven(int driven, DriveGoal goal);
  void LimitMaintained(int row);
  void LimitSticking(Limit& limit, int row) const;
  void LimitSlipping(Limit& limit, int row) const;
  void Advance(const Step<Scalar>& step, bool zero);
  void LeaveCircles();
  void MeetLimit(int row, IndexSet wants);
  bool TurnsAway(int row);
  void Move(int row, IndexSet to);
  void MoveDriven(int driven, IndexSet wants);
  void MoveLimiting(int row, IndexSet wants);
  void GiveUpLimiting(int row, int driven_contact);
  bool BudgetSpent();
  void EndUnlessFinite();
  void RecordDirection(int driven, DriveGoal goal);
  void RecordStep(const Step<Scalar>& step, IndexSet from, bool gave_up);

  // Where the run has been: enclosures.
  LineName NameOfLine(int driven, const std::vector<int>& axes, const std::vector<int>& recorded) const;
  bool SlipEndsOnLine(int contact) const;
  void NoteSlipEnds();
  void MoveAlong(const Step<Scalar>& step, bool zero);

  // Frames. Friction of a contact is in rows `row`, `row` + 1 of state_, along p and q.
  void Turn(int contact, const Tangent& p);
  void Reverse(int row);
  void AlongForce(int row);
  void Rebuild(int row);
  Scalar Entry(int i, int j) const;
  Tangent FrictionInProblemAxes(const Vector& values, int row) const;
  Vector InProblemAxes(const Vector& values) const;
  Scalar Square(const Vector& values, int row) const;
  Scalar Bound(int row) const;
  int FrictionOf(int row) const { return layout_.NormalRowOf(layout_.ContactOf(row)) + 1; }

  Request request_;
  const Problem* problem_ = nullptr;
  Problem turned_;  // the problem in the frames
  SpaceTrace<Scalar>* trace_ = nullptr;
  RowLayout<Eigen::Dynamic> layout_;
  Scale<Scalar> scale_;
  double inverse_grain_ = 0;  // 1/N
  DirectionSystem<Scalar, Eigen::Dynamic> direction_;
  std::vector<Limit> limits_;

  ContactState<Scalar, Eigen::Dynamic> state_;  // in the frames
  std::vector<Frame> frames_;
  std::vector<char> given_up_by_turning_;  // by contact: is to be driven anew against its acceleration
  std::vector<char> on_circle_;            // by contact: abs(fF) = mu fN is known, though it is in CF, or rests
  std::vector<int> recorded_anew_;         // by contact: how often a direction was recorded
  static constexpr int kProblemAxes = 0;
  std::vector<int> axes_;  // by contact: of equal numbers the axes are equal, up to their signs
  int turned_axes_ = 0;
  // The same within a period: equal numbers are equal if every period is like the one before.
  std::vector<int> axes_in_period_, recorded_in_period_, recorded_before_;
  int axes_before_ = 0;
  LineName line_, last_line_;  // of this step; of the last one that was not zero
  int lines_followed_ = 0;
  using SlipEnds = std::set<std::pair<int, LineName>>;
  SlipEnds slip_ends_;  // contact, line: there is a point of the line with aF = 0
  LineName line_in_period_;
  SlipEnds ends_in_period_, ends_before_;  // of this period; of the one before
  bool assumes_turnings_ = false;
  std::vector<Turning> turnings_;
  Trail trail_;
  Verdict verdict_;
  std::int64_t redirects_ = 0, breaks_ = 0;
  bool ended_ = false;
  int last_driven_contact_ = -1;
  IndexSets<Eigen::Dynamic> last_left_;
  bool last_step_zero_ = false;
  std::int64_t zero_run_ = 0;
  std::vector<OuterState> outer_states_;
};

extern template class PublishedInSpace<float>;
extern template class PublishedInSpace<double>;

}  // namespace stiction
