// SPDX-License-Identifier: Apache-2.0
// Simulate: a scene over doubles, stepped through time, in the plane or in space.
//
// A step of length h, from a state (x, v):
//
//   1 contacts    those that are within the gap, or will be at the end of the step with the present velocities;
//                 after 3 and 4 also those that the new velocities would close within the step, such as a block
//                 on another that has just been stopped: then 3, or 4, once more
//   2 positions   where shapes overlap or joints have come apart by more than kDrift: the level `positions` of
//                 assemble.h, one linear correction; contacts are found again. Collisions of the contacts
//                 found first are resolved before, as by 3: moved bodies may show others
//   3 impulses    where a contact approaches faster than `rest` and would close within the step: the level
//                 `impulses`, an inelastic collision with restitution 0 and Coulomb's law, v += W J' p
//   4 forces      the level `forces` with its terms of the step, v += k W (F + J' f); a contact that parts is
//                 left out, and brought back where it would overlap at the end of the step
//   5 motion      x += h v, with the new v
//
// Velocities are those of the middle of a step, but for the start: v(t + h/2) = v(t - h'/2) + k W (F + J' f),
// k = (h + h') / 2 with the step h' before (at the start k = h / 2), x(t + h) = x(t) + h v: the leapfrog
// method. Constraints hold at x(t + h) to second order (assemble.h), as in SHAKE (J.-P. Ryckaert, G. Ciccotti,
// H. J. C. Berendsen, J. Comput. Phys. 23, 1977, cited from memory). How fast a contact parts, approaches or
// slides is measured so that what is kept has speed zero: J v - h' bias / 2.
//
// At 4 a contact whose tangential speed exceeds `rest` slides, (24). If its tangential velocity would turn
// round within the step, it comes to rest in it: it counts as static, with b_F += vF / h, and the forces are
// computed again. Sliding contacts can leave no solution at all (section 6 of [Baraff94] asks for an impulsive
// force then): the frame is solved with every contact static, that is, by one inelastic step at the level of
// velocities, which has a solution where bias is in range(A) and no driven bodies close on each other; it is
// counted.
//
// Overlap. Contacts are predicted from the features that are near at the start of a step, to first order: a
// body that turns fast, an edge that gives way to a face, a corner behind another leave overlap that speeds and
// steps set. A step that ends deeper than the gap (a thousandth of the scene's size in one without), and deeper
// than it began, is taken back and done in two halves, and they likewise, `halvings` times one
// within the other. So no frame ends deeper than both, unless it is counted in `deep`: it ran out of halvings,
// and what was left of it was done without. Forces and contacts are those of the last part. Observers see the
// problems of steps that were taken back too, and all counters but `frames` and `contacts` count them.
//
// Which solution. Forces and accelerations need not be unique. The forces of a step start from those found
// last, in it or in the step before: each contact's goes to the nearest of the contacts between the same
// pieces, each joint's row keeps its own. What is found is a solution near them; where none is, or more than a
// few contacts are new, and in the first step, it is that of SceneSolver without a start (`warm`: false: in
// every step, and the answer depends on the state alone). f = 0 is taken where it is a solution. Nothing else
// is promised.
//
// Errors. A problem that is not solved to kLooseResidual (with joints ten times that) is undecided: the best
// forces that were found are taken, the step goes on, and undecided() tells. There may be none, where driven
// bodies close on each other, or one that doubles miss. Cost. For each island one problem of forces, another
// for every time that contacts come to rest within the step, one of positions where there are joints, one of
// impulses in a collision. For an island of 40 rows and more in the plane, 10 in space, no A is formed where
// that can be.

#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "scene/assemble.h"
#include "scene/solve_scene.h"

namespace stiction {

inline constexpr double kDrift = 1e-9;  // of the size of the scene, or the sine of an angle

// The size of a scene, m: twice the farthest that a piece, a joint or a given contact of a moving body is from
// its centre of mass; 1 where all are points. Tolerances are parts of it, so that a scene ten times as large,
// with all that has a length in its unit, moves alike but for rounding.
template <class Kind>
double SizeOf(const SceneIn<Kind, double>& scene);

// Counters since the start.
struct SimulationStatistics {
  std::int64_t frames = 0;
  std::int64_t contacts = 0;
  std::int64_t problems = 0;
  std::int64_t rows = 0;
  std::int64_t collisions = 0;   // frames with impulses
  std::int64_t corrections = 0;  // frames with corrected positions
  std::int64_t stopped = 0;      // contacts that came to rest within a step
  std::int64_t impulsive = 0;    // frames whose sliding contacts had no solution
  std::int64_t undecided = 0;    // problems whose best forces are no solution
  std::int64_t fallbacks = 0;    // problems that complete driving solved
  std::int64_t loose = 0;        // problems solved to kLooseResidual only
  std::int64_t sparse = 0;       // problems solved in the space of bodies, without A
  std::int64_t warm = 0;         // of these those solved from the forces of the step before
  std::int64_t halved = 0;       // steps, or parts of one, that were taken back and done in two halves
  std::int64_t deep = 0;         // frames that ran out of halvings

