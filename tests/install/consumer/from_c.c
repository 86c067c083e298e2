// SPDX-License-Identifier: Apache-2.0
// The C interface, from C: blocks on planes, whose forces are known; every refusal; warm starts; threads.
// Answers are judged here anew, from J, M, w and c alone.

#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "stiction.h"

static int failures = 0;

static void check(int holds, const char* what, int line) {
  if (holds) return;
  printf("from_c.c:%d: %s\n", line, what);
  failures = 1;
}
#define CHECK(condition) check(condition, #condition, __LINE__)
static int near(double x, double y) { return fabs(x - y) <= 1e-9 * (1 + fabs(y)); }
#define CHECK_NEAR(x, y) check(near(x, y), #x " = " #y, __LINE__)

enum { ROWS = 12, VELOCITIES = 6, ENTRIES = ROWS * VELOCITIES };

// One body on contacts, with room for what a problem points to.
typedef struct block {
  stiction_contact contacts[4];
  unsigned long long keys[4];
  int row_starts[ROWS + 1], columns[ENTRIES], block_sizes[3];
  double values[ENTRIES], mass[VELOCITIES * VELOCITIES], w[VELOCITIES], c[ROWS];
  double f[ROWS], a[ROWS], v[VELOCITIES];
  stiction_factors problem;
  stiction_answer answer;
} block;

static void add_row(block* it, const double* entries) {
  const int row = it->problem.rows++;
  int k = it->row_starts[row];
  for (int j = it->problem.velocities - 1; j >= 0; --j) {  // in any order
    if (entries[j] == 0) continue;
    it->columns[k] = j;
    it->values[k++] = entries[j];
  }
  it->row_starts[row + 1] = k;
}

static void begin(block* it, int dimension, int kind, double mu) {
  memset(it, 0, sizeof *it);
  for (int i = 0; i < 4; ++i) {
    it->contacts[i] = (stiction_contact){kind, mu, {0, 0}};
    it->keys[i] = 70 - 9 * i;
  }
  it->problem = (stiction_factors){.dimension = dimension,
                                   .contacts = it->contacts,
                                   .row_starts = it->row_starts,
                                   .columns = it->columns,
                                   .values = it->values,
                                   .block_sizes = it->block_sizes,
                                   .mass = it->mass,
                                   .w = it->w,
                                   .c = it->c,
                                   .velocities = dimension == 2 ? 3 : 6};
  it->answer = (stiction_answer){.forces = it->f, .accelerations = it->a, .body_accelerations = it->v};
}

// 2 kg, 2 m wide, 1 m high, on two contacts of a floor; pushed by `push` N through its centre.
static void flat(block* it, int kind, double mu, double push) {
  begin(it, 2, kind, mu);
  it->problem.contact_count = 2;
  for (int i = 0; i < 2; ++i) {
    const double x = i == 0 ? -1 : 1;
    add_row(it, (const double[]){0, 1, x});
    if (kind >= STICTION_STATIC) add_row(it, (const double[]){1, 0, 0.5});
  }
  it->problem.block_count = 2;  // translation, and rotation: 2 (2^2 + 1^2) / 12
  it->block_sizes[0] = 2, it->block_sizes[1] = 1;
  memcpy(it->mass, (const double[]){2, 0, 0, 2, 10.0 / 12}, 5 * sizeof(double));
  it->w[0] = push / 2, it->w[1] = -10;
}

// The same in space, 2 m deep: four contacts, pushed along (3, 4) / 5. `at` turns the order of contacts.
static void deep(block* it, int kind, double mu, double push, int at) {
  begin(it, 3, kind, mu);
  it->problem.contact_count = 4;
  for (int n = 0; n < 4; ++n) {
    const int i = (n + at) % 4;
    const double x = i < 2 ? -1 : 1, y = i % 2 ? -1 : 1, z = -0.5;
    it->keys[n] = 70 - 9 * i;
    add_row(it, (const double[]){0, 0, 1, y, -x, 0});
    if (kind < STICTION_STATIC) continue;
    add_row(it, (const double[]){1, 0, 0, 0, z, -y});
    add_row(it, (const double[]){0, 1, 0, -z, 0, x});
  }
  it->problem.block_count = 1;
  it->block_sizes[0] = 6;
  for (int k = 0; k < 6; ++k) it->mass[7 * k] = k < 3 ? 2 : k < 5 ? 2 * 5.0 / 12 : 2 * 8.0 / 12;
  it->w[0] = 0.6 * push / 2, it->w[1] = 0.8 * push / 2, it->w[2] = -10;
}

