#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Problems with one extreme dial each, by every method in every arithmetic: does anything crash, or call solved
what is not?

    tests/setup/extremes.py build/release/stiction [--problems N] [--seed S]

Forces are judged here over fractions, with roots to 80 digits, on the numbers that the arithmetic made of the problem:
an error above the bound of the arithmetic, in units of each contact, is a wrong answer. Prints a table by dial and exits 1 if
there was a crash or a wrong answer. By hand: some minutes.
"""

import argparse
import collections
import decimal
import itertools
import json
import random
import re
import struct
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

BOUND, BOUNDS = Fraction(1, 10**8) * (1 + Fraction(1, 2**30)), {"float": Fraction(1, 10**6)}
UNITS = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (0, 1, 1), (-3, 4, 5), (4, -3, 5)]
decimal.getcontext().prec = 80
decimal.getcontext().Emax = decimal.MAX_EMAX
decimal.getcontext().Emin = decimal.MIN_EMIN


# ---- Problems --------------------------------------------------------------------------------

def product(J, W):
    return [[sum(x * w * y for x, w, y in zip(p, W, q)) for q in J] for p in J]


def body_rows(draw, dimension, lever, parallel):
    """Rows of one contact: normal, then tangential; columns are velocities and spins of one body."""
    if dimension == 3:
        return [[Fraction(draw.randint(-3, 3)) for _ in range(3)] +
                [lever * draw.randint(-3, 3) for _ in range(3)] for _ in range(3)]
    x, y, z = draw.choice(UNITS)
    n = (Fraction(x, z) + parallel, Fraction(y, z))
    r = (lever * draw.randint(-3, 3), lever * draw.randint(-3, 3))
    t = (-n[1], n[0])
    return [[*d, r[0] * d[1] - r[1] * d[0]] for d in (n, t)]


def make(draw, dimension, dial, value):
    """A problem of one to three contacts on two bodies, A = J W J', b = J v + what is out of its range."""
    contacts, free = draw.randint(1, 3), 3 if dimension == 2 else 6
    lever = value if dial == "levers" else Fraction(1)
    W = [Fraction(1, draw.randint(1, 9)) for _ in range(2 * free)]
    if dial == "masses":
        W[free:] = [w / value for w in W[free:]]
    J = []
    first = body_rows(draw, dimension, lever, Fraction(0))
    for i in range(contacts):
        close = dial == "parallel" and i > 0
        mine = [[x + (1 / value if close and k == 0 and j == 0 else 0) for j, x in enumerate(row)]
                for k, row in enumerate(first)] if close else body_rows(draw, dimension, lever, Fraction(0))
        other = body_rows(draw, dimension, lever, Fraction(0)) if draw.random() < 0.5 else None
        for k, row in enumerate(mine):
            J.append(row + ([-x for x in other[k]] if other else [Fraction(0)] * free))
    A = product(J, W)
    v = [Fraction(draw.randint(-9, 9)) for _ in range(2 * free)]
    b = [sum(x * y for x, y in zip(row, v)) for row in J]
    if dial == "range":
        b = [x + Fraction(draw.randint(-3, 3)) / value for x in b]
    if dial == "units":
        scale = value
        A, b = [[x * scale for x in row] for row in A], [x / scale for x in b]
    mu = [Fraction(draw.choice([0, 1, 2, 5]), draw.choice([1, 2, 3])) for _ in range(contacts)]
    if dial == "mu":
        mu = [m * value if draw.random() < 0.7 else m / value for m in mu]
    return {"dimension": dimension, "mu": mu, "A": A, "b": b}


DIALS = {
    "masses": [10**k for k in (0, 4, 8, 12, 16)],
    "levers": [Fraction(10) ** k for k in (-150, -60, -8, 8, 60, 150)],
    "units": [Fraction(10) ** k for k in (-300, -150, -40, 40, 150, 300)],
    "parallel": [10**k for k in (4, 8, 12, 16)],
    "mu": [10**k for k in (2, 4, 8, 12, 16)],
    "range": [10**k for k in (0, 4, 8, 12, 16)],
}


