# SPDX-License-Identifier: Apache-2.0
"""refusal_test.py PROGRAM SOURCES: what is wrong is refused by the Python package in one line that names it."""
import sys
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np
import stiction

SOURCES = Path(sys.argv[2])
LOOP = SOURCES / "corpus/cycle-every-policy-mu-1.json"
SPACE = SOURCES / "corpus/space/three-sliding-contacts.json"
A = [[3, -4, 2, 0], [-4, 7, -4, 1], [2, -4, 7, -6], [0, 1, -6, 7]]
B = [-1, 0, 0, -2]


def changed(row, column, value):
    matrix = np.array(A, float)
    matrix[row, column] = value
    return matrix


# What is called, with what, the error, and what its line says: what was found, then what was expected.
PROBLEMS = [
    ((changed(1, 2, np.nan), B, 1), ValueError, r"A\[1\]\[2\]: found a number that is not finite, expected a finite"),
    ((A, np.array([0, 0, np.inf, 0]), 1), ValueError, r"b\[2\]: found a number that is not finite"),
    (([[1, "x"], [0, 1]], [0, 0], 1), ValueError, r"A\[0\]\[1\]: found 'x', expected a finite number"),
    ((np.eye(2), [0, None], 1), ValueError, r"b\[1\]: found None, expected"),
    ((np.eye(2), [0, 1j], 1), ValueError, r"b\[1\]: found 1j, expected"),
    ((np.eye(2), [0, "1/0"], 1), ValueError, r"b\[1\]: found '1/0', expected"),
    ((np.ma.masked_equal(np.array(A, float), 7), B, 1), ValueError, "A: found an array with masked entries"),
    ((A, B[:3], [1, 1]), ValueError, "b: found 3 numbers, expected 4, one for each row of A"),
    ((np.array(A, float)[:, :3], B, 1), ValueError, "A: found 4 x 3, expected 4 x 4"),
    ((A[:3], B, 1), ValueError, "A: found 3 x 4, expected 4 x 4"),
    ((A, B[:3], 1), ValueError, "b: found 3 numbers, expected 4, one for each row of A"),
    ((A, B, [1, 1, 1]), ValueError, "A: found 4 x 4, expected 6 x 6: 3 contacts, as mu or kinds say, of 2 rows each"),
    ((np.eye(6), np.zeros(6), [1, 1]), ValueError, "expected 4 x 4: 2 contacts, .*, with dimension=2$"),
    (([], B, 1), ValueError, "found A with 1 and b with 1 dimensions, expected 2 and 1"),
    (([[1, 2], [3]], [0, 0], 1), ValueError, "found A with 1 and b with 1"),
    ((np.eye(3), np.zeros(3), [1, 1]), ValueError, "A: found 3 x 3, expected 4 x 4"),
    ((np.eye(2), np.zeros((2, 1)), 1), ValueError, "b with 2 dimensions"),
    ((A, B, [1, -1]), ValueError, r"contacts\[1\].mu: found .*-1.*, expected"),
    ((A, B, [1, np.nan]), ValueError, r"mu\[1\]: found nan, expected a finite number"),
    ((A, B, [1, [1, 2]]), ValueError, r"mu\[1\]: found \[1, 2\], expected"),
    ((A, B, [1, 1, 1], ["static", "static"]), ValueError, "mu: found 3, expected 2, one for each contact"),
    ((A, B, 1, ["static", "sticky"]), ValueError, r"contacts\[1\].kind: found .*sticky.*, expected one of"),
    ((A, B, 1, "static"), TypeError, "kinds: found 'static', expected a sequence"),
    ((A, B, 1, ["static", 2]), TypeError, r"kinds\[1\]: found 2, expected text"),
    ((A, B, 1, None, 4), ValueError, "dimension: found 4, expected 2 or 3"),
    ((A, B, 1, None, 2.0), TypeError, "dimension: found 2.0, expected an integer"),
    ((A, B, 1, None, 2, 3), TypeError, "name: found 3, expected text"),
    ((A, B, 1, None, 2, "p", [None]), ValueError, "slips: found 1, expected 2"),
]
SOLVED = [
    ({"method": "guess"}, ValueError, "method: found guess, expected one of auto, complete, .*lemke"),
    ({"method": 3}, TypeError, "method: found 3, expected text"),
    ({"arithmetic": "decimal"}, ValueError, "arithmetic: found decimal, expected one of .*exact"),
    ({"method": "proximal", "arithmetic": "exact"}, ValueError, "proximal.*exact.*not built.*expected one of"),
    ({"policy": "scan=never"}, ValueError, "scan.*found 'never', expected one of lowest"),
    ({"policy": "pace=slow"}, ValueError, "policy: found 'pace=slow', expected"),
    ({"method": "complete", "policy": "scan=highest"}, ValueError, "policy scan=highest: expected method baraff"),
    ({"law": "coulomb"}, ValueError, "dimension: found 2, expected 3"),
    ({"law": "amonton"}, ValueError, "law: found amonton, expected baraff or coulomb"),
    ({"sides": 6}, ValueError, "sides: found 6, expected a multiple of 4"),
    ({"sides": 8.0}, TypeError, "sides: found 8.0, expected an integer"),
    ({"sides": "8"}, TypeError, "sides: found '8', expected an integer"),
    ({"residual": 2}, ValueError, "residual: found 2, expected 0 to 1"),
    ({"residual": float("nan")}, ValueError, "residual: found nan, expected 0 to 1"),
    ({"residual": "0"}, TypeError, "residual: found '0', expected a number"),
    ({"seconds": -1}, ValueError, "seconds: found -1, expected"),
    ({"max_bits": 0}, ValueError, "max_bits: found 0, expected 1 to"),
    ({"max_pivots": 1.5}, TypeError, "max_pivots: found 1.5, expected an integer"),
    ({"loop_grain": 0}, ValueError, "loop_grain: found 0, expected"),
    ({"force_tolerance": 1}, ValueError, "force_tolerance: found 1, expected 0 to 0.01"),
    ({"tolerance": 1}, TypeError, "tolerance"),
]
REPLAYED = [
    ({"method": "qp"}, ValueError, "method: found qp, expected one with a path: .*baraff"),
    ({"method": "auto"}, ValueError, "method: found auto, expected one with a path"),
    ({"arithmetic": "interval"}, ValueError, "arithmetic: found interval, expected one of exact, float"),
    ({"method": "lemke", "policy": "scan=highest"}, ValueError, "policy scan=highest: expected method baraff"),
    ({"sides": 2}, ValueError, "sides: found 2, expected"),
    ({"max_drives": 0}, ValueError, "max_drives: found 0, expected"),
]
CERTIFIED = [
    ({"claim": "safest"}, ValueError, "claim: found safest, expected one of .*safe-by-condition"),
    ({"claim": "coulomb-solution"}, ValueError, "dimension: found 2, expected 3"),
    ({"claim": None}, TypeError, "claim: found None, expected text"),
    ({"policy": "scan=never"}, ValueError, "found 'never'"),
    ({"law": "coulomb"}, ValueError, "dimension: found 2, expected 3"),
    ({"law": "amonton"}, ValueError, "^law: found amonton, expected baraff or coulomb"),
    ({"max_drives": -1}, ValueError, "max_drives: found -1, expected"),
    ({"max_bits": "9"}, TypeError, "max_bits: found '9', expected an integer"),
]


