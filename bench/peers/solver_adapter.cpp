// SPDX-License-Identifier: Apache-2.0
// A solver of another package as a library that `stiction search --solver` tests
// (search/under_test/stiction_solver.h): compiled once for each, which CMakeLists.txt names.
//
//   ADAPTER_NAME, ADAPTER_VERSION, ADAPTER_LAW   as stiction_solver_describe says them
//   ADAPTER_ACCURACY                             likewise
//   ADAPTER_MAKE, ADAPTER_ARGUMENTS              what makes the contender (contender.h)

#include "bench/peers/contender.h"
#include "search/under_test/stiction_solver.h"

namespace {

stiction::PeerProblem ProblemOf(const stiction_solver_problem& posed) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  stiction::PeerProblem problem;
  problem.dimension = posed.dimension;
  for (int i = 0; i < posed.contacts; ++i)
    problem.contacts.push_back({static_cast<stiction::ContactKind>(posed.kinds[i]), posed.mu[i], {}});
  problem.A = Eigen::Map<const Matrix>(posed.A, posed.rows, posed.rows);
  problem.b = Eigen::Map<const Eigen::VectorXd>(posed.b, posed.rows);
  return problem;
}

static_assert(static_cast<int>(stiction::ContactKind::kBilateral) == STICTION_BILATERAL);
static_assert(static_cast<int>(stiction::ContactKind::kFrictionless) == STICTION_FRICTIONLESS);
static_assert(static_cast<int>(stiction::ContactKind::kStatic) == STICTION_STATIC);

constexpr stiction_solver_info kInfo = {STICTION_SOLVER_INTERFACE, ADAPTER_NAME, ADAPTER_VERSION, ADAPTER_LAW,
                                        ADAPTER_ACCURACY};

}  // namespace

const stiction_solver_info* stiction_solver_describe() { return &kInfo; }

void* stiction_solver_create() { return stiction::ADAPTER_MAKE(ADAPTER_ARGUMENTS).release(); }

int stiction_solver_solve(void* solver, const stiction_solver_problem* posed, double* forces) {
  auto& contender = *static_cast<stiction::Contender*>(solver);
  contender.Load({ProblemOf(*posed)});
  const bool solved = contender.Solve(0);
  Eigen::Map<Eigen::VectorXd>(forces, posed->rows) = contender.Forces();
  return solved ? 1 : 0;
}

void stiction_solver_destroy(void* solver) { delete static_cast<stiction::Contender*>(solver); }
