# SPDX-License-Identifier: Apache-2.0
"""The independent runner (certify/check_runs.py) under many policies, on numbers of any kind. Used by the tests beside
this file."""

import itertools
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "certify"))

import check_runs  # noqa: E402
from certificate_reader import read_problem_file  # noqa: E402

POLICIES = [dict(zip(check_runs.SWITCHES, values)) for values in itertools.product(*check_runs.SWITCHES.values())]
MOST_STEPS = 400


def determinant(M):
    """By Gaussian elimination, over numbers of any field: also over functions, of which the checkers know none."""
    M, result = [list(row) for row in M], 1
    for k in range(len(M)):
        p = next((i for i in range(k, len(M)) if M[i][k] != 0), None)
        if p is None:
            return 0
        if p != k:
            M[k], M[p], result = M[p], M[k], -result
        result = M[k][k] * result
        for i in range(k + 1, len(M)):
            if M[i][k] != 0:
                factor = M[i][k] / M[k][k]
                M[i] = [x - factor * y for x, y in zip(M[i], M[k])]
    return result


class StaticRows(check_runs.Rows):
    """Static contacts with one mu."""

    def __init__(self, A, b, mu):
        self.A, self.b, self.contacts, self.held, self.sliding = A, b, len(b) // 2, [], {}
        self.variables = [check_runs.Variable(f"{letter}{i + 1}", i, 2 * i, 2 * i + 1, mu)
                          for i in range(self.contacts) for letter in "NF"]


def corpus(name):
    """The problem of a corpus file, and its rows."""
    problem = read_problem_file(ROOT / f"corpus/{name}.json")
    return problem, check_runs.Rows(problem)


class Run(check_runs.Published):
    """What one run computed the others on the same rows look up."""

    def __init__(self, rows, policy):
        super().__init__(rows, policy, self.end_if_long)
        self.computed = rows.__dict__.setdefault("computed", {})

    @staticmethod
    def end_if_long(steps):
        if len(steps) >= MOST_STEPS:
            raise check_runs.Ended("limit")

    def once(self, compute, *key):
        key = type(self), *key  # another class checks more
        if key not in self.computed:
            self.computed[key] = compute()
        return self.computed[key]

    def take_step(self, v, goal):
        def compute():
            return super(Run, self).take_step(v, goal), self.f, self.a

        found, self.f, self.a = self.once(compute, "step", *self.f, *self.sets, v, goal, self.policy["ties"])
        return found

    def violated(self, row):
        return self.once(lambda: super(Run, self).violated(row), "violated", *self.f, row)


class OpenRun(Run):
    """A run whose steps stay the same if all of A, b and mu change a little: it fails where a sign is asked of a number
    that is zero, but not by the sets alone, or two limits are reached at once.

    Zero by the sets: what a set keeps at zero, a force in no set that began at zero or came to it there, and, in the next
    step, what has just reached its limit."""

    def __init__(self, rows, policy):
        super().__init__(rows, policy)
        self.tops = []  # of the outer loop: drives before, sets, forces
        self.just = None  # the variable that limited the step before, in this drive

    def sweep(self):
        self.tops.append((self.drives, list(self.sets), list(self.f)))
        super().sweep()

    def violated(self, row):
        self.once(lambda: self.require_zeros_by_sets(row), "zeros", *self.f, *self.sets, row)
        return super().violated(row)

    def require_zeros_by_sets(self, row):
        x = self.variables[row]
        fN, aN, normal = self.f[x.normal], self.a[x.normal], self.sets[x.normal]
        assert fN != 0 or normal in ("none", "NC")
        assert aN != 0 or normal == "C"
        if row != x.normal:
            fF, aF, slack, where = self.f[row], self.a[row], x.mu * fN - abs(self.f[row]), self.sets[row]
            assert fF != 0 or where in ("none", "suspended") or fN == 0 and where in ("NC-", "NC+")
            assert slack != 0 or where in ("NC-", "NC+") or fN == 0
            assert aF != 0 or where == "CF" or slack < 0

    def scan(self):
        violated = sum(map(self.violated, range(len(self.f))))
        assert violated <= 1 or self.policy["scan"] != "most-violated"
        return super().scan()

    def filed(self, row):
        assert self.a[row] != 0
        return super().filed(row)

    def drive(self, v, goal):
        self.just = None
        super().drive(v, goal)

    def take_step(self, v, goal):
        at_limits = self.once(self.at_limits, "at limits", *self.f, *self.sets)
        assert at_limits <= {self.just}
        found = super().take_step(v, goal)
        assert found[0] != 0 or found[2] == self.just
        self.just = found[2]
        return found

    def limits(self, v, goal, df, da):
        found = list(super().limits(v, goal, df, da))
        lengths = [limit[0] for limit in found if limit[0] is not None]
        assert lengths.count(min(lengths)) == 1
        return found

    def at_limits(self):
        """The variables that stand at a limit of their set."""
        def distances(row, where):
            x = self.variables[row]
            if where == "CF":
                return [x.mu * self.f[x.normal] + side * self.f[row] for side in (1, -1)]
            return {"C": [self.f[row]], "NC": [self.a[row]], "NC-": [self.a[row]], "NC+": [self.a[row]]}.get(where, [])

        return {row for row, where in enumerate(self.sets) if 0 in distances(row, where)}

    def is_open(self):
        """Whether it loops, and the sets of a state of the period decide its forces: they do so after a small change,
        and the state recurs when the sets do."""
        found = self.compute_forces()
        return found.outcome == "cycle" and any(
            not any(force for force, where in zip(f, sets) if where in ("none", "NC", "suspended"))
            and self.once(lambda: self.is_regular(sets), "regular", *sets)
            for drives, sets, f in self.tops if drives >= found.start)

    def is_regular(self, sets):
        """Whether the matrix of C and CF is."""
        def column(row):
            line, friction = [A[row] for A in self.rows.A], self.variables[row].friction
            if row == friction or not friction or sets[friction] not in ("NC-", "NC+"):
                return line
            mu = self.variables[row].mu * (1 if sets[friction] == "NC+" else -1)
            return [x + mu * A[friction] for x, A in zip(line, self.rows.A)]

        unknown = [row for row, where in enumerate(sets) if where in ("C", "CF")]
        columns = [column(row) for row in unknown]
        return determinant([[x[row] for x in columns] for row in unknown]) != 0


def word(found):
    return [(step["drive"], step["driven"], step["goal"], step["limiting"], step["from"], step["to"])
            for step in found.pivots]
