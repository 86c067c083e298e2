/* not-finite-3c: ode-frictionless 0.16.2 calls forces solved of which one is not finite.
 *     g++ -x c++ ode-frictionless-not-finite-3c.cc -lode -o ode-frictionless-not-finite-3c && ./ode-frictionless-not-finite-3c */
#include <ode/common.h>
#include <ode/error.h>
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
class dxWorldProcessMemArena; /* exported by ODE 0.16.2, declared by no header */
extern void dxSolveLCP(dxWorldProcessMemArena*, unsigned n, double* A, double* pairs_bx, double* w, unsigned unbounded,
                       double* pairs_low_high, int* friction_index);
extern size_t dxEstimateSolveLCPMemoryReq(unsigned n, bool outer_w);
static void complain(int, const char* message, va_list) { throw message; }
static int solve(double* f) {
  const int stride = ROWS > 1 ? ((ROWS - 1) | 3) + 1 : ROWS;
  std::vector<double> m(ROWS * stride), pairs(2 * ROWS), bounds(2 * ROWS), w(ROWS);
  std::vector<double> pool(dxEstimateSolveLCPMemoryReq(ROWS, true) / sizeof(double) + 64);
  struct { void *current, *begin, *end, *buffer; const void* manager; } arena = {
    pool.data(), pool.data(), pool.data() + pool.size(), nullptr, nullptr};
  for (int i = 0; i < ROWS; ++i) {
    pairs[2 * i] = -b[i], bounds[2 * i] = low[i], bounds[2 * i + 1] = high[i];
    for (int j = 0; j < ROWS; ++j) m[i * stride + j] = A[i * ROWS + j];
  }
  dSetMessageHandler(complain), dSetDebugHandler(complain);
  int solved = 1;
  try {
    dxSolveLCP((dxWorldProcessMemArena*)&arena, ROWS, m.data(), pairs.data(), w.data(), 0, bounds.data(), nullptr);
  } catch (const char* message) { solved = printf("ODE: %s\n", message) < 0; }
  for (int i = 0; i < ROWS; ++i) f[i] = pairs[2 * i + 1];
  return solved;
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
