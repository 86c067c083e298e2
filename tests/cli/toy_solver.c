/* SPDX-License-Identifier: Apache-2.0 */
/* A right solver of the frictionless problem, by trying which contacts press; and with -DBUG_... one that is
 * wrong where under_test_test.py says. -DLAW says another law. -DRARE makes the conditions of the bugs as rare
 * as they are asked to be. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "search/under_test/stiction_solver.h"

#ifndef LAW
#define LAW "frictionless"
#endif

enum { MOST = 16 };
static const double TINY = 1e-11;

static const stiction_solver_info info = {STICTION_SOLVER_INTERFACE, "toy", "1", LAW, 1e-6};
const stiction_solver_info* stiction_solver_describe(void) { return &info; }
void* stiction_solver_create(void) { return malloc(1); }
void stiction_solver_destroy(void* solver) { free(solver); }

/* A f = -b for the contacts of the set, the others 0; Gauss with pivots of the whole column. 0 if singular. */
static int press(const stiction_solver_problem* p, unsigned set, double* f) {
  double m[MOST][MOST + 1];
  int at[MOST], n = 0;
  for (int i = 0; i < p->rows; ++i) {
    f[i] = 0;
    if (set >> i & 1) at[n++] = i;
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) m[i][j] = p->A[at[i] * p->rows + at[j]];
    m[i][n] = -p->b[at[i]];
  }
  for (int k = 0; k < n; ++k) {
    int best = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(m[i][k]) > fabs(m[best][k])) best = i;
    if (fabs(m[best][k]) <= TINY * p->A[at[k] * p->rows + at[k]]) return 0;
    for (int j = 0; j <= n; ++j) {
      const double x = m[k][j];
      m[k][j] = m[best][j], m[best][j] = x;
    }
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double ratio = m[i][k] / m[k][k];
      for (int j = k; j <= n; ++j) m[i][j] -= ratio * m[k][j];
    }
  }
  for (int k = 0; k < n; ++k) f[at[k]] = m[k][n] / m[k][k];
  return 1;
}

/* How much is missed, in a unit of the problem. */
static int holds(const stiction_solver_problem* p, const double* f) {
  for (int i = 0; i < p->rows; ++i) {
    double a = p->b[i], size = fabs(p->b[i]);
    for (int j = 0; j < p->rows; ++j)
      a += p->A[i * p->rows + j] * f[j], size += fabs(p->A[i * p->rows + j] * f[j]);
    if (a < -1e-9 * size || f[i] < 0) return 0;
  }
  return 1;
}

int stiction_solver_solve(void* solver, const stiction_solver_problem* p, double* f) {
  (void)solver;
  const int n = p->rows;
  const double *A = p->A, *b = p->b;
  const int twins = n > 1 && A[0] == A[n + 1] && b[0] == b[1]; /* a tie of the first two contacts */
#ifdef RARE /* of `integers` with two contacts: one in 10^5, and one in 10^6 */
  const int rare = twins && A[1] == 1 && b[0] <= -36, rarer = rare && b[0] <= -45;
#else
  const int rare = twins && b[0] < 0 && A[1] == 1, rarer = rare && n > 2 && b[2] < 0;
#endif
  (void)rare, (void)rarer;
  for (int i = 0; i < n && n == p->contacts; ++i) /* normals alone */
    if (p->low[i] != 0 || !isinf(p->high[i]) || p->findex[i] != -1) return 0;
#ifdef BUG_LIES /* calls no forces at all a solution */
  for (int i = 0; i < n; ++i) f[i] = 0;
  return 1;
#endif
#ifdef BUG_LEAK
  if (b[0] < 0) *(volatile char*)malloc(48) = 1;
#endif
#ifdef BUG_SLOW /* where forces are large */
  for (volatile long turn = 0; turn < (long)(b[0] * b[0]); ++turn) {
  }
#endif
#ifdef BUG_HANG
  for (volatile int turning = rarer; turning;) {
  }
#endif
#ifdef BUG_SLEEP
  if (rarer) pause();
#endif
#ifdef BUG_CRASH
  if (rare) *(volatile int*)8 = 1;
#endif
#ifdef BUG_REFUSES
  if (rare) return 0;
#endif
  for (unsigned set = 0; set < 1u << n; ++set) {
    if (!press(p, set, f) || !holds(p, f)) continue;
#ifdef BUG_TIE
    if (twins && f[0] > 0) f[0] = -f[0];
#endif
#ifdef BUG_NOISE /* by just more than its accuracy where A = 1, and by more where A is larger */
    f[0] += 1.03e-6 * fabs(b[0]) * A[0];
#endif
#ifdef BUG_NAN
    if (rare) f[0] = (A[0] - A[n + 1]) / (b[0] - b[1]);
#endif
    return 1;
  }
  return 0;
}
