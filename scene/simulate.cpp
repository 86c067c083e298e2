// SPDX-License-Identifier: Apache-2.0
#include "scene/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "scene/motion.h"
#include "scene/parallel.h"
#include "scene/rows.h"
#include "solver/in_turn.h"

namespace stiction {
namespace {

constexpr int kHoldRounds = 8;
// One contact in so many may be new where forces of the step before are a start.
constexpr std::size_t kNewShare = 20;
constexpr double kDeep = 1e-3;     // of the scene's size; where it has no gap
constexpr double kSlow = 1e-3;     // of the scene's size a second; at rest where there is no gravity
constexpr int kParallelRows = 20;  // of the largest island; below, threads cost more than they save

// The derivative of the gap: negative where the contact closes.
template <class SceneType, class Touch>
double ApproachOf(const SceneType& scene, const Touch& contact) {
  const auto &a = scene.bodies[contact.a], &b = scene.bodies[contact.b];
  return contact.normal.dot(a.VelocityAt(contact.point) - b.VelocityAt(contact.point));
}

// The direction of a row's unit force on its first body.
template <class Scalar, int Dof>
auto WayOf(const ConstraintRow<Scalar, Dof>& row) {
  constexpr int kDimension = Dof == 3 ? 2 : 3;
  return Eigen::Matrix<Scalar, kDimension, 1>(row.J[0].template head<kDimension>());
}

// 1 where its first body is the lower, -1 where it is the higher.
template <class Scalar, int Dof>
int SideOf(const Constraint<Scalar, Dof>& constraint) {
  return constraint.bodies[0] < constraint.bodies[1] ? 1 : -1;
}

template <class Body>
auto MotionOf(const Body& body) {
  return std::tuple(body.position, body.rotation, body.velocity, body.spin);
}

// From which rows on an island is solved in factors before A is formed, and a start is worth more than it
// costs. Positions have no friction, and joints leave their problems: of a few rows they are cheap with A.
constexpr int FactorRows(Level level, int dimension) {
  return level == Level::kPositions ? 100 : dimension == 2 ? 40 : 10;
}

// Up to which it may be worth while to form A: polygons and complete driving come last, and grow fast.
constexpr int DenseRows(int dimension) { return dimension == 2 ? 300 : 100; }

// In factors, from the start if there is one, then without; then with A. A small island the other way round:
// in factors what has no answer, or a loose one.
template <class Kind, class Model>
SceneAnswer SolveIsland(SceneSolver& solver, const Model& model, Level level, std::size_t island,
                        const Eigen::VectorXd& start) {
  const auto is_better = [](const SceneAnswer& answer, const SceneAnswer& best) {
    return answer.Solved() || (!best.Solved() && answer.error < best.error);
  };
  const int rows = model.islands[island].rows;
  if (rows < FactorRows(level, Kind::kDimension)) {
    SceneAnswer answer = solver.Solve(model.Problem(island));
    if (answer.Solved() && answer.counters[Counter::kLoose] == 0) return answer;
    SceneAnswer other = solver.Solve(model.InFactors(island));
    return is_better(other, answer) ? other : answer;
  }
  const auto problem = model.InFactors(island);
  Runs<SceneAnswer> runs;
  if (start.size() > 0) runs.emplace_back([&] { return solver.Solve(problem, &start); });
  runs.emplace_back([&] { return solver.Solve(problem); });
  if (rows <= DenseRows(Kind::kDimension))
    runs.emplace_back([&] { return solver.Solve(model.Problem(island)); });
  return InTurn(
      runs, [](const SceneAnswer& answer) { return answer.Solved(); }, is_better);
}

}  // namespace

template <class Kind>
SimulationIn<Kind>::SimulationIn(SceneType scene, double step, double rest,
                                 std::function<void(const FrameProblemIn<Kind>&)> observe)
    : scene_(std::move(scene)), frame_step_(step), observe_(std::move(observe)), solvers_() {
  const double gravity = scene_.gravity.norm();
  size_ = SizeOf(scene_);
  scene_.rest = rest > 0 ? rest : gravity > 0 ? gravity * step : kSlow * size_;
}

template <class Kind>
void SimulationIn<Kind>::Step() {
  exhausted_ = false;
  undecided_.clear();
  StepBy(frame_step_, halvings);
  ++statistics_.frames;
  statistics_.contacts += static_cast<std::int64_t>(contacts_.size());
  statistics_.deep += exhausted_;
}

// At once or, where that ends too deep, from the same state in two halves.
template <class Kind>
void SimulationIn<Kind>::StepBy(double h, int halvings_left) {
  if (!is_near_known_) FindNear();
  const double allowed = std::max(scene_.gap > 0 ? scene_.gap : kDeep * size_, Overlap());
  std::vector<decltype(MotionOf(scene_.bodies[0]))> before;
  before.reserve(scene_.bodies.size());
  for (const auto& body : scene_.bodies) before.push_back(MotionOf(body));
  const double step_before = before_;
  const std::size_t told = undecided_.size();
  step_ = h;
  TakeStep();
  FindNear();
  if (exhausted_ || Overlap() <= allowed) return;
  exhausted_ = halvings_left == 0;
  if (exhausted_) return;
  ++statistics_.halved;
  undecided_.resize(told);
  for (std::size_t i = 0; i < before.size(); ++i) {
    auto& body = scene_.bodies[i];
    std::tie(body.position, body.rotation, body.velocity, body.spin) = before[i];
  }
  before_ = step_before;
  is_near_known_ = false;
  for (int half = 0; half < 2; ++half) StepBy(h / 2, halvings_left - 1);
}

template <class Kind>
void SimulationIn<Kind>::TakeStep() {
  FindStepContacts();
  if (HasDrifted()) {
    if (Collides()) ApplyImpulses();
    CorrectPositions();
  }
  Changes accelerations(scene_.bodies.size(), Eigen::Matrix<double, Kind::kDof, 1>::Zero());
  do {
    if (Collides()) ApplyImpulses();
  } while (AddClosing(accelerations));
  solved_.clear();
  do {
    accelerations = Accelerations();
  } while (AddClosing(accelerations));
  Move(accelerations);
}

template <class Kind>
double SimulationIn<Kind>::Overlap() const {
  double overlap = 0;
  for (const auto& contact : near_) overlap = std::max(overlap, -contact.gap);
  return overlap;
}

template <class Kind>
auto SimulationIn<Kind>::AssembleAt(Level level) const -> Model {
  return Assemble(scene_, contacts_, level, minimal, step_, before_);
}

template <class Kind>
void SimulationIn<Kind>::FindNear() {
  double fastest = scene_.gravity.norm() * frame_step_;
  for (const auto& body : scene_.bodies) fastest = std::max(fastest, FastestPoint(body));
  near_ = FindContacts(scene_, 2 * frame_step_ * fastest);
  is_near_known_ = true;
}

template <class Kind>
void SimulationIn<Kind>::FindStepContacts() {
  if (!is_near_known_) FindNear();
  is_near_known_ = false;
  contacts_ = std::move(near_);
  const auto beyond = std::stable_partition(contacts_.begin(), contacts_.end(), [this](const Touch& contact) {
    return contact.gap + step_ * ApproachOf(scene_, contact) <= scene_.gap;
  });
  beyond_.assign(beyond, contacts_.end());
  contacts_.erase(beyond, contacts_.end());
}

// Whether the contact would overlap at the end of the step, to first order.
template <class Kind>
bool SimulationIn<Kind>::Closes(const Touch& contact, const Changes& accelerations) const {
  const double h = step_;
  const auto normal = ContactConstraint(scene_, contact).rows[0];
  const double change = normal.J[0].dot(accelerations[contact.a]) + normal.J[1].dot(accelerations[contact.b]);
  const double speed = ApproachOf(scene_, contact) + Kick() * change + h / 2 * normal.bias;
  return !(contact.gap + h * speed >= -kDrift * size_);
}

// Moves from beyond_ to contacts_ what closes; whether there was anything.
template <class Kind>
bool SimulationIn<Kind>::AddClosing(const Changes& accelerations) {
  const auto closing = std::stable_partition(
      beyond_.begin(), beyond_.end(), [&](const Touch& contact) { return !Closes(contact, accelerations); });
  const bool found = closing != beyond_.end();
  contacts_.insert(contacts_.end(), closing, beyond_.end());
  beyond_.erase(closing, beyond_.end());
  return found;
}

// ---- Solving ---------------------------------------------------------------------------------

// Islands that are not known of an earlier round of the step, at the same time where there is work enough:
// every answer depends on its own problem alone. False where an island is undecided; if these forces are the
// last word, that is told.
template <class Kind>
bool SimulationIn<Kind>::Solve(const Model& model, Level level, bool is_last, Forces& f) {
  const std::size_t count = model.islands.size();
  f.assign(count, {});
  std::vector<std::size_t> open;
  int largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (level == Level::kForces) {
      const auto known = solved_.find(KeyOf(model, i));
      if (known != solved_.end()) {
        f[i] = known->second;
        continue;
      }
    }
    open.push_back(i);
    const int rows = model.islands[i].rows;
    ++statistics_.problems;
    statistics_.rows += rows;
    largest = std::max(largest, rows);
  }

