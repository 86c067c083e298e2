# SPDX-License-Identifier: Apache-2.0
"""objects_test.py PROGRAM SOURCES: every public object is shown in few lines, compared, copied and pickled."""
import copy
import json
import pickle
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import stiction

SOURCES = Path(sys.argv[2])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"


def made():
    """One of each public class but those of a store."""
    problem = stiction.load(LOOP)
    run = stiction.replay(problem)
    return [problem, stiction.solve(problem), run, run.pivots[0], stiction.certify(problem),
            stiction.solve(problem, arithmetic="interval", method="complete"),
            stiction.load(SOURCES / "corpus/space/three-sliding-contacts.json"),
            stiction.load(SOURCES / "corpus/sliding/hinged-slider.json")]


class Objects(unittest.TestCase):
    def assertWhole(self, one):
        self.assertLessEqual(len(repr(one).splitlines()), 5)
        self.assertLess(len(repr(one)), 300)
        self.assertNotIn(" object at 0x", repr(one))
        for other in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one), copy.copy(one)):
            self.assertIs(type(other), type(one))
            self.assertEqual(repr(other), repr(one))

    def test_they_are_shown_copied_and_pickled(self):
        for one in made():
            with self.subTest(one=one):
                if hasattr(one, "f"):
                    one.f  # is kept, and made again
                self.assertWhole(one)
                self.assertEqual(pickle.loads(pickle.dumps(one)), one)
                self.assertEqual(copy.deepcopy(one), one)
                if hasattr(one, "f"):
                    self.assertFalse(copy.deepcopy(one).f.flags.writeable)

    def test_the_same_calls_give_equal_objects(self):
        for left, right in zip(made(), made()):
            if not isinstance(left, stiction.Answer):  # statistics may hold times
                self.assertEqual(left, right)

    def test_friction_without_a_bound_is_read_as_of_a_file(self):
        for name in ("plane", "space"):
            dimension = 2 if name == "plane" else 3
            A = [[2 if i == j else 1 for j in range(2 * dimension)] for i in range(2 * dimension)]
            b = [-1] * (2 * dimension)
            with self.subTest(name=name), tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "p.json"
                file.write_text(json.dumps({"A": A, "b": b, "mu": ["inf", "1/2"], "dimension": dimension}))
                expected = stiction.load(file)
                self.assertEqual(expected.kinds, ["frictionless", *["bilateral"] * (dimension - 1), "static"])
                for infinite in (float("inf"), "inf", np.float32("inf")):
                    mine = stiction.Problem(A, b, [infinite, "1/2"], dimension=dimension)
                    self.assertEqual(mine, expected)
                self.assertEqual(stiction.solve(mine).outcome, "solved")
        with self.assertRaisesRegex(ValueError, r"mu\[0\]: found -inf"):
            stiction.Problem([[1, 0], [0, 1]], [-1, 0], float("-inf"))
        with self.assertRaisesRegex(ValueError, r"mu\[0\]: found inf"):
            stiction.Problem([[1]], [-1], float("inf"), kinds=["frictionless"])

    def test_problems_are_equal_by_their_numbers(self):
        eye = [[1, 0], [0, 1]]
        one = stiction.Problem(eye, [-1, 0], 1)
        self.assertEqual(one, stiction.Problem(eye, ["-1", 0.0], "1", name="other"))
        self.assertEqual(len({one, stiction.Problem(eye, [-1, 0], 1)}), 1)
        self.assertNotEqual(one, stiction.Problem(eye, [-1, 0], 2))
        self.assertNotEqual(one, "one")
        self.assertEqual(pickle.loads(pickle.dumps(one)).name, one.name)

    def test_what_a_store_holds_too(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a.store"
            findings = list(stiction.search(generator="bodies", contacts=2, mu=1, problems=20000, store=file))
            self.assertTrue(findings)
            for one in [stiction.Store(file), *findings[:3]]:
                self.assertWhole(one)
            self.assertEqual(pickle.loads(pickle.dumps(findings[0])), findings[0])
            self.assertEqual(stiction.load(f"{file}:{findings[0].signature}"),
                             findings[0].minimized or findings[0].problem)

    def test_every_public_class_has_a_repr_of_its_own(self):
        for name in stiction.__all__:
            if isinstance(getattr(stiction, name), type):
                self.assertIn("__repr__", vars(getattr(stiction, name)), name)

    def test_the_version_is_that_of_the_build(self):
        stated = re.search(r"project\(stiction VERSION ([\d.]+)", (SOURCES / "CMakeLists.txt").read_text())
        self.assertEqual(stiction.__version__, stated.group(1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
