# SPDX-License-Identifier: Apache-2.0
"""factors_test.py PROGRAM SOURCES: problems in factors from Python: J, M, w, c of numpy, of scipy where it is installed,
or of what has a matrix' entries; solved without A, and given back."""
import pickle
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np
import stiction
from stiction._factors import Entries

try:
    import scipy.sparse as sparse
except ImportError:
    sparse = None

J = np.array([[0, 1, 0, 0], [1, 0, 0, 0], [0, -1, 0, 1], [-1, 0, 1, 0]], float)
M = np.array([[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 0.5, 0.125], [0, 0, 0.125, 0.5]])
W = np.array([0, -9.75, 1, -9.75])
C = np.array([0, 0.5, 0, 0])


def entries(matrix):
    row, col = np.nonzero(matrix)
    return Entries(row, col, matrix[row, col], matrix.shape)


def dense(matrix):
    return np.asarray(matrix.toarray())


def wall(columns, rows):
    """Blocks on blocks, of two contacts each; the J and w of factors_test.py of the program, as entries."""
    row, col, data, at = [], [], [], 0
    for block in range(columns * rows):
        for side in (-1, 1):
            for k, y, sign in ((block, -1, 1), (block - columns, 1, -1)):
                if k >= 0:
                    for i, j, x in ((0, 1, 1), (0, 2, side), (1, 0, 1), (1, 2, -y)):
                        row.append(at + i), col.append(3 * k + j), data.append(float(sign * x))
            at += 2
    size = 3 * columns * rows
    return Entries(np.array(row), np.array(col), np.array(data), (at, size)), np.tile([0.0, -10.0, 0.0], columns * rows)


class Given(unittest.TestCase):
    def forms(self):
        blocks = [2.0, 2.0, M[2:, 2:]]
        yield from ((J, M), (J.tolist(), M.tolist()), (entries(J), entries(M)), (J, blocks), (entries(J), blocks))
        if sparse is not None:
            yield from ((sparse.csr_matrix(J), sparse.csc_matrix(M)), (sparse.coo_matrix(J), M), (sparse.lil_matrix(J), blocks))

    def test_every_form_is_the_same_problem_as_a_and_b(self):
        exact = [[Fraction(x) for x in row] for row in M.tolist()]
        determinant = exact[2][2] ** 2 - exact[2][3] ** 2
        w22, w23 = exact[2][2] / determinant, -exact[2][3] / determinant
        inverse = [[Fraction(1, 2), 0, 0, 0], [0, Fraction(1, 2), 0, 0], [0, 0, w22, w23], [0, 0, w23, w22]]
        rows = [[Fraction(x) for x in row] for row in J.tolist()]
        JW = [[sum(x * inverse[k][j] for k, x in enumerate(row)) for j in range(4)] for row in rows]
        A = [[sum(x * y for x, y in zip(left, right)) for right in rows] for left in JW]
        b = [sum(x * Fraction(w) for x, w in zip(row, W.tolist())) + Fraction(c) for row, c in zip(rows, C.tolist())]
        same = stiction.Problem(A, b, [0.5, 0.25])
        for J_, M_ in self.forms():
            problem = stiction.Problem(J=J_, M=M_, w=W, c=C, mu=[0.5, 0.25])
            self.assertEqual((problem.digest, problem.exact_A), (same.digest, A))
            self.assertEqual(stiction.solve(problem).exact_f, stiction.solve(same).exact_f)

    @unittest.skipUnless(sparse, "python3-scipy is not installed")
    def test_sparse_matrices_of_bodies(self):
        """Of each format of scipy, with entries listed twice, integers, and index arrays of 64 bits."""
        same = stiction.Problem(J=J, M=M, w=W, mu=[0.5, 0.25])
        twice = sparse.coo_matrix((np.r_[J[J != 0] / 2, J[J != 0] / 2], np.tile(np.nonzero(J), 2)), J.shape)
        doubled = sparse.csr_matrix((np.repeat(J[J != 0] / 2, 2), np.repeat(np.nonzero(J)[1], 2),
                                     np.r_[0, 2 * np.cumsum((J != 0).sum(axis=1))]), J.shape)
        wide = sparse.csr_matrix(J)
        wide.indices, wide.indptr = wide.indices.astype(np.int64), wide.indptr.astype(np.int64)
        for J_ in (twice, doubled, wide, sparse.csr_array(J), sparse.dok_matrix(J), sparse.bsr_matrix(J), sparse.dia_matrix(J),
                   sparse.csc_matrix(J.astype(int))):
            before = J_.copy()
            for M_ in (sparse.csc_matrix(M), sparse.block_diag([2, 2, M[2:, 2:]]), sparse.csr_array(M)):
                problem = stiction.Problem.from_bodies(J_, M_, W, mu=[0.5, 0.25])
                self.assertEqual(problem.digest, same.digest, (type(J_), type(M_)))
                self.assertIsInstance(problem.J, sparse.csr_matrix)
                self.assertEqual((problem.J != sparse.csr_matrix(J)).nnz + (problem.M != sparse.csr_matrix(M)).nnz, 0)
            self.assertEqual(before.nnz, J_.nnz)  # what was given is as it was
        ones = stiction.Problem.from_bodies(sparse.csr_matrix(J), [1, 1, 1, 1], W, mu=1, c=C)
        self.assertEqual(ones, stiction.Problem.from_bodies(J, sparse.identity(4), W, 1, C))
        with self.assertRaisesRegex(ValueError, r"J\[0, 1\]: found nan"):
            stiction.Problem.from_bodies(sparse.csr_matrix(np.where(J == 1, np.nan, J)), M, W, 1)

    def test_a_diagonal_of_masses_and_exact_numbers(self):
        problem = stiction.Problem(J=[["1/3", 0], [0, 1]], M=["2", Fraction(1, 3)], w=["-1/7", 0], mu=1)
        self.assertEqual(problem.exact_A, [[Fraction(1, 18), 0], [0, 3]])
        self.assertEqual(problem.exact_b, [Fraction(-1, 21), 0])

    def test_they_are_given_back_and_kept(self):
        problem = stiction.Problem(J=entries(J), M=entries(M), w=W, c=C, mu=0.5, name="stack")
        for matrix, expected in ((problem.J, J), (problem.M, M)):
            self.assertEqual(dense(matrix).tolist(), expected.tolist())
            self.assertEqual(type(matrix).__name__, "Entries" if sparse is None else "csr_matrix")
        self.assertEqual((problem.w.tolist(), problem.c.tolist()), (W.tolist(), C.tolist()))
        for other in (pickle.loads(pickle.dumps(problem)), self.saved(problem)):
            self.assertEqual(other, problem)
            self.assertEqual(dense(other.J).tolist(), J.tolist())
        plain = stiction.Problem(np.eye(2), [-1, 0], 1)
        self.assertEqual((plain.J, plain.M, plain.w, plain.c), (None,) * 4)

    def saved(self, problem):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "p.json"
            problem.save(file)
            return stiction.load(file)

    def test_what_is_wrong_is_refused(self):
        for arguments, error, says in [
                (dict(J=J, M=-M, w=W, mu=1), ValueError, r"factors.M\[0\]: found a block that is not positive definite"),
                (dict(J=J, M=M + np.triu(M, 1), w=W, mu=1), ValueError, r"factors.M\[2\].*symmetric"),
                (dict(J=J, M=M[:3, :3], w=W, mu=1), ValueError, "factors.M: found blocks of 3 velocities"),
                (dict(J=J, M=M[:3], w=W, mu=1), ValueError, "M: found 3 x 4, expected a square matrix"),
                (dict(J=J, M=M, w=W[:2], mu=1), ValueError, "factors.w: found 2 numbers"),
                (dict(J=J, M=M, w=[0, np.nan, 0, 0], mu=1), ValueError, r"w\[1\]: found nan"),
                (dict(J=J, M=M, mu=1), TypeError, "w: found nothing, expected J, M, w"),
                (dict(J=J, M=M, w=W), TypeError, "mu: found nothing"),
                (dict(A=np.eye(2), b=[0, 0], mu=1, w=W), TypeError, "w: found beside A"),
                (dict(J=J, M=M, w=W, mu=1, b=W), TypeError, "b: found beside J"),
                (dict(b=[0, 0], mu=1), TypeError, "A: found nothing")]:
            with self.subTest(says=says), self.assertRaisesRegex(error, says):
                stiction.Problem(**arguments)


