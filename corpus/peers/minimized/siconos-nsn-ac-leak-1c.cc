/* leak-1c: siconos-nsn-ac 4.4.0 keeps memory of every call.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-nsn-ac-leak-1c.cc \
 *         -lsiconos_numerics -o siconos-nsn-ac-leak-1c && ./siconos-nsn-ac-leak-1c */
#include <NonSmoothDrivers.h>
#include <fc3d_Solvers.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 1, CONTACTS = 1, DIMENSION = 3 };
static const double A[] = {
    1};
static const double b[] = {-1};
static const int kinds[] = {1}, findex[] = {-1};
static const double low[] = {0}, high[] = {INFINITY}, mu[] = {0};
/* with errors below 1e-8 */ static const double right[] = {1.};
static int solve(double* f) { /* a frictionless contact: mu = 0, and tangents that are coupled with nothing */
  enum { N = CONTACTS * DIMENSION }; int at[ROWS]; double m[N * N] = {0}, q[N] = {0}, forces[N] = {0}, velocities[N] = {0};
  for (int i = 0, row = 0; i < N; ++i)
    if (i % DIMENSION == 0 || kinds[i / DIMENSION] == 2) q[i] = b[row], at[row++] = i; else m[i * N + i] = 1;
  for (int i = 0; i < ROWS * ROWS; ++i) m[at[i % ROWS] * N + at[i / ROWS]] = A[i]; /* column after column */
  FrictionContactProblem problem = {DIMENSION, CONTACTS, NM_create_from_data(NM_DENSE, N, N, m), q, (double*)mu};
  SolverOptions* options = solver_options_create(SICONOS_FRICTION_3D_NSN_AC);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-9;
  const int info = fc3d_driver(&problem, forces, velocities, options);
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
  enum { CALLS = 5000, PAGE = 4096 };
  long pages[2] = {0, 0};
  for (int turn = 0; turn < 2; ++turn) {
    for (int call = 0; call < CALLS; ++call) solve(f);
    FILE* const statm = fopen("/proc/self/statm", "r");
    if (!statm || fscanf(statm, "%*d %*d %*d %*d %*d %ld", &pages[turn]) != 1) return 2;
    fclose(statm);
  }
  const double kept = (double)(pages[1] - pages[0]) * PAGE / CALLS;
  printf(kept > 0 ? "WRONG: it keeps %.3g bytes of every call\n" : "not seen here: memory that grows, %.3g\n", kept);
  return kept > 0;
}
