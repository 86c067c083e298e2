# SPDX-License-Identifier: Apache-2.0
"""many_test.py PROGRAM SOURCES: many problems at once say what each says alone, fast, whatever the threads."""
import sys
import time
import unittest

import numpy as np
import stiction


def stacks(count, contacts, seed=1, dimension=2):
    """A semidefinite with b in its range."""
    rng, rows = np.random.default_rng(seed), dimension * contacts
    half = rng.integers(-3, 4, (count, rows, rows)).astype(float)
    A = half @ half.transpose(0, 2, 1)
    return A, np.einsum("nij,nj->ni", A, rng.integers(-5, 6, (count, rows)).astype(float)), rng.integers(
        1, 9, (count, contacts)) / 4


class Same(unittest.TestCase):
    def assertSame(self, many, ones, counters=True):
        self.assertEqual(many.outcome.tolist(), [one.outcome for one in ones])
        for i, one in enumerate(ones):
            for array, of in ((many.f, one.f), (many.a, one.a)):
                of = of if len(of) else np.full(array.shape[1], np.nan)
                # Midpoints of enclosures are taken twice, and rounded in two ways.
                size = 1e-15 if one.f_bounds is not None else 0
                np.testing.assert_allclose(array[i], of, rtol=size, atol=size * np.max(np.abs(of)))
            if counters:
                for name, count in one.statistics.items():
                    self.assertEqual(many.statistics[name][i], count, name)

    def test_as_solve(self):
        A, b, mu = stacks(150, 3)
        for method, arithmetic in (("complete", "double"), ("auto", "double"), ("fast", "double"), ("lemke", "exact"),
                                   ("complete", "filtered")):
            with self.subTest(method=method):
                ones = [stiction.solve(stiction.Problem(*of), method, arithmetic)
                        for of in zip(A[:40], b[:40], mu[:40])]
                many = stiction.solve_many(A, b, mu, method=method, arithmetic=arithmetic)
                self.assertEqual((len(many), many.f.shape, many.f.dtype), (150, (150, 6), np.float64))
                some = stiction.solve_many(A[:40], b[:40], mu[:40], method=method, arithmetic=arithmetic)
                self.assertSame(some, ones)

    def test_in_space_and_of_other_kinds(self):
        A, b, mu = stacks(12, 2, dimension=3)
        ones = [stiction.solve(stiction.Problem(*of, dimension=3), "fast", "double") for of in zip(A, b, mu)]
        self.assertSame(stiction.solve_many(A, b, mu, dimension=3, method="fast"), ones)
        kinds = ["bilateral", "static", "frictionless"]
        A, b, _ = stacks(12, 2)
        ones = [stiction.solve(stiction.Problem(*of, [0, 1, 0], kinds), "complete", "double") for of in zip(A, b)]
        self.assertSame(stiction.solve_many(A, b, 1, kinds, method="complete"), ones)

    def test_as_replay_with_loops(self):
        loop = [[3, -4, 2, 0], [-4, 7, -4, 1], [2, -4, 7, -6], [0, 1, -6, 7]]
        A, b, _ = stacks(20, 2)
        A[::3], b[::3] = loop, [-1, 0, 0, -2]
        for policy in ("paper", "scan=highest"):
            ones = [stiction.replay(stiction.Problem(*of, 1), policy) for of in zip(A, b)]
            many = stiction.replay_many(A, b, 1, policy=policy)
            self.assertEqual([(o, s, p) for o, s, p in zip(many.outcome, many.start, many.period)],
                             [(one.outcome, one.start, one.period) for one in ones])
        self.assertIn("7 cycle", repr(stiction.replay_many(A, b, 1)))

    def test_threads_and_strides_change_nothing(self):
        A, b, mu = stacks(300, 2)
        usual = stiction.solve_many(A, b, mu, method="complete", threads=1)
        turned = np.asfortranarray(A)[:, ::-1, ::-1][:, ::-1, ::-1]
        for many in (stiction.solve_many(A, b, mu, method="complete", threads=7),
                     stiction.solve_many(turned, b[::-1][::-1], mu.tolist(), method="complete")):
            np.testing.assert_array_equal(many.f, usual.f)
            self.assertEqual({k: v.tolist() for k, v in many.statistics.items()},
                             {k: v.tolist() for k, v in usual.statistics.items()})

    def test_one_stands_for_all(self):
        A, b, mu = stacks(5, 2)
        full = stiction.solve_many(np.stack([A[0]] * 5), b, np.stack([mu[0]] * 5))
        np.testing.assert_array_equal(stiction.solve_many(A[0], b, mu[0]).f, full.f)
        self.assertEqual(len(stiction.solve_many(A[0], b[0], 1)), 1)
        self.assertEqual(len(stiction.solve_many(A, b[0], 1)), 5)
        none = stiction.solve_many(A[:0], b[:0], 1)
        self.assertEqual((len(none), none.f.shape), (0, (0, 4)))

    def test_what_is_wrong_is_refused_by_its_place(self):
        A, b, mu = stacks(9, 2)
        holed, negative, large = b.copy(), mu.copy(), b.copy()
        holed[4, 2], negative[7, 1], large[3] = np.nan, -1, 1e300
        for arguments, says in [((A, holed, mu), r"b\[4\]\[2\]: found nan"),
                                ((A, b, negative), r"mu\[7\]\[1\]: found -1"),
                                ((A, b[:4], mu), "b: found 4 x 4, expected 4, or 9"),
                                ((A[:, :3], b, mu), "A: found 9 x 3 x 4, expected 4 x 4"),
                                ((A, b, [1, 1, 1]), "A: found 4 x 4, expected 6 x 6"),
                                ((A[None], b, mu), "A with 4"),
                                ((A, b, mu, ["sliding", "static"]), "sliding")]:
            with self.subTest(says=says), self.assertRaisesRegex(ValueError, says):
                stiction.solve_many(*arguments)
        with self.assertRaisesRegex(ValueError, "problem 3: .*float"):
            stiction.solve_many(A, large, mu, arithmetic="float")
        with self.assertRaisesRegex(ValueError, "method: found fast, expected one with a path"):
            stiction.replay_many(A, b, mu, method="fast")
        with self.assertRaisesRegex(ValueError, "method: found guess"):
            stiction.solve_many(A, b, mu, method="guess")
        with self.assertRaisesRegex(ValueError, "threads: found 0"):
            stiction.solve_many(A, b, mu, threads=0)


class Rate(unittest.TestCase):
    def test_python_costs_less_than_three_tenths(self):
        """By processor time, which other processes do not lengthen; bench/studies/many.py has more."""
        A, b, mu = stacks(6000, 6)
        best = 0
        for _ in range(3):
            start = time.process_time()
            many = stiction.solve_many(A, b, mu, method="complete")
            best = max(best, many.seconds / (time.process_time() - start))
        self.assertGreater(best, 0.7)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
