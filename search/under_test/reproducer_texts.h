// SPDX-License-Identifier: Apache-2.0
// Pieces of the programs that reproducer.cpp writes. What stands between @ and @ is filled in there.

#ifndef STICTION_SEARCH_UNDER_TEST_REPRODUCER_TEXTS_H_
#define STICTION_SEARCH_UNDER_TEST_REPRODUCER_TEXTS_H_

namespace stiction {

// ---- C, and C++ over packages ------------------------------------------------------------------

inline constexpr const char* kCommandInC =
    "cc -I SOURCES/search/under_test @FILE@ ./SOLVER.so -lm -o @NAME@ && ./@NAME@";

inline constexpr const char* kIncludesInC = R"(#include <math.h>
#include <stdio.h>
)";
inline constexpr const char* kIncludesOfEnds = R"(#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
)";

inline constexpr const char* kIncludesOfLibrary = "#include \"stiction_solver.h\"\n";
inline constexpr const char* kSolveByLibrary = R"(static int solve(double* f) {
  static const stiction_solver_problem problem = {CONTACTS, DIMENSION, ROWS, A, b, mu, kinds, low, high, findex};
  static void* solver = 0;
  if (!solver) solver = stiction_solver_create();
  return stiction_solver_solve(solver, &problem, f);
}
)";

inline constexpr const char* kIncludesOfOde = R"(#include <ode/error.h>
#include <vector>
)";
inline constexpr const char* kSolveWithOde =
    R"(class dxWorldProcessMemArena; /* exported by ODE 0.16.2, declared by no header */
extern void dxSolveLCP(dxWorldProcessMemArena*, unsigned, double* A, double* bx, double* w, unsigned, double*, int*);
static void complain(int, const char* message, va_list values) { throw (vprintf(message, values), puts(""), 0); }
alignas(64) static char pool[1 << 20]; /* more than it takes */
static int solve(double* f) {
  const int stride = ((ROWS - 1) | 3) + 1;
  std::vector<double> m(ROWS * stride), pairs(2 * ROWS), bounds(2 * ROWS), w(ROWS);
  @COPY@struct { void *current, *begin, *end, *buffer; const void* manager; } arena = {pool, pool, pool + sizeof pool, 0, 0};
  for (int i = 0; i < ROWS * ROWS; ++i) m[i / ROWS * stride + i % ROWS] = A[i];
  for (int i = 0; i < ROWS; ++i) pairs[2 * i] = -b[i], bounds[2 * i] = low[i], bounds[2 * i + 1] = high[i];
  dSetMessageHandler(complain), dSetDebugHandler(complain);
  try {
    dxSolveLCP((dxWorldProcessMemArena*)&arena, ROWS, m.data(), pairs.data(), w.data(), 0, bounds.data(), @INDEX@);
  } catch (int) { return 0; }
  for (int i = 0; i < ROWS; ++i) f[i] = pairs[2 * i + 1];
  return 1;
}
)";

inline constexpr const char* kIncludesOfDart = R"(#include <dart/external/odelcpsolver/error.h>
#include <dart/external/odelcpsolver/lcp.h>
#include <cstdarg>
#include <vector>
)";
inline constexpr const char* kSolveWithDart =
    R"(static void complain(int, const char* message, va_list values) { throw (vprintf(message, values), puts(""), 0); }
static int solve(double* f) {
  const int stride = ROWS > 1 ? ((ROWS - 1) | 3) + 1 : ROWS;
  std::vector<double> m(ROWS * stride), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  @COPY@for (double& x : minus_b) x = -x;
  for (int i = 0; i < ROWS * ROWS; ++i) m[i / ROWS * stride + i % ROWS] = A[i];
  dart::external::ode::dSetMessageHandler(complain), dart::external::ode::dSetDebugHandler(complain);
  try {
    return dart::external::ode::dSolveLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), @INDEX@);
  } catch (int) { return 0; }
}
)";

