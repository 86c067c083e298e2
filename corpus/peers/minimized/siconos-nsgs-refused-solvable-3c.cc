/* refused-solvable-3c: siconos-nsgs 4.4.0 gives up a problem that has a solution.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-nsgs-refused-solvable-3c.cc \
 *         -lsiconos_numerics -o siconos-nsgs-refused-solvable-3c && ./siconos-nsgs-refused-solvable-3c */
#include <NonSmoothDrivers.h>
#include <fc3d_Solvers.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 1, DIMENSION = 2 };
static const double A[] = {
    1, -1,
    -1, 1};
static const double b[] = {-1, 1};
static const int kinds[] = {2}, findex[] = {-1, 0};
static const double low[] = {0, -1}, high[] = {INFINITY, 1}, mu[] = {1};
/* exact, and verified */ static const double right[] = {1. / 2., -1. / 2.};
static int solve(double* f) { /* a frictionless contact: mu = 0, and tangents that are coupled with nothing */
  enum { N = CONTACTS * DIMENSION }; int at[ROWS]; double m[N * N] = {0}, q[N] = {0}, forces[N] = {0}, velocities[N] = {0};
  for (int i = 0, row = 0; i < N; ++i)
    if (i % DIMENSION == 0 || kinds[i / DIMENSION] == 2) q[i] = b[row], at[row++] = i; else m[i * N + i] = 1;
  for (int i = 0; i < ROWS * ROWS; ++i) m[at[i % ROWS] * N + at[i / ROWS]] = A[i]; /* column after column */
  FrictionContactProblem problem = {DIMENSION, CONTACTS, NM_create_from_data(NM_DENSE, N, N, m), q, (double*)mu};
  SolverOptions* options = solver_options_create(SICONOS_FRICTION_2D_NSGS);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-9; options->iparam[SICONOS_IPARAM_MAX_ITER] = 100000;
  const int info = fc2d_driver(&problem, forces, velocities, options);
  for (int i = 0; i < ROWS; ++i) f[i] = forces[at[i]];
  solver_options_delete(options), free(NM_free_not_dense(problem.M));
  return info == 0;
}
int main(void) {
  double f[ROWS] = {0}, a[ROWS];
  const int solved = solve(f);
  printf("it %s\nrow %24s %24s %24s\n", solved ? "calls this solved:" : "gives up:", "f", "a = A f + b", "right f");
  for (int i = 0; i < ROWS; ++i) {
    long double sum = b[i];
    for (int j = 0; j < ROWS; ++j) sum += (long double)A[i * ROWS + j] * f[j];
    printf("%3d %24.17g %24.17g %24.17g\n", i, f[i], a[i] = (double)sum, right[i]);
  }
  printf(solved ? "not seen here: it gives up\n" : "WRONG: it gives up, and there are right forces\n");
  return !solved;
}
