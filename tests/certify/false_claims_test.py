#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""False claims, well written, for the clauses of every claim, and every checker must refuse each (claim_cases.py)."""

import sys
from fractions import Fraction

sys.dont_write_bytecode = True
from claim_cases import FALSE, TRUE, certificate, contact, false, main, problem, texts, true


def smooth(A, b):
    """Of frictionless contacts."""
    return problem([None] * len(b), A, b)


IDENTITY = [[1, 0], [0, 1]]
NOTHING = [[0, 0], [0, 0]]

# --- symmetric, not-symmetric ------------------------------------------------------

true("symmetric", "A = A'", smooth([[1, 2], [2, 0]], [0, 0]))
for i, j in ((0, 1), (1, 0), (1, 2), (2, 1), (0, 2)):
    A = [[1, 2, 3], [2, 4, 5], [3, 5, 6]]
    A[i][j] += 1
    false("symmetric", f"A_{i}{j} is one more than its mirror", smooth(A, [0, 0, 0]))

ASYMMETRIC = smooth([[1, 2, 3], [2, 4, 5], [3, 6, 6]], [0, 0, 0])
true("not-symmetric", "A_12 and A_21 differ", ASYMMETRIC, i=1, j=2)
false("not-symmetric", "these two are equal, others are not", ASYMMETRIC, i=0, j=1)
false("not-symmetric", "an entry of the diagonal", ASYMMETRIC, i=1, j=1)
false("not-symmetric", "no such row", ASYMMETRIC, i=3, j=1)
false("not-symmetric", "no such column", ASYMMETRIC, i=1, j=3)
false("not-symmetric", "a negative index", ASYMMETRIC, i=-1, j=2)
false("not-symmetric", "a negative index, from the end of one that differs", ASYMMETRIC, i=-2, j=2)
false("not-symmetric", "of a symmetric matrix", smooth([[1, 2], [2, 1]], [0, 0]), i=0, j=1)

# --- psd, not-psd ------------------------------------------------------------------

true("psd", "A = L diag(D) L'", smooth([[1, 1], [1, 1]], [0, 0]), L=texts([[1, 0], [1, 1]]), D=texts([1, 0]))
false("psd", "a negative D, the last", smooth([[1, 0], [0, -1]], [0, 0]), L=texts(IDENTITY), D=texts([1, -1]))
false("psd", "a negative D, the first", smooth([[-1, 0], [0, 1]], [0, 0]), L=texts(IDENTITY), D=texts([-1, 1]))
false("psd", "the last entry of A is another", smooth([[1, 1], [1, 0]], [0, 0]),
      L=texts([[1, 0], [1, 1]]), D=texts([1, 0]))
false("psd", "the product lacks its last term", smooth([[1, 1], [1, 1]], [0, 0]),
      L=texts([[1, 0], [1, 1]]), D=texts([1, 5]))
false("psd", "A differs above the diagonal", smooth([[1, 7], [0, 1]], [0, 0]), L=texts(IDENTITY), D=texts([1, 1]))
false("psd", "A differs below the diagonal", smooth([[1, 0], [7, 1]], [0, 0]), L=texts(IDENTITY), D=texts([1, 1]))
false("psd", "A differs beside its diagonal", smooth([[1, 7], [7, 1]], [0, 0]), L=texts(IDENTITY), D=texts([1, 1]))
false("psd", "a diagonal of L that is not one", smooth([[4]], [0]), L=texts([[2]]), D=texts([1]))
false("psd", "an entry of L above the diagonal", smooth(IDENTITY, [0, 0]), L=texts([[1, 1], [0, 1]]), D=texts([1, 1]))
false("psd", "L of too few rows", smooth(IDENTITY, [0, 0]), L=texts([[1, 0]]), D=texts([1, 1]))

true("not-psd", "x'Ax < 0", smooth([[1, 2], [2, 1]], [0, 0]), x=texts([1, -1]), value="-2")
false("not-psd", "x'Ax = 0, x in the kernel", smooth([[1, 1], [1, 1]], [0, 0]), x=texts([1, -1]), value="0")
false("not-psd", "x'Ax = 0, x = 0", smooth(IDENTITY, [0, 0]), x=texts([0, 0]), value="0")
false("not-psd", "x'Ax > 0", smooth(IDENTITY, [0, 0]), x=texts([1, -1]), value="2")
false("not-psd", "the value is not x'Ax, which is positive", smooth(IDENTITY, [0, 0]), x=texts([1, -1]), value="-2")
false("not-psd", "the value is not x'Ax", smooth([[1, 2], [2, 1]], [0, 0]), x=texts([1, -1]), value="-1")
false("not-psd", "the value is x'Ax without its mixed terms", smooth([[-1, 2], [2, -1]], [0, 0]),
      x=texts([1, 1]), value="-2")

# --- definite, not-definite ---------------------------------------------------------

true("definite", "A = L diag(D) L', D > 0", smooth([[1, 1], [1, 3]], [0, 0]),
     L=texts([[1, 0], [1, 1]]), D=texts([1, 2]))
false("definite", "a zero D, the last", smooth([[1, 1], [1, 1]], [0, 0]), L=texts([[1, 0], [1, 1]]), D=texts([1, 0]))
false("definite", "a zero D, the first", smooth([[0, 0], [0, 1]], [0, 0]), L=texts(IDENTITY), D=texts([0, 1]))
false("definite", "a negative D", smooth([[1, 0], [0, -1]], [0, 0]), L=texts(IDENTITY), D=texts([1, -1]))
false("definite", "A is another matrix", smooth([[1, 1], [1, 1]], [0, 0]), L=texts([[1, 0], [1, 1]]), D=texts([1, 2]))
false("definite", "A is not symmetric", smooth([[1, 7], [0, 1]], [0, 0]), L=texts(IDENTITY), D=texts([1, 1]))

true("not-definite", "x'Ax = 0", smooth([[1, 1], [1, 1]], [0, 0]), x=texts([1, -1]), value="0")
true("not-definite", "x'Ax < 0", smooth([[1, 2], [2, 1]], [0, 0]), x=texts([1, -1]), value="-2")
false("not-definite", "x = 0", smooth(IDENTITY, [0, 0]), x=texts([0, 0]), value="0")
false("not-definite", "x'Ax > 0", smooth(IDENTITY, [0, 0]), x=texts([1, 0]), value="1")
false("not-definite", "the value is not x'Ax", smooth(IDENTITY, [0, 0]), x=texts([1, -1]), value="0")

# --- in-range, not-in-range --------------------------------------------------------

true("in-range", "A x = b", smooth([[1, 1], [1, 1]], [2, 2]), x=texts([2, 0]))
for row in (0, 1):
    b = [2, 2]
    b[row] = 3
    false("in-range", f"A x = b but for row {row}", smooth([[1, 1], [1, 1]], b), x=texts([2, 0]))
false("in-range", "A'x = b, not A x = b", smooth([[0, 1], [0, 0]], [0, 1]), x=texts([1, 0]))

