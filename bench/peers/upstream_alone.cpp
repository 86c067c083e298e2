// SPDX-License-Identifier: Apache-2.0
// What `stiction search --solver` found of other packages, minimized, shown by the packages alone: not a line
// of stiction is in this program. Each problem is to find f >= 0 with a = A f + b >= 0 and f.a = 0; each has a
// solution, which is told.

#include <BulletDynamics/MLCPSolvers/btDantzigLCP.h>
#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>
#include <ode/common.h>
#include <ode/error.h>

#include <cstdarg>
#include <cstdio>
#include <limits>
#include <vector>

// Exported by ODE 0.16.2, and declared by no header.
class dxWorldProcessMemArena;
extern void dxSolveLCP(dxWorldProcessMemArena* arena, unsigned n, double* A, double* pairs_bx, double* w,
                       unsigned unbounded, double* pairs_low_high, int* friction_index);
extern std::size_t dxEstimateSolveLCPMemoryReq(unsigned n, bool outer_w);

namespace {

// Two contacts.
struct Problem {
  double A[4], b[2], f[2];
};
// A step of Dantzig's method that is 0: both give up.
constexpr Problem kTie = {{2, -1, -1, 1}, {0, -1}, {1, 2}};
// Lemke's method: a force that is not finite, one that pulls, a solution given up, a force beside an
// acceleration.
constexpr Problem kOfLemke[] = {
    {{1, 0, 0, 0}, {-1, 0}, {1, 0}}, {{25, -15, -15, 9}, {15, -9}, {0, 1}}, {{1, -1, -1, 1}, {1, -1}, {0, 1}}};

void Complain(int, const char* message, va_list) { std::printf("ODE: message: %s\n", message); }

void Tell(const char* solver, const Problem& p, const char* says, double f0, double f1) {
  std::printf("%s: A = %g %g, %g %g; b = %g %g: %s, f = %g %g; a solution is %g %g\n", solver, p.A[0], p.A[1],
              p.A[2], p.A[3], p.b[0], p.b[1], says, f0, f1, p.f[0], p.f[1]);
}

void WithOde(const Problem& p) {
  dSetMessageHandler(Complain);
  struct {
    void *current, *begin, *end, *buffer;
    const void* manager;
  } arena;
  std::vector<double> pool(dxEstimateSolveLCPMemoryReq(2, true) / sizeof(double) + 64);
  arena = {pool.data(), pool.data(), pool.data() + pool.size(), nullptr, nullptr};
  double A[] = {p.A[0], p.A[1], 0, 0, p.A[2], p.A[3], 0, 0};  // rows of four numbers
  double pairs[] = {-p.b[0], 0, -p.b[1], 0}, w[2];
  const double infinity = std::numeric_limits<double>::infinity();
  double bounds[] = {0, infinity, 0, infinity};
  dxSolveLCP(reinterpret_cast<dxWorldProcessMemArena*>(&arena), 2, A, pairs, w, 0, bounds, nullptr);
  Tell("ODE", p, "returns", pairs[1], pairs[3]);
}

void WithBulletDantzig(const Problem& p) {
  double A[] = {p.A[0], p.A[1], p.A[2], p.A[3]}, x[2], b[] = {-p.b[0], -p.b[1]}, w[2];
  double low[] = {0, 0}, high[] = {BT_INFINITY, BT_INFINITY};
  btDantzigScratchMemory scratch;
  const bool solved = btSolveDantzigLCP(2, A, x, b, w, 0, low, high, nullptr, scratch);
  Tell("Bullet, Dantzig", p, solved ? "solved" : "given up", x[0], x[1]);
}

void WithBulletLemke(const Problem& p) {
  btMatrixXu A(2, 2);
  btVectorXu b(2);
  for (int i = 0; i < 2; ++i) {
    b[i] = p.b[i];
    for (int j = 0; j < 2; ++j) A.setElem(i, j, p.A[2 * i + j]);
  }
  btLemkeAlgorithm lemke(A, b);
  const btVectorXu solution = lemke.solve(1000);
  Tell("Bullet, Lemke", p, lemke.getInfo() == 0 ? "solved" : "given up", solution[2], solution[3]);
}

}  // namespace

int main() {
  WithOde(kTie);
  WithBulletDantzig(kTie);
  for (const Problem& p : kOfLemke) WithBulletLemke(p);
}
