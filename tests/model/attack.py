#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Attacks what `stiction solve` calls solved: draws problems, solves them by every method, judges the forces exactly.

    tests/model/attack.py build/release/stiction [--seconds 600] [--seed 1] [--keep FOLDER]

Wrong is what a user calls so, of the forces f that were printed, with a = A f + b over fractions:

    sinks     a contact is pushed into the other body
    moves     a bilateral contact moves
    parts     a contact moves apart, though it is pressed
    pulls     a normal force pulls
    ghosts    contacts that carry nothing (open, or not pressed) have forces all the same, all of them together
    beyond    friction exceeds mu times the normal force
    below     a contact slips with less friction than that
    drives    friction has power against the slip's resistance: f_T.a_T > 0
    askew     friction is not opposite to the acceleration of the slip
    sliding   friction of a sliding contact is not -mu slip f_N

Excuses, fixed before any run. Numbers b and mu may be off by eps, and A by tau, entry by entry; all that four times:

    X_i = 4 (eps abs(b_i) + tau S_i),   S_i = sum of abs(A_ij f_j) over the contacts that carry something

with abs(b_i) of the tangents of a contact together, eps = 1e-8 and tau = 8 2^-53, over float 1e-5 and 8 2^-24. So
forces that jam excuse tau times what they do to a row, and forces that should be nothing excuse nothing.
  - Row i may move by X_i where it should rest. All forces that should be nothing may do X_i to row i together.
  - Friction may miss mu f_N by 4 eps mu f_N. Where mu f_N is zero, it is zero.
  - A slip is opposite to friction if abs(a_i + t f_i) <= X_i for both tangents i and some t >= 0. By the law of the
    paper (answers say so) f_T.a_T <= sum of abs(f_i) X_i.
  - Exact answers in space tell a `bound`: friction is opposite to the slip up to an angle. It may be 4 eps: so much of
    abs(a_T) is excused for the directions of tangents.
  - Whether a contact carries something is chosen in favour of the answer; one with f_N <= 0 does not.
Badness is what is missed in units of its excuse: above 1 is wrong. By the definition in solver/problem/errors.h it is
at most 1/4, but for forces that are rounded to be printed.

`untold` is how much badness exceeds what the answer says of itself (`residual`); of exact answers all of it. Problems
of large badness, or of much untold, are changed again and again. One that is wrong is made smaller, and written with
its command.

Exit: 0 nothing is wrong, 1 something is, or the program crashed.
"""

import argparse
import collections
import functools
import json
import random
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

from drawn_problems import Draw, simpler, written
from judged_forces import EXCUSED, SLACK, USUAL, Judge, Numbers

METHODS = ["auto", "fast", "complete", "lemke", "proximal", "gauss-seidel", "newton-bodies", "baraff"]
ARITHMETICS = ["double", "float"]
SELDOM = ["quad", "exact"]  # of few problems
GENERATORS = ["integers", "psd", "small", "near-degenerate", "duplicates", "conditioned", "bodies", "exponential",
              "scenes", "one-body", "bilateral", "sliding", "space", "exceptional", "steps"]
BATCH = 100


# ---- The program -------------------------------------------------------------------------------------------------

class Program:
    def __init__(self, path, folder, seed):
        self.path, self.folder, self.seed = path, folder, seed
        self.crashes = []
        self.R = random.Random(f"generators {seed}")

    def generated(self):
        """A problem of the program's own generators."""
        R = self.R
        name, contacts = R.choice(GENERATORS), R.randint(1, 4)
        store = self.folder / f"{name}-{contacts}.stiction"
        if not store.exists():
            subprocess.run([self.path, "search", "--store", store, "--generator", name, "--contacts", str(contacts),
                            "--problems", "100", "--finishing", "0", "--threads", "1",
                            "--seed", str(self.seed % 2**32)], stdin=subprocess.DEVNULL, capture_output=True)
        number = R.randint(1, 127)  # units have 1, 2, 4, ... problems
        unit = number.bit_length() - 1
        done = subprocess.run([self.path, "problem", store, str(unit), str(number - 2**unit)], capture_output=True,
                              text=True)
        if done.returncode:
            return None
        content = json.loads(done.stdout)
        if "A" not in content:
            return None
        contacts = [{key: Fraction(x) if key == "mu" else x for key, x in c.items()} for c in content["contacts"]]
        return {"dimension": content["dimension"], "contacts": contacts,
                "A": [[Fraction(x) for x in row] for row in content["A"]], "b": [Fraction(x) for x in content["b"]]}

    def command(self, files, method, arithmetic):
        return [str(self.path), "solve", "--json", "--seconds", "2", "--method", method, "--arithmetic", arithmetic,
                *map(str, files)]

    def solve(self, problems, method, arithmetic):
        """Answers; None of those that the program has none for."""
        files = [self.folder / f"{k:03d}.json" for k in range(len(problems))]
        for file, problem in zip(files, problems):
            file.write_text(written(problem))
        try:
            done = subprocess.run(self.command(files, method, arithmetic), stdin=subprocess.DEVNULL, text=True,
                                  capture_output=True, timeout=60 + 3 * len(files))
        except subprocess.TimeoutExpired:
            return self.crashed(problems, method, arithmetic, "no end")
        if done.returncode not in (0, 1, 2, 3):
            return self.crashed(problems, method, arithmetic, f"exit {done.returncode}: {done.stderr.strip()[:200]}")
        if not done.stdout.strip():
            return [None] * len(problems)
        read = json.loads(done.stdout, parse_float=Fraction)
        return [read] if isinstance(read, dict) else [x.get("answer") for x in read]

    def crashed(self, problems, method, arithmetic, how):
        """Finds the problem that it is about, by halves."""
        if len(problems) == 1:
            self.crashes.append((problems[0], method, arithmetic, how))
            return [None]
        middle = len(problems) // 2
        return [x for half in (problems[:middle], problems[middle:]) for x in self.solve(half, method, arithmetic)]


