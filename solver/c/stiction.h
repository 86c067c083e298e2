// SPDX-License-Identifier: Apache-2.0
// Contact forces with Coulomb's friction, for C: find f with a = A f + b and the law of every contact.
//
//   normal      f_n >= 0, a_n >= 0, one of them zero
//   friction    abs(f_t) <= mu f_n; where a_t is not zero, f_t has that length and opposes it
//
//   #include <stdio.h>
//   #include <stiction.h>
//
//   int main(void) {  // a box of 1 kg on a floor, mu = 0.5, pulled sideways by 8 N
//     const stiction_contact floor = {STICTION_STATIC, 0.5, {0}};
//     const double A[] = {1, 0, 0, 1}, b[] = {-10, 8};  // 1/kg; without contact: it falls, and slides
//     const stiction_dense problem = {
//         .dimension = 2, .contact_count = 1, .contacts = &floor, .rows = 2, .A = A, .b = b};
//     double f[2], a[2];
//     stiction_answer answer = {.forces = f, .accelerations = a};
//     stiction_context* context = stiction_create();
//     if (stiction_solve_dense(context, &problem, NULL, &answer) == STICTION_SOLVED)
//       printf("f = %g %g N, it slides by %g m/s^2\n", f[0], f[1], a[1]);
//     else
//       puts(stiction_message(context));
//     stiction_destroy(context);
//   }
//
// prints: f = 10 -5 N, it slides by 3 m/s^2
//
// A problem is given in factors, A = J M^-1 J' and b = J w + c, of sparse J and masses of bodies, or as numbers
// A and b. In a velocity step f are impulses and a velocities: velocity_step.md says what b is then, and which
// rows of an engine have no counterpart here.
//
// Rows follow the contacts: a bilateral or frictionless contact has one row, a static or sliding one its normal
// row and then dimension - 1 tangential rows, in directions at right angles.
//
// Threads        There are no globals. A context serves one thread at a time; each thread has its own.
// Errors         No exception and no abort crosses this interface. What is given is checked before it is used.
// Determinism    The same calls on a fresh context give the same bytes. An answer depends on earlier calls by
//                the forces it starts from alone, and with warm = 0 not at all.
// Structures     may grow with the minor version (0.x); a field that a caller sets to 0 or NULL says "none".

#ifndef STICTION_H_
#define STICTION_H_

