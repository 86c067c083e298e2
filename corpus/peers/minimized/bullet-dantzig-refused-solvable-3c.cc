/* refused-solvable-3c: bullet-dantzig 3.24 gives up a problem that has a solution.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-dantzig-refused-solvable-3c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-dantzig-refused-solvable-3c && ./bullet-dantzig-refused-solvable-3c */
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 3, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    2, 0, -1,
    0, 1, 0,
    -1, 0, 1};
static const double b[] = {0, -1, -1};
static const int findex[] = {-1, -1, 1};
static const double low[] = {0, 0, -1}, high[] = {INFINITY, INFINITY, 1};
/* exact, and verified */ static const double right[] = {1. / 2., 1., 1.};
static int solve(double* f) {
  std::vector<double> m(A, A + ROWS * ROWS), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  std::vector<int> index(findex, findex + ROWS);
  for (double& x : minus_b) x = -x;
  for (double& bound : hi) bound = fmin(bound, BT_INFINITY);
  btDantzigScratchMemory scratch;
  return btSolveDantzigLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), index.data(), scratch);
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
