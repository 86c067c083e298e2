/* not-finite-2c: bullet-lemke 3.24 calls forces solved of which one is not finite.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-lemke-not-finite-2c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-lemke-not-finite-2c && ./bullet-lemke-not-finite-2c */
#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    1, -1,
    -1, 1};
static const double b[] = {-1, 1};
static const double low[] = {0, 0};
static const double high[] = {INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {1., 0.};
static int solve(double* f) {
  btMatrixXu m(ROWS, ROWS);
  btVectorXu q(ROWS);
  for (int i = 0; i < ROWS * ROWS; ++i) m.setElem(i / ROWS, i % ROWS, A[i]);
  for (int i = 0; i < ROWS; ++i) q[i] = b[i];
  btLemkeAlgorithm lemke(m, q);
  const btVectorXu solution = lemke.solve(1000);
  for (int i = 0; i < ROWS; ++i) f[i] = solution[ROWS + i]; /* behind the accelerations */
  return lemke.getInfo() == 0;
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
