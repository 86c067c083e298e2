// SPDX-License-Identifier: Apache-2.0
#include "scene/solve_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/numeric/body_newton.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/fast.h"
#include "solver/numeric/interior_point.h"
#include "solver/numeric/proximal.h"
#include "solver/problem/lenient.h"
#include "solver/problem/pressing.h"
#include "solver/problem/reduction.ipp"
#include "solver/problem/row_scale.h"

namespace stiction {
namespace {

constexpr double kProximalAim = 1e-13;     // a residual beyond which proximal points gain nothing
constexpr double kCoulombResidual = 1e-7;  // of problems in space

constexpr double kProximal = 1e-9;  // of the largest A_ii; well above the tolerance of pivots, 1e-11
constexpr int kProximalPoints = 3;

// What a scene makes of b is known to a few roundings of its largest entry. Accelerations of that size are no
// error: rows that nothing else acts on, as the second hinge of an axis has some, would be held to rounding.
constexpr double kNoise = 1e-11;
// And joints that repeat each other, as two hinges of a door do, contradict each other by what is curved in
// their drift.
constexpr double kNoiseOfRepeated = 1e-7;

// Of Newton's method: what it has not done then from a start it seldom does.
constexpr int kFailures = 1, kStepsFromStart = 6;
constexpr double kAim = 1e-9;  // lenient error at which it ends

template <class Problem>
double NoiseOf(const Problem& problem, double share = kNoise) {
  return problem.rows() > 0 ? share * problem.b.cwiseAbs().maxCoeff() : 0;
}

Eigen::VectorXd AccelerationsOf(const ContactProblem<double>& problem, const Eigen::VectorXd& f) {
  return problem.A * f + problem.b;
}
Eigen::VectorXd AccelerationsOf(const FactoredProblem<double>& problem, const Eigen::VectorXd& f) {
  return problem.Accelerations(f);
}

// The largest lenient error of forces.
template <class Problem>
double ErrorOf(const Problem& problem, const typename Problem::Vector& f, double share = kNoise) {
  LenientUnits<double> units;
  return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, AccelerationsOf(problem, f), units,
                          NoiseOf(problem, share))
      .error;
}

constexpr double kMostPressing = 1e7;  // of forces that are no sign that there is no solution
// Of what acts, by forces that are measured in units of their own: of what grows without end they miss all of
// it.
constexpr double kMostMissed = 1.0 / 16;

// Errors of a problem with the rows that reduction took out.
constexpr double kWholeResidual = 1e-7, kLooseWholeResidual = 10 * kLooseResidual;

// Of what is undecided: the error of its forces; of those that grow without end, which are taken in part,
// beside what acts. No forces, if they are worse.
template <class Problem>
void KeepBest(const Problem& problem, SceneAnswer& answer) {
  if (answer.Solved()) return;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.rows());
  answer.error = ErrorOf(problem, none);
  const bool are_forces = answer.f.size() == problem.rows() && answer.f.allFinite();
  const double pressing = are_forces ? Pressing(problem, answer.f) : 0;
  const bool is_part = pressing > kMostPressing;
  if (is_part) answer.f *= kMostPressing / pressing;
  const double error = are_forces ? ErrorOf(problem, answer.f) * (is_part ? kMostPressing : 1) : answer.error;
  if (are_forces && error <= answer.error) {
    answer.error = error;
  } else {
    answer.f = none;
  }
}

template <class Problem>
bool HasFriction(const Problem& problem) {
  return std::any_of(problem.contacts.begin(), problem.contacts.end(),
                     [](const auto& contact) { return contact.HasFrictionRows(); });
}

// Whether contacts with a force have no tangential acceleration to speak of.
bool NothingSlips(const FactoredProblem<double>& problem, const Eigen::VectorXd& f, const Eigen::VectorXd& a) {
  const double slow = kLooseResidual * problem.b.cwiseAbs().maxCoeff();
  bool slips = false;
  ForEachContact(problem, [&](int, int row, int rows) {
    if (f[row] > 0) slips |= TangentLength(a, row, rows) > slow;
  });
  return !slips;
}

// Whether f = 0 is a solution.
template <class Problem>
bool IsAtRestWithoutForces(const Problem& problem) {
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const double normal = problem.b[row];
    if (contact.kind == ContactKind::kBilateral ? normal != 0 : !(normal >= 0)) return false;
    row += contact.HasFrictionRows() ? problem.dimension : 1;
  }
  return true;
}

// Joints that repeat each other, as two hinges of a door do, contradict each other by rounding, which may be
// much beside a small drift; the residual of the whole problem has the last word.
Tolerances ForReduction(Tolerances tolerances, int dimension) {
  tolerances.acceleration = dimension == 3 ? kLooseWholeResidual : kWholeResidual;
  return tolerances;
}

}  // namespace

// The order is that of the turns; the methods keep their memory.
class SceneSolver::Methods {
 public:
  Methods() : proximal_({}, kProximalAim), coulomb_({.residual = kCoulombResidual}) {
    bodies_.measures_start = false;
  }