// ---- The law, once more --------------------------------------------------------------------------------

// M y = x, by elimination, with M taken from its blocks.
static void solve_masses(const block* it, double* x) {
  const int n = it->problem.velocities;
  double m[VELOCITIES][VELOCITIES] = {{0}};
  const double* mass = it->mass;
  for (int k = 0, at = 0; k < it->problem.block_count; at += it->block_sizes[k++]) {
    for (int j = 0; j < it->block_sizes[k]; ++j) {
      for (int i = 0; i < it->block_sizes[k]; ++i) m[at + i][at + j] = *mass++;
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int i = k + 1; i < n; ++i) {
      const double factor = m[i][k] / m[k][k];
      for (int j = k; j < n; ++j) m[i][j] -= factor * m[k][j];
      x[i] -= factor * x[k];
    }
  }
  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) x[k] -= m[k][j] * x[j];
    x[k] /= m[k][k];
  }
}

// How far a force is from what its law, with steps of `r`, makes of it.
static double natural_residual(const block* it, const double* a, double r) {
  double worst = 0;
  for (int i = 0, row = 0; i < it->problem.contact_count; ++i) {
    const stiction_contact* contact = &it->contacts[i];
    const double normal = it->f[row], moved = normal - r * a[row];
    const double wanted = contact->kind == STICTION_BILATERAL || moved > 0 ? moved : 0;
    worst = fmax(worst, fabs(normal - wanted));
    const int tangents = contact->kind < STICTION_STATIC ? 0 : it->problem.dimension - 1;
    const double limit = contact->mu * normal;
    double t[2] = {0, 0};
    for (int k = 0; k < tangents; ++k)
      t[k] = contact->kind == STICTION_SLIDING ? -limit * contact->slip[k]
                                               : it->f[row + 1 + k] - r * a[row + 1 + k];
    const double length = hypot(t[0], t[1]), part = length > limit ? limit / length : 1;
    for (int k = 0; k < tangents; ++k) worst = fmax(worst, fabs(it->f[row + 1 + k] - part * t[k]));
    row += 1 + tangents;
  }
  return worst;
}

// v = w + M^-1 J' f, a = J v + c, and what was told of both; then the law.
static void judge(const block* it) {
  const stiction_factors* p = &it->problem;
  double v[VELOCITIES] = {0}, a[ROWS];
  for (int i = 0; i < p->rows; ++i) {
    for (int k = p->row_starts[i]; k < p->row_starts[i + 1]; ++k) v[p->columns[k]] += p->values[k] * it->f[i];
  }
  solve_masses(it, v);
  for (int j = 0; j < p->velocities; ++j) {
    v[j] += p->w[j];
    CHECK(fabs(v[j] - it->v[j]) < 1e-11);
  }
  for (int i = 0; i < p->rows; ++i) {
    a[i] = p->c == NULL ? 0 : p->c[i];
    for (int k = p->row_starts[i]; k < p->row_starts[i + 1]; ++k) a[i] += p->values[k] * v[p->columns[k]];
    CHECK(fabs(a[i] - it->a[i]) < 1e-11);
  }
  CHECK(natural_residual(it, a, 1) < 1e-7);
  CHECK(it->answer.errors.acceleration <= 1e-8 && it->answer.errors.force <= 1e-8);
}

static void solve(stiction_context* context, block* it, const stiction_options* options) {
  const stiction_verdict verdict = stiction_solve(context, &it->problem, options, &it->answer);
  CHECK(verdict == STICTION_SOLVED);
  CHECK(*stiction_message(context) == 0);
  judge(it);
}

// ---- Tests ---------------------------------------------------------------------------------------------