  std::vector<SceneAnswer> answers(open.size());
  const auto solve = [&](std::size_t k) {
    answers[k] = SolveIsland<Kind>(solvers_.local(), model, level, open[k], StartOf(model, level, open[k]));
  };
  if (open.size() > 1 && largest >= kParallelRows) {
    ForEachInParallel(open.size(), solve);
  } else {
    for (std::size_t k = 0; k < open.size(); ++k) solve(k);
  }
  bool solved = true;
  for (std::size_t k = 0; k < open.size(); ++k) {
    SceneAnswer& answer = answers[k];
    const std::size_t i = open[k];
    if (observe_)
      observe_({statistics_.frames, level, static_cast<int>(i), model, answer.f, answer.Solved() || is_last});
    statistics_.fallbacks += answer.counters[Counter::kFallbacks];
    statistics_.loose += answer.counters[Counter::kLoose];
    statistics_.sparse += answer.counters[Counter::kSparse];
    statistics_.warm += answer.counters[Counter::kWarm];
    solved = solved && answer.Solved();
    f[i] = std::move(answer.f);
    if (answer.Solved()) {
      if (level == Level::kForces) solved_.emplace(KeyOf(model, i), f[i]);
    } else if (is_last) {
      ++statistics_.undecided;
      undecided_.push_back(
          {statistics_.frames, time(), level, static_cast<int>(i), answer.error, model.Problem(i)});
    }
  }
  return solved;
}

