/* refused-solvable-2c: dart 6.12.1 gives up a problem that has a solution.
 *     g++ -x c++ dart-refused-solvable-2c.cc -ldart-external-odelcpsolver -o dart-refused-solvable-2c && ./dart-refused-solvable-2c */
#include <dart/external/odelcpsolver/error.h>
#include <dart/external/odelcpsolver/lcp.h>
#include <cstdarg>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 3, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    17, -24, -6,
    -24, 41, 13,
    -6, 13, 5};
static const double b[] = {-18, 6, -6};
static const int findex[] = {-1, 0, -1};
static const double low[] = {0, -1, 0}, high[] = {INFINITY, 1, INFINITY};
/* exact, and verified */ static const double right[] = {18. / 49., -18. / 7., 408. / 49.};
static void complain(int, const char* message, va_list values) { throw (vprintf(message, values), puts(""), 0); }
static int solve(double* f) {
  const int stride = ROWS > 1 ? ((ROWS - 1) | 3) + 1 : ROWS;
  std::vector<double> m(ROWS * stride), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  std::vector<int> index(findex, findex + ROWS);
  for (double& x : minus_b) x = -x;
  for (int i = 0; i < ROWS * ROWS; ++i) m[i / ROWS * stride + i % ROWS] = A[i];
  dart::external::ode::dSetMessageHandler(complain), dart::external::ode::dSetDebugHandler(complain);
  try {
    return dart::external::ode::dSolveLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), index.data());
  } catch (int) { return 0; }
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
