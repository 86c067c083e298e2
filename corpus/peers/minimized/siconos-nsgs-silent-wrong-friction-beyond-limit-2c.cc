/* silent-wrong-friction-beyond-limit-2c: siconos-nsgs 4.4.0 calls forces solved with which friction is beyond its limit.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-nsgs-silent-wrong-friction-beyond-limit-2c.cc \
 *         -lsiconos_numerics -o siconos-nsgs-silent-wrong-friction-beyond-limit-2c && ./siconos-nsgs-silent-wrong-friction-beyond-limit-2c */
#include <NonSmoothDrivers.h>
#include <fc3d_Solvers.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 1, DIMENSION = 2 };
static const double A[] = {
    1, 2,
    2, 4};
static const double b[] = {-50, -100};
static const int kinds[] = {2}, findex[] = {-1, 0};
static const double low[] = {0, -5}, high[] = {INFINITY, 5}, mu[] = {5};
/* exact, and verified */ static const double right[] = {50. / 11., 250. / 11.};
static const double force[] = {100, 500}, acts[] = {100, 200}; /* that act at each row: a force, an acceleration */
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
static double worst = 1e-06; /* what it states */ static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double normal = high[i] > 1e300, of_normal = findex[i] < 0 ? 1 : fmax(0, f[findex[i]]), lo = low[i] * of_normal, hi = high[i] * of_normal;
    miss(i, fmax(lo - f[i], f[i] - hi) / force[i], normal ? "pulls" : "is beyond the limit of friction");
    if (a[i] > 0) miss(i, fmin((f[i] - lo) / force[i], a[i] / acts[i]), normal ? "presses and separates" : "slips below its limit");
    if (a[i] < 0) miss(i, fmin((hi - f[i]) / force[i], -a[i] / acts[i]), normal ? "moves inward" : "slips below its limit");
  }
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
  if (solved) judge(f, a);
  return printf("%s%s\n", *said ? "WRONG: " : "not seen here: what was found", said), *said != 0;
}