inline constexpr const char* kIncludesOfSiconosLemke = R"(#include <stdlib.h>
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <lcp_cst.h>
)";
inline constexpr const char* kSolveWithSiconosLemke = R"(static int solve(double* f) {
  double m[ROWS * ROWS], q[ROWS], w[ROWS];
  int info = 0;
  for (int i = 0; i < ROWS * ROWS; ++i) m[i % ROWS * ROWS + i / ROWS] = A[i]; /* column after column */
  for (int i = 0; i < ROWS; ++i) q[i] = b[i];
  LinearComplementarityProblem lcp = {ROWS, NM_create_from_data(NM_DENSE, ROWS, ROWS, m), q};
  SolverOptions* options = solver_options_create(SICONOS_LCP_LEMKE);
  lcp_lexicolemke(&lcp, f, w, &info, options);
  solver_options_delete(options), free(NM_free_not_dense(lcp.M));
  return info == 0;
}
)";
inline constexpr const char* kIncludesOfSiconosFriction =
    "#include <NonSmoothDrivers.h>\n#include <fc3d_Solvers.h>\n";
inline constexpr const char* kSolveWithSiconosFriction =
    R"(static int solve(double* f) { /* a frictionless contact: mu = 0, and tangents that are coupled with nothing */
  enum { N = CONTACTS * DIMENSION }; int at[ROWS]; double m[N * N] = {0}, q[N] = {0}, forces[N] = {0}, velocities[N] = {0};
  for (int i = 0, row = 0; i < N; ++i)
    if (i % DIMENSION == 0 || kinds[i / DIMENSION] == 2) q[i] = b[row], at[row++] = i; else m[i * N + i] = 1;
  for (int i = 0; i < ROWS * ROWS; ++i) m[at[i % ROWS] * N + at[i / ROWS]] = A[i]; /* column after column */
  FrictionContactProblem problem = {DIMENSION, CONTACTS, NM_create_from_data(NM_DENSE, N, N, m), q, (double*)mu};
  SolverOptions* options = solver_options_create(@SICONOS_METHOD@);
  options->dparam[SICONOS_DPARAM_TOL] = 1e-9;@SICONOS_LIMIT@
  const int info = fc@SICONOS_DIMENSION@d_driver(&problem, forces, velocities, options);
  for (int i = 0; i < ROWS; ++i) f[i] = forces[at[i]];
  solver_options_delete(options), free(NM_free_not_dense(problem.M));
  return info == 0;
}
)";

inline constexpr const char* kIncludesOfBulletDantzig = R"(#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <vector>
)";
inline constexpr const char* kSolveWithBulletDantzig = R"(static int solve(double* f) {
  std::vector<double> m(A, A + ROWS * ROWS), minus_b(b, b + ROWS), w(ROWS), lo(low, low + ROWS), hi(high, high + ROWS);
  @COPY@for (double& x : minus_b) x = -x;
  for (double& bound : hi) bound = fmin(bound, BT_INFINITY);
  btDantzigScratchMemory scratch;
  return btSolveDantzigLCP(ROWS, m.data(), f, minus_b.data(), w.data(), 0, lo.data(), hi.data(), @INDEX@, scratch);
}
)";

inline constexpr const char* kIncludesOfBulletLemke =
    "#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>\n";
inline constexpr const char* kSolveWithBulletLemke = R"(static int solve(double* f) {
  btMatrixXu m(ROWS, ROWS);
  btVectorXu q(ROWS);
  for (int i = 0; i < ROWS * ROWS; ++i) m.setElem(i / ROWS, i % ROWS, A[i]);
  for (int i = 0; i < ROWS; ++i) q[i] = b[i];
  btLemkeAlgorithm lemke(m, q);
  const btVectorXu solution = lemke.solve(1000);
  for (int i = 0; i < ROWS; ++i) f[i] = solution[ROWS + i]; /* behind the accelerations */
  return lemke.getInfo() == 0;
}
)";