#ifdef __cplusplus
extern "C" {
#endif

typedef enum stiction_verdict {
  STICTION_SOLVED = 0,     // every contact separates, sticks or slips, but for errors up to options.residual
  STICTION_UNDECIDED = 1,  // no method came so far; forces are the best that were found, and errors are theirs
  STICTION_REFUSED = 2,    // an argument is wrong: stiction_message says which; nothing was written
  STICTION_NO_MEMORY = 3,  // nothing was written
  STICTION_FAILED = 4      // a fault of this library: nothing was written; please report it with its message
} stiction_verdict;

typedef enum stiction_kind {
  STICTION_BILATERAL = 0,     // a_n = 0, f_n of any sign: a joint's row
  STICTION_FRICTIONLESS = 1,  // the normal law alone: a joint's limit
  STICTION_STATIC = 2,        // with friction
  STICTION_SLIDING = 3        // f_t = -mu f_n slip, whatever a_t is
} stiction_kind;

typedef struct stiction_contact {
  int kind;        // a stiction_kind
  double mu;       // coefficient of friction, finite, >= 0; 0 where the kind has none
  double slip[2];  // of a sliding contact: direction of its velocity, a unit vector of dimension - 1 numbers
} stiction_contact;

// a = A f + b with A = J M^-1 J', b = J w + c. All is copied where it is kept beyond a call.
typedef struct stiction_factors {
  int dimension;  // 2 or 3
  int contact_count;
  const stiction_contact* contacts;
  const unsigned long long*
      keys;  // names of contacts over time, or NULL: contact i is contact i of the call before

  int rows;               // of J; as many as the contacts ask for
  int velocities;         // columns of J; fixed bodies have none
  const int* row_starts;  // rows + 1 numbers: row i has the entries row_starts[i] to row_starts[i + 1] - 1
  const int* columns;     // of each entry, 0 to velocities - 1, in any order; entries of one place add up
  const double* values;   // of each entry

  int block_count;         // blocks of M, one after another along its diagonal
  const int* block_sizes;  // their sum is velocities
  const double* mass;      // entries of the blocks, column by column; symmetric, positive definite

  const double* w;  // velocities: accelerations of the bodies without contact
  const double* c;  // rows: what b has besides J w; NULL: nothing
} stiction_factors;

// a = A f + b.
typedef struct stiction_dense {
  int dimension;  // 2 or 3
  int contact_count;
  const stiction_contact* contacts;
  const unsigned long long* keys;  // as above

  int rows;         // as many as the contacts ask for
  int stride;       // from A_ij to A_(i+1)j; 0: rows
  const double* A;  // A_ij = A[i * stride + j]; of a symmetric A this is also column by column
  const double* b;  // rows
} stiction_dense;

typedef struct stiction_options {
  unsigned size;    // of this structure, as stiction_default_options sets it
  int warm;         // 1: begin with the forces of the call before, contact by contact; 0: with none
  double residual;  // by how much b and mu may differ for forces called solved to be exact; 1e-8
  double noise;     // accelerations up to it are rounding of b and count as none, in the unit of b; 0
  int points;  // most proximal points that Newton's method tries, warm and cold each; 100. 0: it is left out
  int dense_rows;  // most rows for which methods of a dense A try what Newton's method left undecided; 150
} stiction_options;

// Relative, each contact in units of its own: what its nearest mode (it separates, sticks or slips) misses.
typedef struct stiction_errors {
  double acceleration, force;  // the largest of any contact; the larger of both is held to `residual`
  int contact;                 // where that is; -1: nowhere
} stiction_errors;

// The pointers are given; what they point to and the rest is written by a call that ends solved or undecided.
typedef struct stiction_answer {
  double* forces;              // rows
  double* accelerations;       // rows, a = A f + b, or NULL
  double* body_accelerations;  // velocities, w + M^-1 J' f, or NULL; by stiction_solve alone

  stiction_errors errors;  // of these forces, with the rounding of their accelerations
  int warm;                // 1: forces of the call before led to these
  const char* method;      // "newton", in the space of bodies, or that of a dense A; text that stays
} stiction_answer;

// NULL if there is no memory. stiction_destroy(NULL) does nothing.
typedef struct stiction_context stiction_context;
stiction_context* stiction_create(void);
void stiction_destroy(stiction_context* context);

// Sets the first `size` bytes; size is sizeof(stiction_options) of the caller, who may know fewer fields.
void stiction_default_options(stiction_options* options, unsigned size);

// Newton's method in the space of bodies: from the forces of the call before, then without; then, of few rows,
// the methods of stiction_solve_dense. The context keeps memory, the ordering of the matrix and, where solved,
// forces. options NULL: the defaults.
stiction_verdict stiction_solve(stiction_context* context, const stiction_factors* problem,
                                const stiction_options* options, stiction_answer* answer);

// The same method, of A = L D L', where A is symmetric and semidefinite; then the automatic methods of a dense
// A. Cost grows as rows^3, and may be seconds at a hundred contacts where Newton's method settles for nothing.
stiction_verdict stiction_solve_dense(stiction_context* context, const stiction_dense* problem,
                                      const stiction_options* options, stiction_answer* answer);

// Why the last call was not solved: which argument, what was found, what was expected. Empty after a solved
// one. Valid to the next call.
const char* stiction_message(const stiction_context* context);

// Of this library, as "0.3.0".
const char* stiction_version(void);

#ifdef __cplusplus
}
#endif

#endif  // STICTION_H_
