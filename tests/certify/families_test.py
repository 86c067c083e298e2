#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The families of search/adversary/frontiers.md, 3 and 4: the published algorithm loops on every member; and 5: it runs
for ever and never repeats a state.

The independent runner (certify/check_runs.py) runs them over numbers that stand for all members at once
(proved_signs.py): every sign on which a step depends is proved to be the same for all.

    families_test.py PROGRAM ROOT
"""

import sys
import unittest
from fractions import Fraction

sys.dont_write_bytecode = True

from many_runs import POLICIES, OpenRun, Run, StaticRows, check_runs, corpus, determinant, word  # noqa: E402
from proved_signs import Affine, X, Y  # noqa: E402

PAPER = check_runs.read_policy("paper")


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
    def sign(i, k=0):
        return -1 if (i + k) % 2 else 1

    return ([[sign(i, k) * x for k, x in enumerate(row)] for i, row in enumerate(A)],
            [sign(i) * x for i, x in enumerate(b)], mu)


def word_mirrored(found):
    other = {"NC-": "NC+", "NC+": "NC-"}
    return [(*step[:4], *(other.get(place, place) for place in step[4:])) for step in word(found)]


def near_the_bound(m, e):
    """Part 4, friction forces in units of mu."""
    h, k, one, zero = 2 + m, 2 * (1 + m), 1 + e, 0 * e
    return [[1 + zero, one, zero, k * e], [one, h + zero, -(k * e), zero],
            [zero, -(k * e), 1 + zero, one], [k * e, zero, one, h + zero]], [e, 1 + zero, -e, 1 + zero], 1 + zero


def one_body(e):
    """Part 3 with friction and radius of inertia e: rows of J over the root of the masses."""
    contacts = [((Fraction(-24, 25), Fraction(7, 25)), 6, -6), ((Fraction(-4, 5), Fraction(3, 5)), 1, -5)]
    J = []
    for (nx, ny), along, across in contacts:
        J += [[nx, ny, along], [-ny, nx, across / e]]

    def dot(x, y):
        return sum((u * v for u, v in zip(x, y)), 0 * e)

    return [[dot(x, y) for y in J] for x in J], [dot(x, (4, 0, 1)) for x in J], e


def run(problem, policy=PAPER):
    return Run(StaticRows(*problem), policy).compute_forces()


class Family(unittest.TestCase):
    def loops_as_members_do(self, family, members, start, period):
        found = run(family)
        self.assertEqual((found.outcome, found.start, found.period), ("cycle", start, period))
        for member in members:
            self.assertEqual(word(run(member)), word(found))
        # What would differ in space (part 6): no passage between limits, no tie of NC- with NC+.
        self.assertFalse(crosses(found))
        self.assertEqual(word_mirrored(run(mirrored(*family))), word(found))


class OneBody(Family):
    """Part 3."""

    def test_it_loops_at_every_mu_below_a_seventh(self):
        members = [one_body(Fraction(1, n)) for n in (8, 1000, 10 ** 12)]
        self.loops_as_members_do(one_body(1 / (7 + Y)), members, 2, 5)

    def test_at_a_third_it_does_not(self):
        self.assertEqual(run(one_body(Fraction(1, 3))).outcome, "solved")
        with self.assertRaises(ArithmeticError):
            run(one_body(1 / (3 + Y)))


class NearTheBound(Family):
    """Part 4: all m > 0 and e with 0 < e < m / (5 (1 + m)^2)."""

    FAMILY = near_the_bound(X, X / (5 * (1 + X) * (1 + X) + Y))
    MEMBERS = [(Fraction(m), Fraction(e)) for m, e in
               (("1", "1/21"), ("1", "1/10000"), ("49/4", "1/100"), ("1/10000", "1/10000000"), ("10000", "1/10000000"))]

    def test_A_is_positive_definite(self):
        A = self.FAMILY[0]
        for size in range(1, 5):
            self.assertGreater(determinant([row[:size] for row in A[:size]]), 0)

    def test_it_loops_under_every_policy_and_so_does_every_problem_near_it(self):
        self.assertEqual(len(POLICIES), 1536)
        rows = StaticRows(*self.FAMILY)
        for policy in POLICIES:
            self.assertTrue(OpenRun(rows, policy).is_open(), policy)

    def test_members_take_its_steps(self):
        self.loops_as_members_do(self.FAMILY, [near_the_bound(*member) for member in self.MEMBERS], 3, 4)
        rows, others = StaticRows(*self.FAMILY), [StaticRows(*near_the_bound(*member)) for member in self.MEMBERS]
        for policy in POLICIES[::11]:
            found = Run(rows, policy).compute_forces()
            for member in others:
                numbers = Run(member, policy).compute_forces()
                self.assertEqual((numbers.start, numbers.period), (found.start, found.period))
                self.assertEqual(word(numbers), word(found))

    def test_what_does_not_loop_is_told(self):
        A, b, mu = self.FAMILY
        weaker = [[x / 2 if i // 2 != j // 2 else x for j, x in enumerate(row)] for i, row in enumerate(A)]
        self.assertEqual(run((weaker, b, mu)).outcome, "solved")

    def test_a_region_in_which_runs_differ_is_refused(self):
        with self.assertRaises(ArithmeticError):
            run(near_the_bound(X, X / ((1 + X) * (1 + X) + Y)))


class State:
    """Of the outer loop: sets, forces, and what the scan remembers."""

    def __init__(self, run):
        self.sets, self.f, self.last, self.steps = list(run.sets), list(run.f), run.last, len(run.steps)
        self.seen = (tuple(run.sets), run.remembered())


class Endless(unittest.TestCase):
    """Part 5."""

    BEFORE, PERIOD = 5, 8  # outer scans
    RATIO = Fraction(1549, 8932)
    END = 1 / (1 - RATIO)

    def setUp(self):
        self.problem, self.rows = corpus("endless/without-repetition")
        run = self.begin()
        self.states = [State(self.go_on(run, self.BEFORE))]
        for _ in range(3):
            self.states.append(State(self.go_on(run, self.PERIOD)))
        self.words = [self.word(run.steps[x.steps:y.steps]) for x, y in zip(self.states, self.states[1:])]
        self.direction = [y - x for x, y in zip(self.states[0].f, self.states[1].f)]

    def begin(self):
        return check_runs.Published(self.rows, check_runs.read_policy("resume=round"), lambda made: None)

    def begin_at(self, f):
        """From the sets of the first state, with other forces."""
        run, start = self.begin(), self.states[0]
        run.sets, run.last, run.f = list(start.sets), start.last, list(f)
        run.a = [sum((x * y for x, y in zip(f, row)), b + 0 * f[0]) for row, b in zip(self.problem.A, self.problem.b)]
        return run

    @staticmethod
    def go_on(run, scans):
        for _ in range(scans):
            run.sweep()
            violated = run.scan()
            assert violated is not None, "it is solved"
            run.establish(violated)
        return run

    @staticmethod
    def word(steps):
        return [(step["driven"], step["goal"], step["limiting"], step["from"], step["to"]) for step in steps]

    def line(self, t):
        return [x + t * y for x, y in zip(self.states[0].f, self.direction)]

    def round_from_all(self, end):
        """From f(t), for all t with 0 <= t < end."""
        f = [Affine(x, y, end) for x, y in zip(self.states[0].f, self.direction)]
        return self.go_on(self.begin_at(f), self.PERIOD)

    def test_from_every_t_before_the_end_a_round_takes_the_same_steps_to_the_same_sets_nearer_to_the_end(self):
        self.assertTrue(0 < self.RATIO < 1)
        run = self.round_from_all(self.END)
        self.assertEqual(self.word(run.steps), self.words[0])
        self.assertEqual((tuple(run.sets), run.remembered()), self.states[0].seen)
        for force, before, change in zip(run.f, self.states[0].f, self.direction):  # f(1 + RATIO t)
            self.assertEqual((force.p, force.q), (before + change, self.RATIO * change))

    def test_far_beyond_the_end_other_steps_are_taken(self):
        with self.assertRaisesRegex(ArithmeticError, "one sign"):
            self.round_from_all(3 * self.END)

    def test_at_the_end_itself_it_would_stand_still(self):
        run = self.go_on(self.begin_at(self.line(self.END)), self.PERIOD)
        self.assertEqual(run.f, self.line(self.END))

    def test_so_it_is_after_the_first_rounds(self):
        self.assertEqual(len({state.seen for state in self.states}), 1)
        self.assertTrue(self.words[0] == self.words[1] == self.words[2])
        for k, state in enumerate(self.states):
            self.assertEqual(state.f, self.line((1 - self.RATIO ** k) * self.END))

    def test_states_of_300_drives_are_all_different(self):
        run, seen = self.begin(), set()
        while run.drives < 300:
            state = State(run)
            self.assertNotIn((state.seen, *state.f), seen)
            seen.add((state.seen, *state.f))
            self.go_on(run, 1)


class ProvedSigns(unittest.TestCase):
    def test_functions(self):
        self.assertTrue(0 < X < X + Y and not X < X and abs(-X) == X and -X < 0)
        self.assertEqual((X * X - Y * Y) / (X - Y), X + Y)
        self.assertEqual({X - X, X / X}, {0, 1})
        self.assertEqual(((X + 2) / (1 - Y)).at(Fraction(1, 2), Fraction(1, 2)), 5)
        for unknown in (lambda: X < Y, lambda: X == 1, lambda: bool(X - Y), lambda: 1 / (X - 1) > 0):
            self.assertRaises(ArithmeticError, unknown)

    def test_affine_numbers(self):
        t = Affine(Fraction(0), Fraction(1), Fraction(2))
        self.assertTrue(t + 1 > 0 and 2 - t > 0 and t - 2 < 0 and t - t == 0 and (t + 1) * (t - 3) < 0)
        self.assertTrue((t - t) * t == 0 and (t + 1) * (t - t) == 0)
        for unknown in (lambda: t > 0, lambda: t < 1, lambda: (t + 1) * t, lambda: 1 / (t + 1), lambda: t - 3 == -t):
            self.assertRaises(ArithmeticError, unknown)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