// Weight 20 N, mu 1/2: 8 N are held, of 14 N the block keeps 4.
static void blocks_stick_and_slip(void) {
  stiction_context* context = stiction_create();
  block it;
  flat(&it, STICTION_STATIC, 0.5, 8);
  solve(context, &it, NULL);
  CHECK_NEAR(it.f[0] + it.f[2], 20);
  CHECK_NEAR(it.f[1] + it.f[3], -8);
  CHECK_NEAR(it.v[0], 0);
  flat(&it, STICTION_STATIC, 0.5, 14);
  solve(context, &it, NULL);
  CHECK_NEAR(it.f[1] + it.f[3], -10);
  CHECK_NEAR(it.v[0], 2);
  deep(&it, STICTION_STATIC, 0.5, 8, 0);
  solve(context, &it, NULL);
  CHECK_NEAR(it.f[0] + it.f[3] + it.f[6] + it.f[9], 20);
  CHECK_NEAR(hypot(it.v[0], it.v[1]), 0);
  deep(&it, STICTION_STATIC, 0.5, 14, 0);
  solve(context, &it, NULL);
  CHECK_NEAR(it.v[0], 1.2);
  CHECK_NEAR(it.v[1], 1.6);
  CHECK_NEAR(it.v[2], 0);
  // Masses that are not diagonal: those of a reference beside the centre.
  deep(&it, STICTION_STATIC, 0.5, 14, 0);
  it.mass[4] = it.mass[24] = 0.3, it.mass[9] = it.mass[19] = -0.3;
  solve(context, &it, NULL);
  flat(&it, STICTION_STATIC, 0.5, 0);
  it.w[1] = 3;  // it is lifted
  solve(context, &it, NULL);
  CHECK(it.f[0] == 0 && it.f[1] == 0 && it.v[1] == 3);
  stiction_destroy(context);
}

static void kinds(void) {
  stiction_context* context = stiction_create();
  block it;
  for (int dimension = 2; dimension <= 3; ++dimension) {
    for (int kind = STICTION_BILATERAL; kind <= STICTION_SLIDING; ++kind) {
      for (int lifts = 0; lifts < 2; ++lifts) {
        const double mu = kind < STICTION_STATIC ? 0 : 0.25;
        if (dimension == 2) flat(&it, kind, mu, 3);
        if (dimension == 3) deep(&it, kind, mu, 3, 0);
        for (int i = 0; i < 4; ++i)
          it.contacts[i].slip[0] = dimension == 2 ? -1 : 0.6, it.contacts[i].slip[1] = 0.8;
        if (lifts) it.w[dimension - 1] = 10;
        solve(context, &it, NULL);
        CHECK_NEAR(it.v[dimension - 1], kind != STICTION_BILATERAL && lifts ? 10 : 0);
        if (kind == STICTION_SLIDING && !lifts) CHECK_NEAR(it.f[1], (dimension == 2 ? 0.25 : -0.15) * it.f[0]);
      }
    }
  }
  // c lifts one contact: the block turns about the other.
  flat(&it, STICTION_FRICTIONLESS, 0, 0);
  it.c[0] = 100;
  solve(context, &it, NULL);
  CHECK(it.f[0] == 0 && it.f[1] > 0);
  it.problem.c = NULL;
  solve(context, &it, NULL);
  CHECK_NEAR(it.f[0], 10);
  stiction_destroy(context);
}

