# SPDX-License-Identifier: Apache-2.0
"""What exact linear algebra costs: whole exact runs, and systems beside FLINT (libflint) where it is installed.

Systems are dense, of random integers. `stiction` is a whole call on a problem of bilateral contacts, whose forces solve
the system: elimination without fractions, and verification. FLINT has its matrices at hand: elimination over fractions
(`gauss`), without fractions (`fraction-free`), and what it chooses itself (`solve`); its answers must be the same.
Microseconds of processor time: median (90 %)."""

import ctypes
import ctypes.util
import random
import time
from fractions import Fraction

import stiction
import study

library = ctypes.util.find_library("flint")
flint = ctypes.CDLL(library) if library else None


class Matrix:
    """Of FLINT, over rationals."""

    def __init__(self, rows):
        self.rows, self.columns = len(rows), len(rows[0])
        self.memory = ctypes.create_string_buffer(64)
        flint.fmpq_mat_init(self.memory, ctypes.c_long(self.rows), ctypes.c_long(self.columns))
        for k, x in enumerate(x for row in rows for x in row):
            flint.fmpq_set_str(self.entry(k), str(x).encode(), 10)

    def entry(self, k):
        """A pointer to one of them, by rows: the first field points to all."""
        return ctypes.c_void_p(ctypes.cast(self.memory, ctypes.POINTER(ctypes.c_void_p))[0] + 16 * k)

    def value(self, i, j):
        text = ctypes.create_string_buffer(100000)
        flint.fmpq_get_str(text, 10, self.entry(i * self.columns + j))
        return Fraction(text.value.decode())

    def __del__(self):
        flint.fmpq_mat_clear(self.memory)


def flint_ways(M, right):
    """name -> (microseconds, solution)."""
    size = len(M)
    A, b, whole = Matrix(M), Matrix([[x] for x in right]), Matrix([[*row, x] for row, x in zip(M, right)])
    x, reduced = Matrix([[0]] * size), Matrix([[0] * (size + 1)] * size)
    for name, call, answer, column in (
            ("gauss", lambda: flint.fmpq_mat_rref_classical(reduced.memory, whole.memory), reduced, size),
            ("fraction-free", lambda: flint.fmpq_mat_rref_fraction_free(reduced.memory, whole.memory), reduced, size),
            ("solve", lambda: flint.fmpq_mat_solve(x.memory, A.memory, b.memory), x, 0)):
        start = time.thread_time()
        call()
        yield name, 1e6 * (time.thread_time() - start), [answer.value(i, column) for i in range(size)]


def systems(size, most, o):
    """A row: ours, and FLINT's ways."""
    numbers, spent = random.Random(f"{o.seed} {size} {most}"), {"stiction": []}
    while len(spent["stiction"]) < o.problems:
        M = [[numbers.randint(-most, most) for _ in range(size)] for _ in range(size)]
        right = [numbers.randint(-most, most) for _ in range(size)]
        problem = stiction.Problem(M, [-x for x in right], 0, ["bilateral"] * size)
        ours = stiction.solve_all([problem], "complete", "exact")
        if ours["outcome"][0] != "solved":
            continue  # a singular system
        spent["stiction"].append(1e6 * ours["seconds"][0])
        for name, microseconds, x in flint_ways(M, right) if flint else ():
            spent.setdefault(name, []).append(microseconds)
            if sorted(stiction.solve(problem, "complete", "exact").exact_f) != sorted(x):  # rows may have changed places
                raise SystemExit(f"{name}: another solution of a system of {size} rows")
    return [f"up to {most:,}", size, *map(study.times, spent.values())]


def main():
    o = study.options(__doc__, contacts=[2, 4, 6, 8], sizes=[6, 12, 16], problems=100, seed=1)
    ways = ["gauss", "fraction-free", "solve"] if flint else []
    study.show(["integers", "rows", "stiction", *ways],
               [systems(size, most, o) for most in (100, 2 ** 62) for size in o.sizes])
    rows = []
    for generator in ("integers", "psd", "bodies", "conditioned"):
        for contacts in o.contacts:
            problems = stiction.draw(generator, contacts, o.problems, o.seed)
            rows.append((f"`{generator}`", contacts, *(
                study.times(1e6 * stiction.solve_all(problems, method, "exact")["seconds"])
                for method in ("complete", "baraff", "lemke"))))
    study.show(["whole runs", "contacts", "`complete`", "`baraff`", "`lemke`"], rows)
    if not flint:
        print("FLINT is not installed (libflint-dev).")


study.run(main)
