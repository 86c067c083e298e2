# SPDX-License-Identifier: Apache-2.0
"""Which loop of two contacts has the smallest integers? A definite, mu = 1, under the policy paper.

Every positive definite A and every b with integers of at most K, but for tangents reversed: A_N1F1 and A_N2F2 are not
negative. Problems without a negative bN are solved by f = 0 and left out. Smallest is the loop with the smallest
largest entry, of these the one with the fewest nonzeros, of these that with the least sum. Runs are decided by
certified signs, so the table is complete. K = 3 has 51 million problems, and takes an hour or two."""

import itertools

import numpy as np

import stiction
import study


def definite_matrices(K):
    """Rows N1, F1, N2, F2; leading minors are integers, told exactly by doubles."""
    some, all_ = range(K + 1), range(-K, K + 1)
    for entries in itertools.product(*[range(1, K + 1)] * 4, some, some, *[all_] * 4):
        d1, d2, d3, d4, n1f1, n2f2, n1n2, n1f2, f1n2, f1f2 = entries
        A = np.array([[d1, n1f1, n1n2, n1f2], [n1f1, d2, f1n2, f1f2], [n1n2, f1n2, d3, n2f2], [n1f2, f1f2, n2f2, d4]])
        if d1 * d2 > n1f1 ** 2 and all(np.linalg.det(A[:k, :k]) > 0.5 for k in (3, 4)):
            yield A


def size(problem):
    entries = np.abs([*problem.A.flat, *problem.b]).astype(int)
    return int(entries.max()), int(np.count_nonzero(entries)), int(entries.sum())


def shown(problem):
    """Its size, and itself, A and b row by row."""
    if problem is None:
        return "-"
    rows = "; ".join(" ".join(f"{x:.0f}" for x in [*row, b]) for row, b in zip(problem.A, problem.b))
    return "largest {}, {} nonzeros, sum {}: {}".format(*size(problem), rows)


def row_of(K):
    vectors = [b for b in itertools.product(range(-K, K + 1), repeat=4) if b[0] < 0 or b[2] < 0]
    matrices, counts, smallest, whole = 0, {"cycle": 0, "singular": 0, "solved": 0}, None, None
    for A in definite_matrices(K):
        matrices += 1
        problems = [stiction.Problem(A, np.array(b), 1) for b in vectors]
        outcomes = stiction.solve_all(problems, "baraff", "filtered")["outcome"]
        for outcome in counts:
            counts[outcome] += int((outcomes == outcome).sum())
        for problem in (problems[i] for i in np.flatnonzero(outcomes == "cycle")):
            smallest = min(smallest or problem, problem, key=size)
            if (whole is None or size(problem) < size(whole)) and all(
                    end["outcome"] == "cycle" for end in stiction.ends(problem).values()):
                whole = problem
    problems = matrices * len(vectors)
    return (K, matrices, problems, counts["cycle"], counts["singular"], problems - sum(counts.values()), shown(smallest),
            shown(whole))


def main():
    o = study.options(__doc__, entries=2)
    study.show(["entries at most", "matrices", "problems", "loops of `paper`", "no force direction",
                "none of these, nor solved", "the smallest loop", "the smallest under every policy"],
               map(row_of, range(1, o.entries + 1)))


study.run(main)