inline constexpr const char* kGivenBoundsInC = "lo = low[i], hi = high[i]";
inline constexpr const char* kOwnBoundsInC =
    "of_normal = findex[i] < 0 ? 1 : fmax(0, f[findex[i]]), lo = low[i] * of_normal, hi = high[i] * of_normal";
inline constexpr const char* kLimitBoundsInC =
    "lo = findex[i] < 0 ? low[i] : -limit[i], hi = findex[i] < 0 ? high[i] : limit[i]";
inline constexpr const char* kRoundInC = R"(
    if (findex[i] >= 0) { /* both tangents of a contact */
      const double slip = hypot(a[i], a[i + 1]), askew = hypot(f[i] + hi * a[i] / slip, f[i + 1] + hi * a[i + 1] / slip);
      miss(i, (hypot(f[i], f[i + 1]) - hi) / force[i], "is beyond the limit of friction");
      miss(i, fmin(askew / force[i], slip / acts[i]), "slips, and friction is not all against it");
      ++i; continue; })";
inline constexpr const char* kJudgeInC =
    R"(static double worst = @ACCURACY@; /* what it states */ static char said[200];
static void miss(int row, double by, const char* what) {
  if (by > worst) worst = by, snprintf(said, sizeof said, "row %d %s, by %.3g of what acts there", row, what, by);
}
static void judge(const double* f, const double* a) { /* a >= 0 where f is at its low bound, ... */
  for (int i = 0; i < ROWS; ++i) {
    const double normal = high[i] > 1e300, @BOUNDS@;@ROUND@
    miss(i, fmax(lo - f[i], f[i] - hi) / force[i], normal ? "pulls" : "is beyond the limit of friction");
    if (a[i] > 0) miss(i, fmin((f[i] - lo) / force[i], a[i] / acts[i]), normal ? "presses and separates" : "slips below its limit");
    if (a[i] < 0) miss(i, fmin((hi - f[i]) / force[i], -a[i] / acts[i]), normal ? "moves inward" : "slips below its limit");
  }
}
)";

inline constexpr const char* kMainInC = R"(int main(void) {
  double f[ROWS] = {0}, a[ROWS];
  const int solved = solve(f);
  printf("it %s\nrow %24s %24s %24s\n", solved ? "calls this solved:" : "gives up:", "f", "a = A f + b", "@KNOWN@");
  for (int i = 0; i < ROWS; ++i) {
    long double sum = b[i];
    for (int j = 0; j < ROWS; ++j) sum += (long double)A[i * ROWS + j] * f[j];
    printf("%3d %24.17g %24.17g %24.17g\n", i, f[i], a[i] = (double)sum, @RIGHT@);
  }
@VERDICT@}
)";
inline constexpr const char* kVerdictOfJudgeInC = R"(  if (solved) judge(f, a);
  return printf("%s%s\n", *said ? "WRONG: " : "not seen here: what was found", said), *said != 0;
)";
inline constexpr const char* kVerdictNotFiniteInC = R"(  int wrong = 0;
  for (int i = 0; i < ROWS; ++i) wrong += solved && !isfinite(f[i]);
  printf(wrong ? "WRONG: a force is not finite\n" : "not seen here: a force that is not finite\n");
  return wrong > 0;
)";
inline constexpr const char* kVerdictRefusedInC =
    R"(  printf(solved ? "not seen here: it gives up\n" : "WRONG: it gives up, and there are right forces\n");
  return !solved;
)";
inline constexpr const char* kVerdictOfLeakInC = R"(  enum { CALLS = 5000, PAGE = 4096 };
  long pages[2] = {0, 0};
  for (int turn = 0; turn < 2; ++turn) {
    for (int call = 0; call < CALLS; ++call) solve(f);
    FILE* const statm = fopen("/proc/self/statm", "r");
    if (!statm || fscanf(statm, "%*d %*d %*d %*d %*d %ld", &pages[turn]) != 1) return 2;
    fclose(statm);
  }
  const double kept = (double)(pages[1] - pages[0]) * PAGE / CALLS;
  printf(kept > 0 ? "WRONG: it keeps %.3g bytes of every call\n" : "not seen here: memory that grows, %.3g\n", kept);
  return kept > 0;
)";
inline constexpr const char* kMainOfEndsInC = R"(int main(void) {
  const struct rlimit seconds = {1, 2}, bytes = {1ul << 30, 1ul << 30};
  double f[ROWS] = {0};
  int status = 0;
  for (int i = 0; i < ROWS; ++i) printf("right f[%d] = %.17g\n", i, @RIGHT@);
  fflush(stdout);
  if (fork() == 0) {
    setrlimit(RLIMIT_CPU, &seconds), setrlimit(RLIMIT_DATA, &bytes), alarm(60);
    solve(f);
    _exit(100);
  }
  wait(&status);
  const int by = WIFSIGNALED(status) ? WTERMSIG(status) : 0, late = by == SIGXCPU || by == SIGKILL || by == SIGALRM;
  if (late) printf("WRONG: it gives no answer in a second of processor time\n");
  else if (by) printf("WRONG: it ends by signal %d: %s\n", by, strsignal(by));
  else if (WEXITSTATUS(status) != 100) printf("WRONG: it ends the program, with exit code %d\n", WEXITSTATUS(status));
  else printf("not seen here: it answers\n");
  return by || WEXITSTATUS(status) != 100;
}
)";