class Refused(unittest.TestCase):
    def refuses(self, error, named, call, *arguments, **chosen):
        with self.subTest(call=getattr(call, "__name__", call), arguments=arguments[1:], chosen=chosen):
            with self.assertRaisesRegex(error, named) as raised:
                call(*arguments, **chosen)
            self.assertNotIn("\n", str(raised.exception))

    def test_problems(self):
        for arguments, error, named in PROBLEMS:
            self.refuses(error, named, stiction.Problem, *arguments)

    def test_what_is_chosen(self):
        problem = stiction.load(LOOP)
        for call, table in ((stiction.solve, SOLVED), (stiction.replay, REPLAYED), (stiction.certify, CERTIFIED)):
            for chosen, error, named in table:
                self.refuses(error, named, call, problem, **chosen)
        self.refuses(ValueError, "arithmetic: found double, expected exact", stiction.ends, problem,
                     arithmetic="double")
        self.refuses(ValueError, "^law baraff: expected claim existence, found h", stiction.certify,
                     stiction.load(SPACE), "h", law="baraff")
        self.refuses(ValueError, "slip=polygon", stiction.replay, stiction.load(SPACE), "slip=polygon")
        self.refuses(ValueError, "exact.*not built", stiction.replay, stiction.load(SPACE), "slip=polygon",
                     arithmetic="exact")

    def test_what_is_no_problem(self):
        for call in (stiction.solve, stiction.replay, stiction.ends, stiction.certify):
            for thing in (str(LOOP), None, np.eye(2)[0]):
                self.refuses(TypeError, f"{call.__name__}: problem: found .*, expected a stiction.Problem, as stiction.Problem.A, b, mu. and "
                             "stiction.load.path. make", call, thing)
        self.refuses(TypeError, "check: problem: found 1", stiction.check, 1, "{}")
        self.refuses(TypeError, "^solve: problem: found array", stiction.solve, np.array(A), B, 1)
        self.refuses(TypeError, "^solve_all: problems: found one stiction.Problem, expected a sequence",
                     stiction.solve_all, stiction.load(LOOP))
        self.refuses(TypeError, "certificate: found None, expected a stiction.Certificate or its text; certify gives None",
                     stiction.check, stiction.load(LOOP), None)

    def test_many(self):
        self.refuses(TypeError, "solve_all: problem: found None", stiction.solve_all, [None])
        self.refuses(ValueError, "method: found guess", stiction.solve_all, [stiction.load(LOOP)], "guess")
        self.refuses(ValueError, "max_drives: found 0", stiction.solve_all, [stiction.load(LOOP)], max_drives=0)
        self.refuses(ValueError, "judge: found 0 problems, expected 1", stiction.solve_all, [stiction.load(LOOP)], judge=[])
        self.refuses(ValueError, "found 'quad', expected float or double", stiction.load(LOOP).rounded, "quad")
        self.refuses(ValueError, r"b\[0\]: found 1e300|in the range of float", stiction.Problem(A, [1e300] * 4, 1).rounded, "float")
        self.refuses(ValueError, "found .none., expected one of integers", stiction.draw, "none", 2, 1)
        self.refuses(ValueError, "contacts.*9", stiction.draw, "psd", 9, 1)
        self.refuses(ValueError, "count: found -1", stiction.draw, "psd", 2, -1)
        self.refuses(TypeError, "first: found 1.5", stiction.draw, "psd", 2, 1, first=1.5)
        self.refuses(ValueError, "found 3 of 2", stiction.interval, 3, 2)
        self.refuses(ValueError, "found -1 of None", stiction.interval, -1)

    def test_certificates(self):
        problem = stiction.load(LOOP)
        self.refuses(TypeError, "certificate: found 3, expected a stiction.Certificate", stiction.check, problem, 3)
        self.refuses(ValueError, "certificate: .*JSON", stiction.check, problem, "{")
        self.refuses(ValueError, "certificate", stiction.check, problem, "{}")
        self.refuses(ValueError, "certificate: .*found 33554433 bytes, expected a certificate of at most 33554432",
                     stiction.check, problem, " " * (2 ** 25 + 1))

    def test_files(self):
        self.refuses(OSError, "nowhere", stiction.load, "/nowhere.json")
        self.refuses(OSError, "nowhere", stiction.Store, b"/nowhere.store")
        self.refuses(TypeError, "path: found 0, expected text or a path", stiction.load, 0)
        self.refuses(TypeError, "path: found None", stiction.Store, None)
        self.refuses(TypeError, "path: found 1", stiction.load(LOOP).save, 1)
        self.refuses(ValueError, "/nowhere/p.json: cannot be written", stiction.load(LOOP).save, "/nowhere/p.json")

    def test_fractions_of_python_are_no_arrays(self):
        self.assertEqual(stiction.Problem([[Fraction(1, 3)]], [0], 0, ["frictionless"]).exact_A, [[Fraction(1, 3)]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
