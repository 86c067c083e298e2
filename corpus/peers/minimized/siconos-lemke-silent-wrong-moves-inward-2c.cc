/* silent-wrong-moves-inward-2c: siconos-lemke 4.4.0 calls forces solved with which a contact moves inward.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-lemke-silent-wrong-moves-inward-2c.cc \
 *         -lsiconos_numerics -o siconos-lemke-silent-wrong-moves-inward-2c && ./siconos-lemke-silent-wrong-moves-inward-2c */
#include <stdlib.h>
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    1, 0,
    0, 1};
static const double b[] = {-1, -1.8014398509481984e+16};
static const double low[] = {0, 0}, high[] = {INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {1., 18014398509481984.};
static const double force[] = {2, 3.602879701896397e+16}, acts[] = {2, 3.602879701896397e+16}; /* that act at each row: a force, an acceleration */
static int solve(double* f) {
  double m[ROWS * ROWS], q[ROWS], w[ROWS];
  int info = 0;
  for (int i = 0; i < ROWS * ROWS; ++i) m[i % ROWS * ROWS + i / ROWS] = A[i]; /* column after column */
  for (int i = 0; i < ROWS; ++i) q[i] = b[i];
  LinearComplementarityProblem lcp = {ROWS, NM_create_from_data(NM_DENSE, ROWS, ROWS, m), q};
  SolverOptions* options = solver_options_create(SICONOS_LCP_LEMKE);
  lcp_lexicolemke(&lcp, f, w, &info, options);
  solver_options_delete(options), free(NM_free_not_dense(lcp.M));
  return info == 0;
}
static double worst = 1e-06; /* what it states */ static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double normal = high[i] > 1e300, lo = low[i], hi = high[i];
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
