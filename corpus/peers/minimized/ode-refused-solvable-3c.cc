/* refused-solvable-3c: ode 0.16.2 gives up a problem that has a solution.
 *     g++ -x c++ ode-refused-solvable-3c.cc -lode -o ode-refused-solvable-3c && ./ode-refused-solvable-3c */
#include <ode/error.h>
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