// ---- Python ------------------------------------------------------------------------------------

inline constexpr const char* kHeadOfPython = R"(#!/usr/bin/env python3
"""@SAYS@
    python3 @FILE@ @SOLVER@"""
import ctypes, json, math, os, resource, signal, subprocess, sys
from fractions import Fraction
)";
inline constexpr const char* kSolveByLibraryInPython = R"(
class Problem(ctypes.Structure):  # stiction_solver.h
    _fields_ = [(name, ctypes.c_int) for name in ("contacts", "dimension", "rows")] + [
        (name, ctypes.c_void_p) for name in ("A", "b", "mu", "kinds", "low", "high", "findex")]
def array(kind, values):
    return (kind * len(values))(*values)
kinds = [("bilateral", "frictionless", "static").index(kind) for kind in KINDS]
arrays = [array(ctypes.c_double, sum(A, [])), *(array(ctypes.c_double, x) for x in (B, MU)), array(ctypes.c_int, kinds),
          *(array(ctypes.c_double, x) for x in (LOW, HIGH)), array(ctypes.c_int, FINDEX)]
problem = Problem(len(MU), DIMENSION, len(B), *map(ctypes.addressof, arrays))
library, pid = ctypes.CDLL(os.path.abspath(sys.argv[1])), os.getpid()
library.stiction_solver_create.restype = ctypes.c_void_p
solver = ctypes.c_void_p(library.stiction_solver_create())
def solve():
    f = array(ctypes.c_double, [0.0] * len(B))
    return library.stiction_solver_solve(solver, ctypes.byref(problem), f), list(f)
)";
inline constexpr const char* kSolveByProgramInPython = R"(
process = subprocess.Popen([os.path.abspath(sys.argv[1])], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                           preexec_fn=lambda: (resource.setrlimit(resource.RLIMIT_CPU, (@SECONDS@)), signal.alarm(60)))
pid, greeting = process.pid, process.stdout.readline()
def ask():
    process.stdin.write(json.dumps({"dimension": DIMENSION, "A": A, "b": B, "mu": MU, "kinds": KINDS@BOUNDS@}) + "\n")
    process.stdin.flush()
    return process.stdout.readline()
def solve():
    answer = json.loads(ask())
    return answer["solved"], [math.nan if x is None else x for x in answer.get("f", [])]
)";
inline constexpr const char* kOwnBoundsInPython =
    "(x if FINDEX[i] < 0 else x * max(0, f[FINDEX[i]]) for x in (LOW[i], HIGH[i]))";
inline constexpr const char* kLimitBoundsInPython =
    "(LOW[i], HIGH[i]) if FINDEX[i] < 0 else (-LIMIT[i], LIMIT[i])";
