/* silent-wrong-moves-inward-3c: bullet-dantzig-frictionless 3.24 calls forces solved with which a contact moves inward.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-dantzig-frictionless-silent-wrong-moves-inward-3c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-dantzig-frictionless-silent-wrong-moves-inward-3c && ./bullet-dantzig-frictionless-silent-wrong-moves-inward-3c */
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 3, CONTACTS = 3, DIMENSION = 2 };
static const double A[] = {
    9, -9, -15,
    -9, 13, 15,
    -15, 15, 25};
static const double b[] = {15, -17, -25};
static const double low[] = {0, 0, 0};
static const double high[] = {INFINITY, INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {0., 1. / 2., 7. / 10.};
/* what acts at each row: a force, an acceleration */
static const double force[] = {3.3663398378642615, 2.721905870065403, 2.019803902718557};
static const double acts[] = {30.297058540778355, 35.384776310850235, 50.495097567963924};
static int solve(double* f) {
  std::vector<double> m(A, A + ROWS * ROWS), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  for (double& x : minus_b) x = -x;
  for (double& bound : hi) bound = fmin(bound, BT_INFINITY);
  btDantzigScratchMemory scratch;
  return btSolveDantzigLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), nullptr, scratch);
}
static double worst = 1e-06; /* what it states */
static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double lo = low[i], hi = high[i];
    const int normal = high[i] > 1e300;
    miss(i, fmax(lo - f[i], f[i] - hi) / force[i], normal ? "pulls" : "is beyond the limit of friction");
    if (a[i] > 0) miss(i, fmin((f[i] - lo) / force[i], a[i] / acts[i]), normal ? "presses and separates" : "slips below its limit");
    if (a[i] < 0) miss(i, fmin((hi - f[i]) / force[i], -a[i] / acts[i]), normal ? "moves inward" : "slips below its limit");
  }
}
int main(void) {
  double f[ROWS] = {0}, a[ROWS];
  const int solved = solve(f);
  for (int i = 0; i < ROWS; ++i) {
    long double sum = b[i];
    for (int j = 0; j < ROWS; ++j) sum += (long double)A[i * ROWS + j] * f[j];
    a[i] = (double)sum;
  }
  printf("it %s\nrow %24s %24s %24s\n", solved ? "calls this solved:" : "gives up:", "f", "a = A f + b", "right f");
  for (int i = 0; i < ROWS; ++i) printf("%3d %24.17g %24.17g %24.17g\n", i, f[i], a[i], right[i]);
  if (solved) judge(f, a);
  printf("%s%s\n", *said ? "WRONG: " : "not seen here: what was found", said);
  return *said != 0;
}