  SceneAnswer Solve(const ContactProblem<double>& problem);
  SceneAnswer Solve(const FactoredProblem<double>& problem, const Eigen::VectorXd* start);

 private:
  using Dense = ContactProblem<double>;

  // A method, and whose turn it is.
  struct Turn {
    int dimension;
    bool friction;
    bool (Methods::*run)(const Dense&, SceneAnswer&);
  };
  static const Turn kTurns[];

  SceneAnswer SolveScaled(const Dense& problem);
  void FromNothing(const FactoredProblem<double>& problem, SceneAnswer& answer);
  // error_of(f): by which forces are taken where no method ends in a solution.
  template <class Error>
  bool TryInTurn(const Dense& problem, SceneAnswer& answer, Error error_of);
  bool GuessCells(const Dense& problem, const std::vector<Cell>& guess);

  bool Cells(const Dense& problem, SceneAnswer& answer);
  bool NearCells(const Dense& problem, SceneAnswer& answer);
  bool Proximal(const Dense& problem, SceneAnswer& answer);
  bool RunProximal(const SparseContactProblem<double>& problem, SceneAnswer& answer);
  bool Complete(const Dense& problem, SceneAnswer& answer);
  bool Coulomb(const Dense& problem, SceneAnswer& answer);

  FastSolver<double> fast_;
  ProximalNewton<double> proximal_;
  CoulombSolver<double> coulomb_;
  BodyNewton bodies_;
  InteriorPoint interior_;
};

const SceneSolver::Methods::Turn SceneSolver::Methods::kTurns[] = {
    {2, true, &Methods::Cells},     {2, true, &Methods::NearCells}, {2, true, &Methods::Proximal},
    {2, true, &Methods::Complete},  {3, true, &Methods::Coulomb},   {2, false, &Methods::Complete},
    {2, false, &Methods::Proximal},
};

SceneSolver::SceneSolver() : methods_(std::make_unique<Methods>()) {}
SceneSolver::~SceneSolver() = default;

SceneAnswer SceneSolver::Solve(const ContactProblem<double>& problem) { return methods_->Solve(problem); }
SceneAnswer SceneSolver::Solve(const FactoredProblem<double>& problem, const Eigen::VectorXd* start) {
  return methods_->Solve(problem, start);
}

SceneAnswer SceneSolver::Methods::Solve(const Dense& problem) {
  const RowScale scale = FindScale(problem);
  SceneAnswer answer = SolveScaled(Scaled(problem, scale));
  if (answer.f.size() == problem.rows()) ScaleBy(answer.f, scale.f);
  KeepBest(problem, answer);
  return answer;
}

SceneAnswer SceneSolver::Methods::SolveScaled(const Dense& problem) {
  SceneAnswer answer;
  fast_.request().noise = NoiseOf(problem);  // of the whole: what is reduced has it, too
  if (!Reduction<double>::Concerns(problem)) {
    const auto of = [&](const Dense::Vector& f) { return ErrorOf(problem, f); };
    if (TryInTurn(problem, answer, of)) answer.outcome = Outcome::kSolved;
    return answer;
  }
  const Reduction<double> reduction(problem, ForReduction(fast_.request().tolerances, problem.dimension));
  if (reduction.end() != ReductionEnd::kReduced) return answer;
  answer.f.resize(0);
  // What remains may be held to the rounding of what was taken out; the whole is not.
  const auto of_whole = [&](const Dense::Vector& f) {
    return ErrorOf(problem, reduction.Forces(f), kNoiseOfRepeated);
  };
  if (reduction.problem().rows() > 0 && !TryInTurn(reduction.problem(), answer, of_whole)) return answer;
  answer.f = reduction.Forces(answer.f);
  const double error = ErrorOf(problem, answer.f, kNoiseOfRepeated);
  if (!(error <= kLooseWholeResidual)) return answer;
  answer.outcome = Outcome::kSolved;
  if (answer.counters[Counter::kLoose] == 0 && error > kWholeResidual) ++answer.counters[Counter::kLoose];
  return answer;
}

SceneAnswer SceneSolver::Methods::Solve(const FactoredProblem<double>& problem, const Eigen::VectorXd* start) {
  SceneAnswer answer;
  bodies_.request().noise = interior_.request().noise = NoiseOf(problem);
  bodies_.failures = kFailures;
  bodies_.steps = start != nullptr ? kStepsFromStart : BodyNewton::kSteps;
  if (start == nullptr) {
    FromNothing(problem, answer);
  } else if (IsAtRestWithoutForces(problem)) {
    answer.f.setZero(problem.rows());
    answer.outcome = Outcome::kSolved;
  } else {
    answer.outcome = bodies_.Run(problem, start).outcome;
    answer.f = bodies_.f();
    // Where something slips, no better forces are asked for from nothing.
    if (!answer.Solved() && ErrorOf(problem, answer.f) <= kAim &&
        Pressing(problem, answer.f) <= kMostPressing && !NothingSlips(problem, answer.f, bodies_.a()))
      answer.outcome = Outcome::kSolved;
  }
  if (start == nullptr) KeepBest(problem, answer);
  if (!answer.Solved()) return answer;
  ++answer.counters[Counter::kSparse];
  answer.counters[Counter::kWarm] += start != nullptr;
  return answer;
}