KERNEL = smooth([[1, 0], [0, 0]], [1, 0])
true("not-in-range", "y'A = 0, y'b /= 0", smooth([[1, 0], [0, 0]], [1, 1]), y=texts([0, 1]), value="1")
false("not-in-range", "y'b = 0", KERNEL, y=texts([0, 1]), value="0")
false("not-in-range", "y'A /= 0, in its first entry", KERNEL, y=texts([1, 0]), value="1")
false("not-in-range", "y'A /= 0, in its last entry", smooth([[0, 0], [0, 1]], [0, 1]), y=texts([0, 1]), value="1")
false("not-in-range", "A y = 0, not y'A = 0", smooth([[0, 1], [0, 0]], [1, 0]), y=texts([1, 0]), value="1")
false("not-in-range", "the value is not y'b, which is zero", KERNEL, y=texts([0, 1]), value="1")
false("not-in-range", "the value is not y'b", smooth([[1, 0], [0, 0]], [1, 1]), y=texts([0, 1]), value="2")
false("not-in-range", "y = 0 and a value", KERNEL, y=texts([0, 0]), value="1")

# --- h, not-h ----------------------------------------------------------------------

true("h", "b - A'y = 0", smooth(IDENTITY, [-1, -1]), y=texts([-1, -1]))
true("h", "b - A'y within a dual cone, at its edge", problem([2], NOTHING, [2, -1]), y=texts([0, 0]))
false("h", "b - A'y pulls at a contact", smooth(NOTHING, [1, -1]), y=texts([0, 0]))
false("h", "b - A'y outside of a dual cone, one way", problem([2], NOTHING, [1, 1]), y=texts([0, 0]))
false("h", "b - A'y outside of a dual cone, the other way", problem([2], NOTHING, [1, -1]), y=texts([0, 0]))
false("h", "b - A'y in the opposite of a dual cone", problem([2], NOTHING, [-2, 1]), y=texts([0, 0]))
false("h", "within the friction cone, not within its dual", problem([2], NOTHING, [1, 2]), y=texts([0, 0]))
false("h", "b - A'y pushes at a bilateral contact", problem(["hold"], [[0]], [1]), y=texts([0]))
false("h", "b - A'y pulls at a bilateral contact", problem(["hold"], [[0]], [-1]), y=texts([0]))
false("h", "A y for A'y", smooth([[0, 1], [0, 0]], [-1, 0]), y=texts([0, -1]))
false("h", "A y for A'y, no entry zero", smooth([[1, -1], [2, -2]], [-1, -2]), y=texts([0, 1]))
false("h", "a sliding contact", problem([("1", "1")], NOTHING, [1, 0]), y=texts([0, 0]))
FLAT = [[0] * 3 for _ in range(3)]
true("h", "in space, at the edge of the dual cone", problem([1], FLAT, [5, 3, -4], 3), y=texts([0, 0, 0]))
false("h", "in space, outside by both tangents", problem([1], FLAT, [4, 3, -3], 3), y=texts([0, 0, 0]))
false("h", "in space, outside by the second tangent", problem([1], FLAT, [1, 0, 2], 3), y=texts([0, 0, 0]))

true("not-h", "v in K, A v = 0, b'v < 0", problem([1, "hold"], [[0] * 3] * 3, [0, -1, 2]),
     v=texts([1, 1, -1]), value="-3")
false("not-h", "b'v = 0", smooth(NOTHING, [1, 0]), v=texts([0, 1]), value="0")
false("not-h", "b'v > 0", smooth(NOTHING, [1, 0]), v=texts([1, 0]), value="1")
false("not-h", "the value is not b'v, which is positive", smooth(NOTHING, [1, 0]), v=texts([1, 0]), value="-1")
false("not-h", "the value is not b'v", smooth(NOTHING, [-1, 0]), v=texts([1, 0]), value="-2")
false("not-h", "A v /= 0, in its first entry", smooth([[1, 0], [0, 0]], [-1, 0]), v=texts([1, 0]), value="-1")
false("not-h", "A v /= 0, in its last entry", smooth([[0, 0], [0, 1]], [0, -1]), v=texts([0, 1]), value="-1")
false("not-h", "A'v = 0, not A v = 0", smooth([[0, 0], [1, 0]], [-1, 0]), v=texts([1, 0]), value="-1")
false("not-h", "v pulls", smooth(NOTHING, [1, 0]), v=texts([-1, 0]), value="-1")
false("not-h", "v pulls at a static contact", problem([1], NOTHING, [1, 0]), v=texts([-1, 0]), value="-1")
false("not-h", "v outside of its friction cone, one way", problem([1], NOTHING, [2, 1]), v=texts([1, -3]), value="-1")
false("not-h", "v outside of its friction cone, the other way", problem([1], NOTHING, [2, -1]),
      v=texts([1, 3]), value="-1")
false("not-h", "a sliding contact", problem([("1", "1")], NOTHING, [-1, 0]), v=texts([1, 0]), value="-1")
true("not-h", "in space, at the edge of the cone", problem([1], FLAT, [0, -1, 0], 3), v=texts([5, 3, -4]), value="-3")
false("not-h", "in space, outside by the second tangent", problem([1], FLAT, [1, 0, 1], 3),
      v=texts([1, 0, -2]), value="-1")

# --- solution-exists ---------------------------------------------------------------


def solution(kind, what, of, f, a=None, claim="solution-exists", **witness):
    """Without `a`: that of f."""
    A, b = of["A"], of["b"]
    if a is None:
        a = [sum((Fraction(x) * y for x, y in zip(row, f)), Fraction(free)) for row, free in zip(A, b)]
    kind(claim, what, of, f=texts(f), a=texts(a), **witness)


true_solution = lambda *given, **more: solution(true, *given, **more)
false_solution = lambda *given, **more: solution(false, *given, **more)

true_solution("pushed and at rest", smooth([[1]], [-1]), [1])
false_solution("aN < 0", smooth([[1]], [-1]), [0])
false_solution("fN < 0", smooth([[1]], [1]), [-1])
false_solution("fN > 0 and aN > 0", smooth([[1]], [-1]), [2])
false_solution("a is not A f + b, and would do", smooth([[1]], [-1]), [0], [0])
false_solution("a is not A f + b in its last entry", smooth(IDENTITY, [-1, -1]), [1, 0], [0, 0])
false_solution("the second contact breaks the law", smooth(IDENTITY, [-1, -1]), [1, 0])

true_solution("static at its limit", problem([1], IDENTITY, [-1, 2]), [1, -1])
for side in (1, -1):
    false_solution(f"abs(fF) > mu fN, side {side}", problem([1], IDENTITY, [-1, 2 * side]), [1, -2 * side])
    false_solution(f"friction pushes along, side {side}", problem([1], IDENTITY, [-1, 2 * side]), [1, side])
    false_solution(f"slipping within its limit, side {side}", problem([1], IDENTITY, [-1, 2 * side]),
                   [1, Fraction(-side, 2)])
    false_solution(f"slipping, fN < 0, side {side}", problem([1], IDENTITY, [1, 0]), [-1, side])
    false_solution(f"friction without a normal force, side {side}", problem([1], IDENTITY, [1, side]), [0, -side])
false_solution("slipping without friction", problem([1], IDENTITY, [-1, 2]), [1, 0])
false_solution("static, fN < 0", problem([1], IDENTITY, [1, 0]), [-1, 0])
false_solution("static, aN < 0", problem([1], IDENTITY, [-1, 0]), [0, 0])
false_solution("static, fN > 0 and aN > 0", problem([1], IDENTITY, [-1, 0]), [2, 0])
false_solution("mu = 0 with friction", problem([0], IDENTITY, [-1, 1]), [1, -1])

true_solution("bilateral, pulling", problem(["hold"], [[1]], [1]), [-1])
false_solution("bilateral, aN > 0", problem(["hold"], [[1]], [1]), [0])
false_solution("bilateral, aN < 0", problem(["hold"], [[1]], [-1]), [0])