static void numbers(void) {
  stiction_context* context = stiction_create();
  const stiction_contact contacts[2] = {{STICTION_STATIC, 1, {0, 0}}, {STICTION_STATIC, 1, {0, 0}}};
  const double A[] = {2, 0, 1, 0, 9, 0, 1, 0, 0, 9, 1, 0, 2, 0, 9, 0, 0, 0, 1, 9}, b[] = {-4, 0.5, -5, 3};
  double f[4], a[4];
  stiction_dense problem = {
      .dimension = 2, .contact_count = 2, .contacts = contacts, .rows = 4, .stride = 5, .A = A, .b = b};
  stiction_answer answer = {.forces = f, .accelerations = a};
  CHECK(stiction_solve_dense(context, &problem, NULL, &answer) == STICTION_SOLVED);
  CHECK_NEAR(f[0], 1);
  CHECK_NEAR(f[1], -0.5);
  CHECK_NEAR(f[2], 2);
  CHECK_NEAR(f[3], -2);
  CHECK_NEAR(a[3], 1);
  CHECK(strcmp(answer.method, "newton") == 0 && answer.warm == 0);
  CHECK(stiction_solve_dense(context, &problem, NULL, &answer) == STICTION_SOLVED);
  CHECK(answer.warm == 1);
  const double mixed[] = {2, 0, 1, 0, 9, 0, 1, 0, 0, 9, 1.5, 0, 2, 0, 9, 0, 0, 0, 1, 9};  // not symmetric
  problem.A = mixed;
  CHECK(stiction_solve_dense(context, &problem, NULL, &answer) == STICTION_SOLVED);
  CHECK(strcmp(answer.method, "fast") == 0 && answer.warm == 0);
  CHECK_NEAR(f[0], 4.0 / 2 - f[2] / 2);
  CHECK_NEAR(f[2], 5.0 / 2 - 0.75 * f[0]);
  stiction_destroy(context);
}

static void without_contacts(void) {
  stiction_context* context = stiction_create();
  block it;
  flat(&it, STICTION_STATIC, 0.5, 8);
  it.problem.contact_count = it.problem.rows = 0;
  solve(context, &it, NULL);
  CHECK(it.v[0] == 4 && it.v[1] == -10);
  const stiction_factors nothing = {.dimension = 3};
  stiction_answer none = {0};
  CHECK(stiction_solve(context, &nothing, NULL, &none) == STICTION_SOLVED);
  const stiction_dense no_numbers = {.dimension = 2};
  CHECK(stiction_solve_dense(context, &no_numbers, NULL, &none) == STICTION_SOLVED);
  stiction_destroy(context);
}

// ---- What velocity_step.md promises of rows ---------------------------------------------------------------