// The same constraints of one state are the same problem.
template <class Kind>
auto SimulationIn<Kind>::KeyOf(const Model& model, std::size_t island) const -> IslandKey {
  IslandKey key;
  for (const int k : model.islands[island].constraints) {
    const auto& constraint = model.constraints[k];
    key.push_back(
        {constraint.from_joint, constraint.source, constraint.part, static_cast<int>(constraint.law.kind)});
  }
  return key;
}

// Forces of the step before, by row of the island; empty where no constraint of it was there. The force of a
// contact goes to the nearest of those between the same pieces, as seen from the lower body: so none counts
// twice.
template <class Kind>
Eigen::VectorXd SimulationIn<Kind>::StartOf(const Model& model, Level level, std::size_t island) const {
  const bool is_small = model.islands[island].rows < FactorRows(level, Kind::kDimension);
  if (!warm || level != Level::kForces || is_small || remembered_.empty()) return {};
  std::vector<Remembered> now;
  int row = 0;
  for (const int k : model.islands[island].constraints) {
    now.push_back(Known(model.constraints[k], row));
    row += static_cast<int>(model.constraints[k].rows.size());
  }
  std::stable_sort(now.begin(), now.end(), IsBefore);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(row);
  std::size_t found = 0;
  auto from = now.begin();
  for (const Remembered& before : remembered_) {
    while (from != now.end() && IsBefore(*from, before)) ++from;
    auto nearest = from;
    for (auto at = from; at != now.end() && at->key == before.key; ++at) {
      if ((at->place - before.place).squaredNorm() < (nearest->place - before.place).squaredNorm())
        nearest = at;
    }
    if (nearest == now.end() || nearest->key != before.key) continue;
    ++found;
    const auto& constraint = *nearest->constraint;
    for (std::size_t k = 0; k < constraint.rows.size(); ++k)
      start[nearest->row + static_cast<int>(k)] +=
          constraint.from_joint ? before.along
                                : SideOf(constraint) * before.force.dot(WayOf(constraint.rows[k]));
  }
  if (found + now.size() / kNewShare < now.size()) start.resize(0);
  return start;
}

