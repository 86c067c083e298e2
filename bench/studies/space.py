# SPDX-License-Identifier: Apache-2.0
"""Readings of section 5.6 in space, on the same random problems: counts and outcomes.

    A = J J', b = J w    J 3n x columns, entries of J and w uniform integers in [-1000, 1000]

A is positive semidefinite and b in its range: `definite` has 3 n + 1 columns, `one body` has 6, and its A is singular
for three contacts and more. mu is 1/5, 1/2, 1, 2 or 5 at all contacts, in turn.

Doubles suspect a loop where a rounded state recurs. It is run again over quad: there it recurs (same
start, same period), comes nearer to a loop (a later start, or another period), or is left again. Loops and rays are
proved by intervals, which otherwise are unsure; what they decide, and not as doubles did, is counted as `differ`.
slip=polygon is complete driving on polygons of eight sides, exact; `corners`: runs in which polygons got more of them."""

import collections
import sys

import numpy as np

import stiction
import study

READINGS = {"literal": "paper", "redirect": "slip=redirect", "polygon": "slip=polygon"}
MU = ("1/5", "1/2", "1", "2", "5")
COLUMNS = {"definite": lambda n: 3 * n + 1, "one body": lambda n: 6}
NAMES = ("solved", "recurs", "nearer", "proved loop", "left again", "ray", "proved ray", "redirects", "breaks", "unsure",
         "corners", "otherwise", "differ")


def draw(family, contacts, index, seed):
    numbers = np.random.Generator(np.random.PCG64([seed, contacts, list(COLUMNS).index(family), index]))
    columns = COLUMNS[family](contacts)
    J = numbers.integers(-1000, 1000, (3 * contacts, columns), endpoint=True)
    w = numbers.integers(-1000, 1000, columns, endpoint=True)
    return stiction.Problem(J @ J.T, J @ w, MU[index % len(MU)], ["static"] * contacts, dimension=3)


def doubles(problems, policy, count):
    """Runs over doubles, suspicions over quad, and all over intervals."""
    proved = stiction.solve_all(problems, "baraff", "interval", policy)
    run = stiction.solve_all(problems, "baraff", "double", policy)
    for name in ("redirects", "breaks"):
        count[name] += int((run[name] > 0).sum())
    count["steps"].extend(run["steps"][run["outcome"] == "solved"])
    for i, (outcome, certain) in enumerate(zip(run["outcome"], proved["outcome"])):
        certain = "unsure" if certain in ("undecided", "limit") else certain
        first, again = outcome, None
        if outcome != "solved":
            again = stiction.solve(problems[i], "baraff", "double", policy).json
            first = again.get("suspected", again)["outcome"]
        count["unsure"] += certain == "unsure"
        count["proved loop"] += certain == "cycle"
        count["proved ray"] += certain == "ray"
        count["differ"] += certain not in ("unsure", first)
        if first == "cycle":
            same = [again.get(key) == again["suspected"].get(key) for key in ("start", "period")]
            count["left again" if again["outcome"] != "cycle" else "recurs" if all(same) else "nearer"] += 1
        else:
            count[first if first in ("solved", "ray") else "otherwise"] += 1


def polygons(problems, count):
    run = stiction.solve_all(problems, "complete", "exact", law="baraff")
    for outcome in run["outcome"]:
        count[outcome if outcome in ("solved", "ray") else "otherwise"] += 1
    count["corners"] += int((run.get("refinements", np.zeros(1)) > 0).sum())
    count["steps"].extend(run["pieces"][run["outcome"] == "solved"])


def row_of(first, slip, count, problems):
    steps = count.pop("steps")
    loops = count["recurs"] + count["nearer"]
    return (*first, slip, problems, study.share(loops, problems), *(count[name] for name in NAMES),
            f"{study.number(float(np.mean(steps)))} ({max(steps)})" if steps else "-")


def main():
    o = study.options(__doc__, contacts=[1, 2, 3, 4], problems=500, seed=1)
    counts = collections.defaultdict(lambda: collections.Counter(steps=[]))
    for family in COLUMNS:
        for contacts in (n for n in o.contacts if n >= 3 or family == "definite"):
            for kind, mu in enumerate(MU):
                problems = [draw(family, contacts, index, o.seed) for index in range(kind, o.problems, len(MU))]
                for slip, policy in READINGS.items():
                    count = collections.Counter(steps=[])
                    polygons(problems, count) if slip == "polygon" else doubles(problems, policy, count)
                    for key in ((f"{family}, {contacts}", slip), (f"mu = {mu}", slip)):
                        for name, value in {**count, "problems": len(problems)}.items():
                            counts[key][name] += value
    head = ["`slip`", "problems", "loops, 95 %", *NAMES, "steps, mean (most)"]
    differ = sum(count["differ"] for count in counts.values())
    for first, of_mu in (("family, contacts", False), ("friction", True)):
        study.show([first, *head], [row_of([name], slip, count, count["problems"])
                                    for (name, slip), count in counts.items() if name.startswith("mu") == of_mu])
    sys.exit(differ > 0)


study.run(main)
