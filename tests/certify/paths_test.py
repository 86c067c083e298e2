#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two programs that follow solver/published/readings.md take the same steps on the same problem.

  paths_test.py STICTION SOURCES

Random problems of the plane, small integers with many ties, contacts of every kind, and problems of the corpus,
under random policies of the planar grid: `stiction replay` and the published algorithm of the independent checker,
step by step. Of the random problems those are taken on which something is given up, or steps have length zero, and
a few others. Python standard library only.
"""

import importlib
import json
import random
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

DRAWN = 900  # random pairs of a problem and a policy
POLICIES = 20  # of a problem of the corpus
CORPUS = ("two-contact-cycle", "cycle-under-some-policies-a", "three-contact-cycle-with-a-frictionless-one",
          "two-contact-cycle-13-steps", "safe-tie-yet-given-up", "safe-yet-given-up", "safe-tie-cycle-7-contacts",
          "safe-cycle-8-contacts", "sliding/cycle-of-sliding-contacts")
MOST_STEPS = 300
sys.dont_write_bytecode = True


class Independent:
    """The published algorithm of check_runs.py."""

    def __init__(self, sources):
        sys.path.insert(0, str(Path(sources) / "certify"))
        self.algorithm, self.reader = map(importlib.import_module, ("check_runs", "certificate_reader"))

    def run(self, problem, policy):
        """At most MOST_STEPS steps."""
        def end_if_long(steps):
            if len(steps) >= MOST_STEPS:
                raise self.algorithm.Ended("limit")

        rows = self.algorithm.Rows(self.reader.read_problem(problem))
        return self.algorithm.run(rows, policy, end_if_long)


def random_contact(dice):
    kind = dice.choices(("static", "frictionless", "bilateral", "sliding"), (8, 2, 1, 1))[0]
    contact = {"kind": kind}
    if kind in ("static", "sliding"):
        contact["mu"] = dice.choice(("0", "1/3", "1/2", "1", "1", "2", "5"))
    if kind == "sliding":
        contact["slip"] = dice.choice(("1", "-1"))
    return contact


def random_problem(dice):
    """A = J J', b = J c, but for one problem in eight, whose b is any. Some rows are alike, to tie."""
    contacts = [random_contact(dice) for _ in range(dice.randint(1, 4))]
    size = sum(2 if "mu" in contact else 1 for contact in contacts)
    columns = dice.randint(max(1, size - 2), size + 1)
    reach = dice.choice((1, 2, 3, 9))
    J = [[dice.randint(-reach, reach) for _ in range(columns)] for _ in range(size)]
    if size > 1 and dice.random() < 0.3:
        J[dice.randrange(size)] = list(dice.choice(J))
    c = [dice.randint(-3, 3) for _ in range(columns)]
    A = [[sum(x * y for x, y in zip(left, right)) for right in J] for left in J]
    b = [sum(x * y for x, y in zip(row, c)) for row in J]
    if dice.random() < 0.125:
        b = [dice.randint(-3, 1) for _ in b]
    return {"format": "stiction-problem", "version": 1, "dimension": 2, "contacts": contacts,
            "A": [[str(x) for x in row] for row in A], "b": [str(x) for x in b]}


def random_policy(dice, switches):
    chosen = [(name, dice.choice(values)) for name, values in switches.items()]
    return ",".join(f"{name}={value}" for name, value in chosen if value != switches[name][0]) or "paper"


def shown(value):
    """Fractions as texts."""
    if isinstance(value, dict):
        return {key: shown(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [shown(item) for item in value]
    return str(value) if isinstance(value, Fraction) else value


def is_interesting(run):
    """Whether something is given up, or a step has length zero."""
    return any(pivot["step"] == 0 or (pivot["to"] == "none" and pivot["limiting"] != pivot["driven"])
               for pivot in run.pivots)


def difference(replayed, run):
    """What differs, in words, or nothing."""
    if run.outcome != replayed["outcome"]:
        return f"outcome {replayed['outcome']}, expected {run.outcome}"
    steps = shown(run.pivots)
    for k, (found, expected) in enumerate(zip(replayed["pivots"], steps)):
        if found != expected:
            return f"step {k + 1}: {found}, expected {expected}"
    if len(replayed["pivots"]) != len(steps):
        return f"{len(replayed['pivots'])} steps, expected {len(steps)}"
    if run.outcome == "cycle" and (run.start, run.period) != (replayed["start"], replayed["period"]):
        return f"start {replayed['start']}, period {replayed['period']}, expected {run.start}, {run.period}"
    if run.state is not None and shown(run.state["f"]) != replayed["f"]:
        return f"f = {replayed['f']}, expected {shown(run.state['f'])}"
    return None


class Comparison:
    """Counts the outcomes of what it compares."""

    def __init__(self, stiction, folder):
        self.stiction, self.file, self.outcomes = stiction, folder / "problem.json", {}

    def compare(self, problem, policy, run):
        """Ends the program where the two differ."""
        self.file.write_text(json.dumps({**problem, "name": "compared"}))
        command = [self.stiction, "replay", self.file, "--policy", policy, "--json", "--max-pivots", str(MOST_STEPS)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        found = (difference(json.loads(done.stdout), run) if done.stdout.strip()
                 else f"exit {done.returncode}: {done.stderr.strip()[:300]}")
        if found:
            sys.exit(f"FAILED: policy {policy}: {found}\n{json.dumps(problem)}")
        self.outcomes[run.outcome] = self.outcomes.get(run.outcome, 0) + 1


def main(stiction, sources):
    independent, dice = Independent(sources), random.Random(1994)
    with tempfile.TemporaryDirectory() as folder:
        comparison = Comparison(stiction, Path(folder))
        for name in CORPUS:
            file = json.loads((Path(sources) / "corpus" / f"{name}.json").read_text())
            problem = {key: file[key] for key in ("format", "version", "dimension", "contacts", "A", "b")}
            for _ in range(POLICIES):
                policy = random_policy(dice, independent.algorithm.SWITCHES)
                comparison.compare(problem, policy, independent.run(problem, policy))
        for pair in range(DRAWN):
            problem, policy = random_problem(dice), random_policy(dice, independent.algorithm.SWITCHES)
            run = independent.run(problem, policy)
            if pair % 8 == 0 or is_interesting(run):
                comparison.compare(problem, policy, run)
    print(f"{sum(comparison.outcomes.values())} runs take the same steps: {comparison.outcomes}")
    return 0 if comparison.outcomes.get("cycle", 0) > 50 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