template <class Kind>
auto SimulationIn<Kind>::Known(const ConstraintIn<Kind, double>& constraint, int row) const -> Remembered {
  Remembered known;
  known.constraint = &constraint;
  known.row = row;
  if (constraint.from_joint) {
    known.key = {-1, constraint.source, constraint.part, 0, 0};
    return known;
  }
  const Touch& contact = contacts_[constraint.source];
  const std::array<int, 2> a = {contact.a, contact.shape_a}, b = {contact.b, contact.shape_b};
  const auto [lower, higher] = std::minmax(a, b);
  known.key = {0, lower[0], lower[1], higher[0], higher[1]};
  known.place = contact.point - scene_.bodies[lower[0]].position;
  return known;
}

template <class Kind>
auto SimulationIn<Kind>::Response(const Model& model, const Forces& f) const -> Changes {
  Changes change(model.bodies.size(), Eigen::Matrix<double, Kind::kDof, 1>::Zero());
  for (std::size_t i = 0; i < model.islands.size(); ++i)
    AddResponse(model.bodies, model.constraints, model.islands[i], f[i], change);
  return change;
}

// ---- Positions and impulses ------------------------------------------------------------------

template <class Kind>
bool SimulationIn<Kind>::HasDrifted() const {
  const auto overlaps = [this](const Touch& contact) { return contact.gap < -kDrift * size_; };
  if (std::any_of(contacts_.begin(), contacts_.end(), overlaps)) return true;
  if (scene_.joints.empty()) return false;
  const auto joints = JointConstraints(scene_);
  return std::any_of(joints.begin(), joints.end(), [this](const auto& joint) {
    const bool turns = WayOf(joint.rows[0]).isZero(0);  // its error is the sine of an angle
    return std::abs(joint.rows[0].error) > kDrift * (turns ? 1 : size_);
  });
}

template <class Kind>
void SimulationIn<Kind>::CorrectPositions() {
  ++statistics_.corrections;
  const Model model = AssembleAt(Level::kPositions);
  Forces f;
  Solve(model, Level::kPositions, true, f);
  const Changes change = Response(model, f);
  for (std::size_t i = 0; i < change.size(); ++i) Displace(scene_.bodies[i], change[i]);
  FindStepContacts();
}

template <class Kind>
bool SimulationIn<Kind>::Collides() const {
  return std::any_of(contacts_.begin(), contacts_.end(),
                     [this](const Touch& contact) { return Collides(contact); });
}

template <class Kind>
bool SimulationIn<Kind>::Collides(const Touch& contact) const {
  const auto closes = [&](double speed) {
    return speed < -scene_.rest && std::max(contact.gap, 0.0) + step_ * speed < 0;
  };
  const double speed = ApproachOf(scene_, contact);
  return closes(speed) && closes(speed - before_ / 2 * ContactConstraint(scene_, contact).rows[0].bias);
}

