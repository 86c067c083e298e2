# SPDX-License-Identifier: Apache-2.0
"""objects_test.py PROGRAM SOURCES: every public object is shown in few lines, compared, copied and pickled."""
import copy
import pickle
import re
import sys
import tempfile
import unittest
from pathlib import Path

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
