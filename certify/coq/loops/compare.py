#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the extracted Coq function, step by step and in exact numbers, with certify/check_runs.py or with the C++.

    compare.py RUN [--policies N | --all] [--drives K] [--seed S] PROBLEM...
    compare.py RUN --package DIR [...] [--problems N] [PROBLEM...]

RUN: the program of run.ml, which `./run prove --compare` makes. Of each problem: N random policies, K drives at
most. Compared: every pivot (drive, driven, goal, length, limiting variable, from, to), after every drive all sets,
forces, accelerations and what resume=round remembers, and how the run ends. A run that ends in a cycle is compared up
to there, its start and period, too.

With --package, the directory of the Python package, it is the C++, whose `stiction.replay` tells every pivot and the
forces and accelerations after it: compared are all pivots, forces and accelerations after every drive, and the end,
of the files, and of N random problems of one to four contacts, each under one random policy. A fourth of these are
near files, where loops are; the others have small integers, so that ties are frequent, and A definite, semidefinite
or of no symmetry. Exit 1 if anything differs.
"""
import argparse
import concurrent.futures
import itertools
import os
import random
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
parser = argparse.ArgumentParser()
parser.add_argument("run")
parser.add_argument("files", nargs="*")
parser.add_argument("--package")
parser.add_argument("--problems", type=int, default=0)
parser.add_argument("--policies", type=int, default=20)
parser.add_argument("--all", action="store_true")
parser.add_argument("--drives", type=int, default=40)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--flaw", action="store_true", help="a wrong check_runs.py, to see that this program notices")
o = parser.parse_intermixed_args()
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import certificate_reader  # noqa: E402
import check_runs  # noqa: E402
if o.package:
    sys.path.insert(0, o.package)
    import stiction

GRID = [dict(zip(check_runs.SWITCHES, values)) for values in itertools.product(*check_runs.SWITCHES.values())]


def name(policy):
    return ",".join(f"{s}={v}" for s, v in policy.items() if v != check_runs.SWITCHES[s][0]) or "paper"


class Recorded(check_runs.Published):
    """check_runs.py, keeping what it has after every drive."""
    lines = None

    def drive(self, v, goal):
        if self.lines is None:
            self.lines = []
        if self.drives == o.drives:
            raise check_runs.Ended("limit")
        first = len(self.steps)
        try:
            super().drive(v, goal)
        finally:
            self.lines += [("pivot", s["drive"], s["driven"], s["goal"], s["step"], s["limiting"], s["from"], s["to"])
                           for s in self.steps[first:]]
        self.lines.append(("state", tuple(self.sets), tuple(self.f), tuple(self.a), self.remembered()))

    if o.flaw:
        def filed(self, row):
            return ("CF", "NC+", "NC-")[check_runs.sign(self.a[row])]


def parse(text):
    for line in text.splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "policy":
            made = []
            yield made
        elif kind == "pivot":
            drive, driven, goal, length, limiting, before, after = rest.split()
            made.append(("pivot", int(drive), driven, goal, Fraction(length), limiting, before, after))
        elif kind == "state":
            sets, f, a, last = rest.split(" | ")
            made.append(("state", tuple(sets.split()), tuple(map(Fraction, f.split())), tuple(map(Fraction, a.split())),
                         None if last == "-" else int(last)))
        else:
            made.append(("end", rest))


# ---- Problems: A, b, mu ----

def of_file(path):
    """Or None, where contacts are not static, or not in the plane."""
    value = certificate_reader.load(path)
    value = value.get("problem", value)
    problem = certificate_reader.read_problem(value, "$", certificate_reader.exact_or_double,
                                              ("name", "scene", "origin", "expect"))
    return problem if problem.dimension == 2 and all(c.kind == "static" for c in problem.contacts) else None


def near(problem, draw):
    """The problem with one number of A and one of b moved: loops often stay loops."""
    A, b = [list(row) for row in problem.A], list(problem.b)
    i, j, k = (draw.randrange(len(b)) for _ in range(3))
    by = [Fraction(draw.choice([-1, 1]), draw.choice([1, 2, 4, 8])) for _ in range(2)]
    A[i][j] += by[0]
    A[j][i] = A[i][j]
    b[k] += by[1]
    return problem._replace(A=A, b=b)


def drawn(number, bases):
    """A random problem, the same for the same seed: every fourth near one of the files."""
    draw = random.Random(f"{o.seed} {number}")
    if bases and number % 4 == 0:
        return near(draw.choice(bases), draw)
    contacts = [certificate_reader.Contact("static", Fraction(draw.choice(["0", "1/4", "1/2", "1", "1", "2", "5"])), ())
                for _ in range(draw.choice([1, 2, 2, 3, 3, 4]))]
    n = 2 * len(contacts)
    kind = draw.choice(["definite", "definite", "semidefinite", "asymmetric"])
    M = [[draw.randint(-3, 3) for _ in range(max(1, n - (kind == "semidefinite") - draw.randint(0, 1)))]
         for _ in range(n)]
    A = [[Fraction(sum(x * y for x, y in zip(u, v))) for v in M] for u in M]
    for i in range(n):
        A[i][i] += kind != "semidefinite"
        if kind == "asymmetric":
            A[i][draw.randrange(n)] += draw.randint(-1, 1)
    b = [Fraction(draw.randint(-3, 3 if row % 2 else 0)) for row in range(n)]
    if kind == "semidefinite" and draw.random() < 0.5:  # in range(A)
        v = [draw.randint(-1, 1) for _ in range(n)]
        b = [sum(x * y for x, y in zip(row, v)) for row in A]
    return certificate_reader.Problem(2, contacts, A, b)


# ---- What the others do: the lines of a run, how it ends, and whether they stop where a state recurs ----

def by_check_runs(problem, policy):
    run = Recorded(check_runs.Rows(problem), policy, lambda steps: None)
    outcome = run.compute_forces().outcome
    return run.lines or [], outcome, None


def by_program(problem, policy):
    made = stiction.Problem(A=[[str(x) for x in row] for row in problem.A], b=[str(x) for x in problem.b],
                            mu=[str(c.mu) for c in problem.contacts])
    said = stiction.replay(made, name(policy), max_drives=o.drives).json
    if o.flaw and said["pivots"]:
        said["pivots"][-1]["step"] = "7/11"
    lines, last = [], {}
    for p in said["pivots"]:
        lines.append(("pivot", p["drive"], p["driven"], p["goal"], Fraction(p["step"]), p["limiting"], p["from"],
                      p["to"]))
        last[p["drive"]] = tuple(tuple(map(Fraction, p[key])) for key in "fa")
    return lines, said["outcome"], {**said, "after": last}


def drives_of(want, outcome, said):
    """How many drives the Coq function shall make: where the others see a state recur, no more than they."""
    if outcome != "cycle":
        return o.drives
    return said["start"] + said["period"] if said else sum(line[0] == "state" for line in want)


def agree(want, outcome, said, got):
    """Whether the Coq function's lines are those."""
    if said is None:
        return got[:len(want)] == want if outcome == "cycle" else got == want + [("end", outcome)]
    states = [line for line in got if line[0] == "state"]
    if outcome == "cycle" and len(states) != drives_of(want, outcome, said):
        return False
    if outcome not in ("cycle", "limit") and got[-1] != ("end", outcome):
        return False
    after = {k + 1: state[2:4] for k, state in enumerate(states)}  # forces and accelerations after each drive
    return [line for line in got if line[0] == "pivot"] == want and all(said["after"][k] == after[k] for k in after)


