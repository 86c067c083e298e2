/* SPDX-License-Identifier: Apache-2.0 */
/* Libraries under test that mean no good: the name of the file, NAME.so, says what they do (hostile_test.py).
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "search/under_test/stiction_solver.h"

static const stiction_solver_info info = {STICTION_SOLVER_INTERFACE, "hostile", "1", "frictionless", 1e-6};
const stiction_solver_info* stiction_solver_describe(void) { return &info; }
void* stiction_solver_create(void) { return NULL; }

static int is(const char* name) {
  Dl_info found;
  if (!dladdr((void*)stiction_solver_describe, &found)) return 0;
  const char* base = strrchr(found.dli_fname, '/');
  base = base ? base + 1 : found.dli_fname;
  return strncmp(base, name, strlen(name)) == 0 && strcmp(base + strlen(name), ".so") == 0;
}

void stiction_solver_destroy(void* solver) {
  (void)solver;
  while (is("ends-never")) pause();
}

static void helper(int session, int twice) {
  if (fork()) return;
  if (session) setsid();
  if (twice && fork()) _exit(0);
  const char* mark = getenv("HOSTILE_MARK");
  execl("/bin/sleep", "sleep", mark ? mark : "0", (char*)NULL);
  _exit(1);
}

static void* spin(void* nothing) {
  for (volatile int turning = 1; turning;) {
  }
  return nothing;
}

static long deeper(long n) {
  volatile char room[4096];
  room[0] = (char)n;
  return deeper(n + 1) + room[0];
}

static void write_everywhere(void) {
  for (int file = 0; file < 64; ++file)
    if (write(file, "hm\n", 3) < 0) continue;
}

static void close_all(void) {
  for (int file = 0; file < 64; ++file) close(file);
}

int stiction_solver_solve(void* solver, const stiction_solver_problem* p, double* f) {
  (void)solver;
  for (int i = 0; i < p->rows; ++i) f[i] = p->b[i] < 0 ? -p->b[i] / p->A[i * p->rows + i] : 0;
  if (is("lib-segv")) *(volatile int*)8 = 1;
  if (is("lib-abort")) abort();
  if (is("lib-exit")) exit(0);
  if (is("lib-exit-3")) _exit(3);
  if (is("lib-spins")) spin(NULL);
  if (is("lib-sleeps"))
    while (1) pause();
  if (is("lib-nan")) f[0] = NAN;
  if (is("lib-infinity")) f[0] = -INFINITY;
  if (is("lib-writes-everywhere")) write_everywhere();
  if (is("lib-closes-all")) close_all();
  if (is("lib-closes-and-lives")) {
    close_all();
    while (1) pause();
  }
  if (is("lib-child")) helper(0, 0);
  if (is("lib-daemon")) helper(1, 1);
  if (is("lib-kills-its-parent")) kill(getppid(), SIGKILL);
  if (is("lib-stops-itself")) raise(SIGSTOP);
  if (is("lib-grows")) {
    for (char* more; (more = malloc(1 << 24));) memset(more, 1, 1 << 24);
    abort();
  }
  if (is("lib-overflows")) f[0] = (double)deeper(0);
  if (is("lib-changes-the-problem")) ((double*)p->A)[0] = -1, ((double*)p->b)[0] = NAN;
  if (is("lib-writes-beyond")) memset(f, 0x7f, 1 << 20);
  if (is("lib-thread")) {
    pthread_t thread;
    pthread_create(&thread, NULL, spin, NULL);
  }
  if (is("lib-ignores-signals")) {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, NULL);
    while (1) pause();
  }
  if (is("lib-prints"))
    for (int line = 0; line < 100000; ++line) puts("hm"), fputs("hm\n", stderr);
  return 1;
}
