/* silent-wrong-moves-inward-2c: dart-frictionless 6.12.1 calls forces solved with which a contact moves inward.
 *     g++ -x c++ dart-frictionless-silent-wrong-moves-inward-2c.cc -ldart-external-odelcpsolver -o dart-frictionless-silent-wrong-moves-inward-2c && ./dart-frictionless-silent-wrong-moves-inward-2c */
#include <dart/external/odelcpsolver/error.h>
#include <dart/external/odelcpsolver/lcp.h>
#include <cstdarg>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    1, -1,
    -1, 2};
static const double b[] = {0, -1};
static const double low[] = {0, 0}, high[] = {INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {1., 1.};
static const double force[] = {1, 1.2071067811865475}, acts[] = {1, 2.414213562373095}; /* that act at each row: a force, an acceleration */
static void complain(int, const char* message, va_list values) { throw (vprintf(message, values), puts(""), 0); }
static int solve(double* f) {
  const int stride = ROWS > 1 ? ((ROWS - 1) | 3) + 1 : ROWS;
  std::vector<double> m(ROWS * stride), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  for (double& x : minus_b) x = -x;
  for (int i = 0; i < ROWS * ROWS; ++i) m[i / ROWS * stride + i % ROWS] = A[i];
  dart::external::ode::dSetMessageHandler(complain), dart::external::ode::dSetDebugHandler(complain);
  try {
    return dart::external::ode::dSolveLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), nullptr);
  } catch (int) { return 0; }
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
