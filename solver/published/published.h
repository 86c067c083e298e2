// SPDX-License-Identifier: Apache-2.0
// The published algorithm: sections 4.3 and 5.2-5.5 of [Baraff94], switch by switch.
//
// Solves, for frictionless and planar static contacts, the normal force conditions (15) and the static
// friction conditions (16):
//
//   fN >= 0, aN >= 0, fN aN = 0      abs(fF) <= mu fN, aF fF <= 0, aF (mu fN - abs(fF)) = 0
//
// by driving one violated variable at a time while the conditions established before are maintained.
// readings.md fixes every choice that the text leaves open; `Policy` names the readings. The algorithm
// can fail to end: a repeated outer state is the outcome `cycle`, a repeated state inside a drive `stall`.
//
// Over exact scalars a repetition is a proof; over enclosures (problem/enclosure.h) every step is, a repetition
// where the sets decide the forces and those that were given up were left alike, and what the ends do not
// decide throws. Over inexact ones it is a suspicion: forces are compared after rounding, and callers run the
// problem again exactly before they claim anything.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/linear/direction.h"
#include "solver/published/step_size.h"

namespace stiction {

// Whether `problem` has kinds and a dimension that the published algorithm handles here.
template <class Problem>
bool PublishedHandles(const Problem& problem) {
  bool handled = problem.dimension == 2;
  for (const auto& contact : problem.contacts) {
    handled &= contact.kind == ContactKind::kFrictionless || contact.kind == ContactKind::kStatic;
  }
  return handled;
}

// Reusable: memory is kept between runs, so that a run of a problem no larger than one before allocates
// nothing (exact scalars allocate for themselves).
template <class Scalar, int Rows = Eigen::Dynamic>
class PublishedAlgorithm {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using State = ContactState<Scalar, Rows>;
  using Vector = typename Problem::Vector;

  explicit PublishedAlgorithm(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }
  // Unknowns from which on direction systems are updated (linear/updated_system.h).
  void UpdateFrom(int unknowns) { update_from_ = unknowns; }

  // Runs from f = 0. Requires PublishedHandles(problem). With `trace`, every step is recorded, and the
  // switches that the run consulted.
  Verdict Run(const Problem& problem, Trace<Scalar>* trace = nullptr);

  // Over enclosures: tells accelerations that are zero where others are, by an equation between the rows of A
  // and of b, and directions, if it is one that does. Null: none.
  void KnowDependentRows(DependentRows* rows) {
    dependent_rows_ = rows;
    exact_directions_ = dynamic_cast<ExactDirections<Scalar>*>(rows);
    step_size_.KnowDependentRows(rows);
  }

  // The state in which the last run ended.
  const State& state() const { return state_; }
  // The set that each variable last left in the last drive (kNone: none), and whether the last step of
  // that drive had length zero: the memory of a stalled drive.
  const IndexSets<Rows>& last_left() const { return last_left_; }
  bool last_step_zero() const { return last_step_zero_; }
  // Contact driven last, -1 before the first drive.
  int last_driven_contact() const { return last_driven_contact_; }
  // Direction of the last step: for the outcome `ray` its unlimited direction.
  const DirectionSystem<Scalar, Rows>& direction() const { return direction_; }

 private:
  // What can recur at the top of the main loop; forces are rounded over inexact scalars.
  struct OuterState {
    std::int64_t drives;
    std::uint64_t rounded;  // hash of sets and rounded forces; inexact scalars only
    IndexSets<Rows> sets;
    Vector f;
    int contact;
    RowArray<int, Rows> left_at;
  };
  // Over enclosures: what is known after a step that leaves a force where it is, its variable given up.
  struct Leaving {
    std::vector<std::array<int, 3>> known;  // by row: whether a = 0, whether f = 0, the sign of the limit of f
    RowArray<int, Rows> before;             // which leaving each force is from, -1: none
    bool decided;                           // whether one vector of forces is all that has this

    bool operator==(const Leaving&) const = default;
  };
  // What can recur inside a run of zero steps, where forces do not change.
  struct InnerState {
    std::int64_t steps;
    IndexSets<Rows> sets;
    IndexSets<Rows> last_left;
  };

  static constexpr std::string_view kNotFinite = "a number is not finite";

  void Start(const Problem& problem, Trace<Scalar>* trace);
  void Rest();
  bool Ended() const { return ended_; }
  void End(Outcome outcome, std::string_view reason = {});

  // Main loop (4.3, 5.5).
  void ComputeForces();
  void Sweep();
  int ScanForViolated();
  int Pick(Scan scan, Resume resume) const;
  bool NormalHolds(int row) const;
  bool FrictionHolds(int row) const;
  bool Violated(int row) const;
  void Establish(int row);
  bool OuterStateRecurs();
  bool SurelyDiffers(const Vector& f) const;
  bool SetsDecideForces(const OuterState& earlier);
  int LeftAt(int row) const { return state_.sets[row] == IndexSet::kNone ? left_at_[row] : -1; }
  std::uint64_t RoundedHash() const;

  // One drive (4.1-4.3, 5.2-5.5).
  using Status = typename DirectionSystem<Scalar, Rows>::Status;

  void DriveToZero(int driven, DriveGoal goal);
  Status SolveDirection(int driven, int sign);
  void NoteLeaving(const Step<Scalar>& step, int driven, Status status);
  void Advance(const Scalar& s, int limiting, IndexSet wants, int driven);
  void Move(int row, IndexSet to);
  void MoveLimiting(int row, IndexSet wants);
  void GiveUpLimiting(int row, int driven);
  void FileBySign(int row);
  bool InnerStateRecurs();
  bool BudgetSpent();
  bool IsFinite();
  static bool IsFinite(const Problem& problem);
  void Consult(PolicySwitch s) {
    if (trace_ != nullptr) trace_->consulted |= Bit(s);
  }
  void Record(int driven, DriveGoal goal, const Step<Scalar>& step, IndexSet from, bool gave_up);

  Request request_;
  int update_from_ = kUpdateFrom;
  const Problem* problem_ = nullptr;
  Trace<Scalar>* trace_ = nullptr;
  RowLayout<Rows> layout_;
  Scale<Scalar> scale_;
  DirectionSystem<Scalar, Rows> direction_;
  StepSize<Scalar, Rows> step_size_;
  DependentRows* dependent_rows_ = nullptr;
  ExactDirections<Scalar>* exact_directions_ = nullptr;

  State state_;
  Verdict verdict_;
  bool ended_ = false;
  int last_driven_contact_ = -1;
  IndexSets<Rows> last_left_;
  bool last_step_zero_ = false;
  std::int64_t zero_run_ = 0;
  std::vector<OuterState> outer_states_;
  std::vector<InnerState> inner_states_;
  std::vector<Leaving> leavings_;  // that differ, or decide nothing
  RowArray<int, Rows> left_at_;    // which of them left the force of each row where it is, -1: none
};

}  // namespace stiction