static void rows_of_engines(void) {
  stiction_context* context = stiction_create();
  block it;
  // Gap: 10 N s of weight, 2 mm in 1/100 s may be closed. Overlap: it parts. A floor that moves takes the block
  // along.
  flat(&it, STICTION_STATIC, 0.5, 0);
  it.c[0] = it.c[2] = 0.002 / 0.01;
  solve(context, &it, NULL);
  CHECK_NEAR(it.v[1], -0.2);
  it.c[0] = it.c[2] = 0.5 * -0.002 / 0.01;
  solve(context, &it, NULL);
  CHECK_NEAR(it.v[1], 0.1);
  it.c[0] = it.c[2] = 0, it.c[1] = it.c[3] = -3;
  solve(context, &it, NULL);
  CHECK_NEAR(it.v[0], 3);
  it.c[1] = it.c[3] = -30;
  solve(context, &it, NULL);
  CHECK_NEAR(it.v[0], 5);

  // Softness R of a bilateral row: v + R p = 0, v = -10 + p / 2.
  const double R = 0.25;
  flat(&it, STICTION_BILATERAL, 0, 0);
  it.problem.velocities = 4, it.problem.contact_count = 1, it.problem.rows = 0, it.problem.block_count = 3;
  it.block_sizes[2] = 1, it.mass[5] = 1 / R;
  add_row(&it, (const double[]){0, 1, 0, 1});
  solve(context, &it, NULL);
  CHECK_NEAR(it.f[0], 10 / (0.5 + R));
  const double soft[] = {0.5 + R}, b[] = {-10};
  double p;
  const stiction_dense dense = {
      .dimension = 2, .contact_count = 1, .contacts = it.contacts, .rows = 1, .A = soft, .b = b};
  stiction_answer answer = {.forces = &p};
  CHECK(stiction_solve_dense(context, &dense, NULL, &answer) == STICTION_SOLVED);
  CHECK_NEAR(p, it.f[0]);

  // A puck of 2 kg, mu 1/2 along x and 1/4 along y: 6 N are held along x, of 6 N along y 5 N. Between them
  // friction is that of the ellipse: p_t / mu^2 is along the slip.
  for (int way = 0; way < 3; ++way) {
    begin(&it, 3, STICTION_STATIC, 0.5);
    it.problem.contact_count = it.problem.block_count = 1, it.problem.velocities = it.block_sizes[0] = 3;
    for (int k = 0; k < 3; ++k) it.mass[4 * k] = 2;
    add_row(&it, (const double[]){0, 0, 1});
    add_row(&it, (const double[]){1, 0, 0});
    add_row(&it, (const double[]){0, 0.25 / 0.5, 0});
    it.w[2] = -10;
    if (way != 1) it.w[0] = way == 0 ? 3 : 8;
    if (way != 0) it.w[1] = way == 1 ? 3 : 8;
    solve(context, &it, NULL);
    const double x = 2 * (it.v[0] - it.w[0]), y = 2 * (it.v[1] - it.w[1]);
    if (way == 0) CHECK_NEAR(it.v[0], 0);
    if (way == 1) CHECK_NEAR(it.v[1], 0.5);
    CHECK(hypot(x / 10, y / 5) <= 1 + 1e-9);
    if (way == 2) CHECK_NEAR(x / 100 * it.v[1], y / 25 * it.v[0]);
  }

  // A motor turns a wheel of 1/2 kg m^2 to 4 /s with at most 30 N m for 1/100 s, or 300: it reaches .6 /s,
  // or 4.
  for (int dimension = 2; dimension <= 3; ++dimension) {
    for (int strong = 0; strong < 2; ++strong) {
      begin(&it, dimension, STICTION_STATIC, 1);
      it.problem.contact_count = 1, it.problem.block_count = it.problem.velocities = 2;
      it.block_sizes[0] = it.block_sizes[1] = 1, it.mass[0] = 0.5, it.mass[1] = 1;
      it.w[1] = (strong ? -300 : -30) * 0.01;
      add_row(&it, (const double[]){0, 1});
      add_row(&it, (const double[]){1, 0});
      if (dimension == 3) add_row(&it, (const double[]){0, 0});
      it.c[1] = -4;
      solve(context, &it, NULL);
      CHECK_NEAR(it.v[0], strong ? 4 : 0.6);
      CHECK_NEAR(it.f[1], strong ? 2 : 0.3);
    }
  }
  stiction_destroy(context);
}

// From the forces of the call before nothing is left to do: they come back to the bit, whatever the order of
// contacts is now, since keys name them. Newton's method from no forces finds others, where they are not
// unique.
static void warm_starts(void) {
  stiction_context *context = stiction_create(), *fresh = stiction_create();
  stiction_options options;
  stiction_default_options(&options, sizeof options);
  CHECK(options.warm == 1 && options.residual == 1e-8);
  block first, it;
  deep(&first, STICTION_STATIC, 0.5, 8, 0);
  first.problem.keys = first.keys;
  solve(context, &first, &options);
  CHECK(first.answer.warm == 0 && strcmp(first.answer.method, "newton") == 0);
  CHECK(first.f[0] != first.f[3] && first.f[0] != first.f[6]);
  deep(&it, STICTION_STATIC, 0.5, 8, 1);
  it.problem.keys = it.keys;
  solve(context, &it, &options);
  CHECK(it.answer.warm == 1);
  CHECK(memcmp(it.f, first.f + 3, 9 * sizeof(double)) == 0 &&
        memcmp(it.f + 9, first.f, 3 * sizeof(double)) == 0);
  it.w[0] += 0.01;
  solve(context, &it, &options);
  CHECK(it.answer.warm == 1);

  block cold;
  options.warm = 0;
  deep(&cold, STICTION_STATIC, 0.5, 8, 0);
  cold.problem.keys = cold.keys;
  solve(context, &cold, &options);
  CHECK(cold.answer.warm == 0 && memcmp(cold.f, first.f, sizeof cold.f) == 0);
  cold.problem.keys = NULL;
  solve(context, &cold, &options);
  // Contacts by their place; a contact of another kind has no forces to begin with.
  options.warm = 1;
  deep(&it, STICTION_STATIC, 0.5, 8, 0);
  solve(context, &it, &options);
  CHECK(it.answer.warm == 1);
  deep(&it, STICTION_FRICTIONLESS, 0, 0, 0);
  solve(context, &it, &options);
  CHECK(it.answer.warm == 0);
  solve(fresh, &cold, &options);
  CHECK(memcmp(cold.f, first.f, sizeof cold.f) == 0);
  stiction_destroy(context);
  stiction_destroy(fresh);
}

