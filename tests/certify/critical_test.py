#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Critical loads (corpus/space/critical): what certify/existence.md says of them, over fractions.

At the critical friction forces that hold are in the closure of what friction can do, not in it; with a little more
friction only large ones hold. In either case there is a solution whose forces are small (theorem 2), and the corpus has
its certificate.

    critical_test.py PROGRAM ROOT
"""

import json
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

PROGRAM, ROOT = sys.argv[1:3]
FOLDER = Path(ROOT, "corpus/space/critical")
# What squeezes without moving anything: A v = 0, at the edge of the cones at the critical friction.
SQUEEZE = {"convexified-law": [1, 1, 0], "groove": [1, "3/4", 0, 1, "3/4", 0], "pinch": [1, "1/3", 0, 1, "-1/3", 0]}
# Problems at the critical load, and the same with a little more friction.
CRITICAL = {"convexified-law-without-solution": "convexified-law-far-solution",
            "groove-at-the-critical-load": "groove-near-the-critical-load",
            "pinch-at-the-critical-load": "pinch-near-the-critical-load"}


def numbers(texts):
    return [Fraction(text) for text in texts]


def dot(x, y):
    return sum(a * b for a, b in zip(x, y, strict=True))


def square(x):
    return dot(x, x)


def load(name):
    problem = json.loads((FOLDER / f"{name}.json").read_text())
    return problem, [numbers(row) for row in problem["A"]], numbers(problem["b"]), Fraction(problem["contacts"][0]["mu"])


def squeeze_of(name):
    return numbers(next(v for prefix, v in SQUEEZE.items() if name.startswith(prefix)))


def contacts(x):
    return [x[k:k + 3] for k in range(0, len(x), 3)]


def held(A, b):
    """Some forces with A f = -b and the number of their degrees of freedom, by elimination."""
    rows, n, r, pivots = [[*row, -c] for row, c in zip(A, b)], len(b), 0, []
    for column in range(n):
        p = next((i for i in range(r, n) if rows[i][column]), None)
        if p is None:
            continue
        rows[r], rows[p] = rows[p], rows[r]
        rows[r] = [x / rows[r][column] for x in rows[r]]
        rows = [row if i == r else [x - row[column] * y for x, y in zip(row, rows[r])] for i, row in enumerate(rows)]
        pivots.append(column)
        r += 1
    assert all(row[n] == 0 for row in rows[r:]), "b is not in range(A)"
    f = [Fraction(0)] * n
    for i, column in enumerate(pivots):
        f[column] = rows[i][n]
    return f, n - r


class Critical(unittest.TestCase):
    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_all_files_are_named_here(self):
        self.assertEqual({file.stem for file in FOLDER.glob("*.json")}, {*CRITICAL, *CRITICAL.values()})

    def test_the_squeeze_is_at_the_edge_and_moves_nothing(self):
        for critical, near in CRITICAL.items():
            v = squeeze_of(critical)
            for name in (critical, near):
                _, A, b, mu = load(name)
                self.assertTrue(all(dot(row, v) == 0 for row in A), name)
                self.assertEqual(dot(b, v), 0, name)
                for vN, *vF in contacts(v):
                    slack = mu * mu * vN * vN - square(vF)
                    self.assertEqual(slack, 0, name) if name == critical else self.assertGreater(slack, 0, name)

    def test_at_the_critical_load_no_forces_hold(self):
        # All that hold are f + c v. A contact whose f is at the edge but for a part across it is outside for every c.
        for name in CRITICAL:
            _, A, b, mu = load(name)
            f, freedom = held(A, b)
            self.assertEqual(freedom, 1, name)
            outside = []
            for (fN, *fF), (vN, *vF) in zip(contacts(f), contacts(squeeze_of(name))):
                edge = [x / (mu * vN) for x in vF]  # of length one
                within, across = mu * fN - dot(edge, fF), edge[0] * fF[1] - edge[1] * fF[0]
                self.assertGreaterEqual(within, 0, name)  # so nearly all of it can be held
                outside.append(within == 0 != across)
            self.assertTrue(any(outside), name)

    def test_a_little_more_friction_holds_with_large_forces(self):
        for name in CRITICAL.values():
            _, A, b, mu = load(name)
            answer = json.loads(self.run_program("solve", FOLDER / f"{name}.json", "--json"))
            self.assertEqual((answer["outcome"], answer["bound"]), ("solved", "1"))
            f = numbers(answer["f"])
            self.assertEqual([dot(row, f) for row in A], [-x for x in b], name)
            self.assertTrue(all(square(fF) <= (mu * fN) ** 2 and fN >= 0 for fN, *fF in contacts(f)), name)
            self.assertGreater(square(f), 100 ** 2 * square(b), name)

    def test_the_certificate_of_each_has_small_forces(self):
        for name in (*CRITICAL, *CRITICAL.values()):
            certificate = FOLDER / "certificates" / f"{name}.coulomb-solution.json"
            said = self.run_program("check", certificate, "--problem", FOLDER / f"{name}.json")
            self.assertIn("accepted: coulomb-solution", said)
            self.assertEqual(subprocess.run([sys.executable, Path(ROOT, "certify/check_certificate.py"), certificate],
                                            capture_output=True).returncode, 0)
            witness, b = json.loads(certificate.read_text())["witness"], load(name)[2]
            self.assertGreater(Fraction(witness["bound"]), 1 - Fraction(1, 2 ** 38))
            self.assertLess(square(numbers(witness["f"])), 9 * square(b), name)

    def test_existence_is_certified_of_each(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in (*CRITICAL, *CRITICAL.values()):
                out = Path(folder, "exists.json")
                self.assertIn("exists", self.run_program("certify", FOLDER / f"{name}.json", "--claim", "exists", "-o", out))
                self.run_program("check", out)

    def test_the_convexified_law_has_no_solution_where_coulombs_has_one(self):
        # f in K, a in K*, f.a = 0. existence.md has the argument; here are its numbers.
        _, A, b, mu = load("convexified-law-without-solution")
        v, normal = [1, 1, 0], [1, -1, 0]
        self.assertEqual((mu, dot(b, v)), (1, 0))
        # a.v = 0 with aN >= abs(aF) leaves a = g (1, -1, 0): aN = -aX and aN^2 >= aX^2 + aY^2.
        # g = 0: sticking, fN - fX = 0 and fY = 2 for all f with A f = -b, so fN^2 < fX^2 + fY^2.
        f, _ = held(A, b)
        self.assertEqual((dot(normal, f), f[2], dot(normal, v), v[2]), (0, 2, 0, 0))
        # g > 0: f.a = g (fN - fX) = 0 and fN >= abs(fF) make f = c v, so a = b, which is no multiple of (1, -1, 0).
        self.assertNotEqual(b[2], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