def as_file(problem):
    return {"format": "stiction-problem", "version": 1, "name": "extreme", "dimension": problem["dimension"],
            "contacts": [{"kind": "static", "mu": str(m)} for m in problem["mu"]],
            "A": [[str(x) for x in row] for row in problem["A"]], "b": [str(x) for x in problem["b"]]}


# ---- Judging -----------------------------------------------------------------------------------

def rounder(arithmetic):
    if arithmetic in ("exact", "interval"):
        return lambda x: x
    if arithmetic == "float":
        return lambda x: Fraction(struct.unpack("f", struct.pack("f", float(x)))[0])
    return lambda x: Fraction(float(x))


def rounded(problem, arithmetic):
    to = rounder(arithmetic)
    return {"dimension": problem["dimension"], "mu": [to(m) for m in problem["mu"]],
            "A": [[to(x) for x in row] for row in problem["A"]], "b": [to(x) for x in problem["b"]]}


def accelerations(problem, f):
    return [sum(x * y for x, y in zip(row, f)) + b for row, b in zip(problem["A"], problem["b"])]


def root(x):
    return Fraction((decimal.Decimal(x.numerator) / decimal.Decimal(x.denominator)).sqrt())


def length(xs):
    return root(sum(x * x for x in xs))


def groups(problem, rows):
    """The contacts that A couples, as sets of rows."""
    left, found = set(range(len(problem["mu"]))), []
    while left:
        group, todo = set(), [left.pop()]
        while todo:
            one = todo.pop()
            group.add(one)
            near = {k for k in left if any(problem["A"][i][j] != 0 for i in rows[one] for j in rows[k])}
            left -= near
            todo += near
        found.append([i for k in group for i in rows[k]])
    return found


def units(problem, f, a, rows):
    """What accelerations and forces of each row are measured in: solver/problem/units.h says why."""
    acceleration, force = [None] * len(f), [None] * len(f)
    for group in groups(problem, rows):
        work = abs(sum(f[i] * (a[i] - problem["b"][i]) for i in group))
        for i in group:
            own = abs(problem["A"][i][i])
            size = sum(abs(x) * max(abs(f[j]), abs(problem["b"][j]) / problem["A"][j][j] if problem["A"][j][j] else 0)
                       for j, x in enumerate(problem["A"][i]))
            acceleration[i] = abs(problem["b"][i]) + min(size, root(own * work))
            force[i] = acceleration[i] / own if own else Fraction(0)
    return acceleration, force


def over(x, unit):
    return Fraction(0) if x == 0 else x / unit if unit else Fraction(10) ** 300


def friction_error(limit, f, a, unit_f, unit_a, law):
    """Of a contact that touches: it sticks, or slips, or both f and a are moved by as much."""
    force, speed = length(f), length(a)
    sticks = max(over(speed, unit_a), over(max(Fraction(0), force - limit), unit_f))
    if unit_a == 0:
        return sticks
    if law == "coulomb":
        r = unit_f / unit_a
        y = [x - r * z for x, z in zip(f, a)]
        size = length(y)
        p = [x * limit / size for x in y] if size > limit else y
        return min(sticks, over(length([x - z for x, z in zip(f, p)]), unit_f))
    power = sum(x * z for x, z in zip(f, a))
    turned = max(over(abs(force - limit), unit_f), over(max(Fraction(0), power) / (force or 1), unit_a))
    if power <= 0:
        return min(sticks, turned)
    across = abs(f[0] * a[1] - f[1] * a[0]) / speed
    return min(sticks, turned, over(length([power / speed, across - limit]), unit_f))


