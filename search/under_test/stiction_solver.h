/* SPDX-License-Identifier: Apache-2.0 */
/* A solver that `stiction search --solver FILE.so` tests: a shared library with these four functions.
 * README.md. */

#ifndef STICTION_SOLVER_H_
#define STICTION_SOLVER_H_

#ifdef __cplusplus
extern "C" {
#endif

enum { STICTION_SOLVER_INTERFACE = 1 };

/* a = A f + b: accelerations of the contacts with the forces f that are asked for. The rows of a contact: its
 * normal, and unless it is bilateral or frictionless its dimension - 1 tangents. A is symmetric and positive
 * semidefinite but for rounding, b in its range likewise. The arrays belong to the caller. */
enum { STICTION_BILATERAL = 0, STICTION_FRICTIONLESS = 1, STICTION_STATIC = 2 };
typedef struct stiction_solver_problem {
  int contacts, dimension, rows; /* dimension 2 or 3 */
  const double* A;               /* rows x rows, row after row */
  const double* b;               /* rows */
  const double* mu;              /* contacts; 0 where there is no friction */
  const int* kinds;              /* contacts */
  /* Bounds of the forces, by row. Of a normal 0 and infinity, of a bilateral one -infinity and infinity. Of a
   * tangent: law "box" the fixed bounds; every other law -mu and mu, times the force of row findex. */
  const double *low, *high;
  const int* findex; /* rows; the normal's row of a tangent, -1 of others and under "box" */
} stiction_solver_problem;

/* law: what the forces satisfy, and what they are judged by.
 *   "frictionless"  normals alone; the problem has no tangents
 *   "box"           low <= f <= high; a >= 0 where f = low, a <= 0 where f = high, else a = 0
 *   "findex"        the same; bounds of tangents are mu times the forces of the normals alone, as in ODE
 *   "pyramid"       the same; bounds of tangents are mu times the normal forces of f itself
 *   "coulomb"       friction at most mu times the normal force, at the limit against the slip
 *
 * accuracy: of what it calls solved. Lenient errors up to it are accepted (solver/problem/lenient.h). */
typedef struct stiction_solver_info {
  int interface;
  const char *name, *version, *law;
  double accuracy;
} stiction_solver_info;

const stiction_solver_info* stiction_solver_describe(void);
void* stiction_solver_create(void); /* once in a process; what it returns is passed on */
/* Writes the forces. Returns 1 if it calls them a solution, 0 if it gives up. */
int stiction_solver_solve(void* solver, const stiction_solver_problem* problem, double* forces);
void stiction_solver_destroy(void* solver);

#ifdef __cplusplus
}
#endif

#endif /* STICTION_SOLVER_H_ */