def coq(lines):
    done = subprocess.run([o.run], input="\n".join(lines) + "\n", stdout=subprocess.PIPE, text=True, check=True)
    return list(parse(done.stdout))


def compared(task):
    """(policy, outcome, pivots, states, what differs) of every policy of a problem."""
    place, problem, numbers = task
    lines = [f"problem {len(problem.b)}", *(" ".join(map(str, row)) for row in problem.A),
             " ".join(map(str, problem.b)), " ".join(str(c.mu) for c in problem.contacts)]
    expected = [(by_program if o.package else by_check_runs)(problem, GRID[i]) for i in numbers]
    found = coq(lines + [f"policy {i} {drives_of(*other)}" for i, other in zip(numbers, expected)])
    assert len(found) == len(numbers)
    rows = []
    for i, got, (want, outcome, said) in zip(numbers, found, expected):
        count = Counter(line[0] for line in (got if said else want))
        what = None
        if not agree(want, outcome, said, got):
            other = [line for line in got if line[0] == "pivot"] if said else got
            k = next((k for k, (x, y) in enumerate(zip(want, other)) if x != y), min(len(want), len(other)))
            what = f"{place} {name(GRID[i])} {outcome}\n  others {want[k:k + 1]}\n  Coq    {other[k:k + 1]}"
        rows.append((outcome, count["pivot"], count["state"], what))
    return rows


def tasks():
    draw, bases = random.Random(o.seed), []
    for path in o.files:
        problem = of_file(path)
        if problem:
            bases += [problem] if len(problem.contacts) <= 4 else []
            yield path, problem, range(1536) if o.all else sorted(draw.sample(range(1536), o.policies))
    for k in range(o.problems):
        yield f"random problem {k} of seed {o.seed}", drawn(k, bases), [draw.randrange(1536)]


ends, pivots, states, problems, differ = Counter(), 0, 0, 0, 0
with concurrent.futures.ThreadPoolExecutor(os.cpu_count() if o.package else 1) as pool:
    for rows in pool.map(compared, tasks()):
        problems += 1
        for outcome, pivot, state, what in rows:
            ends[outcome] += 1
            pivots, states = pivots + pivot, states + state
            if what:
                differ += 1
                if differ <= 5:
                    print(what)
print(f"{problems} problems of static contacts of the plane, {sum(ends.values())} runs, {pivots} pivots, {states} "
      f"states; ends {dict(sorted(ends.items()))}; differ: {differ}")
sys.exit(differ > 0)
