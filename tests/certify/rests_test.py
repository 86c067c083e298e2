#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`rests` and `cannot-rest`: what their checkers refuse, clause by clause.

  rests_test.py STICTION SOURCES

Python standard library only.
"""

import sys

sys.dont_write_bytecode = True
import claim_cases
from claim_cases import false, problem, true

UNIT = [[1, 0], [0, 1]]
UNIT3 = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def block(mu, push):
    """Of weight 4, pushed sideways: it rests up to 4 mu."""
    return problem([mu], UNIT, [-4, push])


def pinched(gap):
    """Two contacts that press on each other; `gap` is what both together lack to rest."""
    return problem([None, None], [[1, 1], [1, 1]], [-1, -1 - gap])


true("rests", "at its limit", block("1/2", 2), f=["4", "-2"])
true("rests", "nothing acts", problem([None], [[1]], [0]), f=["0"])
true("rests", "any forces that balance", pinched(0), f=["1/3", "2/3"])
true("rests", "a bilateral contact pulls", problem(["hold"], [[1]], [1]), f=["-1"])
true("rests", "in space, at its limit", problem([1], UNIT3, [-5, 3, 4], 3), f=["5", "-3", "-4"])
true("rests", "of an A that is not symmetric", problem([None, None], [[1, 1], [0, 1]], [-2, -1]), f=["1", "1"])
false("rests", "beyond its limit", block("1/2", "5/2"), f=["4", "-5/2"])
false("rests", "the limit alone is kept", block("1/2", "5/2"), f=["4", "-2"])
false("rests", "pulled off", problem([None], [[1]], [1]), f=["-1"])
false("rests", "it separates", problem([None], [[1]], [1]), f=["0"])
false("rests", "one row is missed", pinched(0), f=["1/3", "1/3"])
false("rests", "in space, by its square beyond the limit", problem([1], UNIT3, [-5, 3, "401/100"], 3),
      f=["5", "-3", "-401/100"])
false("rests", "the transpose of A", problem([None, None], [[1, 1], [0, 1]], [-1, -2]), f=["1", "1"])
false("rests", "a sliding contact", problem([("1", ["1"])], UNIT, [-4, 4]), f=["4", "-4"])
false("rests", "too few forces", block("1/2", 2), f=["4"])

true("cannot-rest", "beyond its limit", block("1/2", "5/2"), y=["1/2", "1"], value="1/2")
true("cannot-rest", "it separates", problem([None], [[1]], [1]), y=["1"], value="1")
true("cannot-rest", "two contacts want different forces", pinched(1), y=["1", "-1"], value="1")
true("cannot-rest", "a bilateral contact asks for zero", problem(["hold"], [[0]], [1]), y=["1"], value="1")
true("cannot-rest", "in space", problem([1], UNIT3, [-5, 3, 5], 3), y=["5", "3", "4"], value="4")
true("cannot-rest", "of an A that is not symmetric", problem([None, None], [[1, 1], [0, 1]], [1, 1]), y=["1", "0"],
     value="1")
false("cannot-rest", "it rests at its limit", block("1/2", 2), y=["1/2", "1"], value="0")
false("cannot-rest", "a value that is not y'b", block("1/2", 2), y=["1/2", "1"], value="1")
false("cannot-rest", "a negative value", block("1/2", 1), y=["1/2", "1"], value="-1")
false("cannot-rest", "outside of the dual cone", block("1/2", 2), y=["1/4", "1"], value="1")
false("cannot-rest", "a bilateral contact could hold", problem(["hold"], [[1]], [1]), y=["1"], value="1")
false("cannot-rest", "in space, outside of the dual cone by its square", problem([1], UNIT3, [-5, 3, 4], 3),
      y=["499/100", "3", "4"], value="1/20")
false("cannot-rest", "the transpose of A", problem([None, None], [[1, -1], [0, 1]], [1, 0]), y=["1", "0"], value="1")
false("cannot-rest", "a sliding contact", problem([("1", ["1"])], UNIT, [4, 0]), y=["1", "0"], value="4")

if __name__ == "__main__":
    sys.exit(claim_cases.main(*sys.argv[1:]))
