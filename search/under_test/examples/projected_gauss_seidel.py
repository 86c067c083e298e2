#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A program under test: projected Gauss-Seidel with Coulomb friction in the plane.

    ./run search --solver search/under_test/examples/projected_gauss_seidel.py --problems 2000

The first line says what it is; then a line with a problem, a line with forces, until the input ends.
"""

import json
import sys

TURNS = 1000
ACCURACY = 1e-6


def solve(problem):
    A, b = problem["A"], problem["b"]
    f = [0.0] * len(b)

    def relaxed(row):
        a = b[row] + sum(x * y for x, y in zip(A[row], f))
        return f[row] - a / A[row][row] if A[row][row] > 0 else f[row]

    for _ in range(TURNS):
        change, row = 0.0, 0
        for kind, mu in zip(problem["kinds"], problem["mu"]):
            normal = row
            new = [relaxed(row)] if kind == "bilateral" else [max(0.0, relaxed(row))]
            change = max(change, abs(new[0] - f[row]))
            f[row] = new[0]
            row += 1
            if kind != "static":
                continue
            for _ in range(problem["dimension"] - 1):
                limit = mu * max(0.0, f[normal])
                value = min(limit, max(-limit, relaxed(row)))
                change = max(change, abs(value - f[row]))
                f[row] = value
                row += 1
        if change <= 0.01 * ACCURACY * max(map(abs, f), default=0.0):
            return {"solved": True, "f": f}
    return {"solved": False}


print(json.dumps({"protocol": 1, "solver": "projected Gauss-Seidel", "version": "1", "law": "pyramid",
                  "accuracy": ACCURACY}), flush=True)
for line in sys.stdin:
    print(json.dumps(solve(json.loads(line))), flush=True)