  bool operator==(const SimulationStatistics&) const = default;
};

// visit(name, help, counter)
template <class S, class Visit>
requires std::is_same_v<std::remove_const_t<S>, SimulationStatistics>
void ForEachField(S& s, Visit visit) {
  visit("frames", "steps", s.frames);
  visit("contacts", "contacts found, of all frames", s.contacts);
  visit("problems", "problems solved", s.problems);
  visit("rows", "their rows", s.rows);
  visit("collisions", "frames with impulses", s.collisions);
  visit("corrections", "frames with corrected positions", s.corrections);
  visit("stopped", "sliding contacts that came to rest within a step", s.stopped);
  visit("impulsive", "frames whose sliding contacts had no solution", s.impulsive);
  visit("undecided", "problems whose best forces are no solution", s.undecided);
  visit("fallbacks", "problems that complete driving solved", s.fallbacks);
  visit("loose", "problems solved to 1e-5 only", s.loose);
  visit("sparse", "problems solved in the space of bodies, without A", s.sparse);
  visit("warm", "of these those solved from the forces of the step before", s.warm);
  visit("halved", "steps that ended too deep and were done in two halves", s.halved);
  visit("deep", "frames that ran out of halvings", s.deep);
}

// A problem that a frame met, an island of its model, and its answer.
template <class Kind>
struct FrameProblemIn {
  std::int64_t frame = 0;  // from 0
  Level level = Level::kForces;
  int island = 0;
  const ModelIn<Kind, double>& model;
  const Eigen::VectorXd& f;  // rows x 1, of the level; where it is undecided the best, or empty
  bool is_taken = true;      // or it was undecided, and asked again with every contact static
};
using FrameProblem = FrameProblemIn<Plane>;

// A problem that was not solved: its best forces are those of the step.
struct UndecidedProblem {
  std::int64_t frame = 0;  // from 0
  double time = 0;         // at its start, s
  Level level = Level::kForces;
  int island = 0;
  double error = 0;  // of the forces, lenient
  ContactProblem<double> problem;
};
// Where, and how far its forces are from a solution.
std::string TextOf(const UndecidedProblem& problem);

// A force of contact or joint at a point, on a body `on` and opposite on its partner. World, N.
template <class Kind>
struct AppliedForceIn {
  std::array<int, 2> bodies = {0, 0};
  typename Kind::template Vector<double> point, force;
  bool from_joint = false;
  Contact<double> law = {};
  std::vector<double> rows = {};  // the same by rows: normal, then tangential, N
  std::vector<typename Kind::template Vector<double>> ways = {};  // of a unit force of each, on bodies[0]
  int source = 0;  // number of the joint, or of the contact in contacts()
  // Of a contact, with the velocities of the step: how fast one body slides on the other, m/s.
  double slip = 0;
};

struct Energy {
  double kinetic = 0, potential = 0;  // J; potential of gravity, zero at the origin
  double total() const { return kinetic + potential; }
};

// How far a state is from what joints and shapes demand.
struct Drift {
  double joints = 0;   // m, or the sine of an angle
  double overlap = 0;  // m
};

template <class Kind>
class SimulationIn {
 public:
  using SceneType = SceneIn<Kind, double>;
  using Touch = TouchPointIn<Kind, double>;
  using Applied = AppliedForceIn<Kind>;

  // Of the steps that follow.
  bool minimal = true;  // assemble.h
  bool warm = true;     // whether a step's forces start from those of the step before
  int halvings = 10;    // of a step, one within the other; 0: none

  // Requires a finite scene. Steps are of this length, s. Speeds up to `rest`, m/s, count as at rest, whatever
  // the scene says; 0: what gravity makes in one step, without gravity a thousandth of the scene's size a
  // second. `observe` sees every problem once it is solved.
  explicit SimulationIn(SceneType scene, double step = 1.0 / 60, double rest = 0,
                        std::function<void(const FrameProblemIn<Kind>&)> observe = {});

