/* refused-solvable-3c: siconos-lemke 4.4.0 gives up a problem that has a solution.
 *     g++ -x c++ -I/usr/include/siconos -I/usr/include/siconos/numerics -I/usr/include/suitesparse siconos-lemke-refused-solvable-3c.cc \
 *         -lsiconos_numerics -o siconos-lemke-refused-solvable-3c && ./siconos-lemke-refused-solvable-3c */
#include <stdlib.h>
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 3, CONTACTS = 3, DIMENSION = 2 };
static const double A[] = {
    8836, 2914, 2726,
    2914, 961, 899,
    2726, 899, 841};
static const double b[] = {-94, -31, -29};
static const double low[] = {0, 0, 0}, high[] = {INFINITY, INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {1. / 94., 0., 0.};
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
