# SPDX-License-Identifier: Apache-2.0
"""What Python costs of many problems at once: the rate of solve_many and replay_many beside that of the library.

`library`: problems by processor time of the C++ calls alone, on problems that are in memory, each timed where it runs;
`Python`: the same by that of the whole call from arrays of numpy to arrays, all threads of the process together. Their
ratio is the part of the rate of C++ that Python has; `a second` is by the clock on the wall, on all cores."""

import os
import time

import numpy as np

import stiction
import study


def arrays(generator, contacts, o):
    problems = stiction.draw(generator, contacts, o.problems, o.seed, mu=1)
    return np.array([p.A for p in problems]), np.array([p.b for p in problems])


def runs():
    for method in ("auto", "complete", "fast", "lemke"):
        yield f"`solve_many`, `{method}`, doubles", lambda A, b, m=method: stiction.solve_many(A, b, 1, method=m)
    yield "`replay_many`, doubles", lambda A, b: stiction.replay_many(A, b, 1, arithmetic="double")
    yield "`replay_many`, rationals", lambda A, b: stiction.replay_many(A, b, 1)


def measured(run, A, b, o):
    """Of `repeat` times: processor time of the library and of all of it, and seconds on the wall."""
    for _ in range(o.repeat):
        start, wall = time.process_time(), time.perf_counter()
        answers = run(A, b)
        yield answers.seconds, time.process_time() - start, time.perf_counter() - wall


def main():
    o = study.options(__doc__, generator="bodies", contacts=[2, 4, 8], problems=10000, repeat=5, seed=1)
    rows = []
    for contacts in o.contacts:
        A, b = arrays(o.generator, contacts, o)
        for name, run in runs():
            library, whole, wall = np.array(list(measured(run, A, b, o))).T
            rows.append((name, contacts, float(len(b) / np.median(library)), float(len(b) / np.median(whole)),
                         study.times(library / whole), float(len(b) / np.median(wall))))
    study.show(["call", "contacts", "library, problems a core second", "Python", "ratio: median (90 %)",
                f"a second on {os.cpu_count()} cores"], rows)


study.run(main)
