# SPDX-License-Identifier: Apache-2.0
"""The attack on what is called solved: its judge, on forces made by hand, and a short run.

    tests/model/attack_test.py PATH_TO_STICTION [SOURCES] [unittest arguments]
"""

import functools
import random
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))

import attack  # noqa: E402
import cli  # noqa: E402

STATIC = {"kind": "static", "mu": .5}
SLIDING = {"kind": "sliding", "mu": .5, "slip": "1"}
FREE = {"kind": "frictionless"}
EYE = [[float(i == j) for j in range(3)] for i in range(3)]


def worst(contacts, A, b, f, law=None, arithmetic="double", dimension=2, in_angle=False):
    problem = {"dimension": dimension, "contacts": contacts, "A": A, "b": b}
    excused = attack.EXCUSED.get(arithmetic, attack.USUAL)
    return attack.Judge(attack.Numbers(problem), f, *excused, law, in_angle).wrongs()[0]


class TheJudge(unittest.TestCase):
    def assertWrong(self, kind, *problem, **words):
        wrong = worst(*problem, **words)
        self.assertGreater(wrong.badness, 1)
        self.assertEqual(wrong.kind, kind)

    def assertRight(self, *problem, **words):
        wrong = worst(*problem, **words)
        self.assertLessEqual(wrong.badness, 1, wrong)

    def test_a_contact_that_rests_is_right_and_one_that_sinks_or_parts_is_wrong(self):
        self.assertRight([FREE], [[2]], [-1], [.5])
        self.assertRight([FREE], [[2]], [1], [0])
        self.assertWrong("sinks", [FREE], [[2]], [-1], [.49])
        self.assertWrong("sinks", [FREE], [[2]], [-1], [0])
        self.assertWrong("parts", [FREE], [[2]], [-1], [.51])

    def test_excuses_are_as_large_as_they_say(self):
        self.assertRight([FREE], [[1]], [-1], [1 + 3.9e-8])
        self.assertWrong("parts", [FREE], [[1]], [-1], [1 + 4.1e-8])
        self.assertRight([FREE], [[1]], [-1], [1 + 3.9e-5], arithmetic="float")
        self.assertWrong("parts", [FREE], [[1]], [-1], [1 + 8e-5], arithmetic="float")

    def test_a_bound_excuses_an_angle_of_four_eps_and_no_more(self):
        for askew, right in [(1e-9, True), (3.9e-5, True), (4.1e-5, False)]:  # beside a slip of 1000
            slips = [STATIC], [[1, 1000, askew], [1000, 1, 0], [askew, 0, 1]], [499, 0, 0], [1, -.5, 0]
            self.assertWrong("askew", *slips, dimension=3)
            (self.assertRight if right else functools.partial(self.assertWrong, "askew"))(*slips, dimension=3, in_angle=True)

    def test_a_jam_excuses_its_rounding_and_no_more(self):
        jam = [FREE, FREE], [[1, -1], [-1, 1]]
        for pressed, off, right in [(2.0 ** 40, .004, True), (2.0 ** 40, .02, False), (0, .004, False)]:
            judged = worst(*jam, [-1, 1 - off], [pressed + 1, pressed])
            self.assertEqual(judged.badness <= 1, right, (pressed, off))

    def test_bilateral_contacts_pull_and_do_not_move(self):
        self.assertRight([{"kind": "bilateral"}], [[2]], [1], [-.5])
        self.assertWrong("moves", [{"kind": "bilateral"}], [[2]], [1], [-.49])
        self.assertWrong("moves", [{"kind": "bilateral"}], [[2]], [-1], [.49])

    def test_normal_forces_that_pull_are_wrong_where_a_row_notices_them(self):
        self.assertWrong("pulls", [FREE], [[1]], [1], [-1])
        self.assertRight([FREE], [[1]], [1], [-1e-9])

    def test_forces_of_open_contacts_are_wrong_all_together(self):
        beside = [[1, 1], [1, 1]]
        self.assertWrong("ghosts", [FREE, FREE], beside, [1e9, -9], [9, 0])
        self.assertRight([FREE, FREE], beside, [1e9, -9], [0, 9])
        # Ten that are thrown apart hold up one that weighs 1, each so little that it would be excused alone.
        A = [[float(i == j) for j in range(11)] for i in range(11)]
        for j in range(10):
            A[10][j] = 1.0
        for each, right in [(1e-8, False), (1e-9, True)]:
            judged = worst([FREE] * 11, A, [1e9] * 10 + [-1], [each] * 10 + [1 - 10 * each])
            self.assertEqual(judged.badness <= 1, right, each)

    def test_ghosts_that_cancel_are_ghosts(self):
        A = [[1, 0, 0], [0, 1, 0], [1, -1, 1]]
        self.assertWrong("ghosts", [FREE] * 3, A, [1e9, 1e9, -1], [1e-3, 1e-3, 1])

    def test_friction_that_holds_or_slips_at_its_limit_is_right(self):
        self.assertRight([STATIC], [[1, 0], [0, 1]], [-2, .5], [2, -.5])
        self.assertRight([STATIC], [[1, 0], [0, 1]], [-2, 3], [2, -1])
        self.assertRight([{"kind": "static", "mu": 0}], [[1, 0], [0, 1]], [-2, 3], [2, 0])

    def test_a_contact_that_nobody_notices_may_have_any_friction(self):
        A = [[1, 0, 1, 0], [0, 1, 0, 1], [1, 0, 1, 0], [0, 1, 0, 1]]
        for other, right in [(1e-9, True), (1e-5, False)]:
            judged = worst([STATIC, STATIC], A, [-1, 3, -1, 3], [1 - other, -.5 * (1 - other), other, other])
            self.assertEqual(judged.badness <= 1, right, other)

    def test_tangents_are_excused_by_both(self):
        A = [[1, 0, 0], [0, 1, 0], [1.5e-8, 0, 1]]
        self.assertRight([STATIC], A, [-2, 1, 0], [2, -1, 0], dimension=3)
        self.assertWrong("askew", [STATIC], A, [-2, 0, 0], [2, 0, 0], dimension=3)

    def test_friction_beyond_its_limit_is_wrong(self):
        self.assertWrong("beyond", [STATIC], [[1, 0], [0, 1]], [-2, 3], [2, -3])
        self.assertWrong("beyond", [{"kind": "static", "mu": 0}], [[1, 0], [0, 1]], [-2, 3], [2, -1])

    def test_a_slip_with_less_friction_is_wrong(self):
        self.assertWrong("below", [STATIC], [[1, 0], [0, 1]], [-2, 3], [2, 0])
        self.assertWrong("below", [STATIC], [[1, 0], [0, 1]], [-2, 3], [2, -.999])
        self.assertWrong("below", [STATIC], EYE, [-2, 3, 0], [2, -.999, 0], dimension=3)

    def test_friction_that_drives_is_wrong(self):
        self.assertWrong("drives", [STATIC], [[1, 0], [0, 1]], [-2, 3], [2, 1])
        self.assertWrong("drives", [STATIC], EYE, [-2, 3, 0], [2, 1, 0], law="baraff", dimension=3)

    def test_friction_askew_of_the_slip_is_wrong(self):
        self.assertRight([STATIC], EYE, [-2, 3, 4], [2, -.6, -.8], dimension=3)
        self.assertWrong("askew", [STATIC], EYE, [-2, 3, 4], [2, -.8, -.6], dimension=3)
        self.assertRight([STATIC], EYE, [-2, 3, 4], [2, -.8, -.6], law="baraff", dimension=3)
        judge = attack.Judge(attack.Numbers({"dimension": 2, "contacts": [], "A": [], "b": []}), [], *attack.USUAL)
        for f, a, missed in [((2, 2), (-4, -6), 1), ((2, -2), (-4, 6), 1), ((2, 0), (-4, 3), 3), ((2, 2), (4, 6), 6)]:
            self.assertEqual(judge.driving(f, a, (1, 1)), missed)

    def test_sliding_contacts_have_the_friction_of_their_slip(self):
        self.assertRight([SLIDING], [[1, 0], [0, 1]], [-2, 3], [2, -1])
        for friction in (1, -.9, -1.1, 0):
            self.assertWrong("sliding", [SLIDING], [[1, 0], [0, 1]], [-2, 3], [2, friction])
        space = {"kind": "sliding", "mu": .5, "slip": ["3/5", "4/5"]}
        right = [2, Fraction(-3, 5), Fraction(-4, 5)]
        self.assertRight([space], EYE, [-2, 0, 0], right, dimension=3)
        self.assertWrong("sliding", [space], EYE, [-2, 0, 0], [2, -.8, -.6], dimension=3)

    def test_units_of_contacts_change_no_badness(self):
        for factor in (Fraction(2) ** -600, 1, Fraction(2) ** 480):
            wrong = worst([FREE, FREE], [[2, factor], [factor, 2 * factor ** 2]], [-1, -factor],
                          [Fraction(1, 3) + Fraction(1, 10**7), Fraction(1, 3) / Fraction(factor)])
            self.assertAlmostEqual(wrong.badness, 5, 6)

    def test_what_is_made_smaller_is_nearly_the_problem(self):
        problem = {"dimension": 2, "contacts": [FREE, STATIC], "A": [[1.25, 0, 0], [0, 1, .5], [0, .5, 1]],
                   "b": [-1, -2, 0]}
        sizes = {len(p["b"]) for p in attack.simpler(problem)}
        self.assertEqual(sizes, {1, 2, 3})


class Runs(unittest.TestCase):
    def test_a_seed_draws_the_same_problems_again(self):
        drawn = []
        for seed in (5, 5, 6):
            draw = attack.Draw(random.Random(seed), lambda: None)
            problems = [draw() for _ in range(60)]
            problems += [draw.changed(p, [1.0] * len(p["b"])) for p in problems]
            drawn.append([attack.written(p) for p in problems])
        self.assertEqual(drawn[0], drawn[1])
        self.assertNotEqual(drawn[0], drawn[2])

    def test_nothing_is_found_in_few_problems(self):
        with tempfile.TemporaryDirectory() as folder:
            call = [sys.executable, "-B", str(cli.ROOT / "tests/model/attack.py"), cli.program, "--problems", "12"]
            done = subprocess.run([*call, "--seed", "1", "--keep", folder], capture_output=True, text=True, timeout=600)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(list(Path(folder).iterdir()), [])
        self.assertIn("12 problems, seed 1\n", done.stdout)
        self.assertIn("wrong: 0\n", done.stdout)


if __name__ == "__main__":
    cli.main()
