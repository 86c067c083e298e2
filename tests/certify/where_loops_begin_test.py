#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""certify/where_loops_begin.md: what happens below the bound K(mu) of the condition number, and without friction.

The independent runner (certify/check_runs.py) runs. What is proved for all b is tried on random problems; the loops
with ties are proved for every mu, over numbers that stand for all (proved_signs.py).

    where_loops_begin_test.py PROGRAM ROOT
"""

import itertools
import random
import subprocess
import sys
import unittest
from fractions import Fraction

sys.dont_write_bytecode = True

from many_runs import POLICIES, ROOT, OpenRun, Run, StaticRows, check_runs, corpus, determinant  # noqa: E402
from proved_signs import Function, X  # noqa: E402

import check_certificate  # noqa: E402
from certificate_reader import Rejected  # noqa: E402

NOTHING_GIVEN_UP = [policy for policy in POLICIES if policy["give-up"] != "previous" or policy["apex"] != "kept"]
TWO_CONTACTS_END = [policy for policy in POLICIES if policy["give-up"] != "previous" and policy["drop"] == "contact"]


def loops(rows):
    """The policies under which it loops, by their indices."""
    return {i for i, policy in enumerate(POLICIES) if Run(rows, policy).compute_forces().outcome == "cycle"}


def gives_up(found):
    """Where no force is driven to zero: a variable enters no set."""
    return any(step["to"] == "none" for step in found.pivots)


def three_contacts(m):
    """Friction forces in units of mu, m = mu^2; turning the three contacts round changes nothing."""
    zero = 0 * m
    own, next_one = [[1 + 4 * m, 2 * m], [2 * m, 4 * m * (1 + m)]], [[1 + zero, zero], [-2 * m, -2 * m]]
    A = [[zero] * 6 for _ in range(6)]
    for i, x, y in itertools.product(range(3), range(2), range(2)):
        row, k, n = 2 * i + x, 2 * i + y, (2 * i + 2) % 6 + y
        A[row][k] = own[x][y]
        A[row][n] = A[n][row] = next_one[x][y]
    return A, [-(3 + 4 * m), 4 * m * (1 + 2 * m)] * 3, 1 + zero


class ThreeContactsWithATie(unittest.TestCase):
    RANGES = {"below 1/4": X / (4 + 4 * X), "1/4": Function.of(Fraction(1, 4)), "above 1/4": X + Fraction(1, 4)}

    def test_360_policies_loop_at_every_mu(self):
        found = {name: loops(StaticRows(*three_contacts(m))) for name, m in self.RANGES.items()}
        every = set.intersection(*found.values())
        self.assertEqual(len(every), 360)
        self.assertIn(POLICIES.index(check_runs.read_policy("paper")), every)
        self.assertEqual({(POLICIES[i]["drop"], POLICIES[i]["ties"]) for i in every}, {("contact", "sets")})

    def test_the_eigenvalues_are_those_of_the_text(self):
        """c, 4m, c +- sqrt(3c) twice, c = 3 + 4m: both sides are of degree 6 in t, so 7 values of t are enough."""
        for m in (Fraction(1, 9), Fraction(1, 4), Fraction(1), Fraction(5)):
            A, c = three_contacts(m)[0], 3 + 4 * m
            for t in range(7):
                shifted = [[x - t * (1, m)[i % 2] * (i == j) for j, x in enumerate(row)] for i, row in enumerate(A)]
                self.assertEqual(determinant(shifted), m ** 3 * (c - t) * (4 * m - t) * ((t - c) ** 2 - 3 * c) ** 2)

    def test_the_tie_is_one(self):
        rows = StaticRows(*three_contacts(Fraction(1)))
        with self.assertRaises(AssertionError):
            OpenRun(rows, check_runs.read_policy("paper")).is_open()


class TheTieGoesNoLower(unittest.TestCase):
    """Part 4, its last proposition: of rings A_ii = [p q; q s], A_i,i+1 = [n x; y z] that have the tie."""

    def rings(self):
        dice = random.Random(4)
        for _ in range(40):
            mu = Fraction(dice.randint(1, 8), dice.randint(1, 4))
            q, s, n, x, y, z = (Fraction(dice.randint(-9, 9)) for _ in range(6))
            yield mu, (n + mu * (q - y), q, s, n, x, y, z)

    @staticmethod
    def matrix(p, q, s, n, x, y, z):
        own, next_one = [[p, q], [q, s]], [[n, x], [y, z]]
        A = [[Fraction(0)] * 6 for _ in range(6)]
        for i, row, column in itertools.product(range(3), range(2), range(2)):
            k, m = 2 * i + row, (2 * i + 2) % 6 + column
            A[k][2 * i + column] = own[row][column]
            A[k][m] = A[m][k] = next_one[row][column]
        return A

    @staticmethod
    def turned(p, q, s, n, x, y, z):
        """B_NN, B_FF, and the square of abs(B_NF)."""
        return p - n, s - z, (q - (x + y) / 2) ** 2 + Fraction(3, 4) * (x - y) ** 2

    def test_the_normals_of_the_state_can_all_be_clamped_where_the_tie_holds(self):
        for mu, ring in self.rings():
            A, f = self.matrix(*ring), [2, -2 * mu, 0, 0, 3, 0]
            a = [sum(c * g for c, g in zip(row, f)) for row in A]
            self.assertEqual(a[0], a[2])  # bN is one for all contacts
            A[0][0] += 1
            self.assertNotEqual(sum(c * g for c, g in zip(A[0], f)), a[2])

    def test_the_eigenvalues_of_B_are_among_those_of_A(self):
        for _, ring in self.rings():
            p, q, s, n, x, y, z = ring
            NN, FF, NF2 = self.turned(*ring)
            for t in range(7):
                A = [[c - t * (i == j) for j, c in enumerate(row)] for i, row in enumerate(self.matrix(*ring))]
                same = (p + 2 * n - t) * (s + 2 * z - t) - (q + x + y) ** 2
                self.assertEqual(determinant(A), same * ((NN - t) * (FF - t) - NF2) ** 2)

    def test_B_NN_is_at_most_2_mu_by_the_root_of_3_times_B_NF_and_the_family_reaches_it(self):
        for mu, ring in self.rings():
            NN, _, NF2 = self.turned(*ring)
            self.assertLessEqual(NN ** 2, Fraction(4, 3) * mu ** 2 * NF2)
        for mu in (Fraction(1, 3), Fraction(1), Fraction(5)):
            m = mu ** 2
            NN, _, NF2 = self.turned(1 + 4 * m, 2 * mu, 4 + 4 * m, Fraction(1), Fraction(0), -2 * mu, Fraction(-2))
            self.assertEqual(NN ** 2, Fraction(4, 3) * m * NF2)


class CorpusBelowTheBound(unittest.TestCase):
    CERTIFICATES = ("safe-tie-cycle-3-contacts", "safe-tie-cycle-7-contacts", "safe-cycle-8-contacts")

    def test_the_independent_checker_accepts_that_they_loop_and_are_safe(self):
        cases = [(name, claim) for name in self.CERTIFICATES for claim in ("cycle", "safe-by-condition")]
        for name, claim in (*cases, ("frictionless-cycle-without-symmetry", "cycle")):
            with self.subTest(name=name, claim=claim):
                done = subprocess.run([sys.executable, ROOT / "certify/check_certificate.py",
                                       ROOT / f"corpus/certificates/{name}.{claim}.json",
                                       "--problem", ROOT / f"corpus/{name}.json"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn(f"accepted: {claim} (", done.stdout)

    def is_below(self, name, least, most):
        problem, _ = corpus(name)
        witness = {"scaling": ["1"] * len(problem.b), "least": str(least), "most": str(most)}
        return check_certificate.check_safe_by_condition(problem, witness)

    def loops(self, name):
        return [POLICIES[i] for i in loops(corpus(name)[1])]

    def test_eigenvalues_1_and_5_and_a_tie(self):
        name = "safe-tie-cycle-3-contacts"
        self.assertEqual(self.is_below(name, 1, 5), "condition 5, friction 1")
        A = corpus(name)[0].A
        shifted = [[x - 3 * (i == j) for j, x in enumerate(row)] for i, row in enumerate(A)]
        square = [[sum(x * y for x, y in zip(row, other)) for other in shifted] for row in shifted]
        self.assertEqual(square, [[4 * (i == j) for j in range(6)] for i in range(6)])
        found = self.loops(name)
        self.assertEqual(len(found), 360)
        self.assertIn(check_runs.read_policy("paper"), found)

    def test_a_tie_of_two_normals_makes_other_policies_loop_too(self):
        name = "safe-tie-cycle-7-contacts"
        self.is_below(name, 4872, 7928)
        for policy in ("paper", "apex=suspended", "drop=variable", "ties=contacts"):
            self.assertEqual(Run(corpus(name)[1], check_runs.read_policy(policy)).compute_forces().outcome, "cycle")

    def test_without_a_tie_it_loops_where_previous_meets_an_apex_that_is_kept(self):
        name = "safe-cycle-8-contacts"
        self.is_below(name, 311658, 507591)
        rows = corpus(name)[1]
        for policy in ("give-up=previous", "admit=eager,give-up=previous"):
            self.assertTrue(OpenRun(rows, check_runs.read_policy(policy)).is_open(), policy)
        for policy in ("paper", "give-up=second", "give-up=previous,apex=suspended"):
            self.assertEqual(Run(rows, check_runs.read_policy(policy)).compute_forces().outcome, "solved")

    def test_a_loop_above_the_bound_is_not_below(self):
        for least, most in ((1, 5), (Fraction(1, 10), 20)):
            with self.assertRaises(Rejected):
                self.is_below("cycle-every-policy-mu-1", least, most)


class Below(unittest.TestCase):
    """A with eigenvalues between 1 and k, k just below K(mu)."""

    BOUNDS = {Fraction(1): Fraction(29, 5), Fraction(4): Fraction(41, 25), Fraction(1, 4): Fraction(65)}

    def setUp(self):
        self.dice = random.Random(11)
        for mu, k in self.BOUNDS.items():
            self.assertTrue(mu ** 2 * (k - 1) ** 2 < 4 * k)

    def definite(self, size, k, most):
        """1 + (k - 1) (a weighted mean of projections to lines)."""
        lines = [[self.dice.randint(-most, most) for _ in range(size)] for _ in range(self.dice.randint(1, size))]
        lines = [line for line in lines if any(line)] or [[1] * size]
        weights = [Fraction(self.dice.randint(1, most)) for _ in lines]
        parts = [(k - 1) * weight / sum(weights) / sum(x * x for x in line) for weight, line in zip(weights, lines)]
        return [[(i == j) + sum(part * line[i] * line[j] for part, line in zip(parts, lines)) for j in range(size)]
                for i in range(size)]

    @staticmethod
    def five_modes(A, mu, word):
        """The reduced matrix of a word; `friction` is friction that sticks while the normal is not in C."""
        kept, columns, by_column = [], [], list(zip(*A))
        for i, mode in enumerate(word):
            N, F = 2 * i, 2 * i + 1
            side = {"slip+": mu, "slip-": -mu}.get(mode)
            if side:
                kept.append(N)
                columns.append([x + side * y for x, y in zip(by_column[N], by_column[F])])
            else:
                rows = {"open": [], "friction": [F], "stick": [N, F]}[mode]
                kept += rows
                columns += [by_column[row] for row in rows]
        return [[column[row] for column in columns] for row in kept]

    def test_the_determinants_of_five_modes_are_positive(self):
        for mu, k in self.BOUNDS.items():
            for contacts, problems in ((1, 20), (2, 20), (3, 3)):
                for _ in range(problems):
                    A = self.definite(2 * contacts, k, 3)
                    for modes in itertools.product(("open", "friction", "slip+", "slip-", "stick"), repeat=contacts):
                        self.assertGreater(determinant(self.five_modes(A, mu, modes)), 0)

    def runs_in_general_position(self, mu, k):
        for contacts in (1, 2, 3, 3, 4):
            A = self.definite(2 * contacts, k, 9)
            rows = StaticRows(A, [Fraction(self.dice.randint(-10 ** 9, 5 * 10 ** 8), 1009) for _ in A], mu)
            yield from (Run(rows, policy) for policy in self.dice.sample(NOTHING_GIVEN_UP, 8))

    def test_for_b_in_general_position_nothing_is_given_up(self):
        for mu, k in self.BOUNDS.items():
            for run in self.runs_in_general_position(mu, k):
                found = run.compute_forces()
                self.assertEqual(found.outcome, "solved")
                self.assertLessEqual(run.drives, len(run.f))
                self.assertFalse(gives_up(found))

    def test_far_above_the_bound_something_is(self):
        runs = (run for _ in range(20) for mu in self.BOUNDS for run in self.runs_in_general_position(mu, 10 ** 4))
        self.assertTrue(any(gives_up(run.compute_forces()) for run in runs))

    def through_a_tie(self, A):
        """b so that, while a variable of one contact is driven, forces and accelerations of the other can all be zero
        at once: the only tie at which something is given up."""
        side, push = self.dice.choice((-1, 0, 1)), self.dice.randint(1, 3)
        f, a = [self.dice.randint(4, 9), side * self.dice.randint(1, 3), 0, 0], [0, -side * push, 0, 0]
        if side == 0:
            a = [-push, self.dice.randint(-3, 3), 0, 0]
        if self.dice.random() < .5:
            f, a = f[2:] + f[:2], a[2:] + a[:2]
        return [x - sum(y * z for y, z in zip(row, f)) for x, row in zip(a, A)]

    def test_two_contacts_end_whatever_the_ties(self):
        given_up = 0
        for mu, k in self.BOUNDS.items():
            for _ in range(120):
                A = self.definite(4, k, 3)
                rows = StaticRows(A, self.through_a_tie(A), mu)
                for policy in self.dice.sample(TWO_CONTACTS_END, 8):
                    run = Run(rows, policy)
                    found = run.compute_forces()
                    self.assertEqual(found.outcome, "solved")
                    self.assertLessEqual(run.drives, 8)
                    given_up += gives_up(found)
        self.assertGreater(given_up, 10)


class WithoutFriction(unittest.TestCase):
    def test_without_symmetry_it_can_loop(self):
        problem, rows = corpus("frictionless-cycle-without-symmetry")
        sums = [[x + y for x, y in zip(row, column)] for row, column in zip(problem.A, zip(*problem.A))]
        for size in range(1, 7):  # x'Ax > 0
            self.assertGreater(determinant([row[:size] for row in sums[:size]]), 0)
        self.assertNotEqual(problem.A, [list(column) for column in zip(*problem.A)])
        found = loops(rows)
        self.assertEqual(len(found), 864)
        self.assertLessEqual({i for i, policy in enumerate(POLICIES) if policy["admit"] == "eager"}, found)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