// Two rows that want the same motion to be two numbers.
static void contradictions_are_undecided(void) {
  stiction_context* context = stiction_create();
  block it;
  flat(&it, STICTION_BILATERAL, 0, 0);
  it.problem.rows = 0;
  add_row(&it, (const double[]){0, 1, 0});
  add_row(&it, (const double[]){0, 1, 0});
  it.c[1] = 1e-6;
  CHECK(stiction_solve(context, &it.problem, NULL, &it.answer) == STICTION_UNDECIDED);
  CHECK(fmax(it.answer.errors.acceleration, it.answer.errors.force) > 1e-8);
  CHECK(strstr(stiction_message(context), "undecided: the least error found is ") != NULL);
  CHECK(isfinite(it.f[0]) && isfinite(it.f[1]));
  CHECK_NEAR(it.a[0], it.v[1]);
  stiction_options options;  // where b is known to 1e-6 only, it is no contradiction
  stiction_default_options(&options, sizeof options);
  options.noise = 1e-6;
  CHECK(stiction_solve(context, &it.problem, &options, &it.answer) == STICTION_SOLVED);
  options.residual = 1e-30;  // more than doubles have
  options.noise = 0;
  flat(&it, STICTION_STATIC, 0.3, 1);
  CHECK(stiction_solve(context, &it.problem, &options, &it.answer) == STICTION_UNDECIDED);
  CHECK(it.answer.errors.acceleration < 1e-12);
  options.residual = 1e-8;
  options.points = options.dense_rows = 0;  // nothing may be tried
  CHECK(stiction_solve(context, &it.problem, &options, &it.answer) == STICTION_UNDECIDED);
  CHECK(strcmp(it.answer.method, "none") == 0 && it.f[0] == 0);
  options.dense_rows = 4;
  solve(context, &it, &options);
  CHECK(strcmp(it.answer.method, "fast") == 0);
  stiction_destroy(context);
}

// ---- Refusals ------------------------------------------------------------------------------------------

static stiction_context* asked;
static stiction_options wishes;
static block given;

static void anew(void) {
  stiction_default_options(&wishes, sizeof wishes);
  flat(&given, STICTION_STATIC, 0.5, 8);
  memset(given.f, 1, sizeof given.f);
}

// Nothing is written, and the message begins with these words.
static void refused(stiction_verdict verdict, const char* says, int line) {
  double untouched[ROWS];
  memset(untouched, 1, sizeof untouched);
  const int right = verdict == STICTION_REFUSED && strncmp(stiction_message(asked), says, strlen(says)) == 0 &&
                    memcmp(untouched, given.f, sizeof untouched) == 0;
  if (!right) printf("verdict %d, message '%s'\n", verdict, stiction_message(asked));
  check(right, says, line);
  anew();
}
#define REFUSED(change, says) \
  (change, refused(stiction_solve(asked, &given.problem, &wishes, &given.answer), says, __LINE__))

