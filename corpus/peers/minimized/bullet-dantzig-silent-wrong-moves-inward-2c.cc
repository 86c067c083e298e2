/* silent-wrong-moves-inward-2c: bullet-dantzig 3.24 calls forces solved with which a contact moves inward.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-dantzig-silent-wrong-moves-inward-2c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-dantzig-silent-wrong-moves-inward-2c && ./bullet-dantzig-silent-wrong-moves-inward-2c */
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 4, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    555562902, 134217727, 1, 0, 134217727, 33554431, 0, 0,
    1, 0, 2, 1, 0, 0, 1, 1};
static const double b[] = {-1, -1, -1, 0};
static const int findex[] = {-1, 0, -1, 2};
static const double low[] = {0, -3, 0, -1}, high[] = {INFINITY, 3, INFINITY, 1};
/* exact, and verified */ static const double right[] = {0., 3. / 1111125803., 833344352. / 1111125803., -555562901. / 1111125803.};
static const double limit[] = {0, 2.699964299182061e-09, 0, 0.49999999955000596};
static const double force[] = {1.2149839495909994e-08, 6.680455150401693e-08, 1.0590169943837164, 1.0590169943837164}, acts[] = {6.750000089181973, 2.2415887139274826, 2.118033988767433, 0.7905694150544962}; /* that act at each row: a force, an acceleration */
static int solve(double* f) {
  std::vector<double> m(A, A + ROWS * ROWS), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  std::vector<int> index(findex, findex + ROWS);
  for (double& x : minus_b) x = -x;
  for (double& bound : hi) bound = fmin(bound, BT_INFINITY);
  btDantzigScratchMemory scratch;
  return btSolveDantzigLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), index.data(), scratch);
}
static double worst = 1e-06; /* what it states */ static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double normal = high[i] > 1e300, lo = findex[i] < 0 ? low[i] : -limit[i], hi = findex[i] < 0 ? high[i] : limit[i];
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
