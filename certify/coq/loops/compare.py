#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the extracted Coq function with certify/check_runs.py, step by step, in exact numbers.

    compare.py RUN [--policies N | --all] [--drives K] [--seed S] PROBLEM...

RUN: the program of run.ml, which `./run prove --compare` makes. Of each problem: N random policies, K drives at
most. Compared: every pivot (drive, driven, goal, length, limiting variable, from, to), after every drive all sets,
forces, accelerations and what resume=round remembers, and how the run ends. A run that check_runs.py ends in a
cycle is compared up to there. Exit 1 if anything differs.
"""
import argparse
import itertools
import random
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
parser = argparse.ArgumentParser()
parser.add_argument("run")
parser.add_argument("problems", nargs="+")
parser.add_argument("--policies", type=int, default=20)
parser.add_argument("--all", action="store_true")
parser.add_argument("--drives", type=int, default=40)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--flaw", action="store_true", help="a wrong check_runs.py, to see that this program notices")
o = parser.parse_args()
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import certificate_reader  # noqa: E402
import check_runs  # noqa: E402

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


random.seed(o.seed)
ends, pivots, states, differ, looked, left_out = Counter(), 0, 0, 0, 0, 0
for path in o.problems:
    value = certificate_reader.load(path)
    value = value.get("problem", value)
    problem = certificate_reader.read_problem(value, "$", certificate_reader.exact_or_double,
                                              ("name", "scene", "origin", "expect"))
    if problem.dimension != 2 or any(c.kind != "static" for c in problem.contacts):
        left_out += 1  # not static contacts of the plane
        continue
    numbers = range(1536) if o.all else sorted(random.sample(range(1536), o.policies))
    lines = [f"problem {len(problem.b)}", *(" ".join(map(str, row)) for row in problem.A),
             " ".join(map(str, problem.b)), " ".join(str(c.mu) for c in problem.contacts)]
    lines += [f"policy {i} {o.drives}" for i in numbers]
    expected = []
    for i in numbers:
        run = Recorded(check_runs.Rows(problem), GRID[i], lambda steps: None)
        outcome = run.compute_forces().outcome
        expected.append((run.lines or [], outcome))
    out = subprocess.run([o.run], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True).stdout
    found = list(parse(out))
    assert len(found) == len(numbers)
    for i, (want, outcome), got in zip(numbers, expected, found):
        looked += 1
        ends[outcome] += 1
        if outcome == "cycle":
            same = got[:len(want)] == want
        else:
            same = got == want + [("end", outcome)]
        pivots += sum(x[0] == "pivot" for x in want)
        states += sum(x[0] == "state" for x in want)
        if not same:
            differ += 1
            if differ <= 5:
                k = next((k for k, (x, y) in enumerate(zip(want, got)) if x != y), min(len(want), len(got)))
                print(path, name(GRID[i]), outcome, "\n  check_runs", want[k:k + 1], "\n  Coq       ", got[k:k + 1])
print(f"{len(o.problems) - left_out} problems of static contacts of the plane, {looked} runs, {pivots} pivots, "
      f"{states} states; ends {dict(ends)}; differ: {differ}")
sys.exit(differ > 0)