// By the interior point, which Newton's method ends. Where nothing slips and that is not strictly right,
// Newton's method from f = 0 mostly is: bodies at rest stay where they are.
void SceneSolver::Methods::FromNothing(const FactoredProblem<double>& problem, SceneAnswer& answer) {
  interior_.measure = BestForces::Measure::kLenient;
  interior_.loose = kLooseResidual;
  interior_.aim = kAim;
  interior_.Run(problem);
  answer.f = interior_.f();
  const double error = interior_.error(), pressing = Pressing(problem, answer.f);
  if (!(error <= kLooseResidual) || pressing > kMostPressing || error * pressing > kMostMissed) return;
  answer.outcome = Outcome::kSolved;
  if (!interior_.IsStrict() && NothingSlips(problem, answer.f, interior_.a())) {
    if (bodies_.Run(problem).outcome == Outcome::kSolved) {
      answer.f = bodies_.f();
      return;
    }
  }
  answer.counters[Counter::kLoose] += error > kWholeResidual;
}

template <class Error>
bool SceneSolver::Methods::TryInTurn(const Dense& problem, SceneAnswer& answer, Error error_of) {
  const bool friction = HasFriction(problem);
  if (!friction && problem.dimension == 3) {
    Dense planar = problem;  // one row each, as in the plane
    planar.dimension = 2;
    return TryInTurn(planar, answer, error_of);
  }
  Dense::Vector best;
  double least = kLooseResidual;
  for (const Turn& turn : kTurns) {
    if (turn.friction != friction || turn.dimension != problem.dimension) continue;
    const bool solved = (this->*turn.run)(problem, answer);
    if (answer.f.size() != problem.rows() || !answer.f.allFinite() ||
        Pressing(problem, answer.f) > kMostPressing)
      continue;
    if (solved) return true;
    const double error = error_of(answer.f);
    if (error <= kWholeResidual) return true;
    if (!(error <= least)) continue;
    least = error;
    best = answer.f;
  }
  if (best.size() == 0) return false;
  answer.f = best;
  ++answer.counters[Counter::kLoose];
  return true;
}

// ---- Methods ---------------------------------------------------------------------------------

bool SceneSolver::Methods::GuessCells(const Dense& problem, const std::vector<Cell>& guess) {
  fast_.drives = false;
  return fast_.Run(problem, guess).outcome == Outcome::kSolved;
}

bool SceneSolver::Methods::Cells(const Dense& problem, SceneAnswer& answer) {
  const bool solved = GuessCells(problem, {});
  answer.f = fast_.f();
  return solved;
}

bool SceneSolver::Methods::NearCells(const Dense& problem, SceneAnswer& answer) {
  if (problem.rows() == 0) return false;
  const double eps = kProximal * problem.A.diagonal().maxCoeff();
  Dense near = problem;
  near.A.diagonal().array() += eps;
  double residual = std::numeric_limits<double>::infinity();
  std::vector<Cell> cells;
  Dense::Vector& f = answer.f;
  f.setZero(problem.rows());
  for (int point = 0; point < kProximalPoints && residual > kProximalAim; ++point) {
    near.b = problem.b - eps * f;
    const bool solved = GuessCells(near, cells);
    f = fast_.f();
    if (!solved) return false;
    cells = fast_.cells();
    const Dense::Vector a = problem.A * f + problem.b;
    residual = MeasureErrors(problem, FrictionLaw::kCoulomb, f, a).Largest();
  }
  return residual <= ResidualOf<double>(fast_.request());
}

bool SceneSolver::Methods::Proximal(const Dense& problem, SceneAnswer& answer) {
  return RunProximal({2, problem.contacts, problem.A.sparseView(), problem.b}, answer);
}

bool SceneSolver::Methods::RunProximal(const SparseContactProblem<double>& problem, SceneAnswer& answer) {
  const bool solved = proximal_.Run(problem).outcome == Outcome::kSolved;
  answer.f = proximal_.f();
  answer.counters[Counter::kSparse] += solved;
  return solved;
}

bool SceneSolver::Methods::Complete(const Dense& problem, SceneAnswer& answer) {
  fast_.drives = true;
  const RunEnd<> verdict = fast_.Run(problem);
  answer.counters[Counter::kFallbacks] += verdict.statistics[Counter::kFallbacks];
  answer.f = fast_.f();
  return verdict.outcome == Outcome::kSolved;
}

bool SceneSolver::Methods::Coulomb(const Dense& problem, SceneAnswer& answer) {
  const RunEnd<> verdict = coulomb_.Run(problem);
  answer.counters[Counter::kFallbacks] += verdict.statistics[Counter::kPolygons] > 0;
  answer.f = coulomb_.f();
  return verdict.outcome == Outcome::kSolved;
}

}  // namespace stiction
