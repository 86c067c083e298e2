#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""False claims of loops and rays in space: each meets all conditions of certify/certificates.md but one, and every
checker must refuse it (claim_cases.py).

  false_loops_in_space_test.py STICTION SOURCES

Words are those that the run has, up to other drives than a true certificate states.
"""

import copy
import json
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
from claim_cases import FALSE, TRUE, main, problem

# Drawn; what certify says of them. The memory that the period touches comes to its place at once, and then recurs.
RECURS = problem([3] * 3, [row.split() for row in (
    "14 8 1 9 -2 -6 3 1 -3", "8 28 9 2 5 0 -1 -10 -12", "1 9 18 -7 8 5 0 -9 -7", "9 2 -7 15 -3 -1 -1 2 -5",
    "-2 5 8 -3 31 12 -5 -1 -11", "-6 0 5 -1 12 24 -7 1 -8", "3 -1 0 -1 -5 -7 9 -2 6", "1 -10 -9 2 -1 1 -2 15 3",
    "-3 -12 -7 -5 -11 -8 6 3 16")], "-5 8 -2 -4 3 -4 -4 -3 -2".split(), 3)
# The period leaves all memory untouched.
UNTOUCHED = problem([2] * 3, [row.split() for row in (
    "23 -3 5 -3 -12 3 -4 -4 -12", "-3 18 -2 10 -8 3 1 6 -11", "5 -2 31 -2 -8 -6 -2 2 1", "-3 10 -2 23 -6 5 -10 -1 -5",
    "-12 -8 -8 -6 32 -4 -6 6 14", "3 3 -6 5 -4 18 6 -6 -7", "-4 1 -2 -10 -6 6 17 -2 0", "-4 6 2 -1 6 -6 -2 13 4",
    "-12 -11 1 -5 14 -7 0 4 20")], "-2 -8 -1 -7 10 -10 -5 9 14".split(), 3)
# Three coordinates; what the period makes of the first depends on the others, which it leaves untouched.
COUPLED = problem([3] * 3, [row.split() for row in (
    "15 -3 4 7 1 9 0 1 0", "-3 16 -3 0 4 1 5 0 3", "4 -3 26 -3 4 -2 3 10 2", "7 0 -3 24 -4 -3 -14 -1 -11",
    "1 4 4 -4 15 5 7 2 6", "9 1 -2 -3 5 14 6 -2 2", "0 5 3 -14 7 6 18 -1 15", "1 0 10 -1 2 -2 -1 20 -10",
    "0 3 2 -11 6 2 15 -10 22")], "-9 -1 -14 -11 -5 -1 2 -1 -2".split(), 3)
# Decided by lines along which f has moved before, in the same directions.
TURNED = problem([2] * 3, [row.split() for row in (
    "23 6 -2 -13 2 1 7 -1 18", "6 17 10 -15 13 -10 7 2 11", "-2 10 21 -9 8 3 4 5 -2", "-13 -15 -9 26 -14 8 -2 6 -21",
    "2 13 8 -14 19 -11 4 -1 7", "1 -10 3 8 -11 28 -7 3 -6", "7 7 4 -2 4 -7 23 4 1", "-1 2 5 6 -1 3 4 18 -6",
    "18 11 -2 -21 7 -6 1 -6 26")], "-4 8 4 -9 8 -2 -11 4 7".split(), 3)
PUSHED = problem([1], [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [-1, 0, 0], 3)


class Maker:
    def __init__(self, stiction, sources, folder):
        self.stiction, self.sources, self.file = stiction, Path(sources), Path(folder, "problem.json")
        sys.path.insert(0, str(self.sources / "certify"))

    def true(self, of, policy="paper", claim="cycle"):
        """A certificate, which is a true one; `of`: a problem, or its place in the corpus."""
        self.file.write_text((self.sources / f"corpus/space/{of}.json").read_text() if type(of) is str
                             else json.dumps({**of, "name": "drawn"}))
        made = subprocess.run([self.stiction, "certify", self.file, "--claim", claim, "--policy", policy, "-o", "-"],
                              check=True, capture_output=True).stdout
        certificate = json.loads(made)
        TRUE.append((f"{claim}: no. {len(TRUE)}", certificate))
        return certificate

    def word(self, certificate, drives):
        """The steps of its run, to the first state after so many drives."""
        from certificate_reader import read_problem
        from check_runs import read_policy
        from check_runs_in_space import SWITCHES, Number, Run, Space
        witness, steps = certificate["witness"], []
        Number.bits = witness["bits"]
        Run(Space(read_problem(certificate["problem"])), read_policy(witness["policy"], switches=SWITCHES),
            steps.append).run_until(drives)
        return steps


def false(what, certificate, claim="cycle", **changes):
    other = copy.deepcopy(certificate)
    other["claim"] = claim
    other["witness"].update(changes)
    FALSE.append((f"{claim}: {what}", other))


def loops(maker):
    states, remembering = maker.true("cycle-under-both-slips"), maker.true("cycle-of-a-scene-4-contacts")
    start, period = (remembering["witness"][key] for key in ("start", "period"))
    false("other sets", states, start=1, word=maker.word(states, 1 + states["witness"]["period"]))
    false("states, of which the first remembers something", remembering, start=start - 1,
          word=maker.word(remembering, start - 1 + period))
    false("the same sets, and something remembered", remembering, period=period - 1,
          word=maker.word(remembering, start + period - 1))

    box = maker.true("no-state-twice")
    false("a box to which the run has not come", box, radii=[str(Fraction(box["witness"]["radii"][0]) / 2**10)])
    false("a box out of which its steepest slope alone leads", box, start=10, word=maker.word(box, 16),
          centre=["-932701/1048576"], radii=["999/268435456"])
    coupled = maker.true(COUPLED, "slip=redirect")
    first, *others = coupled["witness"]["radii"]
    false("a box out of which another coordinate leads", coupled, radii=[str(Fraction(first) / 16), *others])

    maker.true(TURNED)

    going_on = maker.true("cycle-under-both-slips", "rezero=continue")
    start, period = (going_on["witness"][key] for key in ("start", "period"))
    false("the start in the middle of two drives without a scan", going_on, start=start - 1)
    false("the end in the middle of two drives without a scan", going_on, period=period - 1)


def no_state_twice(maker):
    maker.true("no-state-twice", claim="endless")
    recurs = maker.true(RECURS, "slip=redirect")
    false("all points of the box come to one, which then recurs", recurs, claim="endless")
    false("punctured, all points of the box come to one", recurs, kind="punctured")
    false("nothing is touched, so the first state recurs", maker.true(UNTOUCHED), claim="endless")


def rays(maker):
    ray = maker.true("ray-under-slip-literal", claim="ray")
    false("a run that ends at a solution", {**ray, "problem": PUSHED}, claim="ray", word=["N1 N1 C"])


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        makers = Maker(*sys.argv[1:3], made)
        for cases in (loops, no_state_twice, rays):
            cases(makers)
    sys.exit(main(*sys.argv[1:]))