// To the islands alone in which something collides.
template <class Kind>
void SimulationIn<Kind>::ApplyImpulses() {
  ++statistics_.collisions;
  Model model = AssembleAt(Level::kImpulses);
  std::erase_if(model.islands, [&](const auto& island) {
    return std::none_of(island.constraints.begin(), island.constraints.end(), [&](int k) {
      const auto& constraint = model.constraints[k];
      return !constraint.from_joint && Collides(contacts_[constraint.source]);
    });
  });
  Forces p;
  Solve(model, Level::kImpulses, true, p);
  const Changes change = Response(model, p);
  for (std::size_t i = 0; i < change.size(); ++i) AddVelocity(scene_.bodies[i], change[i]);
}

// ---- Forces ----------------------------------------------------------------------------------

template <class Kind>
auto SimulationIn<Kind>::Accelerations() -> Changes {
  for (Touch& contact : contacts_) contact.held = contact.closing = false;
  for (int round = 0;; ++round) {
    Model model = AssembleAt(Level::kForces);
    const bool all_held = std::ranges::all_of(contacts_, &Touch::held);
    Forces f;
    if (!Solve(model, Level::kForces, all_held, f) && !all_held) {
      ++statistics_.impulsive;
      for (Touch& contact : contacts_) contact.held = true;
      continue;
    }
    Remember(model, f);
    Changes accelerations = BodyAccelerations(model, f);
    const int reversing = all_held ? 0 : HoldReversing(model, accelerations);
    statistics_.stopped += reversing;
    const int back = KeepClosing(model, accelerations);
    if ((reversing == 0 && back == 0) || round >= kHoldRounds) {
      KeepForces(std::move(model), f, accelerations);
      return accelerations;
    }
  }
}

// Of a row, with the velocities of this step.
template <class Kind>
double SimulationIn<Kind>::SpeedAfter(const Model& model, const ConstraintIn<Kind, double>& constraint, int row,
                                      const Changes& accelerations) const {
  double speed = Velocity(constraint, row, model.bodies) + step_ / 2 * constraint.rows[row].bias;
  for (int side = 0; side < 2; ++side)
    speed += Kick() * constraint.rows[row].J[side].dot(accelerations[constraint.bodies[side]]);
  return speed;
}

// Marks the sliding contacts whose tangential velocity would turn round within the step.
template <class Kind>
int SimulationIn<Kind>::HoldReversing(const Model& model, const Changes& accelerations) {
  int count = 0;
  for (const auto& constraint : model.constraints) {
    if (constraint.law.kind != ContactKind::kSliding) continue;
    double along = 0;  // the slip
    for (int row = 1; row < Kind::kDimension; ++row)
      along += SpeedAfter(model, constraint, row, accelerations) * constraint.law.slip[row - 1];
    if (along >= 0) continue;
    contacts_[constraint.source].held = true;
    ++count;
  }
  return count;
}

// Marks the contacts left out because they part that would be back, and overlap, at the end of the step.
template <class Kind>
int SimulationIn<Kind>::KeepClosing(const Model& model, const Changes& accelerations) {
  int count = 0;
  for (const int i : model.parting) {
    contacts_[i].closing = Closes(contacts_[i], accelerations);
    count += contacts_[i].closing;
  }
  return count;
}

// A contact without friction has its tangents all the same.
template <class Kind>
double SimulationIn<Kind>::SlipOf(const Model& model, const ConstraintIn<Kind, double>& constraint,
                                  const Changes& accelerations) const {
  const bool is_smooth = constraint.rows.size() < Kind::kDimension;
  const auto whole = is_smooth ? ContactConstraint(scene_, contacts_[constraint.source]) : constraint;
  double squares = 0;
  for (int row = 1; row < Kind::kDimension; ++row) {
    const double speed = SpeedAfter(model, whole, row, accelerations);
    squares += speed * speed;
  }
  return std::sqrt(squares);
}

