/* silent-wrong-pulls-2c: bullet-lemke 3.24 calls forces solved with which a contact pulls.
 *     g++ -x c++ -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet bullet-lemke-silent-wrong-pulls-2c.cc -lBulletDynamics-float64 -lBulletCollision-float64 \
 *         -lLinearMath-float64 -o bullet-lemke-silent-wrong-pulls-2c && ./bullet-lemke-silent-wrong-pulls-2c */
#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>
#include <math.h>
#include <stdio.h>
enum { ROWS = 2, CONTACTS = 2, DIMENSION = 2 };
static const double A[] = {
    25, -15,
    -15, 9};
static const double b[] = {95, -57};
static const double low[] = {0, 0};
static const double high[] = {INFINITY, INFINITY};
/* exact, and verified */ static const double right[] = {0., 19. / 3.};
/* what acts at each row: a force, an acceleration */
static const double force[] = {7.6, 12.666666666666666};
static const double acts[] = {190, 114};
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