static void refusals(void) {
  asked = stiction_create();
  anew();
  stiction_factors* p = &given.problem;
  REFUSED(p->dimension = 4, "dimension is 4; expected 2 or 3");
  REFUSED(p->contact_count = -1, "contact_count is -1; expected 0 to");
  REFUSED(p->contacts = NULL, "contacts is NULL; expected 2 numbers");
  REFUSED(given.contacts[1].kind = 4, "contacts[1].kind is 4; expected a stiction_kind, 0 to 3");
  REFUSED(given.contacts[1].mu = -1, "contacts[1].mu is -1; expected a finite number >= 0");
  REFUSED(given.contacts[0].mu = NAN, "contacts[0].mu is nan");
  REFUSED(given.contacts[1].kind = STICTION_BILATERAL, "contacts[1].mu is 0.5; expected 0");
  REFUSED(given.contacts[1].kind = STICTION_SLIDING, "contacts[1].slip has length 0; expected 1");
  REFUSED(p->rows = 2, "rows is 2; expected 4, a row of each contact and, with friction, 1 more");
  REFUSED(p->velocities = -2, "velocities is -2");
  REFUSED(p->row_starts = NULL, "row_starts is NULL; expected 5 numbers");
  REFUSED(given.row_starts[0] = 1, "row_starts[0] is 1; expected 0");
  REFUSED(given.row_starts[2] = 1, "row_starts[2] is 1; expected at least row_starts[1], 2");
  REFUSED(p->columns = NULL, "columns is NULL; expected 8 numbers");
  REFUSED(p->values = NULL, "values is NULL; expected 8 numbers");
  REFUSED(given.values[3] = INFINITY, "values[3] is inf; expected a finite number");
  REFUSED(given.columns[3] = 3, "columns[3], in row 1, is 3; expected 0 to 2");
  REFUSED(given.columns[3] = -1, "columns[3], in row 1, is -1");
  REFUSED(p->block_count = -1, "block_count is -1");
  REFUSED(p->block_sizes = NULL, "block_sizes is NULL");
  REFUSED(given.block_sizes[0] = 0, "block_sizes[0] is 0; expected 1 to 3");
  REFUSED(given.block_sizes[0] = 1, "block_sizes add up to 2; expected 3");
  REFUSED(p->mass = NULL, "mass is NULL; expected 5 numbers");
  REFUSED(given.mass[4] = NAN, "mass[4] is nan");
  REFUSED(given.mass[1] = 1, "block 0 of mass is not symmetric");
  REFUSED(given.mass[4] = 0, "block 1 of mass is not positive definite");
  REFUSED(given.mass[4] = -1, "block 1 of mass is not positive definite");
  REFUSED(p->w = NULL, "w is NULL; expected 3 numbers");
  REFUSED(given.w[2] = NAN, "w[2] is nan");
  REFUSED(given.c[2] = NAN, "c[2] is nan");
  REFUSED(given.answer.forces = NULL, "answer.forces is NULL; expected room for 4 numbers");
  REFUSED(wishes.size = 3, "options.size is 3; expected ");
  REFUSED(wishes.warm = 2, "options.warm is 2; expected 0 or 1");
  REFUSED(wishes.residual = 0, "options.residual is 0; expected a number between 0 and 1");
  REFUSED(wishes.noise = -1, "options.noise is -1");
  REFUSED(wishes.points = -1, "options.points is -1");
  REFUSED(wishes.dense_rows = -1, "options.dense_rows is -1");
  refused(stiction_solve(asked, NULL, NULL, &given.answer), "problem is NULL", __LINE__);
  refused(stiction_solve(asked, &given.problem, NULL, NULL), "answer is NULL", __LINE__);
  CHECK(stiction_solve(NULL, &given.problem, NULL, &given.answer) == STICTION_REFUSED);
  CHECK(strstr(stiction_message(NULL), "context is NULL") != NULL);
  stiction_destroy(NULL);
  stiction_default_options(NULL, 0);

  double A[4] = {1, 0, 0, NAN}, b[2] = {0, 0};
  stiction_dense dense = {
      .dimension = 2, .contact_count = 1, .contacts = given.contacts, .rows = 2, .A = A, .b = b};
  refused(stiction_solve_dense(asked, &dense, NULL, &given.answer), "A[1 * stride + 1] is nan", __LINE__);
  dense.stride = 1;
  refused(stiction_solve_dense(asked, &dense, NULL, &given.answer), "stride is 1; expected 0, or at least 2",
          __LINE__);
  dense.stride = 0, dense.A = NULL;
  refused(stiction_solve_dense(asked, &dense, NULL, &given.answer), "A is NULL", __LINE__);
  A[3] = 1, dense.A = A, dense.b = NULL;
  refused(stiction_solve_dense(asked, &dense, NULL, &given.answer), "b is NULL; expected 2 numbers", __LINE__);
  refused(stiction_solve_dense(asked, NULL, NULL, &given.answer), "problem is NULL", __LINE__);
  // After all of that it works.
  solve(asked, &given, NULL);
  stiction_destroy(asked);
}

