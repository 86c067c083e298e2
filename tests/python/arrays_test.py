# SPDX-License-Identifier: Apache-2.0
"""arrays_test.py PROGRAM SOURCES: the Python package takes arrays of numpy, and gives them, beside what is exact."""
import sys
import unittest
from fractions import Fraction
from pathlib import Path
from unittest import mock

import numpy as np
import stiction

SOURCES = Path(sys.argv[2])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"
A = [[3, -4, 2, 0], [-4, 7, -4, 1], [2, -4, 7, -6], [0, 1, -6, 7]]
B = [-1, 0, 0, -2]


class Taken(unittest.TestCase):
    def test_arrays_of_any_numbers_are_exact(self):
        same = stiction.load(LOOP).digest
        for kind in (np.int8, np.int64, np.float16, np.float32, ">f8", np.longdouble, object):
            self.assertEqual(stiction.Problem(np.array(A, kind), np.array(B, kind), 1).digest, same, kind)
        large = np.array([[2 ** 60 + 1, 0], [0, 1]])
        self.assertEqual(stiction.Problem(large, [0, 0], 1).exact_A[0][0], 2 ** 60 + 1)
        beyond = np.array([[2 ** 53 + 1, 0], [0, 1]], np.uint64)  # which compares as doubles
        self.assertEqual(stiction.Problem(beyond, [0, 0], 1).exact_A[0][0], 2 ** 53 + 1)
        third = np.longdouble(1) / 3
        self.assertNotEqual(third, np.float64(third))
        self.assertEqual(stiction.Problem(np.eye(2), np.array([third, 0]), 1).exact_b[0],
                         Fraction(*third.as_integer_ratio()))
        self.assertEqual(stiction.Problem(np.eye(2), np.array([np.float32(0.1), 0]), np.float32(0.1)).mu,
                         [Fraction(float(np.float32(0.1)))])

    def test_one_may_be_an_array_and_the_other_not(self):
        mixed = stiction.Problem(np.array(A, float), [Fraction(-1, 3), 0, 0, "-2/7"], 1)
        self.assertEqual((mixed.exact_b, mixed.exact_A), ([Fraction(-1, 3), 0, 0, Fraction(-2, 7)], A))
        mixed = stiction.Problem([["1/3", 0], [0, 1]], np.array([-0.5, 1]), 1)
        self.assertEqual((mixed.exact_A, mixed.exact_b), ([[Fraction(1, 3), 0], [0, 1]], [Fraction(-1, 2), 1]))

    def test_doubles_are_read_where_they_lie_whatever_their_strides(self):
        block = np.zeros((8, 12))
        for matrix in (np.asfortranarray(A, float), block[1:8:2, 1:12:3], block[::-2, ::-3]):
            matrix[...] = A
            with mock.patch("stiction._problem._stiction") as module:
                stiction.Problem(matrix, B, 1)
            self.assertIs(module.Problem.from_numbers.call_args.args[0], matrix)
            self.assertEqual(stiction.Problem(matrix, B, 1).digest, stiction.load(LOOP).digest)

    def test_no_number_of_an_array_is_looked_at_in_python(self):
        with mock.patch("stiction._problem.exact_text", side_effect=lambda value, name: str(value)) as looked:
            for kind in (float, np.float32, np.int32, np.int64):
                stiction.Problem(np.array(A, kind), np.array(B, kind), [1, 1])
        self.assertEqual({call.args[1] for call in looked.mock_calls}, {"Problem: mu[0]", "Problem: mu[1]"})


class Given(unittest.TestCase):
    def test_forces_are_arrays_beside_which_exact_ones_stand(self):
        problem = stiction.load(LOOP)
        answer = stiction.solve(problem)
        self.assertEqual((answer.f.dtype, answer.f.shape, answer.a.dtype), (np.float64, (4,), np.float64))
        self.assertEqual(answer.exact_f, (Fraction(1, 3), Fraction(1, 3), Fraction(2, 3), Fraction(2, 3)))
        np.testing.assert_array_equal(answer.f, [1 / 3, 1 / 3, 2 / 3, 2 / 3])
        np.testing.assert_allclose(problem.A @ answer.f + problem.b, answer.a, atol=1e-15)
        self.assertTrue(all(isinstance(x, Fraction) for x in answer.exact_f + answer.exact_a))
        self.assertIsNone(answer.f_bounds)
        self.assertIs(answer.f, answer.f)
        with self.assertRaises(ValueError):
            answer.f[0] = 0
        self.assertEqual(answer, stiction.solve(problem))

    def test_doubles_are_the_rationals_that_they_are(self):
        answer = stiction.solve(stiction.load(LOOP), "complete", "double")
        self.assertEqual(answer.exact_f, tuple(Fraction(x) for x in answer.f))
        self.assertEqual(answer.exact_a, tuple(Fraction(x) for x in answer.a))
        self.assertEqual(answer.f.tolist(), answer.json["f"])

    def test_a_fraction_is_its_nearest_double_however_long_or_large(self):
        for b in (Fraction(10 ** 40 + 1, 3 ** 80), Fraction(10) ** 300, Fraction(1, 10 ** 320)):
            answer = stiction.solve(stiction.Problem([[1]], [-b], 0, ["frictionless"]))
            self.assertEqual((answer.exact_f, answer.f[0]), ((b,), float(b)))
        for free, normal, least in ((Fraction(-10) ** 301, np.inf, 0), (Fraction(10) ** 400, 0, np.inf)):
            answer = stiction.solve(stiction.Problem([["1e-300"]], [free], 0, ["frictionless"]))
            self.assertEqual((answer.exact_f[0], answer.f[0], answer.a[0]),
                             (max(0, -free * 10 ** 300), normal, least))

    def test_bounds_of_enclosures_are_an_array_and_hold_the_forces(self):
        problem = stiction.load(LOOP)
        exact, answer = stiction.solve(problem), stiction.solve(problem, "complete", "interval")
        for bounds, middle, of in ((answer.f_bounds, answer.f, exact.exact_f),
                                   (answer.a_bounds, answer.a, exact.exact_a)):
            self.assertEqual((bounds.shape, middle.shape), ((4, 2), (4,)))
            for (low, high), x, inside in zip(bounds, middle, of):
                self.assertTrue(Fraction(low) <= inside <= Fraction(high))
                self.assertTrue(low <= x <= high)
        with self.assertRaisesRegex(ValueError, "exact_f: found bounds.*f_bounds"):
            answer.exact_f

    def test_so_are_those_of_every_step(self):
        for arithmetic in ("exact", "double"):
            run = stiction.replay(stiction.load(LOOP), method="complete", arithmetic=arithmetic)
            forces = np.array([pivot.f for pivot in run.pivots])
            self.assertEqual((forces.dtype, forces.shape), (np.float64, (len(run.pivots), 4)))
            for pivot in run.pivots:
                self.assertEqual([Fraction(x) for x in pivot.json["f"]], list(pivot.exact_f))
                self.assertEqual(pivot.a.tolist(), [float(x) for x in pivot.exact_a])
        self.assertEqual(stiction.replay(stiction.load(LOOP)).pivots[0].step, Fraction(1, 3))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