for slip in (1, -1):
    SLIDING = problem([("1/2", str(slip))], IDENTITY, [-1, 0])
    true_solution(f"sliding, slip {slip}", SLIDING, [1, Fraction(-slip, 2)])
    false_solution(f"sliding, friction along the slip {slip}", SLIDING, [1, Fraction(slip, 2)])
    false_solution(f"sliding, no friction, slip {slip}", SLIDING, [1, 0])
    false_solution(f"sliding, too much friction, slip {slip}", SLIDING, [1, -slip])
    false_solution(f"sliding, aN < 0, slip {slip}", SLIDING, [0, 0])
    false_solution(f"sliding, fN > 0 and aN > 0, slip {slip}", SLIDING, [2, -slip])


# --- In space: solution-exists, coulomb-solution -------------------------------------

UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def pushed(x, y, law=1):
    """A contact with A = 1 that is pressed with one newton, and drawn to (x, y)."""
    return problem([law], UNIT, [-1, x, y], 3)


true_solution("in space, against aF", pushed(3, 4), [1, Fraction(-3, 5), Fraction(-4, 5)])
true_solution("in space, across aF", pushed(3, 1), [1, 0, -1])
true_solution("in space, at rest", pushed(0, 0), [1, 0, 0])
for x, y in ((2, 0), (0, 2), (-2, 0), (0, -2)):
    false_solution(f"in space, fF.fF > mu^2 fN^2, drawn to {x}, {y}", pushed(x, y), [1, -x, -y])
    false_solution(f"in space, fF.aF > 0, drawn to {x}, {y}", pushed(x, y), [1, Fraction(x, 2), Fraction(y, 2)])
    false_solution(f"in space, at its limit with fF.aF > 0, drawn to {x}, {y}", pushed(x, y),
                   [1, x // 2, y // 2])
    false_solution(f"in space, slipping within the limit, drawn to {x}, {y}", pushed(x, y),
                   [1, Fraction(-x, 4), Fraction(-y, 4)])
false_solution("in space, fF.fF > mu^2 fN^2 by both tangents", pushed(Fraction(4, 5), Fraction(4, 5)),
               [1, Fraction(-4, 5), Fraction(-4, 5)])
false_solution("in space, fN < 0", problem([1], UNIT, [1, 0, 0], 3), [-1, 0, 0])
false_solution("in space, aN < 0", pushed(0, 0), [0, 0, 0])
false_solution("in space, fN > 0 and aN > 0", pushed(0, 0), [2, 0, 0])
false_solution("in space, friction without a normal force", problem([1], UNIT, [1, 1, 0], 3), [0, -1, 0])
false_solution("in space, frictionless, fN > 0 and aN > 0", problem([None], [[1]], [-1], 3), [2])
true_solution("in space, bilateral, pulling", problem(["hold"], [[1]], [1], 3), [-1])
false_solution("in space, bilateral, aN > 0", problem(["hold"], [[1]], [1], 3), [0])
false_solution("in space, bilateral, aN < 0", problem(["hold"], [[1]], [-1], 3), [0])
SLIDES = pushed(0, 0, ("1/2", ["3/5", "4/5"]))
true_solution("in space, sliding", SLIDES, [1, Fraction(-3, 10), Fraction(-2, 5)])
false_solution("in space, sliding, another force along x", SLIDES, [1, Fraction(3, 10), Fraction(-2, 5)])
false_solution("in space, sliding, another force along y", SLIDES, [1, Fraction(-3, 10), Fraction(2, 5)])
false_solution("in space, sliding, no friction", SLIDES, [1, 0, 0])
false_solution("in space, sliding, fN > 0 and aN > 0", SLIDES, [2, Fraction(-3, 5), Fraction(-4, 5)])
false_solution("in space, the second contact breaks the law",
               problem([1, None], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], [-1, 0, 0, -1], 3),
               [1, 0, 0, 0])


def coulomb(kind, what, of, f, bound, a=None):
    solution(kind, what, of, f, a, claim="coulomb-solution", bound=str(bound))


AGAINST = [1, Fraction(-3, 5), Fraction(-4, 5)]
coulomb(true, "against aF, bound 1", pushed(3, 4), AGAINST, 1)
coulomb(true, "at an angle, its cosine", pushed(3, Fraction(4, 5)), AGAINST, Fraction(3, 5))
for bound in (2, Fraction(101, 100), 0, -1):
    coulomb(false, f"the bound {bound}", pushed(0, 0), [1, 0, 0], bound)
coulomb(false, "the bound -1, against aF", pushed(3, 4), AGAINST, -1)
coulomb(false, "across aF", pushed(3, 1), [1, 0, -1], Fraction(1, 1000))
coulomb(false, "along aF", pushed(3, 4), [1, Fraction(3, 5), Fraction(4, 5)], 1)
coulomb(false, "at an angle, a larger bound", pushed(3, Fraction(4, 5)), AGAINST, Fraction(61, 100))
coulomb(false, "slipping within the limit", pushed(3, 4), [1, Fraction(-3, 10), Fraction(-2, 5)], 1)
coulomb(false, "more friction than the limit", pushed(6, 8), [1, Fraction(-6, 5), Fraction(-8, 5)], 1)
coulomb(false, "fN > 0 and aN > 0", pushed(0, 0), [2, 0, 0], 1)
coulomb(false, "aN < 0", pushed(0, 0), [0, 0, 0], 1)
coulomb(false, "fN < 0", problem([1], UNIT, [1, 0, 0], 3), [-1, 0, 0], 1)
coulomb(false, "a is not A f + b, and would do", pushed(3, 4), [1, 0, 0], 1, [0, 0, 0])
coulomb(true, "bilateral, pulling", problem(["hold"], [[1]], [1], 3), [-1], 1)
coulomb(false, "bilateral, aN > 0", problem(["hold"], [[1]], [1], 3), [0], 1)
coulomb(false, "bilateral, aN < 0", problem(["hold"], [[1]], [-1], 3), [0], 1)
coulomb(false, "in the plane", problem([1], IDENTITY, [-1, 2]), [1, -1], 1)
coulomb(false, "sliding against nothing", SLIDES, [1, 0, 0], 1)

# --- no-solution -------------------------------------------------------------------


def none(kind, what, of, *prefixes):
    """Prefixes: (modes separated by blanks, y)."""
    kind("no-solution", what, of,
         prefixes=[{"modes": modes.split(), "y": texts(y)} for modes, y in prefixes])


none(true, "nothing pushes", smooth([[0]], [-1]), ("", [1]))
none(true, "mode by mode", smooth([[0]], [-1]), ("break", [1]), ("touch", [1]))
none(false, "y'b = 0", smooth([[0]], [0]), ("", [0]))
none(false, "y'b > 0", smooth([[0]], [1]), ("", [1]))
none(false, "break with yN < 0", smooth([[0]], [1]), ("", [-1]))
none(false, "touch with gN > 0", smooth([[1]], [-1]), ("", [1]))
none(false, "touch is not covered", smooth([[1]], [-1]), ("break", [1]))
none(false, "one prefix twice", smooth([[1]], [-1]), ("break", [1]), ("break", [2]))
none(false, "no prefix at all", smooth([[1]], [-1]))
none(false, "a prefix and its extensions", smooth(IDENTITY, [-1, -1]),
     ("break", [1, 0]), ("break break", [1, 0]), ("break touch", [1, 0]))
none(false, "a contact behind the prefix in one of its modes", smooth(IDENTITY, [1, -1]),
     ("break", [0, 1]), ("touch", [-1, 0]))
none(false, "a prefix longer than the contacts", smooth([[0]], [-1]), ("break break", [1]), ("touch", [1]))
none(false, "hold with gN > 0", problem(["hold"], [[1]], [-1]), ("hold", [1]))
none(false, "hold with gN < 0", problem(["hold"], [[-1]], [-1]), ("hold", [1]))
none(false, "mu = 0, touch with yF /= 0", problem([0], IDENTITY, [-1, -1]), ("break", [1, 0]), ("touch", [0, 1]))
none(false, "sliding, touch with yF /= 0", problem([("1", "1")], [[1, 0], [0, 1]], [-1, -1]),
     ("break", [1, 0]), ("touch", [0, 1]))
for slip in (1, -1):
    for normal, what in ((3, "the sign of mu u gF"), (-1, "without mu u gF")):
        A = [[normal, -4 * slip], [-4 * slip, 9]]
        none(false, f"sliding, touch, {what}, slip {slip}", problem([("1", str(slip))], A, [-1, 0]),
             ("break", [1, 0]), ("touch", [1, 0]))


def refutations(what, A, b, **y):
    """Of one static contact with mu = 1, by mode; and the same with its tangent turned round."""
    names = {"lift": "break", "stick": "stick", "plus": "slip+", "minus": "slip-"}
    none(false, what, problem([1], A, b), *((names[mode], value) for mode, value in y.items()))
    turned = [[A[0][0], -A[0][1]], [-A[1][0], A[1][1]]]
    names["plus"], names["minus"] = names["minus"], names["plus"]
    none(false, what + ", turned", problem([1], turned, [b[0], -b[1]]),
         *((names[mode], [value[0], -value[1]]) for mode, value in y.items()))


for way in (1, -1):
    NARROW, first, last = problem([1], [[1, -way], [-way, 1]], [-1, 0]), *("slip+", "slip-")[::way]
    none(true, f"a wedge that no force opens, slip {way}", NARROW, ("break", [1, 0]), ("stick", [1, way]), (first, [1, way]),
         (last, [1, 0]))
    none(false, f"a wedge, the slips exchanged, slip {way}", NARROW, ("break", [1, 0]), ("stick", [1, way]), (last, [1, way]),
         (first, [1, 0]))
refutations("break with yF /= 0", NOTHING, [1, 1], lift=[0, -1], stick=[-1, 0], plus=[-1, 0], minus=[-1, 0])
refutations("stick with gN > 0", IDENTITY, [-1, 0], lift=[1, 0], stick=[1, 0], plus=[1, 1], minus=[1, -1])
refutations("stick with mu abs(gF) > -gN", IDENTITY, [-1, Fraction(-1, 2)],
            lift=[1, 0], stick=[0, 1], plus=[1, 1], minus=[1, -1])
refutations("slip+ with yF < 0", IDENTITY, [-1, 2], lift=[1, 0], stick=[-1, -1], plus=[-1, -1], minus=[0, -1])
refutations("slip+ with gN - mu gF > 0", IDENTITY, [-1, 2], lift=[1, 0], stick=[-1, -1], plus=[1, 0], minus=[0, -1])
refutations("slip+ with gN + mu gF <= 0 instead", [[1, -2], [-2, 5]], [-1, 3],
            lift=[1, 0], stick=[-5, -2], plus=[1, 0], minus=[1, 0])

# In space: modes break and touch, a force that touches is anywhere in its cone.


def first_row(*row, law=1, b=(-1, 0, 0)):
    """One contact in space, of A the first row alone."""
    return problem([law], [list(row), [0, 0, 0], [0, 0, 0]], b, 3)


UP = [1, 0, 0]
none(true, "in space, nothing pushes", problem([None], [[0]], [-1], 3), ("", [1]))
none(true, "in space, nothing pushes a static contact", first_row(0, 0, 0), ("", UP))
none(true, "in space, mode by mode", first_row(0, 0, 0), ("break", UP), ("touch", UP))
none(true, "in space, at the edge of the dual cone", first_row(-5, 3, -4), ("", UP))
none(true, "in space, mu = 0, friction that there is none of", first_row(0, 5, 0, law=0), ("", UP))
none(false, "in space, y'b = 0", first_row(0, 0, 0, b=(0, 0, 0)), ("", UP))
none(false, "in space, y'b > 0", first_row(0, 0, 0, b=(1, 0, 0)), ("", UP))
none(false, "in space, outside of the dual cone by both tangents", first_row(-4, 3, -3), ("", UP))
none(false, "in space, outside of the dual cone by the first tangent", first_row(-1, 2, 0), ("", UP))
none(false, "in space, outside of the dual cone by the second tangent", first_row(-1, 0, 2), ("", UP))
none(false, "in space, the opposite of the dual cone", first_row(5, 3, -4), ("", UP))
none(false, "in space, within the cone, not within its dual", first_row(-1, 2, 0, law=2), ("", UP))
none(false, "in space, mu = 0, touch with gN > 0", first_row(1, 0, 0, law=0), ("break", UP), ("touch", UP))
none(false, "in space, frictionless, touch with gN > 0", problem([None], [[1]], [-1], 3), ("break", [1]), ("touch", [1]))
none(false, "in space, break with yN < 0", first_row(0, 0, 0, b=(1, 0, 0)), ("break", [-1, 0, 0]), ("touch", [-1, 0, 0]))
for y in ([0, 1, 0], [0, 0, 1]):
    none(false, f"in space, break with yF /= 0, {y}", first_row(0, 0, 0, b=[1, *(-x for x in y[1:])]),
         ("break", y), ("touch", [-1, 0, 0]))
    none(false, f"in space, touch with yF /= 0, {y}", first_row(1, 0, 0, b=[-1, *(-x for x in y[1:])]),
         ("break", UP), ("touch", y))
    none(false, f"in space, mu = 0, touch with yF /= 0, {y}", first_row(1, 0, 0, law=0, b=[-1, *(-x for x in y[1:])]),
         ("break", UP), ("touch", y))
none(false, "in space, touch is not covered", first_row(1, 0, 0), ("break", UP))
none(false, "in space, a prefix twice", first_row(1, 0, 0), ("break", UP), ("break", [2, 0, 0]))
none(false, "in space, modes of the plane", first_row(0, 0, 0),
     ("break", UP), ("stick", UP), ("slip+", UP), ("slip-", UP))
SLANTED = ("1/2", ["3/5", "4/5"])
none(true, "in space, sliding, gN = mu slip.gF", first_row(1, 2, 1, law=SLANTED), ("", UP))
none(false, "in space, sliding, the slip turned round", first_row(1, -2, -1, law=SLANTED), ("", UP))
none(false, "in space, sliding, by the first tangent alone", first_row(1, "10/3", -5, law=SLANTED), ("", UP))
none(false, "in space, sliding, by the second tangent alone", first_row(1, -5, "5/2", law=SLANTED), ("", UP))
none(false, "in space, sliding, touch with yF /= 0", first_row(1, 0, 0, law=SLANTED, b=(-1, -1, 0)),
     ("break", UP), ("touch", [0, 1, 0]))
HELD = [[0] * 4 for _ in range(4)]
none(true, "in space, a bilateral contact before the one that nothing pushes", problem(["hold", 1], HELD, [0, -1, 0, 0], 3),
     ("hold", [0, 1, 0, 0]))
none(true, "in space, a bilateral contact that nothing moves", problem(["hold", 1], HELD, [-1, 0, 0, 0], 3),
     ("hold break", [1, 0, 0, 0]), ("hold touch", [1, 0, 0, 0]))
none(false, "in space, a bilateral contact before, then yF /= 0", problem(["hold", 1], HELD, [0, 0, -1, 0], 3),
     ("", [0, 0, 1, 0]))
none(false, "in space, a bilateral contact before, then yF /= 0, the last", problem(["hold", 1], HELD, [0, 0, 0, -1], 3),
     ("", [0, 0, 0, 1]))
for pull in (1, -1):
    none(false, f"in space, hold with gN = {pull}", problem(["hold", 1], [[pull, 0, 0, 0], *HELD[1:]], [-1, 0, 0, 0], 3),
         ("", [1, 0, 0, 0]))

# (H) fails, and f = 0 is a solution: the contact slips with no force at all.
for rows in (2, 3):
    DRAWN = problem([1], [[1, 1, 0], [1, 1, 0], [0, 0, 1]], [0, 1, 0], 3) if rows == 3 else \
        problem([1], [[1, 1], [1, 1]], [0, 1])
    KERNEL_OF_IT = [1, -1, 0][:rows]
    true("not-h", f"of a problem with a solution, {rows} rows", DRAWN, v=texts(KERNEL_OF_IT), value="-1")
    true_solution(f"where (H) fails, {rows} rows", DRAWN, [0] * rows)
    none(false, f"(H) fails, and there is a solution, {rows} rows", DRAWN, ("", KERNEL_OF_IT))
    none(false, f"(H) fails, and there is a solution, by its modes, {rows} rows", DRAWN,
         *((mode, KERNEL_OF_IT) for mode in (("break", "touch") if rows == 3 else ("break", "stick", "slip+", "slip-"))))

# --- safe, unsafe, safe-by-condition -------------------------------------------------

COUPLED = [[1, 2], [2, 5]]  # slip+: 1 - 2 mu, slip-: 1 + 2 mu, stick: 1
true("safe", "all positive", problem(["2/5"], COUPLED, [0, 0]), determinants=texts([1, 1, "1/5", "9/5"]))
false("safe", "a determinant of zero", problem(["1/2"], COUPLED, [0, 0]), determinants=texts([1, 1, 0, 2]))
false("safe", "a negative determinant", problem([1], COUPLED, [0, 0]), determinants=texts([1, 1, -1, 3]))
false("safe", "a negative determinant, stated positive", problem([1], COUPLED, [0, 0]),
      determinants=texts([1, 1, 1, 3]))
false("safe", "a negative determinant left out", problem([1], COUPLED, [0, 0]), determinants=texts([1, 1, 3]))
false("safe", "a number too many", problem(["2/5"], COUPLED, [0, 0]), determinants=texts([1, 1, "1/5", "9/5", 1]))
false("safe", "slips exchanged", problem(["2/5"], COUPLED, [0, 0]), determinants=texts([1, 1, "9/5", "1/5"]))
false("safe", "stick is singular", problem(["1/4"], [[1, 2], [2, 4]], [0, 0]), determinants=texts([1, 0, "1/2", "3/2"]))
false("safe", "stick is negative", problem(["1/4"], [[1, 2], [2, 1]], [0, 0]),
      determinants=texts([1, -3, "1/2", "3/2"]))
false("safe", "a sliding contact", problem([("1/4", "1")], COUPLED, [0, 0]), determinants=texts([1, "1/2"]))
false("safe", "a sliding contact, without its friction", problem([("1/4", "1")], COUPLED, [0, 0]),
      determinants=texts([1, 1]))
false("safe", "a bilateral contact", problem(["hold"], [[1]], [0]), determinants=texts([1]))
false("safe", "two contacts, the last word", smooth([[1, 1], [1, 1]], [0, 0]), determinants=texts([1, 1, 1, 0]))

true("unsafe", "a negative determinant", problem([1], COUPLED, [0, 0]), word=["slip+"], determinant="-1")
true("unsafe", "a determinant of zero", problem(["1/2"], COUPLED, [0, 0]), word=["slip+"], determinant="0")
for mode, value in (("break", 1), ("stick", 1), ("slip+", "1/5"), ("slip-", "9/5")):
    false("unsafe", f"{mode} is positive", problem(["2/5"], COUPLED, [0, 0]), word=[mode], determinant=str(value))
    false("unsafe", f"{mode} is positive, stated negative", problem(["2/5"], COUPLED, [0, 0]),
          word=[mode], determinant="-" + str(value))
    false("unsafe", f"{mode} is positive, stated zero", problem(["2/5"], COUPLED, [0, 0]),
          word=[mode], determinant="0")
false("unsafe", "the determinant of the other slip", problem([1], COUPLED, [0, 0]), word=["slip-"], determinant="-1")
false("unsafe", "a word for fewer contacts", smooth([[-1, 0], [0, 1]], [0, 0]), word=["touch"], determinant="-1")
false("unsafe", "a mode of another kind", smooth([[-1]], [0]), word=["slip+"], determinant="-1")


def by_condition(kind, what, of, scaling, least, most):
    kind("safe-by-condition", what, of, scaling=texts(scaling), least=str(least), most=str(most))


ONE_SIXTH = Fraction(1, 6)  # the eigenvalues of COUPLED are 3 -+ 2 sqrt(2)
by_condition(true, "no friction to speak of", problem(["1/4"], COUPLED, [0, 0]), [1, 1], ONE_SIXTH, 6)
by_condition(false, "m^2 (u - l)^2 > 4 u l", problem([1], COUPLED, [0, 0]), [1, 1], ONE_SIXTH, 6)
by_condition(false, "m^2 (u - l)^2 = 4 u l", problem(["4/3"], [[1, 0], [0, 4]], [0, 0]), [1, 1], 1, 4)
by_condition(false, "least is above an eigenvalue", problem([1], COUPLED, [0, 0]), [1, 1], 2, 6)
by_condition(false, "most is below an eigenvalue", problem([1], COUPLED, [0, 0]), [1, 1], ONE_SIXTH, Fraction(1, 2))
by_condition(false, "least is negative", problem([0], COUPLED, [0, 0]), [1, 1], -1, 6)
by_condition(false, "least is zero", problem([0], COUPLED, [0, 0]), [1, 1], 0, 6)
for scaling in ([1, -1], [-1, 1], [1, 0], [0, 1], [-1, -1]):
    by_condition(false, f"the scaling {scaling}", problem([1], COUPLED, [0, 0]), scaling, ONE_SIXTH, 6)
# m is dN / dF mu, not its inverse: D = (1, 1/2) makes DAD = [[1, 1], [1, 5/4]], eigenvalues 0.117 to 2.14.
by_condition(false, "m upside down", problem([1], COUPLED, [0, 0]), [1, Fraction(1, 2)], Fraction(1, 9), Fraction(9, 4))
by_condition(false, "A is not symmetric", problem([1], [[1, 2], [-2, 1]], [0, 0]), [1, 1], 1, 1)
by_condition(false, "a sliding contact", problem([("1/4", "1")], IDENTITY, [0, 0]), [1, 1], 1, 1)
by_condition(false, "a bilateral contact", problem(["hold"], [[1]], [0]), [1], 1, 1)
by_condition(false, "the second contact has the friction",
             problem([0, 1], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 2, 5]], [0] * 4),
             [1, 1, 1, 1], ONE_SIXTH, 6)
