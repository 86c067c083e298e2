/* silent-wrong-moves-inward-2c: ode 0.16.2 calls forces solved with which a contact moves inward.
 *     g++ -x c++ ode-silent-wrong-moves-inward-2c.cc -lode -o ode-silent-wrong-moves-inward-2c && ./ode-silent-wrong-moves-inward-2c */
#include <ode/error.h>
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
class dxWorldProcessMemArena; /* exported by ODE 0.16.2, declared by no header */
extern void dxSolveLCP(dxWorldProcessMemArena*, unsigned, double* A, double* bx, double* w, unsigned, double*, int*);
static void complain(int, const char* message, va_list values) { throw (vprintf(message, values), puts(""), 0); }
alignas(64) static char pool[1 << 20]; /* more than it takes */
static int solve(double* f) {
  const int stride = ((ROWS - 1) | 3) + 1;
  std::vector<double> m(ROWS * stride), pairs(2 * ROWS), bounds(2 * ROWS), w(ROWS);
  std::vector<int> index(findex, findex + ROWS);
  struct { void *current, *begin, *end, *buffer; const void* manager; } arena = {pool, pool, pool + sizeof pool, 0, 0};
  for (int i = 0; i < ROWS * ROWS; ++i) m[i / ROWS * stride + i % ROWS] = A[i];
  for (int i = 0; i < ROWS; ++i) pairs[2 * i] = -b[i], bounds[2 * i] = low[i], bounds[2 * i + 1] = high[i];
  dSetMessageHandler(complain), dSetDebugHandler(complain);
  try {
    dxSolveLCP((dxWorldProcessMemArena*)&arena, ROWS, m.data(), pairs.data(), w.data(), 0, bounds.data(), index.data());
  } catch (int) { return 0; }
  for (int i = 0; i < ROWS; ++i) f[i] = pairs[2 * i + 1];
  return 1;
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