inline constexpr const char* kRoundInPython = R"(
        if FINDEX[i] >= 0:  # both tangents of a contact
            j = 2 * FINDEX[i] + 3 - i
            slip, force = math.hypot(a[i], a[j]), math.hypot(f[i], f[j])
            askew = math.hypot(*(f[k] + high * a[k] / slip for k in (i, j))) if slip else 0
            yield (force - high) / FORCE[i], f"row {i} is beyond the limit of friction"
            yield min(askew / FORCE[i], slip / ACTS[i]), f"row {i} slips, and friction is not all against it"
            continue)";
inline constexpr const char* kJudgeInPython = R"(def misses(f, a):  # a >= 0 where f is at its low bound, ...
    for i in range(len(B)):
        low, high = @BOUNDS@@ROUND@
        normal = HIGH[i] == math.inf
        yield max(low - f[i], f[i] - high) / FORCE[i], f"row {i} " + ("pulls" if normal else "is beyond the limit of friction")
        room = f[i] - low if a[i] > 0 else high - f[i]
        yield min(room / FORCE[i], abs(a[i]) / ACTS[i]), f"row {i} " + (
            "slips below its limit" if not normal else "presses and separates" if a[i] > 0 else "moves inward")
)";
inline constexpr const char* kMainInPython = R"(solved, f = solve()
print("it calls this solved:" if solved else "it gives up:", *f)
print("right f:", *RIGHT)
@VERDICT@
print(f"WRONG: {wrong}" if wrong else "not seen here: what was found")
sys.exit(bool(wrong))
)";
inline constexpr const char* kVerdictOfJudgeInPython =
    R"(a = [float(Fraction(b) + sum(Fraction(x) * Fraction(y) for x, y in zip(row, f))) for row, b in zip(A, B)]
print("a = A f + b:", *a)
by, what = max(misses(f, a))
wrong = solved and by > @ACCURACY@ and f"{what}, by {by:.3g} of what acts there")";
inline constexpr const char* kVerdictNotFiniteInPython =
    R"(wrong = solved and not all(map(math.isfinite, f)) and "a force is not finite")";
inline constexpr const char* kVerdictRefusedInPython =
    R"(wrong = not solved and "it gives up, and there are right forces")";
inline constexpr const char* kVerdictOfLeakInPython = R"(sizes = []
for _ in range(2):
    for _ in range(5000):
        solve()
    with open(f"/proc/{pid}/statm") as statm:
        sizes.append(int(statm.read().split()[5]) * resource.getpagesize())
kept = (sizes[1] - sizes[0]) / 5000
wrong = kept > 0 and f"it keeps {kept:.3g} bytes of every call")";
inline constexpr const char* kMainOfEndsByLibraryInPython = R"(print("right f:", *RIGHT, flush=True)
child = os.fork()
if child == 0:
    resource.setrlimit(resource.RLIMIT_CPU, (1, 2)), resource.setrlimit(resource.RLIMIT_DATA, (1 << 30, 1 << 30))
    signal.alarm(60)
    solve()
    os._exit(100)
code, garbled = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), False
)";
inline constexpr const char* kMainOfEndsByProgramInPython = R"(print("right f:", *RIGHT)
said = ask()
code, garbled = 100 if said else process.wait(), bool(said)
try:
    garbled = garbled and "solved" not in json.loads(said)
except ValueError:
    pass
)";
inline constexpr const char* kVerdictOfEndsInPython = R"(if code == 100 and not garbled:
    sys.exit(print("not seen here: it answers"))
late = -code in (signal.SIGXCPU, signal.SIGKILL, signal.SIGALRM)
print("WRONG:", f"what it writes is no answer: {said.strip()}" if garbled else "it gives no answer in a second of processor time"
      if late else f"its process ends: {signal.strsignal(-code) if code < 0 else f'exit code {code}'}")
sys.exit(1)
)";

}  // namespace stiction

#endif  // STICTION_SEARCH_UNDER_TEST_REPRODUCER_TEXTS_H_
