/* silent-wrong-presses-and-separates-2c: siconos-nsn-ac 4.4.0 calls forces solved with which a contact presses and separates.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-nsn-ac-silent-wrong-presses-and-separates-2c.cc \
 *         -lsiconos_numerics -o siconos-nsn-ac-silent-wrong-presses-and-separates-2c && ./siconos-nsn-ac-silent-wrong-presses-and-separates-2c */
#include <NonSmoothDrivers.h>
#include <fc3d_Solvers.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 6, CONTACTS = 2, DIMENSION = 3 };
static const double A[] = {
    34, 28, -2, 20, -40, 3, 28, 26, -4, 10, -30, 11,
    -2, -4, 2, 4, 0, -7, 20, 10, 4, 26, -30, -17,
    -40, -30, 0, -30, 50, 5, 3, 11, -7, -17, 5, 25};
static const double b[] = {-19, -23, 7, 5, 15, -23};
static const int kinds[] = {2, 2}, findex[] = {-1, 0, 0, -1, 3, 3};
static const double low[] = {0, -3, -3, 0, -0, -0}, high[] = {INFINITY, 3, 3, INFINITY, 0, 0}, mu[] = {3, 0};
/* with errors below 1e-8 */ static const double right[] = {6624148671804189. / 36028797018963968., 7758886630388055. / 18014398509481984., -3103554652155221. / 9007199254740992., 0., 0., 0.};
static const double force[] = {1.1550151956698222, 3.4650455870094667, 5.9581612130949635, 0.874078945936204, 0.7916322426189928, 1.6152729852116794}, acts[] = {39.270516652773956, 40.726052594341304, 11.916322426189927, 22.726052594341308, 39.58161213094964, 40.38182463029199}; /* that act at each row: a force, an acceleration */
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
static double worst = 1e-06; /* what it states */ static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double normal = high[i] > 1e300, of_normal = findex[i] < 0 ? 1 : fmax(0, f[findex[i]]), lo = low[i] * of_normal, hi = high[i] * of_normal;
    if (findex[i] >= 0) { /* both tangents of a contact */
      const double slip = hypot(a[i], a[i + 1]), askew = hypot(f[i] + hi * a[i] / slip, f[i + 1] + hi * a[i + 1] / slip);
      miss(i, (hypot(f[i], f[i + 1]) - hi) / force[i], "is beyond the limit of friction");
      miss(i, fmin(askew / force[i], slip / acts[i]), "slips, and friction is not all against it");
      ++i; continue; }
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