// ---- Memory and threads ----------------------------------------------------------------------------------

#if defined(__has_feature)
#define HAS_FEATURE(x) __has_feature(x)
#else
#define HAS_FEATURE(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || HAS_FEATURE(address_sanitizer) || \
    HAS_FEATURE(thread_sanitizer)
#define SANITIZED 1  // which takes address space without end
#else
#define SANITIZED 0
#endif

// A of 128 MB is not copied into 64 MB.
static void little_memory(void) {
  enum { COUNT = 4000 };
  if (SANITIZED || getenv("VALGRIND") != NULL) return;
  stiction_context* context = stiction_create();
  stiction_contact* contacts = calloc(COUNT, sizeof *contacts);
  double *A = calloc((size_t)COUNT * COUNT, sizeof *A), *b = calloc(COUNT, sizeof *b),
         *f = calloc(COUNT, sizeof *f);
  for (int i = 0; i < COUNT; ++i)
    contacts[i].kind = STICTION_FRICTIONLESS, A[(size_t)i * COUNT + i] = 1, b[i] = -1;
  const stiction_dense problem = {
      .dimension = 2, .contact_count = COUNT, .contacts = contacts, .rows = COUNT, .A = A, .b = b};
  stiction_answer answer = {.forces = f};
  FILE* status = fopen("/proc/self/statm", "r");
  unsigned long long pages = 0;
  CHECK(status != NULL && fscanf(status, "%llu", &pages) == 1);
  if (status != NULL) fclose(status);
  struct rlimit before, now;
  getrlimit(RLIMIT_AS, &before);
  now = before;
  now.rlim_cur = pages * 4096 + (64u << 20);
  setrlimit(RLIMIT_AS, &now);
  const stiction_verdict verdict = stiction_solve_dense(context, &problem, NULL, &answer);
  setrlimit(RLIMIT_AS, &before);
  CHECK(verdict == STICTION_NO_MEMORY && f[0] == 0);
  CHECK(strcmp(stiction_message(context), "there is not enough memory for this problem") == 0);
  block it;
  flat(&it, STICTION_STATIC, 0.5, 8);
  solve(context, &it, NULL);
  stiction_destroy(context);
  free(contacts), free(A), free(b), free(f);
}

enum { STEPS = 200 };

static void* many(void* place) {
  double* sums = place;
  stiction_context* context = stiction_create();
  for (int k = 0; k < STEPS; ++k) {
    block it;
    if (k % 8 < 7) deep(&it, STICTION_STATIC, 0.5, 0.08 * k, k % 3);
    if (k % 8 == 7) flat(&it, STICTION_STATIC, 0.5, 0.08 * k);
    it.problem.keys = it.keys;
    if (stiction_solve(context, &it.problem, NULL, &it.answer) != STICTION_SOLVED) break;
    for (int i = 0; i < it.problem.rows; ++i) sums[k] += (i + 1) * it.f[i];
  }
  stiction_destroy(context);
  return NULL;
}

static void threads_do_not_see_each_other(void) {
  static double sums[3][STEPS];
  pthread_t threads[2];
  for (int t = 0; t < 2; ++t) CHECK(pthread_create(&threads[t], NULL, many, sums[t]) == 0);
  for (int t = 0; t < 2; ++t) pthread_join(threads[t], NULL);
  many(sums[2]);
  CHECK(sums[2][STEPS - 1] != 0);
  CHECK(memcmp(sums[0], sums[2], sizeof sums[0]) == 0 && memcmp(sums[1], sums[2], sizeof sums[1]) == 0);
}

int main(void) {
  blocks_stick_and_slip();
  kinds();
  numbers();
  without_contacts();
  rows_of_engines();
  warm_starts();
  contradictions_are_undecided();
  refusals();
  little_memory();
  threads_do_not_see_each_other();
  printf("stiction %s from C: %s\n", stiction_version(), failures ? "wrong" : "right");
  return failures;
}