class Case:
    """A problem, with what it is judged by."""

    def __init__(self, problem):
        self.problem, self.forces = problem, []

    @functools.cached_property
    def numbers(self):
        return Numbers(self.problem)

    def wrongs(self, answer):
        """Of an answer that is called solved; None of others."""
        if not answer or answer.get("outcome") != "solved" or answer.get("law") not in (None, "coulomb", "baraff"):
            return None
        excused = EXCUSED.get(answer["arithmetic"], USUAL)
        return Judge(self.numbers, answer["f"], *excused, answer.get("law"), "bound" in answer).wrongs()

    def told(self, answer):
        """The badness that the answer says itself; 0 of exact ones."""
        eps, _ = EXCUSED.get(answer["arithmetic"], USUAL)
        return float(Fraction(answer.get("residual", 0)) / (SLACK * eps))


class Attack:
    def __init__(self, program, seed, keep):
        self.program, self.keep, self.seed = program, keep, seed
        self.R = random.Random(f"attack {seed}")
        self.draw = Draw(self.R, program.generated)
        self.problems = 0
        self.counts = collections.Counter()  # by method, arithmetic and outcome
        self.worst = collections.defaultdict(float)  # by method, arithmetic and kind
        self.elites = collections.defaultdict(list)  # by the same: badness, case
        self.finds = []

    def run(self, seconds, most):
        until = time.monotonic() + seconds
        rounds = 0
        while time.monotonic() < until and (most is None or self.problems < most):
            count = BATCH if most is None else min(BATCH, most - self.problems)
            cases = [Case(self.next()) for _ in range(count)]
            self.problems += count
            self.batch(cases, rounds, until)
            rounds += 1

    def next(self):
        keys = sorted(key for key, elites in self.elites.items() if elites)
        if not keys or self.R.random() < .5:
            return self.draw()
        _, case = self.R.choice(self.elites[self.R.choice(keys)])
        return self.draw.changed(case.problem, case.forces)

    def batch(self, cases, rounds, until):
        for dimension in (2, 3):
            some = [c for c in cases if c.problem["dimension"] == dimension]
            runs = [(m, a, some) for m in METHODS for a in ARITHMETICS]
            by_turns = METHODS[1 + rounds % (len(METHODS) - 1)]
            runs += [(m, SELDOM[rounds % len(SELDOM)], some[:12]) for m in ("auto", by_turns)]
            for method, arithmetic, which in runs:
                if which and time.monotonic() < until:
                    self.take(method, arithmetic, which)

    def take(self, method, arithmetic, cases):
        for case, answer in zip(cases, self.program.solve([c.problem for c in cases], method, arithmetic)):
            if answer is None:
                continue
            self.counts[method, arithmetic, answer["outcome"]] += 1
            wrongs = case.wrongs(answer)
            if wrongs is not None:
                self.note(method, arithmetic, case, answer, wrongs)

    def note(self, method, arithmetic, case, answer, wrongs):
        for wrong in wrongs:
            key = (method, arithmetic, wrong.kind)
            self.worst[key] = max(self.worst[key], wrong.badness)
        worst, untold = wrongs[0], wrongs[0].badness - case.told(answer)
        key = (method, arithmetic, "untold")
        self.worst[key] = max(self.worst[key], untold)
        if worst.badness <= 1:
            case.forces = [float(Fraction(x)) for x in answer["f"]]
            self.climb((method, arithmetic, worst.kind), worst.badness, case)
            self.climb(key, untold, case)
        elif sum(f[:2] == (method, arithmetic) for f in self.finds) < 5:  # to shrink them takes long
            self.find(method, arithmetic, case, worst)

    def climb(self, key, height, case):
        """Keeps the highest few. The first of equals stays."""
        elites = self.elites[key]
        if height > 0 and (len(elites) < 4 or height > elites[-1][0]):
            elites.append((height, case))
            elites.sort(key=lambda e: -e[0])
            del elites[4:]

    def badness(self, problem, method, arithmetic):
        """Of what is called solved; the answer, and what is worst of it."""
        answer = self.program.solve([problem], method, arithmetic)[0]
        wrongs = Case(problem).wrongs(answer)
        return (wrongs[0].badness, answer, wrongs[0]) if wrongs else (0, answer, None)

    def find(self, method, arithmetic, case, worst):
        problem = self.shrunk(case.problem, method, arithmetic)
        file = self.file(problem, f"wrong-{len(self.finds)}")
        _, answer, wrong = self.badness(problem, method, arithmetic)
        wrong = wrong or worst  # one that ends by time may end otherwise
        self.finds.append((method, arithmetic, wrong, file))
        print(f"WRONG: {wrong.kind}, contact {wrong.contact}, badness {wrong.badness:.3g}: "
              + " ".join(self.program.command([file], method, arithmetic)), flush=True)
        if answer and answer.get("f"):
            print("       f =", [x if isinstance(x, str) else float(x) for x in answer["f"]], flush=True)

    def file(self, problem, name):
        self.keep.mkdir(parents=True, exist_ok=True)
        file = self.keep / f"{name}-{self.seed}.json"
        file.write_text(written(problem))
        return file

    def shrunk(self, problem, method, arithmetic):
        """A problem that is wrong too, with fewer contacts, more zeros and shorter numbers."""
        left, again = 300, True
        while again and left > 0:
            again = False
            for other in simpler(problem):
                left -= 1
                if left > 0 and self.badness(other, method, arithmetic)[0] > 1:
                    problem, again = other, True
                    break
        return problem

    def table(self):
        kinds = sorted({key[2] for key in self.worst})
        print(f"{self.problems} problems, seed {self.seed}")
        print(f"{'method':14}{'arithmetic':12}{'solved':>8}{'others':>8}" + "".join(f"{kind:>9}" for kind in kinds))
        for method, arithmetic in sorted({key[:2] for key in self.counts}):
            of = {outcome: n for (m, a, outcome), n in self.counts.items() if (m, a) == (method, arithmetic)}
            solved = of.pop("solved", 0)
            print(f"{method:14}{arithmetic:12}{solved:8}{sum(of.values()):8}"
                  + "".join(f"{self.worst.get((method, arithmetic, kind), 0):9.2g}" for kind in kinds))
        for problem, method, arithmetic, how in self.program.crashes:
            file = self.file(problem, f"crash-{len(self.finds)}")
            self.finds.append((method, arithmetic, how, file))
            print(f"CRASH: {how}: " + " ".join(self.program.command([file], method, arithmetic)))
        print(f"wrong: {len(self.finds)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=lambda path: Path(path).resolve())
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("attack"), metavar="FOLDER")
    parser.add_argument("--problems", type=int, help=argparse.SUPPRESS)
    words = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="stiction-attack-") as folder:
        attack = Attack(Program(words.program, Path(folder), words.seed), words.seed, words.keep)
        attack.run(words.seconds, words.problems)
        attack.table()
    return 1 if attack.finds else 0


if __name__ == "__main__":
    sys.exit(main())
