// SPDX-License-Identifier: Apache-2.0
// Bullet with stiction for its solver: ten boxes on each other, every other one 100 times as heavy.
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>
#include <stiction.h>

#include <cstdio>
#include <deque>
#include <vector>

// Bullet: A x = b + w, with rows of friction that name their normal row, and mu for a bound.
struct StictionSolver : btMLCPSolverInterface {
  bool solveMLCP(const btMatrixXu& A, const btVectorXu& b, btVectorXu& x, const btVectorXu& lo,
                 const btVectorXu& hi, const btAlignedObjectArray<int>& normal_of, int, bool) override {
    std::vector<stiction_contact> contacts;
    std::vector<int> row;  // Bullet's, by ours: a normal, then its tangents
    for (int i = 0; i < b.rows(); ++i) {
      if (normal_of[i] >= 0) continue;
      if (hi[i] < 1e9 || (lo[i] < 0 && lo[i] > -1e9)) return false;  // a motor: Bullet does without us
      contacts.push_back({lo[i] < 0 ? STICTION_BILATERAL : STICTION_FRICTIONLESS, 0, {}});
      row.push_back(i);
      for (int k = 0; k < b.rows(); ++k) {
        if (normal_of[k] == i) contacts.back() = {STICTION_STATIC, hi[k], {}}, row.push_back(k);
      }
    }
    const int n = b.rows(), count = static_cast<int>(contacts.size());
    std::vector<double> ours(n * n), free(n), f(n);
    for (int i = 0; i < n * n; ++i) ours[i] = A(row[i / n], row[i % n]), free[i / n] = -b[row[i / n]];
    const stiction_dense problem = {3, count, contacts.data(), nullptr, n, 0, ours.data(), free.data()};
    stiction_answer answer = {f.data(), nullptr, nullptr, {}, 0, nullptr};
    stiction_options options;
    stiction_default_options(&options, sizeof options);
    options.noise = 1e-9;  // m/s: rounding of depths, over the length of the step
    if (stiction_solve_dense(context, &problem, &options, &answer) != STICTION_SOLVED) return false;
    for (int i = 0; i < n; ++i) x[row[i]] = f[i];
    return true;
  }
  stiction_context* context = stiction_create();
  ~StictionSolver() override { stiction_destroy(context); }
};

int main() {
  std::deque<btRigidBody> bodies;
  btBoxShape floor(btVector3(50, 1, 50)), box(btVector3(.5, .5, .5));
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  StictionSolver stiction;
  btMLCPSolver solver(&stiction);
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  for (int k = -1; k < 10; ++k) {
    const double mass = k < 0 ? 0 : k % 2 == 0 ? 1 : 100, y = k < 0 ? -1 : k + .5;
    bodies.emplace_back(mass, nullptr, k < 0 ? &floor : &box, btVector3(1, 1, 1) * (mass / 6));
    bodies.back().translate({0, y, 0});
    world.addRigidBody(&bodies.back());
  }
  for (int frame = 0; frame < 120; ++frame) world.stepSimulation(1. / 240, 0);
  const double moved = bodies.back().getCenterOfMassPosition().distance({0, 9.5, 0});
  const bool stands = moved < 1e-3 && solver.getNumFallbacks() == 0;  // steps that were left to Bullet
  std::printf("%s: moved by %.1g m\n", stands ? "stands" : "fell", moved);
  return stands ? 0 : 1;
}