class Solved(unittest.TestCase):
    def test_thousands_of_contacts_are_solved_without_a(self):
        columns, rows = 40, 30
        J_, w = wall(columns, rows)
        problem = stiction.Problem(J=J_, M=np.ones(J_.shape[1]), w=w, mu=0.5, name="wall")
        answer = stiction.solve(problem)
        self.assertEqual((answer.outcome, answer.method), ("solved", "newton-bodies"))
        self.assertAlmostEqual(answer.f[0:4 * columns:2].sum(), 10 * columns * rows, delta=1e-6)
        self.assertEqual((len(problem.b), problem.J.shape), (4 * columns * rows, J_.shape))
        with self.assertRaisesRegex(ValueError, "4800.*at most 4000"):
            stiction.solve(problem, "lemke")
        with self.assertRaisesRegex(ValueError, "at most 4000"):
            problem.A
        self.assertIn("4800 rows", repr(problem))

    def test_what_has_no_entries_or_no_sizes_does_not_end_the_interpreter(self):
        problems = Path(sys.argv[2]) / "tests/problems"
        with self.assertRaisesRegex(ValueError, "factors.J: found 0"):
            stiction.load(problems / "segv-factors-J.json")
        for name in ("segv-newton-bodies", "segfault-explain-factors", "empty"):
            problem = stiction.load(problems / f"{name}.json")
            outcome = stiction.solve(problem, "newton-bodies", arithmetic="double").outcome
            self.assertEqual(outcome, "solved" if name == "empty" else "undecided")
            self.assertTrue(str(stiction.explain(problem)))

    def test_bytes_that_are_no_utf8_are_told_in_errors(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "bytes.json"
            file.write_bytes(b'{"A": [[1, 0], [0, 1]], "b": [-1, "\xff"], "mu": 1}')
            with self.assertRaisesRegex(ValueError, "\ufffd|UTF-8"):
                stiction.load(file)

    def test_what_factors_prove_is_certified_by_them(self):
        problem = stiction.Problem(J=J, M=M, w=W, mu=0.5)
        certificate = stiction.certify(problem, "exists")
        self.assertIn('"factors"', certificate.text)
        self.assertTrue(stiction.check(problem, certificate))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
