#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The families of search/adversary/frontiers.md, 3 and 4: the published algorithm loops for every small parameter;
and 5: it runs for ever and never repeats a state.

The independent runner (certify/check_runs.py) runs them over the field of rational functions of the parameter e,
ordered by their signs for all small e > 0. A decision there is the decision for all e in some interval (0, e0), and so
are finitely many of them: a loop over the field is one for every such e.

    families_test.py PROGRAM ROOT
"""

import json
import sys
import unittest
from fractions import Fraction
from functools import total_ordering
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(sys.argv[2])
sys.path.insert(0, str(ROOT / "certify"))

import check_runs  # noqa: E402


def trimmed(p):
    p = list(p)
    while p and p[-1] == 0:
        p.pop()
    return tuple(p)


def plus(p, q, sign=1):
    size = max(len(p), len(q))
    return trimmed((p[i] if i < len(p) else 0) + sign * (q[i] if i < len(q) else 0) for i in range(size))


def product(p, q):
    r = [Fraction(0)] * (len(p) + len(q))
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            r[i + j] += x * y
    return trimmed(r)


def divided(p, q):
    """Quotient and remainder of polynomials, coefficients from the constant up."""
    p, quotient = list(p), [Fraction(0)] * max(len(p) - len(q) + 1, 0)
    for k in reversed(range(len(quotient))):
        quotient[k] = p[k + len(q) - 1] / q[-1]
        for i, y in enumerate(q):
            p[k + i] -= quotient[k] * y
    return trimmed(quotient), trimmed(p)


def common(p, q):
    while q:
        p, q = q, divided(p, q)[1]
    return p


@total_ordering
class Function:
    """p(e) / q(e) in lowest terms, q with leading coefficient 1; positive if it is so for all small e > 0."""

    def __init__(self, p, q=(Fraction(1),)):
        p, q = trimmed(p), trimmed(q)
        divisor = common(p, q) if p else q
        p, q = divided(p, divisor)[0], divided(q, divisor)[0]
        self.p, self.q = tuple(x / q[-1] for x in p), tuple(x / q[-1] for x in q)

    @staticmethod
    def of(x):
        return x if isinstance(x, Function) else Function((Fraction(x),))

    def sign(self):
        if not self.p:
            return 0
        lowest = [next(x for x in part if x) for part in (self.p, self.q)]
        return 1 if lowest[0] * lowest[1] > 0 else -1

    def __add__(self, other):
        other = Function.of(other)
        return Function(plus(product(self.p, other.q), product(other.p, self.q)), product(self.q, other.q))

    def __neg__(self):
        return Function(tuple(-x for x in self.p), self.q)

    def __sub__(self, other):
        return self + -Function.of(other)

    def __rsub__(self, other):
        return Function.of(other) - self

    def __mul__(self, other):
        other = Function.of(other)
        return Function(product(self.p, other.p), product(self.q, other.q))

    def __truediv__(self, other):
        other = Function.of(other)
        return Function(product(self.p, other.q), product(self.q, other.p))

    def __rtruediv__(self, other):
        return Function.of(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __abs__(self):
        return self if self.sign() >= 0 else -self

    def __bool__(self):
        return bool(self.p)

    def __eq__(self, other):
        return not (self - other).p

    def __lt__(self, other):
        return (self - other).sign() < 0

    def __hash__(self):
        return hash(self.p[0]) if len(self.p) == 1 and self.q == (1,) else hash((self.p, self.q)) if self.p else hash(0)

    def at(self, e):
        value = [sum((x * e ** i for i, x in enumerate(part)), Fraction(0)) for part in (self.p, self.q)]
        return value[0] / value[1]


E = Function((Fraction(0), Fraction(1)))


class Rows(check_runs.Rows):
    def __init__(self, A, b, mu):
        self.A, self.b, self.contacts, self.held, self.sliding = A, b, len(b) // 2, [], {}
        self.variables = [check_runs.Variable(f"{letter}{i + 1}", i, 2 * i, 2 * i + 1, mu)
                          for i in range(self.contacts) for letter in "NF"]


def run(A, b, mu, policy="paper"):
    def bounded(made):
        if len(made) > 200:
            raise check_runs.Ended("limit")

    return check_runs.run(Rows(A, b, mu), policy, bounded)


def word_of(steps):
    return [(step["driven"], step["goal"], step["limiting"], step["from"], step["to"]) for step in steps]


def word(found):
    return [(step["drive"], step["driven"], step["limiting"], step["from"], step["to"]) for step in found.pivots]


def crosses(found):
    """Whether friction goes from one limit through CF to the other within a drive: that can differ in space."""
    left = {}
    for step in found.pivots:
        place = step["drive"], step["limiting"]
        if step["from"] in ("NC-", "NC+"):
            left[place] = step["from"]
        if step["to"] in ("NC-", "NC+") and left.get(place, step["to"]) != step["to"]:
            return True
    return False


def mirrored(A, b, mu):
    """With every tangent reversed."""
    sign = lambda i, k=0: -1 if (i + k) % 2 else 1
    return [[sign(i, k) * x for k, x in enumerate(row)] for i, row in enumerate(A)], [sign(i) * x for i, x in enumerate(b)], mu


def word_mirrored(found):
    other = {"NC-": "NC+", "NC+": "NC-"}
    return [(*step[:3], *(other.get(place, place) for place in step[3:])) for step in word(found)]


def near_the_bound(mu, e):
    """Part 4, friction forces in units of mu."""
    h, k, one, zero = 2 + mu * mu, 2 * (1 + mu * mu), 1 + e, 0 * e
    return [[1 + zero, one, zero, k * e], [one, h + zero, -(k * e), zero],
            [zero, -(k * e), 1 + zero, one], [k * e, zero, one, h + zero]], [e, 1 + zero, -e, 1 + zero], 1 + zero


def one_body(e):
    """Part 3 with friction and radius of inertia e: rows of J over the root of the masses."""
    contacts = [((Fraction(-24, 25), Fraction(7, 25)), 6, -6), ((Fraction(-4, 5), Fraction(3, 5)), 1, -5)]
    J = []
    for (nx, ny), along, across in contacts:
        J += [[nx, ny, along], [-ny, nx, across / e]]
    dot = lambda x, y: sum((u * v for u, v in zip(x, y)), 0 * e)
    return [[dot(x, y) for y in J] for x in J], [dot(x, (4, 0, 1)) for x in J], e


class Families(unittest.TestCase):
    def loops(self, problem, start, period):
        symbolic = run(*problem(E))
        self.assertEqual((symbolic.outcome, symbolic.start, symbolic.period), ("cycle", start, period))
        self.assertFalse(crosses(symbolic))
        self.assertEqual(word_mirrored(run(*mirrored(*problem(E)))), word(symbolic))  # no tie of NC- with NC+
        for k in (8, 12, 40):  # and at numbers
            e = Fraction(1, 10 ** k)
            A, b, mu = problem(E)
            found = run([[Function.of(x).at(e) for x in row] for row in A], [Function.of(x).at(e) for x in b],
                        Function.of(mu).at(e))
            self.assertEqual((found.outcome, found.start, found.period), ("cycle", start, period))
            self.assertEqual(word(found), word(symbolic))

    def test_two_contacts_near_the_bound_of_the_condition_number(self):
        for mu in (Fraction(1, 100), Fraction(1, 10), Fraction(1), Fraction(7, 2)):
            with self.subTest(mu=mu):
                self.loops(lambda e: near_the_bound(mu, e), 3, 4)

    def test_one_body_at_any_low_friction(self):
        self.loops(one_body, 2, 5)

    def test_the_field_is_ordered(self):
        self.assertTrue(0 < E < Fraction(1, 10 ** 9) < 1 / E)
        self.assertEqual((E * E - 1) / (E - 1), E + 1)
        self.assertEqual(hash(E - E), hash(Fraction(0)))
        self.assertTrue(-E < 0 and not E < E and abs(-E) == E)
        self.assertEqual(((E + 2) / (1 - E)).at(Fraction(1, 2)), 5)

    def test_what_does_not_loop_is_told(self):
        A, b, mu = near_the_bound(Fraction(1), E)
        weaker = [[x / 2 if i // 2 != j // 2 else x for j, x in enumerate(row)] for i, row in enumerate(A)]
        self.assertEqual(run(weaker, b, mu).outcome, "solved")


class State:
    """Of the outer loop: sets, forces, and what the scan remembers."""

    def __init__(self, run):
        self.sets, self.f, self.last, self.steps = list(run.sets), list(run.f), run.last, len(run.steps)
        self.seen = (tuple(run.sets), run.remembered())


class Outer:
    """Runs of one problem under one policy, an outer scan at a time."""

    def __init__(self, A, b, mu, policy):
        self.A, self.b, self.mu, self.policy = A, b, mu, check_runs.read_policy(policy)

    def begin(self, of=Fraction):
        rows = Rows([[of(x) for x in row] for row in self.A], [of(x) for x in self.b], self.mu)
        return check_runs.Published(rows, self.policy, lambda made: None)

    def begin_at(self, state, f):
        run = self.begin(Function.of)
        run.sets, run.last, run.f = list(state.sets), state.last, list(f)
        run.a = [sum((Function.of(x) * y for x, y in zip(row, f)), Function.of(b)) for row, b in zip(self.A, self.b)]
        return run

    @staticmethod
    def go_on(run, scans):
        for _ in range(scans):
            run.sweep()
            violated = run.scan()
            assert violated is not None, "it is solved"
            run.establish(violated)
        return run


def line(f, direction, t):
    return [Function.of(x) + t * y for x, y in zip(f, direction)]


class Endless(unittest.TestCase):
    """Part 5."""

    BEFORE, PERIOD = 5, 8  # outer scans

    def setUp(self):
        problem = json.loads((ROOT / "corpus/endless/without-repetition.json").read_text())
        numbers = lambda values: [Fraction(x) for x in values]
        self.outer = Outer([numbers(row) for row in problem["A"]], numbers(problem["b"]), Fraction(1), "resume=round")
        run = self.outer.go_on(self.outer.begin(), self.BEFORE)
        self.states = [State(run)]
        for _ in range(3):
            self.states.append(State(self.outer.go_on(run, self.PERIOD)))
        self.words = [word_of(run.steps[x.steps:y.steps]) for x, y in zip(self.states, self.states[1:])]
        first, second, third = (state.f for state in self.states[:3])
        self.direction = [y - x for x, y in zip(first, second)]
        ratios = {(z - y) / (y - x) for x, y, z in zip(first, second, third) if x != y}
        self.assertEqual(len(ratios), 1)
        self.ratio = ratios.pop()
        self.assertEqual(self.ratio, Fraction(1549, 8932))
        self.limit = 1 / (1 - self.ratio)

    def test_each_round_takes_the_same_steps_to_the_same_sets_nearer_to_a_limit(self):
        self.assertTrue(0 < self.ratio < 1)
        self.assertEqual(len({state.seen for state in self.states}), 1)
        self.assertTrue(self.words[0] == self.words[1] == self.words[2])
        for k, state in enumerate(self.states):
            t = (1 - self.ratio ** k) * self.limit
            self.assertEqual(state.f, [x + t * y for x, y in zip(self.states[0].f, self.direction)])

    def test_so_does_a_round_that_starts_infinitely_near_to_the_limit(self):
        start = self.states[0]
        run = self.outer.go_on(self.outer.begin_at(start, line(start.f, self.direction, self.limit - E)), self.PERIOD)
        self.assertEqual(word_of(run.steps), self.words[0])
        self.assertEqual(run.f, line(start.f, self.direction, self.limit - E * self.ratio))
        self.assertEqual((tuple(run.sets), run.remembered()), start.seen)

    def test_at_the_limit_itself_it_would_stand_still(self):
        start = self.states[0]
        run = self.outer.go_on(self.outer.begin_at(start, line(start.f, self.direction, self.limit)), self.PERIOD)
        self.assertEqual(run.f, line(start.f, self.direction, self.limit))

    def test_states_of_300_drives_are_all_different(self):
        run, seen = self.outer.begin(), set()
        while run.drives < 300:
            state = State(run)
            self.assertNotIn((state.seen, *state.f), seen)
            seen.add((state.seen, *state.f))
            self.outer.go_on(run, 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
