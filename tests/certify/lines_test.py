#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which lines of a run in space are one is read from all points of a box at once, not from the numbers of one point.

  lines_test.py STICTION SOURCES
"""

import json
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

sys.dont_write_bytecode = True
STICTION, SOURCES = sys.argv[1:3]
sys.path.insert(0, str(Path(SOURCES) / "certify"))
import certificate_reader  # noqa: E402
import check_runs  # noqa: E402
import check_runs_in_space as space  # noqa: E402
from claim_cases import problem, verdicts  # noqa: E402

REDIRECT = check_runs.read_policy("slip=redirect", switches=space.SWITCHES)
# A contact turns away with an aF that comes nearer and nearer to zero: a punctured box.
TURNINGS = problem([1, 1], [[7, 1, -1, -2, -5, -2], [1, 8, -1, -2, -3, -4], [-1, -1, 8, 3, -1, 3], [-2, -2, 3, 8, 1, -2],
                            [-5, -3, -1, 1, 11, 2], [-2, -4, 3, -2, 2, 7]], [-1, 2, 3, -3, -3, -1], 3)


def punctured():
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "problem.json")
        file.write_text(json.dumps({**TURNINGS, "name": "turnings"}))
        made = subprocess.run([STICTION, "certify", file, "--claim", "cycle", "--policy", "slip=redirect", "-o", "-"],
                              check=True, capture_output=True).stdout
    return json.loads(made)


def run_of(described):
    return space.Run(space.Space(certificate_reader.read_problem(described)), REDIRECT)


class Lines(unittest.TestCase):
    def line(self, resting):
        """The name of a line along which the first contact is driven while a force of the second rests."""
        run = run_of(TURNINGS)
        run.f[3] = resting
        return run.name_of_line("N", 0, None, None)

    def test_a_force_that_is_zero_at_one_point_of_a_box_does_not_rest_at_zero(self):
        at_zero, at_point = self.line(space.ZERO), self.line(space.Number.around(Fraction(0)))
        in_box = self.line(space.Number.side(0, 1, Fraction(0), Fraction(1, 1000)))
        self.assertEqual((at_zero[1], at_point[1]), (0, 0))
        self.assertNotEqual(in_box[1], 0)

    def test_a_direction_that_is_along_an_axis_at_one_point_of_a_box_has_a_name_of_its_own(self):
        one, zero = space.one(), space.Number.around(Fraction(0))
        self.assertEqual(space.axis_along([one, zero])[2], "x")
        aside = space.Number.side(0, 1, Fraction(0), Fraction(1, 1000))
        self.assertNotEqual(space.axis_along([one, aside])[2], "x")


class Punctured(unittest.TestCase):
    def setUp(self):
        self.certificate, self.asked = punctured(), []
        self.assertEqual(self.certificate["witness"]["kind"], "punctured")
        before = space.turnings_that_end

        def noted(run, witness, values, charts):
            self.asked.append(values)
            return before(run, witness, values, charts)

        space.turnings_that_end = noted
        self.addCleanup(setattr, space, "turnings_that_end", before)

    def check(self, certificate):
        return certificate_reader.check(certificate, check_runs.CLAIMS)

    def test_the_box_as_a_whole_is_asked_and_no_point_of_it(self):
        self.assertIn("punctured", self.check(self.certificate))
        radii = [Fraction(radius) for radius in self.certificate["witness"]["radii"]]
        self.assertEqual(len(self.asked), 1)
        for number, radius in zip(self.asked[0], radii):
            self.assertIsNotNone(number.slopes)
            self.assertGreaterEqual(Fraction(number.high - number.low, 1 << space.Number.bits), 2 * radius)

    def test_periods_that_name_at_different_places_are_refused(self):
        before, calls = space.take_period, []

        def shifted(*arguments):
            named = before(*arguments)
            calls.append(named)
            return named if len(calls) < 5 else [n + (k == 1) for k, n in enumerate(named)]

        space.take_period = shifted
        self.addCleanup(setattr, space, "take_period", before)
        with self.assertRaisesRegex(certificate_reader.Rejected, "two periods name the same"):
            self.check(self.certificate)

    def test_every_checker_accepts_it(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "certificate.json")
            file.write_text(json.dumps(self.certificate))
            for command in ([STICTION, "check"], [sys.executable, Path(SOURCES) / "certify/check_certificate.py"]):
                self.assertEqual(verdicts(command, [file]), [True], command)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