  void Step();

  const SceneType& scene() const { return scene_; }
  double time() const { return static_cast<double>(statistics_.frames) * frame_step_; }
  const SimulationStatistics& statistics() const { return statistics_; }
  // Of the last step.
  const std::vector<Applied>& forces() const { return forces_; }
  const std::vector<Touch>& contacts() const { return contacts_; }
  const std::vector<UndecidedProblem>& undecided() const { return undecided_; }
  // Whose islands are the problems that those forces solve, in the order of forces(). Empty before a step.
  const ModelIn<Kind, double>& model() const { return model_; }

 private:
  using Model = ModelIn<Kind, double>;
  using Forces = std::vector<ContactProblem<double>::Vector>;
  using Changes = std::vector<Eigen::Matrix<double, Kind::kDof, 1>>;
  using Vector = typename Kind::template Vector<double>;

  // A constraint of this step, or of the last with its force. Contacts between two pieces have one key.
  struct Remembered {
    std::array<int, 5> key = {};
    Vector place = Vector::Zero(), force = Vector::Zero();  // m; N, of a contact, on the lower of its bodies
    double along = 0;                                       // N or N m, of a joint's row
    const ConstraintIn<Kind, double>* constraint = nullptr;
    int row = 0;
  };
  // Of an island: from_joint, source, part and kind of its constraints.
  using IslandKey = std::vector<std::array<int, 4>>;
  static bool IsBefore(const Remembered& one, const Remembered& other) { return one.key < other.key; }

  void StepBy(double h, int halvings);
  void TakeStep();
  double Kick() const { return (step_ + before_) / 2; }  // from the middle of one step to that of the next
  double Overlap() const;
  Model AssembleAt(Level level) const;
  bool Solve(const Model& model, Level level, bool is_last, Forces& f);
  IslandKey KeyOf(const Model& model, std::size_t island) const;
  Eigen::VectorXd StartOf(const Model& model, Level level, std::size_t island) const;
  Remembered Known(const ConstraintIn<Kind, double>& constraint, int row) const;
  void FindNear();
  void FindStepContacts();
  bool Closes(const Touch& contact, const Changes& accelerations) const;
  bool AddClosing(const Changes& accelerations);
  Changes Response(const Model& model, const Forces& f) const;
  bool HasDrifted() const;
  bool Collides() const;
  bool Collides(const Touch& contact) const;
  void CorrectPositions();
  void ApplyImpulses();
  Changes Accelerations();
  int HoldReversing(const Model& model, const Changes& accelerations);
  int KeepClosing(const Model& model, const Changes& accelerations);
  void Remember(const Model& model, const Forces& f);
  void KeepForces(Model model, const Forces& f, const Changes& accelerations);
  double SpeedAfter(const Model& model, const ConstraintIn<Kind, double>& constraint, int row,
                    const Changes& accelerations) const;
  double SlipOf(const Model& model, const ConstraintIn<Kind, double>& constraint,
                const Changes& accelerations) const;
  void Move(const Changes& accelerations);

  SceneType scene_;
  double frame_step_;
  std::function<void(const FrameProblemIn<Kind>&)> observe_;
  tbb::enumerable_thread_specific<SceneSolver> solvers_;
  SimulationStatistics statistics_;
  double size_ = 1;          // SizeOf the scene
  double step_ = 0;          // that is being taken: that of the frame or a part of it
  double before_ = 0;        // the step before, of whose middle the velocities are; 0: of the start itself
  bool exhausted_ = false;   // no halvings are left in this frame
  std::vector<Touch> near_;  // all that may touch within a step from the present state
  bool is_near_known_ = false;
  std::vector<Touch> contacts_;
  std::vector<Touch> beyond_;  // what else is so near that it might touch within the step
  std::vector<Applied> forces_;
  std::vector<Remembered> remembered_;  // by key
  Model model_;
  std::map<IslandKey, Eigen::VectorXd> solved_;  // forces of islands, of earlier rounds of this step
  std::vector<UndecidedProblem> undecided_;      // of the last step
};
using Simulation = SimulationIn<Plane>;
using SimulationInSpace = SimulationIn<Space>;
extern template class SimulationIn<Plane>;
extern template class SimulationIn<Space>;

template <class Kind>
Energy EnergyOf(const SceneIn<Kind, double>& scene);
template <class Kind>
Drift DriftOf(const SceneIn<Kind, double>& scene);

}  // namespace stiction
