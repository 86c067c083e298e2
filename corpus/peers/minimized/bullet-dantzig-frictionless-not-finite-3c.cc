/* not-finite-3c: bullet-dantzig-frictionless 3.24 calls forces solved of which one is not finite.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-dantzig-frictionless-not-finite-3c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-dantzig-frictionless-not-finite-3c && ./bullet-dantzig-frictionless-not-finite-3c */
#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <vector>
#include <math.h>
#include <stdio.h>
enum { ROWS = 3, CONTACTS = 3, DIMENSION = 2 };
static const double A[] = {
    5, -5, -13,
    -5, 10, 7,
    -13, 7, 41};
static const double b[] = {-8, 17, 10};
static const double low[] = {0, 0, 0};
static const double high[] = {INFINITY, INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {11. / 2., 0., 3. / 2.};
static int solve(double* f) {
  std::vector<double> m(A, A + ROWS * ROWS), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  for (double& x : minus_b) x = -x;
  for (double& bound : hi) bound = fmin(bound, BT_INFINITY);
  btDantzigScratchMemory scratch;
  return btSolveDantzigLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), nullptr, scratch);
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
  int wrong = 0;
  for (int i = 0; i < ROWS; ++i) wrong += solved && !isfinite(f[i]);
  printf(wrong ? "WRONG: a force is not finite\n" : "not seen here: a force that is not finite\n");
  return wrong > 0;
}