def error(problem, f, law):
    """The largest error of any contact in its nearest mode, over fractions."""
    size = problem["dimension"]
    rows = [range(size * k, size * (k + 1)) for k in range(len(problem["mu"]))]
    a = accelerations(problem, f)
    acceleration, force = units(problem, f, a, rows)
    worst = Fraction(0)
    for mu, (n, *t) in zip(problem["mu"], rows):
        fF, aF = [f[k] for k in t], [a[k] for k in t]
        unit_f, unit_a = max(force[k] for k in t), max(acceleration[k] for k in t)
        wide = max(unit_f, mu * force[n])
        separates = max(over(max(Fraction(0), -a[n]), acceleration[n]), over(abs(f[n]), force[n]), over(length(fF), unit_f))
        limit = mu * max(Fraction(0), f[n])
        touches = max(over(abs(a[n]), acceleration[n]), over(max(Fraction(0), -f[n]), force[n]),
                      friction_error(limit, fF, aF, wide, unit_a, "coulomb" if size == 2 else law))
        worst = max(worst, min(separates, touches))
    return worst


# ---- Runs --------------------------------------------------------------------------------------

def number(x):
    if isinstance(x, list):
        return (Fraction(x[0]) + Fraction(x[1])) / 2
    return Fraction(x)


def judge(program, file, problem, method, arithmetic, counts):
    done = subprocess.run([program, "solve", file, "--method", method, "--arithmetic", arithmetic, "--json",
                           "--max-pivots", "2000", "--seconds", "20"],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120)
    if done.returncode not in (0, 1, 2, 3):
        counts["crash"] += 1
        return f"exit {done.returncode}: {done.stderr.strip()}"
    if done.returncode == 2:
        counts["refused"] += 1
        return "" if re.search("holds with all its digits|in the range of", done.stderr) else f"refused: {done.stderr.strip()}"
    answer = json.loads(done.stdout)
    if answer["outcome"] != "solved" or done.returncode != 0:
        counts[answer["outcome"]] += 1
        return "" if (answer["outcome"] == "solved") == (done.returncode == 0) else "exit code and outcome differ"
    counts["solved"] += 1
    f = [number(x) for x in answer["f"]]
    size = error(rounded(problem, arithmetic), f, answer.get("law", "baraff"))
    if size > BOUNDS.get(arithmetic, BOUND) and not (answer["arithmetic"] == "exact" and problem["dimension"] == 3):
        counts["wrong"] += 1
        return f"solved with an error of {float(size):.3g}"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--problems", type=int, default=600, help="in all")
    parser.add_argument("--seed", type=int, default=1)
    o = parser.parse_args()
    draw = random.Random(o.seed)
    methods = [m for m in json.loads(subprocess.run([o.program, "methods", "--json"], stdout=subprocess.PIPE,
                                                    text=True, check=True).stdout) if m["name"] not in ("ipopt", "qp")]
    table, faults = collections.defaultdict(collections.Counter), 0
    settings = list(itertools.product(DIALS.items(), (2, 3)))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "problem.json"
        for index in range(o.problems):
            (dial, values), dimension = settings[index % len(settings)]
            problem = make(draw, dimension, dial, Fraction(draw.choice(values)))
            file.write_text(json.dumps(as_file(problem)))
            for method in methods:
                for arithmetic in method["plane" if dimension == 2 else "space"]:
                    fault = judge(o.program, file, problem, method["name"], arithmetic, table[dial])
                    if fault:
                        faults += 1
                        print(f"problem {index} ({dial}, dimension {dimension}), {method['name']} {arithmetic}: {fault}")
    columns = ["solved", "wrong", "crash", "refused", "undecided", "limit", "cycle", "ray", "singular",
               "no-solution"]
    print(f"{'dial':10}", *(f"{c:>11}" for c in columns))
    for dial, counts in table.items():
        print(f"{dial:10}", *(f"{counts[c]:>11}" for c in columns))
    print(f"{o.problems} problems, {sum(sum(c.values()) for c in table.values())} runs, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