by_condition(false, "the first contact has the friction",
             problem([1, 0], [[1, 2, 0, 0], [2, 5, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], [0] * 4),
             [1, 1, 1, 1], ONE_SIXTH, 6)

# --- A bilateral contact, of one row in space too, before another -----------------------

def behind_a_hinge(b, A=None):
    return problem(["hold", 1], A or [[0] * 4 for _ in range(4)], b, 3)


true("h", "in space, behind a bilateral contact", behind_a_hinge([0, 5, 3, -4]), y=texts([0] * 4))
false("h", "in space, behind a bilateral contact, outside of the dual cone", behind_a_hinge([0, 4, 3, -3]), y=texts([0] * 4))
false("h", "in space, at a bilateral contact", behind_a_hinge([1, 5, 3, -4]), y=texts([0] * 4))
true("not-h", "in space, behind a bilateral contact", behind_a_hinge([0, 0, -1, 0]), v=texts([-1, 5, 3, -4]), value="-3")
false("not-h", "in space, behind a bilateral contact, outside of the cone", behind_a_hinge([0, 0, -1, 0]),
      v=texts([9, 4, 3, -3]), value="-3")
for claim, more in (("solution-exists", {}), ("coulomb-solution", {"bound": "1"})):
    def hinged(how, what, f, a):
        how(claim, f"in space, behind a bilateral contact: {what}", behind_a_hinge(a), f=texts(f), a=texts(a), **more)

    hinged(true, "slips at the edge of its cone", [-2, 5, 3, -4], [0, 0, -3, 4])
    hinged(false, "slips within its cone", [5, 5, 3, -3], [0, 0, -3, 3])
    hinged(false, "outside of its cone", [5, 4, 3, -4], [0, 0, 0, 0])
    hinged(false, "friction drives", [5, 5, 3, -4], [0, 0, 3, -4])
    hinged(false, "pulls", [5, -1, 0, 0], [0, 0, 0, 0])
    hinged(false, "penetrates", [0, 0, 0, 0], [0, -1, 0, 0])
    hinged(false, "both fN and aN", [0, 1, 0, 0], [0, 1, 0, 0])
    hinged(false, "the bilateral contact parts", [0, 0, 0, 0], [1, 0, 0, 0])
SUPPORT = [[0] * 4, [0, 1, 0, 0], [0] * 4, [0] * 4]
true("no-solution", "in space, of a bilateral contact before another", behind_a_hinge([1, -1, 0, 0], SUPPORT),
     prefixes=[{"modes": [], "y": texts([-1, 0, 0, 0])}])
false("no-solution", "in space, of a contact behind a bilateral one", behind_a_hinge([0, -1, 0, 0], SUPPORT),
      prefixes=[{"modes": [], "y": texts([0, 1, 0, 0])}])
false("no-solution", "in space, by the friction of a contact behind a bilateral one", behind_a_hinge([0, 0, -1, 0]),
      prefixes=[{"modes": [], "y": texts([0, 0, 1, 0])}])

# --- psd, in-range, h, exists by factors -----------------------------------------------


def factors(J, M, w, c=None, **changes):
    listed = [[i, j, str(x)] for i, row in enumerate(J) for j, x in enumerate(row) if x]
    stated = {"J": {"size": [len(J), len(J[0])], "entries": listed}, "M": texts(M), "w": texts(w)}
    return {**stated, **({} if c is None else {"c": texts(c)}), **changes}


JACOBIAN, MASSES, FREE = [[1, 0], [1, 1]], [2, 4], [-2, 4]
FACTORED = [["1/2", "1/2"], ["1/2", "3/4"]]
GIVEN = factors(JACOBIAN, MASSES, FREE)
IN_RANGE, IN_CONE, OUTSIDE = ([x + y for x, y in zip((-2, 2), c)] for c in ((0, 0), (1, -1), (1, 2)))
for claim in ("psd", "in-range", "h", "exists"):
    def true_by(what, b, **witness):
        true(claim, f"by factors, {what}", problem([1], FACTORED, b), **witness)

    def false_by(what, A=FACTORED, b=IN_RANGE, laws=(1,), **witness):
        false(claim, f"by factors, {what}", problem(list(laws), A, b), **{"factors": GIVEN, **witness})

    true_by("c = 0", IN_RANGE, factors=GIVEN)
    true_by("M in one block", IN_RANGE, factors=factors(JACOBIAN, [[[2, 0], [0, 4]]], FREE))
    true(claim, "by factors, of a block whose velocities act on each other", problem([1], [[2, -1], [-1, 1]], [-2, 4]),
         factors=factors(IDENTITY, [[[1, 1], [1, 2]]], FREE))
    true(claim, "by factors, of as many blocks as J has entries", problem([1], [["1/2", 0], [0, "1/4"]], [-2, 4]),
         factors=factors(IDENTITY, MASSES, FREE))
    false(claim, "by factors, the inverse without what couples them", problem([1], [[1, 0], [0, "1/2"]], [-2, 4]),
          factors=factors(IDENTITY, [[[1, 1], [1, 2]]], FREE))
    if claim != "in-range":
        true_by("c in K*", IN_CONE, factors=factors(JACOBIAN, MASSES, FREE, (1, -1)))
    for i in range(2):
        for j in range(2):
            other = [list(row) for row in FACTORED]
            other[i][j] = "5/8"
            false_by(f"A_{i}{j} is another", A=other)
        false_by(f"b_{i} is another", b=[x + (k == i) for k, x in enumerate(IN_RANGE)])
    beside = [[*row, 0] for row in JACOBIAN]
    true_by("a velocity that no row touches, in a block with one that is touched", IN_RANGE,
            factors=factors(beside, [2, [[4, 0], [0, 1]]], [*FREE, 9]))
    false_by("a velocity that no row touches", factors=factors(beside, [*MASSES, 1], [*FREE, 9]))
    false_by("a velocity of which an entry that is zero is listed",
             factors={**factors(beside, [*MASSES, 1], [*FREE, 9]), "J": {"size": [2, 3], "entries": [
                 [0, 0, "1"], [1, 0, "1"], [1, 1, "1"], [0, 2, "0"]]}})
    false_by("a negative mass", A=[["-1/2", "-1/2"], ["-1/2", "-1/4"]], factors=factors(JACOBIAN, [-2, 4], FREE))
    false_by("a block that is not definite", A=[["-1/3", "2/3"], ["2/3", "-1/3"]], b=FREE,
             factors=factors(IDENTITY, [[[1, 2], [2, 1]]], FREE))
    false_by("a block whose second diagonal is negative", A=[[1, 0], [0, -1]], b=FREE,
             factors=factors(IDENTITY, [[[1, 0], [0, -1]]], FREE))
    for what, A in (("", [[1, -1], [0, 1]]), (", A its transposed inverse", [[1, 0], [-1, 1]])):
        false_by("a block that is not symmetric" + what, A=A, b=FREE, factors=factors(IDENTITY, [[[1, 1], [0, 1]]], FREE))
    false_by("a mass of zero", factors=factors(JACOBIAN, [2, 0], FREE))
    false_by("a velocity without a mass", factors=factors(JACOBIAN, [2], [-2]))
    false_by("a mass without a velocity", factors=factors(JACOBIAN, [*MASSES, 1], [*FREE, 0]))
    false_by("J of another number of rows", factors=factors([*JACOBIAN, [0, 0]], MASSES, FREE))
    false_by("w too short", factors=factors(JACOBIAN, MASSES, FREE[:1]))
    false_by("c too short", factors=factors(JACOBIAN, MASSES, FREE, (0,)))
    for what, entries in (("an entry twice", [[0, 0, "1"], [1, 0, "1"], [1, 1, "1"], [1, 1, "1"]]),
                          ("no such column", [[0, 0, "1"], [1, 0, "1"], [1, 2, "1"]]),
                          ("a negative row", [[0, 0, "1"], [-1, 0, "1"], [1, 1, "1"]]),
                          ("a number that is no text", [[0, 0, 1], [1, 0, "1"], [1, 1, "1"]])):
        false_by(what, factors={**GIVEN, "J": {"size": [2, 2], "entries": entries}})
    false_by("J in rows", factors={**GIVEN, "J": texts(JACOBIAN)})
    false_by("a key that is none", factors={**GIVEN, "W": texts(MASSES)})
    false_by("no w", factors={"J": GIVEN["J"], "M": GIVEN["M"]})
    false_by("another witness beside", x=texts([0, 0]))
    if claim == "in-range":
        false_by("c is not zero", b=IN_CONE, factors=factors(JACOBIAN, MASSES, FREE, (1, -1)))
    if claim in ("h", "exists"):
        false_by("c outside of K*", b=OUTSIDE, factors=factors(JACOBIAN, MASSES, FREE, (1, 2)))
        false_by("c of a bilateral contact", laws=("hold", None), b=[-1, 2], factors=factors(JACOBIAN, MASSES, FREE, (1, 0)))
        false_by("a negative c", laws=(None, None), b=[-2, 1], factors=factors(JACOBIAN, MASSES, FREE, (0, -1)))
        false_by("a contact that slides", laws=((1, "1"),))

# --- exists: psd and h together ------------------------------------------------------

def without_forces():
    """What is claimed of `psd`, beside a y that shows (H) since b = 0; of `h`, beside L and D of A = 0."""
    for how, entries in ((true, TRUE), (false, FALSE)):
        for name, entry in list(entries):
            of, witness, n = entry["problem"], entry["witness"], len(entry["problem"]["b"])
            if "factors" in witness:
                continue
            if entry["claim"] == "psd":
                how("exists", name, of, **witness, y=texts([0] * n))
            if entry["claim"] == "h" and of["A"] == texts([[0] * n] * n):
                how("exists", name, of, **witness, L=texts([[int(i == j) for j in range(n)] for i in range(n)]),
                    D=texts([0] * n))


without_forces()
ROD = [["8/5", "6/5"], ["6/5", "17/5"]]
BOTH = {"L": texts([[1, 0], ["3/4", 1]]), "D": texts(["8/5", "5/2"]), "y": texts([Fraction(-17, 2), 3])}
true("exists", "a rod that may stick", problem([2], ROD, ["-10", "0"]), **BOTH)
false("exists", "a rod that slides, which has no solution", problem([("2", "1")], ROD, ["-10", "0"]), **BOTH)
WEDGE = problem([1], [[1, -1], [-1, 1]], [-1, 0])
for y in ([0, 0], [-1, 0], [0, 1], [Fraction(-1, 2), Fraction(1, 2)]):
    false("exists", f"a wedge without a solution, y = {texts(y)}", WEDGE, L=texts([[1, 0], [-1, 1]]), D=texts([1, 0]), y=texts(y))
DRAWN = {"L": texts([[1, 0], [1, 1]]), "D": texts([1, 0])}
true("exists", "b outside of range(A)", problem([1], [[1, 1], [1, 1]], [1, 0]), **DRAWN, y=texts([0, 0]))
false("exists", "(H) fails", problem([1], [[1, 1], [1, 1]], [0, 1]), **DRAWN, y=texts([0, 0]))
false("exists", "A of another sign", problem([1], [[1, 1], [1, -1]], [1, 0]), **DRAWN, y=texts([0, 0]))
false("exists", "D of psd alone, no y that fits", problem([1], IDENTITY, [-1, 0]), L=texts(IDENTITY), D=texts([1, 1]), y=texts([0, 0]))
false("exists", "y of h alone, no D that fits", problem([1], IDENTITY, [-1, 0]), L=texts(IDENTITY), D=texts([1, 0]), y=texts([-1, 0]))

# --- cycle -------------------------------------------------------------------------

CYCLING = problem([1, 1], [[7, -2, -6, 0], [-2, 9, -1, -7], [-6, -1, 7, 3], [0, -7, 3, 7]], [2, -1, -2, 2])
STEPS = """1 N2 establish 2/7 N2 none C
2 F2 establish 1/2 F2 none CF
3 N1 establish 10/7 N1 none C
4 F1 establish 6/5 F2 CF NC-
4 F1 establish 0 F2 NC- none
4 F1 establish 39/290 F1 none CF
5 F2 zero 791/310 F1 CF NC+
5 F2 zero 0 F1 NC+ none
5 F2 zero 3/62 F2 none none
6 F1 zero 19/310 N1 C NC
6 F1 zero 1/10 F1 none none
7 F2 establish 1/9 N1 NC C
7 F2 establish 65/63 F2 none CF"""
STATE = {"sets": {"N1": "C", "F1": "none", "N2": "C", "F2": "CF"}, "f": ["10/7", "0", "2", "-8/7"]}


def pivots(count=13, steps=STEPS):
    keys = ("drive", "driven", "goal", "step", "limiting", "from", "to")
    return [dict(zip(keys, (int(line.split()[0]), *line.split()[1:])))
            for line in steps.splitlines()[:count]]


def run(policies, start=3, period=4, count=13, state=None):
    return {"policies": policies, "start": start, "period": period, "pivots": pivots(count), "state": state or STATE}


true("cycle", "the reference problem", CYCLING, runs=[run(["paper"])])
true("cycle", "under two policies", CYCLING, runs=[run(["paper", "ties=contacts"])])
false("cycle", "a policy that solves the problem", CYCLING, runs=[run(["file=yes,drop=variable"])])
false("cycle", "a policy that solves it, behind one that cycles", CYCLING,
      runs=[run(["paper", "file=yes,drop=variable"])])
false("cycle", "a problem that is solved", {**CYCLING, "b": texts([2, 1, 2, 2])}, runs=[run(["paper"])])
END = {"sets": {"N1": "C"}, "f": ["1"]}
for start, period in ((None, None), (0, 1), (1, 1), (1, 0)):
    false("cycle", f"a run that ends at a solution, start {start}, period {period}", smooth([[1]], [-1]),
          runs=[{"policies": ["paper"], "start": start, "period": period, "pivots": pivots(1, "1 N1 establish 1 N1 none C"),
                 "state": END}])
false("cycle", "the friction of another problem", {**CYCLING, "contacts": [contact(1), contact(2)]},
      runs=[run(["paper"])])
false("cycle", "a run that has not come back yet", CYCLING,
      runs=[run(["paper"], start=3, period=3, count=11)])
false("cycle", "a run without its last step", CYCLING, runs=[run(["paper"], count=12)])
false("cycle", "a run with a step too many", CYCLING,
      runs=[{**run(["paper"]), "pivots": pivots() + pivots()[-1:]}])
false("cycle", "no runs", CYCLING, runs=[])

# Without friction a contact has one row in the plane and in space, and the run would be the same.
SMOOTH_STEPS = """1 N1 establish 3 N1 none C
2 N4 establish 1 N1 C NC
2 N4 establish 1 N4 none C
3 N3 establish 1/2 N1 NC C
3 N3 establish 7/18 N4 C NC
3 N3 establish 1/9 N1 C NC
3 N3 establish 1 N3 none C
4 N2 establish 3/11 N1 NC C
4 N2 establish 0 N1 C none
4 N2 establish 13/33 N3 C NC
4 N2 establish 4/3 N2 none C
5 N1 establish 4/11 N4 NC C
5 N1 establish 0 N4 C none
5 N1 establish 10/33 N2 C NC
5 N1 establish 7/3 N1 none C
6 N4 establish 7/11 N3 NC C
6 N4 establish 0 N3 C none
6 N4 establish 4/11 N1 C NC
6 N4 establish 1 N4 none C
7 N3 establish 4/11 N2 NC C
7 N3 establish 0 N2 C none
7 N3 establish 3/22 N1 NC C
7 N3 establish 7/18 N4 C NC
7 N3 establish 1/9 N1 C NC
7 N3 establish 1 N3 none C"""
SMOOTH_RUN = {"policies": ["paper"], "start": 3, "period": 4, "pivots": pivots(None, SMOOTH_STEPS),
              "state": {"sets": {"N1": "NC", "N2": "none", "N3": "C", "N4": "NC"}, "f": ["0", "0", "2", "0"]}}
for dimension, claim in ((2, true), (3, false)):
    claim("cycle", f"without friction, in dimension {dimension}",
          problem([None] * 4, [[1, -2, 3, 3], [3, 1, -2, 3], [3, 3, 1, -2], [-2, 3, 3, 1]], [-3, -2, -2, -2], dimension),
          runs=[SMOOTH_RUN])
false("cycle", "a run of no policy", CYCLING, runs=[run([])])
false("cycle", "a policy twice", CYCLING, runs=[run(["paper", "paper"])])
false("cycle", "a run twice", CYCLING, runs=[run(["paper"]), run(["ties=contacts"])])
false("cycle", "a policy of space", CYCLING, runs=[run(["slip=redirect"])])
false("cycle", "a policy with its defaults written", CYCLING, runs=[run(["ties=sets"])])
false("cycle", "another start", CYCLING, runs=[run(["paper"], start=2)])
false("cycle", "another period", CYCLING, runs=[run(["paper"], period=8)])
false("cycle", "the state of another moment", CYCLING,
      runs=[run(["paper"], state={**STATE, "f": ["10/7", "0", "2", "-1"]})])
false("cycle", "other sets", CYCLING,
      runs=[run(["paper"], state={**STATE, "sets": {**STATE["sets"], "F2": "none"}})])
false("cycle", "a state with a contact that is not remembered", CYCLING,
      runs=[run(["paper"], state={**STATE, "contact": 1})])

OTHER = {"drive": 6, "driven": "F1", "goal": "establish", "step": "1/5", "limiting": "N2", "from": "NC", "to": "C"}
for key, value in OTHER.items():  # of the step that ends 5 F2 zero 3/62 F2 none none
    told = run(["paper"])
    told["pivots"][8][key] = value
    false("cycle", f"a step with another {key}", CYCLING, runs=[told])

# A third contact, without friction, that nothing moves and nothing pushes.
BESIDE = problem([1, 1, None], [[*row, 0] for row in CYCLING["A"]] + [[0] * 5], [*CYCLING["b"], 0])
IDLE = {"sets": {**STATE["sets"], "N3": "none"}, "f": [*STATE["f"], "0"]}
true("cycle", "beside a contact at rest", BESIDE, runs=[run(["paper"], state=IDLE)])

# --- counterexample ------------------------------------------------------------------


def factors(A):
    """L and D of A = L diag(D) L', of an A whose leading minors are positive, but for the last."""
    n, D = len(A), []
    S, L = [[Fraction(x) for x in row] for row in A], [[Fraction(i == j) for j in range(n)] for i in range(n)]
    for k in range(n):
        D.append(S[k][k])
        for i in range(k + 1, n):
            L[i][k] = S[i][k] / D[k]
            S[i] = [x - L[i][k] * y for x, y in zip(S[i], S[k])]
    return {"L": texts(L), "D": texts(D)}


def counterexample(kind, what, of, runs, f=(1, Fraction(-6, 7), Fraction(25, 14), Fraction(-25, 14)), **changes):
    witness = {**factors(of["A"]), "runs": runs, **changes}
    solution(kind, what, of, f, claim="counterexample", **witness)


LARGER = {**CYCLING, "A": texts([[8, -2, -6, 0], [-2, 9, -1, -7], [-6, -1, 7, 3], [0, -7, 3, 7]])}
counterexample(true, "the reference problem", CYCLING, [run(["paper"])])
counterexample(false, "f is no solution", CYCLING, [run(["paper"])], f=(1, Fraction(-6, 7), Fraction(25, 14), -2))
counterexample(false, "f is where the cycle stands", CYCLING, [run(["paper"])],
               f=(Fraction(10, 7), 0, 2, Fraction(-8, 7)))
counterexample(false, "the factors are those of another matrix", CYCLING, [run(["paper"])], **factors(LARGER["A"]))
counterexample(false, "a policy that solves the problem", CYCLING, [run(["file=yes,drop=variable"])])
counterexample(false, "a run that has not come back yet", CYCLING, [run(["paper"], start=3, period=3, count=11)])
counterexample(false, "no runs", CYCLING, [])
counterexample(false, "a is not A f + b, and would do", CYCLING, [run(["paper"])],
               f=(Fraction(10, 7), 0, 2, Fraction(-8, 7)), a=[0, 0, 0, 0])
counterexample(false, "A is semidefinite", BESIDE, [run(["paper"], state=IDLE)],
               f=(1, Fraction(-6, 7), Fraction(25, 14), Fraction(-25, 14), 0))

# --- The form of certificates ------------------------------------------------------


def altered(**changes):
    return {**certificate("symmetric", smooth([[1]], [0]), {}), **changes}


FALSE += [
    ("form: another format", altered(format="stiction-problem")),
    ("form: another version", altered(version=2)),
    ("form: a version that is no integer", altered(version=1.0)),
    ("form: a version that is true", altered(version=True)),
    ("form: an unknown claim", altered(claim="symmetrical")),
    ("form: a key too many", altered(note="true")),
    ("form: a witness with a key too many", altered(witness={"x": ["1"]})),
    ("form: a problem with a name", altered(problem={**smooth([[1]], [0]), "name": "one"})),
    ("form: a problem with numbers that are no texts", altered(problem={**smooth([[1]], [0]), "b": [0]})),
    *((f"form: a problem with digits of another alphabet, {number!r}", altered(problem=smooth([[number]], [0])))
      for number in ("\u0661", "1/\u0662", "\u0661/2")),
    ("form: a problem with a denominator of zero", altered(problem=smooth([["1/0"]], [0]))),
    ("form: a problem with friction at a frictionless contact",
     altered(problem={**smooth([[1]], [0]), "contacts": [{"kind": "frictionless", "mu": "1"}]})),
    ("form: a problem with a negative mu", altered(problem=problem([-1], IDENTITY, [0, 0]))),
    ("form: a problem with rows for another contact", altered(problem=problem([1], [[1]], [0]))),
    ("form: a problem with a slip that is no unit",
     altered(problem=problem([("1", ["1", "1"])], UNIT, [0, 0, 0], 3))),
    *((f"form: entries {what}", altered(problem={**smooth(IDENTITY, [0, 0]), "A": {"size": 2, "entries": entries}}))
      for what, entries in (("with one twice", [[1, 0, "1"], [1, 0, "1"]]), ("above the diagonal alone", [[0, 1, "1"]]))),
]

if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