template <class Kind>
void SimulationIn<Kind>::KeepForces(Model model, const Forces& f, const Changes& accelerations) {
  forces_.clear();
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    int at = 0;
    for (const int k : model.islands[i].constraints) {
      const auto& constraint = model.constraints[k];
      Applied force;
      force.bodies = constraint.bodies;
      force.from_joint = constraint.from_joint;
      force.force.setZero();
      force.law = constraint.law;
      force.source = constraint.source;
      if (!constraint.from_joint) force.slip = SlipOf(model, constraint, accelerations);
      for (const auto& row : constraint.rows) {
        force.ways.push_back(WayOf(row));
        force.rows.push_back(f[i][at++]);
        force.force += force.ways.back() * force.rows.back();
      }
      if (constraint.from_joint) {
        const auto& joint = scene_.joints[constraint.source];
        force.point = scene_.bodies[joint.a].At(joint.at_a);
      } else {
        force.point = contacts_[constraint.source].point;
      }
      forces_.push_back(std::move(force));
    }
  }
  model_ = std::move(model);
}

// Forces to start the next problem from.
template <class Kind>
void SimulationIn<Kind>::Remember(const Model& model, const Forces& f) {
  remembered_.clear();
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    int at = 0;
    for (const int k : model.islands[i].constraints) {
      const auto& constraint = model.constraints[k];
      Remembered& remembered = remembered_.emplace_back(Known(constraint, 0));
      remembered.along = f[i][at];
      for (const auto& row : constraint.rows)
        remembered.force += WayOf(row) * (SideOf(constraint) * f[i][at++]);
      remembered.constraint = nullptr;
    }
  }
  std::stable_sort(remembered_.begin(), remembered_.end(), IsBefore);
}

template <class Kind>
void SimulationIn<Kind>::Move(const Changes& accelerations) {
  for (std::size_t i = 0; i < accelerations.size(); ++i)
    Advance(scene_.bodies[i], accelerations[i], Kick(), step_);
  before_ = step_;
}

template class SimulationIn<Plane>;
template class SimulationIn<Space>;

std::string TextOf(const UndecidedProblem& undecided) {
  return fmt::format(
      "frame {}, t = {:.6g} s: the problem of {} of island {} ({} rows) is undecided; the best forces miss "
      "{:.2g} of what acts",
      undecided.frame, undecided.time, kLevelNames[static_cast<int>(undecided.level)], undecided.island + 1,
      undecided.problem.rows(), undecided.error);
}

// ---- Measures --------------------------------------------------------------------------------

template <class Kind>
double SizeOf(const SceneIn<Kind, double>& scene) {
  double radius = 0;
  const auto include = [&](int body, const auto& local) {
    if (!scene.bodies[body].fixed) radius = std::max(radius, local.norm());
  };
  for (const auto& body : scene.bodies) {
    if (!body.fixed) radius = std::max(radius, RadiusOf(body));
  }
  for (const auto& joint : scene.joints) {
    include(joint.a, joint.at_a);
    include(joint.b, joint.at_b);
  }
  for (const auto& contact : scene.contacts) {
    include(contact.a, contact.at_a);
    include(contact.b, contact.at_b);
  }
  return radius > 0 ? 2 * radius : 1;
}
template double SizeOf(const Scene<double>&);
template double SizeOf(const SceneInSpace<double>&);

template <class Kind>
Energy EnergyOf(const SceneIn<Kind, double>& scene) {
  Energy energy;
  for (const auto& body : scene.bodies) {
    if (body.fixed) continue;
    energy.kinetic += (body.mass * body.velocity.squaredNorm() + SpinEnergy(body)) / 2;
    energy.potential -= body.mass * scene.gravity.dot(body.position);
  }
  return energy;
}
template Energy EnergyOf(const Scene<double>&);
template Energy EnergyOf(const SceneInSpace<double>&);

template <class Kind>
Drift DriftOf(const SceneIn<Kind, double>& scene) {
  Drift drift;
  for (const auto& joint : JointConstraints(scene))
    drift.joints = std::max(drift.joints, std::abs(joint.rows[0].error));
  for (const auto& contact : FindContacts(scene)) drift.overlap = std::max(drift.overlap, -contact.gap);
  return drift;
}
template Drift DriftOf(const Scene<double>&);
template Drift DriftOf(const SceneInSpace<double>&);

}  // namespace stiction
